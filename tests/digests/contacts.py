"""All that the Python package says of a clip, in digits that keep every bit:
    contacts.py SCENE AVATAR CLIP EVERY link|exact COUNTERS SWEPT
Each link's verdict of each step, one by one and as a batch, to standard output; the work of each
step to the file COUNTERS; the surface that the last link sweeps to the file SWEPT."""
import sys

import numpy as np

import foretouch


def bits(array):
    """A line of an array's numbers."""
    return " ".join(float(number).hex() for number in np.asarray(array).ravel())


def tell(step):
    for name in ("toi", "free_until", "separation", "penetration"):
        print(name, bits(getattr(step, name)))
    for name in ("points", "points_on_link", "normals"):
        print(name, bits(getattr(step, name)))
    print("verdicts", *step.verdicts.tolist())
    print("triangles", *step.triangles.tolist())
    for c in step.contacts:
        print(c.link, c.verdict.name, c.reason, c.object, c.lss, c.link_triangle, c.link_feature,
              c.scene_feature)


def sweep(path, motions, link):
    surface = foretouch.swept_surface(motions, link, error=0.004)
    with open(path, "w", encoding="utf-8") as file:
        print(surface.certified_error.hex(), surface.pieces, file=file)
        for vertex, time in zip(surface.vertices, surface.times):
            print(bits(vertex), float(time).hex(), file=file)
        np.savetxt(file, surface.triangles, fmt="%d")


def main(scene_path, avatar_path, clip_path, every, fidelity, counters_path, swept_path):
    scene = foretouch.Scene.load(scene_path)
    avatar = foretouch.Avatar.load(avatar_path)
    surface = foretouch.Surface.load(avatar, avatar_path) if fidelity == "exact" else None
    poses = foretouch.Clip.load(clip_path).poses(avatar)[::int(every)]
    query = foretouch.Query(avatar, scene, fidelity=fidelity, surface=surface)
    motions = [foretouch.Motion(avatar, a, b) for a, b in zip(poses, poses[1:])]
    with open(counters_path, "w", encoding="utf-8") as file:
        for number, motion in enumerate(motions):
            step = query.first_contacts(motion)
            print("step", number)
            tell(step)
            print("touches", *query.touches_at(motion, [0.0, 1.0]).astype(int).ravel().tolist())
            print(step.counters, file=file)
    steps = query.first_contacts_many(poses, threads=2)
    print("batch", bits(steps.free_until), bits(steps.points))
    sweep(swept_path, motions[:12], avatar.names[-1])


if __name__ == "__main__":
    main(*sys.argv[1:])

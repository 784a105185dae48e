# %% [markdown]
# # A hand through a railing
#
# The dancer of the bundled example sweeps the left arm along the stairs. A tracker sees the body ten
# times per second. Between two poses the hand passes bars of 14 mm: which does it meet, and when?
#
# Run it as a program, or cell by cell in an editor that knows `# %%`. It writes nothing, unless
# `--output FOLDER` says where: then the swept surface of the hand, and a plot if matplotlib is there.

# %% What is needed
import argparse
import time
from pathlib import Path

import numpy as np

import foretouch
from foretouch import Verdict

parser = argparse.ArgumentParser(description="Which bars of a railing does a hand meet, and when?")
parser.add_argument("--output", type=Path, metavar="FOLDER", help="write hand.obj (and hand.png) there")
output = parser.parse_args().output

# %% The scene, the avatar, the clip
folder = foretouch.example_folder()
scene = foretouch.Scene.load(folder / "room.obj")
avatar = foretouch.Avatar.load(folder / "dancer.avatar.json")
clip = foretouch.Clip.load(folder / "dancer.bvh")
print(scene, avatar, clip, sep="\n")

# %% Ten poses per second, between 2.1 s and 3.6 s
RATE_HZ = 10
every = round(1 / (RATE_HZ * clip.frame_time_s))
poses = clip.poses(avatar)[::every]
first, last = round(2.1 * RATE_HZ), round(3.6 * RATE_HZ)
motions = [foretouch.Motion(avatar, poses[i], poses[i + 1]) for i in range(first, last)]

# %% What the left arm touches, followed through time
query = foretouch.Query(avatar, scene)
ARM = ["LeftArm", "LeftForeArm", "LeftHand"]
print("\nfollowed through time, the left arm meets")
met = missed = 0
for number, motion in enumerate(motions, start=first):
    step = query.first_contacts(motion)
    seen = query.touches_at(motion, [0.0, 1.0]).any(axis=0)
    for contact in step.contacts:
        if contact.link not in ARM or contact.verdict != Verdict.CONTACT:
            continue
        met += 1
        missed += not seen[contact.link_id]
        print(f"  {(number + contact.toi) / RATE_HZ:.4f} s  {contact.link:12} {contact.object:14}"
              f" {1e3 * contact.separation:.2f} mm apart"
              + ("" if seen[contact.link_id] else "   (no pose touches it)"))
print(f"{met} first contacts of the left arm; the poses alone would have missed {missed}")

# %% What more accuracy costs
print("\ntolerance, time a step (best of nine), contacts of all links")
for tolerance in [1e-2, 1e-3, 1e-4, 1e-6]:
    finer = foretouch.Query(avatar, scene, tolerance=tolerance)
    taken = []
    for _ in range(9):
        began = time.perf_counter()
        steps = finer.first_contacts_many(poses, threads=1)
        taken.append(1e6 * (time.perf_counter() - began) / len(steps))
    contacts = (steps.verdicts == Verdict.CONTACT).sum()
    print(f"  {tolerance:7g} m  {min(taken):6.1f} us  {contacts}")

# %% The whole clip at once: up to when is each step free?
steps = foretouch.first_contacts_many(avatar, poses, scene)
free = steps.free_until.min(axis=1)
print(f"\n{(free == 1).sum()} of {len(steps)} steps are proven free as a whole; "
      f"the earliest contact of the others comes at t = {free[free < 1].mean():.2f} on average")
busiest = int((steps.verdicts == Verdict.CONTACT).sum(axis=1).argmax())
print(f"busiest is step {busiest}: {steps[busiest]}")

# %% What the hand sweeps while it passes, as a closed surface that is certain to contain it
surface = foretouch.swept_surface(motions, "LeftHand", error=0.002)
size = surface.vertices.max(axis=0) - surface.vertices.min(axis=0)
print(f"\nswept surface of the hand: {len(surface.triangles)} triangles, "
      f"{size[0]:.2f} x {size[1]:.2f} x {size[2]:.2f} m, at most "
      f"{1e3 * surface.certified_error:.2f} mm too large")

# %% Into files, where that was asked for
if output is not None:
    output.mkdir(parents=True, exist_ok=True)
    with open(output / "hand.obj", "w", encoding="utf-8") as file:
        np.savetxt(file, surface.vertices, fmt="v %.9g %.9g %.9g")
        np.savetxt(file, surface.triangles + 1, fmt="f %d %d %d")
    try:
        from matplotlib.figure import Figure
    except ImportError:
        print("no matplotlib: no plot")
    else:
        figure = Figure(figsize=(8, 3))
        axes = figure.add_subplot(xlabel="time (s)", ylabel="free until t", ylim=(0, 1.05))
        axes.step(np.arange(len(free)) / RATE_HZ, free, where="post")
        figure.savefig(output / "hand.png", dpi=150, bbox_inches="tight")

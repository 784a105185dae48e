"""The bundled dancer in the bundled room: as `foretouch replay` has it, digit for digit where the two
have the same poses, and as near as single precision lets it where Blender has read the clip."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import bpy
import numpy as np
from blend import EXAMPLES, PROGRAM, drained, finished, fresh

from foretouch_blender import library
from foretouch_blender.axes import frames_of
from foretouch_blender.follow import Following
from foretouch_blender.motion import Range
from foretouch_blender.sampled import sampling

ROOM, AVATAR, CLIP = (EXAMPLES / name for name in ("room.obj", "dancer.avatar.json", "dancer.bvh"))
FRAMES_PER_SECOND = 60


def replayed():
    """Header, steps, touches and summary of the program's results, of every frame."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder, "out.jsonl")
        subprocess.run([PROGRAM, "replay", "--scene", ROOM, "--avatar", AVATAR, "--motion", CLIP,
                        "--scope", "objects", "--output", output], check=True, capture_output=True)
        lines = [json.loads(line) for line in output.read_text().splitlines()]
    steps = [line for line in lines if "step" in line]
    return lines[0], steps, [line["touch"] for line in lines if "touch" in line], lines[-1]["summary"]


def seconds(instant, frame_time):
    """Of frames from 0, as the program computes them."""
    begin, end = frame_time * instant.whole, frame_time * (instant.whole + 1)
    return begin + instant.share * (end - begin)


def imported_dancer(scene):
    """The clip by Blender's own reader. Debian's asks for a mode of open() that Python has no more."""
    import io_anim_bvh.import_bvh as reader
    reader.open = lambda path, mode="r", **rest: open(path, mode.replace("U", ""), **rest)
    try:
        finished(bpy.ops.import_anim.bvh, filepath=str(CLIP), axis_forward="-Z", axis_up="Y",
                 rotate_mode="QUATERNION", update_scene_fps=True, update_scene_duration=True,
                 use_fps_scale=False, frame_start=1)
    finally:
        del reader.open
    return bpy.context.object


def imported_room(scene):
    finished(bpy.ops.wm.obj_import, filepath=str(ROOM), forward_axis="NEGATIVE_Z", up_axis="Y")
    room = bpy.data.collections.new("Room")
    scene.collection.children.link(room)
    for thing in bpy.context.selected_objects:
        room.objects.link(thing)
    return room


def named(touch):
    return touch["link"], touch["object"], touch["begin"], touch["end"]


class SamePoses(unittest.TestCase):
    """The add-on's own following, given the doubles that the program reads."""

    @classmethod
    def setUpClass(cls):
        fresh()
        cls.ft = library.package()
        cls.header, cls.steps, cls.expected, summary = replayed()
        assert summary["followed"]
        avatar, room = cls.ft.Avatar.load(AVATAR), cls.ft.Scene.load(ROOM)
        poses = cls.ft.Clip.load(CLIP).poses(avatar)
        frames = Range(0, len(poses) - 1, cls.header["frame_time"])
        following = Following(cls.ft, avatar, room, [], cls.header["tolerance"], frames)
        for k, pose in enumerate(poses):
            following.push(k, pose, [])
            if k % 7 == 6:
                following.follow()
        following.follow()
        cls.found = following.finish()

    def test_touches_are_the_programs_digit_for_digit(self):
        frame_time = self.header["frame_time"]
        found = [(t.link, t.object, seconds(t.begin, frame_time), seconds(t.end, frame_time))
                 for t in self.found]
        self.assertGreater(len(found), 100)
        self.assertEqual(sorted(found), sorted(map(named, self.expected)))

    def test_places_are_those_of_its_steps_digit_for_digit(self):
        contacts = {(step["step"], c["link"], c["object"]): c for step in self.steps
                    for c in step["objects"] if c["verdict"] == "contact"}
        compared = 0
        for touch in self.found:
            contact = contacts.get((touch.begin.whole, touch.link, touch.object))
            if contact is None or contact["toi"] != touch.begin.share:
                continue
            compared += 1
            self.assertEqual((list(touch.point), list(touch.normal), touch.separation),
                             (contact["point"], contact["normal"], contact["separation"]))
        self.assertGreater(compared, 0.9 * len(self.found))


class Imported(unittest.TestCase):
    """Read and evaluated by Blender, whose matrices are in single precision."""

    @classmethod
    def setUpClass(cls):
        cls.scene = fresh()
        cls.rig = imported_dancer(cls.scene)
        asked = cls.scene.foretouch
        asked.body, asked.against = cls.rig, imported_room(cls.scene)
        asked.body_from, asked.avatar_file = "FILE", str(AVATAR)
        finished(bpy.ops.foretouch.check)

    def test_poses_are_the_clips_to_a_micrometre_or_two(self):
        ft = library.package()
        sampled = drained(sampling(bpy.context))
        avatar = ft.Avatar.load(AVATAR)
        clip = ft.Clip.load(CLIP).poses(avatar)
        off = (frames_of(*sampled.poses, avatar.parents)
               - frames_of(clip.rotations, clip.translations, avatar.parents))
        print(f"off by {np.abs(off[..., :3, 3]).max():.2e} m, {np.abs(off[..., :3, :3]).max():.2e} of a rotation")
        self.assertEqual(len(sampled.frames), len(clip))
        self.assertLess(np.abs(off[..., :3, 3]).max(), 5e-6)
        self.assertLess(np.abs(off[..., :3, :3]).max(), 1e-5)

    def test_touches_are_the_programs_one_by_one(self):
        _, _, expected, _ = replayed()
        found = [(t.link, t.object, (t.begin - 1) / FRAMES_PER_SECOND, (t.end - 1) / FRAMES_PER_SECOND)
                 for t in self.scene.foretouch.touches]
        missing, extra, worst = compared(found, [named(t) for t in expected])
        print(f"{len(found)} touches, begins differ by up to {1e3 * worst:.3f} ms")
        self.assertGreater(len(found), 100)
        self.assertEqual((missing, extra), ([], []))
        # Some micrometres of a pose move a contact by less than its tolerance, which bodies here cross
        # in a fraction of a millisecond.
        self.assertLess(worst, 0.5e-3)


def compared(found, expected, within=2e-3):
    """Those that only one of the two has, and the largest difference of a begin."""
    left, missing, worst = list(found), [], 0.0
    for touch in expected:
        near = [t for t in left if t[:2] == touch[:2] and abs(t[2] - touch[2]) < within]
        if not near:
            missing.append(touch)
            continue
        best = min(near, key=lambda t: abs(t[2] - touch[2]))
        worst = max(worst, abs(best[2] - touch[2]))
        left.remove(best)
    return missing, left, worst

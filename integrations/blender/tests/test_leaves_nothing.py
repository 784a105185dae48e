"""Undo, removal and a cancel leave nothing behind; files keep working without the add-on."""

import json
import os
import subprocess
import tempfile
import unittest

import bpy
from blend import ADDON, contents, example, finished, touches

import make_scene
from foretouch_blender import operators, sampled

OPERATORS = {"check": {}, "make_solid": {}, "sweep": {"of_bone": True}}


def prepared():
    scene, rig = example()
    scene.frame_set(5)
    rig.data.bones.active = rig.data.bones["Hand"]
    bpy.data.objects["Floor"].select_set(True)
    return scene, rig


class Undo(unittest.TestCase):
    def test_takes_everything_back(self):
        for name, options in OPERATORS.items():
            scene, _ = prepared()
            bpy.ops.ed.undo_push(message="before")
            before = contents(scene)
            self.assertEqual(getattr(bpy.ops.foretouch, name)("EXEC_DEFAULT", True, **options), {"FINISHED"})
            after = contents(bpy.context.scene)
            self.assertNotEqual(after, before, name)
            bpy.ops.ed.undo()
            self.assertEqual(contents(bpy.context.scene), before, name)
            self.assertEqual(bpy.data.objects["Rig"].animation_data.action.name, "Swing")
            bpy.ops.ed.redo()
            self.assertEqual(contents(bpy.context.scene), after, name)

    def test_every_operator_that_changes_the_file_can_be_undone(self):
        example()
        for name in (*OPERATORS, "jump", "clear"):
            operator = getattr(bpy.types, f"FORETOUCH_OT_{name}")
            self.assertIn("UNDO", operator.bl_options)


class Removal(unittest.TestCase):
    def test_takes_away_all_but_solid_actions(self):
        scene, _ = prepared()
        before = contents(scene)
        finished(bpy.ops.foretouch.check)
        finished(bpy.ops.foretouch.jump, index=1)
        finished(bpy.ops.foretouch.sweep)
        finished(bpy.ops.foretouch.sweep, of_bone=True)
        held = contents(scene)
        self.assertEqual(len(held["objects"]) - len(before["objects"]), 4 + 2)
        self.assertEqual(len(held["markers"]), 2)
        finished(bpy.ops.foretouch.clear)
        scene.frame_set(5)
        bpy.data.objects["Floor"].select_set(True)
        self.assertEqual(contents(scene), before)

    def test_leaves_what_the_user_made(self):
        scene, _ = prepared()
        finished(bpy.ops.foretouch.check)
        scene.timeline_markers.new("mine", frame=7)
        folder = next(child for child in scene.collection.children if "foretouch" in child)
        mine = bpy.data.objects.new("Mine", None)
        folder.objects.link(mine)
        other = bpy.data.collections.new("Foretouch")
        scene.collection.children.link(other)
        finished(bpy.ops.foretouch.clear)
        self.assertEqual([m.name for m in scene.timeline_markers], ["mine"])
        self.assertEqual([thing.name for thing in folder.objects], ["Mine"])
        self.assertIn(other.name, scene.collection.children)

    def test_a_second_check_takes_the_place_of_the_first(self):
        scene, _ = prepared()
        finished(bpy.ops.foretouch.check)
        first = contents(scene), touches(scene)
        finished(bpy.ops.foretouch.check)
        self.assertEqual((contents(scene), touches(scene)), first)


class Cancel(unittest.TestCase):
    """An operator's work, closed after every possible number of slices."""

    def setUp(self):
        example()
        self.chunks = operators.CHUNK, sampled.CHUNK
        operators.CHUNK = sampled.CHUNK = 4

    def tearDown(self):
        operators.CHUNK, sampled.CHUNK = self.chunks

    def test_leaves_nothing(self):
        for name, options in OPERATORS.items():
            slices = 0
            while True:
                scene, rig = prepared()
                before = contents(scene)
                asked = type("Asked", (), {**options, "_asked": operators.FORETOUCH_OT_sweep._asked,
                                           "_check_again": operators.FORETOUCH_OT_make_solid._check_again})()
                work = getattr(operators, f"FORETOUCH_OT_{name}").steps(asked, bpy.context)
                try:
                    for _ in range(slices + 1):
                        next(work)
                except StopIteration:
                    break
                work.close()
                self.assertEqual(contents(scene), before, f"{name} after {slices + 1} slices")
                self.assertEqual(rig.animation_data.action.name, "Swing")
                slices += 1
            self.assertGreater(slices, 5, name)


class WithoutTheAddon(unittest.TestCase):
    LOOK = """
import bpy, json
assert not hasattr(bpy.types.Scene, "foretouch")
scene = bpy.context.scene
folder = next(c for c in scene.collection.children if c.get("foretouch"))
rig = bpy.data.objects["Rig"]
places = []
for frame in range(1, %d):
    scene.frame_set(frame)
    places.append([list(row) for row in rig.pose.bones["Hand"].matrix])
bpy.ops.wm.save_as_mainfile(filepath=bpy.data.filepath)
print("SEEN " + json.dumps({"markers": [(m.name, m.frame) for m in scene.timeline_markers],
    "empties": sorted(o.name for o in folder.objects if o.type == "EMPTY"),
    "sweeps": [len(o.data.polygons) for o in folder.objects if o.type == "MESH"],
    "actions": sorted(a.name for a in bpy.data.actions), "action": rig.animation_data.action.name,
    "hand": places}))
""" % (make_scene.FRAMES + 1)

    def test_a_saved_file_opens_plays_and_comes_back(self):
        scene, rig = prepared()
        finished(bpy.ops.foretouch.check)
        finished(bpy.ops.foretouch.sweep, of_bone=True)
        finished(bpy.ops.foretouch.make_solid)
        found = touches(scene)
        faces = [len(thing.data.polygons) for thing in bpy.data.objects if thing.name.startswith("Sweep")]
        markers = [[m.name, m.frame] for m in scene.timeline_markers]
        hand = []
        for frame in range(1, make_scene.FRAMES + 1):
            scene.frame_set(frame)
            hand.append([list(row) for row in rig.pose.bones["Hand"].matrix])
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "file.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            seen = self.seen(path)
            self.assertEqual(seen["markers"], markers)
            self.assertEqual(len(seen["empties"]), len(found))
            self.assertEqual(seen["sweeps"], faces)
            self.assertEqual(seen["actions"], ["Swing", "Swing solid"])
            self.assertEqual((seen["action"], seen["hand"]), ("Swing solid", hand))
            # Saved again without the add-on, and opened with it.
            bpy.ops.wm.open_mainfile(filepath=path)
            self.assertEqual(touches(bpy.context.scene), found)
            finished(bpy.ops.foretouch.clear)

    def seen(self, path):
        done = subprocess.run([bpy.app.binary_path, "-b", "--factory-startup", path, "--python-exit-code", "1",
                               "--python-expr", self.LOOK], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        (line,) = [line for line in done.stdout.splitlines() if line.startswith("SEEN ")]
        return json.loads(line[5:])


class OnAndOff(unittest.TestCase):
    def test_the_addon_can_be_turned_off_and_on(self):
        import addon_utils
        example()
        finished(bpy.ops.foretouch.check)
        addon_utils.disable(ADDON)
        self.assertFalse(hasattr(bpy.types.Scene, "foretouch"))
        addon_utils.enable(ADDON)
        self.assertEqual(len(bpy.context.scene.foretouch.touches), 4)

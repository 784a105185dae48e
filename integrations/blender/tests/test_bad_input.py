"""What cannot be answered is told in Blender's words, and changes nothing."""

import os
import sys
import tempfile
import unittest

import bpy
from blend import contents, example, finished, fresh

import make_scene
from foretouch_blender import library


class BadInput(unittest.TestCase):
    def setUp(self):
        self.scene, self.rig = example()
        self.asked = self.scene.foretouch

    def told(self, *words, operator=None):
        """The error has all of these words, and the file is as before."""
        before = contents(self.scene)
        with self.assertRaises(RuntimeError) as caught:
            (operator or bpy.ops.foretouch.check)()
        text = str(caught.exception)
        self.assertNotIn("Traceback", text)
        for word in words:
            self.assertIn(word, text)
        self.assertEqual(contents(self.scene), before)

    def told_and_checked(self, *words):
        """It is answered, with a note."""
        finished(bpy.ops.foretouch.check)
        for word in words:
            self.assertIn(word, self.asked.notes)

    def test_no_body(self):
        self.asked.body = None
        self.told("Choose an armature")

    def test_a_body_of_another_scene(self):
        bpy.data.scenes.new("Other").collection.objects.link(self.rig)
        self.scene.collection.objects.unlink(self.rig)
        self.told("Choose an armature")

    def test_no_action(self):
        self.rig.animation_data_clear()
        self.told("'Rig' has no action", "Action Editor")

    def test_one_frame(self):
        self.asked.frames, self.scene.frame_start, self.scene.frame_end = "SCENE", 3, 3
        self.told("between two poses", "frame 3")

    def test_rest_position(self):
        self.rig.data.pose_position = "REST"
        self.told("rest position")

    def test_a_disabled_armature(self):
        self.rig.hide_viewport = True
        self.told("'Rig' is disabled in viewports")

    def test_edit_mode(self):
        bpy.context.view_layer.objects.active = self.rig
        bpy.ops.object.mode_set(mode="EDIT")
        self.told("Edit Mode")

    def test_no_mesh(self):
        bpy.data.objects.remove(bpy.data.objects["Arm"])
        self.told("No shown mesh moves with 'Rig'", "Armature Deform")

    def test_a_mesh_without_vertices(self):
        bpy.data.objects["Arm"].data.clear_geometry()
        self.told("no faces")

    def test_one_mesh_of_two_without_vertices(self):
        make_scene.skin(self.scene, self.rig, "Bare").data.clear_geometry()
        self.told_and_checked("'Bare' has no faces")
        self.assertEqual(len(self.asked.touches), 4)

    def test_a_mesh_without_weights(self):
        bpy.data.objects["Arm"].vertex_groups.clear()
        self.told_and_checked("'Arm' have no weights", "armature object")
        (found,) = self.asked.touches  # at rest it is in the board
        self.assertEqual((found.link, found.begins_inside, found.is_open), ("Arm (no bone)", True, True))

    def test_a_mesh_that_moves_by_itself(self):
        arm = bpy.data.objects["Arm"]
        arm.keyframe_insert("location", frame=1)
        self.told("'Arm' does not move with 'Rig' alone")

    def test_nothing_to_check_against(self):
        self.asked.against = None
        self.told("Choose what to check against")
        self.asked.against = bpy.data.collections.new("Bare")
        self.told("'Bare' has no shown objects")

    def test_objects_without_faces(self):
        for thing in self.asked.against.objects:
            thing.data.clear_geometry()
        self.told("nothing to touch")

    def test_one_object_without_vertices(self):
        bpy.data.objects["Floor"].data.clear_geometry()
        self.told_and_checked("'Floor' has no faces")
        self.assertEqual(len(self.asked.touches), 4)

    def test_hidden_objects_are_left_out(self):
        bpy.data.objects["Floor"].hide_set(True)
        self.told_and_checked("'Floor' is hidden")
        bpy.data.objects["Board"].hide_viewport = True
        self.told("The collection 'Room' has no shown objects")

    def test_a_hidden_mesh_is_no_body(self):
        bpy.data.objects["Arm"].hide_set(True)
        self.told("No shown mesh moves with 'Rig'")

    def test_vertices_that_are_no_numbers(self):
        bpy.data.objects["Arm"].data.vertices[7].co.x = float("nan")
        self.told_and_checked("faces of 'Arm' have vertices that are no numbers")
        bpy.data.objects["Board"].data.vertices[0].co.x = float("nan")
        self.told_and_checked("faces of 'Board' have vertices that are no numbers")

    def test_vertices_far_away(self):
        bpy.data.objects["Board"].data.vertices[0].co.x = 1e30
        self.told("'Board' has a vertex farther than 10,000 km away")
        bpy.data.objects["Board"].data.vertices[0].co.x = 0.0
        bpy.data.objects["Arm"].data.vertices[7].co.x = 1e30
        self.told("'Arm' has a vertex farther than 10,000 km away")

    def test_a_scale_of_zero(self):
        self.rig.scale = (0, 0, 0)
        self.told("scale of 0")

    def test_an_armature_that_is_scaled_unevenly_gets_thicker_capsules(self):
        self.rig.scale = (1.0, 1.1, 1.0)
        self.told_and_checked("stretches by up to", "mm thicker", "Apply the armature's scale (Ctrl A)")
        self.assertEqual(len(self.asked.touches), 4)

    def test_a_bone_that_stretches_gets_thicker_capsules(self):
        self.rig.pose.bones["Fore"].scale = (1.0, 1.2, 1.0)
        self.told_and_checked("Bone 'Fore' stretches by up to", "Alt S")

    def test_a_bone_that_vanishes(self):
        self.rig.pose.bones["Hand"].scale = (0.01, 0.01, 0.01)
        self.told("Bone 'Hand' is scaled by 0.01, 0.01, 0.01 at frame 1", "Alt S")

    def test_a_mirrored_bone(self):
        self.rig.pose.bones["Hand"].scale = (-1.0, 1.0, 1.0)
        self.told("Bone 'Hand'", "mirrored")

    def test_an_object_that_changes_its_shape(self):
        board = bpy.data.objects["Board"]
        board.shape_key_add(name="Basis")
        key = board.shape_key_add(name="Wide")
        key.data[0].co.x -= 0.1
        for frame, value in ((1, 0.0), (23, 1.0)):
            key.value = value
            key.keyframe_insert("value", frame=frame)
        self.told("'Board' changes its shape at frame 2")

    def test_an_object_that_changes_its_size(self):
        board = bpy.data.objects["Board"]
        for frame, size in ((1, 1.0), (23, 2.0)):
            board.scale = (size, size, size)
            board.keyframe_insert("scale", frame=frame)
        self.told("'Board' changes its size at frame", "rigid")

    def test_no_avatar_file(self):
        self.asked.body_from = "FILE"
        self.told("Choose the avatar file")
        self.asked.avatar_file = "/nowhere/avatar.json"
        self.told("/nowhere/avatar.json")

    def test_an_avatar_of_another_rig(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "other.avatar.json")
            with open(path, "w", encoding="utf-8") as file:
                file.write('{"format": "foretouch-avatar", "version": 1, "links": [{"name": "Tail", "parent": null, '
                           '"offset": [0, 0, 0], "lss": [{"a": [0, 0, 0], "b": [0, 1, 0], "radius": 0.1}]}]}')
            self.asked.body_from, self.asked.avatar_file = "FILE", path
            self.told("'Tail' is no bone of 'Rig'")
            with open(path, "w", encoding="utf-8") as file:
                file.write("{")
            self.told("other.avatar.json")

    def test_a_skeleton_that_changes_is_read_anew(self):
        finished(bpy.ops.foretouch.check)
        bpy.context.view_layer.objects.active = self.rig
        bpy.ops.object.mode_set(mode="EDIT")
        self.rig.data.edit_bones.remove(self.rig.data.edit_bones["Hand"])
        bpy.ops.object.mode_set(mode="OBJECT")
        self.told_and_checked("'Arm' have no weights")
        self.assertEqual({t.link for t in self.asked.touches}, {"Fore", "Arm (no bone)"})
        finished(bpy.ops.foretouch.jump, index=0)

    def test_a_jump_to_no_touch(self):
        self.told("Choose a touch", operator=bpy.ops.foretouch.jump)
        self.told("There are 0 touches", operator=lambda: bpy.ops.foretouch.jump(index=3))

    def test_a_sweep_of_nothing(self):
        self.told("Choose a touch in the list, or make a bone", operator=bpy.ops.foretouch.sweep)

    def test_constraints_of_bones_cannot_be_made_solid(self):
        self.rig.pose.bones["Hand"].constraints.new("LIMIT_ROTATION").name = "Wrist"
        self.told("'Hand' has the constraint 'Wrist'", "Bake Action", operator=bpy.ops.foretouch.make_solid)

    def test_an_action_that_is_mixed_cannot_be_made_solid(self):
        self.rig.animation_data.action_influence = 0.5
        self.told("mixed with NLA", operator=bpy.ops.foretouch.make_solid)


class MissingPackage(unittest.TestCase):
    def test_is_told_with_the_line_that_installs_it(self):
        scene, _ = example()
        package, folders = sys.modules.pop("foretouch"), library._folders
        sys.modules["foretouch"], library._folders = None, lambda: []
        try:
            before = contents(scene)
            with self.assertRaises(RuntimeError) as caught:
                bpy.ops.foretouch.check()
            self.assertIn("pip install", str(caught.exception))
            self.assertIn(f"Python {sys.version_info.major}.{sys.version_info.minor}", str(caught.exception))
            self.assertNotIn("Traceback", str(caught.exception))
            self.assertEqual(contents(scene), before)
        finally:
            sys.modules["foretouch"], library._folders = package, folders


class LinkedRig(unittest.TestCase):
    """The rig of another file: it is checked, and not changed."""

    def test_is_checked_but_not_made_solid(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "hero.blend")
            _, rig = example()
            bpy.ops.wm.save_as_mainfile(filepath=path, check_existing=False)
            scene = fresh()
            with bpy.data.libraries.load(path, link=True) as (_, wanted):
                wanted.objects = ["Rig", "Arm"]
            for thing in wanted.objects:
                scene.collection.objects.link(thing)
            room = bpy.data.collections.new("Room")
            scene.collection.children.link(room)
            make_scene.box("Board", (0.30, 0.004, 0.60), (0.66, 0.0, 1.0), room)
            scene.foretouch.body, scene.foretouch.against = wanted.objects[0], room
            bpy.context.view_layer.update()
            finished(bpy.ops.foretouch.check)
            self.assertEqual(len(scene.foretouch.touches), 4)
            before = contents(scene)
            with self.assertRaises(RuntimeError) as caught:
                bpy.ops.foretouch.make_solid()
            self.assertIn("'Rig' is linked from", str(caught.exception))
            self.assertIn("library override", str(caught.exception))
            self.assertEqual(contents(scene), before)

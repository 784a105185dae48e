"""The capsules as objects, held against the body that is checked, wherever the action has it."""

import unittest

import bpy
import numpy as np
from blend import drained, example, finished

import make_scene
from foretouch_blender.axes import frames_of
from foretouch_blender.capsules import GROWTH
from foretouch_blender.sampled import sampling


def capsules(scene):
    return [thing for thing in scene.objects if thing.get("foretouch") == "capsule"]


def ends_in_world(thing):
    world, half = np.array(thing.matrix_world), thing["length"] / 2
    return np.array([world[:3, 3] - half * world[:3, 2], world[:3, 3] + half * world[:3, 2]])


class Capsules(unittest.TestCase):
    def assert_as_checked(self, scene, scale=1.0):
        finished(bpy.ops.foretouch.capsules)
        sampled = drained(sampling(bpy.context))
        avatar, axes = sampled.body.avatar, sampled.axes
        found = capsules(scene)
        self.assertEqual(len(found), sum(len(lss) for lss in avatar.lss))
        self.assertGreater(len(found), 2)
        for k, frame in enumerate(sampled.instants):
            scene.frame_set(int(frame))
            bpy.context.view_layer.update()
            frames = frames_of(sampled.poses[0][k], sampled.poses[1][k], avatar.parents)
            things = iter(found)
            for link, lss in enumerate(avatar.lss):
                for one in lss:
                    thing = next(things)
                    expected = np.array([one.a, one.b]) @ frames[link][:3, :3].T + frames[link][:3, 3]
                    np.testing.assert_allclose(axes.points(ends_in_world(thing)), expected, atol=1e-5)
                    self.assertAlmostEqual(thing["radius"] * scale * axes.unit, one.radius, places=6)

    def test_move_with_the_bones_as_the_body_that_is_checked(self):
        scene, rig = example()
        self.assert_as_checked(scene)

    def test_of_an_armature_that_is_scaled_evenly_and_other_units(self):
        scene, rig = example()
        scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", 0.5
        rig.scale = (2.0, 2.0, 2.0)
        bpy.context.view_layer.update()
        self.assert_as_checked(scene, scale=2.0)

    def test_of_envelopes(self):
        scene, rig = example()
        scene.foretouch.body_from = "ENVELOPES"
        self.assert_as_checked(scene)

    def test_meshes_hold_the_capsules_and_hardly_more(self):
        scene, rig = example()
        finished(bpy.ops.foretouch.capsules)
        for thing in capsules(scene):
            ends = [np.array([0, 0, sign * thing["length"] / 2]) for sign in (-1, 1)]
            for face in thing.data.polygons:
                normal, centre = np.array(face.normal), np.array(face.center)
                for end in ends:  # convex: every face is beyond both balls
                    self.assertGreater((centre - end) @ normal, thing["radius"] * (1 - 1e-6))
            for vertex in thing.data.vertices:
                place = np.array(vertex.co)
                axis = np.array([0, 0, np.clip(place[2], ends[0][2], ends[1][2])])
                self.assertLess(np.linalg.norm(place - axis), thing["radius"] * GROWTH * (1 + 1e-6))

    def test_are_replaced_and_removed(self):
        scene, rig = example()
        before = sorted(mesh.name for mesh in bpy.data.meshes)
        finished(bpy.ops.foretouch.capsules)
        count = len(capsules(scene))
        finished(bpy.ops.foretouch.capsules)
        self.assertEqual(len(capsules(scene)), count)
        finished(bpy.ops.foretouch.clear)
        self.assertEqual(capsules(scene), [])
        self.assertEqual(sorted(mesh.name for mesh in bpy.data.meshes), before)

    def test_are_no_obstacles_and_no_part_of_the_body(self):
        scene, rig = example()
        finished(bpy.ops.foretouch.check)
        before = [(t.link, t.object, t.begin, t.end) for t in scene.foretouch.touches]
        finished(bpy.ops.foretouch.capsules)
        finished(bpy.ops.foretouch.check)
        self.assertEqual([(t.link, t.object, t.begin, t.end) for t in scene.foretouch.touches], before)

    def test_an_uneven_scale_is_told(self):
        scene, rig = example()
        rig.scale = (1.0, 2.0, 1.0)
        bpy.context.view_layer.update()
        with self.assertRaisesRegex(RuntimeError, "scaled unevenly"):
            bpy.ops.foretouch.capsules()

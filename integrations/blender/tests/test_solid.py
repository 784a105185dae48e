"""The solid action, judged by distances of points beside the capsules that Blender moves."""

import unittest

import bpy
import numpy as np
from blend import drained, example, finished

import make_scene
from foretouch_blender.axes import frames_of
from foretouch_blender.operators import following
from foretouch_blender.rig import triangles_of
from foretouch_blender.sampled import sampling

BETWEEN = 8
"""Instants between two frames at which the judge looks."""


def keys(action):
    return {(curve.data_path, curve.array_index): [tuple(point.co) for point in curve.keyframe_points]
            for curve in action.fcurves}


def instants(rig):
    return sorted({at for points in keys(rig.animation_data.action).values() for at, _ in points})


def capsules_between(sampled):
    """Ends and radii of all capsules at many instants, each joint on the shorter arc from frame to frame,
    by Blender's own quaternions."""
    from mathutils import Matrix, Quaternion, Vector
    avatar = sampled.body.avatar
    for k in range(len(sampled.instants) - 1):
        for share in np.arange(BETWEEN) / BETWEEN:
            frames = []
            for link, parent in enumerate(avatar.parents):
                turn = Quaternion(sampled.poses[0][k, link]).slerp(Quaternion(sampled.poses[0][k + 1, link]), share)
                place = Vector(sampled.poses[1][k, link]).lerp(Vector(sampled.poses[1][k + 1, link]), share)
                local = Matrix.Translation(place) @ turn.to_matrix().to_4x4()
                frames.append(frames[parent] @ local if parent >= 0 else local)
            yield [(frame @ Vector(each.a), frame @ Vector(each.b), each.radius)
                   for frame, lss in zip(frames, avatar.lss) for each in lss]


def gap_to_box(a, b, radius, low, high):
    """Of points along the capsule's axis to a box; below 0 inside."""
    points = np.array(a) + np.linspace(0, 1, 65)[:, None] * (np.array(b) - np.array(a))
    return np.linalg.norm(points - np.clip(points, low, high), axis=1).min() - radius


def deepest(low, high, keys=()):
    """Of all that Blender plays. From key to key the motion is straight."""
    sampled = drained(sampling(bpy.context, more_instants=keys))
    return min(gap_to_box(a, b, radius, low, high)
               for instant in capsules_between(sampled) for a, b, radius in instant)


BOARD = np.array([0.51, 0.70, -0.002]), np.array([0.81, 1.30, 0.002])  # metres, y up


class Solid(unittest.TestCase):
    def test_passes_through_nothing_and_keeps_the_original(self):
        scene, rig = example()
        original = rig.animation_data.action
        before = keys(original)
        self.assertLess(deepest(*BOARD), -0.02)  # it does go through
        finished(bpy.ops.foretouch.make_solid)
        solid = rig.animation_data.action
        self.assertEqual((solid.name, original.name), ("Swing solid", "Swing"))
        self.assertEqual(keys(original), before)
        self.assertTrue(original.use_fake_user)
        self.assertGreater(deepest(*BOARD, instants(rig)), -1e-4)

    def test_is_equal_where_nothing_is_in_the_way(self):
        scene, rig = example()
        bpy.data.objects["Board"].location.x = 2.0
        tracked = drained(sampling(bpy.context))
        finished(bpy.ops.foretouch.make_solid)
        self.assertEqual(instants(rig), list(tracked.frames.instants))
        shown = drained(sampling(bpy.context))
        parents = tracked.body.avatar.parents
        np.testing.assert_allclose(frames_of(*shown.poses, parents), frames_of(*tracked.poses, parents), atol=2e-6)

    def test_in_every_rotation_mode(self):
        for mode in ("QUATERNION", "XYZ", "ZYX", "AXIS_ANGLE"):
            scene, rig = example()
            finished(bpy.ops.foretouch.make_solid)
            expected = drained(sampling(bpy.context))
            scene, rig = example()
            for bone in rig.pose.bones:
                if bone.name != "Shoulder":  # whose action has quaternions
                    bone.rotation_mode = mode
            finished(bpy.ops.foretouch.make_solid)
            found = drained(sampling(bpy.context))
            parents = found.body.avatar.parents
            np.testing.assert_allclose(frames_of(*found.poses, parents), frames_of(*expected.poses, parents),
                                       atol=1e-5, err_msg=mode)

    def test_of_an_armature_that_moves_as_an_object(self):
        scene, rig = example()
        for frame, x in ((1, 0.0), (make_scene.FRAMES, 0.05)):
            rig.location.x = x
            rig.rotation_euler.z = 0.2 * x
            rig.keyframe_insert("location", frame=frame)
            rig.keyframe_insert("rotation_euler", frame=frame)
        self.assertLess(deepest(*BOARD), -0.02)
        finished(bpy.ops.foretouch.make_solid)
        self.assertGreater(deepest(*BOARD, instants(rig)), -1e-4)
        self.assertTrue(any(path == "location" for path, _ in keys(rig.animation_data.action)))

    def test_beside_a_door_that_moves(self):
        scene, rig = example()
        board = bpy.data.objects["Board"]
        for frame, x in ((1, 0.66), (make_scene.FRAMES, 0.60)):
            board.location.x = x
            board.keyframe_insert("location", frame=frame)
        finished(bpy.ops.foretouch.check)
        self.assertGreater(len(scene.foretouch.touches), 0)
        finished(bpy.ops.foretouch.make_solid)
        sampled = drained(sampling(bpy.context, more_instants=instants(rig)))
        self.assertEqual(len(sampled.props), 1)
        self.assertEqual(drained(following(sampled, 1e-5)), [])


def windings(triangles, point):
    """How often a surface (m, 3, 3) winds around a point: solid angles, by van Oosterom and Strackee."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    around = (la * lb * lc + np.einsum("ij,ij->i", a, b) * lc + np.einsum("ij,ij->i", b, c) * la
              + np.einsum("ij,ij->i", c, a) * lb)
    return np.arctan2(volume, around).sum() / (2 * np.pi)


class Sweep(unittest.TestCase):
    """The surface may pass through itself: it holds what it winds around at least once."""

    def test_holds_every_vertex_of_the_hand_at_every_frame(self):
        scene, rig = example()
        for frame, z in ((1, 0.0), (make_scene.FRAMES, 2.0)):  # it comes to no place twice
            rig.location.z = z
            rig.keyframe_insert("location", frame=frame)
        rig.data.bones.active = rig.data.bones["Hand"]
        finished(bpy.ops.foretouch.sweep, of_bone=True)
        (sweep,) = [thing for thing in bpy.data.objects if thing.get("foretouch") == "sweep"]
        surface = triangles_of(sweep.data)[0]
        mesh = bpy.data.objects["Arm"]
        asked = 0
        for frame in range(1, make_scene.FRAMES + 1):
            scene.frame_set(frame)
            evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
            for vertex in evaluated.data.vertices:
                if mesh.data.vertices[vertex.index].co.x > 0.7:  # moved by the hand alone
                    asked += 1
                    place = np.array(evaluated.matrix_world @ vertex.co)
                    self.assertGreater(windings(surface, place), 0.5, f"{frame}: {place}")
        self.assertGreater(asked, 300)
        self.assertAlmostEqual(windings(surface, np.array([-1.0, 0.0, 1.0])), 0.0, places=3)

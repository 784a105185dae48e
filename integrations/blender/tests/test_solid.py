"""The solid action, judged by distances of points beside the capsules that Blender moves."""

import unittest

import bpy
import numpy as np
from blend import drained, example, finished

import make_scene
from foretouch_blender.axes import frames_of
from foretouch_blender.operators import following
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


class Sweep(unittest.TestCase):
    def test_holds_every_vertex_of_the_hand_at_every_frame(self):
        scene, rig = example()
        rig.data.bones.active = rig.data.bones["Hand"]
        finished(bpy.ops.foretouch.sweep, of_bone=True)
        from mathutils.bvhtree import BVHTree
        (sweep,) = [thing for thing in bpy.data.objects if thing.get("foretouch") == "sweep"]
        tree = BVHTree.FromPolygons([v.co for v in sweep.data.vertices], [p.vertices for p in sweep.data.polygons])
        mesh = bpy.data.objects["Arm"]
        asked = 0
        for frame in range(1, make_scene.FRAMES + 1):
            scene.frame_set(frame)
            evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
            for vertex in evaluated.data.vertices:
                if mesh.data.vertices[vertex.index].co.x > 0.7:
                    asked += 1
                    self.assertTrue(inside(tree, evaluated.matrix_world @ vertex.co))
        self.assertGreater(asked, 300)


def inside(tree, point):
    """The surface may pass through itself, and holds what it winds around: more faces lead out than in."""
    from mathutils import Vector
    winds = []
    for direction in (Vector((0.12, 0.31, 1)), Vector((1, -0.23, 0.17)), Vector((-0.37, 1, 0.41))):
        wound, start, direction = 0, point.copy(), direction.normalized()
        while True:
            place, normal, _, _ = tree.ray_cast(start, direction)
            if place is None:
                break
            wound += 1 if normal.dot(direction) > 0 else -1
            start = place + 1e-6 * direction
        winds.append(wound)
    return sorted(winds)[1] >= 1

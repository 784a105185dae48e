"""Touches where they are known by hand: a ball on a straight way through a board."""

import math
import unittest

import bpy
import numpy as np
from blend import drained, example, finished, fresh, touches
from mathutils.bvhtree import BVHTree

import make_scene
from foretouch_blender.axes import Axes, frames_of
from foretouch_blender.rig import triangles_of
from foretouch_blender.sampled import sampling

RADIUS, SPEED, HALF = 0.1, 0.05, 0.01  # Blender units, and per frame
TOLERANCE = 1e-3


def ball(scene, where=(0.0, 0.0, 0.0)):
    """One bone at the middle of a fine sphere."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("Ball")
    bone.head, bone.tail = where, (where[0], where[1], where[2] + 0.3)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.data.meshes.new("Ball")
    rings, sides = 48, 48
    points = [(RADIUS * math.sin(math.pi * r / rings) * math.cos(2 * math.pi * s / sides),
               RADIUS * math.sin(math.pi * r / rings) * math.sin(2 * math.pi * s / sides),
               RADIUS * math.cos(math.pi * r / rings)) for r in range(rings + 1) for s in range(sides)]
    mesh.from_pydata(points, [], [(r * sides + s, r * sides + (s + 1) % sides, (r + 1) * sides + (s + 1) % sides,
                                   (r + 1) * sides + s) for r in range(rings) for s in range(sides)])
    thing = bpy.data.objects.new("Ball", mesh)
    scene.collection.objects.link(thing)
    thing.parent = rig
    thing.modifiers.new("Armature", "ARMATURE").object = rig
    thing.vertex_groups.new(name="Ball").add(range(len(points)), 1.0, "REPLACE")
    return rig


def straight(thing, path, begin, end, last):
    """Linear keys at frame 0 and at the last one."""
    target, prop = path
    for frame, value in ((0, begin), (last, end)):
        setattr(target, prop, value)
        target.keyframe_insert(prop, frame=frame)
    for curve in thing.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def board(scene, place=(0.0, 0.0, 0.0)):
    room = bpy.data.collections.new("Room")
    scene.collection.children.link(room)
    return make_scene.box("Board", (2 * HALF, 3.0, 3.0), place, room), room


class BallThroughBoard(unittest.TestCase):
    """It moves along X by 0.05 a frame from -1.013; the board's face is at -0.01."""

    BEGIN, LAST = -1.013, 40
    ENTER = (-HALF - RADIUS - BEGIN) / SPEED
    LEAVE = (HALF + RADIUS - BEGIN) / SPEED

    def scene(self, unit=1.0):
        scene = fresh()
        scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", unit
        rig = ball(scene)
        thing, room = board(scene)
        asked = scene.foretouch
        asked.body, asked.against, asked.tolerance = rig, room, TOLERANCE * unit
        return scene, rig, thing

    def judge(self, scene, unit=1.0, slack=0.0):
        """Sound: never late. Tight: not before it is within the tolerance. The fitted capsule holds the
        sphere, and is hardly larger."""
        (found,) = scene.foretouch.touches
        self.assertEqual((found.link, found.object), ("Ball", "Board"))
        early = (TOLERANCE + 1e-4) / SPEED + slack
        self.assertLessEqual(found.begin, self.ENTER + 1e-4)
        self.assertGreaterEqual(found.begin, self.ENTER - early)
        self.assertGreaterEqual(found.end, self.LEAVE - 1e-4)
        self.assertLessEqual(found.end, self.LEAVE + 2 * early)
        seconds = scene.render.fps_base / scene.render.fps
        self.assertAlmostEqual(found.approach, SPEED * unit / seconds, delta=1e-3 * unit / seconds)
        self.assertAlmostEqual(found.empty.location.x, -HALF, delta=2e-5)
        normal = found.empty.rotation_euler.to_matrix().col[2]
        self.assertAlmostEqual(normal.x, -1.0, delta=1e-4)

    def test_by_its_bone(self):
        scene, rig, _ = self.scene()
        bone = rig.pose.bones["Ball"]
        # The bone's own Y is the world's Z; its X is the world's X.
        straight(rig, (bone, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        self.judge(scene)
        self.assertEqual([(m.name, m.frame) for m in scene.timeline_markers], [("Ball: Board", int(self.ENTER))])

    def test_by_the_armature_object(self):
        scene, rig, _ = self.scene()
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        self.judge(scene)

    def test_in_centimetres(self):
        scene, rig, _ = self.scene(unit=0.01)
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        self.judge(scene, unit=0.01)

    def test_of_a_scaled_armature(self):
        """Twice as large, at half the size in its data: the same ball."""
        scene, rig, _ = self.scene()
        mesh = bpy.data.objects["Ball"].data
        for vertex in mesh.vertices:
            vertex.co *= 0.5
        rig.scale = (2, 2, 2)
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        self.judge(scene)
        self.assertEqual(scene.foretouch.notes, "")

    def test_where_the_board_moves_and_the_ball_rests(self):
        scene, rig, thing = self.scene()
        bone = rig.pose.bones["Ball"]
        straight(rig, (bone, "location"), (0, 0, 0), (0, 0, 0), self.LAST)
        straight(thing, (thing, "location"), (-self.BEGIN, 0, 0), (-self.BEGIN - SPEED * self.LAST, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        (found,) = scene.foretouch.touches
        self.assertLessEqual(found.begin, self.ENTER + 1e-4)
        self.assertGreaterEqual(found.begin, self.ENTER - (TOLERANCE + 1e-4) / SPEED)
        self.assertAlmostEqual(found.empty.location.x, RADIUS, delta=2e-3)
        self.assertAlmostEqual(found.empty.rotation_euler.to_matrix().col[2].x, -1.0, delta=1e-4)

    def test_against_a_collection_instance(self):
        scene, rig, thing = self.scene()
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        source = bpy.data.collections.new("Source")
        scene.foretouch.against.objects.unlink(thing)
        source.objects.link(thing)
        instance = bpy.data.objects.new("Instance", None)
        instance.instance_type, instance.instance_collection = "COLLECTION", source
        scene.foretouch.against.objects.link(instance)
        finished(bpy.ops.foretouch.check)
        (found,) = scene.foretouch.touches
        self.assertEqual(found.object, "Instance: Board")
        self.assertLessEqual(found.begin, self.ENTER + 1e-4)
        self.assertGreaterEqual(found.begin, self.ENTER - (TOLERANCE + 1e-4) / SPEED)

    def test_by_its_envelope(self):
        scene, rig, _ = self.scene()
        bpy.data.objects.remove(bpy.data.objects["Ball"])
        rig.data.bones["Ball"].head_radius = rig.data.bones["Ball"].tail_radius = RADIUS
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        scene.foretouch.body_from = "ENVELOPES"
        finished(bpy.ops.foretouch.check)
        self.judge(scene)

    def test_that_starts_inside_goes_on_until_the_last_frame(self):
        scene, rig, _ = self.scene()
        straight(rig, (rig, "location"), (0, 0, 0), (0.05, 0, 0), self.LAST)
        finished(bpy.ops.foretouch.check)
        (found,) = scene.foretouch.touches
        self.assertTrue(found.begins_inside and found.is_open)
        self.assertEqual((found.begin, found.end), (0.0, float(self.LAST)))

    def test_of_frames_that_were_asked_alone(self):
        scene, rig, _ = self.scene()
        straight(rig, (rig, "location"), (self.BEGIN, 0, 0), (self.BEGIN + SPEED * self.LAST, 0, 0), self.LAST)
        scene.foretouch.frames, scene.frame_start, scene.frame_end = "SCENE", 0, int(self.ENTER)
        finished(bpy.ops.foretouch.check)
        self.assertEqual(touches(scene), [])


def tree_of(name):
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = bpy.data.objects[name].evaluated_get(graph)
    mesh = evaluated.to_mesh()
    points = [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
    faces = [tuple(face.vertices) for face in mesh.polygons]
    evaluated.to_mesh_clear()
    return BVHTree.FromPolygons(points, faces)


def distance(point, a, b):
    """Of a point to a segment."""
    along = np.clip(np.dot(point - a, b - a) / max(np.dot(b - a, b - a), 1e-300), 0.0, 1.0)
    return np.linalg.norm(point - a - along * (b - a))


class SkinnedArm(unittest.TestCase):
    def test_a_look_at_each_frame_sees_nothing_of_what_is_found(self):
        scene, _ = example()
        finished(bpy.ops.foretouch.check)
        self.assertEqual([t[:2] for t in touches(scene)], 2 * [("Fore", "Board"), ("Hand", "Board")])
        for frame in range(1, make_scene.FRAMES + 1):
            scene.frame_set(frame)
            self.assertEqual(tree_of("Arm").overlap(tree_of("Board")), [], f"at frame {frame}")

    def test_every_face_at_rest_is_in_a_capsule(self):
        scene, rig = example()
        body = drained(sampling(bpy.context)).body
        capsules = [(frame[:3, :3] @ each.a + frame[:3, 3], frame[:3, :3] @ each.b + frame[:3, 3], each.radius)
                    for frame, link in zip(body.rest, body.avatar.lss) for each in link]
        self.assertEqual(body.avatar.names, list(make_scene.ARM))
        corners = triangles_of(bpy.data.objects["Arm"].data)[0]
        for triangle in Axes(1.0).points(corners):
            outside = min(max(distance(corner, a, b) - radius for corner in triangle)
                          for a, b, radius in capsules)
            self.assertLessEqual(outside, 1e-6)


class Stretched(unittest.TestCase):
    """Whatever scale a rig has: where one bone alone moves vertices, Blender has them in its capsules."""

    def outermost(self, scene):
        """How far the farthest such vertex is outside, over all frames."""
        sampled = drained(sampling(bpy.context))
        avatar, mesh = sampled.body.avatar, bpy.data.objects["Arm"]
        hand = avatar.link("Hand")
        worst = -1.0
        for k, frame in enumerate(sampled.frames.instants):
            scene.frame_set(int(frame))
            evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
            place = frames_of(*sampled.pose(k), avatar.parents)[hand]
            ends = [(place[:3, :3] @ each.a + place[:3, 3], place[:3, :3] @ each.b + place[:3, 3], each.radius)
                    for each in avatar.lss[hand]]
            for vertex in evaluated.data.vertices:
                if mesh.data.vertices[vertex.index].co.x > 0.7:
                    point = sampled.axes.points(evaluated.matrix_world @ vertex.co)
                    worst = max(worst, min(distance(point, a, b) - radius for a, b, radius in ends))
        return worst

    def test_evenly(self):
        scene, rig = example()
        rig.scale = (2.0, 2.0, 2.0)
        self.assertLess(abs(self.outermost(scene)), 2e-6)

    def test_unevenly(self):
        for scale in ((1.0, 1.1, 1.0), (0.8, 1.0, 1.2)):
            scene, rig = example()
            rig.scale = scale
            self.assertLess(self.outermost(scene), 2e-6)

    def test_by_a_bone(self):
        for scale in ((1.0, 1.2, 1.0), (1.3, 1.0, 1.0), (0.7, 0.7, 0.7)):
            scene, rig = example()
            rig.pose.bones["Hand"].scale = scale
            self.assertLess(self.outermost(scene), 2e-6)

    def test_while_the_rig_lies_somewhere_else(self):
        scene, rig = example()
        rig.location, rig.rotation_euler = (3.0, -1.0, 2.0), (0.3, 0.5, -1.0)
        rig.scale = (1.0, 1.1, 1.0)
        scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", 0.1
        self.assertLess(self.outermost(scene), 2e-6)


class HeldThing(unittest.TestCase):
    def test_on_a_bone_is_part_of_the_body(self):
        """A stick in the hand meets the board, which the hand itself goes past."""
        scene, rig = example()
        bpy.data.objects["Board"].location.x = 0.98
        finished(bpy.ops.foretouch.check)
        self.assertEqual(touches(scene), [])
        stick = make_scene.box("Stick", (0.02, 0.3, 0.02), (0.0, 0.15, 0.0), scene.collection)
        stick.parent, stick.parent_type, stick.parent_bone = rig, "BONE", "Hand"
        finished(bpy.ops.foretouch.check)
        self.assertEqual({t[:2] for t in touches(scene)}, {("Hand", "Board")})
        bpy.context.view_layer.update()
        # Where Blender has the stick: from the hand's tail on, along +X at rest.
        scene.frame_set(4)
        self.assertTrue(all(self.is_in_a_capsule(stick, scene)))

    def is_in_a_capsule(self, stick, scene):
        sampled = drained(sampling(bpy.context))
        frames = frames_of(*sampled.pose(scene.frame_current - sampled.frames.first), sampled.body.avatar.parents)
        hand = sampled.body.avatar.link("Hand")
        graph = bpy.context.evaluated_depsgraph_get()
        world = stick.evaluated_get(graph).matrix_world
        for vertex in stick.data.vertices:
            point = Axes(1.0).points(world @ vertex.co)
            yield min(distance(point, frames[hand][:3, :3] @ each.a + frames[hand][:3, 3],
                               frames[hand][:3, :3] @ each.b + frames[hand][:3, 3]) - each.radius
                      for each in sampled.body.avatar.lss[hand]) < 1e-5

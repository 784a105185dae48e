"""Touches where they are known by hand: a ball on a straight way through a board."""

import math
import unittest

import bpy
from blend import example, finished, fresh, touches

import make_scene

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


class SkinnedArm(unittest.TestCase):
    def test_poses_of_frames_alone_see_nothing_of_what_is_found(self):
        """The example's board is so thin that the arm is in it at no frame."""
        scene, rig = example()
        finished(bpy.ops.foretouch.check)
        self.assertEqual([t[:2] for t in touches(scene)], 2 * [("Fore", "Board"), ("Hand", "Board")])
        mesh = bpy.data.objects["Arm"]
        for frame in range(1, 25):
            scene.frame_set(frame)
            evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
            ys = [(evaluated.matrix_world @ vertex.co).y for vertex in evaluated.data.vertices
                  if vertex.co.x > 0.5]
            print(frame, min(ys), max(ys)) if ys else None

    def test_every_face_is_in_a_capsule_of_its_bone(self):
        """Judged by distances of points, beside the bones as Blender moves them."""


if __name__ == "__main__":
    unittest.main()

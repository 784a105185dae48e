"""Makes the example: a figure swings its arm through a thin board. blender -b --python make_scene.py -- FILE.blend

The same scene is what the tests begin with; nothing in it is drawn by hand.
"""

import math
import sys

import bpy

ARM = ("Shoulder", "Fore", "Hand")
LENGTHS = (0.30, 0.28, 0.18)


def box(name, size, place, collection):
    """Its sides in Blender units, centred at a place."""
    x, y, z = (side / 2 for side in size)
    corners = [(sx * x, sy * y, sz * z) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    thing = bpy.data.objects.new(name, mesh)
    thing.location = place
    collection.objects.link(thing)
    return thing


def armature(scene, name="Rig"):
    """An arm along +X, 1 m above the ground."""
    rig = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    at, parent = 0.0, None
    for bone_name, length in zip(ARM, LENGTHS):
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail = (at, 0.0, 1.0), (at + length, 0.0, 1.0)
        bone.parent, bone.use_connect = parent, parent is not None
        at, parent = at + length, bone
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig


def skin(scene, rig, name="Arm"):
    """A tube of 8 sides about the bones, weighted to them, softly at the joints."""
    rings, sides, radius = 24, 8, 0.045
    whole = sum(LENGTHS)
    points, faces = [], []
    for ring in range(rings + 1):
        x = whole * ring / rings
        points += [(x, radius * math.cos(2 * math.pi * s / sides), 1.0 + radius * math.sin(2 * math.pi * s / sides))
                   for s in range(sides)]
    for ring in range(rings):
        for s in range(sides):
            a, b = ring * sides + s, ring * sides + (s + 1) % sides
            faces.append((a, b, b + sides, a + sides))
    faces += [tuple(reversed(range(sides))), tuple(rings * sides + s for s in range(sides))]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    thing = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(thing)
    thing.parent = rig
    thing.modifiers.new("Armature", "ARMATURE").object = rig
    _weight(thing, points)
    return thing


def _weight(thing, points):
    middles = [sum(LENGTHS[:k]) + LENGTHS[k] / 2 for k in range(len(ARM))]
    groups = [thing.vertex_groups.new(name=name) for name in ARM]
    for number, (x, _, _) in enumerate(points):
        weights = [max(0.0, 1.0 - abs(x - middle) / (0.6 * length)) for middle, length in zip(middles, LENGTHS)]
        if not any(weights):
            weights[0 if x < middles[0] else -1] = 1.0
        for group, weight in zip(groups, weights):
            if weight > 0.0:
                group.add([number], weight, "REPLACE")


FRAMES = 23


def swing(rig, name="Swing"):
    """The arm turns about the vertical by 100 degrees and comes back; keys at three frames. It is
    straight between two frames, so that no frame has it in the board."""
    for bone in rig.pose.bones:
        bone.rotation_mode = "QUATERNION"
    rig.animation_data_create().action = bpy.data.actions.new(name)
    bone = rig.pose.bones["Shoulder"]
    for frame, degrees in ((1, -50), ((1 + FRAMES) // 2, 50), (FRAMES, -50)):
        half = math.radians(degrees) / 2
        bone.rotation_quaternion = (math.cos(half), 0.0, 0.0, math.sin(half))
        bone.keyframe_insert("rotation_quaternion", frame=frame)


def make(scene=None):
    """The whole scene, in the present file. Returns the armature."""
    scene = scene or bpy.context.scene
    for thing in list(scene.objects):
        bpy.data.objects.remove(thing)
    rig = armature(scene)
    skin(scene, rig)
    swing(rig)
    room = bpy.data.collections.new("Room")
    scene.collection.children.link(room)
    box("Board", (0.30, 0.004, 0.60), (0.66, 0.0, 1.0), room)
    box("Floor", (4.0, 4.0, 0.1), (0.0, 0.0, -0.05), room)
    scene.frame_start, scene.frame_end = 1, FRAMES
    if hasattr(scene, "foretouch"):
        scene.foretouch.body, scene.foretouch.against = rig, room
    return rig


if __name__ == "__main__":
    import os
    sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    import addon_utils
    addon_utils.enable("foretouch_blender")
    make()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(sys.argv[sys.argv.index("--") + 1]))

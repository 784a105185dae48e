"""What the add-on leaves in a file: standard data alone, each marked as its own, so that it can all be
found again and removed."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

from .capsules import mesh_around, placed_along

MARK = "foretouch"
"""The custom property of all that the add-on made."""
TOUCH, SWEEP, CAPSULE, FOLDER = "touch", "sweep", "capsule", "folder"


def show(scene, touches, axes):
    """Markers on the timeline and empties at the contact points. Returns the empties."""
    _mark_timeline(scene, touches)
    return [_empty(scene, touch, axes) if touch.is_known else None for touch in touches]


def clear_touches(scene):
    scene.foretouch.touches.clear()
    for marker in [marker for marker in scene.timeline_markers if marker.get(MARK)]:
        scene.timeline_markers.remove(marker)
    _remove(scene, TOUCH)


def clear(scene):
    """Everything, but the actions that were made solid."""
    clear_touches(scene)
    _remove(scene, SWEEP)
    _remove(scene, CAPSULE)
    folder = _folder(scene)
    if folder is not None and not folder.objects:
        bpy.data.collections.remove(folder)
    scene.foretouch.notes = ""


def add_sweep(scene, name, swept, axes):
    """The object of a foretouch.SweptSurface."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(axes.points_back(swept.vertices).tolist(), [], swept.triangles.tolist())
    thing = bpy.data.objects.new(name, mesh)
    thing[MARK] = SWEEP
    thing.color = (1.0, 0.55, 0.1, 0.5)
    _make_folder(scene).objects.link(thing)
    return thing


def add_capsules(scene, rig, capsules):
    """An object for each of capsules.capsules_of(); those of before are replaced. Returns them."""
    _remove(scene, CAPSULE)
    added = []
    for name, bone, ends, radius in capsules:
        length = float(np.linalg.norm(ends[1] - ends[0]))
        thing = bpy.data.objects.new(name, mesh_around(name, length, radius))
        thing[MARK], thing["radius"], thing["length"] = CAPSULE, float(radius), length
        thing.parent = rig
        if bone is not None:
            thing.parent_type, thing.parent_bone = "BONE", bone.name
        thing.matrix_basis = Matrix(placed_along(ends))
        thing.display_type = "WIRE"
        thing.hide_render = True
        _make_folder(scene).objects.link(thing)
        added.append(thing)
    return added


def _mark_timeline(scene, touches):
    """One marker per frame: that at which, or before which, the touch begins."""
    by_frame = {}
    for touch in touches:
        by_frame.setdefault(touch.begin.whole, []).append(touch)
    for frame, those in by_frame.items():
        others = f" +{len(those) - 1}" if len(those) > 1 else ""
        marker = scene.timeline_markers.new(f"{those[0].link}: {those[0].object}{others}", frame=frame)
        marker[MARK] = TOUCH


def _empty(scene, touch, axes):
    """Its Z axis is the normal, from the object to the body."""
    empty = bpy.data.objects.new(f"{touch.link}: {touch.object}", None)
    empty[MARK] = TOUCH
    empty["frame"], empty["link"], empty["object"] = touch.begin.frame, touch.link, touch.object
    empty.empty_display_type = "SINGLE_ARROW"
    empty.empty_display_size = 0.1 / axes.unit
    empty.show_in_front = True
    empty.location = axes.points_back(touch.point)
    normal = Vector(axes.directions_back(touch.normal))
    if normal.length > 0.0:
        empty.rotation_euler = normal.to_track_quat("Z", "Y").to_euler()
    _make_folder(scene).objects.link(empty)
    return empty


def _folder(scene):
    return next((child for child in scene.collection.children if child.get(MARK) == FOLDER), None)


def _make_folder(scene):
    folder = _folder(scene)
    if folder is None:
        folder = bpy.data.collections.new("Foretouch")
        folder[MARK] = FOLDER
        scene.collection.children.link(folder)
    return folder


def _remove(scene, kind):
    folder = _folder(scene)
    for thing in [] if folder is None else [t for t in folder.objects if t.get(MARK) == kind]:
        mesh = thing.data
        bpy.data.objects.remove(thing)
        if mesh is not None and mesh.users == 0:
            bpy.data.meshes.remove(mesh)

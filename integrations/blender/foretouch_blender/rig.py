"""A rig at rest: its bones as links, and which triangles of its meshes each of them moves."""

from typing import NamedTuple

import bpy
import numpy as np

from .axes import nearest_rotations, rigid_frames
from .told import Told

FOLLOWED_PARENTS = {"ARMATURE", "OBJECT", "BONE"}
RESHAPING = {"CLOTH", "SOFT_BODY", "LATTICE", "MESH_DEFORM", "SURFACE_DEFORM", "HOOK", "SHRINKWRAP",
             "MESH_CACHE", "MESH_SEQUENCE_CACHE", "WAVE", "OCEAN", "NODES", "LAPLACIANDEFORM"}
"""Modifiers by which a mesh may change with time in a way that its bones do not tell."""


class Links(NamedTuple):
    """What may become links: bones, and meshes that move with the armature as a whole."""

    names: list
    parents: list
    """Number of the parent; -1: none."""
    bones: list
    """Number of the armature's bone; -1: moves with the armature object."""
    rest: np.ndarray
    """(n, 4, 4), rigid, metres, y up; the armature's own place does not count."""
    triangles: list
    """Of each (m, 3, 3), in its frame; or None."""
    notes: list


def armature_of(scene):
    """The object that is checked, or Told."""
    rig = scene.foretouch.body
    if rig is None or rig.name not in scene.objects:
        raise Told("Choose an armature of this scene as the body")
    if rig.mode == "EDIT":
        raise Told(f"'{rig.name}' is in Edit Mode: leave it (Tab)")
    if rig.hide_viewport:
        raise Told(f"'{rig.name}' is disabled in viewports, so Blender does not move it: enable it "
                   "in the Outliner")
    if rig.data.pose_position == "REST":
        raise Told(f"'{rig.name}' shows its rest position: choose Pose Position among the properties "
                   "of the armature")
    return rig


def rest_stretch(world):
    """(3, 3), what is left of the armature object's matrix without its rotation: its scale."""
    linear = np.array(world)[:3, :3]
    if not np.all(np.isfinite(linear)) or abs(np.linalg.det(linear)) < 1e-12:
        raise Told("The armature object has a scale of 0: apply another one (Ctrl A, Scale)")
    return nearest_rotations(linear).T @ linear


def links_of(rig, scene, axes, stretch, with_meshes=True):
    bones = list(rig.data.bones)
    number = {bone.name: k for k, bone in enumerate(bones)}
    names = [bone.name for bone in bones]
    parents = [number[bone.parent.name] if bone.parent else -1 for bone in bones]
    rest = np.array([bone.matrix_local for bone in bones], dtype=np.float64).reshape(-1, 4, 4)
    linear, places = stretch @ rest[:, :3, :3], rest[:, :3, 3] @ stretch.T
    frames = axes.frames(rigid_frames(nearest_rotations(linear), places))
    found = Links(names, parents, list(range(len(bones))), frames, [None] * len(bones), [])
    if with_meshes:
        found = _with_meshes(found, rig, scene, axes, stretch)
    return found


def meshes_of(rig, scene):
    """Those that move with the armature, shown ones alone."""
    found = []
    for thing in scene.objects:
        if thing.type != "MESH" or not thing.visible_get() or "foretouch" in thing:
            continue
        if thing.parent == rig or _armature_modifiers(thing, rig):
            found.append(thing)
    return found


def _armature_modifiers(thing, rig):
    return [m for m in thing.modifiers if m.type == "ARMATURE" and m.object == rig and m.show_viewport]


def _with_meshes(links, rig, scene, axes, stretch):
    meshes = meshes_of(rig, scene)
    if not meshes:
        raise Told(f"No shown mesh moves with '{rig.name}': parent one to it (Ctrl P, Armature Deform), "
                   "or choose another body: bone envelopes, or an avatar file")
    pieces = [[] for _ in links.names]
    for mesh in meshes:
        corners, owner = _owned_triangles(mesh, rig, links)
        owner = owner[np.isfinite(corners).all(axis=(1, 2))]
        corners = finite(corners, mesh.name, links.notes)
        if len(corners) == 0:
            links.notes.append(f"'{mesh.name}' has no faces: it touches nothing")
            continue
        if np.any(owner < 0):
            links = _with_whole(links, mesh)
            pieces.append([])
            owner = np.where(owner < 0, len(links.names) - 1, owner)
        for link in np.unique(owner):
            placed = corners[owner == link] @ stretch.T
            inverse = np.linalg.inv(links.rest[link])
            pieces[link].append(near(axes.points(placed), mesh.name) @ inverse[:3, :3].T + inverse[:3, 3])
    triangles = [np.concatenate(piece) if piece else None for piece in pieces]
    if not any(piece is not None for piece in triangles):
        raise Told(f"The meshes of '{rig.name}' have no faces: there is nothing that could touch")
    return links._replace(triangles=triangles)


MOST_M = 1e7
"""Metres: no coordinate of Foretouch's is larger."""


def near(points, name):
    """Metres; Told where they are too far away."""
    if len(points) and np.abs(points).max() > MOST_M:
        raise Told(f"'{name}' has a vertex farther than 10,000 km away: remove it, or mind the unit scale")
    return points


def finite(corners, name, notes):
    """Without triangles that have a corner which is no number."""
    good = np.isfinite(corners).all(axis=(1, 2))
    if not good.all():
        notes.append(f"{np.sum(~good)} faces of '{name}' have vertices that are no numbers: left out")
    return corners[good]


def _with_whole(links, mesh):
    """One link more, for what no bone moves."""
    links.notes.append(f"Some faces of '{mesh.name}' have no weights of deforming bones: they move "
                       "with the armature object")
    return links._replace(names=[*links.names, f"{mesh.name} (no bone)"], parents=[*links.parents, -1],
                          bones=[*links.bones, -1],
                          rest=np.concatenate([links.rest, np.eye(4)[None]]))


def _owned_triangles(thing, rig, links):
    """Corners (m, 3, 3) in the armature's space at rest; the number of the link that each triangle
    moves with; -1: none."""
    modifiers = _armature_modifiers(thing, rig)
    by_bone = thing.parent == rig and thing.parent_type == "BONE"
    to_rig = _place_in_rig(thing, rig, by_bone)
    _note_other_changes(thing, links.notes)
    copy = thing.copy()
    scratch = bpy.data.scenes.new("Foretouch")
    try:
        copy.parent = None
        copy.animation_data_clear()
        copy.constraints.clear()
        copy.matrix_world = thing.matrix_world
        for modifier in [m for m in copy.modifiers if m.type == "ARMATURE"]:
            copy.modifiers.remove(modifier)
        scratch.collection.objects.link(copy)
        layer = scratch.view_layers[0]
        layer.update()
        evaluated = copy.evaluated_get(layer.depsgraph)
        mesh = evaluated.to_mesh()
        corners, vertices = triangles_of(mesh)
        if by_bone:
            owner = np.full(len(corners), links.names.index(thing.parent_bone))
        elif modifiers or thing.parent_type == "ARMATURE":
            owner = _owners(mesh, thing, rig, links, vertices)
        else:
            owner = np.full(len(corners), -1)
        evaluated.to_mesh_clear()
    finally:
        bpy.data.scenes.remove(scratch)
        bpy.data.objects.remove(copy)
    return corners @ to_rig[:3, :3].T + to_rig[:3, 3], owner


def triangles_of(mesh):
    """Corners (m, 3, 3) as doubles, and the numbers of the vertices (m, 3)."""
    mesh.calc_loop_triangles()
    points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", points)
    numbers = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", numbers)
    numbers = numbers.reshape(-1, 3)
    return points.reshape(-1, 3).astype(np.float64)[numbers], numbers


def _owners(mesh, thing, rig, links, vertices):
    """Of each triangle the bone with the largest sum of weights, of several the first."""
    link_of_group = {}
    for group in thing.vertex_groups:
        bone = rig.data.bones.get(group.name)
        if bone is not None and bone.use_deform:
            link_of_group[group.index] = links.names.index(group.name)
    used = sorted(set(link_of_group.values()))
    column = {link: k for k, link in enumerate(used)}
    weights = np.zeros((len(mesh.vertices), len(used) + 1))
    for vertex in mesh.vertices:
        for element in vertex.groups:
            link = link_of_group.get(element.group)
            if link is not None and element.weight > 0.0:
                weights[vertex.index, column[link]] += element.weight
    total = weights.sum(axis=1)
    weights[total == 0.0, -1] = 1.0
    weights /= np.where(total == 0.0, 1.0, total)[:, None]
    return np.array([*used, -1])[np.argmax(weights[vertices].sum(axis=1), axis=1)]


def _place_in_rig(thing, rig, by_bone):
    """(4, 4), from the mesh's space to the armature's at rest; Told where it changes with time."""
    own = np.array(thing.matrix_parent_inverse @ thing.matrix_basis)
    moves = thing.constraints or (thing.animation_data and (
        thing.animation_data.action or thing.animation_data.drivers or thing.animation_data.nla_tracks))
    if thing.parent == rig and thing.parent_type in FOLLOWED_PARENTS and not moves:
        if not by_bone:
            return own
        bone = rig.data.bones[thing.parent_bone]
        if bone.use_relative_parent:
            raise Told(f"'{thing.name}' hangs on bone '{bone.name}' by Relative Parenting, which is not "
                       "followed: turn it off")
        at_tail = np.eye(4)
        at_tail[1, 3] = bone.length
        return np.array(bone.matrix_local) @ at_tail @ own
    if thing.parent is None and not moves and not _may_move(rig):
        return np.array(rig.matrix_world.inverted() @ thing.matrix_world)
    raise Told(f"'{thing.name}' does not move with '{rig.name}' alone: parent it to the armature "
               "(Ctrl P, Object) and give it no motion of its own")


def _may_move(thing):
    data = thing.animation_data
    moves = data and (data.drivers or data.nla_tracks or (data.action and any(
        not curve.data_path.startswith("pose.") for curve in curves_of(data.action))))
    return bool(thing.parent or thing.constraints or moves)


def _note_other_changes(thing, notes):
    others = sorted({m.name for m in thing.modifiers if m.type in RESHAPING and m.show_viewport})
    if others:
        notes.append(f"Modifiers of '{thing.name}' are taken as at this frame: {', '.join(others)}")
    if thing.data.shape_keys and len(thing.data.shape_keys.key_blocks) > 1:
        notes.append(f"Shape keys of '{thing.name}' are taken as at this frame")


def curves_of(action):
    """The F-curves of an action, also of one that has layers (Blender 4.4 and later)."""
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]

"""What the body may touch: the chosen objects, as triangles in Foretouch's world."""

from typing import NamedTuple

import numpy as np

from .rig import finite, meshes_of, near, triangles_of
from .told import Told

SOLID_TYPES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}


class Obstacle(NamedTuple):
    name: str
    thing: object
    triangles: np.ndarray
    """(m, 3, 3), in Blender's world at the frame at which it was read."""
    world: np.ndarray
    """(4, 4), of the object then."""


def chosen(scene, context, notes):
    """The shown objects to check against, without the body's own; Told if there are none. Blender does
    not keep hidden ones up to date."""
    rig, collection = scene.foretouch.body, scene.foretouch.against
    own = {rig, *meshes_of(rig, scene)}
    things = collection.all_objects if collection else context.selected_objects
    named = [thing for thing in things if thing not in own and "foretouch" not in thing
             and (thing.type in SOLID_TYPES or _instances(thing))]
    found = [thing for thing in named if thing.visible_get()]
    notes += [f"'{thing.name}' is hidden: it is left out" for thing in named if thing not in found]
    if not found:
        raise Told(f"The collection '{collection.name}' has no shown objects with faces" if collection
                   else "Choose what to check against: a collection, or select objects")
    return sorted(found, key=lambda thing: thing.name_full)


def read(things, notes):
    """The triangles of things, each as a dependency graph has it. Told where none has any."""
    found = [obstacle for thing, graph in things for obstacle in _read_one(thing, graph, notes)]
    if not found:
        raise Told("None of the chosen objects has faces: there is nothing to touch")
    return found


def still_scene(ft, obstacles, axes):
    """A foretouch.Scene of them; None if there are none."""
    if not obstacles:
        return None
    corners = np.concatenate([near(axes.points(obstacle.triangles), obstacle.name) for obstacle in obstacles])
    counts = [len(obstacle.triangles) for obstacle in obstacles]
    return ft.Scene.from_arrays(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3),
                                np.repeat(np.arange(len(counts), dtype=np.int32), counts),
                                [obstacle.name for obstacle in obstacles])


def may_move(thing):
    """Whether anything could move it; conservative: what has a parent may."""
    data = thing.animation_data
    return bool(thing.parent or thing.constraints or thing.rigid_body
                or (data and (data.action or data.drivers or data.nla_tracks)))


SHAPE_KEEPING = {"SUBSURF", "MULTIRES", "BEVEL", "SOLIDIFY", "TRIANGULATE", "EDGE_SPLIT", "WELD",
                 "WEIGHTED_NORMAL", "NORMAL_EDIT", "DECIMATE", "REMESH", "WIREFRAME", "SKIN"}


def may_reshape(thing):
    """Whether its shape could change with time; conservative."""
    data, shape = thing.animation_data, thing.data
    keys = getattr(shape, "shape_keys", None)
    animated = [each for each in (shape, keys) if each is not None and each.animation_data]
    others = [m for m in thing.modifiers if m.type not in SHAPE_KEEPING]
    return bool(animated or others or (data and thing.modifiers) or thing.type == "META"
                or getattr(shape, "bevel_object", None) or getattr(shape, "taper_object", None))


def corners_of(evaluated):
    """(m, 3, 3), in the object's space."""
    mesh = evaluated.to_mesh()
    corners = triangles_of(mesh)[0] if mesh is not None else np.empty((0, 3, 3))
    evaluated.to_mesh_clear()
    return corners


def _instances(thing):
    return thing.instance_type == "COLLECTION" and thing.instance_collection is not None


def _read_one(thing, graph, notes):
    found = []
    if thing.type in SOLID_TYPES:
        evaluated = thing.evaluated_get(graph)
        found.append((thing.name, corners_of(evaluated), np.array(evaluated.matrix_world)))
    if _instances(thing):
        moving = [part for part in thing.instance_collection.all_objects
                  if may_move(part) and part.type in SOLID_TYPES]
        if moving:
            raise Told(f"'{moving[0].name}' may move inside of the collection instance '{thing.name}': "
                       "make the instances real (Object, Apply)")
        for each in graph.object_instances:  # what it yields lives until the next one only
            if each.is_instance and each.parent.original == thing and each.object.type in SOLID_TYPES:
                found.append((f"{thing.name}: {each.object.name}", corners_of(each.object),
                              np.array(each.matrix_world)))
    found = [(name, finite(corners, name, notes), world) for name, corners, world in found]
    notes += [f"'{name}' has no faces: nothing can touch it" for name, corners, _ in found
              if len(corners) == 0]
    own = np.array(thing.evaluated_get(graph).matrix_world)
    return [Obstacle(name, thing, corners @ world[:3, :3].T + world[:3, 3], own)
            for name, corners, world in found if len(corners) > 0]

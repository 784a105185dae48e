"""The body that is checked: Foretouch's avatar, and which bone moves each of its links."""

import json
import struct
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np

from . import library
from .axes import frames_of, quaternions
from .rig import links_of
from .told import Told


class Body(NamedTuple):
    avatar: object
    bones: np.ndarray
    """(n,), of each link the number of its bone; -1: moves with the armature object."""
    rest: np.ndarray
    """(n, 4, 4), world frames of the links at rest, metres, y up."""
    notes: list


def body_of(rig, scene, axes, stretch):
    asked = scene.foretouch
    if asked.body_from == "FILE":
        return _from_file(rig, bpy.path.abspath(asked.avatar_file))
    if asked.body_from == "ENVELOPES":
        return _from_envelopes(rig, links_of(rig, scene, axes, stretch, with_meshes=False), axes, stretch)
    return _from_meshes(rig, links_of(rig, scene, axes, stretch), asked.most_lss)


def grown(body, by):
    """With radii larger by so many metres, link by link."""
    ft = library.package()
    if not np.any(by > 0.0):
        return body
    rest = body.avatar.rest_pose()
    lss = [[(each.a, each.b, each.radius + more) for each in link]
           for link, more in zip(body.avatar.lss, by)]
    avatar = ft.Avatar.from_arrays(body.avatar.names, body.avatar.parents, rest.translations,
                                   rest.rotations, lss)
    return body._replace(avatar=avatar)


def reaches(body):
    """(n,), metres: how far the farthest point of a link's LSS is from its joint; 0 without LSS."""
    return np.array([max((max(np.linalg.norm(each.a), np.linalg.norm(each.b)) + each.radius
                          for each in link), default=0.0) for link in body.avatar.lss])


def _from_file(rig, path):
    ft = library.package()
    if not path:
        raise Told("Choose the avatar file of the body")
    avatar = ft.Avatar.load(path)
    number = {bone.name: k for k, bone in enumerate(rig.data.bones)}
    strangers = [name for name, lss in zip(avatar.names, avatar.lss) if lss and name not in number]
    if strangers:
        raise Told(f"{path}: '{strangers[0]}' is no bone of '{rig.name}'"
                   + (f", nor are {len(strangers) - 1} more links" if len(strangers) > 1 else ""))
    bones = np.array([number.get(name, -1) for name in avatar.names])
    return Body(avatar, bones, frames_of(*avatar.rest_pose(), avatar.parents), [])


def _from_envelopes(rig, links, axes, stretch):
    """Each deforming bone as one LSS, as thick as its envelope."""
    ft = library.package()
    lss = []
    for link, bone in enumerate(rig.data.bones):
        if not bone.use_deform:
            lss.append([])
            continue
        tail = axes.points(stretch @ np.array(bone.tail_local))
        inverse = np.linalg.inv(links.rest[link])
        radius = max(bone.head_radius, bone.tail_radius) * axes.unit * np.linalg.norm(stretch, 2)
        lss.append([(np.zeros(3), inverse[:3, :3] @ tail + inverse[:3, 3], radius)])
    if not any(lss):
        raise Told(f"'{rig.name}' has no deforming bones: turn on Deform among their properties")
    order, parents = _parents_first(links.parents)
    rotations, offsets = _relative(links.rest[order], parents)
    avatar = ft.Avatar.from_arrays([links.names[k] for k in order], parents, offsets, rotations,
                                   [lss[k] for k in order])
    return Body(avatar, np.array(order), links.rest[order], links.notes)


def _parents_first(parents):
    """An order of the links, and the parents in it."""
    order, place = [], {-1: -1}
    waiting = list(range(len(parents)))
    while waiting:
        ready = [k for k in waiting if parents[k] in place]
        for k in ready:
            place[k] = len(order)
            order.append(k)
        waiting = [k for k in waiting if k not in place]
    return order, [place[parents[k]] for k in order]


def _relative(rest, parents):
    local = np.array([frame if parent < 0 else np.linalg.inv(rest[parent]) @ frame
                      for frame, parent in zip(rest, parents)])
    return quaternions(local[:, :3, :3]), local[:, :3, 3]


def _from_meshes(rig, links, most_lss):
    """`foretouch avatar mesh` fits LSS to the triangles of each link."""
    ft = library.package()
    program = library.program()
    with tempfile.TemporaryDirectory() as folder:
        model, made = Path(folder, "body.glb"), Path(folder, "body.json")
        model.write_bytes(_glb(links))
        words = [program, "avatar", "mesh", str(model), "--output", str(made), "--max-lss", str(most_lss)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Told(f"No body can be made of '{rig.name}': {done.stderr.strip()}")
        fitted = ft.Avatar.load(made)
    # What the reader puts above several roots is no link of ours.
    lss = {int(name): lss for name, lss in zip(fitted.names, fitted.lss) if name.isdigit()}
    order = [k for k in _parents_first(links.parents)[0] if k in lss]
    place = {k: number for number, k in enumerate(order)}
    parents = [place.get(links.parents[k], -1) for k in order]
    rotations, offsets = _relative(links.rest[order], parents)
    avatar = ft.Avatar.from_arrays([links.names[k] for k in order], parents, offsets, rotations,
                                   [lss[k] for k in order])
    return Body(avatar, np.array([links.bones[k] for k in order]), links.rest[order], links.notes)


def _glb(links):
    """The links as nodes, called by their numbers, each with its triangles. (Blender's own exporter changes what is selected,
    and leaves out bones and weights by its own rules.)"""
    nodes, meshes, accessors, views, data = [], [], [], [], b""
    rotations, offsets = _relative(links.rest, links.parents)
    for link in range(len(links.names)):
        w, x, y, z = rotations[link]
        nodes.append({"name": str(link), "rotation": [x, y, z, w], "translation": list(offsets[link])})
        below = [k for k, parent in enumerate(links.parents) if parent == link]
        if below:
            nodes[-1]["children"] = below
        if links.triangles[link] is None:
            continue
        points = links.triangles[link].reshape(-1, 3).astype("<f4")
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": points.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "type": "VEC3",
                          "count": len(points), "min": points.min(axis=0).tolist(),
                          "max": points.max(axis=0).tolist()})
        meshes.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 1}}]})
        nodes[-1]["mesh"] = len(meshes) - 1
        data += points.tobytes()
    roots = [k for k, parent in enumerate(links.parents) if parent < 0]
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes,
                "meshes": meshes, "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(data)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    parts = struct.pack("<II", len(text), 0x4E4F534A) + text
    parts += struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(parts)) + parts

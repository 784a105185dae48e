"""The capsules of the body as objects that move with its bones: colliders for rigid bodies, or to look at."""

import bpy
import numpy as np

from .rig import rest_stretch
from .told import Told

AROUND = 24
"""Faces around a capsule, and from pole to pole."""
GROWTH = 1.0 / np.cos(np.pi / AROUND) ** 2
"""A face of a ball of AROUND x AROUND / 2 faces lies within the ball by both half angles at most."""


def one_scale(rig):
    """That of the armature object, or Told."""
    stretch = rest_stretch(rig.matrix_world)
    scale = stretch[0, 0]
    if scale <= 0.0 or not np.allclose(stretch, scale * np.eye(3), atol=1e-4 * abs(scale)):
        raise Told(f"'{rig.name}' is scaled unevenly, which no capsule follows: apply it (Ctrl A, Scale)")
    return scale


def capsules_of(body, rig, axes):
    """Of each LSS its name, its bone (None: the armature itself), and its ends and radius in that parent's
    frame, Blender units."""
    scale, bones = one_scale(rig), list(rig.data.bones)
    for link, lss in enumerate(body.avatar.lss):
        bone = bones[body.bones[link]] if body.bones[link] >= 0 else None
        frame = np.eye(4)
        if bone is not None:  # children of a bone are placed from its tail
            frame = np.array(bone.matrix_local, dtype=np.float64)
            frame[:3, 3] += frame[:3, 1] * bone.length
        back = np.linalg.inv(frame)
        for number, one in enumerate(lss):
            ends = np.array([one.a, one.b]) @ body.rest[link][:3, :3].T + body.rest[link][:3, 3]
            ends = axes.points_back(ends) / scale @ back[:3, :3].T + back[:3, 3]
            yield f"{body.avatar.names[link]} capsule {number}", bone, ends, one.radius / axes.unit / scale


def mesh_around(name, length, radius):
    """A convex mesh that holds the capsule along z about its middle."""
    rings = AROUND // 2
    heights = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)[1:-1]
    points = [(0.0, 0.0, -GROWTH * radius - length / 2)]
    # The ring in the middle is there twice: once about either end.
    for height, end in [(h, -0.5) for h in heights if h <= 1e-9] + [(h, 0.5) for h in heights if h >= -1e-9]:
        for k in range(AROUND):
            around = 2 * np.pi * k / AROUND
            flat = GROWTH * radius * np.cos(height)
            points.append((flat * np.cos(around), flat * np.sin(around), GROWTH * radius * np.sin(height) + end * length))
    points.append((0.0, 0.0, GROWTH * radius + length / 2))
    last, count = len(points) - 1, (len(points) - 2) // AROUND
    faces = []
    for k in range(AROUND):
        n = (k + 1) % AROUND
        faces.append((0, 1 + n, 1 + k))
        for ring in range(count - 1):
            low, high = 1 + ring * AROUND, 1 + (ring + 1) * AROUND
            faces.append((low + k, low + n, high + n, high + k))
        faces.append((last, last - AROUND + k, last - AROUND + n))
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    return mesh


def placed_along(ends):
    """(4, 4): the middle of the ends, and z from the first to the second."""
    along = ends[1] - ends[0]
    length = np.linalg.norm(along)
    z = along / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    frame = np.eye(4)
    frame[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    frame[:3, 3] = ends.mean(axis=0)
    return frame

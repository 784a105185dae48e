"""What several test files share: where things are, a small world, the bundled example."""

import functools
import os
from pathlib import Path

import numpy as np

import foretouch

BUILD = Path(os.environ["FORETOUCH_BUILD"])
SOURCE = Path(os.environ["FORETOUCH_SOURCE"])
PROGRAM = BUILD / "bin" / "foretouch"

IDENTITY = (1.0, 0.0, 0.0, 0.0)


def turn(axis, angle):
    """The quaternion (w, x, y, z) of a turn about an axis."""
    axis = np.asarray(axis, dtype=float)
    axis = axis / np.linalg.norm(axis)
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis])


def arm():
    """Two links in a row along +X: an upper arm and a forearm of 30 cm each, 4 cm thick."""
    return foretouch.Avatar.from_arrays(
        names=["upper", "fore"],
        parents=[-1, 0],
        offsets=[[0, 1, 0], [0.3, 0, 0]],
        rotations=None,
        lss=[[((0, 0, 0), (0.3, 0, 0), 0.04)], [((0, 0, 0), (0.3, 0, 0), 0.04)]],
    )


def wall(z=-0.3, name="wall"):
    """A square of 10 m across the z axis."""
    corners = [[-5, -5, z], [5, -5, z], [5, 5, z], [-5, 5, z]]
    return foretouch.Scene.from_arrays(corners, [[0, 1, 2], [0, 2, 3]], object_names=[name])


def bent(avatar, joint, angle):
    """The rest pose with one joint turned about +Y."""
    pose = avatar.rest_pose()
    pose.rotations[joint] = turn([0, 1, 0], angle)
    return pose


def swing(avatar=None, angle=np.pi / 2):
    """The whole arm swings from +X to -Z."""
    avatar = avatar or arm()
    return foretouch.Motion(avatar, avatar.rest_pose(), bent(avatar, 0, angle))


@functools.lru_cache(maxsize=None)
def example():
    """The bundled avatar, scene and clip."""
    folder = foretouch.example_folder()
    return (
        foretouch.Avatar.load(folder / "dancer.avatar.json"),
        foretouch.Scene.load(folder / "room.obj"),
        foretouch.Clip.load(folder / "dancer.bvh"),
    )

"""Where bones and objects are at every frame, as Blender evaluates them."""

import math
from dataclasses import dataclass, replace

import bpy
import numpy as np

from .axes import nearest_rotations, strain
from .obstacles import corners_of, may_reshape
from .told import Told

MOST_STRAIN = 0.5
"""A bone that is longer or shorter by more than this share is no rigid body in any sense."""


@dataclass(frozen=True)
class Range:
    """Whole frames, both ends in."""

    first: int
    last: int
    seconds_per_frame: float

    def __len__(self):
        return self.last - self.first + 1

    @property
    def instants(self):
        return np.arange(self.first, self.last + 1)

    def cut(self, first, last):
        return replace(self, first=max(self.first, first), last=min(self.last, last))


def range_of(rig, scene):
    """The frames that are checked, or Told."""
    seconds = scene.render.fps_base / scene.render.fps
    if scene.foretouch.frames == "SCENE":
        first, last = scene.frame_start, scene.frame_end
    else:
        action = rig.animation_data.action if rig.animation_data else None
        if action is None:
            raise Told(f"'{rig.name}' has no action: choose one in the Action Editor, or check the "
                       "scene's frames")
        first, last = (round(float(end)) for end in action.frame_range)
    if last <= first:
        raise Told(f"There is nothing between two poses: the motion has the frame {first} alone")
    return Range(first, last, seconds)


class Sampler:
    """A scene of its own that has only what is asked for, and what that depends on: no mesh is
    deformed, and nothing of the user's scene moves. Use it in a `with`."""

    def __init__(self, rig, scene, things=()):
        self.rig, self.user_scene, self.things = rig, scene, list(things)
        self.scene = None

    def __enter__(self):
        self.scene = bpy.data.scenes.new("Foretouch")
        self.scene.render.fps = self.user_scene.render.fps
        self.scene.render.fps_base = self.user_scene.render.fps_base
        for thing in [self.rig, *self.things]:
            self.scene.collection.objects.link(thing)
        self.layer = self.scene.view_layers[0]
        self.layer.update()
        bones = self.rig.pose.bones
        number = {bone.name: k for k, bone in enumerate(self.rig.data.bones)}
        self.order = np.array([number[bone.name] for bone in bones])
        self.flat = np.empty(16 * len(bones), dtype=np.float32)
        self.shapes = {}
        return self

    def __exit__(self, *_):
        bpy.data.scenes.remove(self.scene)
        self.scene = None

    def at(self, frame):
        """Of a frame, whole or not: bones in the armature's space (b, 4, 4), the armature's own matrix, and
        those of the things."""
        self.scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
        graph = self.layer.depsgraph
        rig = self.rig.evaluated_get(graph)
        rig.pose.bones.foreach_get("matrix", self.flat)
        bones = np.empty((len(self.order), 4, 4))
        bones[self.order] = self.flat.reshape(-1, 4, 4).transpose(0, 2, 1)
        things = [np.array(thing.evaluated_get(graph).matrix_world) for thing in self.things]
        self._refuse_reshaped(graph, frame)
        return bones, np.array(rig.matrix_world), things

    def _refuse_reshaped(self, graph, frame):
        """Against the first frame that was asked."""
        for thing in filter(may_reshape, self.things):
            now = corners_of(thing.evaluated_get(graph))
            before = self.shapes.setdefault(thing, now)
            if now.shape != before.shape or not np.array_equal(now, before, equal_nan=True):
                raise Told(f"'{thing.name}' changes its shape at frame {frame:g}: only what keeps its shape "
                           "can be checked against. Take it out of the chosen objects, or apply its modifiers")


class BodyMotion:
    """Poses of a body out of sampled bones, chunk by chunk."""

    def __init__(self, rig, body, axes, stretch):
        self.body, self.axes = body, axes
        rest = np.array([bone.matrix_local for bone in rig.data.bones], dtype=np.float64)
        self.rest_inverse = np.linalg.inv(rest.reshape(-1, 4, 4))
        self.unstretch = np.eye(4)
        self.unstretch[:3, :3] = np.linalg.inv(stretch)

    def frames(self, bones, worlds, instants):
        """World frames (k, n, 4, 4) of the links, and how far each is from rigid (k, n). `instants`: at
        which frames of the scene."""
        moves = worlds[:, None] @ np.concatenate(
            [bones @ self.rest_inverse, np.broadcast_to(np.eye(4), (len(bones), 1, 4, 4))], axis=1)
        moves = self.axes.moves(moves[:, self.body.bones] @ self.unstretch)
        strains = strain(moves)
        self._refuse_wild(moves, strains, instants)
        placed = moves @ self.body.rest
        placed[..., :3, :3] = nearest_rotations(moves[..., :3, :3]) @ self.body.rest[:, :3, :3]
        return placed, strains

    def _refuse_wild(self, moves, strains, instants):
        has_lss = np.array([bool(lss) for lss in self.body.avatar.lss])
        wild = ~np.isfinite(strains) | (strains > MOST_STRAIN) | (np.linalg.det(moves[..., :3, :3]) < 0)
        wild &= has_lss | np.isnan(strains)
        if not np.any(wild):
            return
        frame, link = np.argwhere(wild)[0]
        linear = moves[frame, link, :3, :3]
        scales = ", ".join(f"{scale:.3g}" for scale in np.linalg.norm(linear, axis=0))
        mirrored = " and mirrored" if np.linalg.det(linear) < 0 else ""
        raise Told(f"Bone '{self.body.avatar.names[link]}' is scaled by {scales}{mirrored} at frame "
                   f"{instants[frame]:g}: a body of rigid parts cannot follow it. Clear its scale (Alt S)")


def growth_of(strains, reaches):
    """(n,), metres, by which a link's LSS must grow to hold what stretches; 0 of what is as rigid as
    single precision has it."""
    most = strains.max(axis=0)
    return np.where(most * reaches > AS_RIGID_M, most * reaches, 0.0)


AS_RIGID_M = 1e-5
"""Metres, a hundredth of the usual tolerance: Blender's matrices are in single precision, and so is
what is not told apart from a rigid bone."""

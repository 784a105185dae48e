"""The motion of the body and of what it may touch, frame by frame: what every question begins with."""

from typing import NamedTuple

import numpy as np

from . import library
from .axes import Axes, nearest_rotations, poses_of, quaternions, strain
from .body import body_of, grown, reaches
from .motion import BodyMotion, Range, Sampler, growth_of, range_of
from .obstacles import chosen, may_move, may_reshape, read, still_scene
from .rig import armature_of, rest_stretch
from .told import Told

CHUNK = 32
"""Frames that are worked at in one go: enough to spread what a call costs."""


class Sampled(NamedTuple):
    rig: object
    body: object
    axes: Axes
    frames: Range
    instants: np.ndarray
    """(k,), frames at which the poses are: whole ones, unless others were asked for."""
    motion: BodyMotion
    poses: tuple
    """Rotations (k, n, 4) and translations (k, n, 3)."""
    still: object
    """A foretouch.Scene, or None."""
    props: list
    """Names and scenes of what moves."""
    places: list
    """Of each prop rotations (k, 4) and translations (k, 3)."""
    notes: list

    def pose(self, k):
        return self.poses[0][k], self.poses[1][k]

    def places_at(self, k):
        return [(rotations[k], translations[k]) for rotations, translations in self.places]


def sampling(context, with_obstacles=True, between=None, more_instants=()):
    """Yields the share that is done, and returns a Sampled. `between`: frames to cut the range to.
    `more_instants`: frames that are not whole, to look at as well."""
    ft = library.package()
    scene = context.scene
    rig = armature_of(scene)
    frames = range_of(rig, scene)
    if between is not None:
        frames = frames.cut(*between)
    axes = Axes.of(scene)
    notes = []
    things = chosen(scene, context, notes) if with_obstacles else []
    watched = [thing for thing in things if may_move(thing) or may_reshape(thing)]
    graph = context.evaluated_depsgraph_get()
    with Sampler(rig, scene, watched) as sampler:
        stretch = rest_stretch(sampler.at(frames.first)[1])
        body = body_of(rig, scene, axes, stretch)
        notes += body.notes
        obstacles = []
        if with_obstacles:
            obstacles = read([(thing, sampler.layer.depsgraph if thing in watched else graph)
                              for thing in things], notes)
        motion = BodyMotion(rig, body, axes, stretch)
        instants = np.union1d(frames.instants, more_instants)
        poses, worlds, most = yield from _all_frames(sampler, instants, motion)
    more = growth_of(most, reaches(body))
    notes += [f"Bone '{body.avatar.names[link]}' stretches by up to {100 * most[link]:.2g} %: its capsules "
              f"are {1000 * more[link]:.2g} mm thicker. Apply the armature's scale (Ctrl A), or clear the "
              "bone's (Alt S)" for link in np.flatnonzero(more > NOTED_M)]
    moving = _moving(watched, worlds)
    props = [each for each in obstacles if each.thing in moving]
    return Sampled(
        rig, grown(body, more), axes, frames, instants, motion, poses,
        still_scene(ft, [each for each in obstacles if each.thing not in moving], axes),
        [(each.name, still_scene(ft, [each], axes)) for each in props],
        [_places(each, moving[each.thing], axes, instants) for each in props], notes)


NOTED_M = 1e-4
"""Metres by which capsules may be thicker without a word: a tenth of the usual tolerance."""


def _all_frames(sampler, instants, motion):
    """Poses of the body, matrices of the watched things (k, things, 4, 4), and the most that each link
    is strained."""
    rotations, translations, worlds, most = [], [], [], 0.0
    for first in range(0, len(instants), CHUNK):
        chunk = instants[first:first + CHUNK]
        found = [sampler.at(float(instant)) for instant in chunk]
        bones, rigs, things = (np.array(part) for part in zip(*found))
        placed, strains = motion.frames(bones, rigs, chunk)
        turned, moved = poses_of(placed, motion.body.avatar.parents)
        rotations.append(turned)
        translations.append(moved)
        worlds.append(things.reshape(len(found), -1, 4, 4))
        most = np.maximum(most, strains.max(axis=0))
        yield 0.9 * first / len(instants)
    return (np.concatenate(rotations), np.concatenate(translations)), np.concatenate(worlds), most


def _moving(things, worlds):
    """Of each thing that moves its matrices (k, 4, 4)."""
    return {thing: worlds[:, k] for k, thing in enumerate(things)
            if np.any(worlds[:, k] != worlds[0, k])}


def _places(obstacle, worlds, axes, instants):
    """Where the obstacle is, seen from where it was read. Told where it changes its size."""
    moves = axes.moves(worlds @ np.linalg.inv(obstacle.world))
    strains = strain(moves)
    if not np.all(strains <= MOST_PROP_STRAIN):  # not a number: neither
        frame = instants[int(np.argmin(strains <= MOST_PROP_STRAIN))]
        raise Told(f"'{obstacle.name}' changes its size at frame {frame:g}: what moves must stay rigid. "
                   "Take it out of the chosen objects, or clear its scale")
    return quaternions(nearest_rotations(moves[:, :3, :3])), moves[:, :3, 3]


MOST_PROP_STRAIN = 1e-4
"""What single precision makes of a rigid motion is a thousandth of it."""

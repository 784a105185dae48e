"""All that the Python package says of what moves, in digits that keep every bit:
    moving_world.py SCENE AVATAR CLIP world|solid|solid-world|edges
To standard output: a world with two dancers, a door, a ball in a hand and triggers, window by
window and from enter to leave; a solid avatar; two in a world where a door swings; a robot's
edges, and how near they come."""
import enum
import math
import sys
from collections.abc import Sequence

import numpy as np

import foretouch

TICK_US = 33_333
HINGE = [-0.35, 0, -0.35]
OWNERS = ("avatar", "scene", "world", "robot", "still")  # what an answer is of, and not part of it


def tell(name, value):
    """Prints it, and all that it is made of."""
    if isinstance(value, np.ndarray):
        value = value.ravel().tolist()
        isNumbers = all(isinstance(number, float) for number in value)
        print(name, *(number.hex() if isNumbers else number for number in value))
    elif isinstance(value, float):
        print(name, value.hex())
    elif value is None or isinstance(value, (bool, int, str, enum.Enum, np.generic)):
        print(name, value)
    elif isinstance(value, dict):
        for key, part in value.items():
            tell(f"{name}.{key}", part)
    elif isinstance(value, Sequence) and not hasattr(value, "_fields"):
        for i, part in enumerate(value):
            tell(f"{name}[{i}]", part)
    else:
        for part in sorted(dir(value)):
            held = getattr(value, part) if part[0] != "_" and part not in OWNERS else tell
            if not callable(held):
                tell(f"{name}.{part}", held)


def turned(angle, place):
    """The pose of a prop, turned about +Y."""
    return [[math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0]], [place]


def beside(pose, place):
    """A pose that stands elsewhere."""
    translations = pose.translations.copy()
    translations[0] += place
    return foretouch.Pose(pose.rotations, translations)


def door():
    return foretouch.Scene.from_arrays(
        [[0, 0, 0], [0.9, 0, 0], [0.9, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]],
        object_names=["door"])


def ball(radius):
    return foretouch.Avatar.from_arrays(
        names=["ball"], parents=[-1], offsets=[[0, 0, 0]], rotations=None,
        lss=[[((0, 0, 0), (0, 0, 0), radius)]])


def push_all(world, bodies, poses, i):
    anna, ben, swinging = bodies
    world.push(anna, i * TICK_US, poses[240 + 2 * i])
    if i % 2 == 0:
        world.push(ben, i * TICK_US, beside(poses[480 - 3 * i], [0.1, 0, 0.45]))
    world.push(swinging, i * TICK_US, turned(2.2 + math.sin(0.2 * i), HINGE))


def moving_world(scene, avatar, poses):
    world = foretouch.World(scene, tolerance=0.002)
    bodies = [world.add(avatar), world.add(avatar, group=1), world.add(door(), group=2)]
    thrown = world.add(ball(0.07), when_silent="hold-still")
    triggers = foretouch.Triggers(world, 0)
    doorway, near = triggers.add_box([0.5, 1.0, 0.3]), triggers.add_sphere(0.4, by_link=True)
    triggers.stand(doorway, 0, [0.3, 1.0, -0.4])
    follower = foretouch.Follower(world, 0)
    follower.weigh(bodies[0], 58.0)
    for i in range(61):
        push_all(world, bodies, poses, i)
        if i == 10:
            hand = {"link": "RightHand"}
            world.attach(thrown, bodies[0], i * TICK_US, turned(0, [-0.05, -0.117, 0]), **hand)
            world.attach(triggers.body(near), bodies[0], i * TICK_US, turned(0, [0, 0, 0]), **hand)
        if i % 5 == 0 and i > 0:
            until = world.known_until
            tell(f"{i} window", world.contacts(until - 2 * TICK_US, until))
            tell(f"{i} events", follower.follow(until))
            tell(f"{i} open", follower.open)
            tell(f"{i} depth", world.depth(until, bodies[0], bodies[1]))
            tell(f"{i} triggers", triggers.follow(until))
            tell(f"{i} occupants", triggers.occupants)


def solid(scene, avatar, poses):
    body = foretouch.SolidAvatar(avatar, scene, may_snap=True)
    for i in range(60):
        tracked = beside(poses[240 + 2 * i], [0.0, -0.05, 0.004 * i])
        tell(f"tick {i}", body.follow(tracked, 1e-6 * TICK_US))


def solid_world(scene, avatar, poses):
    shown = foretouch.SolidWorld(scene, 0)
    anna, ben = shown.add(avatar), shown.add(avatar)
    swinging = shown.world.add(door())
    shown.world.push(swinging, 0, turned(2.2, HINGE))
    for i in range(1, 31):
        shown.world.push(swinging, i * TICK_US, turned(2.2 + math.sin(0.2 * i), HINGE))
        targets = {anna: poses[240 + 2 * i], ben: beside(poses[480 - 3 * i], [0.1, 0, 0.45])}
        tell(f"tick {i}", shown.tick(i * TICK_US, targets))
        tell(f"events {i}", shown.follow())


def edges(scene, *_):
    """An arm of three joints that reaches into the room; with a prop, and without."""
    arm = foretouch.Avatar.from_arrays(
        names=["base", "upper", "lower"], parents=[-1, 0, 1],
        offsets=[[0, 0.8, 0], [0, 0.1, 0], [0.5, 0, 0]], rotations=None,
        lss=[[((0, 0, 0), (0, 0.1, 0), 0.08)], [((0, 0, 0), (0.5, 0, 0), 0.05)],
             [((0, 0, 0), (0.45, 0, 0), 0.04)]])
    about = ([0, 1, 0], [0, 0, 1], [0, 0, 1])
    robot = foretouch.Robot.from_joints(
        arm, [{"name": name, "kind": "revolute", "axis": axis, "lower": -2.5, "upper": 2.5}
              for name, axis in zip("abc", about)])
    asked = foretouch.EdgeQuery(robot, scene, clearance=0.005, props=[door()],
                                self_pairs=foretouch.PairRules.of_robot(robot))
    draws = np.array([[2.5 * math.sin(i * (k + 1.3)) for k in range(3)] for i in range(61)])
    for name, place in (("without", None), ("with", turned(0.3, [0.4, 0, 0.2]))):
        asked.place(0, place)
        tell(f"{name} edges", asked.answer(draws[:-1], draws[1:]))
        tell(f"{name} path", asked.answer_path(0.2 * draws[:8]))
        tell(f"{name} clearances", asked.clearance(draws[:-1], draws[1:], slopes=True))


def main(scene_path, avatar_path, clip_path, what):
    scene, avatar = foretouch.Scene.load(scene_path), foretouch.Avatar.load(avatar_path)
    poses = foretouch.Clip.load(clip_path).poses(avatar)
    {"world": moving_world, "solid": solid, "solid-world": solid_world, "edges": edges}[what](
        scene, avatar, poses)


if __name__ == "__main__":
    main(*sys.argv[1:])

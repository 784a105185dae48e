#!/usr/bin/env python3
"""Draws proven-edges.svg beside this file: an edge of an arm that samples call free and that is not, and the way of
proven edges that a planner finds. Needs the package `foretouch` in PYTHONPATH. Every verdict and pose is an answer of
the library; the planner is an RRT whose draws have a fixed seed.
"""
import numpy as np

import foretouch
from foretouch import Verdict

from concepts import BLUE, FAINT, GREEN, INK, ORANGE, RED
from moving import Film

NAME = "proven-edges.svg"
LINKS = [(0.34, 0.030), (0.30, 0.024), (0.22, 0.018)]  # length and radius, metres
WIRES, WIRE = [(0.60, 0.40), (0.35, 0.65), (0.05, 0.70), (-0.15, 0.80)], 0.004  # across the picture; radius
START, GOAL = np.array([-0.35, 0.30, 0.30]), np.array([1.75, 0.25, -0.45])
SAMPLES = 20  # of the straight edge: every 5 %
STEP = 0.35  # rad, of the planner's edges
FRAMES, SECONDS = 80, 8.0
FIRST_PART = 34  # frames of the straight edge; what follows is the way around
SCALE, CENTER = 210, (212, 242)


def make_robot():
    offsets = [[0, 0, 0]] + [[length, 0, 0] for length, _ in LINKS[:-1]]
    avatar = foretouch.Avatar.from_arrays(
        names=["upper", "fore", "tool"], parents=[-1, 0, 1], offsets=offsets, rotations=None,
        lss=[[((0, 0, 0), (length, 0, 0), radius)] for length, radius in LINKS])
    joint = {"kind": "revolute", "axis": [0, 0, 1], "lower": -2.6, "upper": 2.6}
    return avatar, foretouch.Robot.from_joints(avatar, [joint] * len(LINKS))


def make_wires():
    """Prisms of three sides along z."""
    corners, triangles, objects = [], [], []
    for number, (x, y) in enumerate(WIRES):
        first = len(corners)
        for z in (-0.3, 0.3):
            corners += [[x + WIRE * np.cos(a), y + WIRE * np.sin(a), z] for a in (0.0, 2.094, 4.189)]
        for i in range(3):
            j = (i + 1) % 3
            triangles += [[first + i, first + j, first + 3 + i], [first + j, first + 3 + j, first + 3 + i]]
        objects += [number] * 6
    return foretouch.Scene.from_arrays(corners, triangles, objects, [f"wire {i + 1}" for i in range(len(WIRES))])


class Plan:
    """The straight edge, as samples see it and as it is; and a way around."""

    def __init__(self):
        self.avatar, self.robot = make_robot()
        self.edges = foretouch.EdgeQuery(self.robot, make_wires())
        self.asked = 0
        self.straight = self.edges.answer([START], [GOAL])[0]
        assert self.straight.verdict == Verdict.CONTACT
        self.samples = [START + i / SAMPLES * (GOAL - START) for i in range(SAMPLES + 1)]
        assert all(self.is_free(q, q) for q in self.samples)
        self.way = self.shortened(self.found())
        self.lengths = [max(np.abs(b - a)) for a, b in zip(self.way, self.way[1:])]

    def is_free(self, q0, q1):
        self.asked += 1
        return bool(self.edges.answer([q0], [q1]).usable[0])

    def found(self):
        draws = np.random.default_rng(7)
        tree, parents = [START], [None]
        while True:
            aim = GOAL if draws.random() < 0.15 else draws.uniform(-2.4, 2.4, len(LINKS))
            near = min(range(len(tree)), key=lambda i: np.abs(tree[i] - aim).max())
            long = np.abs(aim - tree[near]).max()
            q = tree[near] + min(1.0, STEP / long) * (aim - tree[near]) if long else aim
            if not self.is_free(tree[near], q):
                continue
            tree.append(q)
            parents.append(near)
            if self.is_free(q, GOAL):
                way, at = [GOAL], len(tree) - 1
                while at is not None:
                    way.append(tree[at])
                    at = parents[at]
                return way[::-1]

    def shortened(self, way):
        """Without the corners that a proven edge can leave out."""
        kept = [0]
        while kept[-1] < len(way) - 1:
            kept.append(max(i for i in range(kept[-1] + 1, len(way))
                            if i == kept[-1] + 1 or self.is_free(way[kept[-1]], way[i])))
        return [way[i] for i in kept]

    def at(self, s):
        """On the way, s from 0 to 1."""
        s *= sum(self.lengths)
        for a, b, long in zip(self.way, self.way[1:], self.lengths):
            if s <= long + 1e-12:
                return a + s / long * (b - a)
            s -= long
        return self.way[-1]


def pixel(p):
    return (CENTER[0] + SCALE * p[0], CENTER[1] - SCALE * p[1])


def capsules(plan, q):
    pose = plan.robot.pose(list(q))
    for (one,), place in zip(plan.avatar.lss, foretouch.Motion(plan.avatar, pose, pose).transforms(0)):
        yield pixel(place[:3, :3] @ one.a + place[:3, 3]), pixel(place[:3, :3] @ one.b + place[:3, 3]), one.radius


def drawn():
    plan = Plan()
    p = Film(480, 300, "An edge that samples call free and that is not; and a way of proven edges", SECONDS, FRAMES)
    until, rest = plan.straight.free_until, FRAMES - FIRST_PART
    moves = [START + min(until, 1.3 * until * i / FIRST_PART) * (GOAL - START) for i in range(FIRST_PART)]
    moves += [plan.at(min(1.0, 1.15 * i / (rest - 1))) for i in range(rest)]
    is_first = [i < FIRST_PART for i in range(FRAMES)]
    is_second = [not first for first in is_first]

    def draw_samples():
        for q in plan.samples:
            for a, b, radius in capsules(plan, q):
                p.capsule(a, b, SCALE * radius, FAINT, 0.08, False)
        tips = [list(capsules(plan, q))[-1][1] for q in plan.samples]
        for tip in tips:
            p.dot(tip, 2, FAINT)
        p.text(14, 26, f"{SAMPLES + 1} samples of the straight edge: all free", FAINT, weight="bold")

    def draw_way():
        p.path([list(capsules(plan, plan.at(i / 160)))[-1][1] for i in range(161)], GREEN, 2, opacity=0)
        for q in plan.way:
            p.dot(list(capsules(plan, q))[-1][1], 4, GREEN)
        p.text(14, 26, f"a planner's way: {len(plan.way) - 1} edges, each proven free", GREEN, weight="bold")

    p.when(is_first, draw_samples)
    p.when(is_second, draw_way)
    frames = [list(capsules(plan, q)) for q in moves]
    for i in range(len(LINKS)):
        p.capsule_through([frame[i][:2] for frame in frames], SCALE * LINKS[i][1], "#7fa3dc", BLUE)
    p.dot(CENTER, 4, INK)
    for x, y in WIRES:
        p.dot(pixel((x, y)), 3.2, ORANGE)
    p.text(466, 286, "orange: wires of 8 mm at most, drawn larger", ORANGE, "end", 12)
    hit = [first and i >= FIRST_PART / 1.3 for i, first in enumerate(is_first)]

    def draw_hit():
        p.circle(pixel(plan.straight.point), 9, RED, 2.4)
        p.text(14, 48, f"CONTACT: {plan.straight.link} meets {plan.straight.object}; free until {until:.3f}", RED,
               weight="bold")

    p.when(hit, draw_hit)
    return p


if __name__ == "__main__":
    drawn().write(NAME)

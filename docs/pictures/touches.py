#!/usr/bin/env python3
"""Draws touches.svg beside this file: which part of the bundled dancer touches what of the railing, and when. Needs the
package `foretouch` in PYTHONPATH. Every pose, event and point is an answer of the library.
"""
import foretouch

from concepts import BLUE, FAINT, INK, PAPER, RED, WOOD
from hand_that_stops import capsules, draw_arm
from moving import Film, View

NAME = "touches.svg"
EVERY, RATE_HZ = 6, 10  # frames of the clip from pose to pose; poses a second
FIRST, LAST = 21, 35  # poses
BETWEEN = 3  # pictures from one pose to the next
SLOWER = 5
ROWS = ["LeftFingers", "LeftHand", "LeftForeArm", "LeftArm"]
COLORS = {"railing_bars": RED, "handrail": "#8446a8"}
LEFT, RIGHT, TOP, ROW = 96, 466, 214, 17  # of the table of touches, pixels


class Story:
    """The dance at ten poses a second, followed from enter to leave."""

    def __init__(self):
        folder = foretouch.example_folder()
        self.scene = foretouch.Scene.load(folder / "room.obj")
        self.avatar = foretouch.Avatar.load(folder / "dancer.avatar.json")
        self.poses = foretouch.Clip.load(folder / "dancer.bvh").poses(self.avatar)[::EVERY]
        world = foretouch.World(self.scene)
        body = world.add(self.avatar)
        follower = foretouch.Follower(world, 0)
        for k, pose in enumerate(self.poses):
            world.push(body, 1_000_000 * k // RATE_HZ, pose)
        self.touches = []  # link, object, from, to (seconds), where
        begun = {}
        for event in follower.follow(world.known_until).events:
            key, seconds = (event.a.link, event.b.object), 1e-6 * event.time_us
            if event.kind == "enter":
                begun[key] = (seconds, event.b.point)
            elif event.kind == "leave" and key in begun:
                since, point = begun.pop(key)
                self.touches.append((*key, since, seconds, point))
        self.touches = [t for t in self.touches if FIRST < RATE_HZ * t[2] and RATE_HZ * t[3] < LAST]
        self.read_railing(folder / "room.obj")

    def read_railing(self, path):
        """Bars as lines from foot to head, the handrail as one."""
        points, name = {}, None
        for line in path.read_text().splitlines():
            if line.startswith("o "):
                name = line[2:]
            elif line.startswith("v ") and name in COLORS:
                points.setdefault(name, []).append(tuple(float(x) for x in line.split()[1:4]))
        bars = {}
        for x, y, _ in points["railing_bars"]:
            near = next((bar for bar in bars if abs(bar - x) < 0.04), x)
            bars.setdefault(near, []).append((x, y))
        self.bars = []
        for bar in bars.values():
            xs, ys = zip(*bar)
            middle = 0.5 * (min(xs) + max(xs))
            self.bars.append(((middle, min(ys), -2.08), (middle, max(ys), -2.08)))
        rail = sorted(points["handrail"])
        self.rail = (rail[0][0], rail[0][1], -2.08), (rail[-1][0], rail[-1][1], -2.08)

    def instants(self):
        return [(k + i / BETWEEN) / RATE_HZ for k in range(FIRST, LAST) for i in range(BETWEEN)]

    def capsules(self, seconds):
        at = seconds * RATE_HZ + 1e-9
        motion = foretouch.Motion(self.avatar, self.poses[int(at)], self.poses[int(at) + 1])
        return capsules(self.avatar, motion, max(0.0, at % 1 - 1e-9))


def draw_table(p, story, instants):
    def x(seconds):
        return LEFT + (RIGHT - LEFT) * (RATE_HZ * seconds - FIRST) / (LAST - FIRST)

    p.box(0, TOP - 22, 480, 300 - TOP + 22, "none", PAPER, 0.9)
    for k in range(FIRST, LAST + 1):
        p.line((x(k / RATE_HZ), TOP - 8), (x(k / RATE_HZ), TOP + ROW * len(ROWS)), FAINT, 0.7, None, 0.6)
    for row, link in enumerate(ROWS):
        y = TOP + ROW * row
        p.text(LEFT - 8, y + 12, link, INK, "end", 12)
        for name, what, since, until, _ in story.touches:
            if name == link and what in COLORS:
                p.box(x(since), y + 2, max(1.5, x(until) - x(since)), ROW - 5, "none", COLORS[what], 1)
    p.box(0, 0, 480, 36, "none", PAPER, 0.9)
    for i, (name, color) in enumerate(COLORS.items()):
        p.text(14 + 96 * i, 24, name.replace("_", " "), color, size=13, weight="bold")
    p.text(466, 24, "10 poses a second, slowed down 5 times", INK, "end", 12)
    p.text(LEFT - 8, TOP + ROW * len(ROWS) + 14, "grey: the poses", FAINT, "end", 11)
    ends = [((x(t), TOP - 10), (x(t), TOP + ROW * len(ROWS) + 2)) for t in instants]
    p.capsule_through(ends, 0.9, INK)


def drawn():
    story = Story()
    instants = story.instants()
    p = Film(480, 300, "Which part of a dancer touches what of a railing, and when", SLOWER * (LAST - FIRST) / RATE_HZ,
             len(instants))
    view = View((0.30, -0.16, -1.0), (1.05, 0.95, -1.9), 93, (258, 110))
    for low, high in story.bars:
        p.line(view.at(low), view.at(high), WOOD, 1.8)
    p.line(*(view.at(end) for end in story.rail), WOOD, 5)
    bodies = [story.capsules(t) for t in instants]
    order = sorted(range(len(bodies[0])), key=lambda i: -view.depth(sum(body[i][0] for body in bodies)))
    draw_arm(p, view, [[body[i] for i in order] for body in bodies], "#7fa3dc", BLUE)
    shown = 0
    for link, what, since, until, point in story.touches:
        if what not in COLORS:
            continue
        # Long enough to be seen: the touches of a bar take some milliseconds.
        is_on = [since - 1 / (BETWEEN * RATE_HZ) < t <= max(until, since + 0.06) for t in instants]
        p.when(is_on, lambda: (p.circle(view.at(point), 7, COLORS[what], 2, "#ffffff", 0.5),
                               p.dot(view.at(point), 3, COLORS[what])))
        shown += 1
    assert shown > 12, shown
    draw_table(p, story, instants)
    return p


if __name__ == "__main__":
    drawn().write(NAME)

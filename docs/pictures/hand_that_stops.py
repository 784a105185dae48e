#!/usr/bin/env python3
"""Draws hand-that-stops.svg beside this file: the bundled hand presses on the bundled desk, tracked and shown. Needs
the package `foretouch` in PYTHONPATH. Every pose, contact and state is an answer of the library.
"""
import foretouch
from foretouch import SolidState

from concepts import BLUE, GREEN, INK, ORANGE, PAPER, RED, WOOD
from moving import Film, View

NAME = "hand-that-stops.svg"
EVERY = 4  # frames of the clip, at 60 Hz
BOXES = ["desk_legs", "drawers", "desk_top", "book"]  # from back to front
WORDS = {SolidState.EQUAL: ("free: shown is tracked, bit for bit", GREEN),
         SolidState.FOLLOWING: ("on its way back to the tracked hand", GREEN),
         SolidState.SLIDING: ("it slides along the desk", ORANGE), SolidState.HELD: ("the desk holds it", RED)}


def capsules(avatar, motion, t):
    """Per LSS of the avatar both ends in the world, and its radius."""
    return [(place[:3, :3] @ one.a + place[:3, 3], place[:3, :3] @ one.b + place[:3, 3], one.radius)
            for link, place in zip(avatar.lss, motion.transforms(t)) for one in link]


class Story:
    """The clip, followed by a solid avatar tick by tick; some ticks are drawn."""

    def __init__(self):
        folder = foretouch.example_folder()
        self.scene = foretouch.Scene.load(folder / "desk.obj")
        self.avatar = foretouch.Avatar.load(folder / "hand.avatar.json")
        clip = foretouch.Clip.load(folder / "hand.bvh")
        solid = foretouch.SolidAvatar(self.avatar, self.scene)
        ticks = [(pose, solid.follow(pose, clip.frame_time_s)) for pose in clip.poses(self.avatar)]
        assert all(tick.is_certified for _, tick in ticks)
        self.ticks, self.seconds = ticks[::EVERY], len(ticks) * clip.frame_time_s
        self.most = max(tick.deviation for _, tick in ticks)
        self.boxes = {name: self.box_of(folder / "desk.obj", name) for name in BOXES}

    def box_of(self, path, name):
        points, is_it = [], False
        for line in path.read_text().splitlines():
            if line.startswith("o "):
                is_it = line == f"o {name}"
            elif is_it and line.startswith("v "):
                points.append([float(x) for x in line.split()[1:4]])
        return [min(c) for c in zip(*points)], [max(c) for c in zip(*points)]

    def capsules(self, pose):
        return capsules(self.avatar, foretouch.Motion(self.avatar, pose, pose), 0)


def draw_arm(p, view, poses, color, edge=None):
    frames = [list(pose) for pose in poses]
    for i in range(len(frames[0])):
        p.capsule_through([(view.at(frame[i][0]), view.at(frame[i][1])) for frame in frames],
                          view.scale * frames[0][i][2], color, edge)


def drawn():
    story = Story()
    states = [tick.state for _, tick in story.ticks]
    assert {SolidState.EQUAL, SolidState.SLIDING, SolidState.HELD} <= set(states) <= set(WORDS), set(states)
    p = Film(480, 300, "A tracked hand goes into a desk; the shown one stays on it", story.seconds, len(story.ticks))
    view = View((0.55, -0.27, -0.8), (0.02, 0.80, 0.47), 400, (236, 172))
    for name in BOXES:
        low, high = story.boxes[name]
        legs = [(low, high)]
        if name == "desk_legs":
            legs = [([x, low[1], z], [x + 0.06, high[1], z + 0.06]) for x in (low[0], high[0] - 0.06)
                    for z in (low[2], high[2] - 0.06)]
        for box in legs:
            for shade, corners in view.faces(*box):
                p.path(corners, WOOD, 1, "#f3eee2", 1, True)
                p.path(corners, WOOD, 1, WOOD, shade, True)
    p.parts.append('<g opacity="0.5">')
    draw_arm(p, view, [story.capsules(pose) for pose, _ in story.ticks], ORANGE)
    p.parts.append("</g>")
    draw_arm(p, view, [story.capsules(tick.shown) for _, tick in story.ticks], "#7fa3dc", BLUE)
    p.box(0, 0, 480, 46, "none", PAPER, 0.86)
    p.text(14, 26, "tracked", ORANGE, weight="bold")
    p.text(86, 26, "shown", BLUE, weight="bold")
    for state, (words, color) in WORDS.items():
        if state in states:
            p.when([s == state for s in states], lambda: p.text(466, 26, words, color, "end", weight="bold"))
    p.box(0, 262, 480, 38, "none", PAPER, 0.86)
    p.text(14, 286, f"Tracked up to {1e3 * story.most:.0f} mm into the desk. All that is shown is proven free.", INK, size=13)
    return p


if __name__ == "__main__":
    drawn().write(NAME)

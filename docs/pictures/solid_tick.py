#!/usr/bin/env python3
"""Draws solid-tick.svg beside this file: one tick of a solid avatar, whose tracked hand is in a table. Needs the
package `foretouch` in PYTHONPATH. Every pose, contact, push and distance is an answer of the library.
"""
import numpy as np

import foretouch
from foretouch import SolidState

from concepts import BLUE, GREEN, INK, ORANGE, RED, WOOD, Picture
from table_and_cup import Plane

NAME = "solid-tick.svg"
LINKS = ["UpperArm", "ForeArm", "Hand"]
DT = 1 / 90
SWEEP = 0.08  # radians of the shoulder, in the last part of the story
ARROW = 6  # pushes are drawn so many times as long as they are
TICKS = 60


def make_arm():
    """The hand is level over the table, whose top is at y = 0."""
    return foretouch.Avatar.from_arrays(
        names=LINKS, parents=[-1, 0, 1], offsets=[[-0.02, 0.32, 0], [0.20, -0.16, 0], [0.19, -0.10, 0]], rotations=None,
        lss=[[((0, 0, 0), (0.19, -0.152, 0), 0.034)], [((0, 0, 0), (0.18, -0.095, 0), 0.026)],
             [((0, 0, 0), (0.12, -0.01, 0), 0.018)]])


def make_scene():
    return foretouch.Scene.from_arrays([[-2, 0, -2], [2, 0, -2], [2, 0, 2], [-2, 0, 2]], [[0, 1, 2], [0, 2, 3]],
                                       object_names=["table"])


def about_z(angle):
    return np.array([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])


class Story:
    """The arm comes down, presses, and sweeps along; the last tick is the picture's."""

    def __init__(self):
        self.avatar, self.scene = make_arm(), make_scene()
        solid = foretouch.SolidAvatar(self.avatar, self.scene)
        for i in range(TICKS + 1):
            down, along = min(1, i / 30), max(0, (i - 30) / 30)
            before = self.tick if i else None
            self.tracked = self.pose(down, along)
            self.tick = solid.follow(self.tracked, DT)
        self.before = before.shown

    def pose(self, down, along):
        rest = self.avatar.rest_pose()
        rest.rotations[0] = about_z(-0.42 * down + SWEEP * along)
        rest.rotations[1] = about_z(0.24 * down)
        rest.translations[0, 0] += 0.04 * along
        return rest

    def still(self, pose):
        return foretouch.Motion(self.avatar, pose, pose)

    def capsules(self, motion, t):
        """Per link both ends of its LSS in the picture's plane, and its radius."""
        for (lss,), place in zip(self.avatar.lss, motion.transforms(t)):
            yield [tuple((place[:3, :3] @ end + place[:3, 3])[:2]) for end in (lss.a, lss.b)] + [lss.radius]


def draw(p, story):
    plane, tick = Plane(70, 384, 900), story.tick
    plane.draw_table(p, 24, 696)
    p.box(24, plane.table + 13, 672, 24, "none", WOOD, 0.12)
    plane.draw_arm(p, story, story.still(story.tracked), 0, ORANGE, 0.18)
    plane.draw_arm(p, story, story.still(tick.shown), 0, BLUE, 0.34)
    for contact in tick.contacts:
        at = plane.at(contact.point)
        p.dot(at, 4, RED)
        long = ARROW * plane.scale * contact.push
        tip = (at[0] + long * contact.normal[0], at[1] - long * contact.normal[1])
        p.arrow(at, tip, RED, 2.4)
    p.text(24, 34, "One tick: the tracked hand is in the table, the shown one stays on it", INK, size=16, weight="bold")
    p.text(396, 76, "tracked", ORANGE, weight="bold")
    p.text(396, 95, "goes in; nothing is drawn of it", INK, size=13)
    p.text(396, 128, "shown", BLUE, weight="bold")
    p.text(396, 147, f"comes out: {tick.state.name.lower()}, {1e3 * tick.deviation:.0f} mm off", INK, size=13)
    p.text(396, 180, "push", RED, weight="bold")
    pushes = sum(contact.push for contact in tick.contacts)
    p.text(396, 199, f"how hard the user presses, here {1e3 * pushes:.1f} mm in all", INK, size=13)
    p.text(396, 216, f"(arrows: {ARROW} times as long); times a stiffness,", INK, size=13)
    p.text(396, 233, "the force for haptics", INK, size=13)
    p.text(690, plane.table + 30, "table", WOOD, "end", weight="bold")
    p.text(24, plane.table + 64, "The way since the tick before is proven free: at every instant of it, all links", GREEN)
    p.text(24, plane.table + 82, f"are at least {1e3 * tick.clearance:.2f} mm from the table.", GREEN)
    for i, (link, off) in enumerate(zip(LINKS, tick.link_deviation)):
        p.text(24 + 172 * i, plane.table + 108, f"{link}: {1e3 * off:.0f} mm off", INK, "start", 13)


def check(story):
    """The picture's words hold."""
    tick = story.tick
    assert tick.is_certified and tick.state == SolidState.SLIDING, tick
    assert tick.contacts and all(contact.object == "table" for contact in tick.contacts)
    query = foretouch.Query(story.avatar, story.scene, tolerance=1e-9)
    start = story.before
    for pose in tick.way:
        assert query.first_contacts(foretouch.Motion(story.avatar, start, pose)).is_clear
        start = pose
    tracked = query.first_contacts(story.still(story.tracked))
    assert tracked["Hand"].verdict == foretouch.Verdict.STARTS_IN_CONTACT


def drawn():
    story = Story()
    check(story)
    picture = Picture(720, 512, "One tick: the tracked hand is in the table, the shown one stays on it")
    draw(picture, story)
    return picture


if __name__ == "__main__":
    drawn().write(NAME)

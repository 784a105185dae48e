#!/usr/bin/env python3
"""Draws table-and-cup.svg beside this file: what a hand meets that rests on a table, and how it leaves. Needs the
package `foretouch` in PYTHONPATH. Every pose, instant, verdict, point and speed is an answer of the library.
"""
import math

import foretouch
from foretouch import Verdict

from concepts import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, RED, WOOD, Picture

NAME = "table-and-cup.svg"
TOLERANCE = 1e-3
LINKS = ["forearm", "palm", "fingers"]
IN_HAND = ("palm", "fingers")
CUP, CUP_RADIUS, CUP_HEIGHT = 0.536, 0.036, 0.095  # metres; its axis' x
SWEEP = 0.24  # metres along the table


# ---- The world: y up, the table's top at 0, the picture's plane at z = 0 ----

def make_arm():
    """Palm and fingers have the same distance from the table when the elbow is at its height."""
    return foretouch.Avatar.from_arrays(
        names=LINKS, parents=[-1, 0, 1], offsets=[[0, 0.13, 0], [0.20, -0.114, 0], [0.085, -0.007, 0]], rotations=None,
        lss=[[((0, 0, 0), (0.188, -0.092, 0), 0.026)], [((0, 0, 0), (0.080, 0, 0), 0.016)],
             [((0, 0, 0), (0.080, 0, 0), 0.009)]])


def make_scene(sides=32):
    corners = [[-1, 0, -1], [2, 0, -1], [2, 0, 1], [-1, 0, 1]]
    triangles, objects = [[0, 1, 2], [0, 2, 3]], [0, 0]
    for i in range(sides):
        # The cup's side. One of its edges faces the hand.
        angle = math.pi + 2 * math.pi * i / sides
        x, z = CUP + CUP_RADIUS * math.cos(angle), CUP_RADIUS * math.sin(angle)
        corners += [[x, 0, z], [x, CUP_HEIGHT, z]]
        low, next_low = 4 + 2 * i, 4 + 2 * ((i + 1) % sides)
        triangles += [[low, next_low, low + 1], [low + 1, next_low, next_low + 1]]
        objects += [1, 1]
    return foretouch.Scene.from_arrays(corners, triangles, objects, ["table", "cup"])


def moved(pose, x=0.0, y=0.0):
    translations = pose.translations.copy()
    translations[0] += [x, y, 0]
    return foretouch.Pose(pose.rotations, translations)


class Story:
    """What the library says: down to the table; along it; up again, or down."""

    def __init__(self):
        self.avatar, scene = make_arm(), make_scene()
        self.asked = foretouch.Query(self.avatar, scene, tolerance=TOLERANCE, scope="objects")
        self.passing = foretouch.Query(self.avatar, scene, tolerance=TOLERANCE, pass_separating=True)
        rest = self.avatar.rest_pose()
        self.above = moved(rest, 0, 0.06)
        down = foretouch.Motion(self.avatar, self.above, moved(rest, 0, -0.05))
        self.stop = self.asked.first_contacts(down).contacts[0]
        self.stopped = down.pose_at(self.stop.toi)
        self.sweep = foretouch.Motion(self.avatar, self.stopped, moved(self.stopped, SWEEP))
        self.met = {(c.link, c.object): c for c in self.asked.first_contacts(self.sweep).objects}
        retreat = foretouch.Motion(self.avatar, self.stopped, self.above)
        self.held = self.asked.first_contacts(retreat)
        self.free = self.passing.first_contacts(retreat)
        press = foretouch.Motion(self.avatar, self.stopped, moved(self.stopped, 0, -0.05))
        self.pressed = self.passing.first_contacts(press)

    def capsules(self, motion, t):
        """Per link both ends of its LSS in the picture's plane, and its radius."""
        for (lss,), place in zip(self.avatar.lss, motion.transforms(t)):
            yield [tuple((place[:3, :3] @ end + place[:3, 3])[:2]) for end in (lss.a, lss.b)] + [lss.radius]


# ---- The picture ----

class Plane:
    """From metres to pixels."""

    def __init__(self, left, table, scale):
        self.left, self.table, self.scale = left, table, scale

    def at(self, p):
        return (self.left + self.scale * p[0], self.table - self.scale * p[1])

    def draw_arm(self, picture, story, motion, t, color, opacity, outline=True):
        for a, b, radius in story.capsules(motion, t):
            picture.capsule(self.at(a), self.at(b), self.scale * radius, color, opacity, outline)

    def draw_table(self, picture, left, right):
        picture.box(left, self.table, right - left, 13, WOOD, WOOD, 0.45, 1.2)

    def draw_cup(self, picture):
        (left, top), (right, _) = self.at((CUP - CUP_RADIUS, CUP_HEIGHT)), self.at((CUP + CUP_RADIUS, 0))
        picture.path([(left, top), (left, self.table), (right, self.table), (right, top)], WOOD, 2, WOOD, 0.25)
        picture.parts.append(f'<ellipse cx="{0.5 * (left + right):.1f}" cy="{top:.1f}" rx="{0.5 * (right - left):.1f}" '
                             f'ry="6" fill="{PAPER}" stroke="{WOOD}" stroke-width="2"/>')
        picture.text(0.5 * (left + right), self.table - 22, "cup", WOOD, "middle", weight="bold")


def draw_sweep(p, story):
    plane = Plane(40, 244, 1000)
    first = min((c for (_, what), c in story.met.items() if what == "cup"), key=lambda c: c.toi)
    plane.draw_table(p, 24, 696)
    p.text(690, 273, "table", WOOD, "end", weight="bold")
    p.text(24, 274, "dots: the points of these contacts", BLUE, size=12)
    for i in range(1, 20):
        plane.draw_arm(p, story, story.sweep, first.toi * i / 20, ORANGE, 0.035, False)
    plane.draw_cup(p)
    plane.draw_arm(p, story, story.sweep, 0, BLUE, 0.30)
    plane.draw_arm(p, story, story.sweep, first.toi, RED, 0.10)
    for link in IN_HAND:
        for point in story.met[link, "table"].details().points:
            p.dot(plane.at(point.point), 3.2, BLUE)
    touch = plane.at(first.point)
    p.dot(touch, 4.5, RED)
    p.arrow((touch[0] - 2, touch[1] - 44), (touch[0] - 2 + 52 * first.normal[0], touch[1] - 44), ORANGE)
    p.line((touch[0] - 2, touch[1] - 6), (touch[0] - 2, touch[1] - 44), ORANGE, 1, "2 3")
    p.text(touch[0] - 58, touch[1] - 52, "normal", ORANGE, "middle", 12)
    p.text(24, 30, "A hand that rests on the table sweeps into the cup", INK, size=16, weight="bold")
    p.text(24, 60, "at t = 0 it rests,", BLUE)
    p.text(24, 77, f"{1e3 * story.met['palm', 'table'].separation:.2f} mm above the table", BLUE)
    p.text(392, 60, f"at t = {first.toi:.3f} its {first.link} meet the cup,", RED)
    p.text(392, 77, f"{1e3 * first.separation:.2f} mm from it, at {first.details().approach_speed:.2f} m per step", RED)


def draw_rows(p, story):
    left, right, top = 150.0, 696.0, 322.0
    p.text(24, top - 12, "scope objects: each link has its own first contact with each object", INK, size=13)
    rows = [(link, what) for what in ("table", "cup") for link in IN_HAND[::-1]]
    for i, row in enumerate(rows):
        y, contact = top + 27 * i, story.met[row]
        x = left + (right - left) * contact.toi
        p.text(left - 14, y + 15, f"{row[0]}, {row[1]}", INK, "end", 13)
        p.box(left, y, right - left, 20, FAINT, PAPER, 1, 1, 2, "4 3")
        if contact.toi > 0.0:
            p.box(left, y, x - left, 20, GREEN, GREEN, 0.35, 1.2, 2)
            p.text(0.5 * (left + x), y + 15, "proven free", INK, "middle", 12)
        p.line((x, y - 2), (x, y + 22), RED, 3)
        is_late = x > right - 90
        p.text(x - 8 if is_late else x + 8, y + 15, f"toi = {contact.toi:.3f}", RED, "end" if is_late else "start", 12)
    bottom = top + 27 * len(rows) + 10
    p.text(left, bottom, "t = 0", FAINT, size=12)
    p.text(right, bottom, "t = 1", FAINT, "end", 12)


def verdict(step):
    if step.is_clear:
        return "clear"
    contact = step.contacts[0]
    return f"{contact.verdict.name.lower()} at t = {contact.toi:g}"


def draw_leaving(p, story):
    top = 474.0
    p.text(24, top, "A stopped link that retreats is free", INK, size=16, weight="bold")
    panels = [("stopped where it touched", INK, [f"coming down: t = {story.stop.toi:.3f},",
                                                 f"{1e3 * story.stop.separation:.2f} mm above the table"], None),
              ("it retreats", GREEN, [f"passSeparating: {verdict(story.free)}", f"without: {verdict(story.held)}"], 1),
              ("it presses on", RED, [f"passSeparating: {verdict(story.pressed)}", "the same as without"], -1)]
    still = foretouch.Motion(story.avatar, story.stopped, story.stopped)
    for i, (title, color, lines, way) in enumerate(panels):
        plane = Plane(34 + 230 * i, top + 142, 450)
        plane.draw_table(p, 24 + 230 * i, 24 + 230 * i + 206)
        if way is None:
            above = foretouch.Motion(story.avatar, story.above, story.above)
            plane.draw_arm(p, story, above, 0, FAINT, 0.10)
        elif way > 0:
            plane.draw_arm(p, story, foretouch.Motion(story.avatar, story.stopped, story.above), 0.7, GREEN, 0.12)
        plane.draw_arm(p, story, still, 0, BLUE, 0.30)
        tip = plane.at((0.30, 0.045))
        if way is None:
            p.arrow((tip[0] + 50, tip[1] - 34), (tip[0] + 50, tip[1] + 6), FAINT)
        elif way > 0:
            p.arrow((tip[0] + 50, tip[1] + 6), (tip[0] + 50, tip[1] - 34), GREEN)
        else:
            p.arrow((tip[0] + 50, tip[1] - 34), (tip[0] + 50, tip[1] + 6), RED)
        p.text(24 + 230 * i, top + 28, title, color, weight="bold")
        for j, line in enumerate(lines):
            p.text(24 + 230 * i, top + 178 + 17 * j, line, color if j == 0 else INK, size=13)


def check(story):
    """The picture's words hold."""
    assert set(story.met) == {(link, what) for link in IN_HAND for what in ("table", "cup")}, story.met
    assert all(story.met[link, "table"].toi == 0.0 for link in IN_HAND)
    assert story.met["fingers", "cup"].toi < story.met["palm", "cup"].toi < 1.0
    assert story.free.is_clear and not story.held.is_clear
    assert story.pressed.contacts[0].verdict == Verdict.CONTACT and story.pressed.free_prefix == 0.0


def drawn():
    story = Story()
    check(story)
    picture = Picture(720, 690, "A hand that rests on a table and sweeps into a cup; then it retreats")
    for draw in (draw_sweep, draw_rows, draw_leaving):
        draw(picture, story)
    return picture


if __name__ == "__main__":
    drawn().write(NAME)

#!/usr/bin/env python3
"""Draws the pictures of docs/concepts.md as SVG, beside this file. Python 3 alone; the same bytes every time.

The curves are computed, not sketched: an arm in the plane swings towards a bar, distances are measured, and
conservative advancement is carried out.
"""
import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))
PAPER, INK, FAINT = "#faf9f5", "#22282f", "#8b929a"
BLUE, RED, ORANGE, GREEN, WOOD = "#2f62b5", "#c8321f", "#e07a1f", "#2f8f57", "#a58b6a"


class Picture:
    """An SVG with a ground of its own, so that it can be read on a dark page as well."""

    def __init__(self, width, height, title):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}" role="img" font-family="Helvetica, Arial, sans-serif" font-size="14">',
            f"<title>{title}</title>",
            f'<rect width="{width}" height="{height}" rx="10" fill="{PAPER}"/>',
        ]

    def text(self, x, y, words, color=INK, anchor="start", size=14, weight="normal"):
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" text-anchor="{anchor}" font-size="{size}" '
                          f'font-weight="{weight}">{words}</text>')

    def line(self, p, q, color=INK, width=1.5, dash=None, opacity=1.0, cap="round"):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<line x1="{p[0]:.1f}" y1="{p[1]:.1f}" x2="{q[0]:.1f}" y2="{q[1]:.1f}" stroke="{color}" '
                          f'stroke-width="{width:g}" stroke-linecap="{cap}" stroke-opacity="{opacity:g}"{dashes}/>')

    def path(self, points, color=INK, width=1.5, fill="none", opacity=1.0, closed=False, dash=None):
        data = "M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in points) + (" Z" if closed else "")
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<path d="{data}" fill="{fill}" fill-opacity="{opacity:g}" stroke="{color}" '
                          f'stroke-width="{width:g}" stroke-linejoin="round"{dashes}/>')

    def dot(self, p, radius=4, color=INK):
        self.parts.append(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius:g}" fill="{color}"/>')

    def circle(self, p, radius, color, width=1.5, fill="none", opacity=1.0, dash=None):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius:.1f}" fill="{fill}" '
                          f'fill-opacity="{opacity:g}" stroke="{color}" stroke-width="{width:g}"{dashes}/>')

    def box(self, x, y, width, height, color=INK, fill="none", opacity=1.0, stroke=1.5, radius=0, dash=None):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="{radius}" '
                          f'fill="{fill}" fill-opacity="{opacity:g}" stroke="{color}" stroke-width="{stroke:g}"{dashes}/>')

    def capsule(self, a, b, radius, color=BLUE, opacity=0.30, outline=True):
        """An LSS in the plane."""
        ux, uy = b[0] - a[0], b[1] - a[1]
        length = math.hypot(ux, uy)
        ux, uy = (ux / length, uy / length) if length else (1.0, 0.0)
        nx, ny = -uy * radius, ux * radius
        data = (f"M{a[0] + nx:.1f} {a[1] + ny:.1f} L{b[0] + nx:.1f} {b[1] + ny:.1f} "
                f"A{radius:.1f} {radius:.1f} 0 0 0 {b[0] - nx:.1f} {b[1] - ny:.1f} "
                f"L{a[0] - nx:.1f} {a[1] - ny:.1f} A{radius:.1f} {radius:.1f} 0 0 0 {a[0] + nx:.1f} {a[1] + ny:.1f} Z")
        stroke = f'stroke="{color}" stroke-width="1.5"' if outline else 'stroke="none"'
        self.parts.append(f'<path d="{data}" fill="{color}" fill-opacity="{opacity:g}" {stroke}/>')

    def arrow(self, p, q, color=INK, width=1.8):
        angle = math.atan2(q[1] - p[1], q[0] - p[0])
        self.line(p, (q[0] - 6 * math.cos(angle), q[1] - 6 * math.sin(angle)), color, width)
        wings = [(q[0] - 10 * math.cos(angle + s), q[1] - 10 * math.sin(angle + s)) for s in (0.4, -0.4)]
        self.path([q] + wings, color, 1, color, 1.0, True)

    def svg(self):
        return "\n".join(self.parts + ["</svg>"]) + "\n"

    def write(self, name):
        with open(os.path.join(FOLDER, name), "w", encoding="utf-8", newline="\n") as file:
            file.write(self.svg())


def nearest_on_segment(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    s = 0.0 if square == 0 else max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square))
    return (a[0] + s * dx, a[1] + s * dy)


class Arm:
    """Upper arm and forearm in the plane; both joints turn at constant rate over t in [0,1]. Pixels, y down."""

    shoulder, upper, fore = (120.0, 240.0), 110.0, 125.0
    radius_upper, radius_fore = 18.0, 13.0
    first, last = (-80.0, 35.0), (8.0, 62.0)  # degrees: shoulder from the horizontal, elbow from the upper arm

    def joints(self, t):
        shoulder, elbow = (math.radians(a + t * (b - a)) for a, b in zip(self.first, self.last))
        e = (self.shoulder[0] + self.upper * math.cos(shoulder), self.shoulder[1] + self.upper * math.sin(shoulder))
        angle = shoulder + elbow
        return self.shoulder, e, (e[0] + self.fore * math.cos(angle), e[1] + self.fore * math.sin(angle))

    def separation(self, t, bar):
        """Of the forearm from a round bar."""
        _, e, h = self.joints(t)
        n = nearest_on_segment(bar[0], e, h)
        return math.dist(n, bar[0]) - bar[1] - self.radius_fore

    def speed_bound(self):
        """No point of the forearm is faster (pixels per unit of t): the turns' rates times the chain's lengths."""
        rates = [math.radians(abs(b - a)) for a, b in zip(self.first, self.last)]
        return rates[0] * (self.upper + self.fore) + rates[1] * self.fore

    def draw(self, picture, t, opacity=0.30, color=BLUE):
        s, e, h = self.joints(t)
        picture.capsule(s, e, self.radius_upper, color, opacity)
        picture.capsule(e, h, self.radius_fore, color, opacity)


BAR = ((318.0, 246.0), 8.0)


def draw_lss():
    p = Picture(720, 260, "A line-swept sphere and a triangle")
    a, b, r = (110.0, 165.0), (330.0, 95.0), 42.0
    p.capsule(a, b, r)
    p.line(a, b, BLUE, 2)
    for end, name, dx in ((a, "a", -16), (b, "b", 10)):
        p.dot(end, 4, BLUE)
        p.text(end[0] + dx, end[1] + 5, name, BLUE, weight="bold")
    p.line(a, (a[0] - 13.0, a[1] - 40.0), FAINT, 1.5, "4 3")
    p.text(a[0] - 26, a[1] - 12, "r", FAINT)
    triangle = [(452.0, 118.0), (560.0, 60.0), (600.0, 190.0)]
    p.path(triangle, WOOD, 2, WOOD, 0.35, True)
    on_scene = triangle[0]
    away = math.dist(b, on_scene)
    n = ((b[0] - on_scene[0]) / away, (b[1] - on_scene[1]) / away)
    on_link = (b[0] - r * n[0], b[1] - r * n[1])
    p.line(on_link, on_scene, RED, 2)
    p.dot(on_link, 4, RED)
    p.dot(on_scene, 4, RED)
    p.text(0.5 * (on_link[0] + on_scene[0]), on_scene[1] - 18, "separation", RED, "middle")
    p.arrow((on_scene[0], on_scene[1] + 28), (on_scene[0] + 62 * n[0], on_scene[1] + 28 + 62 * n[1]), ORANGE)
    p.text(on_scene[0] - 60, on_scene[1] + 108, "normal: from the scene to the link", ORANGE)
    p.text(110, 240, "LSS: all points within r of the axis a b", BLUE)
    p.text(512, 136, "triangle", WOOD, weight="bold")
    p.write("lss.svg")


def draw_sweep():
    p = Picture(720, 420, "What an arm sweeps between two poses")
    arm = Arm()
    for i in range(41):
        _, e, h = arm.joints(i / 40)
        p.capsule(e, h, arm.radius_fore, ORANGE, 0.05, False)
    for t in (0.0, 1.0):
        arm.draw(p, t, 0.35)
    straight = [tuple(x0 + (x1 - x0) * t for x0, x1 in zip(arm.joints(0)[2], arm.joints(1)[2])) for t in (0, 1)]
    p.line(straight[0], straight[1], FAINT, 1.8, "6 4")
    p.path([arm.joints(i / 60)[2] for i in range(61)], ORANGE, 2.2)
    p.circle(BAR[0], BAR[1], RED, 2, RED, 0.8)
    touching = first_contact(arm)
    s, e, h = arm.joints(touching)
    p.capsule(e, h, arm.radius_fore, RED, 0.10)
    p.text(60, 60, "earlier pose", BLUE)
    p.text(196, 398, "later pose", BLUE, "end")
    p.text(BAR[0][0] + 36, BAR[0][1] - 12, f"a bar: touched first at t = {touching:.2f},", RED)
    p.text(BAR[0][0] + 36, BAR[0][1] + 6, "free at both poses", RED)
    p.text(390, 100, "the hand's true way: each joint", ORANGE)
    p.text(390, 118, "turns at constant rate", ORANGE)
    p.text(390, 340, "dashed: where a straight line between", FAINT)
    p.text(390, 358, "the poses would take the hand", FAINT)
    p.write("sweep.svg")


def first_contact(arm):
    low = 0.0
    while arm.separation(low, BAR) > 0.0:
        low += 1e-4
    return low


def draw_culling():
    p = Picture(720, 450, "Culling: certified boxes of what moves, against a tree of boxes over the scene")
    arm = Arm()
    pieces = 4
    for k in range(pieces):
        corners = []
        for i in range(11):
            _, e, h = arm.joints((k + i / 10) / pieces)
            corners += [e, h]
        low = [min(c[i] for c in corners) - arm.radius_fore - 6 for i in (0, 1)]
        high = [max(c[i] for c in corners) + arm.radius_fore + 6 for i in (0, 1)]
        p.box(low[0], low[1], high[0] - low[0], high[1] - low[1], BLUE, BLUE, 0.07, 1.3, 3)
        for i in range(11):
            _, e, h = arm.joints((k + i / 10) / pieces)
            p.capsule(e, h, arm.radius_fore, ORANGE, 0.04, False)
    groups = [((296, 228, 60, 36), True), ((430, 60, 110, 90), False), ((590, 90, 90, 130), False),
              ((560, 266, 120, 74), False)]
    p.box(290, 48, 402, 304, WOOD, "none", 1, 1.3, 3, "6 4")
    p.text(684, 40, "the tree's root", WOOD, "end")
    for (x, y, w, h), is_near in groups:
        p.box(x, y, w, h, RED if is_near else WOOD, "none", 1, 1.6, 3)
        for i in range(4):
            cx, cy = x + w * (0.22 + 0.18 * i), y + h * (0.35 + 0.12 * (i % 3))
            s = 0.13 * min(w, h) + 4
            p.path([(cx, cy - s), (cx + s, cy + s), (cx - s, cy + 0.7 * s)], RED if is_near else WOOD, 1.2,
                   RED if is_near else WOOD, 0.35, True)
    p.text(370, 230, "meets a box: a candidate", RED)
    p.text(560, 256, "met by no box: never looked at", WOOD, "middle", 13)
    p.text(30, 436, "Boxes certified to hold a link over a piece of the step (blue) go down the tree in one walk.", INK, size=13)
    p.write("culling.svg")


def advancement(arm, tolerance):
    """The instants of conservative advancement, and the separation at each."""
    steps, t = [], 0.0
    while True:
        g = arm.separation(t, BAR)
        steps.append((t, g))
        if g <= tolerance or t >= 1.0:
            return steps
        t = min(1.0, t + g / arm.speed_bound())


def draw_backtracking():
    p = Picture(720, 380, "Backtracking: from one proven-free instant to the next")
    arm, tolerance = Arm(), 3.0
    left, right, base, top, most, until = 70.0, 690.0, 300.0, 40.0, 200.0, 0.92

    def at(t, g):
        return (left + (right - left) * t / until, base - (base - top) * g / most)

    curve = [(t, arm.separation(t, BAR)) for t in (until * i / 240 for i in range(241))]
    p.line(at(0, 0), at(until, 0), INK, 1.5)
    p.line(at(0, 0), at(0, most), INK, 1.5)
    p.text(right, base + 24, "t", INK, "end")
    p.text(left - 10, top - 12, "separation of this pair", INK)
    p.line(at(0, tolerance), at(until, tolerance), GREEN, 1.5, "5 4")
    p.text(right, at(0, tolerance)[1] - 6, "tolerance", GREEN, "end")
    p.path([at(t, g) for t, g in curve if g >= 0.0 and t < 0.9 * first_contact(arm) + 0.1], ORANGE, 2.4)
    steps = advancement(arm, tolerance)
    for (t, g), (t1, _) in zip(steps, steps[1:]):
        p.line(at(t, g), at(t1, 0), BLUE, 1.3, None, 0.8)
        p.line(at(t1, 0), at(t1, arm.separation(t1, BAR)), BLUE, 1.0, "3 3", 0.8)
    for t, g in steps:
        p.dot(at(t, g), 3.6, BLUE)
    toi = steps[-1][0]
    p.line(at(toi, 0), (at(toi, 0)[0], base + 8), RED, 2)
    p.text(at(toi, 0)[0] + 2, base + 24, f"toi = {toi:.3f}", RED, "end", weight="bold")
    hit = first_contact(arm)
    p.line(at(hit, 0), (at(hit, 0)[0], base + 8), ORANGE, 2)
    p.text(at(hit, 0)[0] + 8, base + 24, "true contact: never before toi", ORANGE)
    p.text(at(0.2, 0)[0], at(0, 185)[1], "blue: no point of the link is faster than this slope allows,", BLUE)
    p.text(at(0.2, 0)[0], at(0, 171)[1], "so until there the pair is free, whatever the true curve does", BLUE)
    p.text(at(0.42, 0)[0], at(0, 112)[1], "the true separation", ORANGE)
    p.text(left, 364, f"{len(steps)} evaluations. The slope is a bound on speed along the whole chain of joints.", INK, size=13)
    p.write("backtracking.svg")


def draw_exact():
    p = Picture(720, 280, "Exact leaves: the LSS is met, the mesh in it is not")
    for x0, reach, verdict, color in ((40.0, 0.0, "link fidelity: contact; exact: clear", GREEN),
                                      (390.0, 50.0, "exact: contact, later than the LSS'", RED)):
        a, b, r = (x0 + 60, 130.0), (x0 + 210, 130.0), 56.0
        p.capsule(a, b, r, BLUE, 0.13)
        mesh = [(x0 + 8, 128), (x0 + 30, 104), (x0 + 80, 96), (x0 + 140, 104), (x0 + 200, 96), (x0 + 258, 116),
                (x0 + 262, 132), (x0 + 232, 150), (x0 + 150, 158), (x0 + 80, 164), (x0 + 26, 152)]
        p.path(mesh, INK, 1.4, "#9aa7b5", 0.7, True)
        for i in range(1, len(mesh) - 2):
            p.line(mesh[0], mesh[i + 1], INK, 0.5, None, 0.35)
        x = x0 + 225
        bar = [(x, 30.0), (x + 16, 26.0), (x + 6, 76.0 + reach * 0.52)]
        p.path(bar, color, 2, color, 0.35, True)
        p.text(x0 + 130, 226, verdict, color, "middle", weight="bold")
    p.text(40, 262, "Blue: the LSS. Grey: the mesh that it contains. Every triangle of a link lies in one of its LSS.", INK, size=13)
    p.write("exact.svg")


def draw_verdicts():
    p = Picture(720, 250, "The four verdicts")
    rows = [("clear", [(0.0, 1.0, GREEN, "proven free")]),
            ("contact", [(0.0, 0.41, GREEN, "proven free"), (0.41, 1.0, None, "not asked: the first contact is what is told")]),
            ("starts_in_contact", [(0.0, 1.0, None, "touching already; the other links are answered all the same")]),
            ("undecided", [(0.0, 0.62, GREEN, "proven free"), (0.62, 1.0, None, "nothing is claimed")])]
    left, right = 180.0, 690.0
    for i, (name, parts) in enumerate(rows):
        y = 30 + 50 * i
        p.text(left - 14, y + 19, name, INK, "end", weight="bold")
        for begin, end, color, words in parts:
            x0, x1 = left + (right - left) * begin, left + (right - left) * end
            p.box(x0, y, x1 - x0, 28, color or FAINT, color or PAPER, 0.35 if color else 1, 1.2, 2, None if color else "4 3")
            p.text(0.5 * (x0 + x1), y + 19, words, INK, "middle", 13)
        mark = {"contact": 0.41, "starts_in_contact": 0.0, "undecided": 0.62}.get(name)
        if mark is not None:
            x = left + (right - left) * mark
            p.line((x, y - 5), (x, y + 33), RED if name != "undecided" else ORANGE, 3)
            label = {"contact": "toi", "starts_in_contact": "toi = 0", "undecided": "free_until"}[name]
            p.text(x + 4, y - 5, label, RED if name != "undecided" else ORANGE, size=12)
    p.text(left, 238, "t = 0, the earlier pose", FAINT, size=12)
    p.text(right, 238, "t = 1, the later pose", FAINT, "end", 12)
    p.write("verdicts.svg")


if __name__ == "__main__":
    for draw in (draw_lss, draw_sweep, draw_culling, draw_backtracking, draw_exact, draw_verdicts):
        draw()

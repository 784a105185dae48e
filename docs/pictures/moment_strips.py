#!/usr/bin/env python3
"""Draws strips of the ugliest moments of a solid avatar, as `solid_moments` has written them: moment_strips.py FOLDER.
Shown in blue, its worst link in red, tracked in orange behind it; from the front and from the side. PNG where there is
a Chromium, else SVG alone."""
import json
import os
import subprocess
import sys

import browser
from concepts import BLUE, FAINT, INK, ORANGE, RED, WOOD, Picture
from moving import View

AROUND = (-12, -4, -2, -1, 0, 1, 2, 4, 12)  # ticks from the moment
WIDTH, HEIGHT, TOP, REACH = 220, 300, 60, 1.1  # pixels of a frame, and metres from its middle that it shows
LEAST = 1.5  # pixels: what is smaller is left out
SIDES = ((-0.35, -0.3, -1.0), (-1.0, -0.3, 0.35))


def middle_of(axes):
    ends = [end for a, b, *_ in axes for end in (a, b)]
    return [0.5 * (min(c) + max(c)) for c in zip(*ends)]


def draw_body(picture, view, axes, color, worst=None, opacity=1.0):
    """Far LSS first; without perspective, one is a line with round ends."""
    for a, b, radius, link in sorted(axes, key=lambda axis: -sum(view.depth(end) for end in axis[:2])):
        p, q = view.at(a), view.at(b)
        q = (q[0] + 0.1, q[1])  # a line of no length is not drawn
        if opacity == 1.0:
            picture.line(p, q, INK, 2 * radius * view.scale + 1.5)
        picture.line(p, q, RED if link == worst else color, 2 * radius * view.scale, opacity=opacity)


def view_of(middle, side, left, top):
    return View(side, middle, 0.5 * HEIGHT / REACH, (left + 0.5 * WIDTH, top + 0.5 * HEIGHT))


def is_seen(corners, top):
    """Within the frame, and no dot."""
    (left, right), (above, below) = ((min(c), max(c)) for c in zip(*corners))
    return (right > 0 and left < WIDTH and below > top and above < top + HEIGHT
            and max(right - left, below - above) > LEAST)


def draw_surroundings(picture, moment, middle, side, row, top):
    """Once for all frames of a row, which use it."""
    view = view_of(middle, side, 0, top)
    near = view.depth(middle)
    picture.parts.append(f'<defs><g id="row{row}">')
    for triangle in sorted(moment["triangles"], key=lambda corners: -sum(map(view.depth, corners))):
        corners = [view.at(corner) for corner in triangle]
        if is_seen(corners, top):
            is_before = sum(map(view.depth, triangle)) < 3 * near
            picture.path(corners, FAINT, 0.5, WOOD, 0.03 if is_before else 0.12, True)
    picture.parts.append("</g></defs>")


def draw_frame(picture, moment, frame, middle, row, left, top):
    view = view_of(middle, SIDES[row], left, top)
    picture.parts.append(f'<svg x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" '
                         f'viewBox="{left} {top} {WIDTH} {HEIGHT}"><use href="#row{row}" x="{left}"/>')
    draw_body(picture, view, frame["tracked"], ORANGE, opacity=0.35)
    draw_body(picture, view, frame["shown"], BLUE, moment["link"])
    picture.parts.append("</svg>")


def strip_of(moment):
    at = next(i for i, frame in enumerate(moment["frames"]) if frame["tick"] == moment["tick"])
    frames = [moment["frames"][i] for i in (at + offset for offset in AROUND) if 0 <= i < len(moment["frames"])]
    words = (f'{moment["link"]}: {moment["measure"]}, {moment["value"]:.3g} {moment["unit"]} '
             f'(tick {moment["tick"]}, {moment["time"]:.3f} s, {moment["state"]})')
    picture = Picture(WIDTH * len(frames), TOP + len(SIDES) * HEIGHT, words)
    picture.text(10, 24, words, size=18, weight="bold")
    middle = middle_of(moment["frames"][at]["shown"])
    for row, side in enumerate(SIDES):
        draw_surroundings(picture, moment, middle, side, row, TOP + row * HEIGHT)
    for i, frame in enumerate(frames):
        is_it = frame["tick"] == moment["tick"]
        picture.text(i * WIDTH + 10, TOP - 10, f'{frame["tick"] - moment["tick"]:+d}', RED if is_it else INK)
        for row in range(len(SIDES)):
            draw_frame(picture, moment, frame, middle, row, i * WIDTH, TOP + row * HEIGHT)
    return picture, (WIDTH * len(frames), TOP + len(SIDES) * HEIGHT)


def main(folder):
    with open(os.path.join(folder, "moments.json"), encoding="utf-8") as file:
        moments = json.load(file)
    for i, moment in enumerate(moments):
        picture, size = strip_of(moment)
        path = os.path.join(os.path.abspath(folder), f"{i:02}")
        with open(path + ".svg", "w", encoding="utf-8") as file:
            file.write(picture.svg())
        try:
            subprocess.run([browser.program(), "--headless=new", "--no-sandbox", "--hide-scrollbars",
                            f"--window-size={size[0]},{size[1]}", f"--screenshot={path}.png", f"file://{path}.svg"],
                           check=True, stderr=subprocess.DEVNULL)
        except SystemExit as missing:
            print(f"{missing}: SVG alone", file=sys.stderr)


main(sys.argv[1])

#!/usr/bin/env python3
"""Draws godot.svg and unity.svg beside this file, of what the integrations' tests play: engines.py BUILD. The demo of
Godot runs in godot3-server, the sample of Unity in Mono, in the player of its tests; neither has a screen. Where one
is absent, says so and leaves its picture as it is.
"""
import math
import pathlib
import subprocess
import sys

from concepts import BLUE, GREEN, INK, ORANGE, PAPER, WOOD
from moving import Film, numbers

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent


def film(build, script):
    """Rows of numbers; None where the host is absent."""
    done = subprocess.run([SOURCE / script, build / "bindings/c", build / "bin/foretouch-import",
                           build / "share/foretouch/examples", "--film"], capture_output=True, text=True, check=False)
    if done.returncode == 77:
        print(f"pictures: {done.stdout.strip()}: its picture stays as it is", file=sys.stderr)
        return None
    rows = [[float(word) for word in line.split()] for line in done.stdout.splitlines()]
    assert done.returncode == 0 and len(rows) > 100, done.stdout + done.stderr
    return rows


def moving_lines(p, ends, width, color, opacity=1.0):
    """A line without round ends that moves."""
    names = ("x1", "y1", "x2", "y2")
    tracks = dict(zip(names, zip(*((*a, *b) for a, b in ends))))
    first = " ".join(f'{name}="{track[0]:.1f}"' for name, track in tracks.items())
    parts = "".join(p.animated(name, numbers(track)) for name, track in tracks.items())
    p.parts.append(f'<line {first} stroke="{color}" stroke-width="{width:g}" stroke-opacity="{opacity:g}">{parts}</line>')


def tracked_and_shown(p, ways, radius, width, words):
    """Two capsules by their ends over time, and what the picture is of."""
    tracked, shown = ways
    p.parts.append('<g opacity="0.5">')
    p.capsule_through(tracked, radius, ORANGE)
    p.parts.append("</g>")
    p.capsule_through(shown, radius, "#7fa3dc", BLUE)
    p.box(0, 0, width, 40, "none", PAPER, 0.86)
    p.text(14, 26, "tracked", ORANGE, weight="bold")
    p.text(86, 26, "shown", BLUE, weight="bold")
    p.text(width - 14, 26, words, INK, "end", size=13)


def godot(rows):
    """From above: bars of a railing, a button in its wall, a door on its hinge (the demo's main.tscn)."""
    every = 4
    rows = rows[2::every]
    p = Film(560, 320, "Godot's demo from above: a hand goes between bars, presses a button, pushes a door", len(rows) * every / 60, len(rows))
    scale = 240

    def at(x, z):
        return 110 + scale * x, 300 + scale * z

    for x in (-0.25, -0.05, 0.15, 0.35):
        px, py = at(x, -0.4)
        p.box(px - 0.01 * scale, py - 0.01 * scale, 0.02 * scale, 0.02 * scale, WOOD, WOOD)
    px, py = at(0.5, -0.47)
    p.box(px, py, 0.3 * scale, 0.02 * scale, WOOD, WOOD, 0.6)
    button = [(at(0.65, z - 0.03), at(0.65, z + 0.03)) for *_, z in rows]
    moving_lines(p, button, 0.08 * scale, GREEN)
    door = []
    for row in rows:
        turn = math.radians(row[4])
        door.append((at(1.0, -0.4), at(1.0 + 0.6 * math.cos(turn), -0.4 - 0.6 * math.sin(turn))))
    moving_lines(p, door, 0.03 * scale, WOOD)
    p.dot(at(1.0, -0.4), 4, INK)

    hands = [[(at(row[column], row[column + 1] - 0.03), at(row[column], row[column + 1] + 0.27)) for row in rows] for column in (0, 2)]
    tracked_and_shown(p, hands, 0.03 * scale, 560, "between bars, at a button, through a door that gives way")
    p.write("godot.svg")


def unity(rows):
    """From the side: a ball is led into a desk and along it (Samples~/HandOnDesk)."""
    every = 2
    rows = rows[::every]
    p = Film(480, 260, "Unity's sample: the tracked hand goes into the desk, the shown one stays on it", len(rows) * every / 50, len(rows))
    scale = 260

    def at(x, y):
        return 240 + scale * x, 170 - scale * y

    px, py = at(-0.8, 0.02)
    p.box(px, py, 1.6 * scale, 0.04 * scale, WOOD, WOOD, 0.6)

    balls = [[(at(row[column], row[column + 1]),) * 2 for row in rows] for column in (0, 2)]
    tracked_and_shown(p, balls, 0.05 * scale, 480, "the sample Hand on a desk")
    p.write("unity.svg")


def main(build):
    for draw, script in ((godot, "integrations/godot/tests/godot_test.sh"), (unity, "integrations/dotnet/tests/dotnet_test.sh")):
        rows = film(build, script)
        if rows is not None:
            draw(rows)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())

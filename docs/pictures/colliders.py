#!/usr/bin/env python3
"""Draws colliders.svg beside this file: the bundled avatar as the colliders that a file for Unity states, at rest:
colliders.py FORETOUCH. Every capsule is placed by what is in the file."""
import json
import pathlib
import subprocess
import sys
import tempfile

from concepts import BLUE, FAINT, INK, Picture

SCALE, MIDDLE = 190, (230, 385)


def turned(q, v):
    """By a unit quaternion (x, y, z, w)."""
    x, y, z, w = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]]


def times(p, q):
    (a, b, c, d), (x, y, z, w) = p, q
    return (d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z)


def vector(said):
    return [said["x"], said["y"], said["z"]]


def quaternion(said):
    return (said["x"], said["y"], said["z"], said["w"])


def frames_of(joints):
    frames = {"": ((0, 0, 0, 1), [0, 0, 0])}
    for joint in joints:
        turn, place = frames[joint["parent"]]
        offset = turned(turn, vector(joint["position"]))
        frames[joint["name"]] = (times(turn, quaternion(joint["rotation"])), [a + b for a, b in zip(place, offset)])
    return frames


def main(program):
    example = pathlib.Path(program).resolve().parent / "../share/foretouch/examples/dancer.avatar.json"
    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder, "colliders.json")
        subprocess.run([program, "avatar", "colliders", example, "-o", made], check=True, stdout=subprocess.DEVNULL)
        file = json.loads(made.read_text())
    frames = frames_of(file["joints"])
    p = Picture(460, 420, "The capsules of the bundled avatar, as colliders")
    placed = []
    for one in file["colliders"]:
        turn, place = frames[one["joint"]]
        half = one["height"] / 2 - one["radius"]
        along = turned(quaternion(one["rotation"]), [0, half, 0])
        ends = [[c + s * d for c, d in zip(vector(one["center"]), along)] for s in (-1, 1)]
        ends = [[a + b for a, b in zip(place, turned(turn, end))] for end in ends]
        placed.append((max(end[2] for end in ends), ends, one["radius"]))
    for _, ends, radius in sorted(placed, key=lambda each: -each[0]):
        a, b = [(MIDDLE[0] + SCALE * end[0], MIDDLE[1] - SCALE * end[1]) for end in ends]
        p.capsule(a, b, SCALE * radius, BLUE, 0.22)
    for name, (_, place) in frames.items():
        if name:
            p.dot((MIDDLE[0] + SCALE * place[0], MIDDLE[1] - SCALE * place[1]), 2.5, INK)
    p.line((40, MIDDLE[1] + 4), (420, MIDDLE[1] + 4), FAINT, 1)
    p.write("colliders.svg")


main(sys.argv[1])

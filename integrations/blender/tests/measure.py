"""How long a check of 10,000 frames takes: run.sh BUILD measure. Not a test: machines differ."""

import os
import sys
import time

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from blend import example, finished, fresh  # noqa: E402
from test_replay import AVATAR, imported_dancer, imported_room  # noqa: E402

FRAMES = 10_000


def repeated(rig, scene):
    """The action again and again, until the last frame."""
    for curve in rig.animation_data.action.fcurves:
        curve.modifiers.new("CYCLES")
    scene.foretouch.frames, scene.frame_start, scene.frame_end = "SCENE", 1, FRAMES


def timed(name, scene):
    begin = time.perf_counter()
    finished(bpy.ops.foretouch.check)
    took = time.perf_counter() - begin
    print(f"MEASURED {name}: {took:.2f} s for {FRAMES} frames, {len(scene.foretouch.touches)} touches")


def main():
    scene = fresh()
    rig, room = imported_dancer(scene), imported_room(scene)
    asked = scene.foretouch
    asked.body, asked.against, asked.body_from, asked.avatar_file = rig, room, "FILE", str(AVATAR)
    repeated(rig, scene)
    timed("dancer, 26 bones, among 105,914 triangles", scene)
    scene, rig = example()
    repeated(rig, scene)
    timed("skinned arm of the example", scene)


main()

"""What the tests share: the add-on, the example scene, an empty file, and what a file holds."""

import os
import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
BUILD = Path(os.environ["FORETOUCH_BUILD"])
PROGRAM = BUILD / "bin" / "foretouch"
EXAMPLES = BUILD / "share" / "foretouch" / "examples"
os.environ["FORETOUCH_PACKAGES"] = str(BUILD / "lib" / "python3" / "dist-packages")
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "example")]

import addon_utils  # noqa: E402

import make_scene  # noqa: E402

ADDON = "foretouch_blender"


def fresh():
    """An empty file with the add-on. Returns its scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if addon_utils.enable(ADDON) is None:
        raise AssertionError("the add-on cannot be enabled")
    return bpy.context.scene


def example():
    """The example scene. Returns the scene and the armature."""
    scene = fresh()
    return scene, make_scene.make(scene)


def finished(operator, **options):
    """Runs it; an error is a RuntimeError with the text that the user sees."""
    result = operator(**options)
    if result != {"FINISHED"}:
        raise AssertionError(f"{operator} answers {result}")


def drained(work):
    """What a generator returns."""
    while True:
        try:
            next(work)
        except StopIteration as stop:
            return stop.value


KINDS = ("objects", "meshes", "collections", "actions", "scenes", "armatures", "materials", "curves",
         "node_groups", "images", "texts", "worlds")


def contents(scene):
    """All that the file holds, by name, with the scene's markers and properties."""
    held = {kind: sorted(each.name for each in getattr(bpy.data, kind)) for kind in KINDS}
    held["markers"] = sorted((marker.name, marker.frame) for marker in scene.timeline_markers)
    held["touches"] = len(scene.foretouch.touches)
    held["frame"] = scene.frame_current_final
    held["selected"] = sorted(thing.name for thing in bpy.context.selected_objects)
    return held


def touches(scene):
    return [(t.link, t.object, t.begin, t.end) for t in scene.foretouch.touches]

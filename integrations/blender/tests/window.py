"""The add-on in a window: the bar moves, Esc cancels and leaves nothing, the panel is drawn. Run by run.sh,
with --enable-event-simulate, in a virtual display; the last line says how it went."""

import os
import sys
import traceback

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from blend import contents, fresh, make_scene, touches  # noqa: E402

FRAMES = 20_000  # some seconds


def slow(scene, rig):
    for curve in rig.animation_data.action.fcurves:
        curve.modifiers.new("CYCLES")
    scene.foretouch.frames, scene.frame_end = "SCENE", FRAMES


def until(holds, most=2000):
    for _ in range(most):
        if holds():
            return
        yield 0.01
    raise AssertionError(f"it did not come to pass: {holds.__doc__ or holds}")


def steps():
    """Each yield lets the window work for so many seconds."""
    fresh()
    yield 0.5
    scene, manager = bpy.data.scenes[0], bpy.context.window_manager
    window = manager.windows[0]
    with bpy.context.temp_override(window=window):
        rig = make_scene.make(scene)
        # The panel is drawn where the sidebar is open.
        area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
        area.spaces.active.show_region_ui = True
        yield 0.5
        slow(scene, rig)
        before = contents(scene)
        assert bpy.ops.foretouch.check("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        yield from until(lambda: manager.foretouch_progress > 5)
        first = manager.foretouch_progress
        yield from until(lambda: manager.foretouch_progress > first)
        assert manager.foretouch_progress < 100
        window.event_simulate(type="ESC", value="PRESS")
        yield from until(lambda: manager.foretouch_progress < 0)
        assert contents(scene) == before, (contents(scene), before)
        for curve in rig.animation_data.action.fcurves:
            curve.modifiers.remove(curve.modifiers[0])
        scene.foretouch.frames, scene.frame_end = "ACTION", 23
        assert bpy.ops.foretouch.check("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        yield from until(lambda: len(touches(scene)) == 4)
        yield from until(lambda: manager.foretouch_progress < 0)
        scene.foretouch.active = 0  # as a click in the list
        assert abs(scene.frame_current_final - touches(scene)[0][2]) < 1e-3
        yield 0.3
        bpy.ops.ed.undo_push(message="list")
        bpy.ops.foretouch.clear("INVOKE_DEFAULT")
        assert touches(scene) == []


def run():
    try:
        return next(RUNNING)
    except StopIteration:
        print("WINDOW passed", flush=True)
    except Exception:
        traceback.print_exc()
        print("WINDOW failed", flush=True)
    bpy.ops.wm.quit_blender()


RUNNING = steps()
bpy.app.timers.register(run, first_interval=1.0, persistent=True)

"""A picture of the add-on at work, in a window: blender --enable-event-simulate --python picture.py -- PICTURE.png

Of the example scene: the touches in the list and on the timeline, empties at the contacts, and what the
hand sweeps.
"""

import os
import sys
import traceback

import bpy

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), HERE]
import addon_utils  # noqa: E402

import make_scene  # noqa: E402

PICTURE = os.path.abspath(sys.argv[sys.argv.index("--") + 1])


def areas(window, kind):
    return [area for area in window.screen.areas if area.type == kind]


def look(window, area):
    """From the front, above, at the board."""
    from mathutils import Euler, Vector
    space = area.spaces.active
    space.show_region_ui, space.show_region_toolbar = True, False
    space.overlay.show_cursor = space.overlay.show_floor = space.overlay.show_axis_x = False
    space.overlay.show_axis_y = space.overlay.show_relationship_lines = False
    space.shading.color_type = "OBJECT"
    space.shading.show_xray = True
    space.shading.xray_alpha = 0.75
    view = space.region_3d
    view.view_perspective, view.view_distance = "PERSP", 1.6
    view.view_location = Vector((0.62, 0.0, 0.97))
    view.view_rotation = Euler((1.0, 0.0, -0.6)).to_quaternion()


def open_tab(window, area):
    """A click where the sidebar has the add-on's tab: the lowest one."""
    (sidebar,) = [region for region in area.regions if region.type == "UI"]
    for below in range(20, 400, 12):
        place = {"x": sidebar.x + sidebar.width - 8, "y": sidebar.y + sidebar.height - below}
        window.event_simulate(type="MOUSEMOVE", value="NOTHING", **place)
        window.event_simulate(type="LEFTMOUSE", value="PRESS", **place)
        window.event_simulate(type="LEFTMOUSE", value="RELEASE", **place)
        yield 0.05


def steps():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("foretouch_blender")
    yield 0.5
    scene = bpy.data.scenes[0]
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window):
        rig = make_scene.make(scene)
        rig.data.bones.active = rig.data.bones["Hand"]
        bpy.data.objects["Arm"].color = (0.45, 0.65, 0.95, 1.0)
        bpy.data.objects["Board"].color = (0.75, 0.6, 0.4, 1.0)
        bpy.ops.foretouch.check("EXEC_DEFAULT")
        bpy.ops.foretouch.sweep("EXEC_DEFAULT", of_bone=True)
        scene.foretouch.active = 1
        bpy.data.objects["Floor"].hide_set(True)
        area = areas(window, "VIEW_3D")[0]
        look(window, area)
        timeline = areas(window, "DOPESHEET_EDITOR")[0]
        region = next(region for region in timeline.regions if region.type == "WINDOW")
        with bpy.context.temp_override(window=window, area=timeline, region=region):
            bpy.ops.action.view_all()
        yield 0.5
        yield from open_tab(window, area)
        yield 1.0
        bpy.ops.screen.screenshot(filepath=PICTURE)


def run():
    try:
        return next(RUNNING)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


RUNNING = steps()
bpy.app.timers.register(run, first_interval=1.0, persistent=True)

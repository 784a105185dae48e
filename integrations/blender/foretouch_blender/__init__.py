"""Foretouch in Blender: what an armature touches between two frames, and when."""

import bpy

from . import operators, panel, settings

bl_info = {
    "name": "Foretouch",
    "author": "The Foretouch authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Foretouch",
    "description": "Finds what an armature touches between two frames, and misses nothing",
    "category": "Animation",
}

CLASSES = (
    settings.ForetouchTouch,
    settings.ForetouchSettings,
    settings.ForetouchPreferences,
    operators.FORETOUCH_OT_check,
    operators.FORETOUCH_OT_make_solid,
    operators.FORETOUCH_OT_sweep,
    operators.FORETOUCH_OT_capsules,
    operators.FORETOUCH_OT_jump,
    operators.FORETOUCH_OT_clear,
    operators.FORETOUCH_OT_copy_install_line,
    panel.FORETOUCH_UL_touches,
    panel.FORETOUCH_PT_panel,
)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.foretouch = bpy.props.PointerProperty(type=settings.ForetouchSettings)
    bpy.types.WindowManager.foretouch_progress = bpy.props.FloatProperty(
        default=-1, min=-1, max=100, subtype="PERCENTAGE", options={"SKIP_SAVE"})


def unregister():
    del bpy.types.WindowManager.foretouch_progress
    del bpy.types.Scene.foretouch
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)

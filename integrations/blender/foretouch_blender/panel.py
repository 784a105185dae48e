"""The panel Foretouch in the sidebar of the 3D view."""

import bpy

from . import library
from .settings import active_touch
from .told import Told


class FORETOUCH_UL_touches(bpy.types.UIList):
    """One line per touch."""

    def draw_item(self, _context, layout, _data, touch, _icon, _active, _property, _index):
        split = layout.split(factor=0.38, align=True)
        split.label(text=f"{touch.begin:.2f}", icon="QUESTION" if not touch.is_known else
                  "IMPORT" if touch.begins_inside else "DOT")
        names = split.row(align=True)
        names.label(text=touch.link)
        names.label(text=touch.object)


class FORETOUCH_PT_panel(bpy.types.Panel):
    bl_idname = "FORETOUCH_PT_panel"
    bl_label = "Foretouch"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Foretouch"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        try:
            library.package()
        except Told:
            _draw_missing(layout)
            return
        asked = context.scene.foretouch
        progress = context.window_manager.foretouch_progress
        if progress >= 0:
            layout.prop(context.window_manager, "foretouch_progress", text="Esc cancels", slider=True)
        _draw_settings(layout, asked)
        layout.operator("foretouch.check", icon="VIEWZOOM")
        _draw_touches(layout, context.scene)
        column = layout.column()
        column.operator("foretouch.make_solid", icon="PHYSICS")
        column.prop(asked, "skin")
        column.prop(asked, "floor")
        layout.operator("foretouch.capsules", icon="MESH_CAPSULE")
        if asked.touches or any("foretouch" in child for child in context.scene.collection.children):
            layout.operator("foretouch.clear", icon="TRASH")
        for line in asked.notes.splitlines():
            _draw_text(layout, line, "INFO")


def _draw_settings(layout, asked):
    column = layout.column()
    column.prop(asked, "body")
    column.prop(asked, "body_from")
    if asked.body_from == "FILE":
        column.prop(asked, "avatar_file")
    if asked.body_from == "MESHES":
        column.prop(asked, "most_lss")
    column.prop(asked, "against")
    column.prop(asked, "frames")
    column.prop(asked, "tolerance")


def _draw_touches(layout, scene):
    asked = scene.foretouch
    layout.template_list("FORETOUCH_UL_touches", "", asked, "touches", asked, "active", rows=4)
    touch = active_touch(scene)
    if touch is not None:
        ends = "goes on" if touch.is_open else f"to {touch.end:.2f}"
        claim = f"{touch.approach:.2f} m/s" if touch.is_known else "nothing is claimed"
        layout.label(text=f"Frames {touch.begin:.2f} {ends}, {claim}")
        layout.operator("foretouch.jump", icon="TIME").index = -1
    column = layout.column(align=True)
    one = column.row(align=True)
    one.enabled = touch is not None
    one.operator("foretouch.sweep", text="Sweep of Touch", icon="MOD_ARRAY").of_bone = False
    column.operator("foretouch.sweep", text="Sweep of Active Bone", icon="BONE_DATA").of_bone = True
    column.prop(asked, "sweep_error")


def _draw_missing(layout):
    layout.label(text="Foretouch itself is missing", icon="ERROR")
    _draw_text(layout, f"Type into a terminal: {library.install_line()} and restart Blender, or name its "
                       "folder in the add-on's preferences", "NONE")
    layout.operator("foretouch.copy_install_line", icon="COPYDOWN")


def _draw_text(layout, text, icon, columns=44):
    """A label does not wrap."""
    column, line = layout.column(align=True), ""
    for word in text.split():
        if line and len(line) + len(word) >= columns:
            column.label(text=line, icon=icon)
            line, icon = "", "BLANK1"
        line += f"{' ' if line else ''}{word}"
    column.label(text=line, icon=icon)

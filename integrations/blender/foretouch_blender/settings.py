"""What the panel asks, and what a check found: properties of the scene, kept in the file."""

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty,
                       PointerProperty, StringProperty)


def _is_armature(_, thing):
    return thing.type == "ARMATURE"


def _jump(self, context):
    touch = active_touch(context.scene)
    if touch is not None:
        context.scene.frame_set(int(touch.begin // 1), subframe=touch.begin % 1)


def active_touch(scene):
    """That is chosen in the list, or None."""
    asked = scene.foretouch
    return asked.touches[asked.active] if 0 <= asked.active < len(asked.touches) else None


class ForetouchTouch(bpy.types.PropertyGroup):
    link: StringProperty()
    object: StringProperty()
    begin: FloatProperty(description="Frame at which the touch begins, never later than it does")
    end: FloatProperty()
    is_known: BoolProperty(description="Off: nothing is claimed from begin to end")
    begins_inside: BoolProperty(description="They touch already where they are known first")
    is_open: BoolProperty(description="It goes on where the frames end")
    approach: FloatProperty(description="Metres per second along the normal where it begins")
    empty: PointerProperty(type=bpy.types.Object)


class ForetouchSettings(bpy.types.PropertyGroup):
    body: PointerProperty(type=bpy.types.Object, poll=_is_armature, name="Body",
                          description="The armature whose motion is checked")
    against: PointerProperty(type=bpy.types.Collection, name="Against",
                             description="What it may touch; if empty, the selected objects")
    body_from: EnumProperty(name="Shape", default="MESHES", items=[
        ("MESHES", "Its Meshes", "Capsules that hold all faces which move with each bone"),
        ("ENVELOPES", "Bone Envelopes", "Each deforming bone as thick as its envelope"),
        ("FILE", "Avatar File", "An avatar of Foretouch, whose links have the names of bones")])
    avatar_file: StringProperty(name="File", subtype="FILE_PATH", description="The avatar file")
    most_lss: IntProperty(name="Capsules", default=4, min=1, max=16,
                          description="At most so many per bone; fewer where more would not fit better")
    frames: EnumProperty(name="Frames", default="ACTION", items=[
        ("ACTION", "Of the Action", "From the first to the last frame of the active action"),
        ("SCENE", "Of the Scene", "From Start to End, with NLA strips and whatever moves the armature")])
    tolerance: FloatProperty(name="Tolerance", default=0.001, min=1e-5, max=0.1, precision=4,
                             description="A touch may be reported so many metres before it happens, never after")
    skin: FloatProperty(name="Gap", default=0.002, min=1e-5, max=0.1, precision=4,
                        description="Metres that the solid body keeps to surfaces where it can")
    floor: EnumProperty(name="Feet", default="LIFT", items=[
        ("LIFT", "Lift the Body", "Where feet are below the floor the whole body is lifted"),
        ("HOLD", "Hold the Feet", "The floor is a surface like all others")])
    sweep_error: FloatProperty(name="Error", default=0.005, min=1e-5, max=1.0, precision=4,
                               description="The sweep holds all that the bone's capsules sweep, and "
                                           "nothing farther away than so many metres")
    touches: CollectionProperty(type=ForetouchTouch)
    active: IntProperty(default=-1, update=_jump)
    notes: StringProperty()


class ForetouchPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    folder: StringProperty(name="Foretouch's Packages", subtype="DIR_PATH",
                           description="The folder that holds Foretouch's Python package, such as "
                                       "build/release/lib/python3/dist-packages")

    def draw(self, _):
        self.layout.prop(self, "folder")

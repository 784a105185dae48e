"""What the panel's buttons do."""

import bpy

from . import library, marks
from .axes import Axes
from .body import body_of
from .capsules import capsules_of, one_scale
from .follow import Following
from .job import Job, scaled
from .rig import armature_of, rest_stretch
from .sampled import CHUNK, sampling
from .settings import active_touch
from .solid import baking, refuse_what_a_bake_cannot_hold, showing
from .told import Told

AROUND_TOUCH = 5
"""Frames before and after a touch that its sweep shows."""
AGAIN_M = 1e-5
"""The tolerance, in metres, with which a solid action is checked again. The solid body comes nearer to
surfaces than the usual tolerance; Blender's single precision is a hundredth of this."""


def following(sampled, tolerance):
    """Yields the share that is done, and returns the touches."""
    ft = library.package()
    instants = sampled.instants
    found = Following(ft, sampled.body.avatar, sampled.still, sampled.props, tolerance, sampled.frames,
                      whole_frames=len(instants) == len(sampled.frames))
    for k, instant in enumerate(instants):
        found.push(instant, sampled.pose(k), sampled.places_at(k))
        if k % CHUNK == CHUNK - 1:
            found.follow()
            yield k / len(instants)
    found.follow()
    return found.finish()


class FORETOUCH_OT_check(Job, bpy.types.Operator):
    """Find what the body touches between any two frames, and mark where and when"""

    bl_idname = "foretouch.check"
    bl_label = "Check Action"
    bl_options = {"REGISTER", "UNDO"}

    def steps(self, context):
        sampled = yield from scaled(sampling(context), 0.0, 0.9)
        touches = yield from scaled(following(sampled, context.scene.foretouch.tolerance), 0.9, 1.0)
        _keep(context.scene, touches, sampled)
        touched = sum(touch.is_known for touch in touches)
        unknown = len(touches) - touched
        return (f"{touched} touches in {len(sampled.frames)} frames"
                + (f"; nothing is claimed of {unknown} spans" if unknown else ""))


def _keep(scene, touches, sampled):
    marks.clear_touches(scene)
    scene.foretouch.notes = "\n".join(sampled.notes)
    for touch, empty in zip(touches, marks.show(scene, touches, sampled.axes)):
        kept = scene.foretouch.touches.add()
        for name in ("link", "object", "is_known", "begins_inside", "is_open", "approach"):
            setattr(kept, name, getattr(touch, name))
        kept.begin, kept.end = touch.begin.frame, touch.end.frame
        kept.empty = empty
    scene.foretouch["active"] = -1  # without a jump


class FORETOUCH_OT_make_solid(Job, bpy.types.Operator):
    """Bake a motion that passes through nothing as a new action; the present one stays as it is"""

    bl_idname = "foretouch.make_solid"
    bl_label = "Make Solid"
    bl_options = {"REGISTER", "UNDO"}

    def steps(self, context):
        scene = context.scene
        sampled = yield from scaled(sampling(context), 0.0, 0.3)
        rig = sampled.rig
        refuse_what_a_bake_cannot_hold(rig)
        shown, unproven = yield from scaled(showing(sampled, scene.foretouch), 0.3, 0.6)
        action = yield from scaled(baking(sampled, shown, scene), 0.6, 0.8)
        before = rig.animation_data.action
        rig.animation_data.action = action
        try:
            left = yield from scaled(self._check_again(context, [at for at, _ in shown]), 0.8, 1.0)
        except BaseException:  # a cancel, too
            rig.animation_data.action = before
            bpy.data.actions.remove(action)
            raise
        before.use_fake_user = True  # nothing else may hold it now
        return _told_of(action, left, unproven)

    def _check_again(self, context, instants):
        """What the action as Blender plays it really touches, not what comes near, from key to key."""
        sampled = yield from scaled(sampling(context, more_instants=instants), 0.0, 0.9)
        return (yield from scaled(following(sampled, AGAIN_M), 0.9, 1.0))


def _told_of(action, left, unproven):
    text = f"'{action.name}', checked again: " + (f"{len(left)} touches are left" if left else
                                                  "nothing touches")
    if unproven:
        text += f"; it found no free place at {len(unproven)} frames, first at {unproven[0]}"
    return text


class FORETOUCH_OT_sweep(Job, bpy.types.Operator):
    """Make a mesh of all the space that a bone sweeps: of the chosen touch, or of the active bone in
    all frames"""

    bl_idname = "foretouch.sweep"
    bl_label = "Sweep Volume"
    bl_options = {"REGISTER", "UNDO"}

    of_bone: bpy.props.BoolProperty(name="Of the active bone", default=False)

    def steps(self, context):
        ft = library.package()
        scene = context.scene
        bone, between = self._asked(scene)
        sampled = yield from scaled(sampling(context, with_obstacles=False, between=between), 0.0, 0.5)
        avatar = sampled.body.avatar
        if bone not in avatar.names or not avatar.lss[avatar.link(bone)]:
            raise Told(f"Bone '{bone}' moves no faces, so it sweeps nothing")
        motions = [ft.Motion(avatar, sampled.pose(k), sampled.pose(k + 1))
                   for k in range(len(sampled.frames) - 1)]
        yield 0.6
        swept = ft.swept_surface(motions, bone, error=scene.foretouch.sweep_error, max_triangles=2_000_000)
        thing = marks.add_sweep(scene, f"Sweep {bone}", swept, sampled.axes)
        return f"'{thing.name}': {len(swept.triangles)} faces"

    def _asked(self, scene):
        touch = active_touch(scene)
        if touch is not None and not self.of_bone:
            return touch.link, (int(touch.begin) - AROUND_TOUCH, int(touch.end) + 1 + AROUND_TOUCH)
        rig = scene.foretouch.body
        active = rig.data.bones.active if rig else None
        if active is None:
            raise Told("Choose a touch in the list, or make a bone of the body active")
        return active.name, None


class FORETOUCH_OT_capsules(bpy.types.Operator):
    """Make an object of each capsule of the body, which moves with its bone: a collider for rigid bodies"""

    bl_idname = "foretouch.capsules"
    bl_label = "Capsules as Objects"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        scene = context.scene
        try:
            rig = armature_of(scene)
            axes = Axes.of(scene)
            one_scale(rig)
            body = body_of(rig, scene, axes, rest_stretch(rig.matrix_world))
            added = marks.add_capsules(scene, rig, capsules_of(body, rig, axes))
        except Told as told:
            self.report({"ERROR"}, str(told))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{len(added)} capsules of '{rig.name}'")
        return {"FINISHED"}


class FORETOUCH_OT_jump(bpy.types.Operator):
    """Go to the frame of the chosen touch, and select its empty"""

    bl_idname = "foretouch.jump"
    bl_label = "Jump to Touch"
    bl_options = {"REGISTER", "UNDO"}

    index: bpy.props.IntProperty(default=-1)

    def execute(self, context):
        asked = context.scene.foretouch
        if self.index >= len(asked.touches):
            self.report({"ERROR"}, f"There are {len(asked.touches)} touches")
            return {"CANCELLED"}
        asked.active = self.index if self.index >= 0 else asked.active
        touch = active_touch(context.scene)
        if touch is None:
            self.report({"ERROR"}, "Choose a touch in the list")
            return {"CANCELLED"}
        if touch.empty is not None and touch.empty.name in context.view_layer.objects:
            for thing in context.selected_objects:
                thing.select_set(False)
            touch.empty.select_set(True)
            context.view_layer.objects.active = touch.empty
        return {"FINISHED"}


class FORETOUCH_OT_clear(bpy.types.Operator):
    """Remove all markers, empties, sweeps and capsules that the add-on made; baked actions stay"""

    bl_idname = "foretouch.clear"
    bl_label = "Remove Results"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        marks.clear(context.scene)
        return {"FINISHED"}


class FORETOUCH_OT_copy_install_line(bpy.types.Operator):
    """Copy the line that installs Foretouch for Blender's Python"""

    bl_idname = "foretouch.copy_install_line"
    bl_label = "Copy the Line that Installs It"

    def execute(self, context):
        context.window_manager.clipboard = library.install_line()
        self.report({"INFO"}, library.install_line())
        return {"FINISHED"}

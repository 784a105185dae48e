"""The shown motion of a solid avatar, as a new action of the armature."""

import bpy
import numpy as np
from mathutils import Matrix

from . import library
from .axes import frames_of, inverted
from .motion import Sampler
from .told import Told

TRANSFORMS = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle")


def refuse_what_a_bake_cannot_hold(rig):
    """Told where the pose is not what the action alone says, or where the rig must not be changed."""
    if rig.library or not rig.animation_data or not rig.animation_data.action:
        raise Told(f"'{rig.name}' is linked from {rig.library.filepath}: make a library override first "
                   "(Object, Library Override)" if rig.library else
                   f"'{rig.name}' has no action that could be made solid: bake one (Object, Animation, "
                   "Bake Action)")
    data = rig.animation_data
    if data.action_blend_type != "REPLACE" or data.action_influence < 1.0 or data.use_tweak_mode:
        raise Told(f"The action of '{rig.name}' is mixed with NLA strips: set its blending to Replace and "
                   "its influence to 1, and leave tweak mode")
    held = [(bone.name, constraint.name) for bone in rig.pose.bones for constraint in bone.constraints
            if not constraint.mute and constraint.influence > 0.0]
    if held:
        raise Told(f"Bone '{held[0][0]}' has the constraint '{held[0][1]}', which would undo what is baked: "
                   "bake the action first (Object, Animation, Bake Action, with Visual Keying and Clear "
                   "Constraints)")
    driven = [driver for driver in data.drivers if driver.data_path.startswith("pose.bones")
              and driver.data_path.rpartition(".")[2] in (*TRANSFORMS, "scale")]
    if driven:
        raise Told(f"A driver moves {driven[0].data_path}: bake the action first")


def showing(sampled, asked):
    """Yields the share that is done, and returns the shown links as (instant, world frames), and the
    numbers of those frames to which no way is proven free."""
    follow = _follower(sampled, asked)
    parents = sampled.body.avatar.parents
    shown, unproven = [], []
    for k, frame in enumerate(sampled.instants):
        tick = follow(k)
        if not tick.is_certified:
            unproven.append(int(frame))
        for share, pose in _pieces(tick):
            shown.append((float(np.float32(frame - 1 + share)) if share < 1.0 else float(frame),
                          frames_of(*pose, parents)))
        if k % 16 == 0:
            yield k / len(sampled.instants)
    return shown, unproven


def _pieces(tick):
    """The ends of the tick's way, that is straight in between, with their shares of the frame. Blender
    takes keys that are nearer to each other than LEAST_APART for one."""
    before, pieces = 0.0, []
    for share, pose in list(zip(tick.times, tick.way))[:-1]:
        if share - before >= LEAST_APART and 1.0 - share >= LEAST_APART:
            pieces.append((share, pose))
            before = share
    return [*pieces, (1.0, tick.shown)]


LEAST_APART = 0.02
"""Frames; twice what Blender's own search for keys tells apart."""


def _follower(sampled, asked):
    """A function from the number of a pose to a foretouch.SolidTick."""
    ft = library.package()
    seconds = sampled.frames.seconds_per_frame
    options = {"skin": asked.skin, "floor": asked.floor.lower()}
    if not sampled.props:
        solid = ft.SolidAvatar(sampled.body.avatar, sampled.still, **options)
        return lambda k: solid.follow(sampled.pose(k), seconds)
    still = sampled.still or ft.Scene.from_arrays(FAR, [[0, 1, 2]])
    solids = ft.SolidWorld(still, 0)
    body = solids.add(sampled.body.avatar, **options)
    props = [solids.world.add(scene) for _, scene in sampled.props]

    def push(now, k):
        for prop, place in zip(props, sampled.places_at(k)):
            solids.world.push(prop, now, place)

    def follow(k):
        now = round(1e6 * seconds * (k + 1))  # its first tick comes after its begin
        push(now, k)
        return solids.tick(now, {body: sampled.pose(k)})[body].tick

    push(0, 0)
    return follow


FAR = [[1e6, 1e6, 1e6], [1e6 + 1, 1e6, 1e6], [1e6, 1e6 + 1, 1e6]]
"""A triangle where nobody goes: a solid world needs a still scene."""


def baking(sampled, shown, scene):
    """Yields the share that is done, and returns the new action. Nothing is assigned yet."""
    rig, body = sampled.rig, sampled.body
    link_of = {int(bone): link for link, bone in enumerate(body.bones) if bone >= 0}
    channels = _Channels(rig, link_of)
    with Sampler(rig, scene) as sampler:
        for k, (instant, frames) in enumerate(shown):
            bones, world, _ = sampler.at(instant)
            tracked, _ = sampled.motion.frames(bones[None], world[None], [instant])
            moves = sampled.axes.moves_back(frames @ inverted(tracked[0]))
            channels.add(bones, np.linalg.inv(world) @ moves @ world)
            if k % 16 == 0:
                yield k / len(shown)
    return channels.write(rig.animation_data.action, [instant for instant, _ in shown])


class _Channels:
    """Location and rotation of each moved bone, frame by frame."""

    def __init__(self, rig, link_of):
        self.bones = list(rig.data.bones)
        number = {bone.name: k for k, bone in enumerate(self.bones)}
        self.parents = [number[bone.parent.name] if bone.parent else -1 for bone in self.bones]
        self.order = sorted(range(len(self.bones)), key=lambda k: len(self.bones[k].parent_recursive))
        self.pose = [rig.pose.bones[bone.name] for bone in self.bones]
        self.link_of = link_of
        self.values = {bone: [] for bone in link_of}

    def add(self, tracked, moves):
        """Bones as they are, and what moves each link, both in the armature's space."""
        new = {}
        for k in self.order:
            parent = self.parents[k]
            if k in self.link_of:
                new[k] = moves[self.link_of[k]] @ tracked[k]
                self.values[k].append(self._local(k, new))
            elif parent >= 0:
                new[k] = new[parent] @ np.linalg.inv(tracked[parent]) @ tracked[k]
            else:
                new[k] = tracked[k]

    def _local(self, k, new):
        """What the pose bone's own channels must be."""
        bone, parent = self.bones[k], self.parents[k]
        above = {} if parent < 0 else {"parent_matrix": Matrix(new[parent]),
                                       "parent_matrix_local": self.bones[parent].matrix_local}
        local = bone.convert_local_to_pose(Matrix(new[k]), bone.matrix_local, invert=True, **above)
        location, rotation, _ = local.decompose()
        before = self.values[k][-1] if self.values[k] else None
        return location, _as_mode(rotation, self.pose[k].rotation_mode, before and before[1])

    def write(self, action, instants):
        solid = action.copy()
        solid.name = f"{action.name} solid"
        paths = {f'{bone.path_from_id()}.{kind}' for k, bone in enumerate(self.pose) if k in self.values
                 for kind in TRANSFORMS}
        curves = _curve_list(solid)
        for curve in [curve for curve in curves if curve.data_path in paths]:
            curves.remove(curve)
        for k, values in self.values.items():
            bone = self.pose[k]
            kind = _rotation_path(bone.rotation_mode)
            _write(curves, f"{bone.path_from_id()}.{kind}", [list(v[1]) for v in values], instants, bone.name)
            if not (self.bones[k].use_connect and self.parents[k] >= 0):
                _write(curves, f"{bone.path_from_id()}.location", [v[0][:] for v in values], instants,
                       bone.name)
        return solid


def _rotation_path(mode):
    return {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(
        mode, "rotation_euler")


def _as_mode(rotation, mode, before):
    """In the bone's own rotation mode, as near to the frame before as it can be."""
    if mode == "QUATERNION":
        if before is not None:
            rotation.make_compatible(before)
        return rotation
    if mode == "AXIS_ANGLE":
        axis, angle = rotation.to_axis_angle()
        return [angle, *axis]
    return rotation.to_euler(mode, before) if before is not None else rotation.to_euler(mode)


def _curve_list(action):
    """Where F-curves are made and removed; of an action with layers those of its first slot."""
    if hasattr(action, "fcurves"):
        return action.fcurves
    return action.layers[0].strips[0].channelbags[0].fcurves


def _write(curves, path, values, instants, group):
    columns = np.array(values, dtype=np.float32).T
    numbers = np.array(instants, dtype=np.float32)
    for index, column in enumerate(columns):
        options = {"action_group": group} if hasattr(bpy.types.Action, "fcurves") else {}
        curve = curves.new(path, index=index, **options)
        curve.keyframe_points.add(len(numbers))
        curve.keyframe_points.foreach_set("co", np.stack([numbers, column], axis=1).ravel())
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
        curve.update()

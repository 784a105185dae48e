"""The solid avatar of libforetouch through ctypes, as a program without this package has it."""

import ctypes as c

import numpy as np
from support import BUILD

LIBRARY = BUILD / "bindings" / "c" / "libforetouch.so"


def fields(kind, names):
    return [(name, kind) for name in names.split()]


class SceneArrays(c.Structure):
    _fields_ = (fields(c.c_uint32, "size reserved") + [
        ("positions", c.c_void_p), ("vertex_count", c.c_size_t), ("indices", c.c_void_p),
        ("triangle_count", c.c_size_t), ("objects", c.c_void_p), ("object_names", c.c_void_p),
        ("object_count", c.c_size_t)])


class AvatarArrays(c.Structure):
    _fields_ = (fields(c.c_uint32, "size reserved") + [
        ("joint_count", c.c_size_t), ("names", c.c_void_p), ("parents", c.c_void_p),
        ("offsets", c.c_void_p), ("rotations", c.c_void_p), ("lss", c.c_void_p),
        ("lss_links", c.c_void_p), ("lss_count", c.c_size_t), ("triangles", c.c_void_p),
        ("triangle_links", c.c_void_p), ("triangle_count", c.c_size_t)])


class Pose(c.Structure):
    _fields_ = [("size", c.c_uint32), ("joint_count", c.c_uint32), ("rotations", c.c_void_p),
                ("translations", c.c_void_p)]


class Tick(c.Structure):
    _fields_ = ([("size", c.c_uint32)]
                + fields(c.c_int32, "state limit is_certified has_appeared reserved")
                + fields(c.c_double, "deviation lift clearance snap_in_s")
                + fields(c.c_uint64, "joint_count contact_count way_count")
                + fields(c.c_uint32, "queries iterations features rows around_queries"
                         " placing_queries")
                + [("work", c.c_uint64)])


class Contact(c.Structure):
    _fields_ = ([("size", c.c_uint32)] + fields(c.c_int32, "link lss triangle object other")
                + [("point", c.c_double * 3), ("normal", c.c_double * 3)]
                + fields(c.c_double, "gap push slip_speed"))


class SolidInC:
    """One solid avatar with the usual options, made of the arrays of a scene and an avatar."""

    def __init__(self, avatar, scene):
        self.lib = c.CDLL(str(LIBRARY))
        self.lib.ft_last_error.restype = c.c_char_p
        self.joints = len(avatar)
        self.scene, self.avatar, self.solid = c.c_void_p(), c.c_void_p(), c.c_void_p()
        self.make_scene(scene)
        self.make_avatar(avatar)
        self.must(self.lib.ft_solid_create(self.scene, self.avatar, None, c.byref(self.solid)))

    def must(self, status):
        if status != 0:
            raise AssertionError(self.lib.ft_last_error().decode())

    def make_scene(self, scene):
        corners = np.ascontiguousarray(scene.triangles, dtype=float)
        objects = np.ascontiguousarray(scene.object_of, dtype=np.int32)
        arrays = SceneArrays(size=c.sizeof(SceneArrays), positions=corners.ctypes.data,
                             vertex_count=3 * len(corners), triangle_count=len(corners),
                             objects=objects.ctypes.data, object_count=len(scene.object_names))
        self.must(self.lib.ft_scene_create(c.byref(arrays), c.byref(self.scene)))

    def make_avatar(self, avatar):
        names = (c.c_char_p * self.joints)(*[name.encode() for name in avatar.names])
        parents = np.ascontiguousarray(avatar.parents, dtype=np.int32)
        rest = avatar.rest_pose()
        lss = np.array([[*one.a, *one.b, one.radius] for link in avatar.lss for one in link])
        links = np.array([i for i, link in enumerate(avatar.lss) for _ in link], dtype=np.int32)
        arrays = AvatarArrays(size=c.sizeof(AvatarArrays), joint_count=self.joints,
                              names=c.cast(names, c.c_void_p), parents=parents.ctypes.data,
                              offsets=rest.translations.ctypes.data,
                              rotations=rest.rotations.ctypes.data, lss=lss.ctypes.data,
                              lss_links=links.ctypes.data, lss_count=len(links))
        self.must(self.lib.ft_avatar_create(c.byref(arrays), c.byref(self.avatar)))

    def follow(self, tracked, dt):
        rotations = np.ascontiguousarray(tracked.rotations, dtype=float)
        translations = np.ascontiguousarray(tracked.translations, dtype=float)
        pose = Pose(c.sizeof(Pose), self.joints, rotations.ctypes.data, translations.ctypes.data)
        tick = Tick(size=c.sizeof(Tick))
        self.must(self.lib.ft_solid_follow(self.solid, c.byref(pose), None, c.c_double(dt),
                                           c.byref(tick)))
        return tick

    def shown(self):
        rotations, translations = np.empty((self.joints, 4)), np.empty((self.joints, 3))
        self.must(self.lib.ft_solid_shown(self.solid, c.c_void_p(rotations.ctypes.data),
                                          c.c_void_p(translations.ctypes.data),
                                          c.c_size_t(self.joints), None))
        return rotations, translations

    def contacts(self, tick):
        found = (Contact * max(1, tick.contact_count))()
        found[0].size = c.sizeof(Contact)
        self.must(self.lib.ft_solid_contacts(self.solid, found, c.c_size_t(tick.contact_count),
                                             None))
        return found[:tick.contact_count]

    def close(self):
        self.lib.ft_solid_destroy(self.solid)
        self.lib.ft_avatar_destroy(self.avatar)
        self.lib.ft_scene_destroy(self.scene)

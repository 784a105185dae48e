"""A moving world of libforetouch through ctypes, as a program without this package has it."""

import ctypes as c

import numpy as np
from solid_in_c import Pose, SolidInC, fields


class Side(c.Structure):
    _fields_ = (fields(c.c_int32, "body link lss triangle object reserved")
                + [("point", c.c_double * 3)])


class Contact(c.Structure):
    _fields_ = ([("size", c.c_uint32)] + fields(c.c_int32, "verdict reason is_assumed")
                + [("time_us", c.c_int64)]
                + fields(c.c_double, "time_fraction separation penetration")
                + [("normal", c.c_double * 3), ("a", Side), ("b", Side)])


class Carrier(c.Structure):
    _fields_ = [("size", c.c_uint32), *fields(c.c_int32, "body link moves_in_frame")]


class WorldInC(SolidInC):
    """A world beside a still scene, whose bodies are of one avatar and of that scene as a mesh."""

    def __init__(self, avatar, scene):
        super().__init__(avatar, scene)
        self.world = c.c_void_p()
        self.must(self.lib.ft_world_create(self.scene, None, c.byref(self.world)))

    def add(self, is_mesh):
        body = c.c_int32()
        add = self.lib.ft_world_add_mesh if is_mesh else self.lib.ft_world_add_avatar
        self.must(add(self.world, self.scene if is_mesh else self.avatar, None, c.byref(body)))
        return body.value

    def pose(self, given):
        """Of C; and the arrays that it points to."""
        rotations, translations = (np.ascontiguousarray(half, dtype=float) for half in given)
        return Pose(c.sizeof(Pose), len(rotations), rotations.ctypes.data,
                    translations.ctypes.data), (rotations, translations)

    def push(self, body, utime_us, given):
        pose, kept = self.pose(given)
        self.must(self.lib.ft_world_push(self.world, body, c.c_int64(utime_us), c.byref(pose)))
        del kept

    def attach(self, body, carrier, utime_us, given, link, moves_in_frame):
        pose, kept = self.pose(given)
        by = Carrier(c.sizeof(Carrier), carrier, link, int(moves_in_frame))
        self.must(self.lib.ft_world_attach(self.world, body, c.byref(by), c.c_int64(utime_us),
                                           c.byref(pose)))
        del kept

    def detach(self, body, utime_us, given):
        pose, kept = self.pose(given)
        self.must(self.lib.ft_world_detach(self.world, body, c.c_int64(utime_us), c.byref(pose)))
        del kept

    def contacts_in(self, from_us, to_us):
        self.must(self.lib.ft_world_answer(self.world, c.c_int64(from_us), c.c_int64(to_us)))
        count = c.c_size_t()
        self.must(self.lib.ft_world_contacts(self.world, None, c.c_size_t(0), c.byref(count)))
        found = (Contact * max(1, count.value))()
        found[0].size = c.sizeof(Contact)
        self.must(self.lib.ft_world_contacts(self.world, found, count, None))
        return found[:count.value]

    def close(self):
        self.lib.ft_world_destroy(self.world)
        super().close()

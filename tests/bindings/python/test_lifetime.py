"""Objects keep what they need, and nothing else; references are counted right."""

import gc
import os
import sys
import unittest
import weakref

import numpy as np

import foretouch
from support import arm, swing, wall


class Lifetime(unittest.TestCase):
    def test_arrays_keep_their_step(self):
        step = foretouch.first_contacts(arm_of_its_own := arm(), swing(arm_of_its_own), wall())
        expected = step.points.copy()
        alive = weakref.ref(step)
        views = [step.points, step.toi[1:]]
        del step, arm_of_its_own
        gc.collect()
        self.assertIsNotNone(alive())
        np.testing.assert_array_equal(views[0], expected)
        views.pop()
        views.pop()
        gc.collect()
        self.assertIsNone(alive())

    def test_contacts_outlive_everything(self):
        avatar, scene = arm(), wall(name="plaster")
        query = foretouch.Query(avatar, scene)
        motion = swing(avatar)
        kept = [query.first_contacts(motion).contacts[0],
                query.first_contacts_many((np.stack([motion.start.rotations, motion.end.rotations]),
                                           np.stack([motion.start.translations] * 2)))[0]["fore"]]
        del avatar, scene, query, motion
        gc.collect()
        for contact in kept:
            self.assertEqual((contact.link, contact.object), ("fore", "plaster"))

    def test_motions_queries_and_surfaces_keep_their_avatar(self):
        avatar = arm()
        alive = weakref.ref(avatar)
        motion = swing(avatar)
        query = foretouch.Query(avatar, wall())
        del avatar
        gc.collect()
        self.assertEqual(query.first_contacts(motion).contacts[0].link, "fore")
        self.assertIs(motion.avatar, query.avatar)
        surface = foretouch.Surface.from_triangles(arm(), [None, None])
        self.assertEqual(surface.avatar.names, ["upper", "fore"])
        del motion, query
        gc.collect()
        self.assertIsNone(alive())

    def test_nothing_is_kept_too_long(self):
        avatar, scene = arm(), wall()
        motion = swing(avatar)
        query = foretouch.Query(avatar, scene)
        rest = avatar.rest_pose()
        watched = [avatar, scene, motion, query, rest, rest.rotations, foretouch.Verdict.CONTACT,
                   foretouch.Verdict, None]

        def use():
            step = query.first_contacts(motion)
            self.assertTrue(step.contacts[0].verdict == foretouch.Verdict.CONTACT)
            _ = (step.toi, step.points, step.counters, repr(step), motion.transforms(0.5))
            foretouch.Motion(avatar, rest, rest)
            foretouch.touches_at(avatar, motion, scene, [0, 1])
            foretouch.first_contacts(avatar, motion, scene, ignore=[("fore", 0)],
                                     policies={"fore": {"tolerance": 1e-4}})
            for bad in [(1, 2), None, (rest.rotations * 2, rest.translations)]:
                try:
                    foretouch.Motion(avatar, bad, rest)
                except foretouch.Error:
                    pass

        use()
        gc.collect()
        before = [sys.getrefcount(x) for x in watched]
        for _ in range(300):
            use()
        gc.collect()
        after = [sys.getrefcount(x) for x in watched]
        # None is counted by everyone; a leak would show as 300 or more.
        for name, x, y in zip("avatar scene motion query rest array member enum none".split(),
                              before, after):
            self.assertLess(abs(y - x), 150, name)

    @unittest.skipIf("asan" in os.environ.get("LD_PRELOAD", ""), "freed memory is kept aside")
    def test_memory_does_not_grow(self):
        avatar, scene = arm(), wall()
        motion = swing(avatar)
        query = foretouch.Query(avatar, scene)
        poses = foretouch.Poses(np.tile(motion.start.rotations, (200, 1, 1)),
                                np.tile(motion.start.translations, (200, 1, 1)))

        def use():
            for _ in range(20):
                query.first_contacts_many(poses, threads=1).points
                foretouch.swept_surface(motion, "fore", error=0.02)
                foretouch.Scene.from_arrays(np.eye(3).repeat(100, axis=0), [[0, 150, 250]] * 1000)

        for _ in range(3):
            use()
        before = resident_bytes()
        for _ in range(10):
            use()
        self.assertLess(resident_bytes() - before, 20 << 20)


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


if __name__ == "__main__":
    unittest.main()

"""The solid avatar: what it promises, and the same ticks as in C, bit for bit."""

import threading
import unittest

import numpy as np

import foretouch
from foretouch import InputError, PairRules, SolidAvatar, SolidJointState, SolidState
from solid_in_c import LIBRARY, SolidInC
from support import arm, bent, example, wall

DT = 1 / 90


def pressing(avatar, t):
    """The arm turns about its shoulder towards -z: at t = 1 by 60 degrees."""
    return bent(avatar, 0, t * np.pi / 3)


class Ticks(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene = arm(), wall(z=-0.3)
        self.solid = SolidAvatar(self.avatar, self.scene)

    def follow(self, t):
        return self.solid.follow(pressing(self.avatar, t), DT)

    def test_equal_a_free_pose_bit_for_bit(self):
        for t in [0, 0.01, 0.02, 0.1]:
            tick = self.follow(t)
            self.assertEqual(tick.state, SolidState.EQUAL)
            np.testing.assert_array_equal(tick.shown.rotations, pressing(self.avatar, t).rotations)
            self.assertTrue(tick.is_certified)
            self.assertEqual((tick.deviation, tick.limit, tick.snap_in), (0.0, None, None))
            self.assertEqual(tick.contacts, [])

    def test_stay_on_their_side_of_a_wall_and_say_why(self):
        for t in np.linspace(0, 1, 60):
            tick = self.follow(t)
            self.assertTrue(tick.is_certified)
            motion = foretouch.Motion(self.avatar, tick.shown, tick.shown)
            self.assertTrue(foretouch.first_contacts(self.avatar, motion, self.scene, 1e-6).is_clear)
        self.assertGreater(tick.deviation, 0.05)
        self.assertEqual(tick.link_deviation.shape, (2,))
        self.assertEqual(tick.deviation, tick.link_deviation.max())
        self.assertIn(tick.state, [SolidState.SLIDING, SolidState.HELD])
        self.assertIn(SolidJointState.FREE, SolidJointState)

    def test_say_where_surfaces_hold_them(self):
        for t in np.linspace(0, 1, 60):
            tick = self.follow(t)
        self.assertGreater(len(tick.contacts), 0)
        for contact in tick.contacts:
            self.assertIn(contact.link, self.avatar.names)
            self.assertEqual((contact.object, contact.other), ("wall", None))
            np.testing.assert_allclose(contact.normal, [0, 0, 1], atol=1e-9)
            self.assertAlmostEqual(contact.point[2], -0.3)
            self.assertGreater(contact.gap, 0)
            self.assertGreater(contact.push, 0)
            self.assertNotEqual(tick.joints[contact.link_id], SolidJointState.FREE)

    def test_come_back_when_the_way_is_free(self):
        for t in [*np.linspace(0, 1, 60), *np.linspace(1, 0, 60), *[0] * 30]:
            tick = self.follow(t)
        self.assertEqual(tick.state, SolidState.EQUAL)

    def test_have_ways_that_follow_one_another(self):
        before = None
        moved = 0
        for t in [*np.linspace(0, 1, 60), *np.linspace(1, 0, 60)]:
            tick = self.follow(t)
            self.assertEqual(len(tick.way), len(tick.times))
            if len(tick.way) == 0:
                continue
            moved += 1
            np.testing.assert_array_equal(tick.way[-1].rotations, tick.shown.rotations)
            self.assertEqual(tick.has_appeared, before is None)
            start = tick.way[0] if before is None else before
            for pose in tick.way:
                motion = foretouch.Motion(self.avatar, start, pose)
                step = foretouch.first_contacts(self.avatar, motion, self.scene, 1e-9)
                self.assertTrue(step.is_clear)
                start = pose
            before = tick.shown
        self.assertGreater(moved, 40)

    def test_are_views_that_nobody_writes_to(self):
        tick = self.follow(0)
        for array in [tick.joints, tick.link_deviation, tick.times]:
            with self.assertRaises(ValueError):
                array[...] = 1
        joints = self.follow(0.1).joints
        np.testing.assert_array_equal(joints, [SolidJointState.FREE] * 2)

    def test_show_themselves(self):
        self.assertEqual(repr(self.follow(0)), "<foretouch.SolidTick: equal, 0 mm off, 0 contacts>")
        self.assertEqual(set(self.follow(0.1).counters), {
            "queries", "iterations", "features", "rows", "around_queries", "placing_queries",
            "work"})

    def test_keep_a_lost_joint_where_it_was(self):
        self.follow(0)
        turned = bent(self.avatar, 1, 0.5)
        for flags in [[True, False], np.array([1, 0])]:
            tick = self.solid.follow(turned, DT, is_tracked=flags)
            self.assertEqual(tick.joints[1], SolidJointState.LOST)
            np.testing.assert_array_equal(tick.shown.rotations,
                                          self.avatar.rest_pose().rotations)
        self.assertEqual(self.solid.follow(turned, DT).joints[1], SolidJointState.FREE)


class Breaks(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene = arm(), wall(z=-0.3)
        self.before = self.avatar.rest_pose()
        self.behind = self.avatar.rest_pose()
        self.behind.translations[0, 2] = -1.0
        self.solid = SolidAvatar(self.avatar, self.scene)

    def test_begin_anew_after_a_reset(self):
        self.solid.follow(self.before, DT)
        self.assertNotEqual(self.solid.follow(self.behind, DT).state, SolidState.EQUAL)
        self.solid.reset()
        tick = self.solid.follow(self.behind, DT)
        self.assertEqual((tick.state, tick.has_appeared), (SolidState.EQUAL, True))

    def test_begin_at_a_place(self):
        self.solid.reset(self.before)
        tick = self.solid.follow(self.behind, DT)
        self.assertNotEqual(tick.state, SolidState.EQUAL)
        self.assertTrue(tick.is_certified)
        inside = self.avatar.rest_pose()
        inside.translations[0, 2] = -0.3
        with self.assertRaisesRegex(InputError, "place"):
            self.solid.reset(inside)

    def test_go_on_in_another_scene(self):
        self.solid.follow(self.before, DT)
        self.assertNotEqual(self.solid.follow(self.behind, DT).state, SolidState.EQUAL)
        far = wall(z=-50, name="far wall")
        self.solid.change_scene(far)
        self.assertIs(self.solid.scene, far)
        self.assertIs(self.solid.avatar, self.avatar)
        for _ in range(90):
            tick = self.solid.follow(self.behind, DT)
        self.assertEqual(tick.state, SolidState.EQUAL)


class SameAsInC(unittest.TestCase):
    def setUp(self):
        if not LIBRARY.exists():
            self.skipTest("the C library is not built")

    def compare(self, avatar, scene, poses, dt):
        here, there = SolidAvatar(avatar, scene), SolidInC(avatar, scene)
        self.addCleanup(there.close)
        seen = set()
        for i, pose in enumerate(poses):
            with self.subTest(tick=i):
                tick, c = here.follow(pose, dt), there.follow(pose, dt)
                self.compare_ticks(tick, c)
                rotations, translations = there.shown()
                np.testing.assert_array_equal(tick.shown.rotations, rotations)
                np.testing.assert_array_equal(tick.shown.translations, translations)
                self.compare_contacts(tick.contacts, there.contacts(c))
            seen.add(tick.state)
        return seen

    def compare_ticks(self, tick, c):
        self.assertEqual(
            (tick.state, tick.is_certified, tick.has_appeared, tick.deviation, tick.lift,
             tick.clearance, len(tick.contacts), len(tick.way), tick.counters["queries"],
             tick.counters["rows"], tick.counters["work"]),
            (c.state, c.is_certified, c.has_appeared, c.deviation, c.lift, c.clearance,
             c.contact_count, c.way_count, c.queries, c.rows, c.work))

    def compare_contacts(self, here, there):
        self.assertEqual(
            [(p.link_id, p.lss, -1 if p.triangle is None else p.triangle, *p.point, *p.normal,
              p.gap, p.push, p.slip_speed) for p in here],
            [(q.link, q.lss, q.triangle, *q.point, *q.normal, q.gap, q.push, q.slip_speed)
             for q in there])

    def test_over_an_arm_that_presses(self):
        avatar = arm()
        times = [*np.linspace(0, 1, 60), *np.linspace(1, 0, 60)]
        seen = self.compare(avatar, wall(), [pressing(avatar, t) for t in times], DT)
        self.assertGreaterEqual(len(seen), 2)

    def test_over_the_bundled_clip(self):
        avatar, scene, clip = example()
        poses = clip.poses(avatar)[::6]
        seen = self.compare(avatar, scene, poses, 6 * clip.frame_time_s)
        self.assertIn(SolidState.EQUAL, seen)
        self.assertGreaterEqual(len(seen), 2)


class Options(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene = arm(), wall()

    def refused(self, text, **options):
        with self.assertRaisesRegex(InputError, text):
            SolidAvatar(self.avatar, self.scene, **options)

    def test_out_of_range_are_refused_by_name(self):
        nan, inf = float("nan"), float("inf")
        for name, values in {
                "skin": [0, -1, 1, nan, "2"], "tolerance": [0, 1, nan], "catch_up": [0, inf, nan],
                "most_lift": [-1, 2, nan], "most_deviation": [0, inf], "patience": [-1, nan],
                "most_limb_deviation": [0, inf], "snap_notice": [-1, nan],
                "placing_reach": [-1, inf], "around_per_tick": [-1, 1.5, True],
                "around_in_all": [-1, 2**40], "work_budget": [0, -1, 1.5, None],
                "may_snap": [1, None], "floor": ["ignore", 0], "up": [(0, 2, 0), (0, 1), "y"]}.items():
            for value in values:
                with self.subTest(option=name, value=value):
                    self.refused(name, **{name: value})

    def test_about_links_and_objects_are_by_name(self):
        SolidAvatar(self.avatar, self.scene, visibility={"fore": 4, 0: 30}, feet=["fore", 0],
                    ignore=["upper", ("fore", "wall")])
        self.refused("visibility: 'fort' is no link.*'fore'", visibility={"fort": 4})
        self.refused(r"visibility\['fore'\]", visibility={"fore": "much"})
        self.refused("visibility: expected 0 to 1e6", visibility={"fore": -1})
        self.refused("visibility: expected a dict", visibility=[1, 1])
        self.refused(r"feet\[1\]: 'x' is no link", feet=["fore", "x"])
        self.refused(r"ignore\[0\]\[1\]: 'walls' is no object", ignore=[("fore", "walls")])

    def test_that_ignore_let_it_through(self):
        through = SolidAvatar(self.avatar, self.scene, ignore=["upper", "fore"])
        for t in np.linspace(0, 1, 60):
            self.assertEqual(through.follow(pressing(self.avatar, t), DT).state, SolidState.EQUAL)

    def test_take_the_rules_of_the_avatar(self):
        avatar = foretouch.Avatar.from_arrays(
            ["trunk", "left", "right"], [-1, 0, 0], [[0, 2, 0], [0.5, -1, 0], [-0.2, -1, 0]], None,
            [[((0, 0, 0), (0, 0, 0), r)] for r in [0.1, 0.05, 0.05]])
        solid = SolidAvatar(avatar, self.scene, self_pairs=PairRules.derive(avatar))
        pose = avatar.rest_pose()
        for x in np.linspace(0.5, -0.7, 120):
            pose.translations[1, 0] = x
            tick = solid.follow(pose, DT)
            self.assertTrue(tick.is_certified)
        self.assertNotEqual(tick.state, SolidState.EQUAL)
        with self.assertRaisesRegex(InputError, "self_pairs: expected the rules of this avatar"):
            SolidAvatar(self.avatar, self.scene, self_pairs=PairRules.derive(avatar))


class Poses(unittest.TestCase):
    def setUp(self):
        self.avatar = arm()
        self.solid = SolidAvatar(self.avatar, wall())
        self.rest = self.avatar.rest_pose()

    def refused(self, text, *arguments, **keywords):
        with self.assertRaisesRegex(InputError, text):
            self.solid.follow(*arguments, **keywords)

    def test_that_are_none_change_nothing(self):
        first = self.solid.follow(self.rest, DT)
        q, p = self.rest
        nan = float("nan")
        self.refused(r"tracked.rotations\[0, 0\]", (q * nan, p), DT)
        self.refused("tracked.rotations: expected the shape", (q[:1], p), DT)
        self.refused("tracked: .*norm", (q * 2, p), DT)
        for dt in [0, -1, 11, nan, "1"]:
            self.refused("dt: expected", self.rest, dt)
        self.refused(r"is_tracked: expected the shape \(2,\)", self.rest, DT, [True])
        self.refused("is_tracked: expected integers", self.rest, DT, [0.5, 1.0])
        again = self.solid.follow(self.rest, DT)
        np.testing.assert_array_equal(first.shown.rotations, again.shown.rotations)

    def test_of_the_wrong_class_are_refused(self):
        with self.assertRaises(TypeError):
            SolidAvatar(None, wall())
        with self.assertRaises(TypeError):
            self.solid.change_scene(None)
        with self.assertRaisesRegex(InputError, "place"):
            self.solid.reset(5)


class Threads(unittest.TestCase):
    def test_wait_for_one_another(self):
        avatar = arm()
        solid = SolidAvatar(avatar, wall())
        solid.follow(avatar.rest_pose(), DT)
        failures = []

        def work(seed):
            random = np.random.default_rng(seed)
            for _ in range(50):
                tick = solid.follow(pressing(avatar, random.uniform(0, 1)), DT)
                if not tick.is_certified:
                    failures.append(tick)
                if random.uniform() < 0.1:
                    solid.change_scene(wall())

        threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


if __name__ == "__main__":
    unittest.main()

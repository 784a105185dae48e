"""At and after the first contact: every object's own contact, leaving, details, poses on the way.
Expected values are closed forms."""

import unittest

import numpy as np

import foretouch
from foretouch import Verdict
from support import arm, bent, swing, turn, wall

RADIUS, CUP = 0.05, 0.5


def hand():
    """One ball of 5 cm."""
    zero = (0, 0, 0)
    return foretouch.Avatar.from_arrays(["hand"], [-1], [zero], None, [[(zero, zero, RADIUS)]])


def table_and_cup():
    """A table at y = 0, and the side of a cup at x = 0.5."""
    corners = [[-2, 0, -2], [2, 0, -2], [2, 0, 2], [-2, 0, 2],
               [CUP, 0, -0.2], [CUP, 0, 0.2], [CUP, 0.4, 0]]
    return foretouch.Scene.from_arrays(corners, [[0, 1, 2], [0, 2, 3], [4, 5, 6]], [0, 0, 1],
                                       ["table", "cup"])


def at(x, y):
    return [[1, 0, 0, 0]], [[x, y, 0]]


class EveryObject(unittest.TestCase):
    """A hand 0.5 mm above the table goes along it, from x = 0 to x = 1."""

    HEIGHT = RADIUS + 5e-4
    TRUE_TOI = CUP - RADIUS

    def setUp(self):
        self.avatar, self.scene = hand(), table_and_cup()
        self.motion = foretouch.Motion(self.avatar, at(0, self.HEIGHT), at(1, self.HEIGHT))

    def ask(self, **options):
        return foretouch.first_contacts(self.avatar, self.motion, self.scene, **options)

    def test_has_a_contact_of_its_own(self):
        step = self.ask(scope="objects")
        table, cup = step.objects
        self.assertEqual((table.object, table.toi), ("table", 0.0))
        self.assertEqual((cup.object, cup.verdict), ("cup", Verdict.CONTACT))
        self.assertLessEqual(cup.toi, self.TRUE_TOI)
        self.assertLessEqual(self.TRUE_TOI - cup.toi, 1e-3 * (1 + 1e-6))
        np.testing.assert_allclose(cup.normal, [-1, 0, 0], atol=1e-9)
        self.assertIn("hand meets cup at t=0.4", repr(cup))
        # Each link's earliest, as without.
        (contact,) = step.contacts
        self.assertEqual((contact.object, contact.toi), ("table", 0.0))
        self.assertIsNone(self.ask().objects)
        self.assertIsNone(self.ask(scope="avatar").objects)

    def test_is_told_of_each_step_of_many(self):
        poses = foretouch.Poses(np.tile([1.0, 0, 0, 0], (4, 1, 1)),
                                [[[x, self.HEIGHT, 0]] for x in (0, 0.2, 1, 1.5)])
        steps = foretouch.first_contacts_many(self.avatar, poses, self.scene, scope="objects")
        self.assertEqual([[c.object for c in step.objects] for step in steps],
                         [["table"], ["table", "cup"], ["table"]])
        cup = steps[1].objects[1]
        np.testing.assert_allclose(cup.details().velocity_of_link, [0.8, 0, 0], atol=1e-12)
        self.assertEqual(steps[1].objects[0].details().points[0].triangle, 0)

    def test_is_asked_beside_own_links(self):
        avatar = arm()
        with self.assertRaisesRegex(foretouch.InputError, "at least one pair"):
            foretouch.PairRules.derive(avatar)
        rules = foretouch.PairRules.leaving_out(avatar, [])
        step = foretouch.first_contacts(avatar, swing(avatar), wall(), scope="objects",
                                        self_pairs=rules)
        self.assertEqual([c.link for c in step.objects], ["fore", "upper"])
        self.assertIsNotNone(step.pairs)

    def test_is_refused_where_it_cannot_be_answered(self):
        cases = [
            (dict(scope="object"), "scope: expected one of 'links', 'avatar', 'objects', found "
                                   "'object'; did you mean 'objects'"),
            (dict(scope="objects", work_budget=1000), "scope: .* budget"),
            (dict(scope="objects", deadline_us=1000), "scope: .* budget"),
            (dict(pass_separating=1), "pass_separating: expected a bool"),
            (dict(pass_separating=None), "pass_separating: expected a bool"),
        ]
        for options, text in cases:
            with self.subTest(text), self.assertRaisesRegex(foretouch.InputError, text):
                self.ask(**options)


class Leaving(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene = hand(), table_and_cup()
        self.down = foretouch.Motion(self.avatar, at(0, 0.3), at(0, -0.3))
        (self.stop,) = foretouch.first_contacts(self.avatar, self.down, self.scene).contacts
        self.stopped = self.down.pose_at(self.stop.toi)

    def verdict(self, x, y, **options):
        motion = foretouch.Motion(self.avatar, self.stopped, at(x, y))
        return foretouch.first_contacts(self.avatar, motion, self.scene, **options)["hand"]

    def test_is_free_where_the_hand_retreats(self):
        self.assertAlmostEqual(self.stopped.translations[0, 1], 0.3 - 0.6 * self.stop.toi, 12)
        held = self.verdict(0, 0.3)
        self.assertEqual((held.verdict, held.toi), (Verdict.CONTACT, 0.0))
        self.assertEqual(self.verdict(0, 0.3, pass_separating=True).verdict, Verdict.CLEAR)

    def test_is_not_free_where_it_presses_on(self):
        pressed = self.verdict(0, -0.3, pass_separating=True)
        self.assertEqual((pressed.verdict, pressed.toi), (Verdict.CONTACT, 0.0))

    def test_goes_along_the_table_to_the_cup(self):
        y = self.stopped.translations[0, 1]
        cup = self.verdict(1, y, pass_separating=True)
        self.assertEqual(cup.object, "cup")
        self.assertLessEqual(cup.toi, CUP - RADIUS)
        self.assertGreater(cup.toi, CUP - RADIUS - 1.001e-3)


class Details(unittest.TestCase):
    def test_say_how_fast_the_two_approach(self):
        avatar, scene = hand(), table_and_cup()
        for slope in [0.0, 1.0, 3.0]:
            motion = foretouch.Motion(avatar, at(0, 0.3), at(0.1 * slope, -0.3))
            contact = foretouch.first_contacts(avatar, motion, scene).contacts[0]
            details = contact.details()
            np.testing.assert_allclose(details.velocity, [0, 0, 0])
            np.testing.assert_allclose(details.velocity_of_link, [0.1 * slope, -0.6, 0], atol=1e-12)
            self.assertAlmostEqual(details.approach_speed, 0.6)
            self.assertLessEqual(details.approach_lower, 0.6)
            self.assertGreaterEqual(details.approach_upper, 0.6)
            self.assertGreater(details.approach_lower, 0.59)
            point = details.points[0]
            np.testing.assert_allclose(point.point, contact.point, atol=1e-9)
            np.testing.assert_allclose(point.on_link, contact.on_link, atol=1e-9)
            self.assertAlmostEqual(point.separation, contact.separation)
            self.assertEqual((point.lss, point.link_triangle), (0, None))
            self.assertIn(point.triangle, (0, 1))

    def test_have_both_ends_of_what_lies_flat(self):
        """The arm, stretched along X, goes down onto a floor; its velocity is that of the turn."""
        avatar = arm()
        floor = foretouch.Scene.from_arrays([[-9, 0, -9], [9, 0, -9], [0, 0, 9]], [[0, 1, 2]])
        low = avatar.rest_pose()
        low.translations[0, 1] = -1
        step = foretouch.first_contacts(avatar, foretouch.Motion(avatar, avatar.rest_pose(), low),
                                        floor)
        details = step["upper"].details()
        self.assertGreaterEqual(len(details.points), 2)
        ends = sorted(p.on_link[0] for p in details.points)
        np.testing.assert_allclose([ends[0], ends[-1]], [0, 0.3], atol=1e-9)

    def test_of_a_turn_follow_the_whole_chain(self):
        avatar = arm()
        contact = foretouch.first_contacts(avatar, swing(avatar), wall())["fore"]
        details = contact.details()
        rate = np.pi / 2  # about +Y at the origin of the chain
        arm_of_it = contact.on_link - [0, 1, 0]
        np.testing.assert_allclose(details.velocity_of_link,
                                   np.cross([0, rate, 0], arm_of_it), atol=1e-9)
        np.testing.assert_allclose(details.approach_speed,
                                   -details.velocity_of_link @ contact.normal, atol=1e-9)

    def test_are_none_where_nothing_is_touched(self):
        avatar = arm()
        step = foretouch.first_contacts(avatar, swing(avatar, 0.01), wall())
        self.assertIsNone(step["fore"].details())
        self.assertIsNone(foretouch.first_contacts(avatar, swing(avatar), wall(),
                                                   work_budget=0)["fore"].details())

    def test_outlive_the_query_and_the_motion(self):
        avatar = arm()
        contact = foretouch.Query(avatar, wall()).first_contacts(swing(avatar))["fore"]
        expected = contact.details()
        del avatar
        np.testing.assert_array_equal(contact.details().velocity_of_link,
                                      expected.velocity_of_link)


class OnTheWay(unittest.TestCase):
    def test_a_pose_is_that_of_the_closed_form(self):
        avatar = arm()
        motion = swing(avatar, angle=1.2)
        for t in [0.25, 0.5, 0.9]:
            pose = motion.pose_at(t)
            np.testing.assert_allclose(pose.rotations[0], turn([0, 1, 0], 1.2 * t), atol=1e-12)
            np.testing.assert_array_equal(pose.rotations[1], [1, 0, 0, 0])
            np.testing.assert_allclose(pose.translations, avatar.rest_pose().translations)

    def test_the_ends_are_the_poses_themselves(self):
        avatar = arm()
        motion = foretouch.Motion(avatar, bent(avatar, 1, 0.3), bent(avatar, 0, -0.7))
        for t, pose in [(0, motion.start), (1, motion.end)]:
            np.testing.assert_array_equal(motion.pose_at(t).rotations, pose.rotations)
            np.testing.assert_array_equal(motion.pose_at(t).translations, pose.translations)

    def test_many_are_the_single_ones(self):
        motion = swing()
        times = [0.0, 0.3, 1.0]
        poses = motion.pose_at(times)
        self.assertIsInstance(poses, foretouch.Poses)
        self.assertEqual(len(poses), 3)
        for t, pose in zip(times, poses):
            np.testing.assert_array_equal(pose.rotations, motion.pose_at(t).rotations)
        self.assertEqual(len(motion.pose_at([])), 0)

    def test_links_are_where_the_motion_has_them(self):
        avatar = arm()
        motion = foretouch.Motion(avatar, bent(avatar, 1, 0.3), bent(avatar, 0, -0.7))
        pose = motion.pose_at(0.4)
        still = foretouch.Motion(avatar, pose, pose)
        np.testing.assert_allclose(still.transforms(0), motion.transforms(0.4), atol=1e-12)

    def test_instants_outside_are_refused(self):
        for t in [-0.1, 1.1, np.nan]:
            with self.assertRaisesRegex(foretouch.InputError, "t"):
                swing().pose_at(t)


if __name__ == "__main__":
    unittest.main()

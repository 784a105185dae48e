"""Own links: pair rules, and what queries answer by them."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from foretouch import PairRules, Verdict
from support import arm, example, wall


def hands(left=0.5):
    """Two balls of 5 cm on a trunk: the right one at x = -0.2, the left one at x = left."""
    zero = (0, 0, 0)
    return foretouch.Avatar.from_arrays(
        names=["trunk", "left", "right"],
        parents=[-1, 0, 0],
        offsets=[[0, 2, 0], [left, -1, 0], [-0.2, -1, 0]],
        rotations=None,
        lss=[[(zero, zero, 0.1)], [(zero, zero, 0.05)], [(zero, zero, 0.05)]],
    )


def moved(avatar, x):
    """The rest pose with the left hand at x."""
    pose = avatar.rest_pose()
    pose.translations[1, 0] = x
    return pose


class OwnContacts(unittest.TestCase):
    """The left hand goes from 0.5 to -0.7, and meets the right one at x = -0.1."""

    TRUE_TOI = 0.5

    def setUp(self):
        self.avatar, self.scene = hands(), wall()
        self.rules = PairRules.derive(self.avatar)
        self.motion = foretouch.Motion(self.avatar, moved(self.avatar, 0.5),
                                       moved(self.avatar, -0.7))

    def test_are_sound_and_tight(self):
        for tolerance in [1e-2, 1e-3, 1e-6]:
            step = foretouch.first_contacts(self.avatar, self.motion, self.scene, tolerance,
                                            self_pairs=self.rules)
            (pair,) = step.pairs
            self.assertEqual((pair.link, pair.other, pair.other_id), ("left", "right", 2))
            self.assertEqual(pair.verdict, Verdict.CONTACT)
            self.assertLessEqual(pair.toi, self.TRUE_TOI)
            self.assertLessEqual(1.2 * (self.TRUE_TOI - pair.toi), tolerance * (1 + 1e-6))
            self.assertEqual(step.free_prefix, pair.toi)
            self.assertFalse(step.is_clear)
            self.assertEqual(step.contacts, [])

    def test_say_where(self):
        step = foretouch.first_contacts(self.avatar, self.motion, self.scene,
                                        self_pairs=self.rules)
        (pair,) = step.pairs
        np.testing.assert_allclose(pair.point, [-0.15, 1, 0], atol=1e-9)
        np.testing.assert_allclose(pair.normal, [1, 0, 0], atol=1e-9)
        self.assertEqual((pair.object, pair.object_id, pair.triangle), (None, None, None))
        self.assertEqual((pair.lss, pair.other_lss), (0, 0))
        self.assertIsInstance(pair, foretouch.Contact)
        self.assertIn("PairContact: left meets right at t=0.49", repr(pair))
        self.assertIn("1 pairs of own links not clear", repr(step))

    def test_are_none_where_nobody_asked(self):
        step = foretouch.first_contacts(self.avatar, self.motion, self.scene)
        self.assertIsNone(step.pairs)
        self.assertTrue(step.is_clear)
        self.assertEqual(step.free_prefix, 1.0)

    def test_are_those_of_each_step_of_many(self):
        poses = foretouch.Poses.stack([moved(self.avatar, x) for x in [0.5, -0.7, -0.8, 0.9]])
        steps = foretouch.first_contacts_many(self.avatar, poses, self.scene, threads=2,
                                              self_pairs=self.rules)
        self.assertEqual([len(step.pairs) for step in steps], [1, 0, 1])
        for i, step in enumerate(steps):
            alone = foretouch.first_contacts(
                self.avatar, foretouch.Motion(self.avatar, poses[i], poses[i + 1]), self.scene,
                self_pairs=self.rules)
            self.assertEqual([p.toi for p in step.pairs], [p.toi for p in alone.pairs])
        self.assertIsNone(foretouch.first_contacts_many(self.avatar, poses, self.scene)[0].pairs)

    def test_an_undecided_pair_names_both_links(self):
        step = foretouch.first_contacts(self.avatar, self.motion, self.scene, work_budget=0,
                                        self_pairs=self.rules)
        (pair,) = step.pairs
        self.assertEqual((pair.verdict, pair.reason), (Verdict.UNDECIDED, "work-budget"))
        self.assertIsNone(pair.other_lss)
        self.assertIn("left with right is undecided (work-budget)", repr(pair))


class Rules(unittest.TestCase):
    def test_say_what_they_leave_out_and_why(self):
        rules = PairRules.derive(hands())
        self.assertEqual((rules.num_pairs, rules.num_asked), (3, 1))
        self.assertEqual(rules.left_out, [("trunk", "left", "adjacent"),
                                          ("trunk", "right", "adjacent")])
        self.assertEqual(rules.left_out[0].reason, "adjacent")
        self.assertEqual(rules.reason_of("right", "left"), "asked")
        self.assertEqual(rules.reason_of("trunk", 2), "adjacent")
        self.assertIn("1 of 3 pairs asked", repr(rules))

    def test_look_at_usual_poses(self):
        avatar = hands()
        poses = foretouch.Poses.stack([moved(avatar, -0.15)] * 3 + [moved(avatar, 0.5)])
        self.assertEqual(PairRules.derive(avatar, usual_poses=poses).num_asked, 1)
        with self.assertRaisesRegex(foretouch.InputError, "at least one pair"):
            PairRules.derive(avatar, usual_poses=poses, always_share=0.75)

    def test_of_the_example_leave_out_what_its_clip_always_does(self):
        avatar, _, clip = example()
        rules = PairRules.derive(avatar, usual_poses=clip.poses(avatar),
                                 leave_out=[("LeftHand", "RightHand")])
        self.assertEqual(rules.reason_of("RightHand", "LeftHand"), "user")
        self.assertEqual(rules.num_asked + len(rules.left_out), rules.num_pairs)

    def test_can_use_smaller_radii(self):
        avatar = hands(left=-0.12)
        rules = PairRules.derive(avatar, pair_radii=True)
        (own,) = rules.radii
        self.assertEqual(own[:4], ("left", 0, "right", 0))
        self.assertAlmostEqual(own.radius, 0.078)
        same = PairRules.leaving_out(avatar, rules.left_out, rules.radii)
        self.assertEqual((same.left_out, same.radii), (rules.left_out, rules.radii))

    def test_come_back_from_a_file(self):
        avatar = hands()
        rules = PairRules.leaving_out(avatar, [("left", "trunk", "adjacent"), (0, 2)])
        self.assertEqual(rules.reason_of(0, 2), "user")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "hands.pairs.json"
            rules.save(file)
            self.assertEqual(PairRules.load(file, avatar).left_out, rules.left_out)
            with self.assertRaisesRegex(foretouch.InputError, "expected a link of the avatar"):
                PairRules.load(file, arm())

    def test_keep_their_avatar(self):
        avatar = hands()
        self.assertIs(PairRules.derive(avatar).avatar, avatar)

    def test_are_refused_where_they_do_not_fit(self):
        avatar, scene = hands(), wall()
        rules = PairRules.derive(avatar)
        cases = [
            (lambda: foretouch.Query(avatar, scene, self_pairs=True), "self_pairs: expected a"),
            (lambda: foretouch.Query(hands(), scene, self_pairs=rules),
             "self_pairs: expected the rules of this avatar"),
            (lambda: foretouch.Query(avatar, scene, self_pairs=rules, scope="avatar"),
             "self_pairs: expected scope links"),
            (lambda: PairRules.leaving_out(avatar, [("left", "rigth")]), "did you mean 'right'"),
            (lambda: PairRules.leaving_out(avatar, [("left", "left")]), "two different links"),
            (lambda: PairRules.leaving_out(avatar, [("left", "right", "because")]), "'adjacent'"),
            (lambda: PairRules.leaving_out(avatar, [("left",)]), r"left_out\[0\]: expected 2 or more"),
            (lambda: PairRules.leaving_out(avatar, [], [("left", 0, "right", 0)]), r"radii\[0\]"),
            (lambda: PairRules.leaving_out(avatar, [], [("left", 0, "right", 0, 1.0)]),
             "below the sum"),
            (lambda: PairRules.derive(avatar, always_share=0), "always_share: expected"),
            (lambda: PairRules.derive(avatar, leave_out=["left"]), "leave_out"),
            (lambda: rules.reason_of("left", "left"), "two different links"),
        ]
        for call, text in cases:
            with self.assertRaisesRegex(foretouch.InputError, text):
                call()


if __name__ == "__main__":
    unittest.main()

"""Many steps at once are the same steps, for any number of threads."""

import signal
import unittest

import numpy as np

import foretouch
from support import arm, bent, example, wall

ARRAYS = ["verdicts", "toi", "free_until", "separation", "penetration", "triangles", "points",
          "points_on_link", "normals"]


class Batch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        avatar, scene, clip = example()
        cls.query = foretouch.Query(avatar, scene)
        cls.poses = clip.poses(avatar)[::3]
        cls.single = [cls.query.first_contacts(foretouch.Motion(avatar, start, end))
                      for start, end in zip(cls.poses, cls.poses[1:])]

    def check(self, steps, single):
        self.assertEqual(len(steps), len(single))
        for name in ARRAYS:
            expected = np.stack([getattr(step, name) for step in single])
            np.testing.assert_array_equal(getattr(steps, name), expected, err_msg=name)
        for step, alone in zip(steps, single):
            self.assertEqual([repr(c) for c in step.contacts], [repr(c) for c in alone.contacts])
            self.assertEqual(step.counters, alone.counters)

    def test_equals_single_steps(self):
        for threads in [1, 2, 5, None]:
            with self.subTest(threads=threads):
                self.check(self.query.first_contacts_many(self.poses, threads=threads), self.single)

    def test_equals_them_across_pieces_of_work(self):
        poses = foretouch.Poses(np.tile(self.poses.rotations, (9, 1, 1)),
                                np.tile(self.poses.translations, (9, 1, 1)))
        steps = self.query.first_contacts_many(poses)
        self.assertGreater(len(steps), 2 * 1024)
        period = len(self.poses)
        for start in range(0, len(steps), period):
            np.testing.assert_array_equal(steps.toi[start:start + period - 1],
                                          np.stack([step.toi for step in self.single]))

    def test_goes_to_ends_where_they_are_given(self):
        starts, ends = self.poses[:-1], self.poses[1:]
        self.check(self.query.first_contacts_many(starts, ends=ends, threads=2), self.single)

    def test_as_a_function(self):
        avatar, scene, _ = example()
        steps = foretouch.first_contacts_many(avatar, self.poses[:20], scene, 1e-3, threads=2)
        self.check(steps, self.single[:19])

    def test_steps_are_counted_from_either_end(self):
        steps = self.query.first_contacts_many(self.poses)
        np.testing.assert_array_equal(steps[-1].toi, steps[len(steps) - 1].toi)
        self.assertEqual(steps.link_names, self.query.avatar.names)
        self.assertIn("steps of 26 links", repr(steps))
        for index in [len(steps), -len(steps) - 1]:
            with self.assertRaises(IndexError):
                steps[index]

    def test_can_be_interrupted(self):
        avatar = arm()
        poses = foretouch.Poses.stack([avatar.rest_pose(), bent(avatar, 0, 1.5)])
        long = foretouch.Poses(np.tile(poses.rotations, (40_000, 1, 1)),
                               np.tile(poses.translations, (40_000, 1, 1)))
        query = foretouch.Query(avatar, wall(), tolerance=1e-9)

        class Interrupted(Exception):
            pass

        def interrupt(*_):
            raise Interrupted

        before = signal.signal(signal.SIGALRM, interrupt)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with self.assertRaises(Interrupted):
            while True:
                query.first_contacts_many(long, threads=1)


if __name__ == "__main__":
    unittest.main()

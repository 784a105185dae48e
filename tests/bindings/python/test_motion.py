"""Motion.transforms() held against a slerp chain of this file's own."""

import unittest

import numpy as np

import foretouch
from support import arm, bent, example


def product(p, q):
    """Quaternions, w first."""
    w = p[0] * q[0] - p[1:] @ q[1:]
    return np.concatenate([[w], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])])


def slerp(p, q, t):
    """By the angle between them on the shorter arc."""
    q = -q if p @ q < 0 else q
    angle = 2 * np.arctan2(np.linalg.norm(q - p), np.linalg.norm(q + p))
    if angle < 1e-9:
        mixed = (1 - t) * p + t * q
        return mixed / np.linalg.norm(mixed)
    return (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)


def rotated(q, v):
    inverse = q * np.array([1, -1, -1, -1])
    return product(product(q, np.concatenate([[0], v])), inverse)[1:]


def matrix(q, p):
    result = np.eye(4)
    result[:3, :3] = np.stack([rotated(q, axis) for axis in np.eye(3)], axis=1)
    result[:3, 3] = p
    return result


def chain(parents, start, end, t):
    turns, places = [], []
    for j, parent in enumerate(parents):
        q = slerp(start.rotations[j], end.rotations[j], t)
        p = (1 - t) * start.translations[j] + t * end.translations[j]
        if parent >= 0:
            p = places[parent] + rotated(turns[parent], p)
            q = product(turns[parent], q)
        turns.append(q)
        places.append(p)
    return np.stack([matrix(q, p) for q, p in zip(turns, places)])


def random_tree(random, joints):
    parents = [-1] + [int(random.integers(-1, j)) for j in range(1, joints)]
    return foretouch.Avatar.from_arrays(
        [f"joint {j}" for j in range(joints)], parents, random.normal(size=(joints, 3)), None,
        [[((0, 0, 0), (0, 0.1, 0), 0.02)]] * joints)


def random_pose(random, joints):
    turns = random.normal(size=(joints, 4))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    return foretouch.Pose(turns, random.normal(size=(joints, 3)))


class Transforms(unittest.TestCase):
    def test_are_the_slerp_chain(self):
        for seed in range(200):
            with self.subTest(seed=seed):
                random = np.random.default_rng(seed)
                joints = int(random.integers(1, 12))
                avatar = random_tree(random, joints)
                start, end = random_pose(random, joints), random_pose(random, joints)
                times = np.concatenate([[0, 1], random.random(3)])
                found = foretouch.Motion(avatar, start, end).transforms(times)
                for t, transforms in zip(times, found):
                    expected = chain(avatar.parents, start, end, t)
                    np.testing.assert_allclose(transforms, expected, atol=1e-12)

    def test_are_the_slerp_chain_of_the_bundled_clip(self):
        avatar, _, clip = example()
        poses = clip.poses(avatar)
        found = foretouch.Motion(avatar, poses[100], poses[106]).transforms(0.3)
        expected = chain(avatar.parents, poses[100], poses[106], 0.3)
        np.testing.assert_allclose(found, expected, atol=1e-13)

    def test_have_the_shape_of_t(self):
        motion = foretouch.Motion(arm(), arm().rest_pose(), bent(arm(), 1, 1.0))
        self.assertEqual(motion.transforms(0).shape, (2, 4, 4))
        self.assertEqual(motion.transforms(np.float32(0.5)).shape, (2, 4, 4))
        self.assertEqual(motion.transforms(True * 1).shape, (2, 4, 4))
        self.assertEqual(motion.transforms([0.5]).shape, (1, 2, 4, 4))
        self.assertEqual(motion.transforms(np.linspace(0, 1, 7)).shape, (7, 2, 4, 4))
        self.assertEqual(motion.transforms([]).shape, (0, 2, 4, 4))

    def test_refuses_instants_that_are_none(self):
        motion = foretouch.Motion(arm(), arm().rest_pose(), arm().rest_pose())
        for bad in [-1e-9, 1.0000001, float("nan"), float("inf"), "0.5", None, 1j, [[0.5]], [0.1, 2],
                    np.array("x"), {}]:
            with self.subTest(t=bad), self.assertRaisesRegex(foretouch.InputError, "^t"):
                motion.transforms(bad)


class Poses(unittest.TestCase):
    def test_come_back_bit_for_bit(self):
        avatar, _, clip = example()
        poses = clip.poses(avatar)
        motion = foretouch.Motion(avatar, poses[3], poses[9])
        np.testing.assert_array_equal(motion.start.rotations, poses[3].rotations)
        np.testing.assert_array_equal(motion.end.translations, poses[9].translations)

    def test_may_be_plain_pairs_lists_or_strided(self):
        avatar = arm()
        rest = avatar.rest_pose()
        lists = (rest.rotations.tolist(), rest.translations.tolist())
        backwards = (rest.rotations[::-1].copy()[::-1], np.asfortranarray(rest.translations))
        for given in [lists, list(lists), backwards, rest]:
            motion = foretouch.Motion(avatar, given, rest)
            np.testing.assert_array_equal(motion.start.rotations, rest.rotations)

    def test_are_not_shared_with_the_caller(self):
        avatar = arm()
        pose = avatar.rest_pose()
        motion = foretouch.Motion(avatar, pose, pose)
        pose.rotations[:] = 7
        motion.start.rotations[:] = 7
        np.testing.assert_array_equal(motion.start.rotations, avatar.rest_pose().rotations)

    def test_stack_slice_and_iterate(self):
        avatar = arm()
        stack = foretouch.Poses.stack([bent(avatar, 0, a) for a in (0.0, 0.5, 1.0)])
        self.assertEqual((len(stack), len(stack[::2]), len(list(stack))), (3, 2, 3))
        np.testing.assert_array_equal(stack[::2][1].rotations, stack[2].rotations)
        with self.assertRaises(IndexError):
            stack[3]
        with self.assertRaises(foretouch.InputError):
            foretouch.Poses(np.zeros((2, 3, 4)), np.zeros((2, 2, 3)))
        with self.assertRaises(foretouch.InputError):
            foretouch.Poses.stack([])


if __name__ == "__main__":
    unittest.main()

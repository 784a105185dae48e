"""Axes, rotations and quaternions, beside Blender's own."""

import random
import unittest

import blend  # noqa: F401 (finds the add-on)
import numpy as np
from mathutils import Matrix, Quaternion, Vector

from foretouch_blender.axes import (Axes, frames_of, inverted, nearest_rotations, poses_of, quaternions,
                                    rotations_of, strain)


def turned(number):
    generator = random.Random(number)
    axis = Vector([generator.gauss(0, 1) for _ in range(3)]).normalized()
    return Quaternion(axis, generator.choice([1.0, 1e-4, 3.141592, 3.0]) * generator.uniform(-1, 1))


class Axes_(unittest.TestCase):
    def test_up_is_up_and_the_unit_counts(self):
        self.assertEqual(Axes(0.01).points([[100.0, 200.0, 300.0]]).tolist(), [[1.0, 3.0, -2.0]])
        self.assertEqual(Axes(0.01).points_back([[1.0, 3.0, -2.0]]).tolist(), [[100.0, 200.0, 300.0]])

    def test_points_and_moves_agree(self):
        axes = Axes(0.5)
        for number in range(100):
            move = Matrix.Translation((1, 2, 3)) @ turned(number).to_matrix().to_4x4()
            point = Vector((0.3, -0.7, number / 10))
            expected = axes.points(move @ point)
            moved = axes.moves(np.array(move)) @ np.append(axes.points(point), 1.0)
            np.testing.assert_allclose(moved[:3], expected, atol=2e-6)
            np.testing.assert_allclose(axes.moves_back(axes.moves(np.array(move))), np.array(move), atol=1e-12)

    def test_nothing_is_lost_without_a_unit(self):
        points = np.random.default_rng(1).normal(size=(100, 3))
        self.assertTrue(np.array_equal(Axes(1.0).points_back(Axes(1.0).points(points)), points))


class Rotations(unittest.TestCase):
    def test_quaternions_are_blenders(self):
        for number in range(300):
            turn = turned(number)
            found = quaternions(rotations_of(np.array(turn)))
            self.assertAlmostEqual(abs(float(np.dot(found, np.array(turn) / np.linalg.norm(turn)))), 1.0, places=12)
            np.testing.assert_allclose(rotations_of(found), np.array(turn.to_matrix()), atol=1e-6)

    def test_the_nearest_rotation_is_that_of_the_singular_values(self):
        for number in range(100):
            noise = 10.0 ** -(number % 8) * np.random.default_rng(number).normal(size=(3, 3)) / 10
            given = rotations_of(np.array(turned(number))) @ (np.eye(3) + noise)
            u, _, vt = np.linalg.svd(given)
            np.testing.assert_allclose(nearest_rotations(given), u @ vt, atol=1e-7)

    def test_no_length_changes_by_more_than_the_strain(self):
        for number in range(200):
            linear = np.eye(4)
            linear[:3, :3] += 0.3 * np.random.default_rng(number).normal(size=(3, 3))
            most = np.abs(np.linalg.svd(linear[:3, :3], compute_uv=False) - 1.0).max()
            self.assertLessEqual(most, strain(linear))

    def test_poses_of_frames_are_frames_again(self):
        parents = [-1, 0, 1, 0]
        local = np.array([[np.array(Matrix.Translation((k, 1, n)) @ turned(7 * k + n).to_matrix().to_4x4())
                           for n in range(4)] for k in range(5)])
        local[..., :3, :3] = nearest_rotations(local[..., :3, :3])
        frames = local.copy()
        for n, parent in enumerate(parents):
            if parent >= 0:
                frames[:, n] = frames[:, parent] @ local[:, n]
        rotations, places = poses_of(frames, parents)
        np.testing.assert_allclose(rotations_of(rotations), local[..., :3, :3], atol=1e-9)
        np.testing.assert_allclose(places, local[..., :3, 3], atol=1e-9)
        np.testing.assert_allclose(frames_of(rotations, places, parents), frames, atol=1e-9)
        np.testing.assert_allclose(inverted(frames) @ frames, np.broadcast_to(np.eye(4), frames.shape), atol=1e-9)

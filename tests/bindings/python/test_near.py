"""What links are near to. Expected values are closed forms."""

import unittest

import numpy as np

import foretouch
from support import arm, bent, wall

RADIUS, LENGTH, WALL = 0.04, 0.3, -0.3


class NearQuery(unittest.TestCase):
    """An arm along +X, 26 cm from a wall across the z axis."""

    def setUp(self):
        self.avatar = arm()
        self.query = foretouch.NearQuery(self.avatar, wall(WALL))

    def test_a_link_along_a_wall_is_held_at_both_ends(self):
        near = self.query.answer(self.avatar.rest_pose(), 0.27)
        np.testing.assert_array_equal(near.links, [0, 0, 1, 1])
        self.assertEqual(near.features, ["face"] * 4)
        np.testing.assert_allclose(sorted(near.along), [0, 0, 1, 1])
        np.testing.assert_allclose(near.gaps, [-WALL - RADIUS] * 4, atol=1e-12)
        self.assertTrue((near.gaps <= -WALL - RADIUS).all())
        np.testing.assert_allclose(near.normals, [[0, 0, 1]] * 4, atol=1e-12)
        np.testing.assert_allclose(near.points[:, 2], [WALL] * 4)
        np.testing.assert_allclose(near.on_links[:, 2], [-RADIUS] * 4)
        np.testing.assert_allclose(sorted(near.points[:, 0]), [0, 0.3, 0.3, 0.6], atol=1e-12)
        self.assertEqual(near.had_more, [])

    def test_nothing_is_near_beyond_reach(self):
        near = self.query.answer(self.avatar.rest_pose(), 0.25)
        self.assertEqual((len(near.links), near.points.shape), (0, (0, 3)))

    def test_reach_is_per_link_and_below_zero_asks_nobody(self):
        near = self.query.answer(self.avatar.rest_pose(), [-1.0, 0.27])
        np.testing.assert_array_equal(near.links, [1, 1])

    def test_the_nearest_is_one_per_link(self):
        angle = 0.1
        pose = bent(self.avatar, 0, angle)
        near = self.query.answer(pose, 1.0, detail="nearest")
        np.testing.assert_array_equal(near.links, [0, 1])
        far = [LENGTH, 2 * LENGTH]
        np.testing.assert_allclose(near.gaps, [-WALL - RADIUS - d * np.sin(angle) for d in far],
                                   atol=1e-12)

    def test_all_are_every_pair(self):
        near = self.query.answer(self.avatar.rest_pose(), 10.0, detail="all")
        pairs = set(zip(near.links, near.lss, near.triangles))
        self.assertEqual(pairs, {(link, 0, triangle) for link in (0, 1) for triangle in (0, 1)})

    def test_ignored_links_and_objects_are_left_out(self):
        scene = wall(WALL)
        for ignore in (["upper"], [("upper", "wall")]):
            query = foretouch.NearQuery(self.avatar, scene, ignore=ignore)
            near = query.answer(self.avatar.rest_pose(), 1.0)
            self.assertEqual(set(near.links), {1})

    def test_bad_arguments_are_refused_by_name(self):
        pose = self.avatar.rest_pose()
        for reach in (np.nan, 1e8, [0.1], "far", [[0.1, 0.1]]):
            with self.subTest(reach=reach), self.assertRaisesRegex(foretouch.InputError, "reach"):
                self.query.answer(pose, reach)
        with self.assertRaisesRegex(foretouch.InputError, "detail"):
            self.query.answer(pose, 0.1, detail="most")
        with self.assertRaisesRegex(foretouch.InputError, "pose"):
            self.query.answer(([[1, 0, 0, 0]], [[0, 0, 0]]), 0.1)
        with self.assertRaisesRegex(foretouch.InputError, "ignore"):
            foretouch.NearQuery(self.avatar, wall(WALL), ignore=["nobody"])


if __name__ == "__main__":
    unittest.main()

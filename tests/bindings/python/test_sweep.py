"""Swept surfaces: closed, around (or within) what is swept, within the certified error."""

import unittest
from collections import Counter

import numpy as np

import foretouch
from support import arm, bent, swing


def winding(surface, points):
    """How often the surface winds around each point: solid angles by van Oosterom and Strackee."""
    a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    total = []
    for point in points:
        u, v, w = a - point, b - point, c - point
        lengths = [np.linalg.norm(x, axis=1) for x in (u, v, w)]
        above = np.einsum("ij,ij->i", u, np.cross(v, w))
        below = (lengths[0] * lengths[1] * lengths[2]
                 + np.einsum("ij,ij->i", u, v) * lengths[2]
                 + np.einsum("ij,ij->i", v, w) * lengths[0]
                 + np.einsum("ij,ij->i", w, u) * lengths[1])
        total.append(2 * np.arctan2(above, below).sum() / (4 * np.pi))
    return np.array(total)


def on_axis(motion, t, share):
    transform = motion.transforms(t)[1]
    return transform[:3, :3] @ [0.3 * share, 0, 0] + transform[:3, 3]


class Sweep(unittest.TestCase):
    def setUp(self):
        self.avatar = arm()
        self.motion = swing(self.avatar)
        random = np.random.default_rng(5)
        self.directions = random.normal(size=(40, 3))
        self.directions /= np.linalg.norm(self.directions, axis=1, keepdims=True)
        self.swept = [on_axis(self.motion, t, s) + d * 0.04 * r for t, s, r, d in zip(
            random.random(40), random.random(40), random.random(40), self.directions)]

    def assert_closed(self, surface):
        edges = Counter()
        for triangle in surface.triangles:
            for k in range(3):
                edges[(triangle[k], triangle[(k + 1) % 3])] += 1
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))

    def test_outer_surface_encloses_what_is_swept(self):
        surface = foretouch.swept_surface(self.motion, "fore", error=0.005)
        self.assert_closed(surface)
        self.assertLessEqual(surface.certified_error, 0.005)
        self.assertTrue((winding(surface, self.swept) > 0.5).all())
        far = [on_axis(self.motion, 0.5, 0.5) + [0, y, 0] for y in (-0.06, 0.06)]
        np.testing.assert_allclose(winding(surface, far), 0, atol=1e-6)
        self.assertEqual(surface.times.shape, (len(surface.vertices),))
        self.assertTrue(((surface.times >= 0) & (surface.times <= 1)).all())

    def test_inner_surface_encloses_nothing_else(self):
        surface = foretouch.swept_surface(self.motion, "fore", error=0.005, side="inner")
        self.assert_closed(surface)
        self.assertTrue((np.abs(surface.vertices[:, 1] - 1) <= 0.04).all())
        middle = [on_axis(self.motion, t, 0.5) for t in np.linspace(0.05, 0.95, 9)]
        self.assertTrue((winding(surface, middle) > 0.5).all())

    def test_goes_on_over_several_motions(self):
        back = foretouch.Motion(self.avatar, self.motion.end, bent(self.avatar, 0, 2.5))
        surface = foretouch.swept_surface([self.motion, back], 1, error=0.01)
        self.assert_closed(surface)
        self.assertTrue((winding(surface, self.swept) > 0.5).all())
        self.assertGreater(surface.times.max(), 1.5)
        self.assertTrue((winding(surface, [on_axis(back, 1, 0.9)]) > 0.5).all())

    def test_holds_all_lss_of_a_link(self):
        avatar = foretouch.Avatar.from_arrays(
            ["hand"], [-1], [[0, 0, 0]], None,
            [[((0, 0, 0), (0, 0, 0), 0.1), ((1, 0, 0), (1, 0, 0), 0.1)]])
        still = foretouch.Motion(avatar, avatar.rest_pose(), avatar.rest_pose())
        surface = foretouch.swept_surface(still, "hand", error=0.01)
        self.assert_closed(surface)
        np.testing.assert_allclose(winding(surface, [[0, 0, 0], [1, 0, 0], [0.5, 0, 0]]), [1, 1, 0],
                                   atol=1e-6)

    def test_single_precision_fits_floats(self):
        surface = foretouch.swept_surface(self.motion, "fore", error=0.01, single_precision=True)
        np.testing.assert_array_equal(surface.vertices, surface.vertices.astype(np.float32))

    def test_thin_lss_have_no_inner_surface(self):
        surface = foretouch.swept_surface(self.motion, "fore", error=0.2, side="inner")
        self.assertEqual((surface.vertices.shape, surface.triangles.shape), ((0, 3), (0, 3)))


if __name__ == "__main__":
    unittest.main()

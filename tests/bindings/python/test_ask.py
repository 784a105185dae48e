"""Rays, casts and shapes against a world at an instant, and what is refused or unknown."""

import unittest

import numpy as np

import foretouch as ft


def rod():
    """One metre up from its joint."""
    return ft.Avatar.from_arrays(["rod"], [-1], [[0, 0, 0]], None,
                                 [[((0, 0, 0), (0, 1, 0), 0.1)]])


def turned(quarter):
    """About z by so many quarter turns."""
    half = 0.25 * np.pi * quarter
    return np.array([np.cos(half), 0, 0, np.sin(half)]), np.zeros(3)


class Ask(unittest.TestCase):
    def setUp(self):
        self.world = ft.World()
        self.rod = self.world.add(rod())
        self.world.push(self.rod, 0, turned(0))
        self.world.push(self.rod, 1000, turned(1))

    def test_a_ray_meets_the_rod_where_its_motion_has_it(self):
        tip = np.sqrt(0.5) * np.array([-0.95, 0.95, 0])
        ask = lambda when: self.world.probe(when, tip + [0, 0, 2], direction=[0, 0, -1])
        self.assertEqual(ask(0).verdict, "clear")
        self.assertEqual(ask(1000).verdict, "clear")
        answer = ask(500)
        self.assertEqual(answer.verdict, "hit")
        self.assertTrue(answer.is_complete)
        (hit,) = answer.hits
        self.assertAlmostEqual(hit.distance, 1.9, places=8)
        self.assertEqual((hit.what.body, hit.what.link, hit.what.lss), (self.rod, "rod", 0))
        np.testing.assert_allclose(hit.normal, [0, 0, 1], atol=1e-8)
        self.assertEqual(ask((500, 0.25)).verdict, "hit")

    def test_a_body_at_an_instant_of_its_own(self):
        tip = np.sqrt(0.5) * np.array([-0.95, 0.95, 0])
        answer = self.world.probe(1000, tip + [0, 0, 2], direction=[0, 0, -1],
                                  instants={self.rod: 500})
        self.assertEqual(answer.verdict, "hit")

    def test_casts_overlaps_and_the_nearest(self):
        cast = self.world.probe(0, ([0.0, 0.5, 2], 0.25), direction=[0, 0, -1])
        self.assertAlmostEqual(cast.hits[0].distance, 1.65, places=8)
        capsule = ([1, 0.5, 0], [2, 0.5, 0], 0.1)
        self.assertEqual(self.world.probe(0, capsule).verdict, "clear")
        of_arrays = (np.array([1, 0.5, 0]), np.array([2, 0.5, 0]), 0.1)
        self.assertEqual(self.world.probe(0, of_arrays).verdict, "clear")
        self.assertEqual(self.world.probe(0, tuple(np.array([0, 0.5, 0]))).verdict, "hit")
        near = self.world.probe(0, capsule, within=1.0)
        self.assertAlmostEqual(near.hits[0].distance, 0.8, places=8)
        self.assertEqual(self.world.probe(0, ([0, 0.5, 0.2], 0.15)).verdict, "hit")

    def test_a_skin_is_met_as_it_is_bent(self):
        arm = ft.Avatar.from_arrays(
            ["upper", "lower"], [-1, 0], [[0, 0, 0], [0, 1, 0]], None,
            [[((0, 0, 0), (0, 1, 0), 0.1)], [((0, 0, 0), (0, 1, 0), 0.1)]])
        # A sheet across the elbow, whose corners follow both links half and half.
        corners = np.array([[-1, 1, 0.5], [1, 1, 0.5], [0, 2, 0.5]], float)
        links = np.tile([0, 1], (3, 1))
        points = np.stack([corners, corners - [0, 1, 0]], axis=1)
        make = lambda **more: ft.Skin.from_arrays(
            **{"avatar": arm, "triangles": [[0, 1, 2]], "triangle_links": [1], "links": links,
               "weights": np.full((3, 2), 0.5), "points": points, **more})
        skin = make()
        self.assertEqual((skin.avatar, skin.num_triangles), (arm, 1))
        world = ft.World()
        body = world.add(arm, skin=skin)
        half = np.sqrt(0.5)
        straight = np.array([[1.0, 0, 0, 0]] * 2)
        bent = np.array([[1.0, 0, 0, 0], [half, half, 0, 0]])  # a quarter about x
        offsets = np.array([[0.0, 0, 0], [0, 1, 0]])
        world.push(body, 0, (straight, offsets))
        world.push(body, 1000, (bent, offsets))
        ask = lambda us: world.probe(us, [0, 1.1, 5], direction=[0, 0, -1]).hits[0]
        (hit, late) = ask(0), ask(1000)
        self.assertAlmostEqual(hit.distance, 4.5, places=8)
        self.assertEqual((hit.what.link, hit.what.triangle), ("lower", 0))
        # Half of it is turned a quarter about the elbow: linear blend skinning, by hand.
        turned = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        there = 0.5 * corners + 0.5 * ((corners - [0, 1, 0]) @ turned.T + [0, 1, 0])
        (a, b, c) = there
        normal = np.cross(b - a, c - a)
        z = a[2] - (normal[0] * (0 - a[0]) + normal[1] * (1.1 - a[1])) / normal[2]
        self.assertGreater(abs(z - 0.5), 0.05)
        self.assertAlmostEqual(late.distance, 5 - z, places=8)
        for bad, words in [({"triangle_links": [2]}, "links of the avatar"),
                           ({"triangles": [[0, 1, 3]]}, "vertices of the skin"),
                           ({"weights": np.full((3, 2), 0.4)}, "sum to one"),
                           ({"links": np.tile([0, 5], (3, 1))}, "a link of the avatar")]:
            with self.assertRaisesRegex(ft.InputError, words):
                make(**bad)
        with self.assertRaisesRegex(ft.InputError, "skin: expected a foretouch.Skin"):
            world.add(arm, skin=1)
        with self.assertRaisesRegex(ft.InputError, "skin of this avatar"):
            world.add(rod(), skin=skin)

    def test_filters_by_body_and_link(self):
        for part in (self.rod, (self.rod, "rod")):
            answer = self.world.probe(0, [0, 0.5, 2], direction=[0, 0, -1], without=[part])
            self.assertEqual(answer.verdict, "clear")
        answer = self.world.probe(0, [0, 0.5, 2], direction=[0, 0, -1], groups=[3])
        self.assertEqual(answer.hits, [])

    def test_a_flight_meets_what_moves_meanwhile(self):
        # A ball comes down where the tip is halfway through its turn, when it is there.
        tip = np.sqrt(0.5) * np.array([-0.9, 0.9, 0])
        hit = self.world.fly(0, 1000, (tip + [0, 0, 1], 0.05), [0, 0, -2])
        self.assertEqual(hit.verdict, "hit")
        # At 0.85 m it would meet the rod if that were there already.
        self.assertTrue(0.85 < hit.hit.distance < 0.95)
        self.assertAlmostEqual(hit.time_us + hit.fraction, 500 * hit.hit.distance, places=6)
        late = self.world.fly(0, 1000, (tip + [0, 0, 2], 0.05), [0, 0, -2.2])
        self.assertEqual((late.verdict, late.hit), ("clear", None))
        unknown = self.world.fly(500, 3000, (tip + [5, 0, 2], 0.05), [0, 0, -1])
        self.assertEqual((unknown.verdict, unknown.unknown[0].why), ("unknown", "silent"))

    def test_what_is_unknown_is_no_miss(self):
        answer = self.world.probe(2000, [5, 5, 5], direction=[0, 0, 1])
        self.assertEqual(answer.verdict, "unknown")
        self.assertEqual(answer.unknown, [(self.rod, "silent", None)])

    def test_a_box_is_cast_overlaps_and_is_near(self):
        box = np.array([[x, y, z] for x in (-1, 1) for y in (0, 1) for z in (-1, 1)]) * 0.25
        cast = self.world.probe(0, box + [0, 0.5, 2], direction=[0, 0, -1])
        self.assertAlmostEqual(cast.hits[0].distance, 2 - 0.25 - 0.1, delta=1e-8)
        rounded = self.world.probe(0, (box + [0, 0.5, 2], 0.05), direction=[0, 0, -1])
        self.assertAlmostEqual(rounded.hits[0].distance, 2 - 0.25 - 0.15, delta=1e-8)
        near = self.world.probe(0, box + [1, 0.5, 0], within=1.0)
        self.assertAlmostEqual(near.hits[0].distance, 0.65, delta=1e-8)
        self.assertEqual(self.world.probe(0, box + [0.3, 0.5, 0]).verdict, "hit")
        self.assertEqual(self.world.probe(0, box + [0.4, 0.5, 0]).verdict, "clear")
        flight = self.world.fly(0, 1000, box + [0, 0, 2], [0, 0, -4])
        self.assertEqual(flight.verdict, "hit")

    def test_a_point_is_inside_of_what_is_closed(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        faces = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
        for closed in (True, False):
            world = ft.World(ft.Scene.from_arrays(corners, faces if closed else faces[1:]))
            answer = world.probe(0, [0.1, 0.1, 0.1], which="all", solids=True)
            if closed:
                hit = answer.hits[0]
                self.assertEqual((hit.distance, hit.what.triangle, hit.what.object), (0.0, None, "object_0"))
            else:
                self.assertEqual(answer.unknown, [(None, "open", 0)])
                self.assertEqual(answer.verdict, "unknown")
            self.assertEqual(world.probe(0, [0.1, 0.1, 0.1]).verdict, "clear")
            self.assertEqual(world.probe(0, [2, 2, 2], solids=True).verdict, "clear")

    def test_many_have_the_bits_of_each_alone(self):
        random = np.random.default_rng(3)
        n = 200
        a = random.uniform(-1, 1, (n, 3))
        way = random.uniform(-0.5, 0.5, (n, 3)) - a
        times = random.integers(0, 1000, n)
        radius, reach = random.uniform(0, 0.1, n), random.uniform(0.1, 3, n)
        many = self.world.probe_many(times, a, radius=radius, direction=way, reach=reach,
                                     instants={self.rod: times[::-1].copy()})
        self.assertTrue(10 < (many.verdict == 1).sum() < n - 10)
        for i in range(n):
            alone = self.world.probe(int(times[i]), (a[i], float(radius[i])), direction=way[i],
                                     reach=float(reach[i]), instants={self.rod: int(times[n - 1 - i])})
            self.assertEqual(["clear", "hit", "unknown"][many.verdict[i]], alone.verdict)
            if not alone.hits:
                self.assertTrue(np.isnan(many.distance[i]) and many.body[i] == -1)
                continue
            self.assertEqual(many.distance[i], alone.hits[0].distance)
            np.testing.assert_array_equal(many.point[i], alone.hits[0].what.point)
            np.testing.assert_array_equal(many.normal[i], alone.hits[0].normal)
        for message, arguments in {
            "direction": dict(direction=way[1:]),
            "'all'|which": dict(which="all"),
            "radius": dict(radius=radius[1:]),
            "question 7": dict(direction=np.where(np.arange(n)[:, None] == 7, 0.0, way)),
        }.items():
            with self.subTest(message):
                with self.assertRaisesRegex(ft.InputError, message):
                    self.world.probe_many(0, a, **arguments)

    def test_refuses_by_name(self):
        for message, arguments in {
            "direction": dict(direction=[0, 0, 0]),
            "reach": dict(direction=[0, 0, 1], reach=float("inf")),
            "within": dict(direction=[0, 0, 1], within=1.0),
            "body 7": dict(without=[7]),
            "which": dict(which="first"),
        }.items():
            with self.subTest(message):
                with self.assertRaisesRegex(ft.InputError, message):
                    self.world.probe(0, [0, 0, 0], **arguments)


if __name__ == "__main__":
    unittest.main()

"""From enter to leave: a ball that flies through another one, computed by hand; what it weighs; and
who is silent. Input that is wrong is refused by name."""

import math
import unittest

import numpy as np

import foretouch as ft

SPEED = 10.0
TOLERANCE = 1e-3


def ball(radius, links=1):
    names = [f"link{i}" for i in range(links)]
    return ft.Avatar.from_arrays(names, [-1] + list(range(links - 1)), [[0, 0, 0]] * links, None,
                                 [[((0, 0, 0), (0, 0, 0), radius)] for _ in range(links)])


def place(x, y=0.0):
    return np.array([1.0, 0, 0, 0]), np.array([x, y, 0.0])


def exact(event):
    return event.time_us + event.fraction


def passing(world, when_silent="wait", until=100_000):
    """One of 2 cm stands at 0; the other one passes it at 10 m/s from -0.5 to 0.5."""
    one = world.add(ball(0.02))
    other = world.add(ball(0.03), when_silent=when_silent)
    for us in (0, 100_000):
        world.push(one, us, place(0.0))
    for us in (0, until):
        world.push(other, us, place(-0.5 + SPEED * 1e-6 * us))
    return one, other


class Events(unittest.TestCase):
    def test_an_enter_and_a_leave_within_one_step(self):
        world = ft.World(tolerance=TOLERANCE)
        one, other = passing(world)
        follower = ft.Follower(world, 0)
        follower.weigh(one, 3.0)
        follower.weigh(other, 1.0, center=[0, 0, 0], inertia=np.eye(3))
        told = follower.follow(100_000)
        self.assertEqual((told.from_us, told.to_us, told.silent), (0, 100_000, []))
        enter, leave = told.events
        self.assertEqual((enter.kind, leave.kind), ("enter", "leave"))
        # They touch while their centres are within 5 cm: from 45 to 55 ms.
        self.assertLessEqual(exact(enter), 45_000)
        self.assertGreaterEqual(exact(enter), 45_000 - 1e6 * TOLERANCE / SPEED - 1e-3)
        self.assertGreaterEqual(exact(leave), 55_000)
        self.assertLessEqual(exact(leave), 55_000 + 2e6 * TOLERANCE / SPEED + 1e-3)
        self.assertEqual((leave.since_us, leave.since_fraction), (enter.time_us, enter.fraction))
        self.assertEqual((enter.a.body, enter.b.body), (one, other))
        self.assertEqual((enter.a.link, enter.b.link_id), ("link0", 0))
        np.testing.assert_allclose(enter.normal, [1, 0, 0], atol=1e-9)
        np.testing.assert_allclose(enter.velocity, [-SPEED, 0, 0], atol=1e-9)
        self.assertAlmostEqual(enter.approach_speed, SPEED)
        self.assertLessEqual(enter.approach_lower, SPEED)
        self.assertGreaterEqual(enter.approach_upper, SPEED)
        self.assertAlmostEqual(enter.effective_mass, 1 / (1 / 3 + 1 / 1))
        self.assertLessEqual(enter.separation, TOLERANCE)
        self.assertGreaterEqual(len(enter.points), 1)
        self.assertAlmostEqual(enter.points[0].a[0], -0.02, delta=1e-9)
        self.assertFalse(enter.is_not_asked or enter.is_assumed)
        (part,) = told.parts
        self.assertEqual(part.kind, "contact")
        self.assertEqual((part.from_us, part.to_us), (enter.time_us, leave.time_us))
        self.assertFalse(part.goes_on or part.began_before)
        self.assertEqual(follower.open, [])
        self.assertEqual(follower.followed_until, 100_000)
        self.assertEqual(follower.follow(100_000).events, [])

    def test_what_goes_on_is_open_and_tells_since_when(self):
        world = ft.World()
        passing(world)
        follower = ft.Follower(world, 0, threads=2)
        for us in (50_000,):
            (enter,) = follower.follow(us).events
            self.assertEqual(enter.effective_mass, math.inf)
        (now,) = follower.open
        self.assertEqual((now.kind, now.since_us, now.reason), ("contact", enter.time_us, None))
        told = follower.follow(100_000)
        self.assertTrue(told.parts[0].began_before)
        self.assertEqual([e.kind for e in told.events], ["leave"])

    def test_from_within_it_starts_inside(self):
        world = ft.World()
        passing(world)
        (inside, leave) = ft.Follower(world, 50_000).follow(100_000).events
        self.assertEqual((inside.kind, leave.kind), ("starts_inside", "leave"))
        self.assertEqual(inside.time_us, 50_000)
        self.assertGreater(inside.penetration, 0)

    def test_nothing_is_claimed_of_who_is_silent(self):
        world = ft.World()
        _, other = passing(world, when_silent="undecided", until=20_000)
        told = ft.Follower(world, 0).follow(100_000)
        self.assertEqual([e.kind for e in told.events], ["unresolved_from"])
        event = told.events[0]
        self.assertEqual((event.time_us, event.reason), (20_000, "gap"))
        self.assertEqual((event.a.body, event.b.body), (other, ft.EVERY_BODY))
        self.assertEqual([(s.body, s.taken_to) for s in told.silent], [(other, "undecided")])
        (part,) = told.parts
        self.assertEqual((part.kind, part.reason, part.goes_on), ("unresolved", "gap", True))

    def test_what_rests_on_who_holds_still_says_so(self):
        world = ft.World()
        one = world.add(ball(0.02))
        other = world.add(ball(0.03), when_silent="hold-still")
        for us, x in ((0, 0.0), (20_000, 0.0)):
            world.push(other, us, place(x))
        for us, x in ((0, 0.5), (100_000, -0.5)):
            world.push(one, us, place(x))
        told = ft.Follower(world, 0).follow(100_000)
        self.assertEqual([(e.kind, e.is_assumed) for e in told.events],
                         [("enter", True), ("leave", True)])
        self.assertEqual([p.is_assumed for p in told.parts], [True])
        self.assertEqual([(s.body, s.taken_to) for s in told.silent], [(other, "hold-still")])

    def test_who_takes_it_ends_the_contact_unasked(self):
        world = ft.World()
        one, other = passing(world)
        world.attach(other, one, 50_000, place(0.0))
        world.push(one, 150_000, place(0.0))
        leaves = [e for e in ft.Follower(world, 0).follow(100_000).events if e.kind == "leave"]
        self.assertEqual([e.is_not_asked for e in leaves], [True])

    def test_who_is_put_elsewhere_leaves_where_it_was(self):
        world = ft.World()
        one, other = passing(world)
        hand = world.add(ball(0.02))
        world.push(hand, 0, place(9.0))
        world.push(hand, 100_000, place(9.0))
        world.attach(other, hand, 50_000, place(1.0))
        (leave,) = [e for e in ft.Follower(world, 0).follow(100_000).events if e.kind == "leave"]
        self.assertTrue(leave.is_moved and not leave.is_not_asked)
        self.assertEqual(leave.time_us, 50_000)
        self.assertGreater(leave.penetration, 0)
        self.assertLess(abs(leave.a.point[0]), 1)

    def test_objects_of_a_scene_are_named(self):
        floor = ft.Scene.from_arrays([[-9, 0, -9], [9, 0, -9], [0, 0, 9]], [[0, 1, 2]])
        world = ft.World(floor)
        body = world.add(ball(0.1))
        world.push(body, 0, place(0.0, 1.0))
        world.push(body, 100_000, place(0.0, 0.05))
        (enter,) = ft.Follower(world, 0).follow(100_000).events
        self.assertIsNone(enter.b.body)
        self.assertEqual(enter.b.object, floor.object_names[0])
        np.testing.assert_allclose(enter.normal, [0, 1, 0], atol=1e-9)

    def test_it_refuses_by_name(self):
        world = ft.World()
        one, _ = passing(world)
        for given, word in (({"threads": 0}, "threads"), ({"cut_us": -1}, "cut"),
                            ({"threads": 1.5}, "threads")):
            with self.subTest(given), self.assertRaisesRegex(ft.InputError, word):
                ft.Follower(world, 0, **given)
        with self.assertRaisesRegex(ft.InputError, "from_us"):
            ft.Follower(world, 1 << 60)
        follower = ft.Follower(world, 0)
        for call, word in ((lambda: follower.weigh(7, 1.0), "body"),
                           (lambda: follower.weigh(one, -1.0), "kg"),
                           (lambda: follower.weigh(one, math.nan), "kg"),
                           (lambda: follower.weigh(one, 1.0, center=[0, 0, 0]), "inertia"),
                           (lambda: follower.weigh(one, 1.0, center=[0, 0, 0], inertia=[1, 2, 3]),
                            "inertia"),
                           (lambda: follower.follow(10**9), "")):
            with self.subTest(word), self.assertRaisesRegex(ft.InputError, word):
                call()
        self.assertEqual([e.kind for e in follower.follow(100_000).events], ["enter", "leave"])


if __name__ == "__main__":
    unittest.main()

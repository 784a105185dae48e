"""A solid hand among what moves: a door pushes it, a press crushes it, it holds a ball, and what it
enters and leaves is when its shown way says so, by plain arithmetic. Wrong input is refused by
name."""

import unittest

import numpy as np

import foretouch as ft

TICK = 10_000
SKIN = 2e-3
TOLERANCE = 1e-4
RADIUS = 0.05


def ball(name, radius):
    return ft.Avatar.from_arrays([name], [-1], [[0, 0, 0]], None,
                                 [[((0, 0, 0), (0, 0, 0), radius)]])


def sheet(x, half=2.0):
    """A square across the x axis."""
    vertices = [[x, -half, -half], [x, half, -half], [x, half, half], [x, -half, half]]
    return ft.Scene.from_arrays(vertices, [[0, 1, 2], [0, 2, 3]], [0, 0], ["sheet"])


def at(x, y=0.0):
    return ft.Pose(np.array([[1.0, 0, 0, 0]]), np.array([[x, y, 0.0]]))


def room(**options):
    """A hand of 5 cm before a wall at x = 1."""
    world = ft.SolidWorld(sheet(1.0), 0, tolerance=TOLERANCE, **options)
    return world, world.add(ball("hand", RADIUS), skin=SKIN)


def exact(event):
    return event.time_us + event.fraction


class Shown:
    """The way that the hand was shown on, as a line through instants; of a ball, motions are
    straight."""

    def __init__(self):
        self.knots = []  # (us, x)

    def add(self, tick, begin_us, end_us):
        last = begin_us
        for time, pose in zip(tick.times, tick.way):
            last = begin_us + time * (end_us - begin_us)
            self.knots.append((last, pose.translations[0, 0]))
        if last < end_us:
            self.knots.append((end_us, tick.shown.translations[0, 0]))

    def crossing(self, x, rises):
        """The first instant at which it comes to x so."""
        for (t0, x0), (t1, x1) in zip(self.knots, self.knots[1:]):
            if (x0 < x <= x1) if rises else (x0 > x >= x1):
                return t0 + (x - x0) / (x1 - x0) * (t1 - t0)
        raise AssertionError("it never does")


class SolidWorld(unittest.TestCase):
    def test_enters_a_wall_that_stops_it_and_leaves_it(self):
        world, hand = room()
        shown, events = Shown(), []
        for k in range(1, 101):
            x = 0.5 + 0.012 * min(k, 100 - k)
            tick = world.tick(TICK * k, {hand: at(x)})[hand]
            self.assertTrue(tick.tick.is_certified)
            self.assertLessEqual(tick.tick.shown.translations[0, 0], 1.0 - RADIUS)
            shown.add(tick.tick, TICK * (k - 1), TICK * k)
            events += world.follow().events
        enter, leave = events
        self.assertEqual((enter.kind, leave.kind), ("enter", "leave"))
        self.assertEqual((enter.a.body, enter.a.link, enter.b.object), (hand, "hand", "sheet"))
        # It reaches to its skin: it is apart below `apart`, and within the tolerance from `near` on.
        apart = 1.0 - RADIUS - SKIN
        near = apart - TOLERANCE
        self.assertLessEqual(exact(enter), shown.crossing(apart - 1e-9, True) + 1)
        self.assertGreaterEqual(exact(enter), shown.crossing(near - 1e-9, True) - 1)
        self.assertGreaterEqual(exact(leave), shown.crossing(apart, False) - 1)
        self.assertLessEqual(exact(leave), shown.crossing(apart - 2 * TOLERANCE - 1e-9, False) + 1)
        self.assertEqual(world.utime, 100 * TICK)

    def test_a_door_pushes_it_and_is_told(self):
        world, hand = room()
        door = world.world.add(sheet(0.0))
        world.world.push(door, 0, at(-1.0))
        kinds, pushed = [], 0.0
        for k in range(1, 61):
            # The door goes sideways as well, at 0.5 m/s.
            world.world.push(door, TICK * k, at(-1.0 + 0.02 * min(k, 120 - k), 0.005 * k))
            tick = world.tick(TICK * k, {hand: at(0.0)})[hand]
            kinds += [(e.kind, e.b.body) for e in world.follow().events]
            for contact in tick.contacts:
                self.assertEqual((contact.body, contact.link, contact.object),
                                 (door, "hand", "sheet"))
                np.testing.assert_allclose(contact.normal, [1, 0, 0], atol=1e-9)
                self.assertAlmostEqual(contact.slip_speed, 0.5, delta=1e-6)
                pushed = max(pushed, contact.push)
            self.assertEqual(tick.crushes, [])
        self.assertEqual(kinds, [("enter", door)])
        self.assertGreater(pushed, 0.0)
        self.assertGreaterEqual(tick.tick.shown.translations[0, 0], 0.2 + RADIUS)

    def test_a_press_crushes_it_and_is_said(self):
        world, hand = room()
        press = world.world.add(sheet(0.0))
        world.world.push(press, 0, at(0.5))
        crushes = []
        for k in range(1, 61):
            world.world.push(press, TICK * k, at(0.5 + 0.01 * min(k, 43)))
            crushes += world.tick(TICK * k, {hand: at(0.8)})[hand].crushes
        self.assertEqual({(c.body, c.link, c.is_over) for c in crushes}, {(press, "hand", False)})
        self.assertGreater(crushes[-1].depth, 0.0)

    def test_a_ball_in_its_hand_stops_it(self):
        world, hand = room()
        held = world.world.add(ball("ball", 0.03))
        world.world.push(held, 0, at(0.5, 0.1))
        world.world.push(held, TICK, at(0.5, 0.1))
        world.tick(TICK, {hand: at(0.5)})
        world.world.attach(held, hand, TICK, at(0.1))
        for k in range(2, 80):
            tick = world.tick(TICK * k, {hand: at(0.5 + 0.01 * k)})[hand]
        self.assertEqual((tick.tools, tick.loose_tools, tick.let_go), ([held], [], []))
        self.assertLessEqual(tick.tick.shown.translations[0, 0] + 0.1 + 0.03, 1.0)

    def test_lost_trackers_and_targets_that_are_left_out(self):
        world, hand = room()
        world.tick(TICK, {hand: at(0.5)})
        tick = world.tick(2 * TICK, {hand: at(0.7)}, {hand: [False]})[hand]
        self.assertEqual(tick.tick.joints[0], ft.SolidJointState.LOST)
        self.assertEqual(tick.tick.shown.translations[0, 0], 0.5)
        self.assertEqual(list(world.tick(3 * TICK, {})), [hand])

    def test_reaching_to_the_surface_touches_nothing(self):
        world, hand = room(reach="surface")
        told = []
        for k in range(1, 60):
            world.tick(TICK * k, {hand: at(0.5 + 0.012 * k)})
            told += world.follow().events
        self.assertEqual(told, [])

    def test_wrong_input_is_refused_by_name(self):
        world, hand = room()
        prop = world.world.add(sheet(0.0))
        for call, word in (
            (lambda: ft.SolidWorld(sheet(1.0), 0, reach="far"), "reach"),
            (lambda: ft.SolidWorld(sheet(1.0), 2**60), "begin"),
            (lambda: world.add(ball("hand", 0.1), skin=-1.0), "skin"),
            (lambda: world.add(ball("hand", 0.1), may_snap=True), "may_snap"),
            (lambda: world.tick(0, {hand: at(0.5)}), "utime"),
            (lambda: world.tick(TICK, {7: at(0.5)}), "body"),
            (lambda: world.tick(TICK, {prop: at(0.5)}), "targets"),
            (lambda: world.tick(TICK, {hand: at(np.nan)}), "targets"),
            (lambda: world.tick(TICK, {hand: at(0.5)}, {prop: [True]}), "is_tracked"),
        ):
            with self.assertRaisesRegex(ft.InputError, word):
                call()
        with self.assertRaisesRegex(TypeError, "skim"):
            world.add(ball("hand", 0.1), skim=1.0)
        self.assertEqual(world.utime, 0)


if __name__ == "__main__":
    unittest.main()

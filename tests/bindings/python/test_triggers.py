"""Triggers, and how deep: a hand that passes through a thin box, and one that is inside."""

import unittest

import numpy as np

import foretouch as ft


def ball(radius):
    return ft.Avatar.from_arrays(["ball"], [-1], [[0, 0, 0]], None,
                                 [[((0, 0, 0), (0, 0, 0), radius)]])


def place(x):
    return np.array([1.0, 0, 0, 0]), np.array([x, 0.0, 0.0])


class Triggers(unittest.TestCase):
    def test_a_hand_that_passes_through_within_one_step_enters_and_leaves(self):
        world = ft.World()
        hand = world.add(ball(0.02))
        triggers = ft.Triggers(world, 0)
        box = triggers.add_box([0.01, 0.5, 0.5])
        triggers.stand(box, 0, [0, 0, 0])
        world.push(hand, 0, place(-1.0))
        world.push(hand, 100_000, place(1.0))
        enter, leave = triggers.follow(100_000)
        self.assertEqual((enter.kind, leave.kind), ("enter", "leave"))
        self.assertEqual((enter.trigger, enter.body), (box, hand))
        self.assertAlmostEqual(enter.time_us, 48_500, delta=100)
        self.assertAlmostEqual(leave.time_us, 51_500, delta=100)
        self.assertEqual(leave.since_us, enter.time_us)
        self.assertEqual(triggers.occupants, [])

    def test_who_is_inside_starts_inside(self):
        world = ft.World()
        hand = world.add(ball(0.02))
        triggers = ft.Triggers(world, 0)
        room = triggers.add_box([1, 1, 1])
        near = triggers.add_sphere(0.5, by_link=True)
        for trigger in (room, near):
            triggers.stand(trigger, 0, [0, 0, 0])
        world.push(hand, 0, place(0.0))
        world.push(hand, 1000, place(0.0))
        events = triggers.follow(1000)
        self.assertEqual([e.kind for e in events], ["starts_inside"] * 2)
        self.assertEqual([o.link for o in triggers.occupants], [None, 0])

    def test_refuses_what_has_no_inside(self):
        triggers = ft.Triggers(ft.World(), 0)
        with self.assertRaises(ft.InputError):
            triggers.add_box([1, 0, 1])
        with self.assertRaises(ft.InputError):
            triggers.add_sphere(-1.0)
        with self.assertRaisesRegex(ft.InputError, "closed mesh"):
            triggers.add_mesh(ft.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
        with self.assertRaises(ft.InputError):
            triggers.body(0)


class Depth(unittest.TestCase):
    def test_two_balls(self):
        world = ft.World()
        one, other = world.add(ball(0.02)), world.add(ball(0.02))
        for body, x in ((one, 0.03), (other, 0.05)):
            world.push(body, 0, place(x))
        deep = world.depth(0, one, other)
        self.assertTrue(deep.is_certified)
        self.assertAlmostEqual(deep.lower, 0.02)
        np.testing.assert_allclose(deep.way_out, [-0.02, 0, 0], atol=1e-9)
        with self.assertRaises(ft.InputError):
            world.depth(0, one, 7)
        by_link = world.depth(0, one, other, link="ball", other_link=0)
        self.assertEqual(by_link.lower, deep.lower)
        with self.assertRaisesRegex(ft.InputError, "link"):
            world.depth(0, one, other, link="hand")
        with self.assertRaisesRegex(ft.InputError, "other_link: expected None"):
            world.depth(0, one, other_link=0)


if __name__ == "__main__":
    unittest.main()

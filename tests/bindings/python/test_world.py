"""The moving world: who meets whom and when, and the same answers as in C, bit for bit."""

import subprocess
import sys
import threading
import unittest

import numpy as np

import foretouch
from foretouch import InputError, PairRules, Verdict, World
from solid_in_c import LIBRARY
from support import IDENTITY, SOURCE, arm, bent, example, turn, wall
from world_in_c import WorldInC


def ball(radius=0.1):
    return foretouch.Avatar.from_arrays(["ball"], [-1], [[0, 0, 0]], None,
                                        [[((0, 0, 0), (0, 0, 0), radius)]])


def at(x, y=0.0, z=0.0):
    return IDENTITY, (x, y, z)


def door():
    """A panel of 0.9 by 2 m, in the frame of its hinge, of two objects."""
    return foretouch.Scene.from_arrays(
        [[0, 0, 0], [0.9, 0, 0], [0.9, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]], [0, 1],
        ["lower", "upper"])


class Answers(unittest.TestCase):
    def test_say_which_two_meet_when_and_where(self):
        world = World()
        thrown, panel = world.add(ball()), world.add(door())
        self.assertEqual((thrown, panel, world.num_bodies), (0, 1, 2))
        for us, z in [(0, 1.1), (1_000_000, -0.9)]:
            world.push(thrown, us, at(0.6, 0.5, z))
            world.push(panel, us, at(0))
        answer = world.contacts(0, 1_000_000)
        [contact] = answer.contacts
        self.assertEqual(contact.verdict, Verdict.CONTACT)
        self.assertEqual((contact.reason, contact.is_assumed), (None, False))
        self.assertTrue(499_000 < contact.time_us + contact.fraction < 500_000)
        self.assertTrue(0 < contact.separation <= world.tolerance)
        self.assertEqual((contact.a.body, contact.a.link, contact.a.link_id, contact.a.lss),
                         (thrown, "ball", 0, 0))
        self.assertEqual((contact.a.triangle, contact.a.object), (None, None))
        self.assertEqual((contact.b.body, contact.b.link, contact.b.link_id, contact.b.lss),
                         (panel, None, 0, None))
        self.assertEqual((contact.b.triangle, contact.b.object), (0, "lower"))
        np.testing.assert_allclose(contact.normal, [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(contact.b.point, [0.6, 0.5, 0], atol=1e-6)
        self.assertEqual((answer.silent, answer.counters["pairs"]), ([], 1))

    def test_go_by_triangles_where_a_surface_says_so(self):
        hull = ball(0.5)
        plate = foretouch.Surface.from_triangles(
            hull, [[[[-0.1, 0, -0.1], [0.1, 0, -0.1], [0, 0, 0.1]]]])
        met = []
        for surface in (None, plate):
            world = World()
            for body, x in ((world.add(hull, surface=surface), 0), (world.add(door()), -0.4)):
                for us, y in ((0, 2.5), (1_000_000, -0.5)):
                    world.push(body, us, at(x, y if body == 0 else -2.0))
            met.append(world.contacts(0, 1_000_000).contacts)
        [[by_lss], [exactly]] = met
        self.assertEqual((by_lss.a.triangle, exactly.a.triangle, exactly.a.lss), (None, 0, 0))
        self.assertEqual((by_lss.a.object, exactly.a.object), (None, None))
        # The ball of 50 cm, and the plate in its middle, come down upon the door's upper edge.
        self.assertTrue(660_000 < by_lss.time_us < 667_000)
        self.assertTrue(830_000 < exactly.time_us < 834_000)

    def test_ask_two_meshes_where_they_are_told_to(self):
        for ask_meshes in (False, True):
            world = World(door(), ask_meshes=ask_meshes)
            panel = world.add(door())
            for us, z in ((0, 1), (1_000_000, -1)):
                world.push(panel, us, at(0, 0, z))
            self.assertEqual(len(world.contacts(0, 1_000_000).contacts), int(ask_meshes))

    def test_know_what_stands_still(self):
        world = World(wall(z=0.0), tolerance=1e-4)
        thrown = world.add(ball())
        world.push(thrown, 0, at(0, 0, 1))
        world.push(thrown, 10, at(0, 0, -1))
        [contact] = world.contacts(0, 10).contacts
        self.assertEqual((contact.b.body, contact.b.link, contact.b.object), (None, None, "wall"))
        self.assertLessEqual(contact.separation, 1e-4)
        world.ask_still(0, False)
        self.assertEqual(world.contacts(0, 10).contacts, [])

    def test_follow_carriers(self):
        world = World()
        dancer, cup, panel = world.add(arm()), world.add(ball(0.03)), world.add(door())
        for us, angle in [(0, 0.0), (100, 1.5)]:
            world.push(dancer, us, bent(arm(), 0, angle))
            world.push(panel, us, (turn([0, 1, 0], 0.3), (0, 0, -0.4)))
        world.attach(cup, dancer, 0, at(0.35), link="fore")
        met = {(c.a.body, c.b.body) for c in world.contacts(0, 100).contacts}
        self.assertIn((cup, panel), met)
        self.assertNotIn((dancer, cup), met)
        world.detach(cup, 50, at(5))
        with self.assertRaisesRegex(InputError, "link: 'fort' is no link.*'fore'"):
            world.attach(cup, dancer, 60, at(0), link="fort")

    def test_ask_own_links_and_groups_as_told(self):
        avatar = foretouch.Avatar.from_arrays(
            ["trunk", "left", "right"], [-1, 0, 0], [[0, 2, 0], [0.5, -1, 0], [-0.2, -1, 0]], None,
            [[((0, 0, 0), (0, 0, 0), r)] for r in [0.1, 0.05, 0.05]])
        world = World()
        own = world.add(avatar, self_pairs=PairRules.derive(avatar), group=3)
        near = world.add(ball(3.0), group=4, when_silent="hold-still")
        pose = avatar.rest_pose()
        world.push(own, 0, pose)
        pose.translations[1, 0] = -0.7
        world.push(own, 100, pose)
        world.push(near, 0, at(0))
        answer = world.contacts(0, 100)
        self.assertEqual(sum(c.b.body == near for c in answer.contacts), 3)
        self.assertTrue(all(c.is_assumed == (c.b.body == near) for c in answer.contacts))
        self.assertEqual([(s.body, s.since_us, s.taken_to) for s in answer.silent],
                         [(near, 0, "hold-still")])
        world.ask(3, 4, False)
        [contact] = world.contacts(0, 100).contacts
        self.assertEqual((contact.a.link, contact.b.link), ("left", "right"))

    def test_are_refused_beyond_what_is_known_and_forgotten(self):
        world = World()
        self.assertEqual((world.known_until, world.waits_for), (None, None))
        quick, slow = world.add(ball()), world.add(ball())
        for us in [100, 300]:
            world.push(quick, us, at(0))
        world.push(slow, 200, at(1))
        self.assertEqual((world.known_until, world.waits_for), (200, slow))
        with self.assertRaisesRegex(InputError, "ends after what is known.*body 1"):
            world.contacts(100, 201)
        world.forget_before(150)
        with self.assertRaisesRegex(InputError, "forgotten"):
            world.contacts(140, 200)
        with self.assertRaisesRegex(InputError, "utime_us: .*in the past"):
            World.push(world, slow, 150, at(1))

    def test_forget_and_thin_what_they_keep(self):
        world = World()
        body = world.add(ball())
        for k in range(100):
            world.push(body, 1000 * k, at(1e-5 * k * k))
        every = world.pose_bytes
        self.assertEqual(every, 100 * (56 + 256))
        world.thin_before(90_000, 1e-3)
        self.assertLess(world.pose_bytes, every / 2)
        hit = world.probe(45_500, (5, 0, 0), direction=(-1, 0, 0)).hits[0]
        alone = World()
        alone.add(ball())
        for k in range(100):
            alone.push(body, 1000 * k, at(1e-5 * k * k))
        self.assertAlmostEqual(
            hit.distance, alone.probe(45_500, (5, 0, 0), direction=(-1, 0, 0)).hits[0].distance,
            delta=1e-3)
        until = world.forget_beyond(world.pose_bytes // 2)
        self.assertGreater(until, 0)
        with self.assertRaisesRegex(InputError, "forgotten"):
            world.probe(until - 1, (5, 0, 0), direction=(-1, 0, 0))
        for metres in [-1.0, float("nan"), float("inf")]:
            with self.assertRaisesRegex(InputError, "metres"):
                world.thin_before(95_000, metres)
        with self.assertRaisesRegex(InputError, "metres: expected a number"):
            world.thin_before(95_000, "much")
        with self.assertRaises(TypeError):
            world.forget_beyond(-1)

    def test_show_themselves(self):
        world = World()
        world.add(ball())
        self.assertEqual(repr(world), "<foretouch.World of 1 bodies>")


class Refusals(unittest.TestCase):
    def refused(self, text, call, *arguments, **keywords):
        with self.assertRaisesRegex(InputError, text):
            call(*arguments, **keywords)

    def test_name_the_argument(self):
        nan = float("nan")
        for tolerance in [0, -1, nan, 1e-9]:
            self.refused("tolerance", World, tolerance=tolerance)
        world = World()
        self.refused("shape: expected a foretouch.Avatar or a foretouch.Scene", world.add, 3)
        self.refused("group", world.add, ball(), group=32)
        self.refused("when_silent.*hold-still", world.add, ball(), when_silent="hold still")
        self.refused("self_pairs", world.add, door(), self_pairs=PairRules)
        body = world.add(ball())
        for bad in [-1, 1, 2**31 - 1]:
            self.refused("body: expected one of the 1 that were added", world.push, bad, 0, at(0))
        self.refused("body", world.push, True, 0, at(0))
        for us in [0.5, 2**60, None, "1"]:
            self.refused("utime_us", world.push, body, us, at(0))
        for pose in [at(nan), (IDENTITY, (1, 2)), ((0, 0, 0, 0), (0, 0, 0)), 4, "ab", (1, 2, 3)]:
            with self.subTest(pose=pose):
                self.refused("pose", world.push, body, 0, pose)
        world.push(body, 0, at(0))
        world.push(body, 9, at(0))
        self.refused("carries body 0", world.attach, body, body, 1, at(0))
        self.refused("body 0 is not carried", world.detach, body, 1, at(0))
        self.refused("moves_in_frame", world.attach, body, body, 1, at(0), moves_in_frame=1)
        self.refused("is_asked", world.ask, 0, 0, 1)
        self.refused("group", world.ask, 0, -1, True)
        self.refused("group", world.ask_still, 99, True)
        self.refused("window", world.contacts, 5, 5)
        self.refused("from_us", world.contacts, 0.0, 5)


class SameAsInC(unittest.TestCase):
    def setUp(self):
        if not LIBRARY.exists():
            self.skipTest("the C library is not built")

    def values(self, contact):
        def none_is(value, instead=-1):
            return instead if value is None else value
        sides = [(none_is(s.body), none_is(s.link_id), none_is(s.lss), none_is(s.triangle),
                  *s.point) for s in [contact.a, contact.b]]
        return (contact.verdict, contact.is_assumed, contact.time_us, contact.fraction,
                contact.separation, contact.penetration, *contact.normal, *sides)

    def values_in_c(self, contact):
        sides = [(s.body, s.link, s.lss, s.triangle, *s.point) for s in [contact.a, contact.b]]
        return (contact.verdict, contact.is_assumed, contact.time_us, contact.time_fraction,
                contact.separation, contact.penetration, *contact.normal, *sides)

    def test_over_the_bundled_clip(self):
        avatar, scene, clip = example()
        here, there = World(scene), WorldInC(avatar, scene)
        self.addCleanup(there.close)
        poses = clip.poses(avatar)[::6]
        bodies = [here.add(avatar), here.add(avatar), here.add(scene)]
        self.assertEqual(bodies, [there.add(False), there.add(False), there.add(True)])
        seen = 0
        for i, pose in enumerate(poses[:40]):
            us = 100_000 * i
            other = poses[len(poses) - 1 - i]
            for body, when, given in [(0, us, pose), (1, us + 777, other),
                                      (2, us, ([turn([0, 1, 0], 0.1 * i)], [[0.0, -0.2, 0.0]]))]:
                here.push(body, when, given)
                there.push(body, when, given)
            if i == 0:
                continue
            window = (us - 100_000 + 777, us)
            answer = here.contacts(*window)
            self.assertEqual([self.values(c) for c in answer.contacts],
                             [self.values_in_c(c) for c in there.contacts_in(*window)])
            seen += len(answer.contacts)
            here.forget_before(us)
        self.assertGreater(seen, 20)

    def test_with_a_tool_that_is_taken_and_let_go(self):
        avatar, scene = arm(), door()
        here, there = World(scene), WorldInC(avatar, scene)
        self.addCleanup(there.close)
        for is_mesh in [False, True]:
            here.add(scene if is_mesh else avatar)
            there.add(is_mesh)
        place = ([turn([0, 0, 1], 0.7)], [[0.2, 0.0, 0.1]])
        for world in [here, there]:
            for us, angle in [(0, 0.0), (100, 1.0), (200, -1.0)]:
                world.push(0, us, bent(avatar, 0, angle))
            world.push(1, 0, place)
            world.push(1, 30, place)
        here.attach(1, 0, 20, place, link="fore", moves_in_frame=False)
        there.attach(1, 0, 20, place, link=1, moves_in_frame=False)
        here.detach(1, 90, place)
        there.detach(1, 90, place)
        for world in [here, there]:
            world.push(1, 200, place)
        for window in [(0, 200), (10, 80), (85, 199)]:
            answer = here.contacts(*window).contacts
            self.assertEqual([self.values(c) for c in answer],
                             [self.values_in_c(c) for c in there.contacts_in(*window)])
            self.assertGreater(len(answer), 0)


class Threads(unittest.TestCase):
    def test_that_share_a_world_wait_for_one_another(self):
        world = World()
        bodies = [world.add(ball()) for _ in range(4)]
        failures = []

        def tell(body):
            try:
                for k in range(200):
                    world.push(body, 1000 * k, at(0.15 * body, 0.01 * (k % 3)))
                    if k > 0 and world.known_until is not None:
                        world.forget_before(-1)
            except Exception as error:  # told below
                failures.append(error)
        threads = [threading.Thread(target=tell, args=(body,)) for body in bodies]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        self.assertEqual(world.known_until, 199_000)
        self.assertEqual(len(world.contacts(0, 199_000).contacts), 3)


class Example(unittest.TestCase):
    def test_prints_when_the_door_is_met(self):
        program = SOURCE / "bindings" / "python" / "example" / "swinging_door.py"
        done = subprocess.run([sys.executable, "-W", "error", program], check=True,
                              capture_output=True, text=True)
        lines = done.stdout.splitlines()
        self.assertGreater(len(lines), 2)
        for line in lines[:-1]:
            self.assertRegex(line, r"^\d\.\d{4} s: (arm|trunk) meets the door at \(.*\)$")
        self.assertRegex(lines[-1], f"^{len(lines) - 1} contacts in 119 windows$")


if __name__ == "__main__":
    unittest.main()

"""Robots by joint coordinates, and edges of a planner. Expected values are closed forms."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from support import arm, wall

URDF = """<robot name="r"><link name="base"><collision><geometry><sphere radius="0.1"/></geometry>
</collision></link><link name="arm"><collision><origin xyz="0.2 0 0"/><geometry>
<sphere radius="0.05"/></geometry></collision></link><joint name="turn" type="revolute">
<parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="{lower}" upper="3" effort="1" velocity="1"/></joint></robot>"""

TURN = {"kind": "continuous", "axis": (0, 1, 0)}


def swinging():
    """Of support.arm(): the upper arm turns about +Y, the forearm slides out along +X."""
    slide = {"kind": "prismatic", "name": "out", "axis": (1, 0, 0), "lower": 0.0, "upper": 0.5}
    return foretouch.Robot.from_joints(arm(), [TURN, slide])


class Robots(unittest.TestCase):
    def test_coordinates_and_poses(self):
        robot = swinging()
        self.assertEqual(robot.names, ["upper", "out"])
        np.testing.assert_array_equal(robot.lower, [-np.inf, 0.0])
        np.testing.assert_array_equal(robot.is_periodic, [True, False])
        pose = robot.pose([np.pi / 2, 0.25])
        half = np.sqrt(0.5)
        np.testing.assert_allclose(pose.rotations[0], [half, 0, half, 0], atol=1e-15)
        np.testing.assert_allclose(pose.translations[1], [0.55, 0, 0], atol=1e-15)

    def test_edges_meet_a_wall_where_sines_say(self):
        robot = swinging()
        edges = foretouch.EdgeQuery(robot, wall(-0.3))
        # About +Y, +X turns to -Z: the tip at 0.6 m, 4 cm thick, meets z = -0.3.
        answer = edges.answer([[0, 0], [0, 0], [0, 0.5]], [[1, 0], [-1, 0], [0, 0.6]])
        self.assertEqual(list(answer.verdicts), [1, 0, 0])
        touch = np.arcsin(0.26 / 0.6)
        self.assertLessEqual(answer.free_until[0], touch)
        self.assertGreater(answer.free_until[0], touch - 0.004)
        self.assertEqual(list(answer.usable), [False, True, False])  # the last is out of limits
        self.assertEqual(list(answer.links), [1, -1, -1])
        self.assertEqual(answer.points.shape, (3, 3))
        np.testing.assert_allclose(answer.points[0, 2], -0.3, atol=1e-12)

    def test_paths_and_threads_answer_alike(self):
        robot = swinging()
        random = np.random.default_rng(1)
        q = random.uniform([-1, 0], [1, 0.5], (200, 2))
        one, two = (foretouch.EdgeQuery(robot, wall(), threads=n) for n in (1, 2))
        first, second = one.answer(q[:-1], q[1:]), two.answer(q[:-1], q[1:])
        for name in ("verdicts", "free_until", "usable", "links", "others", "triangles", "points"):
            np.testing.assert_array_equal(getattr(first, name), getattr(second, name), name)
        clear = first.verdicts == foretouch.Verdict.CLEAR
        self.assertTrue(20 < clear.sum() < 180)
        expected = int(np.argmin(clear))
        free_until, met = two.answer_path(q)
        self.assertTrue(expected <= free_until <= expected + first.free_until[expected])
        self.assertEqual(met.verdicts[0], first.verdicts[expected])

    def test_clearances_are_where_sines_say(self):
        edges = foretouch.EdgeQuery(swinging(), wall(-0.5), clearance_tolerance=1e-5, threads=2)
        q = np.array([[0.0, 0.0], [0.3, 0.0], [0.6, 0.0], [0.2, 0.0]])
        near = edges.clearance(q, slopes=True)  # a path of three edges
        self.assertEqual(len(near), 3)
        # The tip at 0.6 m, 4 cm thick; it is lowest at the larger angle of each edge.
        truth = 0.5 - 0.04 - 0.6 * np.sin([0.3, 0.6, 0.6])
        np.testing.assert_array_less(near.lower, truth + 1e-12)
        np.testing.assert_array_less(truth - 1e-12, near.upper)
        np.testing.assert_allclose(near.upper, near.lower, atol=1.1e-5)
        np.testing.assert_allclose(near.t, [1, 1, 0], atol=1e-4)
        np.testing.assert_allclose(near.slopes1[:, 0], -0.6 * np.cos([0.3, 0.6, 0.6]) * [1, 1, 0],
                                   atol=1e-3)
        np.testing.assert_allclose(near.slopes0[2, 0], -0.6 * np.cos(0.6), atol=1e-3)
        again = edges.clearance(q[:-1], q[1:])
        np.testing.assert_array_equal(again.upper, near.upper)
        self.assertIsNone(again.slopes0)
        with self.assertRaisesRegex(foretouch.InputError, "at least two"):
            edges.clearance(q[:1])

    def test_clearance_tools_and_own_links(self):
        robot = swinging()
        near = [[np.arcsin(0.255 / 0.6), 0.0]]  # 5 mm from the wall
        for clearance, verdict in ((0.0, 0), (0.003, 0), (0.007, 2)):
            edges = foretouch.EdgeQuery(robot, wall(), clearance=clearance, tolerance=1e-4)
            self.assertEqual(edges.answer(near, near).verdicts[0], verdict)
        tooled = robot.with_tool("fore", "rod", [((0.3, 0, 0), (0.6, 0, 0), 0.01)])
        self.assertEqual(tooled.avatar.names[-1], "rod")
        rules = foretouch.PairRules.derive(tooled.avatar)
        edges = foretouch.EdgeQuery(tooled, wall(), self_pairs=rules, ignore=["upper"])
        self.assertEqual(edges.answer(near, near).links[0], 2)

    def test_edges_are_a_sequence_that_says_what_is_met(self):
        edges = foretouch.EdgeQuery(swinging(), wall(-0.3))
        answer = edges.answer([[0, 0], [0, 0], [0, 0.5]], [[1, 0], [-1, 0], [0, 0.6]])
        self.assertEqual(len(answer), 3)
        self.assertEqual([str(edge.verdict) for edge in answer], ["CONTACT", "CLEAR", "CLEAR"])
        first, last = answer[0], answer[-1]
        self.assertEqual((first.link, first.object, first.other, first.prop),
                         ("fore", "wall", None, None))
        self.assertEqual(first.free_until, answer.free_until[0])
        self.assertEqual((last.link, last.object, last.usable), (None, None, False))
        self.assertEqual([edge.usable for edge in answer[1:]], [True, False])
        self.assertIn("2 CLEAR, 1 CONTACT", repr(answer))
        with self.assertRaises(IndexError):
            answer[3]
        self.assertEqual(answer.describe().splitlines(),
                         ["3 edges: 2 CLEAR, 1 CONTACT", "1 CONTACT: link 'fore' and 'wall'"])
        self.assertEqual(answer[1:].describe(), "2 edges: 2 CLEAR")

    def test_edges_that_all_start_in_contact_say_what_to_ignore(self):
        robot, scene = swinging(), wall(0.02, "table")  # through the upper arm
        q = np.zeros((5, 2))
        told = foretouch.EdgeQuery(robot, scene).answer(q, q).describe()
        self.assertIn("5 STARTS_IN_CONTACT: link 'upper' and 'table'", told)
        self.assertIn("ignore=[('upper', 'table')]", told)
        ignored = foretouch.EdgeQuery(robot, scene, ignore=[("upper", "table"), ("fore", "table")])
        self.assertEqual(ignored.answer(q, q).describe(), "5 edges: 5 CLEAR")

    def test_a_path_turns_the_way_that_q_says(self):
        robot = swinging()
        poses, at = robot.path([[-2, 0], [2, 0.5]])
        np.testing.assert_array_equal(at, [0, 0.5, 1])
        np.testing.assert_allclose(poses[1].rotations[0], [1, 0, 0, 0], atol=1e-15)
        np.testing.assert_allclose(poses[1].translations[1], [0.55, 0, 0], atol=1e-15)
        with self.assertRaises(foretouch.InputError):
            robot.path([[0, np.nan]])

    def test_pair_rules_ask_or_leave_out_and_are_drawn_within_limits(self):
        robot = swinging().with_tool("fore", "rod", [((0.3, 0, 0), (0.6, 0, 0), 0.01)])
        rules = foretouch.PairRules.asking(robot.avatar, [("rod", "upper")])
        self.assertEqual(rules.num_asked, 1)
        self.assertEqual(rules.reason_of("upper", "fore"), "user")
        rules = foretouch.PairRules.leaving_out(robot.avatar, [("rod", "upper")])
        self.assertEqual((rules.num_asked, rules.reason_of("upper", "rod")), (2, "user"))
        with self.assertRaisesRegex(foretouch.InputError, r"asking\(.*leaving_out\("):
            foretouch.PairRules.exactly(robot.avatar, [])
        with self.assertRaisesRegex(foretouch.InputError, "at least one pair"):
            foretouch.PairRules.asking(robot.avatar, [])
        drawn = foretouch.PairRules.of_robot(robot, samples=200, seed=3)
        self.assertEqual(drawn.num_usual_poses, 200)
        touches = {(pair.a, pair.b): pair.touches for pair in drawn.touches}
        self.assertEqual(len(touches), 3)
        self.assertEqual((touches["upper", "rod"], touches["fore", "rod"]), (0, 200))
        self.assertTrue(15 < touches["upper", "fore"] < 52)  # out by 8 of 50 cm: 32, five sigmas
        self.assertEqual(drawn.reason_of("upper", "rod"), "asked")
        foretouch.EdgeQuery(robot, wall(), self_pairs=drawn)

    def test_props_are_placed_anew(self):
        robot = swinging()
        far = foretouch.Scene.from_arrays(
            [[90, 90, 90], [91, 90, 90], [90, 91, 90]], [[0, 1, 2]])
        still = foretouch.EdgeQuery(robot, wall())
        moved = foretouch.EdgeQuery(robot, far, props=[wall()])
        q0, q1 = [[-1.0, 0.0]], [[1.0, 0.0]]
        expected, met = still.answer(q0, q1), moved.answer(q0, q1)
        self.assertEqual(expected.verdicts[0], foretouch.Verdict.CONTACT)
        self.assertEqual(met.verdicts[0], foretouch.Verdict.CONTACT)
        self.assertAlmostEqual(met.free_until[0], expected.free_until[0], places=7)
        self.assertEqual((expected.props[0], met.props[0]), (-1, 0))
        moved.place(0, ([1, 0, 0, 0], [0, 0, 50]))
        self.assertEqual(moved.answer(q0, q1).verdicts[0], foretouch.Verdict.CLEAR)
        self.assertEqual(moved.answer(q0, q1).props[0], -1)
        moved.place(0, ([1, 0, 0, 0], [0, 0, 0]))
        self.assertEqual(moved.answer(q0, q1).verdicts[0], foretouch.Verdict.CONTACT)
        moved.place(0, None)
        self.assertEqual(moved.answer(q0, q1).verdicts[0], foretouch.Verdict.CLEAR)
        for prop, pose in ((1, None), (-1, None), (0, ([2, 0, 0, 0], [0, 0, 0])),
                           (0, ([1, 0, 0, 0], [0, 0, np.inf])), (0, ([1, 0, 0, 0], [0, 2e4, 0])),
                           (0, "here")):
            with self.assertRaises(foretouch.InputError):
                moved.place(prop, pose)

    def test_bad_input(self):
        robot = swinging()
        edges = foretouch.EdgeQuery(robot, wall())
        for q0, q1 in (([[0]], [[0]]), ([[0, 0]], [[0, np.nan]]), ([[0, 0]], [[0, 0], [1, 0]]),
                       ([[0, 2000]], [[0, 0]]), ("no", "numbers")):
            with self.assertRaises(foretouch.InputError):
                edges.answer(q0, q1)
        with self.assertRaises(foretouch.InputError):
            edges.answer_path([[0, 0]])
        for joints in ([TURN], [TURN, {"kind": "round"}], [TURN, {"kind": "fixed", "axes": 1}],
                       [TURN, {"kind": "revolute", "lower": 1, "upper": -1}],
                       [TURN, {"kind": "revolute", "mimic_of": "hand"}]):
            with self.assertRaises(foretouch.InputError):
                foretouch.Robot.from_joints(arm(), joints)
        for options in ({"clearance": -1}, {"threads": 0}, {"self_pairs": 3}):
            with self.assertRaises(foretouch.InputError):
                foretouch.EdgeQuery(robot, wall(), **options)

    def test_urdf(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "arm.urdf"
            path.write_text(URDF.format(lower=-3))
            robot = foretouch.Robot.load_urdf(path)
            self.assertEqual((robot.names, list(robot.lower)), (["turn"], [-3.0]))
            path.write_text(URDF.format(lower=4))
            with self.assertRaisesRegex(foretouch.InputError, "'turn' has its lower limit"):
                foretouch.Robot.load_urdf(path)


if __name__ == "__main__":
    unittest.main()

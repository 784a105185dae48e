"""What a person surely touched and may have touched. Expected values are closed forms."""

import os
import re
import tempfile
import unittest

import numpy as np

import foretouch
from support import SOURCE, arm, wall
from test_self import hands, moved

RADIUS, WALL = 0.04, -0.3
SECONDS = 0.1


def towards_the_wall(avatar, heights):
    """Poses of the whole arm at these heights above the wall's side."""
    rest = avatar.rest_pose()
    poses = []
    for height in heights:
        places = rest.translations.copy()
        places[0, 2] += height
        poses.append(foretouch.Pose(rest.rotations, places))
    return foretouch.Poses.stack(poses)


def first_below(function):
    """The least t in [0, 1] of a function that falls below 0."""
    instants = np.linspace(0, 1, 200001)
    below = np.nonzero([function(t) <= 0 for t in instants])[0]
    return instants[below[0]] if len(below) else None


class BracketQuery(unittest.TestCase):
    """An arm along +X that comes from 10 cm above a wall to 5 cm below its side, in a line."""

    def setUp(self):
        self.avatar = arm()
        self.query = foretouch.BracketQuery(self.avatar, wall(WALL))

    @staticmethod
    def gap(t):
        return (0.1 - 0.15 * t) - RADIUS

    def lowered(self):
        return towards_the_wall(self.avatar, [WALL + 0.1, WALL - 0.05])

    def test_a_touch_begins_between_the_grown_and_the_shrunk_body(self):
        most = 0.01
        bound = foretouch.LinkBound(acceleration=8 * most / SECONDS**2)
        told = self.query.answer(self.lowered(), bound, seconds=SECONDS)
        self.assertEqual(told.verdicts.shape, (1, 2))
        self.assertTrue((told.verdicts == foretouch.BracketVerdict.CERTAIN).all())
        growth = lambda t: 4 * most * t * (1 - t)
        np.testing.assert_allclose(told.growths, most, rtol=1e-9)
        possible = first_below(lambda t: self.gap(t) - growth(t))
        certain = first_below(lambda t: self.gap(t) + growth(t))
        self.assertLess(possible, certain)
        np.testing.assert_allclose(told.possible[0, :, 0], possible, atol=3e-4)
        np.testing.assert_allclose(told.certain[0, :, 0], certain, atol=3e-4)

    def test_without_work_nothing_is_certain(self):
        idle = foretouch.BracketQuery(self.avatar, wall(WALL), work_budget=0)
        bound = foretouch.LinkBound(acceleration=0.1)
        told = idle.answer(self.lowered(), bound, seconds=SECONDS)
        self.assertTrue((told.verdicts == foretouch.BracketVerdict.POSSIBLE).all())
        told = self.query.answer(self.lowered(), bound, seconds=SECONDS)
        self.assertTrue((told.verdicts == foretouch.BracketVerdict.CERTAIN).all())

    def test_without_a_bound_nothing_is_claimed(self):
        told = self.query.answer(self.lowered(), foretouch.LinkBound(), seconds=SECONDS)
        self.assertTrue((told.verdicts == foretouch.BracketVerdict.UNCLAIMED).all())
        self.assertTrue(np.isnan(told.possible).all() and np.isnan(told.certain).all())

    def test_bounds_are_per_link(self):
        sure, unknown = foretouch.LinkBound(acceleration=0.0), foretouch.LinkBound()
        told = self.query.answer(self.lowered(), [sure, unknown], seconds=SECONDS)
        self.assertEqual(told.verdicts.tolist(), [[3, 0]])
        with self.assertRaisesRegex(foretouch.InputError, "one per link: 2"):
            self.query.answer(self.lowered(), [sure], seconds=SECONDS)

    def test_a_lost_second_excludes_what_nobody_could_have_reached(self):
        far = towards_the_wall(self.avatar, [WALL + 1.0, WALL + 1.0])
        for speed, verdict in ((1.0, "EXCLUDED"), (2.5, "POSSIBLE")):
            told = self.query.answer_gap(far[0], far[1], foretouch.LinkBound(speed=speed), seconds=1.0)
            self.assertEqual(foretouch.BracketVerdict(told.verdicts[0, 0]).name, verdict)

    def test_nothing_is_touched_before(self):
        """At 1 m/s, from 46 cm beside the wall: no touch for 0.36 s by error 0.1 m."""
        two = towards_the_wall(self.avatar, [WALL + 0.6, WALL + 0.5])
        bound = foretouch.LinkBound(error=0.1, ahead_acceleration=0.0)
        told = self.query.look_ahead(two[0], two[1], bound, seconds=SECONDS, horizon=1.0)
        np.testing.assert_allclose(told.possible[0, :, 0], 0.5 - RADIUS - 0.1, atol=1e-3)

    def test_of_own_links_both_grow(self):
        """The left hand goes through the right one, 1.2 m in a step."""
        avatar, most = hands(), 0.01
        query = foretouch.BracketQuery(avatar, wall(), self_pairs=foretouch.PairRules.derive(avatar))
        bound = foretouch.LinkBound(acceleration=8 * most / SECONDS**2)
        poses = foretouch.Poses.stack([moved(avatar, 0.5), moved(avatar, -0.7)])
        (pair,) = query.answer(poses, bound, seconds=SECONDS).pairs
        self.assertEqual((pair.step, pair.link, pair.other), (0, "left", "right"))
        self.assertEqual(pair.verdict, foretouch.BracketVerdict.CERTAIN)
        gap, growth = (lambda t: 0.6 - 1.2 * t), (lambda t: 8 * most * t * (1 - t))
        expected = [first_below(lambda t: gap(t) - growth(t)), first_below(lambda t: gap(t) + growth(t))]
        np.testing.assert_allclose([pair.possible[0], pair.certain[0]], expected, atol=3e-4)

    def test_refuses_by_name(self):
        poses, bound = self.lowered(), foretouch.LinkBound(acceleration=1.0)
        for argument, arguments in (
            ("seconds", {"seconds": 0.0}),
            ("between", {"seconds": 1.0, "between": "linear"}),
        ):
            with self.assertRaisesRegex(foretouch.InputError, argument):
                self.query.answer(poses, bound, **arguments)
        for bad in (3.0, None, ["a"], foretouch.LinkBound(acceleration=-1.0)):
            with self.assertRaisesRegex(foretouch.InputError, "bounds"):
                self.query.answer(poses, bad, seconds=1.0)
        with self.assertRaisesRegex(foretouch.InputError, "poses"):
            self.query.answer(poses[:1], bound, seconds=1.0)
        with self.assertRaisesRegex(foretouch.InputError, "horizon"):
            self.query.look_ahead(poses[0], poses[1], bound, seconds=1.0, horizon=-1.0)
        with self.assertRaisesRegex(foretouch.InputError, "surface"):
            foretouch.BracketQuery(self.avatar, wall(WALL), fidelity="exact")


class ReadBounds(unittest.TestCase):
    def test_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "anna.bounds.json")
            with open(path, "w", encoding="utf-8") as out:
                out.write(
                    '{"format": "foretouch-bounds", "version": 1, "bounds": [{"part": "all",'
                    ' "model": "cubic", "rate_hz": 30, "acceleration_m_s2": 12.5}]}'
                )
            avatar = arm()
            bounds = foretouch.read_bounds(path, avatar, between="cubic", rate_hz=30)
            self.assertEqual(bounds, [foretouch.LinkBound(acceleration=12.5)] * 2)
            with self.assertRaisesRegex(foretouch.InputError, "anna.bounds.json.*30"):
                foretouch.read_bounds(path, avatar, between="cubic", rate_hz=90)

    def test_the_page_s_example_runs(self):
        guide = (SOURCE / "docs" / "person.md").read_text(encoding="utf-8")
        code = re.search(r"```python\n(.*?)```", guide, re.DOTALL)[1]
        avatar = arm()
        known = {"foretouch": foretouch, "avatar": avatar, "scene": wall(WALL),
                 "poses": towards_the_wall(avatar, [WALL + h for h in (0.2, 0.1, 0.0, -0.1)])}
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                with open("anna.bounds.json", "w", encoding="utf-8") as out:
                    out.write(
                        '{"format": "foretouch-bounds", "version": 1, "bounds": [{"part": "all",'
                        ' "model": "cubic-late", "acceleration_m_s2": 0.1,'
                        ' "ahead_acceleration_m_s2": 1}]}'
                    )
                exec(code, known)
            finally:
                os.chdir(here)
        self.assertTrue(known["surely"].any())
        began = known["began"]
        self.assertTrue((began[0][known["surely"]] <= began[1][known["surely"]]).all())


if __name__ == "__main__":
    unittest.main()

"""Random arguments from a fixed seed, sensible and senseless: an answer or a foretouch.Error (or
Python's own TypeError), never anything else. The seed of a case is its number."""

import unittest
import warnings

import numpy as np

import foretouch
from support import arm, swing, wall

CASES = 4000


class Nothing:
    """An object that answers badly to every protocol."""

    rotations = property(lambda self: 1 / 0)

    def __len__(self):
        return -1

    def __float__(self):
        return "no"

    def __index__(self):
        return 1.5

    def __iter__(self):
        return 5


def random_value(random, depth=0):
    choice = int(random.integers(0, 22 if depth < 3 else 16))
    size = int(random.integers(0, 5))
    simple = [
        lambda: None, lambda: True, lambda: int(random.integers(-5, 6)), lambda: 2**70,
        lambda: float(random.normal()), lambda: float("nan"), lambda: float("inf"),
        lambda: "fore", lambda: "link", lambda: "", lambda: "\ud800\0", lambda: b"\xff",
        lambda: 1 + 2j, lambda: Nothing(), lambda: object, lambda: np.float32(random.normal()),
        lambda: random.normal(size=tuple(random.integers(0, 5, size=int(random.integers(0, 4))))),
        lambda: random.integers(-3, 9, size=(size, 3)).astype(
            random.choice([np.int8, np.uint8, np.int64, np.uint64])),
        lambda: np.array([None, "a"], dtype=object),
        lambda: [random_value(random, depth + 1) for _ in range(size)],
        lambda: tuple(random_value(random, depth + 1) for _ in range(size)),
        lambda: {str(i): random_value(random, depth + 1) for i in range(size)},
    ]
    return simple[choice]()


def nearly_right(random):
    """Arguments of the right shape, some of whose numbers are not right."""
    n, m = int(random.integers(1, 8)), int(random.integers(1, 8))
    vertices = random.normal(size=(n, 3)) * 10.0 ** random.integers(-300, 9)
    triangles = random.integers(-1 if random.random() < 0.1 else 0, n + (random.random() < 0.1),
                                size=(m, 3))
    if random.random() < 0.1:
        vertices[random.integers(n), 1] = random.choice([np.nan, np.inf, 1e308, 5e-324])
    return vertices, triangles


class RandomArguments(unittest.TestCase):
    ALLOWED = (foretouch.Error, TypeError)

    def attempt(self, seed, function, *arguments, **keywords):
        with self.subTest(seed=seed, function=getattr(function, "__name__", function)):
            try:
                with warnings.catch_warnings():  # a tolerance of metres is legal, and is remarked
                    warnings.simplefilter("ignore", UserWarning)
                    return function(*arguments, **keywords)
            except self.ALLOWED:
                return None
            except ZeroDivisionError:  # Nothing's own
                return None

    def test_senseless_ones_are_refused(self):
        avatar, scene = arm(), wall()
        motion = swing(avatar)
        query = foretouch.Query(avatar, scene)
        step = query.first_contacts(motion)
        rest = avatar.rest_pose()
        robot = foretouch.Robot.from_joints(avatar, [{"kind": "continuous"}, {"kind": "fixed"}])
        edges = foretouch.EdgeQuery(robot, scene)
        functions = [
            lambda v: foretouch.Robot.from_joints(avatar, v()),
            lambda v: foretouch.Robot.from_joints(avatar, [{"kind": "fixed", "axis": v()}, v()]),
            lambda v: robot.with_tool(v(), v(), v()),
            lambda v: robot.pose(v()),
            lambda v: foretouch.EdgeQuery(robot, scene, tolerance=v(), clearance=v(), ignore=v()),
            lambda v: edges.answer(v(), v()),
            lambda v: edges.answer_path(v()),
            lambda v: edges.clearance(v(), v()),
            lambda v: foretouch.Scene.from_arrays(v(), v(), v(), v()),
            lambda v: foretouch.Scene.from_arrays(np.eye(3), v()),
            lambda v: foretouch.Scene.from_arrays(np.eye(3), [[0, 1, 2]], v(), v()),
            lambda v: foretouch.Avatar.from_arrays(v(), v(), v(), v(), v()),
            lambda v: foretouch.Avatar.from_arrays(["a"], [-1], [[0, 0, 0]], v(), v()),
            lambda v: foretouch.Motion(avatar, v(), v()),
            lambda v: foretouch.Motion(avatar, (v(), rest.translations), rest),
            lambda v: foretouch.Motion(v(), rest, rest),
            lambda v: motion.transforms(v()),
            lambda v: motion.pose_at(v()),
            lambda v: foretouch.Query(avatar, scene, pass_separating=v(), scope=v()),
            lambda v: query.first_contacts(v()),
            lambda v: query.first_contacts_many(v(), ends=v(), threads=1),
            lambda v: query.touches_at(motion, v()),
            lambda v: foretouch.Query(avatar, scene, tolerance=v()),
            lambda v: foretouch.Query(avatar, scene, fidelity=v(), surface=v()),
            lambda v: foretouch.Query(avatar, scene, policies={"fore": v()}, ignore=v()),
            lambda v: foretouch.Query(avatar, scene, work_budget=v(), deadline_us=v(), scope=v()),
            lambda v: foretouch.Surface.from_triangles(avatar, v()),
            lambda v: foretouch.Surface.from_triangles(avatar, [v(), v()]),
            lambda v: foretouch.swept_surface(motion, v(), error=v()),
            lambda v: foretouch.swept_surface(v(), "fore", error=0.1),
            lambda v: step[v()],
            lambda v: avatar.link(v()),
            lambda v: foretouch.Clip.load(v(), v()),
            lambda v: foretouch.Avatar.load(v()),
            lambda v: foretouch.Scene.load("x.obj", v(), v(), importer=v()),
        ]
        answered = 0
        for seed in range(CASES):
            random = np.random.default_rng(seed)
            function = functions[seed % len(functions)]
            answered += self.attempt(seed, function, lambda: random_value(random)) is not None
        self.assertGreater(answered, CASES // 200)

    def test_nearly_right_ones_are_answered_or_refused(self):
        avatar = arm()
        motion = swing(avatar)
        built = detailed = 0
        for seed in range(CASES):
            random = np.random.default_rng(seed)
            scene = self.attempt(seed, foretouch.Scene.from_arrays, *nearly_right(random))
            if scene is None:
                continue
            built += 1
            tolerance = float(10.0 ** random.uniform(-9.5, 1))
            step = self.attempt(seed, foretouch.first_contacts, avatar, motion, scene, tolerance,
                                scope="objects", pass_separating=bool(seed % 2))
            if step is not None:
                self.assertTrue(((step.free_until >= 0) & (step.free_until <= 1)).all(), seed)
                touched = step.verdicts == foretouch.Verdict.CONTACT
                self.assertTrue((step.separation[touched] <= tolerance).all(), seed)
                detailed += sum(self.has_details(seed, contact) for contact in step.objects)
        self.assertGreater(built, CASES // 2)
        self.assertGreater(detailed, CASES // 20)

    def has_details(self, seed, contact):
        details = contact.details()
        if details is None:
            return False
        self.assertLessEqual(details.approach_lower, details.approach_speed, seed)
        self.assertLessEqual(details.approach_speed, details.approach_upper, seed)
        self.assertTrue(np.isfinite(details.velocity_of_link).all(), seed)
        self.assertLessEqual(len(details.points), 4, seed)
        return True


if __name__ == "__main__":
    unittest.main()

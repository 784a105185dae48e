"""One edge of a robot, asked in every way that there is: all of them give one answer.

Robots are random chains with continuous joints, limits beyond a whole turn, joints that slide, and
joints that follow others. What is right comes from kinematics in numpy, sampled finely: they share
nothing with the library but the robot's text."""

import ctypes as c
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from solid_in_c import LIBRARY
from support import BUILD, PROGRAM

ROBOTS, EDGES = 8, 12
RADIUS, LENGTH = 0.04, 0.3
BAND = 0.003
"""Metres: nearer to touching than that, tolerance and sampling may decide either way."""


class RandomRobot:
    """A chain of capsules along z, and an obstacle as small as a grain."""

    def __init__(self, seed):
        random = np.random.default_rng(seed)
        self.joints = []
        for i in range(int(random.integers(3, 6))):
            kind = random.choice(["continuous", "revolute", "revolute", "prismatic"])
            axis = random.normal(size=3)
            limit = random.uniform(np.pi, 3 * np.pi) if kind == "revolute" else 0.2
            leader, factor, offset = None, 1.0, 0.0
            if i > 0 and kind != "prismatic" and random.random() < 0.3:
                free = [j for j, other in enumerate(self.joints) if other["leader"] is None]
                leader = int(random.choice(free))
                factor, offset = random.uniform(-2, 2), random.uniform(-1, 1)
                kind = "continuous"
            self.joints.append({"kind": str(kind), "axis": axis / np.linalg.norm(axis),
                                "limit": limit, "leader": leader, "factor": factor,
                                "offset": offset})
        self.moved = [i for i, joint in enumerate(self.joints) if joint["leader"] is None]
        self.names = [f"j{i}" for i in self.moved]
        spans = [self.joints[i]["limit"] if self.joints[i]["kind"] != "continuous" else 2 * np.pi
                 for i in self.moved]
        self.q = random.uniform(-1, 1, (EDGES + 1, len(self.moved))) * spans
        self.grain = np.zeros(3)
        while np.linalg.norm(self.grain - [0, 0, np.clip(self.grain[2], 0, LENGTH)]) < 0.2:
            t = random.random()  # where a link's end is on some edge, but off the base
            edge = random.integers(EDGES)
            where = self.points((1 - t) * self.q[None, edge] + t * self.q[None, edge + 1])[0]
            self.grain = where[2 * random.integers(1, len(self.joints) + 1) + 1]

    def urdf(self):
        def link(name):
            return (f'<link name="{name}"><collision><origin xyz="0 0 {LENGTH / 2}"/><geometry>'
                    f'<capsule radius="{RADIUS}" length="{LENGTH}"/></geometry></collision></link>')
        text = '<robot name="chain">' + link("base")
        for i, joint in enumerate(self.joints):
            parent = f"link{i - 1}" if i > 0 else "base"
            x, y, z = joint["axis"].tolist()
            limit, follow = "", ""
            if joint["kind"] != "continuous":
                limit = (f'<limit lower="{-joint["limit"]!r}" upper="{joint["limit"]!r}" '
                         'effort="1" velocity="1"/>')
            if joint["leader"] is not None:
                follow = (f'<mimic joint="j{joint["leader"]}" multiplier="{joint["factor"]!r}" '
                          f'offset="{joint["offset"]!r}"/>')
            text += link(f"link{i}") + (
                f'<joint name="j{i}" type="{joint["kind"]}"><parent link="{parent}"/>'
                f'<child link="link{i}"/><origin xyz="0 0 {LENGTH}"/>'
                f'<axis xyz="{x!r} {y!r} {z!r}"/>{limit}{follow}</joint>')
        return text + "</robot>"

    def scene(self):
        """Z-up."""
        x, y, z = self.grain.tolist()
        return "o grain\n" + "".join(
            f"v {x + dx!r} {y + dy!r} {z!r}\n" for dx, dy in ((0, 0), (1e-5, 0), (0, 1e-5))
        ) + "f 1 2 3\n"

    def table(self):
        rows = [",".join([repr(float(i)), *map(repr, row.tolist())])
                for i, row in enumerate(self.q)]
        return "\n".join(["time," + ",".join(self.names), *rows]) + "\n"

    def points(self, q):
        """Of each configuration, the ends of all capsules: (n, links + 1, 3)."""
        place, turn = np.zeros((len(q), 3)), np.broadcast_to(np.eye(3), (len(q), 3, 3))
        ends = [place, place + LENGTH * turn[:, :, 2]]
        for joint_index, joint in enumerate(self.joints):
            source = joint["leader"] if joint["leader"] is not None else joint_index
            value = q[:, self.moved.index(source)]
            if joint["leader"] is not None:
                value = joint["factor"] * value + joint["offset"]
            place = place + LENGTH * turn[:, :, 2]
            axis = joint["axis"]
            if joint["kind"] == "prismatic":
                place = place + value[:, None] * (turn @ axis)
            else:
                x, y, z = axis
                cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
                own = (np.eye(3) + np.sin(value)[:, None, None] * cross
                       + (1 - np.cos(value))[:, None, None] * (cross @ cross))
                turn = turn @ own
            ends += [place, place + LENGTH * turn[:, :, 2]]
        return np.stack(ends, axis=1)

    def gap(self, edge):
        """How near the robot comes to the grain on the edge, by samples; below 0: it meets it."""
        t = np.linspace(0, 1, 20001)[:, None]
        ends = self.points(self.q[edge] + t * (self.q[edge + 1] - self.q[edge]))
        a, b = ends[:, 0::2], ends[:, 1::2]
        along = np.clip(np.einsum("nlk,nlk->nl", self.grain - a, b - a) / LENGTH**2, 0, 1)
        nearest = a + along[..., None] * (b - a)
        return np.linalg.norm(nearest - self.grain, axis=2).min() - RADIUS

    def largest_turn(self, edge):
        step = np.abs(self.q[edge + 1] - self.q[edge])
        return max(step[i] for i, j in enumerate(self.moved)
                   if self.joints[j]["kind"] != "prismatic") if any(
            self.joints[j]["kind"] != "prismatic" for j in self.moved) else 0.0


def run(*command, codes=(0,)):
    ended = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if ended.returncode not in codes:
        raise AssertionError(f"{command}: {ended.returncode}\n{ended.stdout}{ended.stderr}")
    return ended


class Ways:
    """The files of one robot, and the answers of each way: per edge, does it meet the grain?"""

    def __init__(self, robot, folder):
        self.robot, self.folder = robot, Path(folder)
        for name, text in (("r.urdf", robot.urdf()), ("s.obj", robot.scene()),
                           ("q.csv", robot.table())):
            (self.folder / name).write_text(text)
        run(PROGRAM, "avatar", "urdf", self.folder / "r.urdf", "-o", self.folder / "a.json")
        self.arguments = ["--scene", self.folder / "s.obj", "--scene-up", "z", "--avatar",
                          self.folder / "a.json", "--motion", self.folder / "q.csv", "--robot",
                          self.folder / "r.urdf"]

    def edges(self):
        answer = self.edge_query().answer(self.robot.q[:-1], self.robot.q[1:])
        return [edge.verdict != foretouch.Verdict.CLEAR for edge in answer]

    def edges_in_c(self):
        """Verdict and free_until, besides, are Python's to the bit."""

        class Edge(c.Structure):
            _fields_ = [("size", c.c_uint32), ("verdict", c.c_int32), ("reason", c.c_int32),
                        ("is_usable", c.c_int32), ("free_until", c.c_double),
                        ("breach_at_0", c.c_int32), ("breach_at_1", c.c_int32)]

        # Built, not installed, the C library does not find its importer.
        os.environ["FORETOUCH_IMPORTER"] = str(Path(PROGRAM).with_name("foretouch-import"))
        lib = c.CDLL(str(LIBRARY))
        lib.ft_last_error.restype = c.c_char_p

        def must(status):
            assert status == 0, lib.ft_last_error().decode()

        scene, robot, edges = c.c_void_p(), c.c_void_p(), c.c_void_p()
        must(lib.ft_scene_create_from_file(str(self.folder / "s.obj").encode(), None, c.byref(scene)))
        must(lib.ft_robot_create_from_urdf(str(self.folder / "r.urdf").encode(), None,
                                           c.byref(robot)))
        must(lib.ft_edges_create(robot, scene, None, c.byref(edges)))
        q0, q1 = (np.ascontiguousarray(q) for q in (self.robot.q[:-1], self.robot.q[1:]))
        answers = (Edge * EDGES)()
        answers[0].size = c.sizeof(Edge)
        must(lib.ft_edges_answer(edges, c.c_void_p(q0.ctypes.data), c.c_void_p(q1.ctypes.data),
                                 c.c_size_t(EDGES), c.c_size_t(q0.shape[1]), answers))
        asked = self.edge_query().answer(q0, q1)
        assert [a.verdict for a in answers] == asked.verdicts.tolist()
        assert [a.free_until for a in answers] == asked.free_until.tolist()
        lib.ft_edges_destroy(edges)
        lib.ft_robot_destroy(robot)
        lib.ft_scene_destroy(scene)
        return [a.verdict != foretouch.Verdict.CLEAR for a in answers]

    def edge_query(self, **options):
        scene = foretouch.Scene.load(self.folder / "s.obj")
        robot = foretouch.Robot.load_urdf(self.folder / "r.urdf")
        return foretouch.EdgeQuery(robot, scene, **options)

    def edges_certified(self):
        """By Python and by the program, which turns robot and scene to Y up, each as a stranger
        proves it."""
        for clearance in (0.0, 1e-4):
            made = self.edge_query(clearance=clearance).certify(
                self.robot.q[:-1], self.robot.q[1:], self.folder / "python")
            told = self.proven_by_program(clearance)
            assert told["not_proven"] == [] or told["not_proven"][0]["verdict"]
            sure = np.abs(self.robot.gaps) > BAND
            names = {edge["edge"] for edge in told["not_proven"]}
            proven = np.array([i not in names for i in range(EDGES)])
            np.testing.assert_array_equal(proven[sure], made.proven[sure])
            for folder, count in ((self.folder / "python", made.proven.sum()),
                                  (self.folder / "program", proven.sum())):
                self.verify_edges(folder, int(count))
        return [not proven for proven in made.proven.tolist()]

    def proven_by_program(self, clearance):
        names = self.robot.names
        rows = [",".join([str(i), *map(repr, row.tolist())]) for i in range(EDGES)
                for row in (self.robot.q[i], self.robot.q[i + 1])]
        (self.folder / "edges.csv").write_text("\n".join([",".join(["edge", *names]), *rows, ""]))
        ended = run(PROGRAM, "certify", "--scene", self.folder / "s.obj", "--scene-up", "z",
                    "--robot", self.folder / "r.urdf", "--edges", self.folder / "edges.csv",
                    "--clearance", clearance, "--json", "-o", self.folder / "program",
                    codes=(0, 1))
        return json.loads(ended.stdout)

    @staticmethod
    def verify_edges(folder, count):
        ended = run(BUILD / "bin" / "foretouch-verify",
                    *(folder / name for name in ("scene.obj", "avatar.json", "edges.txt",
                                                 "certificate.txt")), codes=(0, 1))
        assert (ended.returncode == 0) == (count > 0), ended.stdout
        if count > 0:
            assert ended.stdout.startswith(f"proven: {count} of {EDGES} edges"), ended.stdout

    def poses_along(self):
        scene = foretouch.Scene.load(self.folder / "s.obj")
        robot = foretouch.Robot.load_urdf(self.folder / "r.urdf")
        query = foretouch.Query(robot.avatar, scene)
        return [self.meets(query, robot.avatar, robot.path(self.robot.q[i:i + 2])[0])
                for i in range(EDGES)]

    def clip(self):
        clip = foretouch.Clip.load(self.folder / "q.csv", robot=self.folder / "r.urdf")
        avatar = foretouch.Avatar.load(self.folder / "a.json")
        query = foretouch.Query(avatar, foretouch.Scene.load(self.folder / "s.obj", up="z"))
        poses, k = clip.poses(avatar), clip.frames_per_row
        assert abs(clip.frame_time_s * k - 1) < 1e-12 and len(poses) == EDGES * k + 1
        return [self.meets(query, avatar, poses[i * k:(i + 1) * k + 1]) for i in range(EDGES)]

    def all(self):
        return (self.edges, self.edges_in_c, self.edges_certified, self.poses_along, self.clip,
                self.replay)

    @staticmethod
    def meets(query, avatar, poses):
        return any(not query.first_contacts(foretouch.Motion(avatar, a, b)).is_clear
                   for a, b in zip(poses, poses[1:]))

    def replay(self):
        run(PROGRAM, "replay", *self.arguments, "-o", self.folder / "out.jsonl")
        met = [False] * EDGES
        for line in (self.folder / "out.jsonl").read_text().splitlines():
            step = json.loads(line)
            if not step.get("contacts"):
                continue
            row = step.get("row", step.get("step"))
            for contact in step["contacts"]:
                assert row <= contact["time"] <= row + 1, "times are those of the table"
            met[row] = True
        return met

    def certificate(self):
        """Only whether all of it is free, as a stranger proves it."""
        proof = self.folder / "proof"
        run(PROGRAM, "certify", *self.arguments, "-o", proof, codes=(0, 1))
        ended = run(BUILD / "bin" / "foretouch-verify", proof / "scene.obj", proof / "avatar.json",
                    proof / "steps.txt", proof / "certificate.txt", "--whole", codes=(0, 1))
        return ended.returncode == 0


class SameEdge(unittest.TestCase):
    def test_every_way_gives_one_answer(self):
        asked = touched = turned = 0
        for seed in range(ROBOTS):
            robot = RandomRobot(seed)
            gaps = robot.gaps = np.array([robot.gap(i) for i in range(EDGES)])
            sure = np.flatnonzero(np.abs(gaps) > BAND)
            expected = gaps[sure] < 0
            with tempfile.TemporaryDirectory() as folder, self.subTest(seed=seed):
                ways = Ways(robot, folder)
                for way in ways.all():
                    np.testing.assert_array_equal(np.array(way())[sure], expected, way.__name__)
                if len(sure) == EDGES:
                    self.assertEqual(ways.certificate(), not expected.any())
            asked += len(sure)
            touched += int(expected.sum())
            turned += sum(robot.largest_turn(i) > np.pi for i in sure)
        self.assertGreater(asked, 0.9 * ROBOTS * EDGES)
        self.assertGreater(turned, asked / 3)
        self.assertTrue(0.1 * asked < touched < 0.8 * asked, (touched, asked))

    def test_a_joint_passes_zero_on_its_way_from_minus_two_to_two(self):
        robot = RandomRobot(0)
        robot.joints = [{"kind": "revolute", "axis": np.array([1.0, 0, 0]), "limit": 3.0,
                         "leader": None, "factor": 1.0, "offset": 0.0}]
        robot.moved, robot.names = [0], ["j0"]
        robot.q = np.array([[-2.0], [2.0]])
        robot.grain = np.array([0.0, 0.0, 2 * LENGTH + 0.02])  # above the upright arm
        global EDGES
        before, EDGES = EDGES, 1
        try:
            robot.gaps = np.array([robot.gap(0)])
            self.assertLess(robot.gaps[0], -BAND)
            with tempfile.TemporaryDirectory() as folder:
                ways = Ways(robot, folder)
                for way in ways.all():
                    self.assertEqual(way(), [True], way.__name__)
                self.assertFalse(ways.certificate())
        finally:
            EDGES = before

    def test_a_base_in_its_table_is_named_and_lies_in_files_are_refused(self):
        def ball(name, x, radius):
            return (f'<link name="{name}"><collision><origin xyz="{x} 0 0"/><geometry>'
                    f'<sphere radius="{radius}"/></geometry></collision></link>')

        def turn(parent, child, x, axis):
            return (f'<joint name="to_{child}" type="revolute"><parent link="{parent}"/>'
                    f'<child link="{child}"/><origin xyz="{x} 0 0"/><axis xyz="{axis}"/>'
                    '<limit lower="-9" upper="9" effort="1" velocity="1"/></joint>')

        urdf = ('<robot name="r">' + ball("base", 0, 0.1) + ball("arm", 0.4, 0.05)
                + ball("tip", 0.4, 0.05) + turn("base", "arm", 0, "0 0 1")
                + turn("arm", "tip", 0.4, "0 1 0") + "</robot>")
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file, text in (("r.urdf", urdf), ("s.obj", (
                    "o table\nv -1 -1 -0.08\nv 1 -1 -0.08\nv 1 1 -0.08\nf 1 2 3\nv -1 1 -0.08\n"
                    "f 1 3 4\n")), ("e.csv", (
                    "edge,to_tip,to_arm\n0,0,0\n0,-1,7\n1,0,0\n1,0.3,0\n"))):
                (folder / file).write_text(text)
            asked = [PROGRAM, "certify", "--scene", folder / "s.obj", "--scene-up", "z", "--robot",
                     folder / "r.urdf", "--edges", folder / "e.csv", "-o", folder]
            told = run(*asked)
            self.assertIn('all 2 edges start with link "base" and object "table" in contact; if it '
                          'stands there, as a base does, ignore the pair: --ignore "base:table"',
                          " ".join(told.stderr.split()))
            self.assertIn('edge 1: starts_in_contact: link "base" and object "table"', told.stdout)
            refused = run(*asked, "--rate", "30", codes=(2,))
            self.assertIn("--rate: not with --edges", refused.stderr)
            told = run(*asked, "--ignore", "base:table", "--clearance", "0.02", "--self")
            self.assertIn('edge 1: contact: link "tip" and object "table"', told.stdout)

            def verified(*more):
                return run(BUILD / "bin" / "foretouch-verify",
                           *(folder / file for file in ("scene.obj", "avatar.json", "edges.txt",
                                                        "certificate.txt")), *more,
                           codes=(0, 1, 2))

            honest = verified()
            self.assertIn("proven: 1 of 2 edges keep more than 0.02", honest.stdout)
            self.assertIn("not claimed: edge 1: contact", honest.stdout)
            self.assertIn("is not claimed: contact", verified("--whole").stdout)
            proof = (folder / "certificate.txt").read_text()
            self.assertIn("pair 0 2\n", proof)
            for file, old, new, why, code in (
                    ("certificate.txt", "edge 0", "edge 1", "none of its planes", 1),
                    ("certificate.txt", "edge 1 contact\n", "", "edge 1: is neither claimed nor", 1),
                    ("certificate.txt", proof[proof.index("pair 0 2"):proof.index("edge 1")], "",
                     "links 0 and 2 are not proven apart", 1),
                    ("certificate.txt", proof[proof.index("link 2"):proof.index("pair 0")], "",
                     "link 2 is not proven apart from the scene", 1),
                    ("certificate.txt", "certificate 2", "certificate 1", "of edges", 2),
                    ("edges.txt", "clearance 0.02", "clearance 0.2", "none of its planes", 1),
                    ("edges.txt", "ignore 0 0 2\n", "", "none of its planes", 1),
                    ("edges.txt", "7 -1", "7 1", "none of its planes", 1),
                    ("edges.txt", "end\n", "", "cut", 2)):
                text = (folder / file).read_text()
                self.assertIn(old, text)
                (folder / file).write_text(text.replace(old, new, 1))
                ended = verified()
                self.assertEqual(ended.returncode, code, (old, ended.stdout + ended.stderr))
                self.assertIn(why, ended.stdout + ended.stderr)
                (folder / file).write_text(text)


if __name__ == "__main__":
    unittest.main()

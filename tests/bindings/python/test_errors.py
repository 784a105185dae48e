"""Every way to be wrong: the exception, and what it says. Nothing here may crash or hang."""

import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from foretouch import Avatar, Clip, InputError, Motion, Poses, Query, ResourceError, Scene
from support import arm, bent, example, swing, wall

NAN, INF = float("nan"), float("inf")


class Errors(unittest.TestCase):
    def refused(self, pattern, function, *arguments, kind=InputError, **keywords):
        with self.subTest(pattern=pattern):
            with self.assertRaisesRegex(kind, pattern) as caught:
                function(*arguments, **keywords)
            return caught.exception

    def test_are_what_python_expects(self):
        self.assertTrue(issubclass(InputError, ValueError))
        self.assertTrue(issubclass(ResourceError, OSError))
        self.assertTrue(issubclass(InputError, foretouch.Error))
        self.assertTrue(issubclass(ResourceError, foretouch.Error))

    def test_carry_file_line_and_code(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.bvh"
            file.write_text("HIERARCHY\nROOT a\n{\nOFFSET 0 0\n}\n")
            error = self.refused(f"{file}:", Clip.load, file)
        self.assertEqual((error.file, error.code), (str(file), "syntax"))
        self.assertIn(f":{error.line}: ", str(error))
        missing = self.refused("/no/such", Clip.load, "/no/such.bvh", kind=ResourceError)
        self.assertEqual((missing.code, missing.line, missing.index), ("file-not-found", None, None))

    def test_of_files(self):
        for load in [Scene.load, Avatar.load, Clip.load, Avatar.from_bvh]:
            self.refused("/no/such.obj", load, "/no/such.obj", kind=ResourceError)
            self.refused("path: expected a path", load, 5)
            self.refused("path: expected a path", load, None)
            self.refused("NUL", load, "a\0b")
            self.refused("encoded", load, "\ud800x")
            self.refused("", load, "/tmp", kind=ResourceError)
        self.refused("no/such/folder", arm().save, "/no/such/folder/a.json", kind=ResourceError)
        with tempfile.TemporaryDirectory() as folder:
            broken = Path(folder) / "x.obj"
            broken.write_text("v 1 2\n")
            self.refused("x.obj", Scene.load, broken)
            odd = os.fsencode(folder) + b"/\xff\x1b[2J.json"
            Path(os.fsdecode(odd)).write_bytes(b"{")
            error = self.refused("", Avatar.load, odd)
            self.assertIn("\\xff", str(error))

    def test_of_loading_options(self):
        folder = foretouch.example_folder()
        room = folder / "room.obj"
        for scale in [0, -1, NAN, INF]:
            self.refused("scale", Scene.load, room, scale)
            self.refused("", Clip.load, folder / "dancer.bvh", scale)
            self.refused("", Avatar.from_bvh, folder / "dancer.bvh", scale)
            self.refused("radius", Avatar.from_bvh, folder / "dancer.bvh", radius_scale=scale)
        self.refused("scale: expected a number", Scene.load, room, "1")
        self.refused("scale: expected a number", Scene.load, room, True)
        self.refused("up: expected one of 'y', 'z', found 'x'", Scene.load, room, up="x")
        self.refused("up: expected a text", Scene.load, room, up=3)
        self.refused("memory_limit_bytes", Scene.load, room, memory_limit_bytes=-1)
        self.refused("memory limit", Scene.load, room, memory_limit_bytes=1)
        self.refused("memory_limit_bytes", Scene.load, room, memory_limit_bytes=1 << 70)
        self.refused("time", Scene.load, room, time_limit_s=0)
        self.refused("time", Scene.load, room, time_limit_s=NAN)
        self.refused("importer", Scene.load, room, importer=3)
        self.refused("/no/importer", Scene.load, room, importer="/no/importer", kind=ResourceError)

    def test_of_scene_arrays(self):
        make, v, t = Scene.from_arrays, np.eye(3), [[0, 1, 2]]
        self.refused(r"vertices: expected the shape \(any, 3\), found \(3, 2\)", make, v[:, :2], t)
        self.refused(r"vertices: .*found \(3,\)", make, [1, 2, 3], t)
        self.refused("vertices: expected", make, None, t)
        self.refused("vertices: expected", make, "abc", t)
        self.refused("vertices: expected an array", make, [[1, 2, 3], [4, 5]], t)
        self.refused("vertices: expected real numbers, found dtype complex128", make, v * 1j, t)
        self.refused("vertices: expected real numbers, found dtype bool", make, v > 0, t)
        self.refused("vertices: expected real numbers, found dtype object", make,
                     v.astype(object), t)
        for bad in [NAN, INF, -INF]:
            self.refused(r"vertices\[1, 2\]: expected a finite number", make,
                         [[0, 0, 0], [0, 0, bad], [1, 1, 1]], t)
        self.refused("1e7", make, v * 1e8, t)
        self.refused(r"triangles: expected the shape \(any, 3\)", make, v, [0, 1, 2])
        self.refused("triangles: expected integers, found dtype float64", make, v, [[0., 1., 2.]])
        self.refused(r"triangles\[0, 1\]: expected a vertex from 0 to 2, found -1", make, v,
                     [[0, -1, 2]])
        self.refused(r"triangles\[1, 0\]: expected a vertex from 0 to 2, found 3", make, v,
                     [[0, 1, 2], [3, 1, 2]])
        self.refused(r"triangles\[0, 0\]", make, v, np.array([[2**64 - 1, 0, 0]], dtype=np.uint64))
        self.refused("at least one", make, v, np.zeros((0, 3), dtype=int))
        self.refused("triangles", make, np.zeros((0, 3)), t)
        self.refused(r"object_of: expected the shape \(1,\)", make, v, t, [0, 1])
        self.refused(r"object_of\[0\]: expected an object from 0 to 0, found -1", make, v, t, [-1])
        self.refused(r"object_of\[0\]: .*found 5", make, v, t, [5])
        self.refused(r"object_of\[0\]: .*0 to 1, found 2", make, v, t, [2], ["a", "b"])
        self.refused("object_names: expected a list", make, v, t, [0], "a")
        self.refused(r"object_names\[0\]: expected a text", make, v, t, [0], [b"a"])
        self.refused("UTF-8", make, v, t, [0], ["\ud800"])
        self.refused("object index", make, v, t, None, [])

    def test_of_avatar_arrays(self):
        lss = [[((0, 0, 0), (1, 0, 0), 0.1)], []]

        def make(names=("a", "b"), parents=(-1, 0), offsets=np.zeros((2, 3)), rotations=None,
                 lss=lss):
            return Avatar.from_arrays(names, parents, offsets, rotations, lss)

        make()
        self.refused("names: expected a list", make, names="ab")
        self.refused(r"names\[1\]: expected a text", make, names=["a", 2])
        self.refused("name", make, names=["a", "a"])
        self.refused("empty", make, names=["a", ""])
        self.refused("control", make, names=["a", "b\n"])
        self.refused(r"parents: expected the shape \(3,\)", make, names=["a", "b", "c"])
        self.refused("parents: expected integers", make, parents=[-1.0, 0.0])
        for parent in [1, 2, -2, 2**40, -(2**40)]:
            self.refused("parent", make, parents=[-1, parent])
        self.refused("offsets", make, offsets=np.zeros((2, 4)))
        self.refused(r"offsets\[0, 1\]", make, offsets=[[0, NAN, 0], [0, 0, 0]])
        self.refused("1e7", make, offsets=[[0, 1e9, 0], [0, 0, 0]])
        self.refused("rotations", make, rotations=np.zeros((2, 3)))
        self.refused("norm", make, rotations=np.ones((2, 4)))
        self.refused("lss", make, lss=None)
        self.refused("LSS", make, lss=[[], []])
        self.refused("LSS lists for 1", make, lss=lss[:1])
        self.refused(r"lss\[1\]\[0\]: expected \(a, b, radius\), found 2", make,
                     lss=[[], [((0, 0, 0), 1)]])
        self.refused(r"lss\[0\]\[0\].b", make, lss=[[((0, 0, 0), (1, 0), 0.1)], []])
        self.refused(r"lss\[0\]\[0\].radius", make, lss=[[((0, 0, 0), (1, 0, 0), "x")], []])
        for radius in [-1, NAN, INF, 1e9]:
            self.refused("LSS", make, lss=[[((0, 0, 0), (1, 0, 0), radius)], []])
        many = 5000
        self.refused("4096", Avatar.from_arrays, [str(i) for i in range(many)], [-1] * many,
                     np.zeros((many, 3)), None, [[]] * many)

    def test_of_poses(self):
        avatar = arm()
        rest = avatar.rest_pose()
        q, p = rest
        bad = [(None, "start"), (5, "start"), ((q,), "start"), ((q, p, p), "start"),
               ((q[:1], p), r"start.rotations: expected the shape \(2, 4\), found \(1, 4\)"),
               ((q, p[:1]), "start.translations"), ((q * 2, p), "start: .*norm"),
               ((q * NAN, p), r"start.rotations\[0, 0\]"), ((q, p + INF), "start.translations"),
               ((q, p + 1e9), "1e7"), ((p, q), "start.rotations"), ((q * 0, p), "norm"),
               ((q.astype(complex), p), "complex"), (("ab", "cd"), "start"), ({}, "start")]
        for given, pattern in bad:
            self.refused(pattern, Motion, avatar, given, rest)
        self.refused("end: ", Motion, avatar, rest, (q * 2, p))
        self.refused("", Motion, None, rest, rest, kind=TypeError)
        query = Query(avatar, wall())
        stack = Poses.stack([rest, rest, rest])
        self.refused("poses.rotations", query.first_contacts_many, rest)
        self.refused("at least two", query.first_contacts_many, stack[:1])
        self.refused("at least two", query.first_contacts_many, stack[:0])
        self.refused("ends", query.first_contacts_many, stack, ends=stack[:2])
        self.refused("ends", query.first_contacts_many, stack[:0], ends=stack[:0])
        wrong = Poses(stack.rotations.copy(), stack.translations)
        wrong.rotations[1, 1] = 3
        self.refused(r"poses\[1\]: joint 1 'fore'", query.first_contacts_many, wrong)
        for threads in [0, -1, 257, 1.0, True, "2", 2**80]:
            self.refused("threads", query.first_contacts_many, stack, threads=threads)

    def test_of_options(self):
        avatar, scene = arm(), wall()

        def ask(**options):
            return Query(avatar, scene, **options)

        for tolerance in [0, -1, 1e-10, 1e8, NAN, INF, "1", None]:
            self.refused("tolerance: expected", ask, tolerance=tolerance)
        self.refused("fidelity: expected one of 'link', 'exact'", ask, fidelity="skinned")
        self.refused("fidelity: expected the surface", ask, fidelity="exact")
        self.refused("fidelity", ask, fidelity=1)
        self.refused("surface: expected a foretouch.Surface", ask, surface=1)
        self.refused("scope: expected one of 'links', 'avatar'", ask, scope="all")
        for budget in [-1, 1.5, True, "3", 2**64]:
            self.refused("work_budget", ask, work_budget=budget)
        for deadline in [-1, NAN, "3"]:
            self.refused("deadline", ask, deadline_us=deadline)
        self.refused("ignore: expected a list", ask, ignore="fore")
        self.refused("ignore: expected a list", ask, ignore=None)
        self.refused(r"ignore\[1\]: 'fort' is no link of the avatar; did you mean 'fore'\?", ask,
                     ignore=["upper", "fort"])
        self.refused(r"ignore\[0\]: expected 0 to 1, found 2", ask, ignore=[2])
        self.refused(r"ignore\[0\]: expected 0 to 1, found -1", ask, ignore=[-1])
        self.refused(r"ignore\[0\]\[1\]: 'walls' is no object.*'wall'", ask,
                     ignore=[("fore", "walls")])
        self.refused(r"ignore\[0\]\[1\]: expected 0 to 0", ask, ignore=[("fore", 1)])
        self.refused(r"ignore\[0\]: expected a link, or a pair", ask, ignore=[("fore",)])
        self.refused(r"ignore\[0\]: expected an integer", ask, ignore=[1.0])
        self.refused("policies: expected a dict", ask, policies=["fore"])
        self.refused("policies: 'x'", ask, policies={"x": {}})
        self.refused(r"policies\['fore'\]: expected a dict", ask, policies={"fore": 1e-3})
        self.refused(r"policies\['fore'\]\['tol'\]", ask, policies={"fore": {"tol": 1}})
        self.refused(r"policies\['fore'\]\['tolerance'\]: expected 1e-9", ask,
                     policies={"fore": {"tolerance": 0}})
        self.refused(r"policies\['fore'\]\['fidelity'\]: limb is gone: .*; use link", ask,
                     policies={"fore": {"fidelity": "limb"}})
        for gone in ["limb", "avatar", "ellipsoid"]:
            self.refused(f"fidelity: {gone} is gone: a volume around several links was slower and "
                         r"coarser .* \(docs/trade.md\); use link", ask, fidelity=gone)
        self.refused(r"policies\['fore', 'wall'\]\['ignore'\]: expected a bool", ask,
                     policies={("fore", "wall"): {"ignore": 1}})
        self.refused("policies: 'walls' is no object.*'wall'", ask,
                     policies={("fore", "walls"): {"ignore": True}})
        self.refused("policies: expected a link, or a pair", ask, policies={("fore",): {}})
        self.refused("policies: fidelity: expected no objects beside it", ask,
                     policies={("fore", "wall"): {"fidelity": "exact"}})
        self.refused("surface of this avatar", ask, policies={0: {"fidelity": "exact"}})
        self.refused("", Query, None, scene, kind=TypeError)
        self.refused("", Query, avatar, None, kind=TypeError)
        self.refused("", Query, scene, avatar, kind=TypeError)

    def test_of_things_of_another_avatar(self):
        one, other, scene = arm(), arm(), wall()
        motion = swing(other)
        query = Query(one, scene)
        self.refused("motion: expected a motion of this avatar", query.first_contacts, motion)
        self.refused("motion: expected a motion of this avatar", query.touches_at, motion, 0.5)
        self.refused("motion", foretouch.first_contacts, one, motion, scene)
        surface = foretouch.Surface.from_triangles(other, [None, None])
        self.refused("surface: expected the surface of this avatar", Query, one, scene,
                     surface=surface, fidelity="exact")
        self.refused("", query.first_contacts, None, kind=TypeError)

    def test_of_surfaces(self):
        make, avatar = foretouch.Surface.from_triangles, arm()
        inside = [[[0, 0, 0], [0.1, 0, 0], [0, 0.01, 0]]]
        make(avatar, [inside, None])
        self.refused("triangles for 2 links, found 1", make, avatar, [inside])
        self.refused("outside", make, avatar, [np.array(inside) + 1, None])
        self.refused(r"triangles\[0\]: expected the shape", make, avatar, [[[0, 0, 0]], None])
        self.refused(r"triangles\[1\]\[0, 0, 0\]", make, avatar, [None, np.array(inside) * NAN])
        self.refused("", make, None, [], kind=TypeError)
        self.refused("'x' is no link", make(avatar, [inside, None]).triangles, "x")
        self.refused("expected 0 to 1", make(avatar, [inside, None]).triangles, -1)
        self.refused("", foretouch.Surface.load, None, "x", kind=TypeError)

    def test_of_clips(self):
        avatar, _, clip = example()
        self.refused("up", clip.poses, avatar, up="x")
        self.refused("origin", clip.poses, avatar, origin=(1, 2))
        self.refused("origin", clip.poses, avatar, origin=(1, 2, NAN))
        self.refused("frame 0: ", clip.poses, avatar, yaw_deg=NAN)
        self.refused("frame 0: .*1e7", clip.poses, avatar, origin=(1e9, 0, 0))
        self.refused("joint_map: expected a dict", clip.poses, avatar, joint_map=["a"])
        self.refused("joint_map: expected a text", clip.poses, avatar, joint_map={1: "a"})
        self.refused("'nobody'", clip.match, avatar, joint_map={"nobody": "Hips"})
        self.refused("no joint of the avatar", clip.poses, arm())
        self.refused("", clip.poses, None, kind=TypeError)

    def test_of_names_and_indices(self):
        avatar = arm()
        for bad in [2, -1, 2**70, 1.0, None, True, "", "Fore ", b"fore", ["fore"], "\ud800"]:
            self.refused("name", avatar.link, bad)
            step = foretouch.first_contacts(avatar, swing(avatar), wall())
            self.refused("link", step.__getitem__, bad)

    def test_of_sweeps(self):
        avatar = arm()
        motion = swing(avatar)
        sweep = foretouch.swept_surface
        for error in [0, -1, NAN, INF, 1e-20, "x"]:
            self.refused("error", sweep, motion, "fore", error=error)
        self.refused("side", sweep, motion, "fore", side="both")
        self.refused("link", sweep, motion, "hand")
        self.refused("max_triangles", sweep, motion, "fore", max_triangles=0)
        self.refused("triangles", sweep, motion, "fore", max_triangles=10)
        self.refused("motions", sweep, [], "fore")
        self.refused("motions", sweep, None, "fore")
        self.refused(r"motions\[1\]", sweep, [motion, None], "fore")
        self.refused(r"motions\[1\]: .*where the one before", sweep, [motion, motion], "fore")
        back = Motion(arm(), bent(arm(), 0, np.pi / 2), arm().rest_pose())
        self.refused(r"motions\[1\]: .*avatar", sweep, [motion, back], "fore")
        bare = Avatar.from_arrays(["a", "b"], [-1, 0], np.zeros((2, 3)), None,
                                  [[], [((0, 0, 0), (1, 0, 0), 0.1)]])
        still = Motion(bare, bare.rest_pose(), bare.rest_pose())
        self.refused("link: expected a link with an LSS", sweep, still, "a")


if __name__ == "__main__":
    unittest.main()

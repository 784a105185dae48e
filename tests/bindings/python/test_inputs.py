"""Scenes and avatars from arrays and files: what they hold afterwards."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from support import arm, example, wall


class Scenes(unittest.TestCase):
    def test_from_arrays_keeps_ids_and_names(self):
        random = np.random.default_rng(1)
        vertices = random.normal(size=(30, 3))
        triangles = random.integers(0, 30, size=(20, 3))
        owner = random.integers(0, 3, size=20)
        scene = foretouch.Scene.from_arrays(vertices, triangles, owner, ["a", "b", "ä"])
        self.assertEqual(scene.num_triangles, 20)
        self.assertEqual(scene.object_names, ["a", "b", "ä"])
        np.testing.assert_array_equal(scene.object_of, owner)
        for given, kept in zip(vertices[triangles], scene.triangles):
            self.assertEqual(sorted(given.tolist()), kept.tolist())
        self.assertIn("20 triangles, 3 objects", repr(scene))

    def test_from_arrays_takes_any_layout_and_width(self):
        vertices = np.asfortranarray(np.eye(3, dtype=np.float32))[::-1]
        for dtype in [np.int8, np.uint16, np.int32, np.uint64]:
            triangles = np.array([[0, 9, 1, 9, 2]], dtype=dtype)[:, ::2]
            scene = foretouch.Scene.from_arrays(vertices, triangles)
            self.assertEqual(scene.object_names, ["object_0"])
            self.assertEqual(sorted(scene.triangles[0].tolist()), sorted(np.eye(3).tolist()))

    def test_unnamed_objects_are_numbered(self):
        scene = foretouch.Scene.from_arrays(np.eye(3), [[0, 1, 2]] * 3, [0, 2, 0])
        self.assertEqual(scene.object_names, ["object_0", "object_1", "object_2"])

    def test_the_audit_counts(self):
        audit = foretouch.Scene.from_arrays(np.eye(3), [[0, 1, 2], [1, 0, 2], [0, 0, 1]]).audit
        self.assertEqual((audit.triangles, audit.duplicates, audit.zero_area), (3, 1, 1))
        np.testing.assert_array_equal(audit.box_max, [1, 1, 1])
        self.assertAlmostEqual(audit.longest_edge, np.sqrt(2))

    def test_load_scales_and_turns(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "ä.obj"
            file.write_text("o box\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 2 3\n")
            scene = foretouch.Scene.load(file, scale=0.01, up="z")
            self.assertEqual(scene.object_names, ["box"])
            expected = sorted([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
            np.testing.assert_allclose(scene.triangles[0], expected)
            for path in [str(file), str(file).encode()]:
                self.assertEqual(foretouch.Scene.load(path).num_triangles, 1)


class Avatars(unittest.TestCase):
    def test_say_what_they_were_made_of(self):
        avatar = arm()
        self.assertEqual((len(avatar), avatar.num_links, avatar.num_lss), (2, 2, 2))
        self.assertEqual(avatar.names, ["upper", "fore"])
        self.assertEqual(avatar.parents.tolist(), [-1, 0])
        self.assertEqual((avatar.link("fore"), avatar.link(np.int64(1))), (1, 1))
        self.assertEqual(avatar.lss[1][0].radius, 0.04)
        np.testing.assert_array_equal(avatar.lss[1][0].b, [0.3, 0, 0])
        rest = avatar.rest_pose()
        np.testing.assert_array_equal(rest.translations, [[0, 1, 0], [0.3, 0, 0]])
        self.assertIn("2 links", repr(avatar))

    def test_are_made_of_what_they_say(self):
        avatar, _, _ = example()
        rest = avatar.rest_pose()
        again = foretouch.Avatar.from_arrays(avatar.names, avatar.parents, rest.translations,
                                             rest.rotations, avatar.lss)
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / "a.json", Path(folder) / "b.json"]
            avatar.save(files[0])
            again.save(files[1])
            self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
            read = foretouch.Avatar.load(files[0])
            self.assertEqual(read.names, avatar.names)

    def test_from_bvh_has_an_lss_a_bone(self):
        file = foretouch.example_folder() / "dancer.bvh"
        avatar = foretouch.Avatar.from_bvh(file)
        clip = foretouch.Clip.load(file)
        self.assertEqual(avatar.names, clip.joint_names)
        self.assertGreater(avatar.num_lss, 20)
        fat = foretouch.Avatar.from_clip(clip, radius_scale=2)
        self.assertAlmostEqual(fat.lss[5][0].radius, 2 * avatar.lss[5][0].radius)
        small = foretouch.Avatar.from_bvh(file, 0.5)
        np.testing.assert_allclose(small.rest_pose().translations,
                                   avatar.rest_pose().translations / 2)


class Package(unittest.TestCase):
    def test_has_a_version_and_exports_what_it_says(self):
        self.assertRegex(foretouch.__version__, r"^\d+\.\d+\.\d+$")
        for name in foretouch.__all__:
            self.assertTrue(hasattr(foretouch, name), name)

    def test_answers_nothing_without_a_scene(self):
        self.assertEqual(wall().num_triangles, 2)
        with self.assertRaises(TypeError):
            foretouch.Query(arm())


if __name__ == "__main__":
    unittest.main()

"""Clips of animated models, and what is said of a clip in another unit than the avatar."""

import base64
import json
import struct
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import foretouch
from support import example


def bending_leg():
    """A glTF text: in one second a hip rises by 0.1 m, and a knee 0.4 m below it turns by 90 degrees
    about +x."""
    half = 0.5 ** 0.5
    times = struct.pack("<2f", 0.0, 1.0)
    turns = struct.pack("<8f", 0, 0, 0, 1, half, 0, 0, half)
    corners = struct.pack("<9f", 0, 0, 0, 0.1, 0, 0, 0, -0.3, 0)
    places = struct.pack("<6f", 0, 0.9, 0, 0, 1.0, 0)
    data = times + turns + corners + places
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Hip", "translation": [0, 0.9, 0], "children": [1], "mesh": 0},
                  {"name": "Knee", "translation": [0, -0.4, 0], "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 2}}]}],
        "animations": [{"name": "bend", "channels": [
            {"sampler": 0, "target": {"node": 1, "path": "rotation"}},
            {"sampler": 1, "target": {"node": 0, "path": "translation"}}],
            "samplers": [{"input": 0, "output": 1, "interpolation": "LINEAR"},
                         {"input": 0, "output": 3, "interpolation": "LINEAR"}]}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 8, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 40, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 76, "byteLength": 24}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR",
             "min": [0], "max": [1]},
            {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC4"},
            {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3",
             "min": [0, -0.3, 0], "max": [0.1, 0, 0]},
            {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]})


class ModelClips(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.model = self.folder / "leg.gltf"
        self.model.write_text(bending_leg())
        self.leg = foretouch.Avatar.from_arrays(
            ["Hip", "Knee"], [-1, 0], [[0, 0.9, 0], [0, -0.4, 0]], None,
            [[((0, 0, 0), (0, -0.4, 0), 0.05)], [((0, 0, 0), (0, -0.4, 0), 0.05)]])

    def test_are_sampled(self):
        clip = foretouch.Clip.load(self.model, rate_hz=10, animation="bend")
        self.assertEqual((len(clip), clip.joint_names), (11, ["Hip", "Knee"]))
        poses = clip.poses(self.leg)
        half = np.pi / 8
        np.testing.assert_allclose(poses[5].rotations[1], [np.cos(half), np.sin(half), 0, 0],
                                   atol=1e-6)
        np.testing.assert_allclose(poses[5].translations, [[0, 0.95, 0], [0, -0.4, 0]], atol=1e-7)
        self.assertEqual(len(foretouch.Clip.load(self.model)), 31)

    def test_are_turned_and_scaled_as_they_are_read(self):
        clip = foretouch.Clip.load(self.model, 0.5, up="z")
        # Only the hip has positions of its own in the file.
        np.testing.assert_allclose(clip.poses(self.leg)[-1].translations,
                                   [[0, 0, -0.5], [0, -0.4, 0]], atol=1e-7)

    def test_refuse_what_has_no_effect(self):
        table = self.folder / "log.csv"
        table.write_text("time,joint\n0,0\n1,1\n")
        bvh = foretouch.example_folder() / "dancer.bvh"
        for pattern, file, keywords in [
                ("bend, .*|no animation is called 'nod'", self.model, {"animation": "nod"}),
                ("animation: expected none", bvh, {"animation": "bend"}),
                ("robot: expected none", self.model, {"robot": "arm.urdf"}),
                ("robot: expected the URDF", table, {}),
                ("up: expected none: Clip.poses", bvh, {"up": "z"}),
                ("up: expected one of 'y', 'z'", self.model, {"up": "x"})]:
            with self.subTest(pattern), self.assertRaisesRegex(foretouch.InputError, pattern):
                foretouch.Clip.load(file, **keywords)


class Units(unittest.TestCase):
    def test_a_clip_a_hundred_times_as_large_is_said(self):
        avatar, _, clip = example()
        large = foretouch.Clip.load(foretouch.example_folder() / "dancer.bvh", scale=100)
        with self.assertWarnsRegex(UserWarning, r"100 times as long as the avatar's.*scale=0.01 "):
            large.poses(avatar)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            clip.poses(avatar)

    def test_a_tolerance_of_a_metre_is_said(self):
        avatar, scene, _ = example()
        with self.assertWarnsRegex(UserWarning, "tolerance=1 is in metres"):
            foretouch.Query(avatar, scene, tolerance=1.0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            foretouch.Query(avatar, scene, tolerance=0.1)


if __name__ == "__main__":
    unittest.main()

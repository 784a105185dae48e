"""Clips as poses of an avatar."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from support import example


class Clips(unittest.TestCase):
    def setUp(self):
        self.avatar, _, self.clip = example()

    def test_say_how_long_they_are(self):
        self.assertEqual(len(self.clip), 817)
        self.assertAlmostEqual(self.clip.duration_s, 816 / 60, places=3)
        self.assertAlmostEqual(self.clip.frame_time_s, 1 / 60, places=5)
        self.assertEqual(self.clip.notes, [])
        self.assertIn("817 frames", repr(self.clip))

    def test_poses_are_stacked(self):
        poses = self.clip.poses(self.avatar)
        self.assertEqual(poses.rotations.shape, (817, 26, 4))
        self.assertEqual(poses.translations.shape, (817, 26, 3))
        np.testing.assert_allclose(np.linalg.norm(poses.rotations, axis=2), 1, atol=1e-15)
        self.assertIn("817 poses of 26 joints", repr(poses))

    def test_poses_are_placed(self):
        plain = self.clip.poses(self.avatar)
        root = plain.translations[:, 0]
        moved = self.clip.poses(self.avatar, origin=(1, 2, 3)).translations[:, 0]
        np.testing.assert_allclose(moved, root + [1, 2, 3])
        turned = self.clip.poses(self.avatar, yaw_deg=90).translations[:, 0]
        np.testing.assert_allclose(turned, root[:, [2, 1, 0]] * [1, 1, -1], atol=1e-12)
        upright = self.clip.poses(self.avatar, up="z").translations[:, 0]
        np.testing.assert_allclose(upright, root[:, [0, 2, 1]] * [1, 1, -1], atol=1e-12)
        np.testing.assert_array_equal(moved[:, 0] - moved[:, 0], 0)
        np.testing.assert_array_equal(self.clip.poses(self.avatar, origin=(1, 2, 3)).rotations,
                                      plain.rotations)

    def test_of_acclaim_are_about_the_skeleton_that_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            amc = Path(folder, "walk.amc")
            amc.write_text(":FULLY-SPECIFIED\n:DEGREES\n1\nroot 0 2 0 0 0 0\nstick 0 0 30\n2\nroot 0 4 0 0 0 0\n"
                           "stick 0 0 60\n")
            for name in ("first.asf", "second.asf"):
                Path(folder, name).write_text(
                    ":version 1.10\n:units\n length 1\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n"
                    " position 0 0 0\n orientation 0 0 0\n:bonedata\n begin\n id 1\n name stick\n direction 0 -1 0\n"
                    " length 1\n axis 0 0 0 XYZ\n dof rx ry rz\n end\n:hierarchy\n begin\n root stick\n end\n")
            clip = foretouch.Clip.load(amc, skeleton=Path(folder, "first.asf"), row_rate_hz=50)
            self.assertEqual((len(clip), clip.frame_time_s), (2, 0.02))
            self.assertIn("stick", clip.joint_names)
            with self.assertRaises(foretouch.InputError):
                foretouch.Clip.load(amc)  # there are two beside it
            for unfit in ({"skeleton": amc}, {"row_rate_hz": 50}):
                with self.assertRaisesRegex(foretouch.InputError, next(iter(unfit))):
                    foretouch.Clip.load(Path(folder, "walk.bvh"), **unfit)

    def test_joints_match_by_name_or_map(self):
        match = self.clip.match(self.avatar)
        self.assertEqual((match.unmatched_avatar, match.unmatched_clip), ([], []))
        other = foretouch.Avatar.from_arrays(["root", "LeftHand"], [-1, 0], np.zeros((2, 3)), None,
                                             [[], [((0, 0, 0), (0, 0.1, 0), 0.03)]])
        match = self.clip.match(other)
        self.assertEqual(match.unmatched_avatar, ["root"])
        self.assertEqual(match.clip_joint_of[0], -1)
        self.assertEqual(len(match.unmatched_clip), 25)
        mapped = self.clip.match(other, joint_map={"root": "Hips"})
        self.assertEqual(mapped.unmatched_avatar, [])
        poses = self.clip.poses(other, joint_map={"root": "Hips"})
        np.testing.assert_array_equal(poses.translations[:, 0],
                                      self.clip.poses(self.avatar).translations[:, 0])


if __name__ == "__main__":
    unittest.main()

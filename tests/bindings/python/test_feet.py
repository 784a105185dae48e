"""Labels of feet as arrays: those of the program's own table, on the bundled clip and on one made here."""

import csv
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import foretouch
from support import PROGRAM

# A foot without legs: it stands for 0.5 s, then slides along x at 0.1 m/s.
SKELETON = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftFoot
  {
    OFFSET 0 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 0.2
    }
  }
}
MOTION
Frames: 101
Frame Time: 0.01
"""
AVATAR = """{"format":"foretouch-avatar","version":1,"links":[
{"name":"Hips","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0.5,0],"b":[0,1,0],"radius":0.1}]},
{"name":"LeftFoot","parent":"Hips","offset":[0,0,0],"lss":[{"a":[0,0.03,0],"b":[0,0.03,0.2],"radius":0.03}]}
]}"""


class FeetLabels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        rows = "".join(f"{0.1 * max(0.0, 0.01 * i - 0.5):.6f} 0.001 0 0 0 0 0 0 0\n" for i in range(101))
        self.clip, self.avatar = self.folder / "slide.bvh", self.folder / "foot.json"
        self.clip.write_text(SKELETON + rows)
        self.avatar.write_text(AVATAR)

    def test_a_planted_slide_has_its_speed_and_its_frames(self):
        labels = foretouch.feet_labels(self.clip, self.avatar)
        self.assertEqual(labels.part, ["heel", "ball"])
        self.assertEqual(labels.joint, ["LeftFoot", "LeftFoot"])
        self.assertEqual((labels.contact.shape, labels.contact.dtype), ((101, 2), np.dtype(bool)))
        self.assertTrue(labels.contact.all())
        np.testing.assert_array_equal(labels.frame, np.arange(101))
        np.testing.assert_allclose(labels.time, 0.01 * np.arange(101), atol=1e-12)
        np.testing.assert_allclose(labels.distance, 0.001, atol=1e-6)
        np.testing.assert_allclose(labels.slide[:50], 0, atol=1e-5)
        np.testing.assert_allclose(labels.slide[51:100], 0.1, atol=1e-4)
        self.assertFalse(labels.depth.any())

    def test_they_are_those_of_the_table(self):
        table = self.folder / "labels.csv"
        words = [PROGRAM, "feet", self.clip, self.avatar, "--rate", "50", "--labels", table, "--quiet"]
        subprocess.run(words, check=True, capture_output=True)
        labels = foretouch.feet_labels(self.clip, self.avatar, rate=50, options=["--tolerance", "0.005"])
        with table.open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), labels.contact.size)
        for i, row in enumerate(rows):
            pose, part = divmod(i, len(labels.part))
            self.assertEqual(int(row["frame"]), labels.frame[pose])
            self.assertEqual(row["part"], labels.part[part])
            self.assertEqual(row["contact"] == "1", labels.contact[pose, part])
            self.assertEqual(row["rule"] == "1", labels.rule[pose, part])
            self.assertAlmostEqual(float(row["slide_mps"]), float(labels.slide[pose, part]), places=5)

    def test_what_the_program_refuses_is_said(self):
        with self.assertRaisesRegex(foretouch.InputError, "gone.bvh: cannot be opened"):
            foretouch.feet_labels(self.folder / "gone.bvh")
        with self.assertRaisesRegex(foretouch.InputError, "--from: expected an instant"):
            foretouch.feet_labels(self.clip, self.avatar, options=["--from", "9"])


if __name__ == "__main__":
    unittest.main()

"""What the documents show works. The example runs on the bundled files, finds what it says, and writes only where it is told."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import foretouch
from support import SOURCE

EXAMPLE = SOURCE / "bindings" / "python" / "example" / "hand_through_railing.py"


class Example(unittest.TestCase):
    def run_in(self, folder, *arguments):
        return subprocess.run([sys.executable, EXAMPLE, *arguments], cwd=folder, check=True,
                              capture_output=True, text=True).stdout

    def test_finds_the_bars_that_poses_miss(self):
        with tempfile.TemporaryDirectory() as folder:
            text = self.run_in(folder)
            self.assertEqual(os.listdir(folder), [])
        self.assertIn("railing", text)
        self.assertRegex(text, r"poses alone would have missed [1-9]")

    def test_writes_the_swept_surface_where_it_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "out"
            self.run_in(folder, "--output", output)
            self.assertEqual(os.listdir(folder), ["out"])
            obj = (output / "hand.obj").read_text().splitlines()
            self.assertGreater(sum(line.startswith("f ") for line in obj), 100)

    def test_a_clip_is_played_and_what_cannot_be_read_is_said(self):
        program, folder = EXAMPLE.with_name("play_clip.py"), foretouch.example_folder()
        files = [folder / name for name in ["room.obj", "dancer.avatar.json", "dancer.bvh"]]
        done = subprocess.run([sys.executable, "-W", "error", program, *files, "6"], check=True,
                              capture_output=True, text=True)
        lines = done.stdout.splitlines()
        self.assertRegex(lines[0], r"^step \d+: \w+ meets \w+ at t = 0\.\d{4}$")
        self.assertEqual(lines[-1], f"{len(lines) - 1} contacts in 136 steps")
        failed = subprocess.run([sys.executable, program, "/no/such.obj", *files[1:]],
                                capture_output=True, text=True)
        self.assertEqual((failed.returncode, failed.stderr.count("\n")), (1, 1))
        self.assertIn("/no/such.obj: cannot open the file", failed.stderr)

    def test_the_guides_code_runs(self):
        guide = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
        code = "\n".join(re.findall(r"```python\n(.*?)```", guide, re.DOTALL))
        done = subprocess.run([sys.executable, "-W", "error", "-c", code], check=True,
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertRegex(done.stdout, "CONTACT")


if __name__ == "__main__":
    unittest.main()

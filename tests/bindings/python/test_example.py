"""What the documents show works. The example runs on the bundled files, finds what it says, and writes only where it is told."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import foretouch
from support import BUILD, SOURCE

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

    def test_an_arm_is_planned_on_proven_edges(self):
        link = ('<link name="{0}"><collision><origin xyz="0 0 0.15"/><geometry><capsule '
                'radius="0.03" length="0.3"/></geometry></collision></link>')
        turn = ('<joint name="{0}{1}" type="revolute"><parent link="{0}"/><child link="{1}"/>'
                '<origin xyz="0 0 0.3"/><axis xyz="{2}"/><limit lower="-2.5" upper="2.5" '
                'effort="1" velocity="1"/></joint>')
        urdf = ('<robot name="arm">' + "".join(map(link.format, "abcd"))
                + turn.format("a", "b", "0 1 0") + turn.format("b", "c", "1 0 0")
                + turn.format("c", "d", "0 1 0") + "</robot>")
        poles = "".join(f"v {x} {y} {z}\n" for x, y in ((0.4, 0.1), (-0.3, 0.3), (0.1, -0.5))
                        for z in (0, 2, 2.01)) + "f 1 2 3\nf 4 5 6\nf 7 8 9\n"
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "arm.urdf").write_text(urdf)
            (folder / "poles.obj").write_text(poles)
            done = subprocess.run([sys.executable, EXAMPLE.with_name("plan_arm.py"),
                                   folder / "arm.urdf", folder / "poles.obj", "1", folder / "why"],
                                  check=True, capture_output=True, text=True)
            found = re.fullmatch(r"a way of (\d+) edges, CLEAR; (\d+) were asked\n"
                                 r"(\d+) of them are proven\n", done.stdout)
            self.assertTrue(found, done.stdout)
            self.assertEqual(found[1], found[3])
            self.assertGreater(int(found[2]), int(found[1]))
            verified = subprocess.run(
                [BUILD / "bin" / "foretouch-verify",
                 *(folder / "why" / file for file in ("scene.obj", "avatar.json", "edges.txt",
                                                      "certificate.txt")), "--whole"],
                capture_output=True, text=True)
            self.assertEqual(verified.returncode, 0, verified.stdout)
            self.assertIn(f"proven: {found[1]} of {found[1]} edges keep more than 0.005",
                          verified.stdout)
        guide = (SOURCE / "docs" / "robots.md").read_text(encoding="utf-8")
        shown = re.search(r"```python\n(class MotionValidator.*?)```", guide, re.DOTALL)
        self.assertIn(shown[1], EXAMPLE.with_name("plan_arm.py").read_text(encoding="utf-8"))

    def test_the_guides_code_runs(self):
        guide = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
        code = "\n".join(re.findall(r"```python\n(.*?)```", guide, re.DOTALL))
        done = subprocess.run([sys.executable, "-W", "error", "-c", code], check=True,
                              capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertRegex(done.stdout, "CONTACT")


if __name__ == "__main__":
    unittest.main()

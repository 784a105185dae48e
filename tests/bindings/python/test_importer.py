"""Where foretouch-import is looked for: the argument, the environment, the installation."""

import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import foretouch
from support import BUILD

LOAD = """
import sys, foretouch
scene = foretouch.Scene.load(sys.argv[1], **eval(sys.argv[2]))
print(scene.num_triangles)
"""


class Importer(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.model = self.folder / "one.obj"
        self.model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.broken = self.folder / "broken"
        self.broken.write_text("#!/bin/sh\necho planted >&2\nexit 3\n")
        self.broken.chmod(self.broken.stat().st_mode | stat.S_IXUSR)

    def load(self, options="{}", **environment):
        inherited = {k: v for k, v in os.environ.items() if k != "FORETOUCH_IMPORTER"}
        return subprocess.run([sys.executable, "-c", LOAD, self.model, options],
                              env={**inherited, **environment}, capture_output=True, text=True)

    def test_is_found_in_the_build_tree(self):
        done = self.load()
        self.assertEqual((done.stdout, done.stderr), ("1\n", ""))

    def test_is_the_one_of_the_environment(self):
        self.assertIn("planted", self.load(FORETOUCH_IMPORTER=str(self.broken)).stderr)
        self.assertEqual(self.load(FORETOUCH_IMPORTER="").stdout, "1\n")

    def test_is_the_argument_before_all(self):
        importer = BUILD / "bin" / "foretouch-import"
        done = self.load(f"{{'importer': {str(importer)!r}}}", FORETOUCH_IMPORTER=str(self.broken))
        self.assertEqual(done.stdout, "1\n")
        with self.assertRaisesRegex(foretouch.Error, "planted"):
            foretouch.Scene.load(self.model, importer=self.broken)

    def test_is_missed_in_words(self):
        with self.assertRaisesRegex(foretouch.ResourceError,
                                    "expected the program foretouch-import at /no/such"):
            foretouch.Scene.load(self.model, importer="/no/such")


if __name__ == "__main__":
    unittest.main()

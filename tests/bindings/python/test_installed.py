"""An installed copy works by itself, wherever its prefix was moved to."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import BUILD

USE = """
import foretouch, numpy, pathlib, sys
assert pathlib.Path(foretouch.__file__).is_relative_to(sys.argv[1]), foretouch.__file__
folder = foretouch.example_folder()
assert folder.is_relative_to(sys.argv[1]), folder
avatar = foretouch.Avatar.load(folder / "dancer.avatar.json")
motion = foretouch.Motion(avatar, avatar.rest_pose(), avatar.rest_pose())
scene = foretouch.Scene.load(folder / "room.obj")
print(len(foretouch.first_contacts(avatar, motion, scene)))
"""


class Installed(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        installed = Path(scratch.name) / "first"
        subprocess.run([os.environ["FORETOUCH_CMAKE"], "--install", BUILD, "--component", "python",
                        "--prefix", installed], check=True, capture_output=True)
        # The parts that other components install.
        for source, place in [(BUILD / "bin" / "foretouch-import", "libexec/foretouch"),
                              (BUILD / "share" / "foretouch" / "examples", "share/foretouch")]:
            (installed / place).mkdir(parents=True)
            (installed / place / source.name).symlink_to(source)
        self.prefix = Path(scratch.name) / "moved"
        installed.rename(self.prefix)
        self.packages = self.prefix / "lib" / "python3" / "dist-packages"

    def test_answers_a_query(self):
        environment = {k: v for k, v in os.environ.items() if k != "FORETOUCH_IMPORTER"}
        environment["PYTHONPATH"] = str(self.packages)
        done = subprocess.run([sys.executable, "-c", USE, self.prefix], env=environment,
                              capture_output=True, text=True, cwd=self.prefix)
        self.assertEqual((done.stdout, done.stderr), ("26\n", ""))

    def test_has_every_file(self):
        package = self.packages / "foretouch"
        names = sorted(p.name for p in package.iterdir() if p.suffix != ".so")
        self.assertEqual(names, ["__init__.py", "_examples.py", "_feet.py", "_foretouch.pyi",
                                 "_notebook.py", "_queries.py", "_types.py", "py.typed"])
        self.assertEqual(len(list(package.glob("_foretouch*.so"))), 1)

    def test_shows_nothing_but_its_entry(self):
        module = next((self.packages / "foretouch").glob("_foretouch*.so"))
        shown = subprocess.run(["nm", "-D", "--defined-only", module], check=True,
                               capture_output=True, text=True).stdout
        ours = [line.split()[-1] for line in shown.splitlines() if "foretouch" in line]
        self.assertEqual(ours, ["PyInit__foretouch"])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""A picture of the add-on for Blender, in a virtual display: blender.py FOLDER. FORETOUCH_PACKAGES names the Python
packages. Says so where there is no Blender, and leaves the picture as it is."""
import pathlib
import shutil
import subprocess
import sys

from smaller_png import shrink

WIDTH, HEIGHT, MOST_BYTES = 1280, 800, 120_000
PART = (0, 0, 1056, 800)  # without the properties
SCRIPT = pathlib.Path(__file__).resolve().parent / "../../integrations/blender/example/picture.py"


def main(folder):
    if not shutil.which("blender") or not shutil.which("xvfb-run"):
        print("pictures: no blender or no xvfb-run: blender.png stays as it is", file=sys.stderr)
        return
    subprocess.run(["xvfb-run", "-a", "-s", f"-screen 0 {WIDTH}x{HEIGHT}x24", "blender", "--factory-startup",
                    "--enable-event-simulate", "--python", str(SCRIPT), "--", "blender.png"], check=True,
                   stdout=subprocess.DEVNULL, timeout=120)
    shrink("blender.png", MOST_BYTES, f"{folder}/blender.png", PART)


main(sys.argv[1])

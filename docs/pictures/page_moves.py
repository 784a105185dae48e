#!/usr/bin/env python3
"""Takes page-moves.png, the report of the demo while it plays in a browser: page_moves.py DEMO.html FOLDER."""
import os
import sys
import tempfile

from browser import PRESS, VIEW, Page
from moving_png import write_film

WIDTH, HEIGHT, MOST_BYTES = 480, 560, 120_000
FIRST, LAST, FRAMES = 5.20, 6.60, 20  # seconds of the dance: two turns beside the floor lamp
# One that the camera then looks at.
SELECT = """{
  const view = JSON.parse(document.getElementById('foretouch-view').textContent);
  const [avatar] = view.avatars;
  const order = [...avatar.contacts].sort((x, y) => x.time - y.time);
  foretouch.selectContact(order.findIndex(c => c.object === 'floor_lamp'));
}"""


def main(report, folder):
    with tempfile.TemporaryDirectory() as work, Page(WIDTH, HEIGHT) as page:
        page.open(report)
        page.run(SELECT)
        # Without the poses around, and the hole through what hides the body.
        for name in ("Ghosts", "Cut away"):
            page.run(PRESS % name)
        shots = [os.path.join(work, f"{i}.png") for i in range(FRAMES)]
        for i, shot in enumerate(shots):
            page.run(f"foretouch.seek({FIRST + (LAST - FIRST) * i / (FRAMES - 1)})")
            page.shoot(shot)
        write_film(shots, page.run(VIEW), os.path.join(folder, "page-moves.png"), 0.12, MOST_BYTES)


main(*sys.argv[1:3])

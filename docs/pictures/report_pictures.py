#!/usr/bin/env python3
"""Takes the pictures of reports: report_pictures.py DEMO.html LOOK.html WRONG.html FOLDER."""
import sys

from browser import PRESS, VIEW, Page
from smaller_png import shrink

WIDTH, HEIGHT, MOST_BYTES = 1200, 820, 120_000
# The left hand through the railing's bars, which neither pose shows.
SELECT = """{
  const view = JSON.parse(document.getElementById('foretouch-view').textContent);
  const [avatar] = view.avatars;
  const order = [...avatar.contacts].sort((x, y) => x.time - y.time);
  foretouch.selectContact(order.findIndex(c => c.missed_by_poses && c.object === 'railing_bars' &&
                                               avatar.links[c.link].name === 'LeftHand'));
}"""


def main(demo, look, wrong, folder):
    with Page(WIDTH, HEIGHT) as page:
        page.open(demo)
        page.run(SELECT)
        if not page.run("foretouch.state().showsSwept"):
            page.run(PRESS % "Swept volume")
        page.shoot(f"{folder}/report.png")
        view = tuple(page.run(VIEW))
        for path, name in ((look, "look.png"), (wrong, "look-wrong.png")):
            page.open(path)
            page.shoot(f"{folder}/{name}")
    shrink(f"{folder}/report.png", MOST_BYTES, f"{folder}/railing.png", view)
    for name in ("report.png", "look.png", "look-wrong.png"):
        shrink(f"{folder}/{name}", MOST_BYTES)


main(*sys.argv[1:5])

"""The pictures of docs/ that the package draws are what it answers today."""

import importlib
import re
import sys
import unittest

from support import SOURCE

FOLDER = SOURCE / "docs" / "pictures"
NUMBER = re.compile(r"-?\d+\.\d+")


def drawn(name):
    sys.path.insert(0, str(FOLDER))
    try:
        picture = importlib.import_module(name)
    finally:
        sys.path.remove(str(FOLDER))
    return picture.drawn().svg(), (FOLDER / picture.NAME).read_text(encoding="utf-8")


class Pictures(unittest.TestCase):
    def test_of_a_table_and_a_cup(self):
        self.expect_todays_answers("table_and_cup")

    def test_of_a_tick_of_a_solid_avatar(self):
        self.expect_todays_answers("solid_tick")

    def expect_todays_answers(self, name):
        """To the last digit: processors with other vectors may round another way."""
        today, kept = drawn(name)
        self.assertEqual(NUMBER.sub("#", today), NUMBER.sub("#", kept))
        for now, then in zip(NUMBER.findall(today), NUMBER.findall(kept)):
            self.assertEqual(len(now.split(".")[1]), len(then.split(".")[1]))
            last_digit = 10.0 ** -len(then.split(".")[1])
            self.assertLessEqual(abs(float(now) - float(then)), 1.1 * last_digit)


if __name__ == "__main__":
    unittest.main()

"""The picture of docs/ that the package draws is what it answers today."""

import re
import sys
import unittest

from support import SOURCE

FOLDER = SOURCE / "docs" / "pictures"
NUMBER = re.compile(r"-?\d+\.\d+")


def drawn():
    sys.path.insert(0, str(FOLDER))
    try:
        import table_and_cup
    finally:
        sys.path.remove(str(FOLDER))
    return table_and_cup.drawn().svg(), (FOLDER / table_and_cup.NAME).read_text(encoding="utf-8")


class TableAndCup(unittest.TestCase):
    def test_is_drawn_from_todays_answers(self):
        """To the last digit: processors with other vectors may round another way."""
        today, kept = drawn()
        self.assertEqual(NUMBER.sub("#", today), NUMBER.sub("#", kept))
        for now, then in zip(NUMBER.findall(today), NUMBER.findall(kept)):
            self.assertEqual(len(now.split(".")[1]), len(then.split(".")[1]))
            last_digit = 10.0 ** -len(then.split(".")[1])
            self.assertLessEqual(abs(float(now) - float(then)), 1.1 * last_digit)


if __name__ == "__main__":
    unittest.main()

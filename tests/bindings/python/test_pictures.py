"""The picture of docs/ that the package draws is what it answers today."""

import sys
import unittest

from support import SOURCE

FOLDER = SOURCE / "docs" / "pictures"


class TableAndCup(unittest.TestCase):
    def test_is_drawn_from_todays_answers(self):
        sys.path.insert(0, str(FOLDER))
        try:
            import table_and_cup
        finally:
            sys.path.remove(str(FOLDER))
        expected = (FOLDER / table_and_cup.NAME).read_text(encoding="utf-8")
        self.assertEqual(table_and_cup.drawn().svg(), expected)


if __name__ == "__main__":
    unittest.main()

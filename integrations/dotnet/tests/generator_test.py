"""What the generator does not know is an error that names file, line and what it found: nothing of a header
is left out unseen."""
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
HEADERS = PACKAGE.parent.parent / "bindings/c/include/foretouch"
sys.dont_write_bytecode = True
sys.path.insert(0, str(PACKAGE / "generator"))
from csharp import Writer  # noqa: E402
from headers import Function, Handle, Struct, Unknown, read_headers  # noqa: E402


class Generator(unittest.TestCase):
    def refused(self, *odd, header="events"):
        """What is said of a header that has `odd` before its last lines."""
        with tempfile.TemporaryDirectory() as folder:
            folder = shutil.copytree(HEADERS, Path(folder, "foretouch"))
            path = folder / (header + ".h")
            head, tail = path.read_text().rsplit("#ifdef __cplusplus", 1)
            path.write_text(head + "\n".join(odd) + "\n#ifdef __cplusplus" + tail)
            with self.assertRaises(Unknown) as refusal:
                headers = read_headers(folder)
                writer = Writer(headers)
                for one in headers:
                    writer.file(one)
            return str(refusal.exception)

    def test_a_declaration_of_another_shape_is_named_with_its_line(self):
        said = self.refused("typedef int (*ft_callback)(void);")
        line = (HEADERS / "events.h").read_text().rsplit("#ifdef __cplusplus", 1)[0].count("\n") + 1
        self.assertIn(f"events.h:{line}", said)
        self.assertIn("ft_callback", said)

    def test_fields_of_another_shape_are_named(self):
        self.assertIn("flags : 3", self.refused("typedef struct ft_odd {", "  int32_t flags : 3;", "} ft_odd;"))
        self.assertIn("ft_odd.word", self.refused("typedef struct ft_odd {", "  uint16_t word;", "} ft_odd;"))
        self.assertIn("ft_odd.five", self.refused("typedef struct ft_odd {", "  double five[5];", "} ft_odd;"))

    def test_functions_and_enums_of_another_shape_are_named(self):
        self.assertIn("ft_odd", self.refused("int32_t ft_odd(void);"))
        self.assertIn("FT_ODD", self.refused("enum { FT_ODD = 1 << 3, FT_EVEN = 2 };"))

    def test_a_header_that_is_new_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = shutil.copytree(HEADERS, Path(folder, "foretouch"))
            (folder / "ropes.h").write_text("")
            with self.assertRaises(Unknown) as refusal:
                read_headers(folder)
        self.assertIn("ropes", str(refusal.exception))

    def test_it_reads_all_that_the_headers_have(self):
        headers = read_headers(HEADERS)
        text = "".join(path.read_text() for path in HEADERS.glob("*.h"))
        self.assertEqual(sum(len(header.of(Function)) for header in headers), text.count("\nFT_API "))
        self.assertEqual(sum(len(header.of(Struct)) for header in headers), len(re.findall(r"\ntypedef struct \w+ {", text)))
        self.assertEqual(sum(len(header.of(Handle)) for header in headers), len(re.findall(r"\ntypedef struct \w+ \w+;", text)))


if __name__ == "__main__":
    unittest.main()

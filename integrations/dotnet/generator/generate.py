#!/usr/bin/env python3
"""The C library's headers as C#, and C for the tests of it. Needs Python's own library alone.
  generate.py csharp        writes Runtime/Native/*.cs of this package
  generate.py check         are these what the headers say? Exits with 1, and the difference, if not
  generate.py layout        prints a C program that prints how all structs lie in memory
  generate.py dump          prints a C header that prints the fields of every struct without pointers"""
import difflib
import sys
from pathlib import Path

sys.dont_write_bytecode = True
from c_tests import dump_header, layout_program  # noqa: E402
from csharp import Writer  # noqa: E402
from headers import Unknown, read_headers  # noqa: E402

PACKAGE = Path(__file__).resolve().parent.parent
HEADERS = PACKAGE.parent.parent / "bindings" / "c" / "include" / "foretouch"
OUTPUT = PACKAGE / "Runtime" / "Native"


def files(headers):
    writer = Writer(headers)
    return {"Ft" + "".join(part.capitalize() for part in header.name.split("_")) + ".cs": writer.file(header)
            for header in headers}


def check(wanted):
    stale = sorted({path.name for path in OUTPUT.glob("*.cs")} ^ set(wanted))
    for name, text in wanted.items():
        found = (OUTPUT / name).read_text() if (OUTPUT / name).exists() else ""
        if found != text:
            stale.append(name)
            sys.stdout.writelines(difflib.unified_diff(found.splitlines(True), text.splitlines(True),
                                                       f"Runtime/Native/{name}", "of the headers"))
    if stale:
        print(f"not what the headers say: {', '.join(stale)}. Write them anew: generate.py csharp")
    return 1 if stale else 0


def main(task):
    headers = read_headers(HEADERS)
    if task == "layout":
        print(layout_program(headers), end="")
    elif task == "dump":
        print(dump_header(headers), end="")
    elif task == "check":
        return check(files(headers))
    else:
        OUTPUT.mkdir(parents=True, exist_ok=True)
        for name, text in files(headers).items():
            (OUTPUT / name).write_text(text)
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in ("csharp", "check", "layout", "dump"):
        sys.exit(__doc__)
    try:
        sys.exit(main(sys.argv[1]))
    except Unknown as reason:
        sys.exit(f"generate.py: {reason}")

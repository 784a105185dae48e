"""The program foretouch, as the wheel brings it: `foretouch ...` or `python3 -m foretouch ...`."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    program = Path(__file__).resolve().parent / "_installed" / "bin" / "foretouch"
    os.execv(program, [str(program), *sys.argv[1:]])

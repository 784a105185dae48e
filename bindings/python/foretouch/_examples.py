"""The place of the bundled example."""

from __future__ import annotations

import os
from pathlib import Path

from foretouch._foretouch import ResourceError


def example_folder() -> Path:
    """The folder of room.obj, dancer.bvh and dancer.avatar.json: $FORETOUCH_EXAMPLES, or its place
    in this package's installation, wheel or build tree."""
    named = os.environ.get("FORETOUCH_EXAMPLES")
    package = Path(__file__).resolve().parent
    # A wheel has an installation inside; else this file is
    # PREFIX/lib/python3/dist-packages/foretouch/_examples.py.
    inside = package / "_installed"
    prefix = inside if inside.is_dir() else (package / "../../../..").resolve()
    folder = Path(named) if named else prefix / "share" / "foretouch" / "examples"
    if (folder / "room.obj").is_file():
        return folder
    raise ResourceError(
        f"{folder}: holds no room.obj; expected the bundled example there, or its folder in the "
        "environment variable FORETOUCH_EXAMPLES"
    )

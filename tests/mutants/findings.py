"""What ./run mutants and ./run coverage have in common: the kernel's test programs, where they find their
data, findings that a person has looked at, and a table by folder."""
import json
import os
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# The kernel's test programs.
KERNEL = ["lss_tests", "articulated_tests", "tessellation_tests", "middleware_tests", "scene_tests", "near_tests",
          "solid_parts_tests", "world_tests", "event_tests", "trigger_tests", "bracket_tests", "depth_tests",
          "ask_tests", "edge_tests", "solid_tests"]


def test_environment():
    return {**os.environ, "GTEST_BRIEF": "1",
            "FORETOUCH_DATA": os.environ.get("FORETOUCH_DATA", str(ROOT.parent / "shared/data"))}


def judged(path):
    """The findings that a list names; below each, indented, stands its reason."""
    lines = (ROOT / path).read_text().splitlines()
    return {line for line in lines if line and not line.startswith(("#", " "))}


def show(columns, rows):
    for row in [columns, dict.fromkeys(columns, "---"), *rows]:
        print("| " + " | ".join(str(value) for value in row.values()) + " |")


def record(name, title, table, columns, rows):
    """As docs/measurements/NAME.json; `table`: its name and its title."""
    figures = {
        "format": "foretouch-figures", "version": 1, "title": title,
        "tables": [{"name": table[0], "title": table[1], "command": f"./run {name}",
                    "date": time.strftime("%Y-%m-%d"),
                    "columns": [{"key": key, "title": title} for key, title in columns.items()], "rows": rows}]}
    (ROOT / f"docs/measurements/{name}.json").write_text(json.dumps(figures, indent=1) + "\n")

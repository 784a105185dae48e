#!/usr/bin/env python3
"""What does no test come by? Builds the kernel and what reads a stranger's bytes so that it counts
(the preset `coverage`), runs their tests, and says per folder which share of lines and of branches
was taken. Lists the lines that none came by and that uncovered.txt does not name with a reason.

  coverage.py [--folders F,...] [--programs P,...] [--again] [--record] [--branches FOLDER]

--again reads the counts of the last run; --branches lists the lines of a folder of which only some
branches were taken; --record keeps the table in docs/measurements."""
import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict

from findings import KERNEL, ROOT, judged, record, show, test_environment

BUILD = ROOT / "build/coverage"
COUNTS = BUILD / "counts.json"

PROGRAMS = [*KERNEL, "mechanics_tests", "solid_sample_tests", "solid_world_tests", "allocation_tests", "verify_tests",
            "assets_tests", "import_tests", "model_import_tests", "mjcf_tests", "motion_format_tests", "smpl_tests",
            "wire_tests", "vmc_tests", "network_tests", "world_service_tests", "served_memory_tests", "fuzz_corpus_tests", "fuzz_vmc_tests", "bindings_tests", "bindings_events_tests",
            "bindings_memory_tests"]
# These need a network of their own.
NETWORKED = {"wire_tests"}
# The kernel, and what reads a stranger's bytes.
FOLDERS = ["lss", "articulated", "tessellation", "middleware", "assets", "network/wire", "network/log",
           "network/vmc", "verify"]


def run_tests(programs, folders):
    have = [program for program in programs if target_exists(program)]
    subprocess.run(["cmake", "--build", BUILD, "--target", *have], check=True)
    for counts in BUILD.rglob("*.gcda"):
        counts.unlink()
    for program in have:
        print(f"coverage: {program}", file=sys.stderr, flush=True)
        apart = [ROOT / "tests/network/in_namespace.sh"] if program in NETWORKED else []
        done = subprocess.run([*apart, BUILD / "bin" / program], env=test_environment())
        if done.returncode != 0:
            sys.exit(f"coverage: {program} fails; expected tests that pass")
    subprocess.run(["gcovr", "--root", ROOT, "--object-directory", BUILD, "--json", COUNTS,
                    "--exclude-throw-branches", "--exclude-unreachable-branches", "-j", str(os.cpu_count()),
                    *[f"--filter={ROOT / folder}/" for folder in folders]], check=True)


def target_exists(program):
    listed = subprocess.run(["ninja", "-C", BUILD, "-t", "query", f"bin/{program}"], capture_output=True)
    return listed.returncode == 0


def room_of(path):
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] in ("middleware", "assets", "network") and len(parts) > 2 else parts[0]


def lines_of(counts):
    """Per line of code: (path, number, text, whether it ran, branches, branches that were taken)."""
    for file in counts["files"]:
        text = (ROOT / file["file"]).read_text().splitlines()
        for line in file["lines"]:
            if line.get("gcovr/noncode"):
                continue
            branches = [branch for branch in line["branches"] if not branch["throw"]]
            yield (file["file"], line["line_number"], text[line["line_number"] - 1].strip(), line["count"] > 0,
                   len(branches), sum(branch["count"] > 0 for branch in branches))


COLUMNS = {"folder": "folder", "lines": "lines", "line_percent": "run, %", "branches": "branches",
           "branch_percent": "taken, %", "named": "lines named"}


def rows_of(lines, known):
    sums = defaultdict(lambda: [0, 0, 0, 0, 0])
    for path, _, text, ran, branches, taken in lines:
        row = sums[room_of(path)]
        for i, value in enumerate([1, ran, branches, taken, not ran and f"{path}: {text}" in known]):
            row[i] += value
    for folder, (all_lines, ran, branches, taken, named) in sorted(sums.items()):
        yield dict(zip(COLUMNS, [folder, all_lines, round(100 * ran / all_lines, 1), branches,
                                 round(100 * taken / max(branches, 1), 1), named]))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--folders", default=",".join(FOLDERS))
    arguments.add_argument("--programs", default=",".join(PROGRAMS), help="these test programs alone")
    arguments.add_argument("--again", action="store_true", help="the counts of the last run")
    arguments.add_argument("--branches", metavar="FOLDER", help="lines of which only some branches were taken")
    arguments.add_argument("--record", action="store_true", help="the table into docs/measurements")
    given = arguments.parse_args()
    if not given.again:
        run_tests(given.programs.split(","), given.folders.split(","))
    lines = sorted(lines_of(json.loads(COUNTS.read_text())))
    known = judged("tests/mutants/uncovered.txt")
    rows = list(rows_of(lines, known))
    show(COLUMNS, rows)
    if given.record:
        record("coverage", "Coverage", ("lines", "What tests come by"), COLUMNS, rows)
    left = 0
    for path, number, text, ran, branches, taken in lines:
        if not ran and f"{path}: {text}" not in known:
            print(f"{path}:{number}: {text}")
            left += 1
        elif ran and given.branches and path.startswith(given.branches) and taken < branches:
            print(f"{path}:{number}: {taken} of {branches}: {text}")
    sys.exit(1 if left else 0)


if __name__ == "__main__":
    main()

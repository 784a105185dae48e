#!/usr/bin/env python3
"""Do the tests notice? Draws small wrong changes of the kernel (operators.py), builds each one and
runs the tests that cover its file, nearest first: what no test notices is listed, to be judged.

  mutants.py [--count N] [--seed S] [--folders lss,articulated,...] [--from K] [--out FILE]
  mutants.py --again | --table [--out FILE] [--record]

The tree is a clean copy of HEAD in build/mutants; nothing of the working tree changes. FILE gets a
line of JSON per mutant; a run with --from goes on there, one with --again tries those that
survived anew, by the tests as they are now; --record keeps the table in docs/measurements. judged.txt lists survivors that a person
has looked at, with the reason why no test can notice them."""
import argparse
import json
import os
import random
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from operators import mutants_of

ROOT = Path(__file__).resolve().parents[2]
PLACE = ROOT / "build/mutants"
SOURCE, BUILD = PLACE / "source", PLACE / "build"

# A folder: the programs whose tests cover it, nearest first.
FOLDERS = {
    "lss": ["lss_tests", "tessellation_tests", "articulated_tests"],
    "articulated": ["articulated_tests", "tessellation_tests"],
    "tessellation": ["tessellation_tests"],
    "verify": ["verify_tests"],
    "middleware": ["middleware_tests", "scene_tests", "near_tests", "solid_parts_tests", "world_tests",
                   "event_tests", "trigger_tests", "bracket_tests", "depth_tests", "ask_tests", "edge_tests",
                   "solid_tests"],
}
# Of a room of middleware/: what covers it best comes first.
ROOMS = {
    "scene": "scene_tests", "near": "near_tests", "solid": "solid_parts_tests", "world": "world_tests",
    "events": "event_tests", "triggers": "trigger_tests", "bracket": "bracket_tests", "depth": "depth_tests",
    "ask": "ask_tests", "edges": "edge_tests",
}


def programs_for(path):
    parts = path.split("/")
    programs = FOLDERS[parts[0]]
    first = ROOMS.get(parts[1]) if parts[0] == "middleware" and len(parts) > 2 else None
    return [first] + [p for p in programs if p != first] if first else programs


def run(command, seconds=None, **more):
    try:
        return subprocess.run(command, timeout=seconds, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace", **more)
    except subprocess.TimeoutExpired:
        return None


def prepare(folders):
    if SOURCE.exists():
        subprocess.run(["git", "-C", SOURCE, "checkout", "-q", "--detach", "-f",
                        run(["git", "-C", ROOT, "rev-parse", "HEAD"]).stdout.strip()], check=True)
    else:
        PLACE.mkdir(parents=True, exist_ok=True)
        subprocess.run(["git", "-C", ROOT, "worktree", "prune"], check=True)
        subprocess.run(["git", "-C", ROOT, "worktree", "add", "-q", "--detach", SOURCE, "HEAD"], check=True)
    # A source by itself, compiled in little time: what counts is what it computes.
    configured = run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                      "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DFORETOUCH_UNITY=OFF", "-DFORETOUCH_WERROR=OFF",
                      "-DFORETOUCH_TESTS=ON", "-DFORETOUCH_BENCH=ON", "-DFORETOUCH_PYTHON=OFF"] +
                     (["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if run(["sh", "-c", "command -v ccache"]).stdout else []))
    if configured.returncode != 0:
        sys.exit(configured.stdout)
    programs = sorted({p for folder in folders for p in FOLDERS[folder]})
    built = run(["ninja", "-C", BUILD, *[f"bin/{p}" for p in programs]])
    if built.returncode != 0:
        sys.exit(built.stdout[-4000:])
    usual = {}
    for program in programs:
        begin = time.monotonic()
        if run([BUILD / "bin" / program], env=test_environment()).returncode != 0:
            sys.exit(f"mutants: {program} fails as it stands; expected tests that pass")
        usual[program] = time.monotonic() - begin
        print(f"{program}: {usual[program]:.0f} s", file=sys.stderr)
    return usual


def test_environment():
    return {**os.environ, "GTEST_FAIL_FAST": "1", "GTEST_BRIEF": "1",
            "FORETOUCH_DATA": os.environ.get("FORETOUCH_DATA", str(ROOT.parent / "shared/data"))}


def fate_of(mutant, usual):
    """'killed by PROGRAM', 'survived', or 'no program': it does not compile."""
    path = SOURCE / mutant.path
    source = path.read_text()
    path.write_text(mutant.applied(source))
    try:
        for program in programs_for(mutant.path):
            built = run(["ninja", "-C", BUILD, f"bin/{program}"], 1200)
            if built is None or built.returncode != 0:
                return "no program"
            tested = run([BUILD / "bin" / program], 60 + 10 * usual[program], env=test_environment())
            if tested is None or tested.returncode != 0:
                return f"killed by {program}"
        return "survived"
    finally:
        path.write_text(source)


def mutants_in(folder):
    for path in sorted((SOURCE / folder).rglob("*")):
        if path.suffix in (".cpp", ".h"):
            yield from mutants_of(str(path.relative_to(SOURCE)), path.read_text())


def drawn(folders, seed):
    """All mutants in an order of chance, each folder as often as the others."""
    chance = random.Random(seed)
    lists = []
    for folder in folders:
        found = list(mutants_in(folder))
        chance.shuffle(found)
        lists.append(found)
    for same_place in zip(*lists):
        yield from same_place


def survivors(results):
    """Those of `results` that survived, in the sources as they are now."""
    keys = {result["key"] for result in results.values() if result["fate"] == "survived"}
    for folder in sorted({result["path"].split("/")[0] for result in results.values()}):
        yield from (mutant for mutant in mutants_in(folder) if mutant.key in keys)


def read_results(path):
    """The last word on each mutant."""
    if not path.exists():
        return {}
    return {result["key"]: result for result in map(json.loads, path.read_text().splitlines())}


def judged():
    lines = (ROOT / "tests/mutants/judged.txt").read_text().splitlines()
    return {line for line in lines if line and not line.startswith(("#", " "))}


COLUMNS = {"folder": "folder", "mutants": "mutants", "killed": "killed", "equivalent": "equivalent",
           "survived": "survived"}


def rows_of(results, equivalent):
    folders = Counter()
    for result in results:
        folder = result["path"].split("/")[0]
        fate = result["fate"].split(" by ")[0]
        if fate == "survived" and result["key"] in equivalent:
            fate = "equivalent"
        folders[folder, fate] += 1
    for folder in sorted({folder for folder, _ in folders}):
        counts = [folders[folder, fate] for fate in ("killed", "equivalent", "survived")]
        yield dict(zip(COLUMNS, [folder, sum(counts), *counts]))


def record(rows):
    figures = {
        "format": "foretouch-figures", "version": 1, "title": "Mutants",
        "tables": [{"name": "kernel", "title": "What tests notice", "command": "./run mutants",
                    "date": time.strftime("%Y-%m-%d"),
                    "columns": [{"key": key, "title": title} for key, title in COLUMNS.items()],
                    "rows": rows}]}
    path = ROOT / "docs/measurements/mutants.json"
    path.write_text(json.dumps(figures, indent=1) + "\n")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--count", type=int, default=40, help="mutants that compile")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--folders", default="lss,articulated,tessellation,verify")
    arguments.add_argument("--from", type=int, default=0, dest="first", help="passes over so many of the draw")
    arguments.add_argument("--out", type=Path, default=PLACE / "mutants.jsonl")
    arguments.add_argument("--again", action="store_true", help="tries those of FILE that survived")
    arguments.add_argument("--record", action="store_true", help="the table into docs/measurements")
    arguments.add_argument("--table", action="store_true", help="only the table of what FILE holds")
    given = arguments.parse_args()
    folders = given.folders.split(",")
    if unknown := [folder for folder in folders if folder not in FOLDERS]:
        sys.exit(f"mutants: --folders: expected some of {', '.join(FOLDERS)}, found '{unknown[0]}'")
    if not given.table:
        usual = prepare(folders)
        done = 0
        chosen = list(survivors(read_results(given.out))) if given.again else drawn(folders, given.seed)
        with given.out.open("a") as out:
            for place, mutant in enumerate(chosen):
                if place < given.first:
                    continue
                if done == given.count:
                    break
                fate = fate_of(mutant, usual)
                if fate == "no program":
                    continue
                done += 1
                out.write(json.dumps({"seed": given.seed, "place": place, "path": mutant.path, "line": mutant.line,
                                      "operator": mutant.operator, "key": mutant.key, "fate": fate}) + "\n")
                out.flush()
                print(f"{done}/{given.count} {fate}: {mutant.name}", file=sys.stderr, flush=True)
    results = read_results(given.out)
    equivalent = judged()
    rows = list(rows_of(results.values(), equivalent))
    for row in [COLUMNS, dict.fromkeys(COLUMNS, "---"), *rows]:
        print("| " + " | ".join(str(value) for value in row.values()) + " |")
    if given.record:
        record(rows)
    for result in results.values():
        if result["fate"] == "survived" and result["key"] not in equivalent:
            print(f"survived: {result['key']} (line {result['line']}, {result['operator']})")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Do the tests notice? Draws small wrong changes of the kernel (operators.py), compiles them into one
tree (switches.py) in which one at a time can be on, asks which test comes by which of them, and runs
these, quickest first: what none notices is listed, to be judged.

  mutants.py [--count N] [--seed S] [--folders lss,articulated,...] [--patience S] [--out FILE]
  mutants.py --again | --table [--out FILE] [--record]

The tree is a copy of HEAD in build/mutants; nothing of the working tree changes. FILE gets a line of
JSON per mutant; one that it has already is passed over, also one that cannot be compiled in. --again
tries those that survived anew, by the tests as they are now, but for those that judged.txt lists: a
person has looked at them, and says why no test can notice them. --record keeps the table in
docs/measurements."""
import argparse
import json
import os
import random
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from findings import KERNEL, ROOT, judged, record, show, test_environment
from operators import code_of, mutants_of
from switches import with_switches

PLACE = ROOT / "build/mutants"
SOURCE, BUILD = PLACE / "source", PLACE / "build"

# A folder: the programs whose tests cover it, nearest first.
FOLDERS = {
    "lss": KERNEL,
    "articulated": ["articulated_tests", *(p for p in KERNEL if p != "articulated_tests")],
    "tessellation": ["tessellation_tests", *(p for p in KERNEL if p != "tessellation_tests")],
    "middleware": KERNEL[3:],
    "verify": ["verify_tests"],
}
# Of a room of middleware/: what covers it best comes first.
ROOMS = {
    "scene": "scene_tests", "near": "near_tests", "solid": "solid_parts_tests", "world": "world_tests",
    "events": "event_tests", "triggers": "trigger_tests", "bracket": "bracket_tests", "depth": "depth_tests",
    "ask": "ask_tests", "edges": "edge_tests", "mechanics": "mechanics_tests", "solid_world": "solid_world_tests",
}


def programs_for(path, asked):
    parts = path.split("/")
    programs = FOLDERS[parts[0]]
    first = ROOMS.get(parts[1]) if parts[0] == "middleware" and len(parts) > 2 else None
    programs = [first] + [p for p in programs if p != first] if first else programs
    return [p for p in programs if not asked or p in asked]


ALIVE = ("survived", "unreached")


def run(command, seconds=None, **more):
    try:
        return subprocess.run(command, timeout=seconds, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace", **more)
    except subprocess.TimeoutExpired:
        return None


def check_out():
    head = run(["git", "-C", ROOT, "rev-parse", "HEAD"]).stdout.strip()
    if SOURCE.exists():
        subprocess.run(["git", "-C", SOURCE, "checkout", "-q", "--detach", "-f", head], check=True)
    else:
        PLACE.mkdir(parents=True, exist_ok=True)
        subprocess.run(["git", "-C", ROOT, "worktree", "prune"], check=True)
        subprocess.run(["git", "-C", ROOT, "worktree", "add", "-q", "--detach", SOURCE, "HEAD"], check=True)


def configure():
    """Compiled in little time: what counts is what it computes."""
    here = Path(__file__).parent
    configured = run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                      f"-DCMAKE_CXX_FLAGS=-include {here / 'switch.h'}", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                      f"-DFORETOUCH_BESIDE_TESTS={here / 'reach.cpp'}", "-DFORETOUCH_WERROR=OFF",
                      "-DFORETOUCH_TESTS=ON", "-DFORETOUCH_BENCH=ON", "-DFORETOUCH_PYTHON=OFF"])
    if configured.returncode != 0:
        sys.exit(configured.stdout)


def write_switches(mutants, paths):
    """Writes all of them into these sources; returns the numbers of those that they hold."""
    inside = set()
    for path in sorted(paths):
        source = run(["git", "-C", SOURCE, "show", f"HEAD:{path}"]).stdout
        own = {k: mutant for k, mutant in mutants.items() if mutant.path == path}
        text, held = with_switches(source, own, code_of)
        place = SOURCE / path
        if place.read_text() != text:
            place.write_text(text)
        inside |= held
    return inside


ERROR = re.compile(r"([\w/.-]+):(\d+):\d+:")


def build(mutants, programs):
    """Compiles them, without those that the compiler does not take; returns what is left."""
    paths = {mutant.path for mutant in mutants.values()}
    for _ in range(12):
        inside = write_switches(mutants, paths)
        mutants = {k: mutant for k, mutant in mutants.items() if k in inside}
        built = run(["ninja", "-k", "0", "-C", BUILD, *[f"bin/{p}" for p in programs]])
        if built.returncode == 0:
            return mutants
        wrong = set()
        for line in built.stdout.splitlines():
            for found in ERROR.finditer(line):
                # The compiler names them from where it runs.
                wrong.add((os.path.relpath(BUILD / found[1], SOURCE), int(found[2])))
        # A statement over several lines is written on its first one.
        for ahead in (0, 12):  # what a statement breaks is further down, where nothing is wrong itself
            left = {k: mutant for k, mutant in mutants.items()
                    if not any((mutant.path, mutant.line - back) in wrong for back in range(-ahead, 12))}
            if len(left) < len(mutants):
                break
        print(f"mutants: {len(mutants) - len(left)} are none to the compiler", file=sys.stderr)
        if len(left) == len(mutants):
            sys.exit(built.stdout[-6000:])
        mutants = left
    sys.exit("mutants: expected sources that compile after twelve tries")


def reach_of(program):
    """Per mutant, the tests that come by it: (milliseconds, name). And all tests, by name."""
    path = PLACE / f"{program}.reach"
    done = run([BUILD / "bin" / program], env={**test_environment(), "GTEST_FAIL_FAST": "1", "FORETOUCH_REACHED": str(path)})
    if done.returncode != 0:
        sys.exit(f"mutants: {program} fails as it stands; expected tests that pass\n{done.stdout[-2000:]}")
    reached, always, tests = {}, [], []
    for line in path.read_text().splitlines():
        name, milliseconds, numbers = line.split("\t")
        numbers = [int(k) for k in numbers.split()]
        if not name:
            always = numbers
            continue
        tests.append((int(milliseconds), name))
        for k in numbers:
            reached.setdefault(k, []).append((int(milliseconds), name))
    print(f"{program}: {len(reached)} mutants reached", file=sys.stderr, flush=True)
    for k in always:  # constants
        reached[k] = tests
    return {k: sorted(found) for k, found in reached.items()}


def fate_of(k, reach, patience):
    """'killed by PROGRAM', 'survived', or 'unreached': no test comes by it."""
    left = 1000.0 * patience
    is_reached = False
    # What is made once is reached by the first test that needs it, and used by all others.
    for program, reached in reach.items():
        if not 0 < len(reached.get(k, [])) <= 2:
            continue
        done = run([BUILD / "bin" / program], 60 + 10 * patience,
                   env={**test_environment(), "GTEST_FAIL_FAST": "1", "FORETOUCH_MUTANT": str(k)})
        if done is None or done.returncode != 0:
            return f"killed by {program}"
    for program, reached in reach.items():
        tests = reached.get(k, [])
        is_reached = is_reached or bool(tests)
        for chunk in (tests[:6], tests[6:60], tests[60:400], tests[400:]):
            while chunk and sum(time for time, _ in chunk) > left:
                chunk = chunk[:-1]
            if not chunk:
                continue
            usual = sum(time for time, _ in chunk)
            left -= usual
            names = ":".join(name for _, name in chunk)
            tested = run([BUILD / "bin" / program], 20 + 10e-3 * usual,
                         env={**test_environment(), "GTEST_FAIL_FAST": "1", "FORETOUCH_MUTANT": str(k), "GTEST_FILTER": names})
            if tested is None or tested.returncode != 0:
                return f"killed by {program}"
    return "survived" if is_reached else "unreached"


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
    keys = {result["key"] for result in results.values() if result["fate"] in ALIVE}
    for folder in sorted({result["path"].split("/")[0] for result in results.values()}):
        yield from (mutant for mutant in mutants_in(folder) if mutant.key in keys)


def read_results(path):
    """The last word on each mutant."""
    if not path.exists():
        return {}
    return {result["key"]: result for result in map(json.loads, path.read_text().splitlines())}


COLUMNS = {"folder": "folder", "mutants": "mutants", "killed": "killed", "equivalent": "equivalent",
           "survived": "survived"}


def rows_of(results, equivalent):
    folders = Counter()
    for result in results:
        folder = result["path"].split("/")[0]
        fate = result["fate"].split(" by ")[0]
        if result["fate"] in ALIVE:
            fate = "equivalent" if result["key"] in equivalent else "survived"
        folders[folder, fate] += 1
    for folder in sorted({folder for folder, _ in folders}):
        counts = [folders[folder, fate] for fate in ("killed", "equivalent", "survived")]
        yield dict(zip(COLUMNS, [folder, sum(counts), *counts]))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--count", type=int, default=40, help="mutants drawn; those that cannot be compiled in are left out")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--folders", default=",".join(FOLDERS))
    arguments.add_argument("--programs", default="", help="these test programs alone")
    arguments.add_argument("--jobs", type=int, default=os.cpu_count(), help="tests that run at a time")
    arguments.add_argument("--patience", type=float, default=120, help="seconds of tests per mutant, at most")
    arguments.add_argument("--out", type=Path, default=PLACE / "mutants.jsonl")
    arguments.add_argument("--again", action="store_true", help="tries those of FILE that survived")
    arguments.add_argument("--record", action="store_true", help="the table into docs/measurements")
    arguments.add_argument("--table", action="store_true", help="only the table of what FILE holds")
    given = arguments.parse_args()
    folders = given.folders.split(",")
    if unknown := [folder for folder in folders if folder not in FOLDERS]:
        sys.exit(f"mutants: --folders: expected some of {', '.join(FOLDERS)}, found '{unknown[0]}'")
    equivalent = judged("tests/mutants/judged.txt")
    if not given.table:
        check_out()
        old = read_results(given.out)
        if given.again:
            chosen = [mutant for mutant in survivors(old) if mutant.key not in equivalent]
        else:
            chosen = [mutant for mutant in drawn(folders, given.seed) if mutant.key not in old][:given.count]
        configure()
        programs_of = {mutant.path: programs_for(mutant.path, given.programs.split(",") if given.programs else [])
                       for mutant in chosen}
        programs = sorted({p for some in programs_of.values() for p in some})
        mutants = build(dict(enumerate(chosen)), programs)
        with ThreadPoolExecutor(given.jobs) as pool, given.out.open("a") as out:
            def tell(mutant, fate):
                out.write(json.dumps({"seed": given.seed, "path": mutant.path, "line": mutant.line,
                                      "operator": mutant.operator, "key": mutant.key, "fate": fate}) + "\n")
                out.flush()

            for k, mutant in enumerate(chosen):
                if k not in mutants:
                    tell(mutant, "left out")
            reach = dict(zip(programs, pool.map(reach_of, programs)))
            fates = {pool.submit(fate_of, k, {p: reach[p] for p in programs_of[mutant.path]}, given.patience): mutant
                     for k, mutant in mutants.items()}
            for done, found in enumerate(as_completed(fates), 1):
                mutant, fate = fates[found], found.result()
                tell(mutant, fate)
                print(f"{done}/{len(mutants)} {fate}: {mutant.name}", file=sys.stderr, flush=True)
    results = read_results(given.out)
    rows = list(rows_of(results.values(), equivalent))
    show(COLUMNS, rows)
    if given.record:
        record("mutants", "Mutants", ("kernel", "What tests notice"), COLUMNS, rows)
    for result in results.values():
        if result["fate"] in ALIVE and result["key"] not in equivalent:
            print(f"{result['fate']}: {result['key']} (line {result['line']}, {result['operator']})")


if __name__ == "__main__":
    main()

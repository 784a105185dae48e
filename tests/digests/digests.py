#!/usr/bin/env python3
"""Runs the program over a list of cases and compares a digest of each output with the recorded one:
what must not change is seen to have stayed the same, byte for byte.

    ./run digests                     every case; those whose data or tools are absent are skipped
    ./run digests --only 'clip/*'     some of them
    ./run digests --keep /tmp/old     and keeps the outputs, as they are compared
    ./run digests --against /tmp/old  and says where an output that differs does so first
    ./run digests --record            records what is made now, after each case gave the same twice

The cases are in bundled.py and recordings.py; what may differ, and is masked, in normalise.py.
Answers follow from the processor too (the width of its vectors, its approximate reciprocals, the C
library's mathematics), so recorded.json says on what it was recorded. On another one nothing is
compared: exit code 77.
Exit code 0: all as recorded; 1: something differs; 2: a case could not be run.
"""
import argparse
import fnmatch
import json
import os
import platform
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True

import bundled  # noqa: E402
import normalise  # noqa: E402
import recordings  # noqa: E402
import running  # noqa: E402

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
RECORDED = HERE / "recorded.json"
SKIPPED = 77


# The widest vectors as foretouch names them, and what a processor must have for them.
VECTORS = (
    ("avx512", {"avx512f", "avx512vl", "avx512dq", "avx512bw", "avx512cd"}),
    ("avx2", {"avx2", "fma", "bmi1", "bmi2", "abm", "f16c"}),
    ("sse4", {"sse4_2", "aes", "pclmulqdq"}),
    ("ssse3", {"ssse3"}),
    ("scalar", set()),
)


def machine():
    """What answers follow from besides the inputs."""
    facts = {}
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            key, _, value = line.partition(":")
            facts.setdefault(key.strip(), value.strip())
    flags = set(facts.get("flags", "").split())
    widest = next(name for name, needed in VECTORS if needed <= flags)
    return {"vectors": widest, "processor": facts.get("vendor_id", platform.machine()),
            "library": os.confstr("CS_GNU_LIBC_VERSION")}


def arguments():
    parser = argparse.ArgumentParser(description="Compare digests of outputs with recorded ones.")
    parser.add_argument("--record", action="store_true", help="record what is made now")
    parser.add_argument("--only", metavar="NAME", help="cases with this name, which may have a *")
    parser.add_argument("--short", action="store_true", help="the bundled example alone, briefly")
    parser.add_argument("--program", metavar="FOLDER", type=Path, default=SOURCE / "build/release",
                        help="what is run: a build folder, with bin/foretouch in it")
    parser.add_argument("--keep", metavar="DIR", type=Path, help="keep normalised outputs there")
    parser.add_argument("--against", metavar="DIR", type=Path,
                        help="kept outputs, to say where one that differs does so first")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(),
                        help="cases run at a time")
    return parser.parse_args()


def chosen_cases(options, world):
    """Those asked for, and why others of them cannot be run."""
    chosen, skipped = [], {}
    for case in (*bundled.every_case(), *recordings.every_case()):
        named = options.only is None or fnmatch.fnmatch(case.name, options.only)
        if not named or (options.short and not case.short):
            continue
        lacks = world.lacks(case)
        if lacks:
            skipped[case.name] = lacks
        else:
            chosen.append(case)
    return chosen, skipped


def outputs_of(case, world):
    """Each part of each output, normalised, by its name."""
    made = {}
    with tempfile.TemporaryDirectory(prefix="foretouch-digests-") as folder:
        running.run(case, world, Path(folder))
        for file, normal in case.outputs.items():
            for part, content in normal((Path(folder) / file).read_bytes()).items():
                made[f"{case.name}/{file}" + (f".{part}" if part else "")] = content
    return made


def keep(folder, made):
    for name, content in made.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def first_difference(old, new):
    """Line, column and surroundings of the first byte that differs."""
    at = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
    line = old.count(b"\n", 0, at) + 1
    column = at - (old.rfind(b"\n", 0, at) + 1) + 1

    def around(content):
        begin = max(content.rfind(b"\n", 0, at) + 1, at - 60)
        end = content.find(b"\n", at)
        return content[begin:min(at + 60, len(content) if end < 0 else end)]

    return f"line {line}, column {column}:\n    was {around(old)!r}\n    is  {around(new)!r}"


class Comparison:
    """Outputs as they come, against the recorded ones."""

    def __init__(self, options, recorded):
        self.options, self.recorded = options, recorded
        self.digests, self.moved, self.failed = {}, [], []

    def add(self, made):
        if self.options.keep:
            keep(self.options.keep, made)
        for name, content in made.items():
            now = {"sha256": normalise.digest(content), "holds": normalise.holds(content)}
            self.digests[name] = now
            was = self.recorded.get(name)
            if was != now:
                self.moved.append(name)
                self.tell(name, was, now, content)

    def tell(self, name, was, now, content):
        if was is None:
            if not self.options.record:
                print(f"{name}: is not recorded; {now['holds']}", flush=True)
            return
        print(f"{name}: differs; was {was['holds']}, is {now['holds']}", flush=True)
        kept = self.options.against / name if self.options.against else None
        if kept and kept.is_file():
            print("  " + first_difference(kept.read_bytes(), content), flush=True)

    def fail(self, case, why):
        self.failed.append(case.name)
        print(f"{case.name}: {why}", flush=True)

    def gone(self, chosen):
        """Recorded outputs of these cases that are made no more."""
        names = tuple(f"{case.name}/" for case in chosen if case.name not in self.failed)
        return [name for name in self.recorded
                if name.startswith(names) and name not in self.digests]


def run_all(chosen, world, comparison):
    twice = comparison.options.record

    def attempt(case):
        try:
            made = outputs_of(case, world)
            again = outputs_of(case, world) if twice else made
            return made, [name for name in made if made[name] != again.get(name)]
        except Exception as failure:  # also of an output that is not what it should be
            return failure, []

    with ThreadPoolExecutor(comparison.options.jobs) as pool:
        for case, (made, unsteady) in zip(chosen, pool.map(attempt, chosen)):
            if isinstance(made, Exception):
                comparison.fail(case, made)
            elif unsteady:
                comparison.fail(case, f"not the same twice: {', '.join(unsteady)}")
            else:
                comparison.add(made)


def record(comparison, here, gone):
    """A line an output, so that a change shows by itself what moved."""
    digests = {**comparison.recorded, **comparison.digests}
    lines = [f"{json.dumps(name, ensure_ascii=False)}: {json.dumps(digests[name])}"
             for name in sorted(digests) if name not in gone]
    text = ",\n".join(lines)
    RECORDED.write_text(f'{{"recorded_on": {json.dumps(here)},\n"digests": {{\n{text}\n}}}}\n',
                        encoding="utf-8")


def told_and_done(comparison, gone, skipped, seconds):
    """Says what was found; the exit code."""
    for name in gone:
        print(f"{name}: is recorded, and made no more")
    for name, why in skipped.items():
        print(f"{name}: skipped: {why}")
    moved, failed = len(comparison.moved) + len(gone), len(comparison.failed)
    print(f"{len(comparison.digests)} outputs, {moved} other than recorded; {failed} cases failed, "
          f"{len(skipped)} skipped; {seconds:.0f} s")
    if failed:
        return 2
    return 1 if moved and not comparison.options.record else 0


def main():
    options = arguments()
    known = json.loads(RECORDED.read_text(encoding="utf-8")) if RECORDED.exists() else {}
    here = machine()
    if known.get("recorded_on", here) != here:
        if not options.record or options.only or options.short:
            print(f"skipped: recorded on {known['recorded_on']}, this is {here}")
            return SKIPPED
        known = {}  # digests of two machines would be those of none
    begun = time.monotonic()
    with running.World(SOURCE, options.program) as world:
        chosen, skipped = chosen_cases(options, world)
        comparison = Comparison(options, known.get("digests", {}))
        run_all(chosen, world, comparison)
    gone = comparison.gone(chosen)
    if options.record and not comparison.failed:
        record(comparison, here, gone)
    return told_and_done(comparison, gone, skipped, time.monotonic() - begun)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Runs the program over a list of cases and compares a digest of each output with the recorded one:
what must not change is seen to have stayed the same, byte for byte.

    ./run digests                     every case; those whose data or tools are absent are skipped
    ./run digests --only 'clip/*'     some of them
    ./run digests --keep /tmp/old     and keeps the outputs, as they are compared
    ./run digests --against /tmp/old  and says where an output that differs does so first
    ./run digests --record            records what is made now, after each case gave the same twice
    ./run digests --width sse4        runs all cases at that width

The cases are in bundled.py, moving.py and recordings.py; what may differ, and is masked, in
normalise.py. Answers follow from the width of the processor's vectors, so recorded.json has digests
by width. All cases run at the widest that is recorded and that the processor has, some at every
width; a wider one is named and not taken. They follow from the C library's mathematics as well: its
plain ones are asked for, which do not depend on the processor, and where they answer otherwise than
those of the library that was recorded, nothing is compared: exit code 77.
Exit code 0: all as recorded; 1: something differs; 2: a case could not be run.
"""
import argparse
import fnmatch
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True

import asked  # noqa: E402
import bundled  # noqa: E402
import mathematics  # noqa: E402
import moving  # noqa: E402
import normalise  # noqa: E402
import recordings  # noqa: E402
import running  # noqa: E402

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
RECORDED = HERE / "recorded.json"
SKIPPED = 77


def mathematics_here():
    """The C library, and what its mathematics answer as the cases ask them."""
    said = subprocess.run([sys.executable, HERE / "mathematics.py"], check=True, text=True,
                          env={**os.environ, **mathematics.PLAIN}, capture_output=True)
    return {"library": " ".join(platform.libc_ver()), "mathematics": said.stdout.strip()}


def arguments():
    parser = argparse.ArgumentParser(description="Compare digests of outputs with recorded ones.")
    parser.add_argument("--record", action="store_true", help="record what is made now")
    parser.add_argument("--only", metavar="NAME", help="cases with this name, which may have a *")
    parser.add_argument("--short", action="store_true", help="the bundled example alone, briefly")
    parser.add_argument("--width", choices=running.WIDTHS,
                        help="vectors of all cases, in place of the widest that is recorded")
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
    for case in (*asked.every_case(), *bundled.every_case(), *moving.every_case(), *recordings.every_case()):
        named = options.only is None or fnmatch.fnmatch(case.name, options.only)
        if not named or (options.short and not case.short):
            continue
        lacks = world.lacks(case)
        if lacks:
            skipped[case.name] = lacks
        else:
            chosen.append(case)
    return chosen, skipped


def widths_of(options, world, known):
    """At which width all cases run, and some of them besides."""
    if options.width not in (None, *world.widths):
        sys.exit(f"--width {options.width}: this processor lacks it")
    recorded = {width for digests in known.values() for width in digests} or {*world.widths}
    common = [width for width in world.widths if width in recorded]
    absent = [width for width in world.widths if width not in recorded]
    if absent and not options.record:
        print(f"not recorded, and not compared: {', '.join(absent)}", flush=True)
    widest = options.width or common[-1]
    others = world.widths if options.record else common
    return widest, [width for width in others if width != widest]


def outputs_of(case, world, width):
    """Each part of each output, normalised, by its name."""
    made = {}
    with tempfile.TemporaryDirectory(prefix="foretouch-digests-") as folder:
        running.run(case, world, width, Path(folder))
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
        self.digests, self.moved, self.uncompared, self.failed = {}, [], [], []

    def add(self, width, made):
        if self.options.keep:
            keep(self.options.keep / width, made)
        for name, content in made.items():
            now = {"sha256": normalise.digest(content), "holds": normalise.holds(content)}
            self.digests.setdefault(name, {})[width] = now
            known = self.recorded.get(name, {})
            if known and width not in known and not self.options.record:
                self.uncompared.append((name, width))
            elif known.get(width) != now:
                self.moved.append((name, width))
                self.tell(name, width, known.get(width), now, content)

    def tell(self, name, width, was, now, content):
        if was is None:
            if not self.options.record:
                print(f"{name} at {width}: is not recorded; {now['holds']}", flush=True)
            return
        print(f"{name} at {width}: differs; was {was['holds']}, is {now['holds']}", flush=True)
        kept = self.options.against / width / name if self.options.against else None
        if kept and kept.is_file():
            print("  " + first_difference(kept.read_bytes(), content), flush=True)

    def fail(self, case, width, why):
        self.failed.append(case.name)
        print(f"{case.name} at {width}: {why}", flush=True)

    def gone(self, chosen):
        """Recorded outputs of these cases that are made no more."""
        names = tuple(f"{case.name}/" for case in chosen if case.name not in self.failed)
        return [name for name in self.recorded
                if name.startswith(names) and name not in self.digests]


def run_all(chosen, world, widths, comparison):
    widest, others = widths
    runs = [(case, widest) for case in chosen]
    runs += [(case, width) for case in chosen if case.everyWidth for width in others]
    twice = comparison.options.record

    def attempt(run):
        try:
            made = outputs_of(*run)
            again = outputs_of(*run) if twice else made
            return made, [name for name in made if made[name] != again.get(name)]
        except Exception as failure:  # also of an output that is not what it should be
            return failure, []

    with ThreadPoolExecutor(comparison.options.jobs) as pool:
        attempts = pool.map(attempt, [(case, world, width) for case, width in runs])
        for (case, width), (made, unsteady) in zip(runs, attempts):
            if isinstance(made, Exception):
                comparison.fail(case, width, made)
            elif unsteady:
                comparison.fail(case, width, f"not the same twice: {', '.join(unsteady)}")
            else:
                comparison.add(width, made)


def by_width(kinds):
    return {width: digest for widths, digest in kinds.items() for width in widths.split()}


def read_record():
    """On what was recorded, and the digests: by output, then by width."""
    if not RECORDED.exists():
        return {}, {}
    written = json.loads(RECORDED.read_text(encoding="utf-8"))
    digests = {name: by_width(kinds) for name, kinds in written["digests"].items()}
    return written["recorded_on"], digests


def renewed(was, now):
    """Digests of one output by width. Those of widths that were not run are out of date if any
    other moved."""
    kept = was if all(was.get(width) == now[width] for width in now if width in was) else {}
    return {**kept, **now}


def by_digest(digests):
    """The widths that agree on a digest, narrowest first, in place of each width."""
    kinds = {}
    for width in (width for width in running.WIDTHS if width in digests):
        kinds.setdefault(json.dumps(digests[width]), []).append(width)
    return ", ".join(f"{json.dumps(' '.join(widths))}: {digest}"
                     for digest, widths in kinds.items())


def record(comparison, here, gone):
    """A line an output, so that a change shows by itself what moved."""
    digests = {name: renewed(comparison.recorded.get(name, {}), comparison.digests.get(name, {}))
               for name in {*comparison.recorded, *comparison.digests}.difference(gone)}
    lines = [f"{json.dumps(name, ensure_ascii=False)}: {{{by_digest(digests[name])}}}"
             for name in sorted(digests)]
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
    made = sum(len(widths) for widths in comparison.digests.values())
    if comparison.uncompared:
        widths = sorted({width for _, width in comparison.uncompared})
        print(f"{len(comparison.uncompared)} outputs are not recorded at {', '.join(widths)}, and "
              "not compared")
    print(f"{made} outputs, {moved} other than recorded; {failed} cases failed, "
          f"{len(skipped)} skipped; {seconds:.0f} s")
    if failed:
        return 2
    return 1 if moved and not comparison.options.record else 0


def main():
    options = arguments()
    known, digests = read_record()
    here = mathematics_here()
    if known.get("mathematics", here["mathematics"]) != here["mathematics"]:
        if not options.record or options.only or options.short:
            print(f"skipped: recorded with {known}, this is {here}")
            return SKIPPED
        digests = {}  # digests of two libraries would be those of none
    begun = time.monotonic()
    with running.World(SOURCE, options.program) as world:
        chosen, skipped = chosen_cases(options, world)
        comparison = Comparison(options, digests)
        run_all(chosen, world, widths_of(options, world, digests), comparison)
    gone = comparison.gone(chosen)
    if options.record and not comparison.failed:
        record(comparison, here, gone)
    return told_and_done(comparison, gone, skipped, time.monotonic() - begun)


if __name__ == "__main__":
    sys.exit(main())

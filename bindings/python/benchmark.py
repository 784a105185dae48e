"""What Python adds to a query: the bundled clip step by step from Python, beside the same steps in
C++ as `foretouch replay` times them (latency_us: motion and query). One thread, best of a few runs.

    python3 bindings/python/benchmark.py --build build/release
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--build", type=Path, default=Path("build/release"), help="a build tree")
parser.add_argument("--runs", type=int, default=7)
parser.add_argument("--rate", type=float, default=10.0, help="poses a second (Hz)")
options = parser.parse_args()
sys.path.insert(0, str(options.build.resolve() / "lib" / "python3" / "dist-packages"))

import foretouch  # noqa: E402


def replayed(folder):
    """Microseconds of each step in C++."""
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch) / "out.jsonl"
        subprocess.run(
            [options.build / "bin" / "foretouch", "replay", "--scene", folder / "room.obj", "--avatar",
             folder / "dancer.avatar.json", "--motion", folder / "dancer.bvh", "--rate",
             str(options.rate), "--threads", "1", "--output", output],
            check=True, capture_output=True)
        lines = [json.loads(line) for line in output.read_text().splitlines()]
    return [line["latency_us"] for line in lines if "step" in line]


def timed(work, items):
    """Microseconds of each call."""
    taken = []
    for item in items:
        began = time.perf_counter_ns()
        work(*item)
        taken.append((time.perf_counter_ns() - began) / 1e3)
    return taken


def best(measure):
    """Of each step the least of all runs."""
    return [min(run) for run in zip(*(measure() for _ in range(options.runs)))]


def show(name, microseconds):
    ranked = sorted(microseconds)
    print(f"{name:54} {statistics.mean(ranked):8.2f} {statistics.median(ranked):8.2f}"
          f" {ranked[int(0.99 * len(ranked))]:8.2f}")


def main():
    folder = foretouch.example_folder()
    avatar = foretouch.Avatar.load(folder / "dancer.avatar.json")
    scene = foretouch.Scene.load(folder / "room.obj")
    clip = foretouch.Clip.load(folder / "dancer.bvh")
    poses = clip.poses(avatar)[:: max(1, round(1 / (options.rate * clip.frame_time_s)))]
    pairs = list(zip(poses, poses[1:]))
    query = foretouch.Query(avatar, scene)
    motions = [foretouch.Motion(avatar, start, end) for start, end in pairs]
    empty = foretouch.Scene.from_arrays([[1e6] * 3] * 3, [[0, 1, 2]])
    far = foretouch.Query(avatar, empty)

    def step(start, end):
        query.first_contacts(foretouch.Motion(avatar, start, end))

    print(f"{len(pairs)} steps of {len(avatar)} links, {scene.num_triangles} triangles")
    print(f"{'microseconds a step':54} {'mean':>8} {'p50':>8} {'p99':>8}")
    show("C++: motion and query", best(lambda: replayed(folder)))
    show("Python: Motion() and Query.first_contacts()", best(lambda: timed(step, pairs)))
    show("  of it Motion(): numpy checked, poses validated",
         best(lambda: timed(lambda a, b: foretouch.Motion(avatar, a, b), pairs)))
    show("  of it Query.first_contacts()",
         best(lambda: timed(query.first_contacts, [(m,) for m in motions])))
    show("  the same where nothing is near",
         best(lambda: timed(far.first_contacts, [(m,) for m in motions])))
    show("Python: first_contacts(), a Query each",
         best(lambda: timed(lambda m: foretouch.first_contacts(avatar, m, scene),
                            [(m,) for m in motions])))
    many = [timed(lambda: query.first_contacts_many(poses, threads=1), [()])[0] / len(pairs)
            for _ in range(options.runs)]
    show("Python: Query.first_contacts_many(), a step", [min(many)])


main()

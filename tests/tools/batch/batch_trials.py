"""batch_trials.py [PROGRAM] [--jobs N] [--kills N] [--overhead N] [--make DIR]: a batch of N short clips, once
undisturbed and once killed at random instants, with a full disk and with a job that crashes: the
merged tables have to be the same bytes. Then what a batch costs beside its replays. Exit code 1
where a promise was broken. Needs root for the full disk, which is left out otherwise. --make only
writes the clips and the manifest into a folder."""
import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

WALL = """o wall
v 0 -2 -2
v 0 2 -2
v 0 2 2
v 0 -2 2
f 1 2 3
f 1 3 4
"""
MAN = """{"format":"foretouch-avatar","version":1,"links":[
{"name":"Hips","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"Arm","parent":"Hips","offset":[0,0.3,0],"lss":[{"a":[0,0,0],"b":[0,0.5,0],"radius":0.05}]}
]}"""
CLIP_HEAD = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 0 0.3 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0.5 0
    }
  }
}
MOTION
"""


def clip(seed, frames=6):
    draw = random.Random(seed)
    rows = [f"{draw.uniform(-1, 1):.6f} 0 0 {draw.uniform(-90, 90):.4f} 0 0 0 0 0" for _ in range(frames)]
    return CLIP_HEAD + f"Frames: {frames}\nFrame Time: 0.1\n" + "\n".join(rows) + "\n"


class Fleet:
    def __init__(self, folder, jobs, program):
        self.folder, self.jobs, self.program = Path(folder), jobs, program
        (self.folder / "wall.obj").write_text(WALL)
        (self.folder / "man.json").write_text(MAN)
        (self.folder / "clips").mkdir()
        for i in range(jobs):
            (self.folder / "clips" / f"c{i:06}.bvh").write_text(clip(i))
        self.manifest = self.folder / "fleet.batch"
        gone = "job --motion clips/gone.bvh\n"
        self.manifest.write_text("foretouch-batch 1\nall --scene wall.obj --avatar man.json\n"
                                 "job --motion clips/c*.bvh\n" + gone)

    def words(self, results, *more):
        return [self.program, "batch", str(self.manifest), "--output", str(results), "--quiet", *more]

    def run(self, results, *more):
        return subprocess.run(self.words(results, *more), capture_output=True, text=True)

    def merged(self, results):
        """The table and the lines; they do not name the folder."""
        ended = [self.run(results, "--merge", "--table", str(self.folder / name), "--report",
                          str(Path(results) / "report.html")) for name in ("t.csv", "t.jsonl")]
        for one in ended:
            if one.returncode > 1:
                sys.exit(one.stderr)
        return [(self.folder / name).read_bytes() for name in ("t.csv", "t.jsonl")] + [
            (Path(results) / "report.html").read_bytes()]


def killed(fleet, results, kills, seconds, crashing):
    """Kills it at instants spread over its whole length; returns how often it was alive then."""
    draw, alive = random.Random(1), 0
    for i in range(kills):
        more = ["--program", crashing] if i == kills // 2 else []
        run = subprocess.Popen(fleet.words(results, *more), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        time.sleep(draw.uniform(0, 2 * seconds / kills))
        alive += run.poll() is None
        run.send_signal(signal.SIGKILL)
        run.wait()
    return alive


def full_disk(fleet, crashing):
    """A file system that is too small, then larger. None: no root, no trial."""
    place = fleet.folder / "small"
    place.mkdir()
    size = max(256, fleet.jobs)  # kB: a tenth of what is needed
    if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k,nr_inodes=0", "none", place],
                      stderr=subprocess.DEVNULL).returncode != 0:
        return None
    try:
        first = fleet.run(place)
        if first.returncode == 0 or "No space left" not in first.stderr:
            return f"a full disk of {size} kB was not told of: {first.returncode} {first.stderr}"
        subprocess.run(["mount", "-o", "remount,size=4g", place], check=True)
        fleet.run(place)
        return fleet.merged(place)
    finally:
        subprocess.run(["umount", place], check=True)


def own_share(fleet, jobs):
    """CPU time of the batch itself beside that of its jobs, as the kernel counts both while it runs."""
    manifest = fleet.folder / "cost.batch"
    manifest.write_text("foretouch-batch 1\nall --scene wall.obj --avatar man.json\n" + "".join(
        f"job --motion clips/c{i:06}.bvh\n" for i in range(jobs)))
    run = subprocess.Popen([fleet.program, "batch", str(manifest), "--output", str(fleet.folder / "cost"),
                            "--threads", "1", "--quiet"], stdout=subprocess.DEVNULL)
    ticks = None
    while run.poll() is None:
        try:
            fields = Path(f"/proc/{run.pid}/stat").read_text().rsplit(")", 1)[1].split()
            if fields[0] != "Z":
                ticks = [int(text) for text in fields[11:15]]  # own user and system, then of its children
        except (FileNotFoundError, ProcessLookupError):
            pass
        time.sleep(0.02)
    hz = os.sysconf("SC_CLK_TCK")
    return (ticks[0] + ticks[1]) / hz, (ticks[2] + ticks[3]) / hz


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", nargs="?", default="foretouch")
    parser.add_argument("--make")
    parser.add_argument("--jobs", type=int, default=10_000)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--overhead", type=int, default=300)
    asked = parser.parse_args()
    if asked.make:
        Fleet(asked.make, asked.jobs, asked.program)
        return
    with tempfile.TemporaryDirectory() as folder:
        fleet = Fleet(folder, asked.jobs, os.path.abspath(asked.program))
        crashing = fleet.folder / "crashing"
        crashing.write_text(f'#!/bin/sh\ncase "$*" in *c00000[37].bvh*) kill -SEGV $$;; esac\n'
                            f'exec {fleet.program} "$@"\n')
        crashing.chmod(0o755)
        start = time.monotonic()
        first = fleet.run(fleet.folder / "alone")
        seconds = time.monotonic() - start
        if first.returncode != 1:
            sys.exit(f"expected exit code 1 for the one missing clip: {first.stderr}")
        expected, broken = fleet.merged(fleet.folder / "alone"), 0
        print(f"{asked.jobs + 1} jobs: {seconds:.1f} s undisturbed, a table of {len(expected[0])} bytes", flush=True)
        alive = killed(fleet, fleet.folder / "killed", asked.kills, seconds, str(crashing))
        fleet.run(fleet.folder / "killed", "--program", str(crashing))
        fleet.run(fleet.folder / "killed")
        same = fleet.merged(fleet.folder / "killed") == expected
        broken += not same
        left = [one.name for one in (fleet.folder / "killed").iterdir() if one.name.startswith(".work")]
        broken += bool(left)
        print(f"killed {asked.kills} times, {alive} of them at work, and two jobs that crashed: "
              f"{'the same bytes' if same else 'OTHER BYTES'}, {len(left)} leftovers", flush=True)
        disk = full_disk(fleet, str(crashing))
        if disk is None:
            print("a full disk: left out, nothing can be mounted here")
        else:
            broken += disk != expected
            print(f"a full disk, then room: {'the same bytes' if disk == expected else disk}", flush=True)
        if asked.overhead > 0:
            jobs = min(asked.overhead, asked.jobs)
            own, of_jobs = own_share(fleet, jobs)
            print(f"CPU of {jobs} jobs one after the other: {of_jobs:.2f} s of the replays, {own:.2f} s of the "
                  f"batch itself, its start included: {100 * own / of_jobs:.2f} %")
        sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()

"""roofline.py PROGRAM FOLDER RECORD [--record]: what bounds a step that is asked once?

Callgrind counts the instructions of each phase of a step, and the cache lines that it has to fetch
because what a program did in between has pushed them out: into a first level of 32 KiB, for code and
for data, and from beyond a second one of 1 MiB. The benchmark then times the same steps, warm and
asked once. Valgrind knows no AVX-512, so all of it is of AVX2.
"""

import json
import os
import re
import subprocess
import sys
from collections import defaultdict

STEPS = {
    "link": ["--triangles", "300000", "--links", "16", "--choice", "mix"],
    "exact": ["--fidelity", "exact", "--links", "15"],
}
COMMON = ["latency", "--rate", "10", "--tolerance", "0.001", "--simd", "avx2", "--quiet"]

# The first pattern that a function's name holds says whose it is.
PHASES = [
    ("the motion between two poses",
     r"ChainMotion::assign|arcsInLanes|jointMotion|rotationVector|JointArc|sin|cos|atan2"),
    ("frames, curves and boxes of links",
     r"weighJoints|evaluateLinks|boxesOf|[sS]weptBoxes|NodeEnds|ChainNodes|fitPoint|polynomialsOf|pointError|"
     r"RelativeNodes|FittedCurve|[fF]rameLanes|LaneFrames|fitRotation|fitEnd"),
    ("the walk through trees and what leaves hold",
     r"WalkInLanes|LeafHits|LaneCull|gatherTriangles|gatherSpheres|addLeaf|nearTriangles|settleBatch|sortClusters|"
     r"collectParts|addTriangles|addCandidate|BvhWalk|boundGaps|[pP]airBoxes"),
    ("advancement in lanes",
     r"advanceAll|sphereRounds|PairLanes|laneLss|triangleRounds|advanceLss|TimeBuckets|LaneBacktracker|Sides|"
     r"[tT]rianglePairs|prove\w*Lanes|placeLanes|placeParts|PartLanes|[aA]xisParts"),
    ("doubles, for what lanes leave open",
     r"[bB]acktrack|closestPoints|offerEdges|[sS]eparation|movingPair|MovingHull|tryDirection|localOf|composed|"
     r"chainState|stateIn|MotionEvaluator|StateCache|contactOf|nextPossible|provenFrom|leastGap|pairOf|hullAt|"
     r"axisDistance|featurePlaceAt|edgesOf|nextafter|_heap"),
]
REST = "answers and the rest"
COUNTS = {"instructions": "instructions", "code": "lines of code", "read": "lines read", "written": "lines written",
          "far": "of them beyond 1 MiB"}


def phase_of(function):
    return next((phase for phase, pattern in PHASES if re.search(pattern, function)), REST)


def costs_by_function(path):
    """What callgrind attributes to each function itself, without its callees."""
    costs, names, current, skips = defaultdict(lambda: defaultdict(int)), {}, None, False
    events = []
    with open(path) as profile:
        for line in profile:
            if line.startswith("events:"):
                events = line.split()[1:]
            elif named := re.match(r"fn=\((\d+)\)(?: (.*))?", line):
                number, name = named.groups()
                current = names.setdefault(number, name)
            elif called := re.match(r"cfn=\((\d+)\)(?: (.*))?", line):
                names.setdefault(*called.groups())
            elif line.startswith("calls="):
                skips = True  # the next line is the callee's
            elif re.match(r"[+*-]?\d* |\* ", line):
                if not skips:
                    for event, count in zip(events, line.split()[1:]):
                        costs[current][event] += int(count)
                skips = False
    if not costs:
        sys.exit(f"{path}: expected costs of functions, as callgrind writes them")
    return costs


def latency(program, words, output):
    """The report of a run, which `program` begins, and its steps' times by the state of the caches."""
    run = subprocess.run([*program, *COMMON, *words, "--json", output], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(run.stderr)
    with open(output) as file:
        report = json.load(file)
    rows = next(table for table in report["tables"] if table["name"] == "latency")["rows"]
    return report, {row["caches"]: row for row in rows}


def count(program, words, folder):
    profile, output = os.path.join(folder, "callgrind.out"), os.path.join(folder, "counted.json")
    # Valgrind does not let a program lower the limit of open files that it inherits; the importer's is 64.
    limited = ["prlimit", "--nofile=64:64", "valgrind", "--tool=callgrind", "--cache-sim=yes",
               "--I1=32768,8,64", "--D1=32768,8,64", "--LL=1048576,8,64", "--collect-atstart=no",
               "--toggle-collect=foretouch::tools::answerStep*", f"--callgrind-out-file={profile}"]
    # Without cold passes each step is answered once.
    steps = latency([*limited, program], [*words, "--repeat", "1", "--cold-mb", "0"], output)[1]["warm"]["steps"]
    phases = defaultdict(lambda: defaultdict(float))
    for function, costs in costs_by_function(profile).items():
        lines = {"instructions": costs["Ir"], "code": costs["I1mr"], "read": costs["D1mr"],
                 "written": costs["D1mw"], "far": costs["ILmr"] + costs["DLmr"] + costs["DLmw"]}
        for key, value in lines.items():
            phases[phase_of(function or "")][key] += value / steps
    return phases


def main():
    program, folder, record = sys.argv[1:4]
    os.makedirs(folder, exist_ok=True)
    phases, steps = [], []
    for name, words in STEPS.items():
        print(f"run: roofline: {name}", file=sys.stderr)
        counted = count(program, words, folder)
        report, rows = latency([program], words, os.path.join(folder, "timed.json"))
        for phase in [phase for phase, _ in PHASES] + [REST]:
            phases.append({"step": name, "phase": phase, **{key: counted[phase][key] for key in COUNTS}})
        total = {key: sum(part[key] for part in counted.values()) for key in COUNTS}
        warm, once = rows["warm"]["mean_us"], rows["asked once"]["mean_us"]
        lines = total["code"] + total["read"] + total["written"]
        steps.append({"step": name, **total, "warm_us": warm, "once_us": once,
                      "instruction_ns": 1e3 * warm / total["instructions"], "line_ns": 1e3 * (once - warm) / lines})
    counts = [(key, title, 0) for key, title in COUNTS.items()]
    times = [("warm_us", "warm, us", 1), ("once_us", "asked once, us", 1),
             ("instruction_ns", "ns an instruction", 3), ("line_ns", "ns a line", 2)]
    named = lambda columns: [dict(zip(("key", "title", "decimals"), column)) for column in columns]
    report.update(kind="roofline", title="What bounds a step that is asked once", command="./run roofline --record",
                  workload={name: " ".join(COMMON[:-1] + words) for name, words in STEPS.items()},
                  tables=[{"name": "steps", "title": "A step in the mean",
                           "columns": named([("step", "step", 0)] + counts + times), "rows": steps},
                          {"name": "phases", "title": "Its phases",
                           "columns": named([("step", "step", 0), ("phase", "phase", 0)] + counts), "rows": phases}],
                  notes=["Counted by valgrind's callgrind with caches of 32 KiB (code), 32 KiB (data) and 1 MiB, each "
                         "of eight ways; timed with the same vectors."])
    output = record if "--record" in sys.argv[4:] else os.path.join(folder, "roofline.json")
    with open(output, "w") as file:
        json.dump(report, file, indent=1)
    sys.exit(subprocess.run([program, "report", output]).returncode)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""compare.py ONE OTHER [FIGURES MACHINE TESTS]: do two machines answer alike (verdicts.cpp)?

Both must tell of the same cases, steps and links, asked about the same poses (to a micrometre). All
verdicts must be equal, except on a graze: one machine's contact lies in the tolerance, where both
answers are right (whether they are, judge_verdicts says of each). Prints what was compared; 1 where
they disagree, or where more than one in a thousand is a graze. FIGURES is the file of measurements
that the other MACHINE's row is written to, with the number of TESTS that passed there.
"""
import datetime
import itertools
import json
import sys

TOLERANCE_M = 1e-3  # of ft_query_options, by default
CLEAR, CONTACT = 0, 1  # FT_VERDICT_*
SAME_POSE = 1e-6  # metres, and units of quaternions
COLUMNS = [("machine", "machine"), ("tests", "tests passed"), ("answers", "answers about links"),
           ("met", "not clear"), ("grazes", "grazes told differently"), ("wrong", "wrong"),
           ("instant", "instants within, of a step")]


def answers_of(path):
    """(case, frame, link or -1 for a pose, numbers)"""
    case = frame = None
    with open(path, encoding="ascii") as file:
        for line in file:
            kind, *words = line.split()
            if kind == "case":
                case = int(words[0])
            elif kind == "pose":
                frame = int(words[0])
                yield case, frame, -1, [float.fromhex(word) for word in words[1:]]
            else:
                verdict, toi, _, separation = int(words[1]), *map(float.fromhex, words[2:5])
                yield case, frame, int(words[0]), (verdict, toi, separation)


class Comparison:
    def __init__(self):
        self.answers = self.met = self.grazes = 0
        self.instant = self.moved = 0.0
        self.wrong = []

    def add(self, place, mine, yours):
        if place[2] < 0:
            self.moved = max([self.moved, *(abs(x - y) for x, y in zip(mine, yours))])
            return
        self.answers += 1
        self.met += mine[0] != CLEAR
        if mine[0] == yours[0]:
            if mine[0] == CONTACT:
                self.instant = max(self.instant, abs(mine[1] - yours[1]))
        elif {mine[0], yours[0]} == {CLEAR, CONTACT}:
            self.grazes += 1
        else:
            self.wrong.append(place)
        if any(verdict == CONTACT and separation > TOLERANCE_M for verdict, _, separation in (mine, yours)):
            self.wrong.append(place)

    def is_alike(self):
        return (self.met > 0 and not self.wrong and self.grazes * 1000 <= self.answers
                and self.moved <= SAME_POSE)

    def tell(self):
        print(f"{self.answers} answers about links, {self.met} of them not clear, {self.grazes} grazes "
              f"told differently, {len(self.wrong)} wrong; instants within {self.instant:.2g} of a step, "
              f"poses within {self.moved:.2g}")
        for case, frame, link in self.wrong[:10]:
            print(f"  case {case}, step to frame {frame}, link {link}")

    def record(self, path, machine, tests):
        with open(path, encoding="utf-8") as recorded:
            figures = json.load(recorded)
        table = figures["tables"][0]
        row = {"machine": machine, "tests": int(tests), "answers": self.answers, "met": self.met,
               "grazes": self.grazes, "wrong": len(self.wrong), "instant": float(f"{self.instant:.2g}")}
        table["rows"] = [old for old in table["rows"] if old["machine"] != machine] + [row]
        table["columns"] = [{"key": key, "title": title} for key, title in COLUMNS]
        table["date"] = datetime.date.today().isoformat()
        with open(path, "w", encoding="utf-8") as out:
            json.dump(figures, out, indent=1)
            out.write("\n")


def main(one, other, *recorded):
    found = Comparison()
    for ours, theirs in itertools.zip_longest(answers_of(one), answers_of(other)):
        if ours is None or theirs is None or ours[:3] != theirs[:3]:
            print(f"compare.py: {one} and {other} tell of other steps or links, near {ours and ours[:3]}")
            return 1
        found.add(ours[:3], ours[3], theirs[3])
    found.tell()
    if recorded:
        found.record(*recorded)
    return 0 if found.is_alike() else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

#!/usr/bin/env python3
"""compare.py ONE OTHER: do two machines answer alike (verdicts.cpp)?

Both must tell of the same cases, steps and links, asked about the same poses (to a micrometre). All
verdicts must be equal, except on a graze: one machine's contact lies in the tolerance, where both
answers are right (whether they are, judge_verdicts says of each). Prints what was compared; 1 where
they disagree, or where more than one in a thousand is a graze.
"""
import itertools
import sys

TOLERANCE_M = 1e-3  # of ft_query_options, by default
CLEAR, CONTACT = 0, 1  # FT_VERDICT_*
SAME_POSE = 1e-6  # metres, and units of quaternions


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


def main(one, other):
    compared = met = grazes = 0
    latest = moved = 0.0
    wrong = []
    for ours, theirs in itertools.zip_longest(answers_of(one), answers_of(other)):
        if ours is None or theirs is None or ours[:3] != theirs[:3]:
            print(f"compare.py: {one} and {other} tell of other steps or links, near {ours and ours[:3]}")
            return 1
        place, (mine, yours) = ours[:3], (ours[3], theirs[3])
        if place[2] < 0:
            moved = max([moved, *(abs(x - y) for x, y in zip(mine, yours))])
            continue
        compared += 1
        met += mine[0] != CLEAR
        if mine[0] == yours[0]:
            if mine[0] == CONTACT:
                latest = max(latest, abs(mine[1] - yours[1]))
        elif {mine[0], yours[0]} == {CLEAR, CONTACT}:
            grazes += 1
        else:
            wrong.append(place)
        if any(verdict == CONTACT and separation > TOLERANCE_M for verdict, _, separation in (mine, yours)):
            wrong.append(place)
    print(f"{compared} answers about links, {met} of them not clear, {grazes} grazes told differently, "
          f"{len(wrong)} wrong; instants within {latest:.2g} of a step, poses within {moved:.2g}")
    for case, frame, link in wrong[:10]:
        print(f"  case {case}, step to frame {frame}, link {link}")
    alike = met > 0 and not wrong and grazes * 1000 <= compared and moved <= SAME_POSE
    return 0 if alike else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

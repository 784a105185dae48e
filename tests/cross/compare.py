#!/usr/bin/env python3
"""compare.py ONE OTHER: do two machines' verdicts (verdicts.cpp) agree?

All verdicts must be equal, except on a graze: one machine's contact lies in the tolerance, where both
answers are right. Prints what was compared; 1 where they disagree.
"""
import sys

TOLERANCE_M = 1e-3  # of ft_query_options, by default
CONTACT = 1  # FT_VERDICT_CONTACT
CLEAR = 0  # FT_VERDICT_CLEAR


def lines_of(path):
    with open(path, encoding="ascii") as file:
        for line in file:
            frame, link, verdict, toi, separation = line.split()
            yield (int(frame), int(link)), int(verdict), float(toi), float(separation)


def main(one, other):
    compared = met = grazes = 0
    furthest = 0.0
    wrong = []
    ours, theirs = list(lines_of(one)), list(lines_of(other))
    if not ours or [o[0] for o in ours] != [t[0] for t in theirs]:
        print(f"compare.py: {one} and {other} tell of other steps and links", file=sys.stderr)
        return 1
    for (place, verdict, toi, separation), (_, verdict2, toi2, separation2) in zip(ours, theirs):
        compared += 1
        met += verdict != CLEAR
        if verdict == verdict2 == CONTACT:
            furthest = max(furthest, abs(toi - toi2))
            if max(separation, separation2) > TOLERANCE_M:
                wrong.append(place)
        elif verdict != verdict2:
            if {verdict, verdict2} == {CONTACT, CLEAR}:
                grazes += 1
            else:
                wrong.append(place)
    print(f"{compared} link-steps, {met} of them not clear, {grazes} grazes told differently, "
          f"instants within {furthest:.2g} of a step, {len(wrong)} wrong")
    for frame, link in wrong[:10]:
        print(f"  step to frame {frame}, link {link}")
    return 1 if wrong or grazes * 1000 > compared else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

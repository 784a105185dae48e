"""Judges what vr_hands prints of hands that meet and leave, by plain arithmetic on where it says
that all were shown. Reads what it prints with its ways; ends with 1 and what is wrong.

A hand is a capsule, the others are boxes and a ball. Between two places of a way each moves straight
and turns little. A hand touches within its skin: while nothing was told it is farther off, and
between "meets" and "leaves" it is within the skin and twice the tolerance."""

import bisect
import math
import sys

SKIN, TOLERANCE = 2e-3, 1e-3
ROUNDING = 1e-5  # of what is printed, and of turning between two places
STEP_S, END_S = 1e-3, 3.99
HAND = ((0, 0, 0.03), (0, 0, -0.06), 0.04)
BALL = 0.035
BOXES = {  # by name: whom it moves with, its corners
    "floor": (None, (-3, -1, -3), (3, -0.9, 3)),
    "platform": ("lift", (-0.9, -0.1, -0.9), (0.9, 0, 0.9)),
    "rail": ("lift", (-0.6, 0.9, -0.5), (-0.3, 0.95, -0.4)),
    "door": ("door", (0, 0, -0.6), (1, 4, -0.5)),
}


class Way:
    def __init__(self):
        self.times, self.places = [], []

    def add(self, s, place):
        if not self.times or s > self.times[-1]:
            self.times.append(s)
            self.places.append(place)

    def at(self, s):
        i = min(max(bisect.bisect_left(self.times, s), 1), len(self.times) - 1)
        t0, t1 = self.times[i - 1], self.times[i]
        share = min(max((s - t0) / (t1 - t0), 0.0), 1.0)
        return [a + share * (b - a) for a, b in zip(self.places[i - 1], self.places[i])]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def turned(q, v):
    t = [2 * c for c in cross(q[1:], v)]
    return [v[i] + q[0] * t[i] + cross(q[1:], t)[i] for i in range(3)]


def gap(hand, other, name):
    """From the hand's surface to the other's."""
    norm = math.sqrt(sum(c * c for c in hand[3:]))
    q = [c / norm for c in hand[3:]]
    a, b = ([hand[i] + turned(q, end)[i] for i in range(3)] for end in HAND[:2])

    def distance(t):
        p = [a[i] + t * (b[i] - a[i]) for i in range(3)]
        if name == "ball":
            return math.dist(p, other[:3]) - BALL
        offset = other[:3] if other else (0, 0, 0)
        low, high = ([c + o for c, o in zip(corner, offset)] for corner in BOXES[name][1:])
        return math.dist(p, [min(max(c, l), h) for c, l, h in zip(p, low, high)])

    if distance(0.5) > 0.3:
        return 0.2  # far
    lower, upper = 0.0, 1.0  # of a convex function
    for _ in range(40):
        m, n = lower + (upper - lower) / 3, upper - (upper - lower) / 3
        if distance(m) < distance(n):
            upper = n
        else:
            lower = m
    return distance(lower) - HAND[2]


def read(lines):
    ways, told = {}, {}
    for line in lines:
        words = line.split()
        s, who = float(words[0]), words[2]
        if words[3] == "at":
            place = [float(word) for word in words[4:7] + words[8:12]]
            ways.setdefault(who, Way()).add(s, place)
        else:
            told.setdefault((who, words[4]), []).append((s, words[3]))
    return ways, told


def judged(ways, hand, name, events):
    """What is wrong; nothing if all is well."""
    def at(s):
        carrier = "ball" if name == "ball" else BOXES[name][0]
        return gap(ways[hand].at(s), ways[carrier].at(s) if carrier else None, name)

    samples = [i * STEP_S for i in range(1, int(END_S / STEP_S))] + [s for s, _ in events]
    verbs = dict(events)
    touches = False
    for s in sorted(set(samples)):
        here = at(s)
        if s in verbs:
            if touches == (verbs[s] == "meets"):
                return f"{s} s: {verbs[s]} out of turn"
            touches = verbs[s] == "meets"
            if verbs[s] == "takes":
                return None  # held from here on, it is not asked
        elif not touches and here <= SKIN - ROUNDING:
            return f"{s} s: {1e3 * here} mm apart, and not told to meet"
        if touches and here > SKIN + 2 * TOLERANCE + ROUNDING:
            return f"{s} s: {1e3 * here} mm apart, and told to meet"
        if verbs.get(s) == "meets" and here > SKIN + TOLERANCE + ROUNDING:
            return f"{s} s: meets at {1e3 * here} mm, beyond skin and tolerance"
        if verbs.get(s) == "leaves" and here <= SKIN - ROUNDING:
            return f"{s} s: leaves at {1e3 * here} mm, within the skin"
    return "it meets, and never leaves" if touches else None


def main():
    ways, told = read(sys.stdin)
    wrong = 0
    for hand in ("LeftHand", "RightHand"):
        for name in (*BOXES, "ball"):
            fault = judged(ways, hand, name, told.pop((hand, name), []))
            if fault:
                print(f"{hand}, {name}: {fault}")
                wrong += 1
    if told:
        print("nothing was there to meet:", *told)
        wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

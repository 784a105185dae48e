#!/usr/bin/env python3
"""Counts the touches in a results file from its step lines alone, and holds the file's own touch
lines against that.

    count_touches.py RESULTS.jsonl

Prints the counts as JSON. Exit code 1: the file's touches are others. It shares nothing with the
program but docs/formats.md ("Touches"): each pair of a link and an object is looked at by itself,
over all steps, pose by pose."""
import json
import sys
from collections import defaultdict

TOUCHING, HIDDEN, FREE, UNKNOWN = "touching", "hidden", "free", "unknown"


def read(path):
    """The header, the steps, the touches and the summary of a results file."""
    with open(path, encoding="utf-8") as file:
        header, *lines = [json.loads(line) for line in file]
    steps = [line for line in lines if "step" in line]
    touches = [line["touch"] for line in lines if "touch" in line]
    summaries = [line["summary"] for line in lines if "summary" in line]
    return header, steps, touches, summaries


def pair_of(contact):
    return contact["link"], contact.get("other"), contact.get("object")


def rows_of(step, by_object):
    """What the step says of the scene, and of own links."""
    return step["objects" if by_object else "contacts"], step.get("pairs", [])


def instant(contact):
    """When in its step the contact is, or until when nothing is."""
    return contact["free_until"] if contact["verdict"] == "undecided" else contact["toi"]


def state_at(step, pair, by_object):
    """What is known of the pair at the earlier pose of the step."""
    link, other, _ = pair
    scene, own = rows_of(step, by_object)
    if other is not None:
        mine = [c for c in own if c["link"] == link and c["other"] == other]
        contacts, undecided = split(mine)
        hiding = []
    else:
        contacts, undecided = split([c for c in scene if c["link"] == link])
        hiding = [] if by_object else contacts
        contacts = [c for c in contacts if pair_of(c) == pair]
    if contacts:
        return TOUCHING if instant(contacts[0]) == 0 else FREE
    if hiding:
        return HIDDEN if instant(hiding[0]) == 0 else FREE
    return UNKNOWN if undecided and instant(undecided[0]) == 0 else FREE


def split(contacts):
    touching = [c for c in contacts if c["verdict"] != "undecided"]
    return touching, [c for c in contacts if c["verdict"] == "undecided"]


def touches_of(pair, rows, steps, by_object):
    """The touches of one pair; `rows`: its contacts, each with the number of its step."""
    # Only the steps from its first contact to its last, and those right after, matter.
    states = {}

    def state(pose):
        if pose not in states:
            states[pose] = state_at(steps[pose], pair, by_object) if pose < len(steps) else UNKNOWN
        return states[pose]

    groups = []
    for number, contact in rows:
        goes_on = bool(groups)
        pose = groups[-1][-1][0] + 1 if groups else 0
        while goes_on and pose <= number:
            goes_on = state(pose) in (TOUCHING, HIDDEN)
            pose += 1
        if goes_on:
            groups[-1].append((number, contact))
        else:
            groups.append([(number, contact)])
    for group in groups:
        last = group[-1][0]
        after = last + 1
        while state(after) == HIDDEN:
            after += 1
        starts = any(c["verdict"] == "starts_in_contact" for _, c in group)
        touch = {"link": pair[0]}
        touch.update({"other": pair[1]} if pair[1] is not None else {"object": pair[2]})
        touch.update(begin=group[0][1]["time"], end=max(c["time"] for _, c in group),
                     steps=[group[0][0], last],
                     begins="inside" if instant(group[0][1]) == 0 else "contact",
                     ends="open" if state(after) == UNKNOWN else "left", contacts=len(group),
                     separation=min(c["separation"] for _, c in group))
        if starts:
            touch["penetration"] = max(c.get("penetration") or 0 for _, c in group) or None
        # None: the next answer does not say whether the pose after it was free.
        seen_free = after == last + 1 and state(after) == FREE
        touch["missed"] = False if starts else True if seen_free else None
        yield touch


def count(header, steps):
    by_object = header.get("scope") == "objects"
    rows = defaultdict(list)
    for number, step in enumerate(steps):
        assert step["step"] == number
        for contacts in rows_of(step, by_object):
            for contact in split(contacts)[0]:
                rows[pair_of(contact)].append((number, contact))
    return [touch for pair, contacts in rows.items()
            for touch in touches_of(pair, contacts, steps, by_object)], rows


def comparable(touch):
    return json.dumps({k: v for k, v in touch.items() if k not in ("ground", "missed")},
                      sort_keys=True)


def contradictions(steps, told, by_object):
    """Where touches that were followed from enter to leave contradict the steps: each contact is in
    a touch of its pair, and each touch is as long as its contacts."""
    of_pair = defaultdict(list)
    for touch in told:
        of_pair[pair_of(touch)].append(touch)
    counted = defaultdict(int)
    for step in steps:
        for contacts in rows_of(step, by_object):
            for contact in split(contacts)[0]:
                # A step and the follower may find one contact at two instants, each proven.
                mine = [t for t in of_pair[pair_of(contact)]
                        if t["begin"] <= contact["time"] <= t["end"]]
                # Those that are near at a pose need not touch.
                if not mine and contact["verdict"] == "starts_in_contact":
                    yield f"no touch holds {contact} of step {step['step']}"
                for touch in mine[:1]:
                    counted[id(touch)] += 1
                    if touch["separation"] > contact["separation"]:
                        yield f"{touch} is farther apart than {contact}"
    for touch in told:
        if touch["begin"] > touch["end"] or touch["steps"][0] > touch["steps"][1]:
            yield f"ends before it begins: {touch}"
        first, last = (steps[step] for step in touch["steps"])
        if not (first["t0"] <= touch["begin"] <= first["t1"] <= last["t1"] >= touch["end"] >= last["t0"]):
            yield f"not in its steps: {touch}"
        has_pose = any(touch["begin"] <= steps[step]["t0"] <= touch["end"]
                       for step in range(touch["steps"][0], touch["steps"][1] + 1))
        if touch.get("missed", False) and has_pose:
            yield f"missed, though a pose is in it: {touch}"


def disorder(told, summary, ignored):
    for name, number in summary_of(told).items():
        if summary.get(name, 0) != number and not (ignored and name == "touches_ground"):
            yield f"{name}: {number} lines, {summary.get(name)} in the summary"
    order = [(t["begin"], t["link"]) for t in told]
    if [begin for begin, _ in order] != sorted(begin for begin, _ in order):
        yield "not in order"


def differences(counted, told, ignored):
    """What the file says otherwise: sentences. `ignored`: touches of the ground are not listed."""
    mine, theirs = ({comparable(t): t for t in touches} for touches in (counted, told))
    for text in theirs.keys() - mine.keys():
        yield f"only told: {text}"
    for text in mine.keys() - theirs.keys():
        if not ignored:
            yield f"only counted: {text}"
    for text in mine.keys() & theirs.keys():
        missed = mine[text]["missed"]
        if missed is not None and missed != theirs[text].get("missed", False):
            yield f"missed {missed} counted: {text}"


def summary_of(told):
    scene = [t for t in told if "other" not in t]
    others = [t for t in scene if not t.get("ground")]
    return {"touches": len(others), "touches_missed": sum(t.get("missed", False) for t in others),
            "touches_ground": len(scene) - len(others), "touches_own": len(told) - len(scene)}


def main(path):
    header, steps, told, summaries = read(path)
    counted, rows = count(header, steps)
    ignored = header.get("ground") == "ignore"
    if summaries[-1].get("followed"):
        by_object = header.get("scope") == "objects"
        found = [] if ignored else list(contradictions(steps, told, by_object))
    else:
        found = list(differences(counted, told, ignored))
    found += disorder(told, summaries[-1], ignored)
    if len(summaries) != 1 or summaries[-1]["steps"] != len(steps):
        found.append("the summary is not that of the steps")
    print(json.dumps({"rows": sum(map(len, rows.values())), "touches": len(counted),
                      **{f"told_{k}": v for k, v in summaries[-1].items()}}))
    for sentence in found[:20]:
        print(sentence, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))

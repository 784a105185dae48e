"""The program's results file of the bundled clip, found again in Python, digit for digit."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import foretouch
from support import PROGRAM, example

FRAMES_A_STEP = 6  # 60 Hz kept at 10 Hz


def replayed(*options):
    """The header and the steps that `foretouch replay` writes."""
    folder = foretouch.example_folder()
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch) / "out.jsonl"
        command = [PROGRAM, "replay", "--scene", folder / "room.obj", "--avatar",
                   folder / "dancer.avatar.json", "--motion", folder / "dancer.bvh", "--rate", "10",
                   "--output", output, *options]
        subprocess.run(command, check=True, capture_output=True)
        lines = [json.loads(line) for line in output.read_text().splitlines()]
    return lines[0], [line for line in lines[1:] if "step" in line]


def as_written(contact):
    """A Contact by the keys of the results file."""
    fields = {"link": contact.link, "verdict": contact.verdict.name.lower()}
    if contact.verdict == foretouch.Verdict.UNDECIDED:
        return {**fields, "free_until": contact.free_until, "reason": contact.reason}
    fields.update(toi=contact.toi, separation=contact.separation, point=list(contact.point),
                  on_link=list(contact.on_link), normal=list(contact.normal),
                  triangle=contact.triangle, object=contact.object)
    if contact.verdict == foretouch.Verdict.STARTS_IN_CONTACT:
        fields["penetration"] = contact.penetration
    return fields


class Replay(unittest.TestCase):
    def check(self, query, *options, lists=("contacts",)):
        avatar, _, clip = example()
        header, steps = replayed(*options)
        poses = clip.poses(avatar)[::FRAMES_A_STEP]
        self.assertEqual(header["links"], avatar.names)
        self.assertEqual(len(steps), len(poses) - 1)
        contacts = 0
        for step, start, end in zip(steps, poses, poses[1:]):
            answer = query.first_contacts(foretouch.Motion(avatar, start, end))
            for name in lists:
                expected = [{k: v for k, v in c.items() if k != "time"} for c in step[name]]
                self.assertEqual([as_written(c) for c in getattr(answer, name)], expected)
            contacts += len(expected)
        return contacts

    def test_gives_the_programs_contacts(self):
        avatar, scene, _ = example()
        self.assertGreater(self.check(foretouch.Query(avatar, scene)), 100)

    def test_gives_them_at_another_tolerance_without_the_ignored(self):
        avatar, scene, _ = example()
        query = foretouch.Query(avatar, scene, tolerance=1e-5,
                                ignore=["Head", ("LeftHand", "string_curtain")])
        self.check(query, "--tolerance", "1e-5", "--ignore", "Head,LeftHand:string_curtain")

    def test_gives_them_in_the_scope_of_the_avatar(self):
        avatar, scene, _ = example()
        self.check(foretouch.Query(avatar, scene, scope="avatar"), "--scope", "avatar")

    def test_gives_them_by_object(self):
        avatar, scene, _ = example()
        query = foretouch.Query(avatar, scene, scope="objects")
        self.assertGreater(self.check(query, "--scope", "objects", lists=("contacts", "objects")),
                           200)

    def test_gives_them_where_what_separates_is_passed(self):
        avatar, scene, _ = example()
        query = foretouch.Query(avatar, scene, tolerance=0.02, pass_separating=True)
        self.check(query, "--tolerance", "0.02", "--pass-separating")


if __name__ == "__main__":
    unittest.main()

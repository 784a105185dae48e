"""Plays a clip in a scene, and prints what each link of the avatar meets first in every step."""

import argparse
import sys

import foretouch

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("scene")
parser.add_argument("avatar")
parser.add_argument("clip")
parser.add_argument("frames_per_step", type=int, nargs="?", default=1)
given = parser.parse_args()

try:
    # Files in centimetres with z up: foretouch.Scene.load(given.scene, scale=0.01, up="z").
    scene = foretouch.Scene.load(given.scene)
    avatar = foretouch.Avatar.load(given.avatar)
    clip = foretouch.Clip.load(given.clip)
    poses = clip.poses(avatar)[::given.frames_per_step]
except (foretouch.Error, ValueError) as error:
    sys.exit(str(error))
for note in clip.notes:
    print("note:", note, file=sys.stderr)

query = foretouch.Query(avatar, scene)
contacts = 0
for number in range(len(poses) - 1):
    step = query.first_contacts(foretouch.Motion(avatar, poses[number], poses[number + 1]))
    for contact in step.contacts:
        if contact.verdict == foretouch.Verdict.CONTACT:
            print(f"step {number}: {contact.link} meets {contact.object} at t = {contact.toi:.4f}")
            contacts += 1
print(f"{contacts} contacts in {len(poses) - 1} steps")

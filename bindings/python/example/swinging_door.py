"""A dancer, tracked 30 times per second, and a door that swings, known 60 times per second: when
does which link meet the door?"""

import math

import foretouch

TURN = 2 * math.pi


def about_y(angle):
    return [math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0]


def tracked_dancer(s):
    """What the tracker says. Yours; here somebody turns, and swings an arm."""
    turns = [about_y(0.4 * math.sin(TURN * 0.3 * s)), about_y(1.2 * math.sin(TURN * 0.7 * s))]
    return turns, [[0, 0.9, 0], [0.2, 0.5, 0]]


def tracked_door(s):
    return about_y(0.35 * math.sin(TURN * 0.5 * s)), [1.3, 0.0, -0.35]


# A trunk with one arm; and a panel of 0.9 by 2 m, in the frame of its hinge.
avatar = foretouch.Avatar.from_arrays(
    names=["trunk", "arm"], parents=[-1, 0], offsets=[[0, 0.9, 0], [0.2, 0.5, 0]], rotations=None,
    lss=[[((0, 0, 0), (0, 0.6, 0), 0.15)], [((0, 0, 0), (0.6, 0, 0), 0.05)]])
panel = foretouch.Scene.from_arrays(
    [[0, 0, 0], [-0.9, 0, 0], [-0.9, 2, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]],
    object_names=["door"])

world = foretouch.World()  # or World(scene): what never moves
dancer = world.add(avatar)  # several bodies may have one avatar
door = world.add(panel)  # a Scene in the door's own frame
answered, contacts, windows = 0, 0, 0
for us in range(0, 4_000_001, 5_556):
    if us % 33_336 == 0:
        world.push(dancer, us, tracked_dancer(1e-6 * us))
    if us % 16_668 == 0:  # its own clock
        world.push(door, us, tracked_door(1e-6 * us))
    until = world.known_until  # all is known until then
    if until <= answered:
        continue
    for contact in world.contacts(answered, until).contacts:
        if contact.verdict == foretouch.Verdict.CONTACT:  # else it touched before
            seconds = 1e-6 * (contact.time_us + contact.fraction)
            x, y, z = contact.a.point
            print(f"{seconds:.4f} s: {contact.a.link} meets the {contact.b.object} "
                  f"at ({x:.3f}, {y:.3f}, {z:.3f})")
            contacts += 1
    world.forget_before(until)
    answered = until
    windows += 1
print(f"{contacts} contacts in {windows} windows")

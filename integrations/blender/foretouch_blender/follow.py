"""From enter to leave: what touches what, and when, in frames. Nothing here knows Blender."""

from dataclasses import dataclass

import numpy as np

FRAME_US = 100_000
"""World time of a frame, whatever it takes: so that each begins at a whole number of microseconds.
`foretouch replay` has the same, so that the two agree to the last digit."""
PROPS = 1
"""The group of what moves beside the body."""


@dataclass
class Touch:
    link: str
    object: str
    begin: float
    """In frames of the scene."""
    end: float
    is_known: bool
    """False: nothing is claimed in this time."""
    begins_inside: bool
    is_open: bool
    """It goes on where the frames end."""
    point: np.ndarray
    """(3,), metres, y up, on the object where it begins."""
    normal: np.ndarray
    """(3,), from the object to the link; zero where there is none."""
    separation: float
    penetration: float
    approach: float
    """Metres per second."""


class Following:
    """One body among what stands still and what moves."""

    def __init__(self, ft, avatar, still, props, tolerance, frames):
        """`props`: names and scenes; `frames`: a motion.Range."""
        self.world = ft.World(still, tolerance=tolerance)
        self.body = self.world.add(avatar)
        self.props = [self.world.add(scene, group=PROPS) for _, scene in props]
        self.names = {body: name for body, (name, _) in zip(self.props, props)}
        # What they do to each other, and to what stands still, is not asked here.
        self.world.ask(PROPS, PROPS, False)
        if still is not None:
            self.world.ask_still(PROPS, False)
        self.follower = ft.Follower(self.world, 0)
        self.frames, self.pushed = frames, 0
        self.touches, self.live = [], {}

    def push(self, pose, places):
        """The pose of the next frame, and where each prop is then."""
        self.world.push(self.body, self.pushed * FRAME_US, pose)
        for prop, place in zip(self.props, places):
            self.world.push(prop, self.pushed * FRAME_US, place)
        self.pushed += 1

    def follow(self):
        """Everything that was pushed."""
        until = (self.pushed - 1) * FRAME_US
        for event in self.follower.follow(until).events:
            self._take(event)
        self.world.forget_before(until)

    def finish(self):
        last = float(self.frames.last)
        for touch in self.live.values():
            touch.end, touch.is_open = last, True
        self.live.clear()
        self.touches.sort(key=lambda touch: (touch.begin, touch.link, touch.object))
        return self.touches

    def _take(self, event):
        if event.kind in ("leave", "unresolved_to"):
            self._end(event)
        if event.kind in ("enter", "starts_inside", "unresolved_from"):
            self._begin(event)

    def _begin(self, event):
        mine, other = self._sides(event)
        sign = 1.0 if mine is event.a else -1.0
        seconds = self.frames.seconds_per_frame * 1e6 / FRAME_US  # of a second of the world
        begin = self._frame(event.time_us, event.fraction)
        touch = Touch(mine.link, self._object(other), begin, begin, event.kind != "unresolved_from",
                      event.kind == "starts_inside", False, np.array(other.point),
                      sign * np.array(event.normal), event.separation, event.penetration,
                      event.approach_speed / seconds)
        self.live[self._key(event)] = touch
        self.touches.append(touch)

    def _end(self, event):
        touch = self.live.pop(self._key(event), None)
        if touch is not None:
            touch.end = self._frame(event.time_us, event.fraction)

    def _key(self, event):
        mine, other = self._sides(event)
        return event.kind.startswith("unresolved"), mine.link_id, other.body, other.object

    def _sides(self, event):
        return (event.a, event.b) if event.a.body == self.body else (event.b, event.a)

    def _object(self, side):
        if side.body is None or side.body in self.names:
            return self.names.get(side.body) or side.object or "anything"
        return "anything"

    def _frame(self, time_us, fraction):
        step = min(time_us // FRAME_US, self.frames.last - self.frames.first - 1)
        return self.frames.first + step + ((time_us - step * FRAME_US) + fraction) / FRAME_US

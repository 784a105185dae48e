"""From enter to leave: what touches what, and when, in frames. Nothing here knows Blender."""

from dataclasses import dataclass
from typing import NamedTuple, Optional

import numpy as np

FRAME_US = 100_000
"""World time of a frame, whatever it takes: so that each begins at a whole number of microseconds.
`foretouch replay` has the same, so that the two agree to the last digit."""
PROPS = 1
"""The group of what moves beside the body."""


class Instant(NamedTuple):
    """A whole frame of the scene, and the share of the way to the next one. Apart, no digit is lost."""

    whole: int
    share: float

    @property
    def frame(self):
        return self.whole + self.share


@dataclass
class Touch:
    link: str
    object: str
    begin: Instant
    end: Instant
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
    penetration: Optional[float]
    approach: float
    """Metres per second."""


class Following:
    """One body among what stands still and what moves."""

    def __init__(self, ft, avatar, still, props, tolerance, frames, whole_frames=True):
        """`props`: names and scenes; `frames`: a motion.Range. `whole_frames`: no other pose is pushed."""
        self.world = ft.World(still, tolerance=tolerance)
        self.body = self.world.add(avatar)
        self.props = [self.world.add(scene, group=PROPS) for _, scene in props]
        self.names = {body: name for body, (name, _) in zip(self.props, props)}
        # What they do to each other, and to what stands still, is not asked here.
        self.world.ask(PROPS, PROPS, False)
        if still is not None:
            self.world.ask_still(PROPS, False)
        self.follower = ft.Follower(self.world, 0)
        self.steps = _Steps(ft, avatar, still, tolerance) if still and whole_frames else None
        self.frames, self.now = frames, 0
        self.touches, self.live = [], {}

    def push(self, instant, pose, places):
        """The next pose, at a frame of the scene, and where each prop is then."""
        self.now = round((instant - self.frames.first) * FRAME_US)
        self.world.push(self.body, self.now, pose)
        for prop, place in zip(self.props, places):
            self.world.push(prop, self.now, place)
        if self.steps is not None:
            self.steps.poses[int(instant) - self.frames.first] = pose

    def follow(self):
        """Everything that was pushed."""
        for event in self.follower.follow(self.now).events:
            self._take(event)
        self.world.forget_before(self.now)
        if self.steps is not None:
            self.steps.forget_before(self.now // FRAME_US)

    def finish(self):
        for touch in self.live.values():
            touch.end, touch.is_open = Instant(self.frames.last - 1, 1.0), True
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
        begin = self._instant(event.time_us, event.fraction)
        touch = Touch(mine.link, self._object(other), begin, begin, event.kind != "unresolved_from",
                      event.kind == "starts_inside", False, np.array(other.point),
                      sign * np.array(event.normal), event.separation, event.penetration,
                      event.approach_speed / seconds)
        if event.kind == "enter" and other.body is None and self.steps is not None:
            self._begin_as_its_step(touch)
        self.live[self._key(event)] = touch
        self.touches.append(touch)

    def _begin_as_its_step(self, touch):
        """A step's own answer may find the same contact at another instant, within the tolerance of it,
        and proven as well. As in `foretouch replay` the first touch of a pair in a step begins there."""
        step = touch.begin.whole - self.frames.first
        contact = self.steps.take(step, touch.link, touch.object)
        if contact is not None:
            touch.begin = Instant(touch.begin.whole, contact.toi)
            touch.point, touch.normal = contact.point, contact.normal
            touch.separation = contact.separation

    def _end(self, event):
        touch = self.live.pop(self._key(event), None)
        if touch is not None:
            touch.end = self._instant(event.time_us, event.fraction)

    def _key(self, event):
        mine, other = self._sides(event)
        return event.kind.startswith("unresolved"), mine.link_id, other.body, other.object

    def _sides(self, event):
        return (event.a, event.b) if event.a.body == self.body else (event.b, event.a)

    def _object(self, side):
        if side.body is None or side.body in self.names:
            return self.names.get(side.body) or side.object or "anything"
        return "anything"

    def _instant(self, time_us, fraction):
        step = min(time_us // FRAME_US, self.frames.last - self.frames.first - 1)
        return Instant(self.frames.first + step, ((time_us - step * FRAME_US) + fraction) / FRAME_US)


class _Steps:
    """The first contact of each link with each still object in a step, asked where it is needed."""

    def __init__(self, ft, avatar, still, tolerance):
        self.ft, self.avatar = ft, avatar
        self.query = ft.Query(avatar, still, tolerance=tolerance, scope="objects")
        self.poses, self.answers = {}, {}

    def take(self, step, link, thing):
        """Once; None if it is taken, or touched already where the step begins."""
        if step not in self.answers:
            motion = self.ft.Motion(self.avatar, self.poses[step], self.poses[step + 1])
            self.answers[step] = {
                (contact.link, contact.object): contact
                for contact in self.query.first_contacts(motion).objects
                if contact.verdict == self.ft.Verdict.CONTACT}
        return self.answers[step].pop((link, thing), None)

    def forget_before(self, step):
        for kept in (self.poses, self.answers):
            for old in [k for k in kept if k < step]:
                del kept[old]

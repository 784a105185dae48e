"""Plain data: the inputs and answers of queries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Optional, TypedDict, Union, overload

import numpy as np
import numpy.typing as npt

from foretouch._foretouch import (
    Avatar,
    BracketVerdict,
    InputError,
    Scene,
    SolidTick,
    Verdict,
)

Doubles = npt.NDArray[np.float64]


class Pose(NamedTuple):
    """Where every joint is, relative to its parent (roots: in the world)."""

    rotations: Doubles
    """(n, 4), unit quaternions in the order w, x, y, z."""
    translations: Doubles
    """(n, 3), metres."""


class Poses(Sequence[Pose]):
    """Many poses of one avatar, as two arrays. A slice is again a Poses, without a copy."""

    def __init__(self, rotations: npt.ArrayLike, translations: npt.ArrayLike) -> None:
        self.rotations: Doubles = np.asarray(rotations, dtype=np.float64)
        """(k, n, 4)"""
        self.translations: Doubles = np.asarray(translations, dtype=np.float64)
        """(k, n, 3)"""
        turns, places = self.rotations.shape, self.translations.shape
        if len(turns) != 3 or turns[2] != 4 or places != (*turns[:2], 3):
            raise InputError(
                f"Poses: expected the shapes (k, n, 4) and (k, n, 3), found {turns} and {places}"
            )

    @classmethod
    def stack(cls, poses: Sequence[Pose]) -> Poses:
        """Poses one after the other."""
        if not poses:
            raise InputError("Poses.stack: expected at least one pose")
        return cls(np.stack([p.rotations for p in poses]), np.stack([p.translations for p in poses]))

    def __len__(self) -> int:
        return int(self.rotations.shape[0])

    @overload
    def __getitem__(self, index: int) -> Pose: ...
    @overload
    def __getitem__(self, index: slice) -> Poses: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[Pose, Poses]:
        if isinstance(index, slice):
            return Poses(self.rotations[index], self.translations[index])
        return Pose(self.rotations[index], self.translations[index])

    def __iter__(self) -> Iterator[Pose]:
        return map(Pose, self.rotations, self.translations)

    def __repr__(self) -> str:
        return f"<foretouch.Poses: {len(self)} poses of {self.rotations.shape[1]} joints>"


class Edge(NamedTuple):
    """The answer to one edge. Metres, world."""

    verdict: Verdict
    free_until: float
    """Free on [0, free_until), never too late; 1: clear."""
    usable: bool
    """Clear, and both ends within the joints' limits."""
    link: Optional[str]
    """That meets something first; None: clear."""
    other: Optional[str]
    """The own link that it meets."""
    object: Optional[str]
    """What it meets of the scene, or of a prop."""
    point: Doubles
    """(3,), where; of a clear edge it says nothing."""
    prop: Optional[int]
    """The prop that it meets."""


@dataclass(frozen=True, eq=False)
class Clearances:
    """How near n edges of a robot come: an array of each part. Metres, world."""

    lower: Doubles
    """(n,): the edge never comes nearer; 0: it touches, or may."""
    upper: Doubles
    """(n,): at t it is no farther; inf: nothing comes within clearance_within."""
    t: Doubles
    """(n,): when, in [0, 1] of the edge."""
    links: npt.NDArray[np.int32]
    """(n,): what comes nearest; -1: nothing."""
    triangles: npt.NDArray[np.int32]
    """(n,): of the scene, or of the prop's; -1: none."""
    props: npt.NDArray[np.int32]
    """(n,): the prop that it is nearest to; -1: the scene."""
    alone: npt.NDArray[np.bool_]
    """(n,): no other place that was looked at is as near; so the slopes are the only ones."""
    link_points: Doubles
    """(n, 3): on the link."""
    scene_points: Doubles
    """(n, 3): on the triangle."""
    normals: Doubles
    """(n, 3): unit, from the scene to the link; 0: they meet."""
    slopes0: Optional[Doubles]
    """(n, coordinates): how upper changes with the edge's begin; None: not asked."""
    slopes1: Optional[Doubles]
    """(n, coordinates): how upper changes with its end."""

    def __len__(self) -> int:
        return len(self.lower)


@dataclass(frozen=True, eq=False, repr=False)
class Edges(Sequence[Edge]):
    """Answers to n edges of a robot: a sequence of Edge, and an array of each of its parts.

    Metres, world; of clear edges the last five arrays say nothing.
    """

    verdicts: npt.NDArray[np.uint8]
    """(n,), each a Verdict."""
    free_until: Doubles
    """(n,): free on [0, free_until), never too late; 1: clear."""
    usable: npt.NDArray[np.bool_]
    """(n,): clear, and both ends within the joints' limits."""
    links: npt.NDArray[np.int32]
    """(n,), that meet something; -1: none."""
    others: npt.NDArray[np.int32]
    """(n,), the own link that is met; -1: the scene, or nothing."""
    triangles: npt.NDArray[np.int32]
    """(n,), of the scene, or of the prop's; -1: none."""
    points: Doubles
    """(n, 3), where."""
    props: npt.NDArray[np.int32]
    """(n,), the prop that is met; -1: none."""
    avatar: Avatar
    """The robot's, for names."""
    scenes: Sequence[Scene]
    """The scene, then those of the props."""

    def __len__(self) -> int:
        return len(self.verdicts)

    @overload
    def __getitem__(self, index: int) -> Edge: ...
    @overload
    def __getitem__(self, index: slice) -> Edges: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[Edge, Edges]:
        if isinstance(index, slice):
            return Edges(
                self.verdicts[index],
                self.free_until[index],
                self.usable[index],
                self.links[index],
                self.others[index],
                self.triangles[index],
                self.points[index],
                self.props[index],
                self.avatar,
                self.scenes,
            )
        names, link, other = self.avatar.names, int(self.links[index]), int(self.others[index])
        place = slice(index, index + 1 if index != -1 else None)
        prop, object_ = int(self.props[index]), int(self._objects_of(place)[0])
        return Edge(
            Verdict(int(self.verdicts[index])),
            float(self.free_until[index]),
            bool(self.usable[index]),
            names[link] if link >= 0 else None,
            names[other] if other >= 0 else None,
            self.scenes[prop + 1].object_names[object_] if object_ >= 0 else None,
            self.points[index],
            prop if prop >= 0 else None,
        )

    def _objects_of(self, index: slice) -> npt.NDArray[np.int32]:
        """Of the scene or the prop that is met; -1: none."""
        triangles, others, props = self.triangles[index], self.others[index], self.props[index]
        objects = np.full(len(triangles), -1, dtype=np.int32)
        for prop, scene in enumerate(self.scenes, -1):
            met = (props == prop) & (others < 0) & (triangles >= 0)
            if np.any(met):
                objects[met] = scene.object_of[triangles[met]]
        return objects

    def __repr__(self) -> str:
        return f"<foretouch.Edges: {self._counts()}>"

    def _counts(self) -> str:
        counts = (int(np.sum(self.verdicts == verdict)) for verdict in Verdict)
        told = [f"{n} {verdict.name}" for n, verdict in zip(counts, Verdict) if n > 0]
        return f"{len(self)} edges" + (": " + ", ".join(told) if told else "")

    def describe(self, most: int = 10) -> str:
        """How many edges meet what first, most frequent first; advice where all start so."""
        lines = [self._counts()]
        met = np.flatnonzero(self.links >= 0)
        keys = np.stack(
            [
                self.verdicts[met].astype(np.int32),
                self.links[met],
                self.others[met],
                self.props[met],
                self._objects_of(slice(None))[met],
            ],
            axis=1,
        )
        _, first, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
        order = np.lexsort((first, -counts))
        for place in order[:most].tolist():
            edge = self[int(met[first[place]])]
            lines.append(f"{counts[place]} {edge.verdict.name}: {_meeting(edge)}")
        if len(order) > most:
            lines.append(f"and {len(order) - most} more")
        if len(order) > 0 and counts[order[0]] == len(self):
            lines += _advice(self[0])
        return "\n".join(lines)


def _meeting(edge: Edge) -> str:
    if edge.other is not None:
        return f"link {edge.link!r} and own link {edge.other!r}"
    if edge.object is None:
        return f"link {edge.link!r}"
    place = "" if edge.prop is None else f" of prop {edge.prop}"
    return f"link {edge.link!r} and {edge.object!r}{place}"


def _advice(edge: Edge) -> list[str]:
    """Of edges that all meet the same."""
    if edge.verdict != Verdict.STARTS_IN_CONTACT or edge.prop is not None:
        return []
    if edge.other is not None:
        return [
            f"All edges start with {_meeting(edge)} in contact; if the two may touch, leave the "
            f"pair out of the PairRules: leave_out=[({edge.link!r}, {edge.other!r})]"
        ]
    return [
        f"All edges start with {_meeting(edge)} in contact; if it stands there, as a base does, "
        f"ignore the pair: EdgeQuery(..., ignore=[({edge.link!r}, {edge.object!r})])"
    ]


class CertifiedEdges(NamedTuple):
    """What EdgeQuery.certify() found, and wrote."""

    answers: Edges
    proven: npt.NDArray[np.bool_]
    """(n,): the certificate proves that the edge is clear. Not where it is clear, but comes so near
    to something that no proof was found."""
    num_spans: int
    num_planes: int
    num_bytes: int
    """Of certificate.txt."""


class NearFeatures(NamedTuple):
    """The k places where links are near the scene, by link, LSS, gap and triangle. Metres, world."""

    links: npt.NDArray[np.int32]
    """(k,), as the next two."""
    lss: npt.NDArray[np.int32]
    """Which of the link's LSS."""
    triangles: npt.NDArray[np.int32]
    features: list[str]
    """'face', 'edge' or 'vertex' of the triangle."""
    along: Doubles
    """(k,), of the axis' nearest point: from its end a (0) to b (1)."""
    gaps: Doubles
    """(k,), lower bounds on the separation; below 0 where the two overlap."""
    points: Doubles
    """(k, 3), on the triangles."""
    on_links: Doubles
    """(k, 3), on the LSS."""
    normals: Doubles
    """(k, 3), unit, from the scene to the link; 0 where the two meet without one."""
    had_more: list[int]
    """Links near more than a reduced answer keeps: the nearest are here."""


class LinkBound(NamedTuple):
    """How far every point of a link's axes may be from where the model of the motion has it: a
    claim of yours. Metres, seconds; infinity: nothing is claimed."""

    error: float = 0.0
    """Of a pose, m."""
    acceleration: float = np.inf
    """Of person minus model within a step, m/s^2."""
    follow_floor: float = np.inf
    """Instead, if less: a length, m, and"""
    follow_share: float = 0.0
    """a share of how much the poses around the step bend there."""
    speed: float = np.inf
    """Of the person where poses were lost, m/s."""
    ahead_speed: float = 0.0
    """After the last pose, of person minus model: m/s, and"""
    ahead_acceleration: float = np.inf
    """m/s^2."""


class PairBracket(NamedTuple):
    """Two own links that are not proven apart in a step."""

    step: int
    link: str
    other: str
    """Above it in the skeleton."""
    verdict: BracketVerdict
    possible: tuple[float, float]
    """Apart before and after, t of the step."""
    certain: Optional[tuple[float, float]]
    """They touched at both instants."""


class Brackets(NamedTuple):
    """What a person touched in k steps, by link, whatever they did within the bounds."""

    verdicts: npt.NDArray[np.uint8]
    """(k, n), a BracketVerdict each."""
    possible: Doubles
    """(k, n, 2), t of the step: nothing is touched before the first and after the second; NaN
    where nothing is touched or claimed."""
    certain: Doubles
    """(k, n, 2): something is touched at both; or, where the second comes first, at an instant
    between the two, at which the link passed through a surface. NaN where the verdict is not
    CERTAIN."""
    triangles: npt.NDArray[np.int32]
    """(k, n), of the scene, what is, or may be, touched first; -1: none, or not known."""
    growths: Doubles
    """(k, n), the largest distance between person and model, m."""
    pairs: list[PairBracket]
    """Own links, if asked: every pair that is not excluded."""


class ContactPoint(NamedTuple):
    """Two points, one of each side, that are near when a contact is made. Metres, world frame."""

    point: Doubles
    """(3,), on the scene, or on the other link."""
    on_link: Doubles
    separation: float
    """As computed; below 0 where the two overlap."""
    triangle: Optional[int]
    """Of the scene, or of the other link's mesh; None for its LSS."""
    lss: Optional[int]
    """Which of the link's LSS; None for a triangle."""
    link_triangle: Optional[int]
    """Which of the link's triangles; None for an LSS."""


class ContactDetails(NamedTuple):
    """More about a contact, at its toi. Velocities in metres per unit of t: divide by the step's
    seconds."""

    velocity: Doubles
    """(3,), of the material point at `Contact.point`; zero for the scene."""
    velocity_of_link: Doubles
    """(3,), the same at `Contact.on_link`."""
    approach_speed: float
    """Along the normal, above 0 while the two approach; 0 without a normal."""
    approach_lower: float
    """If these two points touch in the rest of the step, within the tolerance from here, they do so
    at a speed between this and the next, along this normal. Below 0: perhaps they never touch."""
    approach_upper: float
    points: list[ContactPoint]
    """Up to four that are within the tolerance: the nearest first, then points far from it and from
    each other. At fidelity 'link' and 'exact'; elsewhere there are none."""


class Lss(NamedTuple):
    """A line-swept sphere: all points within `radius` of the segment from `a` to `b`. Metres."""

    a: Doubles
    b: Doubles
    radius: float


class LeftOutPair(NamedTuple):
    """Two own links that no query asks whether they touch: nothing is said of them."""

    a: str
    b: str
    reason: str
    """'adjacent', 'rest-overlap', 'always' or 'user'."""


class PairTouches(NamedTuple):
    """In how many of the usual poses two own links touch: PairRules.num_usual_poses."""

    a: str
    b: str
    touches: int


class PairRadius(NamedTuple):
    """Two LSS of own links whose sum of radii counts as `radius`. Metres."""

    a: str
    lss_a: int
    b: str
    lss_b: int
    radius: float


class JointMatch(NamedTuple):
    """Which joint of a clip drives which joint of an avatar."""

    clip_joint_of: list[int]
    """Per joint of the avatar, the clip's joint; -1 if the clip has none."""
    unmatched_avatar: list[str]
    """They keep their rest values."""
    unmatched_clip: list[str]
    """They drive nothing."""


class SceneAudit(NamedTuple):
    """Facts about a scene that its user may want to know. Metres."""

    triangles: int
    dropped_non_finite: int
    zero_area: int
    duplicates: int
    box_min: Doubles
    box_max: Doubles
    shortest_edge: float
    longest_edge: float


class SweptSurface(NamedTuple):
    """A closed surface around (or within) the volume that a link sweeps. Metres, world frame.

    It may pass through itself: it encloses the points that it winds around at least once. An inner
    surface of LSS that are too thin for its error is empty."""

    vertices: Doubles
    """(v, 3)"""
    triangles: npt.NDArray[np.uint32]
    """(m, 3), counter-clockwise seen from outside."""
    certified_error: float
    """No enclosed point is further from the swept volume (inner: the other way round)."""
    times: Doubles
    """(v,): when the link is there: the motion's number plus t."""
    pieces: int


class SolidContact(NamedTuple):
    """A place where a surface holds a solid avatar from its tracked pose. Metres, world frame."""

    link: str
    link_id: int
    lss: int
    """Which of the link's LSS."""
    triangle: Optional[int]
    """Of the scene; None if another own link is touched."""
    object: Optional[str]
    """The name of the triangle's object."""
    other: Optional[str]
    """That own link."""
    point: Doubles
    """(3,), on the surface that is touched."""
    normal: Doubles
    """(3,), unit, from that surface to the link."""
    gap: float
    push: float
    """How hard the tracked pose presses, >= 0 (m). Times a stiffness (N/m) it is the force along
    `normal` with which a haptic device holds the hand."""
    slip_speed: float
    """Of the link's point along the surface, m/s."""


class SolidBodyContact(NamedTuple):
    """A moving body that holds or pushes a solid avatar. Metres, world frame."""

    body: int
    link: str
    """The avatar's."""
    link_id: int
    lss: int
    """Of the link's LSS; those of tools in its hand come after its own."""
    triangle: Optional[int]
    """Of a mesh."""
    object: Optional[str]
    """The name of the triangle's object."""
    point: Doubles
    """(3,), on the body's surface."""
    normal: Doubles
    """(3,), unit, from it to the avatar."""
    gap: float
    push: float
    """As of SolidContact; what the body's own motion adds is in it."""
    slip_speed: float
    """Of the link's point along that surface, which moves, m/s."""


class SolidCrush(NamedTuple):
    """A body that nobody holds back has left a solid avatar no proven way: between the two nothing
    is claimed from `since_us` on. Everything else stays proven."""

    body: int
    link: str
    """Where it was met; while they overlap, the link that is deepest."""
    link_id: int
    since_us: int
    is_over: bool
    """It ended at the tick's begin, where the two are proven apart; told once."""
    depth: float
    """Of a link's axis below the body's surface at the tick's end, metres; 0: no overlap there."""


class SolidBodyTick(NamedTuple):
    """What a solid avatar among moving bodies shows at one tick, and what they do to it."""

    body: int
    tick: SolidTick
    """As of a SolidAvatar; its contacts are those with what is still and with own links. Moving
    bodies are part of what it proves."""
    contacts: list[SolidBodyContact]
    crushes: list[SolidCrush]
    tools: list[int]
    """What its hands hold and is solid with it."""
    loose_tools: list[int]
    """What they hold, and touched something where it was taken: nothing is claimed of it yet."""
    let_go: list[int]
    """What they let go of and still touch: the two are not asked until they are apart."""
    is_assumed: bool
    """A body around it was silent, and was taken to hold still or to be nowhere."""


class ContactSide(NamedTuple):
    """One of the two that meet in a world."""

    body: Optional[int]
    """None: what stands still."""
    link: Optional[str]
    """Its name; None for a mesh and for what stands still."""
    link_id: Optional[int]
    """0 for a mesh and for what stands still; None: every link without a contact of its own."""
    lss: Optional[int]
    """Which of the link's LSS; None for a triangle."""
    triangle: Optional[int]
    """Of the mesh, or of what stands still; None for an LSS."""
    object: Optional[str]
    """The name of the triangle's object."""
    point: Doubles
    """(3,), on its surface."""


class WorldContact(NamedTuple):
    """The first contact of two links in a window of a world. Metres, world frame."""

    verdict: Verdict
    """CONTACT; STARTS_IN_CONTACT: they touch where the window begins, or where one of them appears
    or is attached; UNDECIDED: free until then, nothing claimed after it."""
    reason: Optional[str]
    """Of UNDECIDED."""
    time_us: int
    """Whole microseconds, rounded down: never later than the first touch."""
    fraction: float
    """Of one microsecond more, in [0, 1)."""
    a: ContactSide
    """The body with the lower number, or of one body the lower link; what stands still is b."""
    b: ContactSide
    separation: float
    penetration: Optional[float]
    """Of STARTS_IN_CONTACT; None if it is not known, as of triangles, which have no inside."""
    normal: Doubles
    """(3,), unit, from b to a."""
    is_assumed: bool
    """It rests on a body that was silent, and was taken to hold still."""


class SilentBody(NamedTuple):
    """A body of which nothing was known in the rest of a window."""

    body: int
    since_us: int
    """Its last pose, or the window's begin."""
    taken_to: str
    """'hold-still' or 'undecided'."""


class WorldContacts(NamedTuple):
    """What a world answers about a window. Pairs that were asked and are not listed are proven clear,
    except of silent bodies that are undecided, and of what these carry."""

    contacts: list[WorldContact]
    """The earliest first; at equal times by a's body and link, then by b's."""
    silent: list[SilentBody]
    counters: dict[str, int]
    """Work done, by kind."""


class EventPoint(NamedTuple):
    """Two points, one of each side, that are near at an event's instant. World frame."""

    a: Doubles
    b: Doubles
    separation: float
    """Metres; below zero where the two overlap."""


class WorldEvent(NamedTuple):
    """One thing that happens to two links, or to a link and an object of a mesh or of what stands
    still. Metres, seconds, kilograms, world frame."""

    kind: str
    """'enter': the two were free. 'leave': they are, from here on. 'starts_inside': they are in
    contact where they are known first. 'unresolved_from', 'unresolved_to': nothing is claimed."""
    time_us: int
    """Whole microseconds. An enter is never later than it is, a leave never earlier."""
    fraction: float
    """Of one microsecond more, in [0, 1)."""
    since_us: int
    """When that began which ends here; else as the time."""
    since_fraction: float
    a: ContactSide
    b: ContactSide
    """Of what is unresolved its body may be EVERY_BODY: whatever a is asked about."""
    separation: float
    penetration: Optional[float]
    """As in WorldContact."""
    normal: Doubles
    """(3,), unit, from b to a; zero if none is told."""
    velocity: Doubles
    """(3,), of a's point less b's, m/s."""
    approach_speed: float
    """Along the normal, above zero while the two approach, m/s."""
    approach_lower: float
    """If these two points touch, they do so at a speed between this one and the next. Below zero: a
    graze, perhaps."""
    approach_upper: float
    effective_mass: float
    """Along the normal, of those that were weighed; infinite if neither was."""
    points: list[EventPoint]
    """Up to four, the nearest first."""
    reason: Optional[str]
    """Of what is unresolved."""
    is_not_asked: bool
    """Of a leave: the two are not known to be apart; one carries the other, or ask() says so."""
    is_assumed: bool
    is_moved: bool
    """Of a leave: one of the two, or who carries it, is put elsewhere there, with a jump. Where
    is_moved or is_not_asked is true, all places and speeds are the last ones before."""


class WorldPart(NamedTuple):
    """What two do in a part of the time. Everything else is free: proven."""

    kind: str
    """'contact': at most twice the tolerance apart throughout. 'unresolved': nothing is claimed."""
    from_us: int
    from_fraction: float
    to_us: int
    to_fraction: float
    since_us: int
    """When it began: at its begin or before."""
    since_fraction: float
    a: ContactSide
    b: ContactSide
    reason: Optional[str]
    began_before: bool
    goes_on: bool
    """It ends where the time that was asked does."""
    is_assumed: bool


class OpenPart(NamedTuple):
    """A contact, or something unresolved, that has not ended."""

    kind: str
    since_us: int
    since_fraction: float
    a: ContactSide
    b: ContactSide
    reason: Optional[str]
    is_assumed: bool


class WorldEvents(NamedTuple):
    """What happened from one Follower.follow() to the next, or from one SolidWorld.follow()."""

    from_us: int
    to_us: int
    events: list[WorldEvent]
    """The earliest first; at one instant what ends comes before what begins."""
    parts: list[WorldPart]
    """By pair, then by time."""
    silent: list[SilentBody]


class TriggerEvent(NamedTuple):
    """Who enters or leaves a trigger. An enter is never later than it is, a leave never earlier."""

    kind: str
    """'enter', 'leave', 'starts_inside', 'unresolved_from' or 'unresolved_to'."""
    trigger: int
    body: int
    link: Optional[int]
    """Which enters or leaves; None: none by itself."""
    time_us: int
    fraction: float
    """Of one microsecond more, in [0, 1)."""
    since_us: int
    """When that began which ends here; else as the time."""
    since_fraction: float
    is_assumed: bool
    """It rests on a body that was silent, and was taken to hold still."""


class Occupant(NamedTuple):
    """Who is inside a trigger, or may be."""

    trigger: int
    body: int
    link: Optional[int]
    """Of a trigger that looks at each link by itself."""
    is_unresolved: bool
    since_us: int
    since_fraction: float


class Depth(NamedTuple):
    """How deep a body is in another at an instant. Metres, world frame."""

    lower: float
    """No translation shorter than this clears."""
    upper: float
    """Infinite if no way out could be certified."""
    way_out: Doubles
    """(3,): moved by it, the body is proven clear; not longer than upper."""
    is_certified: bool
    num_pairs: int
    """Of pieces that have, or may have, a point in common."""
    is_assumed: bool


class WorldHit(NamedTuple):
    """What a shape hit, or is near to. Metres, world frame."""

    distance: float
    """Of a cast: along the way. Else how far the two are apart. Rounded down."""
    what: ContactSide
    """Whom; its point is on that one's surface."""
    normal: Doubles
    """(3,): unit, to the shape; zero if none is told."""
    weights: Optional[Doubles]
    """(3,): of a triangle: the point as a sum of its corners."""
    is_assumed: bool
    """It rests on a body that was silent, and was taken to hold still."""


class UnknownBody(NamedTuple):
    """A body that was asked about, and is not known at the instant; or an object that has no inside."""

    body: Optional[int]
    """None: what stands still."""
    why: str
    """'assumed' (taken to hold still), or 'silent', 'not_there' or 'unresolved': it was left out. Of
    solids, 'open': it is not closed."""
    object: Optional[int]
    """Of one that is open; None of a link's surface."""


class WorldAnswer(NamedTuple):
    """What World.probe() found."""

    verdict: str
    """'hit', 'clear' (proven) or 'unknown': nothing that is known is hit or near."""
    hits: list[WorldHit]
    """Nearest first."""
    unknown: list[UnknownBody]
    is_complete: bool
    """All that was asked about is known."""


class WorldAnswers(NamedTuple):
    """What World.probe_many() found: one row per question, of its first hit. Without one, numbers
    are NaN and indices are -1."""

    verdict: npt.NDArray[np.uint8]
    """0 clear (proven), 1 hit, 2 unknown."""
    distance: Doubles
    body: npt.NDArray[np.int32]
    """-1 too of what stands still."""
    link: npt.NDArray[np.int32]
    lss: npt.NDArray[np.int32]
    triangle: npt.NDArray[np.int32]
    object: npt.NDArray[np.int32]
    point: Doubles
    """(n, 3), as the next two."""
    normal: Doubles
    weights: Doubles
    is_assumed: npt.NDArray[np.bool_]
    is_complete: npt.NDArray[np.bool_]
    """All that was asked about is known."""


class FlightAnswer(NamedTuple):
    """What World.fly() found: the first hit of all."""

    verdict: str
    """'hit', 'clear' (proven) or 'unknown'."""
    hit: Optional[WorldHit]
    time_us: Optional[int]
    """Never later than it is."""
    fraction: Optional[float]
    """Of one microsecond more, in [0, 1)."""
    unknown: list[UnknownBody]
    """Bodies that are not known all through."""


class Policy(TypedDict, total=False):
    """What one link has for itself, or with one object. What is missing is as for all links."""

    tolerance: float
    fidelity: str
    """Of a link, not of a pair: a link has one surface for all objects."""
    ignore: bool
    """False: no longer ignored."""


LinkLike = Union[str, int]
"""A link's name or index."""
LinkPairLike = tuple[LinkLike, LinkLike]
"""Two links, in either order."""
LeftOutLike = Union[LinkPairLike, tuple[LinkLike, LinkLike, str]]
"""Two links, and why they are left out; "user" if nothing says why."""
PairRadiusLike = tuple[LinkLike, int, LinkLike, int, float]
"""Two links, each with the number of its LSS, and the sum of radii that counts for the two."""
IgnoredLike = Union[LinkLike, tuple[LinkLike, Union[str, int]]]
"""A link, or a link and an object (its name or index), whose contacts the query ignores."""
PolicyKey = Union[LinkLike, tuple[LinkLike, Union[str, int]]]
"""A link, or a link and an object (its name or index), which have options of their own."""
PoseLike = Union[Pose, tuple[npt.ArrayLike, npt.ArrayLike]]
"""Rotations (n, 4) and translations (n, 3)."""
PosesLike = Union[Poses, tuple[npt.ArrayLike, npt.ArrayLike]]
"""Rotations (k, n, 4) and translations (k, n, 3)."""

"""The compiled half of the package, as type checkers see it. tests/bindings/python/test_stubs.py
compares it with the module, name by name; `./run python-types` does so with mypy's stubtest."""

import enum
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn, Optional, Union, overload

import numpy as np
import numpy.typing as npt

from foretouch._types import (
    Brackets,
    CertifiedEdges,
    Clearances,
    ContactDetails,
    Depth,
    Doubles,
    Edges,
    FlightAnswer,
    IgnoredLike,
    JointMatch,
    LeftOutLike,
    LeftOutPair,
    LinkBound,
    LinkLike,
    LinkPairLike,
    Lss,
    NearFeatures,
    Occupant,
    OpenPart,
    PairRadius,
    PairRadiusLike,
    PairTouches,
    Policy,
    PolicyKey,
    Pose,
    PoseLike,
    Poses,
    PosesLike,
    SceneAudit,
    SolidBodyTick,
    SolidContact,
    SweptSurface,
    TriggerEvent,
    WorldAnswer,
    WorldAnswers,
    WorldContacts,
    WorldEvents,
)

_Path = Union[str, bytes, os.PathLike[str], os.PathLike[bytes]]
_LssLike = Union[Lss, tuple[npt.ArrayLike, npt.ArrayLike, float]]

__version__: str
EVERY_BODY: int

class Error(Exception):
    code: Optional[str]
    file: Optional[str]
    line: Optional[int]
    index: Optional[int]

class InputError(Error, ValueError): ...
class ResourceError(Error, OSError): ...

class Verdict(enum.IntEnum):
    CLEAR = 0
    CONTACT = 1
    STARTS_IN_CONTACT = 2
    UNDECIDED = 3

class SolidState(enum.IntEnum):
    PLACING = 0
    EQUAL = 1
    FOLLOWING = 2
    SLIDING = 3
    HELD = 4
    AROUND = 5
    SNAPPED = 6

class SolidJointState(enum.IntEnum):
    FREE = 0
    SLIDING = 1
    HELD = 2
    LOST = 3

class Scene:
    @staticmethod
    def from_arrays(
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        object_of: Optional[npt.ArrayLike] = None,
        object_names: Optional[Sequence[str]] = None,
    ) -> Scene: ...
    @staticmethod
    def load(
        path: _Path,
        scale: Optional[float] = None,
        up: Optional[str] = None,
        *,
        importer: Optional[_Path] = None,
        time_limit_s: float = 60.0,
        memory_limit_bytes: int = 8589934592,
    ) -> Scene: ...
    @property
    def num_triangles(self) -> int: ...
    @property
    def triangles(self) -> Doubles: ...
    @property
    def object_of(self) -> npt.NDArray[np.int32]: ...
    @property
    def object_names(self) -> list[str]: ...
    @property
    def audit(self) -> SceneAudit: ...

class Avatar:
    @staticmethod
    def load(path: _Path) -> Avatar: ...
    @staticmethod
    def from_arrays(
        names: Sequence[str],
        parents: npt.ArrayLike,
        offsets: npt.ArrayLike,
        rotations: Optional[npt.ArrayLike],
        lss: Sequence[Sequence[_LssLike]],
    ) -> Avatar: ...
    @staticmethod
    def from_bvh(path: _Path, scale: float = 1.0, *, radius_scale: float = 1.0) -> Avatar: ...
    @staticmethod
    def from_clip(clip: Clip, *, radius_scale: float = 1.0) -> Avatar: ...
    def save(self, path: _Path) -> None: ...
    def link(self, name: LinkLike) -> int: ...
    def rest_pose(self) -> Pose: ...
    @property
    def num_links(self) -> int: ...
    @property
    def num_lss(self) -> int: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def link_names(self) -> list[str]: ...
    @property
    def parents(self) -> npt.NDArray[np.int32]: ...
    @property
    def lss(self) -> list[list[Lss]]: ...
    def __len__(self) -> int: ...

class Surface:
    @staticmethod
    def load(avatar: Avatar, avatar_path: _Path, *, importer: Optional[_Path] = None) -> Surface: ...
    @staticmethod
    def from_triangles(
        avatar: Avatar, triangles: Sequence[Optional[npt.ArrayLike]]
    ) -> Surface: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def num_triangles(self) -> int: ...
    def triangles(self, link: LinkLike) -> Doubles: ...

class Skin:
    @staticmethod
    def from_arrays(
        avatar: Avatar,
        triangles: npt.ArrayLike,
        triangle_links: npt.ArrayLike,
        links: npt.ArrayLike,
        weights: npt.ArrayLike,
        points: npt.ArrayLike,
    ) -> Skin: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def num_triangles(self) -> int: ...

class PairRules:
    @staticmethod
    def derive(
        avatar: Avatar,
        *,
        usual_poses: Optional[PosesLike] = None,
        always_share: float = 0.95,
        pair_radii: bool = False,
        rest_skin: float = 0.002,
        leave_out: Sequence[LinkPairLike] = (),
    ) -> PairRules: ...
    @staticmethod
    def of_robot(
        robot: Robot,
        *,
        samples: int = 10000,
        seed: int = 1,
        always_share: float = 0.95,
        leave_out: Sequence[LinkPairLike] = (),
    ) -> PairRules: ...
    @staticmethod
    def leaving_out(
        avatar: Avatar,
        left_out: Sequence[LeftOutLike],
        radii: Sequence[PairRadiusLike] = (),
    ) -> PairRules: ...
    @staticmethod
    def asking(avatar: Avatar, asked: Sequence[LinkPairLike]) -> PairRules: ...
    @staticmethod
    def exactly(
        avatar: Optional[Avatar],
        left_out: Sequence[LeftOutLike],
        radii: Sequence[PairRadiusLike] = (),
    ) -> NoReturn: ...
    @staticmethod
    def load(path: _Path, avatar: Avatar) -> PairRules: ...
    def save(self, path: _Path) -> None: ...
    def reason_of(self, a: LinkLike, b: LinkLike) -> str: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def num_pairs(self) -> int: ...
    @property
    def num_asked(self) -> int: ...
    @property
    def left_out(self) -> list[LeftOutPair]: ...
    @property
    def radii(self) -> list[PairRadius]: ...
    @property
    def num_usual_poses(self) -> int: ...
    @property
    def touches(self) -> list[PairTouches]: ...

class Clip:
    @staticmethod
    def load(
        path: _Path,
        scale: Optional[float] = None,
        *,
        up: Optional[str] = None,
        animation: str = "",
        rate_hz: float = 30.0,
        robot: Optional[_Path] = None,
        skeleton: Optional[_Path] = None,
        row_rate_hz: Optional[float] = None,
        importer: Optional[_Path] = None,
    ) -> Clip: ...
    def poses(
        self,
        avatar: Avatar,
        *,
        joint_map: Optional[dict[str, str]] = None,
        up: str = "y",
        origin: npt.ArrayLike = (0.0, 0.0, 0.0),
        yaw_deg: float = 0.0,
    ) -> Poses: ...
    def match(self, avatar: Avatar, *, joint_map: Optional[dict[str, str]] = None) -> JointMatch: ...
    @property
    def frame_time_s(self) -> float: ...
    @property
    def frames_per_row(self) -> int: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...
    def __len__(self) -> int: ...

class Motion:
    def __init__(self, avatar: Avatar, start: PoseLike, end: PoseLike) -> None: ...
    def transforms(self, t: npt.ArrayLike) -> Doubles: ...
    @overload
    def pose_at(self, t: float) -> Pose: ...
    @overload
    def pose_at(self, t: npt.ArrayLike) -> Union[Pose, Poses]: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def start(self) -> Pose: ...
    @property
    def end(self) -> Pose: ...

class Contact:
    @property
    def link(self) -> str: ...
    @property
    def link_id(self) -> int: ...
    @property
    def verdict(self) -> Verdict: ...
    @property
    def reason(self) -> Optional[str]: ...
    @property
    def toi(self) -> Optional[float]: ...
    @property
    def free_until(self) -> float: ...
    @property
    def separation(self) -> Optional[float]: ...
    @property
    def penetration(self) -> Optional[float]: ...
    @property
    def point(self) -> Optional[Doubles]: ...
    @property
    def on_link(self) -> Optional[Doubles]: ...
    @property
    def normal(self) -> Optional[Doubles]: ...
    @property
    def triangle(self) -> Optional[int]: ...
    @property
    def object(self) -> Optional[str]: ...
    @property
    def object_id(self) -> Optional[int]: ...
    @property
    def lss(self) -> Optional[int]: ...
    @property
    def link_triangle(self) -> Optional[int]: ...
    @property
    def link_feature(self) -> Optional[str]: ...
    @property
    def scene_feature(self) -> Optional[str]: ...
    def details(self) -> Optional[ContactDetails]: ...

class PairContact(Contact):
    @property
    def other(self) -> str: ...
    @property
    def other_id(self) -> int: ...
    @property
    def other_lss(self) -> Optional[int]: ...

class Step:
    @property
    def verdicts(self) -> npt.NDArray[np.uint8]: ...
    @property
    def toi(self) -> Doubles: ...
    @property
    def free_until(self) -> Doubles: ...
    @property
    def separation(self) -> Doubles: ...
    @property
    def penetration(self) -> Doubles: ...
    @property
    def triangles(self) -> npt.NDArray[np.int32]: ...
    @property
    def points(self) -> Doubles: ...
    @property
    def points_on_link(self) -> Doubles: ...
    @property
    def normals(self) -> Doubles: ...
    @property
    def link_names(self) -> list[str]: ...
    @property
    def contacts(self) -> list[Contact]: ...
    @property
    def pairs(self) -> Optional[list[PairContact]]: ...
    @property
    def objects(self) -> Optional[list[Contact]]: ...
    @property
    def is_clear(self) -> bool: ...
    @property
    def free_prefix(self) -> float: ...
    @property
    def counters(self) -> dict[str, int]: ...
    def __getitem__(self, link: LinkLike) -> Contact: ...
    def __len__(self) -> int: ...

class Steps:
    @property
    def verdicts(self) -> npt.NDArray[np.uint8]: ...
    @property
    def toi(self) -> Doubles: ...
    @property
    def free_until(self) -> Doubles: ...
    @property
    def separation(self) -> Doubles: ...
    @property
    def penetration(self) -> Doubles: ...
    @property
    def triangles(self) -> npt.NDArray[np.int32]: ...
    @property
    def points(self) -> Doubles: ...
    @property
    def points_on_link(self) -> Doubles: ...
    @property
    def normals(self) -> Doubles: ...
    @property
    def link_names(self) -> list[str]: ...
    def plot(
        self, axes: Optional[Any] = None, *, seconds_per_step: Optional[float] = None
    ) -> Any: ...
    def __getitem__(self, index: int) -> Step: ...
    def __len__(self) -> int: ...

class Query:
    def __init__(
        self,
        avatar: Avatar,
        scene: Scene,
        *,
        tolerance: float = 0.001,
        fidelity: str = "link",
        policies: Optional[Mapping[PolicyKey, Policy]] = None,
        ignore: Iterable[IgnoredLike] = (),
        work_budget: Optional[int] = None,
        deadline_us: Optional[float] = None,
        scope: str = "links",
        surface: Optional[Surface] = None,
        self_pairs: Optional[PairRules] = None,
        pass_separating: bool = False,
    ) -> None: ...
    def first_contacts(self, motion: Motion) -> Step: ...
    def first_contacts_many(
        self,
        poses: PosesLike,
        *,
        ends: Optional[PosesLike] = None,
        threads: Optional[int] = None,
    ) -> Steps: ...
    def touches_at(self, motion: Motion, t: npt.ArrayLike) -> npt.NDArray[np.bool_]: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def scene(self) -> Scene: ...

class NearQuery:
    def __init__(
        self, avatar: Avatar, scene: Scene, *, ignore: Iterable[IgnoredLike] = ()
    ) -> None: ...
    def answer(
        self, pose: PoseLike, reach: npt.ArrayLike, *, detail: str = "reduced"
    ) -> NearFeatures: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def scene(self) -> Scene: ...

class BracketVerdict(enum.IntEnum):
    UNCLAIMED = 0
    EXCLUDED = 1
    POSSIBLE = 2
    CERTAIN = 3

class BracketQuery:
    def __init__(
        self,
        avatar: Avatar,
        scene: Scene,
        *,
        fidelity: str = "link",
        surface: Optional[Surface] = None,
        ignore: Iterable[IgnoredLike] = (),
        self_pairs: Optional[PairRules] = None,
        resolution: float = 1e-05,
        work_budget: Optional[int] = None,
    ) -> None: ...
    def answer(
        self,
        poses: PosesLike,
        bounds: Union[LinkBound, Sequence[LinkBound]],
        *,
        seconds: float,
        between: str = "constant-rate",
    ) -> Brackets: ...
    def answer_gap(
        self,
        start: PoseLike,
        end: PoseLike,
        bounds: Union[LinkBound, Sequence[LinkBound]],
        *,
        seconds: float,
    ) -> Brackets: ...
    def look_ahead(
        self,
        start: PoseLike,
        end: PoseLike,
        bounds: Union[LinkBound, Sequence[LinkBound]],
        *,
        seconds: float,
        horizon: float,
    ) -> Brackets: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def scene(self) -> Scene: ...

def read_bounds(
    path: _Path, avatar: Avatar, *, between: str, rate_hz: float
) -> list[LinkBound]: ...

class SolidTick:
    @property
    def shown(self) -> Pose: ...
    @property
    def state(self) -> SolidState: ...
    @property
    def limit(self) -> Optional[str]: ...
    @property
    def is_certified(self) -> bool: ...
    @property
    def has_appeared(self) -> bool: ...
    @property
    def deviation(self) -> float: ...
    @property
    def lift(self) -> float: ...
    @property
    def clearance(self) -> float: ...
    @property
    def snap_in(self) -> Optional[float]: ...
    @property
    def joints(self) -> npt.NDArray[np.uint8]: ...
    @property
    def link_deviation(self) -> Doubles: ...
    @property
    def contacts(self) -> list[SolidContact]: ...
    @property
    def way(self) -> Poses: ...
    @property
    def times(self) -> Doubles: ...
    @property
    def counters(self) -> dict[str, int]: ...

class SolidAvatar:
    def __init__(
        self,
        avatar: Avatar,
        scene: Scene,
        *,
        skin: float = 0.002,
        tolerance: float = 0.0005,
        catch_up: float = 2.0,
        visibility: Optional[Mapping[LinkLike, float]] = None,
        floor: str = "lift",
        feet: Optional[Sequence[LinkLike]] = None,
        up: npt.ArrayLike = (0.0, 1.0, 0.0),
        most_lift: float = 0.1,
        most_deviation: float = 0.5,
        most_limb_deviation: float = 0.35,
        patience: float = 0.7,
        may_snap: bool = False,
        snap_notice: float = 0.25,
        around_per_tick: int = 64,
        around_in_all: int = 2000,
        placing_reach: float = 2.0,
        ignore: Iterable[IgnoredLike] = (),
        self_pairs: Optional[PairRules] = None,
        work_budget: int = 60000,
    ) -> None: ...
    def follow(
        self, tracked: PoseLike, dt: float, is_tracked: Optional[npt.ArrayLike] = None
    ) -> SolidTick: ...
    def reset(self, place: Optional[PoseLike] = None) -> None: ...
    def change_scene(self, scene: Scene) -> None: ...
    @property
    def avatar(self) -> Avatar: ...
    @property
    def scene(self) -> Scene: ...

class World:
    def __init__(
        self,
        still: Optional[Scene] = None,
        *,
        tolerance: float = 0.001,
        ask_meshes: bool = False,
        work_per_pair: int = 100000000,
        work_per_window: Optional[int] = None,
        most_near: Optional[int] = None,
    ) -> None: ...
    def add(
        self,
        shape: Union[Avatar, Scene],
        *,
        group: int = 0,
        when_silent: str = "wait",
        self_pairs: Optional[PairRules] = None,
        surface: Optional[Surface] = None,
        skin: Optional[Skin] = None,
    ) -> int: ...
    def push(self, body: int, utime_us: int, pose: PoseLike) -> None: ...
    def attach(
        self,
        body: int,
        carrier: int,
        utime_us: int,
        pose: PoseLike,
        *,
        link: LinkLike = 0,
        moves_in_frame: bool = False,
    ) -> None: ...
    def detach(self, body: int, utime_us: int, pose: PoseLike) -> None: ...
    def ask(self, a: int, b: int, is_asked: bool) -> None: ...
    def ask_still(self, group: int, is_asked: bool) -> None: ...
    @property
    def known_until(self) -> Optional[int]: ...
    @property
    def waits_for(self) -> Optional[int]: ...
    def contacts(self, from_us: int, to_us: int) -> WorldContacts: ...
    def forget_before(self, utime_us: int) -> None: ...
    def forget_beyond(self, bytes: int) -> int: ...
    def thin_before(self, utime_us: int, metres: float) -> None: ...
    @property
    def pose_bytes(self) -> int: ...
    @property
    def num_bodies(self) -> int: ...
    @property
    def tolerance(self) -> float: ...
    def depth(
        self,
        utime_us: int,
        body: int,
        other: Optional[int] = None,
        *,
        link: Optional[LinkLike] = None,
        other_link: Optional[LinkLike] = None,
    ) -> Depth: ...
    def probe(
        self,
        utime_us: Union[int, tuple[int, float]],
        shape: Union[npt.ArrayLike, tuple[npt.ArrayLike, float], _LssLike],
        *,
        direction: Optional[npt.ArrayLike] = None,
        reach: float = 1000.0,
        within: Optional[float] = None,
        which: str = "closest",
        only: Optional[Sequence[Any]] = None,
        without: Optional[Sequence[Any]] = None,
        instants: Optional[Mapping[int, Union[int, tuple[int, float]]]] = None,
        groups: Optional[Sequence[int]] = None,
        still: bool = True,
        solids: bool = False,
    ) -> WorldAnswer: ...
    def probe_many(
        self,
        utime_us: Union[int, tuple[int, float], npt.ArrayLike],
        a: npt.ArrayLike,
        *,
        b: Optional[npt.ArrayLike] = None,
        radius: Union[float, npt.ArrayLike] = 0.0,
        hull: Optional[npt.ArrayLike] = None,
        direction: Optional[npt.ArrayLike] = None,
        reach: Union[float, npt.ArrayLike] = 1000.0,
        within: Optional[Union[float, npt.ArrayLike]] = None,
        which: str = "closest",
        only: Optional[Sequence[Any]] = None,
        without: Optional[Sequence[Any]] = None,
        instants: Optional[Mapping[int, Union[int, tuple[int, float], npt.ArrayLike]]] = None,
        groups: Optional[Sequence[int]] = None,
        still: bool = True,
        solids: bool = False,
    ) -> WorldAnswers: ...
    def fly(
        self,
        from_us: int,
        to_us: int,
        shape: Union[npt.ArrayLike, tuple[npt.ArrayLike, float], _LssLike],
        way: npt.ArrayLike,
        *,
        only: Optional[Sequence[Any]] = None,
        without: Optional[Sequence[Any]] = None,
        groups: Optional[Sequence[int]] = None,
        still: bool = True,
    ) -> FlightAnswer: ...

class SolidWorld:
    def __init__(
        self,
        still: Scene,
        begin_us: int,
        *,
        reach: str = "skin",
        tolerance: float = 0.001,
        work_per_pair: int = 100000000,
        work_per_window: Optional[int] = None,
        most_near: Optional[int] = None,
    ) -> None: ...
    def add(
        self, avatar: Avatar, *, group: int = 0, when_silent: str = "wait", **options: Any
    ) -> int: ...
    def tick(
        self,
        utime_us: int,
        targets: Mapping[int, PoseLike],
        is_tracked: Optional[Mapping[int, npt.ArrayLike]] = None,
    ) -> dict[int, SolidBodyTick]: ...
    def follow(self) -> WorldEvents: ...
    @property
    def utime(self) -> int: ...
    @property
    def world(self) -> World: ...
    @property
    def still(self) -> Scene: ...

class Follower:
    def __init__(
        self, world: World, from_us: int, *, threads: int = 1, cut_us: int = 0
    ) -> None: ...
    def weigh(
        self,
        body: int,
        kg: float,
        *,
        center: Optional[npt.ArrayLike] = None,
        inertia: Optional[npt.ArrayLike] = None,
    ) -> None: ...
    def follow(self, until_us: int) -> WorldEvents: ...
    @property
    def open(self) -> list[OpenPart]: ...
    @property
    def followed_until(self) -> int: ...

class Triggers:
    def __init__(self, world: World, from_us: int) -> None: ...
    def add_box(
        self, half_extents: npt.ArrayLike, *, group: int = 31, by_link: bool = False
    ) -> int: ...
    def add_sphere(self, radius: float, *, group: int = 31, by_link: bool = False) -> int: ...
    def add_mesh(self, closed: Scene, *, group: int = 31, by_link: bool = False) -> int: ...
    def body(self, trigger: int) -> int: ...
    def stand(self, trigger: int, from_us: int, translation: npt.ArrayLike) -> None: ...
    def watch(self, trigger: int, body: int, link: Optional[int] = None) -> None: ...
    def follow(self, until_us: int) -> list[TriggerEvent]: ...
    @property
    def occupants(self) -> list[Occupant]: ...

def swept_surface(
    motions: Union[Motion, Iterable[Motion]],
    link: LinkLike,
    *,
    error: float = 0.001,
    side: str = "outer",
    single_precision: bool = False,
    max_triangles: int = 50000000,
) -> SweptSurface: ...

class Robot:
    @staticmethod
    def load_urdf(
        path: _Path,
        *,
        packages: Sequence[str] = (),
        visual: bool = False,
        max_lss: int = 4,
        importer: Optional[_Path] = None,
    ) -> Robot: ...
    @staticmethod
    def from_joints(avatar: Avatar, joints: Sequence[Mapping[str, Any]]) -> Robot: ...
    def with_tool(self, link: LinkLike, name: str, lss: Sequence[_LssLike]) -> Robot: ...
    def pose(self, q: npt.ArrayLike) -> Pose: ...
    def path(self, q: npt.ArrayLike) -> tuple[Poses, Doubles]: ...
    @property
    def links_without_volume(self) -> list[str]: ...
    @property
    def num_coordinates(self) -> int: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def lower(self) -> Doubles: ...
    @property
    def upper(self) -> Doubles: ...
    @property
    def is_periodic(self) -> npt.NDArray[np.bool_]: ...
    @property
    def avatar(self) -> Avatar: ...

class EdgeQuery:
    def __init__(
        self,
        robot: Robot,
        scene: Scene,
        *,
        tolerance: float = 0.001,
        clearance: float = 0.0,
        self_pairs: Optional[PairRules] = None,
        ignore: Iterable[IgnoredLike] = (),
        threads: int = 1,
        props: Sequence[Scene] = (),
        clearance_tolerance: float = 0.001,
        clearance_within: Optional[float] = None,
    ) -> None: ...
    def place(self, prop: int, pose: Optional[PoseLike]) -> None: ...
    def answer(self, q0: npt.ArrayLike, q1: npt.ArrayLike) -> Edges: ...
    def certify(
        self, q0: npt.ArrayLike, q1: npt.ArrayLike, folder: _Path
    ) -> CertifiedEdges: ...
    def answer_path(self, q: npt.ArrayLike) -> tuple[float, Edges]: ...
    def clearance(
        self, q: npt.ArrayLike, q1: Optional[npt.ArrayLike] = None, *, slopes: bool = False
    ) -> Clearances: ...
    @property
    def robot(self) -> Robot: ...
    @property
    def scene(self) -> Scene: ...

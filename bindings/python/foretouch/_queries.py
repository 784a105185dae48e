"""Single queries: each function makes a Query and runs it once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Optional

import numpy as np
import numpy.typing as npt

from foretouch._foretouch import Avatar, Motion, PairRules, Query, Scene, Step, Steps, Surface
from foretouch._types import IgnoredLike, Policy, PolicyKey, PosesLike


def first_contacts(
    avatar: Avatar,
    motion: Motion,
    scene: Scene,
    tolerance: float = 1e-3,
    fidelity: str = "link",
    *,
    policies: Optional[Mapping[PolicyKey, Policy]] = None,
    ignore: Iterable[IgnoredLike] = (),
    work_budget: Optional[int] = None,
    deadline_us: Optional[float] = None,
    scope: str = "links",
    surface: Optional[Surface] = None,
    self_pairs: Optional[PairRules] = None,
    pass_separating: bool = False,
) -> Step:
    """The first contact of every link in one motion. The options are those of Query, which is
    faster for more than one motion."""
    query = Query(
        avatar,
        scene,
        tolerance=tolerance,
        fidelity=fidelity,
        policies=policies,
        ignore=ignore,
        work_budget=work_budget,
        deadline_us=deadline_us,
        scope=scope,
        surface=surface,
        self_pairs=self_pairs,
        pass_separating=pass_separating,
    )
    return query.first_contacts(motion)


def first_contacts_many(
    avatar: Avatar,
    poses: PosesLike,
    scene: Scene,
    tolerance: float = 1e-3,
    fidelity: str = "link",
    *,
    ends: Optional[PosesLike] = None,
    threads: Optional[int] = None,
    policies: Optional[Mapping[PolicyKey, Policy]] = None,
    ignore: Iterable[IgnoredLike] = (),
    work_budget: Optional[int] = None,
    deadline_us: Optional[float] = None,
    scope: str = "links",
    surface: Optional[Surface] = None,
    self_pairs: Optional[PairRules] = None,
    pass_separating: bool = False,
) -> Steps:
    """The first contact of every link on the way from each pose to the next (or to the one at the
    same place in `ends`), on several threads."""
    query = Query(
        avatar,
        scene,
        tolerance=tolerance,
        fidelity=fidelity,
        policies=policies,
        ignore=ignore,
        work_budget=work_budget,
        deadline_us=deadline_us,
        scope=scope,
        surface=surface,
        self_pairs=self_pairs,
        pass_separating=pass_separating,
    )
    return query.first_contacts_many(poses, ends=ends, threads=threads)


def touches_at(
    avatar: Avatar,
    motion: Motion,
    scene: Scene,
    t: npt.ArrayLike,
    fidelity: str = "link",
    *,
    ignore: Iterable[IgnoredLike] = (),
    surface: Optional[Surface] = None,
) -> npt.NDArray[np.bool_]:
    """What a discrete check sees at single instants, without any promise: (n,) for a number t,
    (k, n) for k of them."""
    query = Query(avatar, scene, fidelity=fidelity, ignore=ignore, surface=surface)
    return query.touches_at(motion, t)

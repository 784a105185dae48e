"""Foretouch: what does each link of an avatar touch first between two poses, and when?

Lengths in metres, world +Y up, quaternions in the order w, x, y, z, t from 0 (the earlier pose) to 1
(the later). The guide is docs/python.md, the promise docs/guarantees.md of the project.
"""

from __future__ import annotations

from foretouch._foretouch import (
    Avatar,
    Clip,
    Contact,
    Error,
    InputError,
    Motion,
    NearQuery,
    PairContact,
    PairRules,
    Query,
    ResourceError,
    Scene,
    SolidAvatar,
    SolidJointState,
    SolidState,
    SolidTick,
    Step,
    Steps,
    Surface,
    Verdict,
    __version__,
    swept_surface,
)
from foretouch._examples import example_folder
from foretouch._queries import first_contacts, first_contacts_many, touches_at
from foretouch._types import (
    ContactDetails,
    ContactPoint,
    JointMatch,
    LeftOutPair,
    Lss,
    NearFeatures,
    PairRadius,
    Pose,
    Poses,
    SceneAudit,
    SolidContact,
    SweptSurface,
)

__all__ = [
    "Avatar",
    "Clip",
    "Contact",
    "ContactDetails",
    "ContactPoint",
    "Error",
    "InputError",
    "JointMatch",
    "LeftOutPair",
    "Lss",
    "Motion",
    "NearFeatures",
    "NearQuery",
    "PairContact",
    "PairRadius",
    "PairRules",
    "Pose",
    "Poses",
    "Query",
    "ResourceError",
    "Scene",
    "SceneAudit",
    "SolidAvatar",
    "SolidContact",
    "SolidJointState",
    "SolidState",
    "SolidTick",
    "Step",
    "Steps",
    "Surface",
    "SweptSurface",
    "Verdict",
    "__version__",
    "example_folder",
    "first_contacts",
    "first_contacts_many",
    "swept_surface",
    "touches_at",
]

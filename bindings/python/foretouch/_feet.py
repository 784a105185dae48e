"""How feet rest in a clip, as arrays: what `foretouch feet --labels` writes."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from foretouch._foretouch import InputError, ResourceError

PathLike = Union[str, "os.PathLike[str]"]


class FeetLabels(NamedTuple):
    """Of n poses and m parts of feet and hands. Metres and seconds."""

    frame: npt.NDArray[np.int64]
    """(n,), of the clip, from 0."""
    time: npt.NDArray[np.float64]
    """(n,), seconds since the clip's first frame."""
    joint: list[str]
    """Of each part, the joint that it moves with."""
    part: list[str]
    """Of each: "heel", "ball", "toe", "foot" or "hand"."""
    contact: npt.NDArray[np.bool_]
    """(n, m): whether a touch, whose begin and end are proven, holds at the pose."""
    distance: npt.NDArray[np.float32]
    """(n, m), above the ground, 0 in it; NaN above a void."""
    depth: npt.NDArray[np.float32]
    """(n, m), in the ground."""
    slide: npt.NDArray[np.float32]
    """(n, m), m/s along the ground until the next pose, while the part touches and rests."""
    rule: npt.NDArray[np.bool_]
    """(n, m): contact by the rule of thumb, a joint below 5 cm and slower than 0.3 m/s."""


def _program() -> str:
    """$FORETOUCH_PROGRAM, or the program of this package's installation or build tree, or of the
    PATH."""
    package = Path(__file__).resolve().parent
    # A wheel has an installation inside; else this file is
    # PREFIX/lib/python3/dist-packages/foretouch/_feet.py.
    inside = package / "_installed"
    prefix = inside if inside.is_dir() else (package / "../../../..").resolve()
    beside = prefix / "bin" / "foretouch"
    named = os.environ.get("FORETOUCH_PROGRAM")
    found = named or (str(beside) if beside.is_file() else shutil.which("foretouch"))
    if found is None:
        raise ResourceError(
            f"{beside}: is not there; expected the program foretouch there, in the PATH, or its "
            "place in the environment variable FORETOUCH_PROGRAM"
        )
    return found


def feet_labels(
    clip: PathLike,
    avatar: Optional[PathLike] = None,
    scene: Optional[PathLike] = None,
    *,
    clip_scale: Optional[float] = None,
    fit_ground: bool = False,
    skip_t_pose: bool = False,
    rate: Optional[float] = None,
    options: Sequence[str] = (),
) -> FeetLabels:
    """Which part of which foot touches, how deep it is and how fast it slides, pose by pose.

    Runs `foretouch feet`; without an avatar a body is made of a BVH clip's bones, without a scene
    the ground is a plain floor at y = 0. `options`: more of that command's words, such as
    ["--place", "0,0.1,0"]. InputError says what the program says.
    """
    with tempfile.TemporaryDirectory() as folder:
        labels = os.path.join(folder, "labels.npz")
        words = [_program(), "feet", "--motion", os.fspath(clip), "--labels", labels, "--quiet"]
        for name, value in (("--avatar", avatar), ("--scene", scene)):
            words += [] if value is None else [name, os.fspath(value)]
        for name, number in (("--clip-scale", clip_scale), ("--rate", rate)):
            words += [] if number is None else [name, repr(float(number))]
        words += ["--ground", "fit"] if fit_ground else []
        words += ["--skip-t-pose"] if skip_t_pose else []
        done = subprocess.run([*words, *options], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise InputError(f"feet_labels: {done.stderr.strip().removeprefix('foretouch: ')}")
        with np.load(labels) as arrays:
            texts = {name: [text.decode() for text in arrays[name]] for name in ("joint", "part")}
            return FeetLabels(**{name: texts.get(name, arrays[name]) for name in arrays.files})

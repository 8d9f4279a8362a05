from __future__ import annotations

import math
import numbers
import typing

from . import choreography
from ._errors import invalid
from ._words import hint, quoted


def pose(
    skeleton: choreography.Skeleton,
    rotations: typing.Optional[typing.Mapping[str, typing.Sequence[float]]] = None,
    x: float = 0.0,
    z: float = 0.0,
) -> choreography.Pose:
    """The body of `skeleton` at rest, but for `rotations`: {joint name: [x, y, z] in radians}. Raises ChoreoError for joints that it lacks, and
    what is no rotation."""
    names, rotations = list(skeleton.joint_names), rotations or {}
    for joint, turn in rotations.items():
        if joint not in names:
            raise invalid(f"rotations.{joint}", f"no joint of {skeleton.name or 'the skeleton'}; {hint(joint, names)}")
        if not (hasattr(turn, "__len__") and len(turn) == 3 and all(map(_is_number, turn))):
            raise invalid(f"rotations.{joint}", f"{quoted(turn)} is not [x, y, z], three finite numbers")
    for axis, place in (("x", x), ("z", z)):
        if not _is_number(place):
            raise invalid(axis, f"{quoted(place)} is no finite number")
    return choreography.Pose(
        root_position=choreography.Vector3(x=x, y=skeleton.pelvis_height, z=z),
        rotations=[number for joint in names for number in rotations.get(joint, (0, 0, 0))],
    )


def _is_number(value):
    return isinstance(value, numbers.Real) and math.isfinite(value)

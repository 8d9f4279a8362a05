from __future__ import annotations

import collections.abc
import typing

from . import choreography
from ._errors import invalid
from ._numbers import LARGEST_FLOAT32, finite
from ._words import hint, quoted


WITHOUT_PLACE = "leave it out, and the pose is taken wherever the dancer is"


def pose(
    skeleton: choreography.Skeleton,
    rotations: typing.Optional[typing.Mapping[str, typing.Sequence[float]]] = None,
    place: typing.Optional[typing.Sequence[float]] = None,
) -> choreography.Pose:
    """Makes a pose: the rest pose of `skeleton` with these `rotations`, {joint name: [x, y, z] in radians}. It is at `place`, [x, z] in metres, or,
    without one, wherever the dancer is. Raises ChoreoError for joints that the skeleton lacks, and for invalid rotations."""
    require_skeleton(skeleton)
    names, rotations = list(skeleton.joint_names), {} if rotations is None else rotations
    if not isinstance(rotations, collections.abc.Mapping):
        raise invalid("rotations", f"{quoted(rotations)} is not {{joint name: [x, y, z]}}")
    for joint, turn in rotations.items():
        if joint not in names:
            raise invalid(f"rotations.{joint}", f"no joint of {skeleton.name or 'the skeleton'}; {hint(joint, names)}")
        if not _is_vector(turn, 3):
            raise invalid(f"rotations.{joint}", f"{quoted(turn)} is not [x, y, z], three finite numbers")
    if place is not None and not _is_vector(place, 2):
        raise invalid("place", f"{quoted(place)} is not [x, z], two finite numbers in metres; {WITHOUT_PLACE}")
    root = None if place is None else choreography.Vector3(x=place[0], y=skeleton.pelvis_height, z=place[1])
    return choreography.Pose(root_position=root, rotations=[number for joint in names for number in rotations.get(joint, (0, 0, 0))])


def require_skeleton(skeleton):
    """Raises ChoreoError unless the argument is a model's skeleton."""
    if not hasattr(skeleton, "joint_names"):
        raise invalid("skeleton", f"{quoted(skeleton)} is none, as in client.info().models[0].skeleton")


def _is_vector(value, size):
    return hasattr(value, "__len__") and len(value) == size and all(abs(finite(one) or 0) <= LARGEST_FLOAT32 and finite(one) is not None for one in value)

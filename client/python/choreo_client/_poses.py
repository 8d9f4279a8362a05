"""The library of named poses, which key files may name."""

from __future__ import annotations

import functools
import json
import pathlib
import typing

from ._errors import invalid
from ._words import hint

_PACKED = pathlib.Path(__file__).with_name("poses")


class LibraryPose(typing.NamedTuple):
    id: str
    description: str
    tags: typing.List[str]  # "standing", "travelling", "jump" or "floor"
    root_position: typing.List[float]
    rotations: typing.List[typing.List[float]]  # an axis-angle vector per joint of smpl24


@functools.lru_cache(maxsize=None)
def poses() -> typing.Tuple[LibraryPose, ...]:
    """The library's poses, sorted by name, which key files may name."""
    folder = _PACKED if _PACKED.is_dir() else pathlib.Path(__file__).resolve().parents[2] / "poses"  # the repository's folder, in a checkout
    read = (json.loads(file.read_text("utf-8")) for file in sorted(folder.glob("*.json")))
    return tuple(_pose(file) for file in read)


def _pose(file):
    (key,) = file["keyframes"]
    return LibraryPose(key["id"], file["description"], file["tags"], key["root_position"], key["rotations"])


def find(name, field):
    """Finds the pose of this name. Raises ChoreoError, naming `field`, if there is none."""
    for one in poses():
        if one.id == name:
            return one
    raise invalid(field, f"{name!r} is not a pose of the library; {hint(name, [one.id for one in poses()])}")

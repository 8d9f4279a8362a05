"""Translates fields in errors: servers count the joints of a pose, whereas callers count the numbers that they sent."""

import collections.abc
import re

from . import choreography

_WIDTHS = {choreography.ROTATION_ENCODING_QUATERNION: 4, choreography.ROTATION_ENCODING_MATRIX: 9}


_MEMBER = re.compile(r"(\w+)(?:\[(\d+)\])?")


def joint_at(field, request):
    """The joint of a number in a message's rotations, such as "keyframe.pose.rotations[48]": 16. None for other fields."""
    counted = re.fullmatch(r"(.+)\.rotations\[(\d+)\]", field)
    return counted and int(counted[2]) // _width(counted[1], request)


def _width(path, request):
    pose = request
    for name, index in _MEMBER.findall(path):
        pose = pose.get(name) if isinstance(pose, collections.abc.Mapping) else getattr(pose, name, None)
        if index:
            pose = pose[int(index)] if pose is not None and int(index) < len(pose) else None
    encoding = pose.get("encoding") if isinstance(pose, collections.abc.Mapping) else getattr(pose, "encoding", None)
    number = getattr(choreography, encoding, None) if isinstance(encoding, str) else encoding
    return _WIDTHS.get(number, 3) if isinstance(number, int) else 3


def as_sent(field, request):
    """Translates a server's `field` in a message that was sent as `request` (None: unknown). Returns the field, and a joint or None.
    "keyframe.pose.rotations[16]" is joint 16, whose first number is "keyframe.pose.rotations[48]"."""
    counted = re.fullmatch(r"(.+)\.rotations\[(\d+)\]", field)
    if counted is None:
        return field, None
    joint = int(counted[2])
    return f"{counted[1]}.rotations[{joint * _width(counted[1], request)}]", joint

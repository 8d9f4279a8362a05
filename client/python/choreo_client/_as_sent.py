"""Translates fields in errors: servers count the joints of a pose, whereas callers count the numbers that they sent."""

import re

from . import choreography

_WIDTHS = {choreography.ROTATION_ENCODING_QUATERNION: 4, choreography.ROTATION_ENCODING_MATRIX: 9}


def as_sent(field, request):
    """Translates a server's `field` in a message that was sent as `request` (None: unknown). Returns the field, and a joint or None.
    "keyframe.pose.rotations[16]" is joint 16, whose first number is "keyframe.pose.rotations[48]"."""
    counted = re.fullmatch(r"(.+)\.rotations\[(\d+)\]", field)
    if counted is None:
        return field, None
    pose, joint = request, int(counted[2])
    for name, index in re.findall(r"(\w+)(?:\[(\d+)\])?", counted[1]):
        pose = getattr(pose, name, None)
        if index:
            pose = pose[int(index)] if pose is not None and int(index) < len(pose) else None
    return f"{counted[1]}.rotations[{joint * _WIDTHS.get(getattr(pose, 'encoding', None), 3)}]", joint

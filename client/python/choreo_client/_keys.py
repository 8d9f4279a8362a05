"""Reads key files as `choreo dance --keyframes` does (docs/poses.md)."""

from __future__ import annotations

import json
import math
import os
import re
import typing
import warnings

from . import choreography
from ._errors import invalid
from ._pose import WITHOUT_PLACE, require_skeleton
from ._numbers import finite
from ._poses import find
from ._words import hint, quoted

_MEMBERS = ("id", "time", "frame", "hold", "hit", "hands", "pose", "place", "facing", "joints", "root_position", "rotations")
_LIMBS = {"arms": ("left_shoulder", "right_shoulder"), "legs": ("left_hip", "right_hip")}
_LIMBS |= {f"{side}_{limb}": (f"{side}_{root}",) for side in ("left", "right") for limb, root in (("arm", "shoulder"), ("leg", "hip"))}
_BENDS = {"left_knee": -1, "right_knee": -1, "left_elbow": 1, "right_elbow": 1}  # direction along z
_HOLD_STEP, _WAY_FROM_HOLD = 0.2, 0.5  # seconds
_USUAL_HIT = 1  # default for a held key
_MOST_HIT = 3
_HANDS = ("rest", "relaxed", "open", "fist", "point")
_MOST_SECONDS = _MOST_FRAME = 10**9
_FOLDED = 165  # degrees: the largest bend
# Limits of turns about each axis, in degrees either way, by a part of the joint's name. Other joints may turn by 180 degrees. The limits are the
# same in model/motion/kinematics/joint_angles.cpp.
_MOST_TURN = {"collar": 60, "wrist": 90, "ankle": 80, "foot": 60, "toe": 60, "spine": 60, "neck": 80, "head": 80}


def read_keys(file: typing.Union[str, bytes, typing.Mapping[str, typing.Any]], skeleton: choreography.Skeleton) -> list[dict]:
    """Reads the keys of a key file, given as its text or as parsed JSON, as requests for stream_dance: [{"keyframe": ...}, ...]. A held key
    becomes several keys. A key without an id is called by its place in the file, from 1: "key2". The keys are in order of time, unless some have
    a time and others a frame. Times must be in seconds: counts of a song ("9c") require its beats, which only the `choreo` program finds. Poses
    in numbers must be `rotations`. Raises ChoreoError. Warns about a jump without a place, which is danced standing on the floor, and
    about a hold that a key within it ends half a second before itself."""
    require_skeleton(skeleton)
    content = _parsed(file) if isinstance(file, (str, bytes, os.PathLike)) else file
    keys = content.get("keyframes") if isinstance(content, typing.Mapping) else None
    if not isinstance(keys, list):
        raise invalid("file", 'has no list "keyframes"')
    if not keys:
        raise invalid("keyframes", "is empty")
    read = [_key(key, f"keyframes[{at}]", f"key{at + 1}", skeleton) for at, key in enumerate(keys)]
    ids = set()
    for at, (key, _, lost_jump) in enumerate(read):
        if key["id"] in ids:
            raise invalid(f"keyframes[{at}].id", f'"{key["id"]}" is already the id of an earlier key')
        ids.add(key["id"])
        if lost_jump and _sets_feet(key.get("mask"), skeleton):
            warnings.warn(f'key "{key["id"]}": {lost_jump}', stacklevel=2)
    starts = sorted((key["time"], key["id"]) for key, *_ in read if "time" in key)
    timed = []
    for at, (key, hold, _) in enumerate(read):
        timed += [key, *_held(key, hold, starts, f"keyframes[{at}].hold")]
    for when in ("time", "frame"):
        if all(when in key for key in timed):
            timed.sort(key=lambda key, when=when: key[when])
    return [{"keyframe": key} for key in timed]


def library_pose(
    name: str, skeleton: choreography.Skeleton, place: typing.Optional[typing.Sequence[float]] = None, facing: float = 0.0
) -> choreography.Pose:
    """Returns the library's pose of this name, for a Keyframe, turned by `facing` degrees. It is at `place`, [x, z] in metres, or, without one,
    wherever the dancer is. `skeleton`: the model's, which must be smpl24. Raises ChoreoError. Warns about a jump without a place, which is danced
    standing on the floor."""
    require_skeleton(skeleton)
    given = {"pose": name, "facing": facing} | ({} if place is None else {"place": place if isinstance(place, str) else list(place)})
    rotations, root, lost_jump = _pose(given, "library_pose", skeleton)
    if lost_jump:
        warnings.warn(f"library_pose: {lost_jump}", stacklevel=2)
    return choreography.Pose(**_pose_of(rotations, root))


def _parsed(text):
    is_path = isinstance(text, os.PathLike)
    try:
        if not is_path:
            return json.loads(text)
    except ValueError as error:
        is_path = isinstance(text, str) and re.fullmatch(r"[^{}\n]*[./\\][^{}\n]+", text)
        if not is_path:
            raise invalid("file", f"is not JSON: {error}") from None
    raise invalid("file", f"{quoted(text)} is a path: read it, and give its text")


def _key(value, field, name, skeleton):
    """Reads a Keyframe's fields, for how long it is held, and a warning for a jump that will be danced standing."""
    if not isinstance(value, typing.Mapping):
        raise invalid(field, f"{quoted(value)} is not a key")
    for member in value:
        if member not in _MEMBERS:
            raise invalid(f"{field}.{member}", f"is not known; {hint(member, list(_MEMBERS))}")
    key = {"id": value.get("id", name), "pose": {}}
    if not isinstance(key["id"], str) or not key["id"]:
        raise invalid(f"{field}.id", f"{quoted(key['id'])} is not a name")
    when = [member for member in ("time", "frame") if member in value]
    if len(when) != 1:
        raise invalid(f"{field}.time", "cannot be combined with frame" if when else "is missing, and so is frame")
    key[when[0]] = _moment(value[when[0]], when[0], f"{field}.{when[0]}")
    if "hit" in value:
        key["hit"] = _number(value["hit"], f"{field}.hit")
        if not 0 <= key["hit"] <= _MOST_HIT:
            raise invalid(f"{field}.hit", f"{key['hit']} is not a number from 0 (gently) to {_MOST_HIT} (late and fast)")
    if "hands" in value:
        if value["hands"] not in _HANDS:
            raise invalid(f"{field}.hands", f"{quoted(value['hands'])} is none of {', '.join(_HANDS)}")
        key["hands"] = f"HAND_POSE_{value['hands'].upper()}"
    rotations, root, lost_jump = _pose(value, field, skeleton)
    joints = value.get("joints")
    if isinstance(joints, typing.Mapping):
        if not joints:
            raise invalid(f"{field}.joints", "names no joint")
        for joint, degrees in joints.items():
            rotations[_joint(joint, skeleton, f"{field}.joints.{joint}")] = _turn(joint, degrees, skeleton, f"{field}.joints.{joint}")
        if "pose" not in value and "rotations" not in value:
            named = {_joint(joint, skeleton, field) for joint in joints}
            key["mask"] = {"joints": sorted(named | ({0} if "facing" in value else set()))}
    elif "joints" in value:
        key["mask"] = {"joints": _mask(joints, skeleton, f"{field}.joints")}
    key["pose"] = _pose_of(rotations, root)
    return key, _number(value["hold"], f"{field}.hold") if "hold" in value else None, lost_jump


def _pose_of(rotations, root):
    """Makes the fields of a Pose."""
    placed = {} if root is None else {"root_position": dict(zip("xyz", root))}
    return {**placed, "rotations": [number for rotation in rotations for number in rotation]}


def _pose(value, field, skeleton):
    """Reads the rotations of all joints, the root's position or None, and a warning for a jump that will be danced standing."""
    facing = _number(value.get("facing", 0), f"{field}.facing")
    if abs(facing) > 360:
        raise invalid(f"{field}.facing", f"{facing} degrees, must be -360 to 360")
    place = _place(value["place"], f"{field}.place") if "place" in value else None
    if "rotations" in value:
        if "pose" in value:
            raise invalid(f"{field}.rotations", "cannot be combined with pose")
        rotations = value["rotations"]
        if not isinstance(rotations, list) or len(rotations) != len(skeleton.joint_names):
            raise invalid(f"{field}.rotations", f"{quoted(rotations)} is not one vector for each of {len(skeleton.joint_names)} joints")
        turns = [_rotation(one, f"{field}.rotations[{at}]") for at, one in enumerate(rotations)]
        root = _vector(value["root_position"], 3, f"{field}.root_position") if "root_position" in value else None
        if place is not None and root is None:
            raise invalid(f"{field}.place", "needs a root_position, which says how high the pose is")
        return *_placed(turns, root, place, value.get("facing")), None
    if "root_position" in value:
        raise invalid(f"{field}.rotations", "is missing beside root_position")
    if "pose" not in value:
        if not isinstance(value.get("joints"), typing.Mapping):
            raise invalid(f"{field}.rotations", "is missing, and so is pose")
        root = None if place is None else [0.0, skeleton.pelvis_height, 0.0]
        return *_placed([[0.0] * 3 for _ in skeleton.joint_names], root, place, value.get("facing")), None
    if skeleton.name != "smpl24":
        raise invalid(f"{field}.pose", f"poses of the library are of smpl24, not of {skeleton.name or 'this skeleton'}")
    named = find(value["pose"], f"{field}.pose")
    heading = [0.0, math.radians(facing), 0.0]
    rotations = [list(one) for one in named.rotations]
    rotations[0] = _log(_times(_quaternion(heading), _quaternion(rotations[0])))
    if place is None:
        lost_jump = f'{named.id} is in the air, but without a place it stands on the floor; give it one: "place": [x, z]'
        return rotations, None, lost_jump if "jump" in named.tags else None
    turned = _turned(_quaternion(heading), named.root_position)
    return rotations, [turned[0] + place[0], turned[1], turned[2] + place[1]], None


def _place(value, field):
    if not isinstance(value, list) or len(value) != 2:
        raise invalid(field, f"{quoted(value)} is not a list of 2 numbers, [x, z] in metres; {WITHOUT_PLACE}")
    return _vector(value, 2, field)


def _placed(rotations, root, place, facing):
    """Moves a pose so that its root is above a place, and turns it there so that its root faces that way."""
    pelvis = _quaternion(rotations[0])
    if facing is not None:
        ahead = _turned(pelvis, [0.0, 0.0, 1.0])
        turn = math.radians(facing) - math.atan2(ahead[0], ahead[2])
        rotations = [_log(_times(_quaternion([0.0, turn, 0.0]), pelvis)), *rotations[1:]]
    return rotations, root if place is None else [place[0], root[1], place[1]]


def _sets_feet(mask, skeleton):
    """Whether a key determines how far below the root its feet are, and so the root's height when it stands."""

    def is_set(joint):
        return joint < 0 or (joint in mask["joints"] and is_set(skeleton.parents[joint]))

    return mask is None or all(is_set(skeleton.parents[foot]) for foot in skeleton.feet)


def _held(key, hold, starts, field):
    """Returns the keys that hold this one. Sets the key's hit unless it has one. Warns where another key ends the hold."""
    if hold is None:
        return
    if "time" not in key:
        raise invalid(field, "goes with time")
    if not 0.1 <= hold <= 60:
        raise invalid(field, f"{hold} s, must be 0.1 to 60")
    held = {name: value for name, value in key.items() if name != "hit"}
    key.setdefault("hit", _USUAL_HIT)
    steps = max(1, math.floor(hold / _HOLD_STEP + 1e-9))
    end = key["time"] + hold
    after, after_id = next((start for start in starts if start[0] > key["time"]), (math.inf, ""))
    last = math.inf if after > end else after - _WAY_FROM_HOLD  # leaves time to reach a key within the hold
    now = key["time"]
    for step in range(1, steps + 1):
        time = key["time"] + hold * step / steps
        if time <= last:
            now = time
            yield {**held, "id": f"{key['id']} held {step}", "time": time}
    if after <= end:
        cut = f'it is held up to {round(now, 2):g} s, not {round(end, 2):g} s: the key "{after_id}" comes at {round(after, 2):g} s'
        warnings.warn(f'key "{key["id"]}": {cut}', stacklevel=3)


def _number(value, field):
    if finite(value) is None:
        counts = "; counts need a song's beats: say seconds" if isinstance(value, str) and value.endswith("c") else ""
        raise invalid(field, f"{quoted(value)} is not a number{counts}")
    return value


def _moment(value, kind, field):
    if kind == "frame":
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= _MOST_FRAME:
            raise invalid(field, f"{quoted(value)} is not a whole number from 0 to {_MOST_FRAME}")
        return value
    seconds = _number(value, field)
    if seconds < 0:
        raise invalid(field, f"{seconds} s is before 0")
    if seconds > _MOST_SECONDS:
        raise invalid(field, f"{seconds} s is beyond {_MOST_SECONDS} s")
    return seconds


def _rotation(value, field):
    turn = _vector(value, 3, field)
    if math.hypot(*turn) > 2 * math.pi:
        raise invalid(field, f"{math.hypot(*turn):.6g} rad exceeds 2π; angles are in radians")
    return turn


def _vector(value, size, field):
    if not isinstance(value, list) or len(value) != size:
        raise invalid(field, f"{quoted(value)} is not a list of {size} numbers")
    return [_number(one, f"{field}[{at}]") for at, one in enumerate(value)]


def _joint(name, skeleton, field):
    names = list(skeleton.joint_names)
    if name not in names:
        raise invalid(field, f"{quoted(name)} is not a joint of {skeleton.name or 'the skeleton'}; {hint(name, names)}")
    return names.index(name)


def _mask(names, skeleton, field):
    """Makes a mask of the joints with these names, some of which are whole limbs."""
    if not isinstance(names, list) or not names:
        raise invalid(field, f"{quoted(names)} is not a list of joint names")
    chosen = set()
    for name in names:
        if not isinstance(name, str):
            raise invalid(field, f"{quoted(name)} is not a joint's name")
        roots = {_joint(root, skeleton, field) for root in _LIMBS.get(name, ())}
        limb = set(roots) or {_joint(name, skeleton, field)}
        for joint, parent in enumerate(skeleton.parents):  # parents precede their children
            if roots and parent in limb:
                limb.add(joint)
        chosen |= limb
    return sorted(chosen)


def _turn(joint, degrees, skeleton, field):
    """Makes a rotation from degrees: the bend of a knee or elbow, or another joint's turns about x, then y, then z."""
    at = _joint(joint, skeleton, field)
    if joint not in _BENDS:
        most = next((most for part, most in _MOST_TURN.items() if part in joint), 180)
        turns = _vector(degrees, 3, field)
        for axis, turn in zip("xyz", turns):
            _require_range(joint, turn, f" about {axis}", -most, most, field)
        x, y, z = (_quaternion([math.radians(one) * (at == axis) for at in range(3)]) for axis, one in enumerate(turns))
        return _log(_times(z, _times(y, x)))
    _require_range(joint, _number(degrees, field), "", 0, _FOLDED, field)
    x, y, _ = skeleton.offsets[3 * at : 3 * at + 3]
    length, side = math.hypot(x, y), _BENDS[joint]
    bend = math.radians(degrees)
    return [bend * side * y / length, -bend * side * x / length, 0.0]  # about the cross product of the bone and z


def _require_range(joint, degrees, about, low, high, field):
    if not low <= degrees <= high:
        raise invalid(field, f"{joint} is at {degrees} degrees{about}, must be {low} to {high}")


def _quaternion(rotation):
    """Converts an axis-angle vector to [w, x, y, z]."""
    angle = math.hypot(*rotation)
    scale = math.sin(angle / 2) / angle if angle > 0 else 0.5
    return [math.cos(angle / 2), *(scale * one for one in rotation)]


def _times(a, b):
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]


def _turned(q, vector):
    return _times(_times(q, [0, *vector]), [q[0], -q[1], -q[2], -q[3]])[1:]


def _log(q):
    """Converts a quaternion, [w, x, y, z], to the shortest axis-angle vector."""
    sign = -1 if q[0] < 0 else 1
    sine = math.hypot(*q[1:])
    scale = 2 * math.atan2(sine, sign * q[0]) / sine if sine > 0 else 2
    return [sign * scale * one for one in q[1:]]

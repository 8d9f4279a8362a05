"""Handles keys, and removals of keys, that the package's own check refuses, in dances that continue without invalid keys. Instead of each, the
server is sent a blank: a key without a pose at the same moment. The server rejects the blank in order, also after a resumption; the caller
receives the reason that the check found."""

import collections.abc

from . import choreography
from ._check import checked
from ._errors import ChoreoError
from ._words import well_formed

_NOWHERE = -1
_KINDS = {"keyframe": choreography.Keyframe, "remove_keyframe": choreography.RemoveKeyframe}


class RefusedKeys:
    def __init__(self):
        # For all keys without a pose, in order: what the check found wrong, or None for a key that the caller sent so.
        self._bodiless = []
        self._answered = 0  # how many of these the present server has answered

    def restart(self):
        """Prepares for another server, which receives all requests again."""
        self._answered = 0

    def note(self, request):
        """Notes a request that is sent unchanged."""
        key = request.keyframe
        if request.HasField("keyframe") and key.WhichOneof("when") is not None and not key.HasField("pose"):
            self._bodiless.append(None)

    def blank(self, request, error):
        """Returns the blank to send instead of a key's request that `error` refuses; None if more than the key is invalid."""
        kind = _kind_of(request)
        if kind is None:
            return None
        try:
            checked(choreography.StreamDanceRequest, {**request, kind: {}}, "request")
        except ChoreoError:
            return None
        self._bodiless.append(error.violations[0])
        return choreography.StreamDanceRequest(keyframe=_without_pose(request[kind]))

    def take_event(self, event):
        """Translates an event, in place, for the caller."""
        rejected = event.keyframe_rejected
        if rejected.code != choreography.REJECTION_CODE_INVALID or rejected.field != "keyframe.pose":
            return
        wrong = self._bodiless[self._answered]
        self._answered += 1
        if wrong is not None:
            rejected.field, rejected.reason = wrong


def require_key(request, message):
    """Raises ChoreoError for a request whose message is empty because its key is None."""
    kind = _kind_of(request)
    if kind is not None and message.WhichOneof("request") is None:
        checked(_KINDS[kind], request[kind], kind)


def _kind_of(request):
    """Returns which field of a request has a key or its removal."""
    named = [kind for kind in _KINDS if isinstance(request, collections.abc.Mapping) and kind in request]
    return next((kind for kind in named if request[kind] is not None), named[0] if named else None)


def _without_pose(key):
    """Returns the id of a key, valid or not, and its moment, if it has one."""
    fields = key if isinstance(key, collections.abc.Mapping) else {}
    name = fields.get("id")
    when = {kind: fields.get(kind) for kind in ("frame", "time", "interval_after_previous")}
    try:
        blank = checked(choreography.Keyframe, when, "keyframe")
    except ChoreoError:
        blank = choreography.Keyframe()
    if blank.WhichOneof("when") is None:
        blank.frame = _NOWHERE
    blank.id = well_formed(name) if isinstance(name, str) else ""
    return blank

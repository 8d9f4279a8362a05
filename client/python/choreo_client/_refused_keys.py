"""Keys, and removals of keys, that the package's own check refuses, in dances that go on without bad keys. In place of each the server is told
a blank: a key without a pose, at the moment that the key names. It rejects that in its turn, and again where the dance is resumed; the caller
is told what was wrong here."""

import collections.abc

from . import choreography
from ._check import checked
from ._errors import ChoreoError

_NOWHERE = -1
_KINDS = {"keyframe": choreography.Keyframe, "remove_keyframe": choreography.RemoveKeyframe}


class RefusedKeys:
    def __init__(self):
        # Of all keys without a pose, in order: what was wrong here, or None for one that the caller left so.
        self._bodiless = []
        self._answered = 0  # of them, by the present server

    def restart(self):
        """Another server is told all again."""
        self._answered = 0

    def note(self, request):
        """A request that is said as it is."""
        key = request.keyframe
        if request.HasField("keyframe") and key.WhichOneof("when") is not None and not key.HasField("pose"):
            self._bodiless.append(None)

    def blank(self, request, error):
        """What to say instead of a request for a key that `error` refuses; None where more than the key is wrong."""
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
        """Changes it to what the caller is to hear."""
        rejected = event.keyframe_rejected
        if rejected.code != choreography.REJECTION_CODE_INVALID or rejected.field != "keyframe.pose":
            return
        wrong = self._bodiless[self._answered]
        self._answered += 1
        if wrong is not None:
            rejected.field, rejected.reason = wrong


def require_key(request, message):
    """Raises for a request whose message is empty because its key is none."""
    kind = _kind_of(request)
    if kind is not None and message.WhichOneof("request") is None:
        checked(_KINDS[kind], request[kind], kind)


def _kind_of(request):
    """Whether fields of a request are for a key or for its removal."""
    named = [kind for kind in _KINDS if isinstance(request, collections.abc.Mapping) and kind in request]
    return next((kind for kind in named if request[kind] is not None), named[0] if named else None)


def _without_pose(key):
    """Of a key of any kind: its id and when it is to be, if it says so."""
    fields = key if isinstance(key, collections.abc.Mapping) else {}
    name = fields.get("id")
    when = {kind: fields.get(kind) for kind in ("frame", "time", "interval_after_previous")}
    try:
        blank = checked(choreography.Keyframe, when, "keyframe")
    except ChoreoError:
        blank = choreography.Keyframe()
    if blank.WhichOneof("when") is None:
        blank.frame = _NOWHERE
    blank.id = name if isinstance(name, str) else ""
    return blank

"""Keys that the package's own check refuses, in dances that go on without bad keys. In place of each the server is told a blank: a key with
neither a moment nor a pose. It rejects that in its turn, and again where the dance is resumed; the caller is told what was wrong here."""

import collections.abc

from . import choreography
from ._check import checked
from ._errors import ChoreoError


class RefusedKeys:
    def __init__(self):
        # Of all keys without a moment, in order: what was wrong here, or None for one that the caller left so.
        self._unplaced = []
        self._answered = 0  # of them, by the present server

    def restart(self):
        """Another server is told all again."""
        self._answered = 0

    def note(self, request):
        """A request that is said as it is."""
        if request.HasField("keyframe") and request.keyframe.WhichOneof("when") is None:
            self._unplaced.append(None)

    def blank(self, request, error):
        """What to say instead of a request for a key that `error` refuses; None where more than the key is wrong."""
        key = request.get("keyframe") if isinstance(request, collections.abc.Mapping) else None
        if key is None:
            return None
        name = key.get("id") if isinstance(key, collections.abc.Mapping) else None
        keyframe = choreography.Keyframe(id=name if isinstance(name, str) else "")
        try:
            blank = checked(choreography.StreamDanceRequest, {**request, "keyframe": keyframe}, "request")
        except ChoreoError:
            return None
        self._unplaced.append(error.violations[0])
        return blank

    def take_event(self, event):
        """Changes it to what the caller is to hear."""
        rejected = event.keyframe_rejected
        if rejected.code != choreography.REJECTION_CODE_INVALID or rejected.field != "keyframe" or event.frame >= 0:
            return
        wrong = self._unplaced[self._answered]
        self._answered += 1
        if wrong is not None:
            rejected.field, rejected.reason = wrong

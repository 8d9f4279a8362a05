"""Stores all requests of a dance, in order, to repeat them to another server: a dance resumes from the last continuation and the same messages.
Discards only music that is no longer needed."""

import collections.abc
import re
import threading

from . import choreography
from ._check import checked, require_kind, require_sendable
from ._errors import ChoreoError, Violation, invalid
from ._from_loop import FromLoop
from ._refused_keys import RefusedKeys, require_key
from ._words import quoted

_BYTES = {choreography.AUDIO_ENCODING_PCM_F32LE: 4, choreography.AUDIO_ENCODING_PCM_S16LE: 2}
_ONCE = ("config", "end_of_audio", "keyframes_complete")  # kinds of requests of which a dance takes one


class Journal:
    """The requests of a dance. Calls read them on threads of their own, one call after another."""

    def __init__(self, requests):
        if isinstance(requests, (collections.abc.Mapping, choreography.StreamDanceRequest)):
            raise invalid("requests", "is one request: put it in a list, [{'config': ...}, ...]")
        if not hasattr(requests, "__iter__"):
            raise invalid("requests", f"{quoted(requests)} is not an iterable of messages")
        self._source = iter(requests)
        self._asking = threading.Lock()
        self._said = []  # None: discarded
        self._over = False
        self._music_end = None  # end of the discarded music
        self._next_piece = None  # start of the next piece of music
        self.refused_keys = RefusedKeys()
        self.failure = None  # the exception that the source raised

    def at(self, index):
        """Returns request number `index`, or None if it is discarded. Raises IndexError if the source ended before it, or what the source
        raised."""
        while index >= len(self._said):
            with self._asking:  # one call at a time reads the source
                if index < len(self._said):
                    break
                if self._over:
                    raise self.failure or IndexError(index)
                self._ask()
        return self._said[index]

    def _ask(self):
        try:
            self._said.append(self._checked(next(self._source)))
        except StopIteration:
            self._over = True
        except BaseException as failure:
            self._over, self.failure = True, failure
            raise

    def _checked(self, request):
        config = self._said[0].config if self._said else choreography.DanceConfig()
        try:
            fine = checked(choreography.StreamDanceRequest, request, f"requests[{len(self._said)}]", config.audio_format.encoding)
            require_key(request, fine)
            require_kind(fine, len(self._said))
            require_sendable(fine, "send it in pieces")
            self.refused_keys.note(fine)
            return self._numbered(fine) if self._said and fine.HasField("audio") else fine
        except ChoreoError as error:  # the source did not fail itself
            blank = self.refused_keys.blank(request, error) if config.reject_invalid_keys else None
            if blank is not None:
                return blank
            self._end_source()
            key = request.get("keyframe") if isinstance(request, collections.abc.Mapping) else None
            name = key.get("id") if isinstance(key, collections.abc.Mapping) else None
            if isinstance(name, str):
                error.violations = [Violation(*violation, keyframe_id=name, joint=violation.joint) for violation in error.violations]
            raise error.located(lambda violation: (None, len(self._said)), lambda field, message: (field, None))

    def _numbered(self, request):
        """Numbers a piece of music: it starts at the end of the previous one unless the caller gives its start. For a file, counts bytes."""
        start = request.audio.first_sample
        if not start:
            start = self._said[0].config.audio_format.first_sample if self._next_piece is None else self._next_piece
        self._next_piece = start + len(request.audio.data) // (self.bytes_per_sample() or 1)
        if start == request.audio.first_sample:
            return request
        numbered = choreography.StreamDanceRequest()
        numbered.CopyFrom(request)  # the caller's request stays unchanged
        numbered.audio.first_sample = start
        return numbered

    def _end_source(self):
        if hasattr(self._source, "close"):
            self._source.close()

    def close(self):
        """Ends the source: no more requests are needed. A source that is producing a request is not interrupted, unless it is asynchronous."""
        if isinstance(self._source, FromLoop):
            self._source.close()
        if self._asking.acquire(blocking=False):
            self._over = True
            self._end_source()
            self._asking.release()

    def find(self, violation):
        """Finds the latest request that may contain the violation's field, or None; for a key, the request with its id, if it is known. Also
        returns the request's index if no other one may contain the field, if no other one has the value with which the error's description
        begins, or if it is the second of a kind that may come once."""
        kind, *members = re.findall(r"\w+", violation.field) or [""]

        def may_have(request):
            if request is None:
                return kind == "audio"
            return request.WhichOneof("request") == kind and (kind != "keyframe" or violation.keyframe_id in (None, request.keyframe.id))

        found = [(request, at) for at, request in enumerate(list(self._said)) if may_have(request)]
        if not found:
            return None, None
        said = [one for one in found if members and violation.description.startswith(f"{_value(one[0], [kind, *members])} ")]
        if len(said) == 1:
            return said[0]
        if len(found) > 1 and violation.field in _ONCE:
            return found[1]
        request, at = found[-1]
        return request, at if len(found) == 1 else None

    def forget_music_before(self, sample, sent):
        """Discards music before this sample, which another server would not need. The present server has been sent the first `sent`
        requests."""
        size = self.bytes_per_sample()
        if size == 0:
            return
        for at, request in enumerate(self._said[:sent]):
            if request is None or not request.HasField("audio"):
                continue
            end = request.audio.first_sample + len(request.audio.data) // size
            if end > sample:
                return
            self._music_end = end
            self._said[at] = None

    def first_sample(self):
        """The first sample of music still stored."""
        for request in list(self._said):
            if request is not None and request.HasField("audio"):
                return request.audio.first_sample
        return self._said[0].config.audio_format.first_sample if self._music_end is None else self._music_end

    def bytes_per_sample(self):
        """Bytes per sample, of all channels together; 0 without music, and for a music file, which is decoded as a whole."""
        audio_format = self._said[0].config.audio_format
        return _BYTES.get(audio_format.encoding, 0) * audio_format.channels


def _value(message, path):
    """The value at a path of names and indices; None where there is none."""
    for name in path:
        try:
            message = message[int(name)] if name.isdigit() else getattr(message, name)
        except (AttributeError, IndexError, TypeError):
            return None
    return message

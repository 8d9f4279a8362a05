"""Filters out the answers that a resumed dance repeats, so that the caller receives each once."""

import collections
import math

from ._errors import ChoreoError, wrong_field

_PER_FRAME = ("root_positions", "rotations", "contacts")


def first_output_frame(header):
    """The first output frame at or after the first frame."""
    return math.ceil(header.first_frame * header.frame_rate / header.model_frame_rate - 1e-9)


def require_same_fingerprint(begun, header, address, remedy=""):
    """Raises for a server of another fingerprint, which would generate other frames; another server may have the right one. The error's field
    is the one that servers name. `remedy`: how to permit it, for the message."""
    if header.fingerprint != begun:
        what = f'begun by "{begun}"; {address} has "{header.fingerprint}"{remedy}'
        raise wrong_field("FAILED_PRECONDITION", "config.continuation.fingerprint", what)


class DeliveryFilter:
    def __init__(self, header):
        self._next_frames = collections.defaultdict(lambda: first_output_frame(header))  # by candidate; a dance has one candidate
        self._rejected = []  # (id, frame) of rejected keys, as delivered
        self._expected = []  # answers that the present server has yet to repeat
        self._told = set()  # delivered warnings, and keys that were reached
        self._last_beat = -1.0

    def next_frame(self, candidate=0):
        """The next frame to deliver, at the output rate."""
        return self._next_frames[candidate]

    def restart(self, frame, late):
        """Prepares for another server, which continues from `frame` (at the model's rate) and receives all requests again. `late`: the keys
        before that frame, each listed as often as it was sent. The new server will report these as rejected or as reached."""
        # Keys without a frame are not in `late`.
        self._expected = late + [place for place in self._rejected if place[1] >= frame or place[1] < 0]

    def take_frames(self, frames):
        """Removes frames that were delivered already. Returns False if none is left."""
        due = self._next_frames[frames.candidate]
        if frames.first_frame > due:
            raise ChoreoError("DATA_LOSS", f"the server left out frames: {frames.first_frame} came where {due} was due")
        end, known = frames.first_frame + frames.count, due - frames.first_frame
        if end <= due:
            return False
        for numbers in (getattr(frames, field) for field in _PER_FRAME):
            del numbers[: len(numbers) // frames.count * known]
        frames.first_frame, frames.count = due, end - due
        self._next_frames[frames.candidate] = end
        return True

    def take_event(self, event):
        """Whether an event is new."""
        kind = event.WhichOneof("event")
        if kind == "keyframe_rejected":
            return self._is_new_rejection((event.keyframe_rejected.id, event.frame))
        if kind == "keyframe_reached":
            self._take_expected((event.keyframe_reached.id, event.frame))
            return self._is_new((kind, event.keyframe_reached.id, event.frame))
        if kind == "warning":
            return self._is_new((kind, event.warning.message, event.frame))
        if kind == "beat":
            if event.time <= self._last_beat:
                return False
            self._last_beat = event.time
        return True

    def _is_new(self, what):
        if what in self._told:
            return False
        self._told.add(what)
        return True

    def _is_new_rejection(self, place):
        if self._take_expected(place):
            return False
        self._rejected.append(place)
        return True

    def _take_expected(self, place):
        if place not in self._expected:
            return False
        self._expected.remove(place)
        return True

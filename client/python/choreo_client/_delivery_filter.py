"""Filters out the answers that a resumed dance repeats, so that the caller receives each once."""

import collections
import math

from . import choreography
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
        self._first_frame = header.first_frame  # at the model's rate
        self._rejections = 0  # delivered
        self._repeats = 0  # rejections that the present server has yet to repeat
        self._told = set()  # delivered warnings, and keys that were reached
        self._last_beat = -1.0

    def next_frame(self, candidate=0):
        """The next frame to deliver, at the output rate."""
        return self._next_frames[candidate]

    def restart(self):
        """Prepares for another server, which receives all requests again."""
        self._repeats = self._rejections

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
            return self._is_new_rejection(event)
        if kind == "keyframe_reached":
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

    def _is_new_rejection(self, event):
        """Rejections depend on the order of the requests alone, so every server sends the same ones, in this order. A resumed server
        also rejects, as already danced, keys that the first server accepted; those are left out."""
        if event.keyframe_rejected.code == choreography.REJECTION_CODE_ALREADY_DANCED and event.frame >= self._first_frame:
            return False
        if self._repeats > 0:
            self._repeats -= 1
            return False
        self._rejections += 1
        return True

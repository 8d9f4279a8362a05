"""Tells what a resumed dance says again from what is new, so that the caller hears everything once."""

import collections
import math

from ._errors import ChoreoError, wrong_field

_PER_FRAME = ("root_positions", "rotations", "contacts")


def first_output_frame(header):
    """Where the first output frame stands that is not before the first frame."""
    return math.ceil(header.first_frame * header.frame_rate / header.model_frame_rate - 1e-9)


def require_same_fingerprint(begun, header, address, remedy=""):
    """A server of another fingerprint makes other frames; another one may do better. The field is the one that servers name. `remedy`: what
    would let it be."""
    if header.fingerprint != begun:
        what = f'begun by "{begun}"; {address} has "{header.fingerprint}"{remedy}'
        raise wrong_field("FAILED_PRECONDITION", "config.continuation.fingerprint", what)


class DeliveryFilter:
    def __init__(self, header):
        self._next_frames = collections.defaultdict(lambda: first_output_frame(header))  # of each candidate; a dance has one
        self._rejected = []  # (id, frame) of keys, as they were told
        self._expected = []  # answers that the present server is still to repeat
        self._told = set()  # keys that were reached, warnings
        self._last_beat = -1.0

    def next_frame(self, candidate=0):
        """The next frame to be told, at the output rate."""
        return self._next_frames[candidate]

    def restart(self, frame, late):
        """Another server goes on from `frame` (at the model's rate), and is told all again. Of that, it will answer the keys that
        stand before as rejected, or as reached: `late`, each as often as it was spoken of."""
        # Keys without a frame are none of `late`.
        self._expected = late + [place for place in self._rejected if place[1] >= frame or place[1] < 0]

    def take_frames(self, frames):
        """Cuts away the frames that were told already; False if none is left."""
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
        """Whether it is new."""
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

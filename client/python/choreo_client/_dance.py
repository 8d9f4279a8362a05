"""A dance that survives the loss of its server: it resumes on another one from the last continuation, and the caller reads the same answers."""

import dataclasses
import threading
import warnings

import grpc

from . import choreography
from ._as_sent import as_sent
from ._errors import ChoreoError, Violation, unavailable
from ._journal import Journal
from ._delivery_filter import DeliveryFilter, require_same_fingerprint


@dataclasses.dataclass(frozen=True)
class Resumed:
    """Reports that a dance has resumed on another server."""

    address: str
    frame: int  # the next frame to arrive, at the output rate
    # False if the new server has another fingerprint, which config.allow_inexact_resume permitted. The dance then continues differently: smoothly
    # or, before the first continuation, with the new server's own frames.
    exact: bool
    because: ChoreoError  # the failure of the previous server


class KeyRejectedWarning(UserWarning):
    """A key is not danced as it was sent."""


def _warn(rejected):
    """Warns callers without `on_rejected` of keys that are not danced, except invalid keys, whose rejection they requested."""
    if rejected.code != choreography.REJECTION_CODE_INVALID:
        warnings.warn(f'key "{rejected.id}" is not danced as it was sent: {rejected.reason}', KeyRejectedWarning, stacklevel=2)


def dance(replicas, requests, on_resume, on_rejected, until):
    """Yields the answers of StreamDance to `requests`."""
    journal = Journal(requests)
    progress = _Progress(journal, on_resume, on_rejected or _warn)

    def attempt(server, patience):
        progress.restart()
        saying = _Saying(journal, progress)
        metadata = [*replicas.options.metadata(), *progress.resumed_from()]
        call = until.begin(server.stream_dance(iter(saying), timeout=until.remaining(), metadata=metadata))
        saying.begin(call)
        try:
            for answer in call:
                progress.note_call(call)
                if progress.take(answer, server.address, saying.count):
                    if answer.HasField("frames"):
                        patience.reset()
                    yield answer
        except (grpc.RpcError, ChoreoError) as failure:
            if journal.failure is not None:
                raise journal.failure from None
            if not progress.complete:  # else nothing of the status matters any more
                ours = isinstance(failure, ChoreoError)
                progress.lost_because = failure if ours else ChoreoError.of(failure, journal.find)
                raise progress.lost_because from None
        finally:
            call.cancel()  # a finished one does not mind
        if not progress.complete:
            progress.lost_because = unavailable("the server ended the dance before its summary")
            raise progress.lost_because

    try:
        yield from replicas.persist(attempt, until)
    finally:
        journal.close()


class _Saying:
    """Iterates over the requests of one call, from the journal. gRPC reads them on a thread of its own."""

    def __init__(self, journal, progress):
        self._journal, self._progress = journal, progress
        self._call = None
        self._begun = threading.Event()
        self.count = 0  # requests that it has been told

    def begin(self, call):
        self._call = call
        self._begun.set()

    def __iter__(self):
        while True:
            try:
                request = self._journal.at(self.count)
            except IndexError:
                return
            except BaseException:  # the journal knows what went wrong
                self._begun.wait()
                self._call.cancel()
                return
            self.count += 1
            if request is not None:
                yield self._progress.first(request) if self.count == 1 else request


class _Progress:
    """The received part of a dance, and how another server continues it."""

    def __init__(self, journal, on_resume, on_rejected):
        self._journal, self._on_resume, self._on_rejected = journal, on_resume, on_rejected
        self._header = self._continuation = self._filter = None
        self._fingerprint = None  # of the server that danced last
        self._stream_id = None  # of the first call, in its server's log
        self._may_differ = False
        self.complete = False
        self.lost_because = None

    def first(self, request):
        """Returns the first request of an attempt."""
        self._may_differ = request.config.allow_inexact_resume
        if self._header is None or not request.HasField("config"):
            return request
        again = choreography.StreamDanceRequest()
        again.CopyFrom(request)
        # Another server must generate the same dance with the same model.
        again.config.seed, again.config.model = self._header.seed, self._header.model
        if self._continuation is not None:
            again.config.continuation.CopyFrom(self._continuation)
        if self._journal.bytes_per_sample() > 0:
            again.config.audio_format.first_sample = self._journal.first_sample()
        return again

    def note_call(self, call):
        """Notes a call that the server has answered."""
        if self._stream_id is None:
            self._stream_id = dict(call.initial_metadata()).get("choreo-stream-id", "")

    def resumed_from(self):
        """Returns metadata that name the first call, for the logs of both servers."""
        return [("choreo-resumed-from", self._stream_id)] if self._stream_id else []

    def restart(self):
        """Prepares for another server."""
        self._journal.refused_keys.restart()
        if self._filter is not None:
            self._filter.restart()

    def take(self, answer, address, sent):
        """Changes an answer to the part for the caller. Returns False if there is none. `sent`: the number of requests sent to the server."""
        kind = answer.WhichOneof("response")
        if kind == "header":
            return self._take_header(answer.header, address)
        if kind == "frames":
            return self._filter.take_frames(answer.frames)
        if kind == "event":
            self._name_as_sent(answer.event.keyframe_rejected)
            self._journal.refused_keys.take_event(answer.event)
            is_news = self._filter.take_event(answer.event)
            if is_news and answer.event.HasField("keyframe_rejected"):
                self._on_rejected(answer.event.keyframe_rejected)
            return is_news
        if kind == "continuation":
            self._continuation = answer.continuation
            self._journal.forget_music_before(self._continuation.audio_from_sample, sent)
        elif kind == "summary":
            self._take_summary(answer.summary.report)
        return kind is not None  # else of a newer version of the protocol

    def _name_as_sent(self, rejected):
        if rejected.field:
            violation = Violation(rejected.field, rejected.reason, rejected.id)
            rejected.field, _ = as_sent(rejected.field, self._journal.find(violation)[0])

    def _take_header(self, header, address):
        if self._header is None:
            self._header, self._filter = header, DeliveryFilter(header)
            self._fingerprint = header.fingerprint
            return True
        if header.frame_rate != self._header.frame_rate or header.skeleton.joint_names != self._header.skeleton.joint_names:
            raise ChoreoError("DATA_LOSS", "the server that should resume the dance has another frame rate or body")
        # Servers compare fingerprints only if there is a continuation.
        exact = header.exact_resume
        if self._continuation is None:
            exact = header.fingerprint == self._fingerprint
            if not self._may_differ:
                remedy = ", which config.allow_inexact_resume would let go on"
                require_same_fingerprint(self._fingerprint, header, address, remedy)
        self._fingerprint = header.fingerprint
        if self._on_resume is not None:
            self._on_resume(Resumed(address, self._filter.next_frame(), exact, self.lost_because))
        return False

    def _take_summary(self, report):
        """Completes a summary. The server counts only the frames that it generated itself: adds those of earlier servers."""
        self.complete = True
        report.frames += report.first_frame - self._header.first_frame
        report.first_frame = self._header.first_frame

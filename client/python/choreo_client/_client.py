from __future__ import annotations

import threading
import typing

from . import choreography
from ._dance import Resumed, dance
from ._errors import invalid
from ._from_loop import FromLoop
from ._options import Options
from ._replicas import Cancellation, Replicas
from ._transition import transition


Answer = typing.TypeVar("Answer")
Fields = typing.Mapping[str, typing.Any]  # of a message, by name
Requests = typing.Iterable[typing.Union[choreography.StreamDanceRequest, Fields]]
AsyncRequests = typing.AsyncIterable[typing.Union[choreography.StreamDanceRequest, Fields]]


class Answers(typing.Generic[Answer]):
    """A server's answers, as they arrive. If you stop reading early, end the call: use this as a context manager. Any thread may read, one at
    a time, and any other leave the context meanwhile."""

    def __init__(self, answers, until, source=None):
        self._answers, self._until, self._source = answers, until, source
        self._reading = threading.RLock()

    def __iter__(self) -> Answers[Answer]:
        return self

    def __next__(self) -> Answer:
        if isinstance(self._source, FromLoop):
            self._source.require_elsewhere()
        with self._reading:
            return next(self._answers)

    def __enter__(self) -> Answers[Answer]:
        return self

    def __exit__(self, *_: object) -> None:
        self.cancel()
        with self._reading:
            self._answers.close()

    def cancel(self) -> None:
        """Ends the call, here and on the server, from any thread; reading then raises ChoreoError, code CANCELLED."""
        self._until.cancel()


class Client:
    """A client of one server or of several replicas. Connections are made when needed. A call whose server is lost, is full or refuses a model
    or fingerprint is tried at the next address. Thread-safe, but to be made after a fork. Calls block. Every failure is a ChoreoError, but for
    what `requests`, `on_resume` and `on_rejected` raise, which comes as it is, and names that are no options: a TypeError.

    `addresses`: HOST:PORT, unix:PATH or a list of them, which are replicas: when one fails the next is asked. Calls take turns at the
    addresses of one name (dns:///NAME:PORT), or of one list (ipv4:A:PORT,B:PORT), and pass those whose health says that they do not serve,
    unless `even_draining`.
    `options`: those of Options."""

    def __init__(self, addresses: typing.Union[str, typing.Iterable[str]], **options: typing.Any) -> None:
        if not hasattr(addresses, "__iter__"):
            raise invalid("addresses", f"{addresses!r} is neither HOST:PORT nor a list of them")
        self._replicas = Replicas([addresses] if isinstance(addresses, str) else list(addresses), Options(**options))

    def close(self) -> None:
        """Ends its calls with CANCELLED, and refuses others."""
        self._replicas.close()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def info(self, timeout: typing.Optional[float] = None, cards: bool = False) -> choreography.GetServerInfoResponse:
        """Models, limits, devices: a GetServerInfoResponse. `timeout`: seconds, of all attempts together. `cards`: with the models' cards, JSON
        of some 30 KB each."""
        until = Cancellation(timeout)
        request = choreography.GetServerInfoRequest(without_cards=not cards)
        metadata = self._replicas.options.metadata

        def attempt(server, _):
            yield server.get_server_info(request, timeout=until.remaining(), metadata=metadata())

        return next(self._replicas.persist(attempt, until))

    def stream_dance(
        self,
        requests: typing.Union[Requests, AsyncRequests],
        on_resume: typing.Optional[typing.Callable[[Resumed], object]] = None,
        timeout: typing.Optional[float] = None,
        on_rejected: typing.Optional[typing.Callable[[choreography.KeyframeRejected], object]] = None,
    ) -> Answers[choreography.StreamDanceResponse]:
        """Dances. Sends the `requests`, an iterable of StreamDanceRequests or of their fields ({"keyframe": ...}), on another thread as fast as
        the server takes them, and gives the answers meanwhile: Answers with StreamDanceResponses. An asynchronous iterable is awaited in the
        loop that runs where this is called; aio.stream reads the answers.

        When its server is lost, the dance goes on at the next one from the last continuation: answers are those of an undisturbed dance, bit
        for bit. `on_resume` alone hears of it: Resumed. Requests must not be changed once they are said: they may be said again. One that the
        API does not know ends the dance, naming the field's path; of a key or its removal, with config.reject_invalid_keys, it is a
        keyframe_rejected, and the dance goes on. (The summary's shares are those of the frames since the last resume.)

        A key that comes too late, after later ones have settled its frames, is not danced. `on_rejected` hears of it, beside the event; without
        it there is a KeyRejectedWarning."""
        until = Cancellation(timeout)
        source = FromLoop(requests) if hasattr(requests, "__aiter__") else requests
        return Answers(dance(self._replicas, source, on_resume, on_rejected, until), until, source)

    def generate_transition(
        self, request: typing.Union[choreography.GenerateTransitionRequest, Fields], timeout: typing.Optional[float] = None
    ) -> Answers[choreography.GenerateTransitionResponse]:
        """One transition, in one or several candidates: Answers with GenerateTransitionResponses. `request`: one, or its fields. When its server
        is lost, another one makes it again; nothing is told twice."""
        until = Cancellation(timeout)
        return Answers(transition(self._replicas, request, until), until)

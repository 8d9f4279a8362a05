from __future__ import annotations

import inspect
import threading
import typing

from . import choreography
from ._dance import Resumed, dance
from ._errors import invalid
from ._from_loop import FromLoop
from ._options import Options, options_of
from ._replicas import Cancellation, Replicas
from ._transition import transition


Answer = typing.TypeVar("Answer")
Fields = typing.Mapping[str, typing.Any]  # of a message, by name
Requests = typing.Iterable[typing.Union[choreography.StreamDanceRequest, Fields]]
AsyncRequests = typing.AsyncIterable[typing.Union[choreography.StreamDanceRequest, Fields]]


class Answers(typing.Generic[Answer]):
    """Iterates over a server's answers as they arrive. To stop reading early, end the call: use this as a context manager. Any thread may read,
    one at a time; another thread may leave the context meanwhile."""

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
        self.close()

    def close(self) -> None:
        """Ends the call, here and on the server, as leaving the context does. Reading then ends. Any thread may call it."""
        self.cancel()
        with self._reading:
            self._answers.close()

    def cancel(self) -> None:
        """Ends the call, here and on the server. Reading then raises ChoreoError with the code CANCELLED. Any thread may call it."""
        self._until.cancel()


class Client:
    """A client of one server or of several replicas. It connects when needed. If a server is lost, is full, or refuses a model or fingerprint,
    the call is retried at the next address. Thread-safe; create clients after forking, not before. Calls block. Every failure is a ChoreoError,
    except that exceptions of `requests`, `on_resume` and `on_rejected` are passed on unchanged.

    `addresses`: HOST:PORT, unix:PATH, or a list of replicas: if one fails, the next is tried. Calls are distributed in turn over the addresses
    of one name (dns:///NAME:PORT) or one list (ipv4:A:PORT,B:PORT). Addresses whose health is not serving are skipped, unless
    `even_draining`.
    `options`: those of Options."""

    def __init__(self, addresses: typing.Union[str, typing.Iterable[str]], **options: typing.Any) -> None:
        if not hasattr(addresses, "__iter__") or isinstance(addresses, (bytes, bytearray)):
            raise invalid("addresses", f"{addresses!r} is neither HOST:PORT nor a list of them")
        self._replicas = Replicas([addresses] if isinstance(addresses, str) else list(addresses), options_of(options))

    def close(self) -> None:
        """Ends all calls in progress with CANCELLED, and refuses further calls."""
        self._replicas.close()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def info(self, timeout: typing.Optional[float] = None, cards: bool = False) -> choreography.GetServerInfoResponse:
        """Gets the server's models, limits and devices, as a GetServerInfoResponse. `timeout`: seconds for all attempts together. `cards`:
        includes the models' cards, JSON of about 30 KB each."""
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
        """Runs a dance. Sends the `requests`, an iterable of StreamDanceRequests or of their fields ({"keyframe": ...}), on another thread as
        fast as the server accepts them, and returns Answers with StreamDanceResponses, to be read meanwhile. An asynchronous iterable is
        awaited in the event loop in which this is called; aio.stream reads the answers.

        If its server is lost, the dance resumes on the next one from the last continuation, with exactly the answers of an uninterrupted dance;
        only `on_resume`, which is called with a Resumed, reports it. The summary's shares then cover only the frames since the last
        resumption. Do not change requests after yielding them, because they may be sent again.

        A request that is not valid in the API ends the dance with an error that names the field's path. With config.reject_invalid_keys, an
        invalid key or removal of a key is answered by a keyframe_rejected instead, and the dance continues.

        A key that is too late, because later keys have made its frames final, is not danced. In addition to the event, `on_rejected` is called;
        without it, a KeyRejectedWarning is issued."""
        until = Cancellation(timeout)
        source = FromLoop(requests) if hasattr(requests, "__aiter__") else requests
        return Answers(dance(self._replicas, source, on_resume, on_rejected, until), until, source)

    def generate_transition(
        self, request: typing.Union[choreography.GenerateTransitionRequest, Fields], timeout: typing.Optional[float] = None
    ) -> Answers[choreography.GenerateTransitionResponse]:
        """Generates one transition, as one or several candidates. Returns Answers with GenerateTransitionResponses. `request`: a
        GenerateTransitionRequest or its fields. If its server is lost, another one repeats it; no answer is delivered twice."""
        until = Cancellation(timeout)
        return Answers(transition(self._replicas, request, until), until)


def _with_options(call):
    """The signature of `call` with the options by name, for help() and editors."""
    own = inspect.signature(call)
    positional = [one for one in own.parameters.values() if one.kind is not one.VAR_KEYWORD]
    options = [one.replace(kind=one.KEYWORD_ONLY) for one in inspect.signature(Options).parameters.values()]
    return own.replace(parameters=positional + options)


Client.__init__.__signature__ = _with_options(Client.__init__)  # type: ignore[attr-defined]

"""The servers that may be asked, one at a time, and how long to go on asking."""

import contextlib
import math
import numbers
import random
import threading
import time

import grpc

from . import choreography
from ._connect_faults import explained
from ._errors import ChoreoError, advice_for, invalid
from ._words import quoted

LONGEST_BACKOFF = 2  # seconds


class Server:
    """One address, and its three calls."""

    def __init__(self, address, options, credentials):
        self.address = address
        self.was_there = False
        arguments = options.channel_options()
        if credentials is None:
            self.channel = grpc.insecure_channel(address, arguments)
        else:
            self.channel = grpc.secure_channel(address, credentials, arguments)
        self.get_server_info = self._call(self.channel.unary_unary, "GetServerInfo")
        self.generate_transition = self._call(self.channel.unary_stream, "GenerateTransition")
        self.stream_dance = self._call(self.channel.stream_stream, "StreamDance")

    @staticmethod
    def _call(kind, name):
        request, response = getattr(choreography, name + "Request"), getattr(choreography, name + "Response")
        return kind(f"/choreo.v1.Choreography/{name}", request.SerializeToString, response.FromString)


class Replicas:
    """Thread-safe."""

    def __init__(self, addresses, options):
        options.check(addresses)
        credentials = options.credentials()
        self.options = options
        self._servers = [Server(address, options, credentials) for address in addresses]
        self._current = 0
        self._closed = False
        self._lock = threading.Lock()

    def close(self):
        """Ends all calls."""
        self._closed = True
        for server in self._servers:
            server.channel.close()

    def persist(self, attempt, until):
        """The answers of `attempt(server, patience)`, a generator, which is asked for again, of one server after another, until it ends or
        trying again would not help. `until`: the call's Cancellation."""
        patience = Patience(self.options, until, len(self._servers))
        while True:
            server = self._servers[self._current]
            try:
                until.check()
                with contextlib.closing(attempt(server, patience)) as answers:
                    for answer in answers:
                        server.was_there = True
                        yield answer
                return
            except grpc.RpcError as failure:
                error = ChoreoError.of(failure)
            except ChoreoError as failure:
                error = failure
            except ValueError:  # what closed channels raise
                if not self._closed:
                    raise
            if self._closed:
                raise ChoreoError("CANCELLED", "the client is closed")
            if until.cancelled:
                raise error
            error = explained(error, server, self.options)
            wait = patience.next(error, self._leave(server), server.address)
            if wait is None:
                raise _named(patience.verdict, patience.away if patience.verdict.is_away else [patience.verdict_of])
            until.wait(wait)

    def _leave(self, failed):
        """This one failed: go on to the next, unless another call went on already. False where there is no other."""
        with self._lock:
            if self._servers[self._current] is failed:
                self._current = (self._current + 1) % len(self._servers)
        return len(self._servers) > 1


def _named(error, addresses):
    """Whoever is away is named."""
    if error.code == "UNAVAILABLE":
        error.args = (f"{', '.join(addresses)}: {error}",)
    return error


class Cancellation:
    """Ends a call, from any thread, whichever attempt it is at; and when it has to be over by itself."""

    def __init__(self, timeout=None):
        if timeout is not None and (not isinstance(timeout, numbers.Real) or math.isnan(timeout)):
            raise invalid("timeout", f"{quoted(timeout)} is no number of seconds")
        for_ever = timeout is None or timeout > threading.TIMEOUT_MAX  # which gRPC would take for the past
        self.deadline = None if for_ever else time.monotonic() + timeout
        self._asked = threading.Event()
        self._lock = threading.Lock()
        self._call = None

    @property
    def cancelled(self):
        return self._asked.is_set()

    def remaining(self):
        """Seconds, or None: for ever."""
        return None if self.deadline is None else max(0.0, self.deadline - time.monotonic())

    def check(self):
        if self.cancelled:
            raise ChoreoError("CANCELLED", "the call was cancelled")

    def wait(self, seconds):
        self._asked.wait(seconds)

    def begin(self, call):
        """An attempt, which ends with the call."""
        with self._lock:
            self._call = call
        if self.cancelled:
            call.cancel()
        return call

    def cancel(self):
        self._asked.set()
        with self._lock:
            call = self._call
        if call is not None:
            call.cancel()


class Patience:
    """How long to wait before the next attempt of a call, if there is to be one."""

    def __init__(self, options, until, servers):
        self._options, self._until, self._servers = options, until, servers
        self._since = 0.0
        self.reset()

    def reset(self):
        """There was progress: count from the beginning."""
        self._failures = 0  # since then
        self._refusals = 0  # of servers that would refuse again, one after another
        self.away = {}  # the addresses at which no server was reached since then, in order
        # What to tell the caller. Why a server that is there would not serve says more than that another one is away.
        self.verdict = self.verdict_of = None

    def next(self, failed, elsewhere, address):
        """Seconds, or None where trying again would not help, or is no longer allowed."""
        if failed.is_away:
            self.away[address] = True
        advice = advice_for(failed)
        now = time.monotonic()
        if self._failures == 0:
            self._since = now
        if not advice.here or self.verdict is None or advice_for(self.verdict).here:
            self.verdict, self.verdict_of = failed, address
        # Once all have refused there is no other one left to do better.
        self._refusals = 0 if advice.here else self._refusals + 1
        useful = advice.here or (advice.elsewhere and self._refusals < self._servers)
        left = self._options.retry_s - (now - self._since)
        asked = 0 if elsewhere else advice.wait_s  # what a server asks for concerns itself
        if not useful or left <= 0 or asked > left:
            return None
        doubled = min(LONGEST_BACKOFF, self._options.first_backoff_s * 2**self._failures)
        self._failures += 1
        # Clients that lost the same server should not all come back at once.
        wait = max(asked, min(left, doubled * random.uniform(0.5, 1)))
        remaining = self._until.remaining()
        return wait if remaining is None or wait < remaining else None

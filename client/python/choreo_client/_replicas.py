"""The servers of a client, of which one is in use, and the retries of calls."""

import contextlib
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
    """One server: an address, and its three calls."""

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
    """The available servers, and the one in use. Thread-safe."""

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
        """Yields the answers of `attempt(server, patience)`, a generator. Calls it again, on one server after another, until it ends or a retry
        is useless. `until`: the call's Cancellation."""
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
            except ValueError:  # closed channels raise it
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
        """Switches from a failed server to the next, unless another call already has. Returns False if there is no other."""
        with self._lock:
            if self._servers[self._current] is failed:
                self._current = (self._current + 1) % len(self._servers)
        return len(self._servers) > 1


def _named(error, addresses):
    """Adds the addresses to the error of an unreachable server."""
    if error.code == "UNAVAILABLE":
        error.args = (f"{', '.join(addresses)}: {error}",)
    return error


class Cancellation:
    """Cancels a call, from any thread, during any of its attempts. Also has the call's deadline."""

    def __init__(self, timeout=None):
        if timeout is not None and (not isinstance(timeout, numbers.Real) or timeout != timeout):
            raise invalid("timeout", f"{quoted(timeout)} is not a number of seconds")
        for_ever = timeout is None or timeout > threading.TIMEOUT_MAX  # gRPC would misread a longer timeout as past
        self.deadline = None if for_ever else time.monotonic() + max(0, timeout)
        self._asked = threading.Event()
        self._lock = threading.Lock()
        self._call = None

    @property
    def cancelled(self):
        return self._asked.is_set()

    def remaining(self):
        """The seconds left until the deadline; None: no deadline."""
        return None if self.deadline is None else max(0.0, self.deadline - time.monotonic())

    def check(self):
        if self.cancelled:
            raise ChoreoError("CANCELLED", "the call was cancelled")

    def wait(self, seconds):
        self._asked.wait(seconds)

    def begin(self, call):
        """Registers an attempt, so that it ends with the call."""
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
    """Decides whether to retry a call, and how long to wait before."""

    def __init__(self, options, until, servers):
        self._options, self._until, self._servers = options, until, servers
        self._since = 0.0
        self.reset()

    def reset(self):
        """Restarts the time for retries, because the call made progress."""
        self._failures = 0  # since then
        self._refusals = 0  # consecutive refusals by servers that would refuse again
        self.away = {}  # the addresses at which no server was reached since then, in order
        # The error to report to the caller, and its server's address. A reachable server's refusal takes precedence over an unreachable one.
        self.verdict = self.verdict_of = None

    def next(self, failed, elsewhere, address):
        """Returns the seconds to wait before a retry; None if it would be useless or is no longer allowed."""
        if failed.is_away:
            self.away[address] = True
        advice = advice_for(failed)
        now = time.monotonic()
        if self._failures == 0:
            self._since = now
        # A lone server that was stopping has stopped.
        stopped = self._servers == 1 and failed.is_away and self.verdict is not None and self.verdict.is_leaving
        if not stopped and (not advice.here or self.verdict is None or advice_for(self.verdict).here):
            self.verdict, self.verdict_of = failed, address
        # Counts refusals until all servers have refused.
        self._refusals = 0 if advice.here else self._refusals + 1
        useful = advice.here or (advice.elsewhere and self._refusals < self._servers)
        left = self._options.retry_s - (now - self._since)
        asked = 0 if elsewhere else advice.wait_s  # a server's retry delay applies only to that server
        if not useful or left <= 0 or asked > left:
            return None
        # A server that stops leaves its dances to the others: each of them is asked once without a wait.
        if elsewhere and failed.is_leaving and self._failures + 1 < self._servers:
            self._failures += 1
            return 0
        doubled = min(LONGEST_BACKOFF, self._options.first_backoff_s * 2**self._failures)
        self._failures += 1
        # Clients that lost the same server should not all come back at once.
        wait = max(asked, min(left, doubled * random.uniform(0.5, 1)))
        remaining = self._until.remaining()
        return wait if remaining is None or wait < remaining else None

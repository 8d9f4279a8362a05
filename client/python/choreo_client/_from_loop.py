"""Requests that a program of asyncio makes, for calls, which ask for them on threads of their own."""

import asyncio
import threading

from ._errors import invalid
from ._words import quoted

_END = object()


class FromLoop:
    """An asynchronous iterable as an iterator for another thread: each element is awaited in the loop that runs where this is made."""

    def __init__(self, source):
        try:
            self.loop = asyncio.get_running_loop()
        except RuntimeError:
            raise invalid("requests", f"{quoted(source)} is asynchronous, and no loop runs here") from None
        self._source = source.__aiter__()
        self._state = threading.Lock()
        self._awaited = None
        self._over = False

    def __iter__(self):
        return self

    def require_elsewhere(self):
        """Raises where the loop itself would wait for what it is to make."""
        try:
            here = asyncio.get_running_loop()
        except RuntimeError:
            return
        if here is self.loop:
            raise invalid("requests", "are asynchronous, and would wait for their own loop: read the answers by aio.stream")

    def __next__(self):
        with self._state:
            if self._over:
                raise StopIteration
            self._awaited = asyncio.run_coroutine_threadsafe(self._next(), self.loop)
        try:
            element = self._awaited.result()
        except asyncio.CancelledError:  # as the call is over
            element = _END
        if element is _END:
            raise StopIteration
        return element

    async def _next(self):
        try:
            return await self._source.__anext__()
        except StopAsyncIteration:  # which futures cannot raise
            return _END

    def close(self):
        """Ends the source, also one that is being awaited. Any thread may call it."""
        with self._state:
            if self._over:
                return
            self._over = True
        if self._awaited is not None:
            self._awaited.cancel()
        if hasattr(self._source, "aclose") and not self.loop.is_closed():
            self.loop.call_soon_threadsafe(lambda: self.loop.create_task(self._aclose()))

    async def _aclose(self):
        try:
            await self._source.aclose()
        except RuntimeError:  # it is at its end anyway: cancelled while it was awaited
            pass

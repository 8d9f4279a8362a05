"""Passes requests from an asyncio program to calls, which read them on threads of their own."""

import asyncio
import threading

from ._errors import invalid
from ._words import quoted

_END = object()


class FromLoop:
    """Wraps an asynchronous iterable as an iterator for another thread. Each element is awaited in the event loop in which this object is
    created."""

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
        """Raises in the event loop's own thread, which would wait for itself."""
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
        except asyncio.CancelledError:  # because the call is over
            element = _END
        if element is _END:
            raise StopIteration
        return element

    async def _next(self):
        try:
            return await self._source.__anext__()
        except StopAsyncIteration:  # futures cannot raise StopAsyncIteration
            return _END

    def close(self):
        """Ends the source, even while it is being awaited. Any thread may call it."""
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
        except RuntimeError:  # the source has already ended: it was cancelled while being awaited
            pass

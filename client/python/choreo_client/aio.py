"""For asyncio programs, whose event loop must not block."""

from __future__ import annotations

import asyncio
import concurrent.futures
import typing

from . import choreography
from ._client import Answer, Answers, Client
from ._errors import invalid
from ._words import quoted


async def stream(answers: Answers[Answer]) -> typing.AsyncIterator[Answer]:
    """Yields the answers of a call as they arrive: `async for answer in stream(client.stream_dance(...))`. The call ends if you stop reading, or
    if the task is cancelled. Each call has a thread of its own, because waiting calls would exhaust the event loop's thread pool."""
    if not isinstance(answers, Answers):
        raise invalid("answers", f"{quoted(answers)} is not what stream_dance or generate_transition returns")
    loop = asyncio.get_running_loop()
    thread = concurrent.futures.ThreadPoolExecutor(1, "choreo")
    try:
        while (answer := await loop.run_in_executor(thread, next, answers, None)) is not None:
            yield answer
    finally:
        answers.cancel()  # so the thread's present work ends soon
        thread.submit(answers.__exit__)
        thread.shutdown(wait=False)


async def info(client: Client, timeout: typing.Optional[float] = None, cards: bool = False) -> choreography.GetServerInfoResponse:
    """Awaits `client.info(timeout, cards)`, on a thread of its own. If the task is cancelled, that ends by itself, within its timeout."""
    if not isinstance(client, Client):
        raise invalid("client", f"{quoted(client)} is not a Client")
    thread = concurrent.futures.ThreadPoolExecutor(1, "choreo")
    try:
        return await asyncio.get_running_loop().run_in_executor(thread, client.info, timeout, cards)
    finally:
        thread.shutdown(wait=False)

"""For asyncio programs, whose event loop must not block."""

from __future__ import annotations

import asyncio
import concurrent.futures
import typing

from ._client import Answer, Answers
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

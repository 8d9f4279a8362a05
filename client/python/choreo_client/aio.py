"""For programs of asyncio, whose loop must not wait."""

from __future__ import annotations

import asyncio
import concurrent.futures
import typing

from ._client import Answer, Answers


async def stream(answers: Answers[Answer]) -> typing.AsyncIterator[Answer]:
    """The answers of a call, as they arrive: `async for answer in stream(client.stream_dance(...))`. Whoever stops reading, or is cancelled,
    ends the call. Each has a thread of its own: in the loop's pool calls that wait would leave none to others."""
    loop = asyncio.get_running_loop()
    thread = concurrent.futures.ThreadPoolExecutor(1, "choreo")
    try:
        while (answer := await loop.run_in_executor(thread, next, answers, None)) is not None:
            yield answer
    finally:
        answers.cancel()  # so what the thread is at ends soon
        thread.submit(answers.__exit__)
        thread.shutdown(wait=False)

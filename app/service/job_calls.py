"""How many calls that make jobs, or are about them, may use the threads that all calls share."""

from __future__ import annotations

import asyncio

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.service.middleware import Layer
from app.service.negotiation import AS_JOB, prefers_job
from app.service.problems import Refused
from app.settings import Settings
from core.language import say
from core.quantities import Quantity

# Calls about jobs that wait for the disk at once in one process, and those that wait for their turn: more are refused.
JOB_CALLS, JOB_CALLS_WAITING = 4, 200


class JobCalls(Layer):
    """Lets few calls about jobs at a time into the threads that all calls share, because each waits for the disk.

    The others wait for their turn outside, so that a thousand jobs or removals at once delay no page. A call has its
    slot from the end of its body, which may come slowly, until its answer begins.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self._slots, self._waiting, self._retry_after = asyncio.Semaphore(JOB_CALLS), 0, settings.retry_after

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        scope[AS_JOB] = prefers_job(Headers(scope=scope))
        if not scope[AS_JOB] and not scope["path"].startswith(("/jobs", "/sweeps")):
            return await self.app(scope, receive, send)
        if self._waiting >= JOB_CALLS_WAITING:
            calls = say("{count} waiting calls", count=JOB_CALLS_WAITING)
            most = Quantity(JOB_CALLS_WAITING, "", text=calls)
            values = {"most": most, "seconds": Quantity(self._retry_after, "s")}
            words, after = "The limit of {most} about jobs is reached", {"Retry-After": str(self._retry_after)}
            refused = Refused(503, words, None, after, reason="try again in {seconds}.", **values)
            return await self.refuse(refused, scope, receive, send)
        has_slot = False

        async def enter() -> None:
            nonlocal has_slot
            self._waiting += 1
            try:
                await self._slots.acquire()
            finally:
                self._waiting -= 1
            has_slot = True

        def leave() -> None:
            nonlocal has_slot
            if has_slot:
                self._slots.release()
            has_slot = False

        is_read = scope["method"] in ("GET", "HEAD", "DELETE")

        async def receive_and_enter() -> Message:
            nonlocal is_read
            message = await receive()
            if not is_read and message["type"] == "http.request" and not message.get("more_body", False):
                is_read = True
                await enter()
            return message

        async def send_and_leave(message: Message) -> None:
            leave()
            await send(message)

        if is_read:
            await enter()
        try:
            await self.app(scope, receive_and_enter, send_and_leave)
        finally:
            leave()

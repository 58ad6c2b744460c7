"""An end to every computation: at its deadline, when its client is gone, or soon if the event loop itself makes it."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Coroutine, Iterator
from contextlib import asynccontextmanager, contextmanager
from functools import partial
from threading import Event, Thread, get_ident
from typing import Any

from fastapi import Request, Response
from fastapi.routing import APIRoute

from app.service.lanes import Lanes
from app.settings import Settings
from core import Budget

# The event loop makes a computation itself that should take no longer than this [s]: a thread costs a third of a
# millisecond, a sixth of the answer (2026-11-22). One that takes longer is stopped, and made anew in a thread.
GLANCE = 0.005
# After so many looks at nothing the thread that stops them waits until the next one begins [1].
LOOKS_IDLE = 200

Handler = Callable[[Request], Coroutine[Any, Any, Response]]


class WatchedRoute(APIRoute):
    """A call whose computation ends at the deadline, and when its client is gone."""

    def get_route_handler(self) -> Handler:
        answer = self.unwatched()

        async def handled(request: Request) -> Response:
            async with watched(request, self.seconds(request.app.state.settings)):
                return await answer(request)

        return handled

    def seconds(self, settings: Settings) -> float:
        """How long the computation may take [s]."""
        return settings.deadline_seconds

    def unwatched(self) -> Handler:
        return super().get_route_handler()


@asynccontextmanager
async def watched(request: Request, seconds: float) -> AsyncIterator[None]:
    """Gives the request a budget, which is stopped after so many seconds and when the client is gone."""
    await request.body()  # What is received after it is the end of the connection.
    request.state.budget = Budget()
    task = asyncio.create_task(_watch(request, seconds))
    try:
        yield
    finally:
        task.cancel()


def clock_of_this_thread() -> Callable[[], float]:
    """Clock of the processor time of the thread that asks for it, for any thread to read; elsewhere than on Unix of all
    time [s]."""
    if not hasattr(time, "pthread_getcpuclockid"):
        return time.monotonic
    return partial(time.clock_gettime, time.pthread_getcpuclockid(get_ident()))


class Glances:
    """Computations that the event loop makes itself; a thread stops one that takes too long.

    turn: held by the one that is made, so that the loop looks after everybody else between two of them
    What counts is the time that the loop computes: on a busy machine every wait is long.
    """

    def __init__(self) -> None:
        self.turn = asyncio.Lock()
        self._now: tuple[float, Budget] | None = None
        self._clock: Callable[[], float] | None = None
        self._wake = Event()
        Thread(target=self._look, name="glances", daemon=True).start()

    @contextmanager
    def budget(self) -> Iterator[Budget]:
        """A budget for one computation, which is stopped when GLANCE is over."""
        budget = Budget(brief=True)
        self._clock = self._clock or clock_of_this_thread()
        self._now = self._clock(), budget
        if not self._wake.is_set():
            self._wake.set()
        try:
            yield budget
        finally:
            self._now = None

    def _look(self) -> None:
        while self._wake.wait():
            self._wake.clear()
            idle = 0
            while idle < LOOKS_IDLE:
                time.sleep(GLANCE / 2.0)
                now = self._now
                idle = 0 if now else idle + 1
                if now and self._clock and self._clock() - now[0] > GLANCE:
                    now[1].stop("at a glance")


async def _watch(request: Request, seconds: float) -> None:
    lanes: Lanes = request.app.state.lanes
    budget = request.state.budget
    try:
        async with asyncio.timeout(seconds):
            while (await request.receive())["type"] != "http.disconnect":
                pass
    except TimeoutError:
        lanes.stopped.labels("deadline").inc()
        budget.stop(f"within {seconds:g} s, the time that one answer may take here")
    else:
        lanes.stopped.labels("client gone").inc()
        budget.stop("before its client was gone")

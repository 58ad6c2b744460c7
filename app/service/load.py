"""Load control: lanes, a limit on the time of every computation, and kept answers.

Lanes limit how many computations run at once, separately for cheap calls, heavy calls, workbooks and large bodies. No
call waits in a lane: a full lane answers 503 with the time at which the first of its computations should be done, so
that a heavy call never delays a cheap one. A computation ends at its deadline or when its client is gone; one that the
event loop runs itself ends much sooner. The latest answers stay in memory, because many people look at the same dance.
"""

from __future__ import annotations

import asyncio
import math
import time
from collections import OrderedDict
from collections.abc import AsyncIterator, Callable, Coroutine, Iterable, Iterator
from contextlib import asynccontextmanager, contextmanager
from functools import partial
from threading import Event, Lock, Thread, get_ident
from typing import Any

from fastapi import Request, Response
from fastapi.routing import APIRoute
from prometheus_client import CollectorRegistry, Counter, Gauge

from app.files.tables import XLSX_TYPE
from app.service.problems import Refused
from app.settings import Settings
from core import Budget

# Longest estimated time of a cheap answer [s].
CHEAP = 0.1
# Longest estimated time of a computation that the event loop runs itself [s]: a thread costs a third of a millisecond,
# a sixth of the answer (2026-11-22). A computation that takes longer is stopped, and repeated in a thread.
GLANCE = 0.005
# Time after such a stop during which the loop runs no computation [s]: each one of 40 at once would delay all others.
REST = 0.1
# Number of looks without a computation after which the thread that stops them waits for the next one to begin [1].
LOOKS_IDLE = 200
# Largest answer that is kept, relative to the room for all [1].
SHARE_MAX = 1 / 16

Handler = Callable[[Request], Coroutine[Any, Any, Response]]


class Lane:
    """A limit on the computations at once, of all clients and of each one."""

    def __init__(
        self, name: str, most: int, of_client: int, retry_after: int, running: Gauge, refused: Counter
    ) -> None:
        self.name, self.most, self.of_client, self.retry_after = name, most, of_client, retry_after
        self._running, self._refused = running.labels(name), refused.labels(name)
        self._lock = Lock()
        # For each computation: its beginning [s], its estimated time [s], and its client.
        self._begun: dict[object, tuple[float, float, str]] = {}

    @contextmanager
    def taken(self, cost: float, client: str = "") -> Iterator[None]:
        """A place in the lane. cost: estimated time for which it is needed [s]. raises: Refused (429, 503)"""
        key = object()
        with self._lock:
            own = [one for one in self._begun.values() if one[2] == client]
            if len(self._begun) >= self.most:
                words = f"{self.most} {self.name} computations are running, the limit"
                raise self._full(503, words, self._begun.values())
            if client and len(own) >= self.of_client:
                words = f"{self.of_client} of your {self.name} computations are running, the limit for one client"
                raise self._full(429, words, own)
            self._begun[key] = (time.monotonic(), cost, client)
        self._running.inc()
        try:
            yield
        finally:
            self._running.dec()
            with self._lock:
                del self._begun[key]

    def _full(self, status: int, words: str, begun: Iterable[tuple[float, float, str]]) -> Refused:
        """A refusal with the expected end of the first computation; a late one is expected to take as long again."""
        self._refused.inc()
        now = time.monotonic()
        left = (began + cost - now if now < began + cost else now - began for began, cost, _ in begun)
        seconds = max(self.retry_after, math.ceil(min(left)))
        return Refused(status, f"{words}: try again in {seconds} s.", headers={"Retry-After": str(seconds)})


class Lanes:
    """The lanes of one process."""

    def __init__(self, settings: Settings, registry: CollectorRegistry) -> None:
        running = Gauge(
            "bench_dragon_computations",
            "Computations running",
            ("lane",),
            registry=registry,
            multiprocess_mode="livesum",
        )
        refused = Counter("bench_dragon_refused", "Computations refused by a full lane", ("lane",), registry=registry)
        self.stopped = Counter("bench_dragon_stopped", "Computations ended early", ("reason",), registry=registry)
        self._cheap, self._heavy, self._workbook, self.large_bodies = (
            Lane(name, most, of_client, settings.retry_after, running, refused)
            for name, most, of_client in (
                ("cheap", settings.cheap_max, settings.cheap_max),
                ("heavy", settings.heavy_max, settings.heavy_client_max),
                ("workbook", settings.workbooks_max, settings.workbooks_max),
                ("large body", settings.large_bodies_max, settings.large_bodies_max),
            )
        )

    def of(self, cost: float, media_type: str) -> Lane:
        """The lane of a computation. cost: its estimated time [s]"""
        if media_type == XLSX_TYPE:
            return self._workbook
        return self._cheap if cost <= CHEAP else self._heavy


class WatchedRoute(APIRoute):
    """A call whose computation ends at the deadline, and when its client is gone."""

    def get_route_handler(self) -> Handler:
        answer = self.unwatched()

        async def handled(request: Request) -> Response:
            async with watched(request, self.seconds(request.app.state.settings)):
                return await answer(request)

        return handled

    def seconds(self, settings: Settings) -> float:
        """Longest time of the computation [s]."""
        return settings.deadline_seconds

    def unwatched(self) -> Handler:
        return super().get_route_handler()


@asynccontextmanager
async def watched(request: Request, seconds: float) -> AsyncIterator[None]:
    """Context in which the request has a budget, which is stopped after `seconds` and when the client is gone."""
    await request.body()  # After the body, the only message is the end of the connection.
    request.state.budget = Budget()
    task = asyncio.create_task(_watch(request, seconds))
    try:
        yield
    finally:
        task.cancel()


def clock_of_this_thread() -> Callable[[], float]:
    """Clock of the calling thread's processor time [s], which any thread can read; outside Unix of elapsed time."""
    if not hasattr(time, "pthread_getcpuclockid"):
        return time.monotonic
    return partial(time.clock_gettime, time.pthread_getcpuclockid(get_ident()))


class Glances:
    """Computations that the event loop runs itself; a thread stops one that takes too long.

    turn: held by the computation that runs, so that the loop serves other requests between two of them
    The limit is on the processor time of the loop, because on a busy machine every wait is long.
    """

    def __init__(self) -> None:
        self.turn = asyncio.Lock()
        self._rests_until = 0.0
        self._now: tuple[float, Budget] | None = None
        self._clock: Callable[[], float] | None = None
        self._wake = Event()
        Thread(target=self._look, name="glances", daemon=True).start()

    @property
    def rests(self) -> bool:
        """Whether computations are left to threads, because one took too long a moment ago."""
        return time.monotonic() < self._rests_until

    def rest(self) -> None:
        """Leave computations to threads for REST seconds, because one took too long."""
        self._rests_until = time.monotonic() + REST

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


class KeptAnswers:
    """Answers by their tags. A tag depends on everything that determines the answer: request, form and build.

    bytes_max: room for all of them [bytes]; the answer that was asked for least recently goes first
    """

    def __init__(self, bytes_max: int, registry: CollectorRegistry) -> None:
        self.bytes_max = bytes_max
        self._repeated = Counter("bench_dragon_repeated", "Answers given from memory", registry=registry)
        self._kept: OrderedDict[str, bytes] = OrderedDict()
        self._used = 0
        self._lock = Lock()

    def get(self, tag: str) -> bytes | None:
        with self._lock:
            found = self._kept.get(tag)
            if found is not None:
                self._kept.move_to_end(tag)
                self._repeated.inc()
            return found

    def keep(self, tag: str, answer: bytes) -> None:
        """Keep an answer, unless it is too large."""
        if len(answer) > SHARE_MAX * self.bytes_max:
            return
        with self._lock:
            if tag in self._kept:  # Two clients asked at the same time.
                return
            self._kept[tag] = answer
            self._used += len(answer)
            while self._used > self.bytes_max:
                self._used -= len(self._kept.popitem(last=False)[1])

"""Lanes: limits on how many computations run at once, in total and for each client.

There are lanes for cheap calls, heavy calls, workbooks, files and large bodies. No call waits in a lane: a full lane
answers 503 with the time at which the first of its computations should be done, so that a heavy call never delays a
cheap one. A client that has its part of the slots gets 429.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from threading import Lock, Timer, get_native_id

from prometheus_client import CollectorRegistry, Counter, Gauge

from app.files.tables import XLSX_TYPE
from app.processes.limits import lower_thread_priority
from app.service.problems import Refused
from app.settings import Settings, part
from app.wire.question import UNKNOWN_COST
from core import Budget, TooMuchWork
from core.language import Phrases, counted, phrase, say
from core.quantities import Quantity

# Longest estimated time of a cheap answer [s].
CHEAP = 0.1
# The lanes in words, by their names.
LANES: Phrases = {
    "cheap": "cheap", "heavy": "heavy", "workbook": "workbook", "assistant": "assistant", "file": "file",
    "large body": "large body",
}  # fmt: skip


class Lane:
    """A limit on simultaneous computations, in total and for each client."""

    def __init__(
        self, name: str, most: int, of_client: int, settings: Settings, running: Gauge, refused: Counter
    ) -> None:
        self.name, self.most, self.of_client = name, most, of_client
        self.retry_after, self.longest = settings.retry_after, settings.deadline_seconds
        self._running, self._refused = running.labels(name), refused.labels(name)
        self._lock = Lock()
        # For each computation: its beginning [s], its estimated time [s], and its client.
        self._begun: dict[object, tuple[float, float, str]] = {}

    @contextmanager
    def slot(self, cost: float, client: str = "") -> Iterator[None]:
        """A slot in the lane. cost: estimated time for which it is needed [s]. raises: Refused (429, 503)"""
        key = object()
        with self._lock:
            own = [one for one in self._begun.values() if one[2] == client]
            if len(self._begun) >= self.most:
                raise self._full(503, "The limit of {most} at once is reached", self.most, self._begun.values())
            if client and len(own) >= self.of_client:
                raise self._full(429, "Your limit of {most} at once is reached", self.of_client, own)
            self._begun[key] = (time.monotonic(), cost, client)
        self._running.inc()
        try:
            yield
        finally:
            self._running.dec()
            with self._lock:
                del self._begun[key]

    def _full(self, status: int, words: str, most: int, begun: Iterable[tuple[float, float, str]]) -> Refused:
        """A refusal with the expected end of the first computation; a late one is expected to take as long again.

        None takes longer than its deadline.
        """
        self._refused.inc()
        now = time.monotonic()
        left = (began + cost - now if now < began + cost else now - began for began, cost, _ in begun)
        seconds = max(self.retry_after, math.ceil(min(self.longest, *left)))
        text = counted(most, "{count} {lane} computation", "{count} {lane} computations", lane=say(LANES[self.name]))
        values = {"most": Quantity(most, "", text=text), "seconds": Quantity(seconds, "s")}
        after = {"Retry-After": str(seconds)}
        return Refused(status, words, None, after, reason="try again in {seconds}.", **values)


class Lanes:
    """The lanes of one process."""

    def __init__(self, settings: Settings, registry: CollectorRegistry) -> None:
        labels = ("lane",)
        running = Gauge(
            "bench_dragon_computations", "Computations running", labels, registry=registry, multiprocess_mode="livesum"
        )
        refused = Counter("bench_dragon_refused", "Computations refused by a full lane", labels, registry=registry)
        self.stopped = Counter("bench_dragon_stopped", "Computations ended early", ("reason",), registry=registry)

        def lane(name: str, most: int, of_client: int) -> Lane:
            return Lane(name, most, of_client, settings, running, refused)

        self._cheap = lane("cheap", settings.cheap_max, settings.cheap_max)
        self._heavy = lane("heavy", settings.heavy_max, part(settings.heavy_max, settings.heavy_client_max))
        self._workbook = lane("workbook", settings.workbooks_max, settings.workbooks_max)
        self.assistants = lane("assistant", settings.cheap_max, part(settings.cheap_max, None))
        self.files = lane("file", settings.readers_max, part(settings.readers_max, settings.readers_client_max))
        self.large_bodies = lane("large body", settings.large_bodies_max, part(settings.large_bodies_max, None))

    def slot(self, cost: float, media_type: str, client: str) -> AbstractContextManager[None]:
        """A slot in the lane of a computation. cost: its estimated time [s]"""
        if media_type == XLSX_TYPE:
            return self._workbook.slot(cost, client)
        if cost <= CHEAP:
            return self._cheap.slot(cost, client)
        lower_thread_priority(get_native_id())
        return self._heavy.slot(cost, client)

    @contextmanager
    def movable_slot(self, cost: float, client: str, budget: Budget) -> Iterator[None]:
        """A slot among the cheap computations, and after CHEAP seconds one among the heavy ones instead.

        The computation goes on in its new slot; without a free one its budget is stopped.
        cost: its estimated time [s]
        raises: Refused (429, 503)
        """
        refusals, thread = list[Refused](), get_native_id()
        with ExitStack() as heavy, ExitStack() as cheap:
            cheap.enter_context(self._cheap.slot(cost, client))

            def move() -> None:
                try:
                    heavy.enter_context(self._heavy.slot(UNKNOWN_COST, client))
                except Refused as refusal:
                    refusals.append(refusal)
                    budget.stop(phrase("before a slot among the heavy computations was free"))
                else:
                    lower_thread_priority(thread)
                    cheap.close()

            timer = Timer(CHEAP, move)
            timer.start()
            try:
                yield
            except TooMuchWork as error:
                if refusals:
                    raise refusals[0] from error
                raise
            finally:
                timer.cancel()
                timer.join()  # It may be moving the computation now.

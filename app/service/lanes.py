"""Lanes: how many computations run at once, counted apart for cheap calls, heavy ones and workbooks.

A call waits in no lane. A full lane answers 503 and says when the first of its computations should be done, so a heavy
call never stands before a cheap one.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from threading import Lock
from time import monotonic

from prometheus_client import CollectorRegistry, Counter, Gauge

from app.files.tables import XLSX_TYPE
from app.service.problems import Refused
from app.settings import Settings

# An answer that is expected to take no longer than this is cheap [s].
CHEAP = 0.1


class Lane:
    """At most so many computations at once, and so many of one client."""

    def __init__(
        self, name: str, most: int, of_client: int, retry_after: int, running: Gauge, refused: Counter
    ) -> None:
        self.name, self.most, self.of_client, self.retry_after = name, most, of_client, retry_after
        self._running, self._refused = running.labels(name), refused.labels(name)
        self._lock = Lock()
        # Of each computation: when it began, how long it should take [s], and whose it is.
        self._begun: dict[object, tuple[float, float, str]] = {}

    @contextmanager
    def taken(self, cost: float, client: str = "") -> Iterator[None]:
        """A place in the lane. cost: how long it is needed, as far as is known [s]. raises: Refused (429, 503)"""
        key = object()
        with self._lock:
            own = [one for one in self._begun.values() if one[2] == client]
            if len(self._begun) >= self.most:
                words = f"{self.most} {self.name} computations are running, as many as may"
                raise self._full(503, words, self._begun.values())
            if client and len(own) >= self.of_client:
                words = f"{self.of_client} of your {self.name} computations are running, as many as one client may have"
                raise self._full(429, words, own)
            self._begun[key] = (monotonic(), cost, client)
        self._running.inc()
        try:
            yield
        finally:
            self._running.dec()
            with self._lock:
                del self._begun[key]

    def _full(self, status: int, words: str, begun: Iterable[tuple[float, float, str]]) -> Refused:
        """Says when the first is expected to be done; one that is late is expected to take as long again."""
        self._refused.inc()
        now = monotonic()
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
        """The lane of a computation. cost: how long it should take [s]"""
        if media_type == XLSX_TYPE:
            return self._workbook
        return self._cheap if cost <= CHEAP else self._heavy

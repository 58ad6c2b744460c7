"""Lanes: limits on how many computations run at once, in total and for each client.

There are lanes for cheap calls, heavy calls, workbooks, files and large bodies. No call waits in a lane: a full lane
answers 503 with the time at which the first of its computations should be done, so that a heavy call never delays a
cheap one. A client that has its part of the places gets 429. A computation ends at its deadline or when its client is
gone.
"""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import AsyncIterator, Iterable, Iterator
from contextlib import asynccontextmanager, contextmanager
from functools import lru_cache
from ipaddress import IPv4Address, ip_address, ip_network
from threading import Lock

from fastapi import Request
from prometheus_client import CollectorRegistry, Counter, Gauge

from app.files.tables import XLSX_TYPE
from app.service.problems import Refused
from app.settings import Settings, part
from core import Budget
from core.display import format_count
from core.errors import Quantity

# Number of first bits of an IPv6 address that a network of one client has.
IPV6_BITS = 64
# Longest estimated time of a cheap answer [s].
CHEAP = 0.1


def client_of(request: Request) -> str:
    """Address of the client, for its limits; a proxy on this machine gives it in X-Forwarded-For."""
    return one_client(request.client.host) if request.client else ""


@lru_cache(maxsize=1024)
def one_client(address: str) -> str:
    """The client at an address: of IPv6 the first 64 bits, because one machine has all addresses that follow.

    >>> one_client("192.0.2.7"), one_client("::ffff:192.0.2.7"), one_client("2001:db8::7:1")
    ('192.0.2.7', '192.0.2.7', '2001:db8::/64')
    """
    try:
        known = ip_address(address.partition("%")[0])
    except ValueError:  # a proxy gave a name
        return address
    if isinstance(known, IPv4Address):
        return str(known)
    return str(known.ipv4_mapped or ip_network((known, IPV6_BITS), strict=False))


class Deadline(Quantity):
    """The longest time of an answer, as the end of an error's sentence."""

    def __str__(self) -> str:
        return f"within {super().__str__()}, the time that one answer may take here"


def limit(most: int, thing: str) -> Quantity:
    """A limit of the service in a sentence, such as 2 unfinished jobs."""
    return Quantity(most, "", text=format_count(most, thing))


class Lane:
    """A limit on simultaneous computations, in total and for each client."""

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
                raise self._full(503, "The", self.most, self._begun.values())
            if client and len(own) >= self.of_client:
                raise self._full(429, "Your", self.of_client, own)
            self._begun[key] = (time.monotonic(), cost, client)
        self._running.inc()
        try:
            yield
        finally:
            self._running.dec()
            with self._lock:
                del self._begun[key]

    def _full(self, status: int, whose: str, most: int, begun: Iterable[tuple[float, float, str]]) -> Refused:
        """A refusal with the expected end of the first computation; a late one is expected to take as long again."""
        self._refused.inc()
        now = time.monotonic()
        left = (began + cost - now if now < began + cost else now - began for began, cost, _ in begun)
        seconds = max(self.retry_after, math.ceil(min(left)))
        told = {"most": limit(most, f"{self.name} computation"), "seconds": Quantity(seconds, "s")}
        words, after = f"{whose} limit of {{most}} at once is reached", {"Retry-After": str(seconds)}
        return Refused(status, words, None, after, reason="try again in {seconds}.", **told)


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
            return Lane(name, most, of_client, settings.retry_after, running, refused)

        self._cheap = lane("cheap", settings.cheap_max, settings.cheap_max)
        self._heavy = lane("heavy", settings.heavy_max, part(settings.heavy_max, settings.heavy_client_max))
        self._workbook = lane("workbook", settings.workbooks_max, settings.workbooks_max)
        self.files = lane("file", settings.readers_max, part(settings.readers_max, settings.readers_client_max))
        self.large_bodies = lane("large body", settings.large_bodies_max, part(settings.large_bodies_max, None))

    def of(self, cost: float, media_type: str) -> Lane:
        """The lane of a computation. cost: its estimated time [s]"""
        if media_type == XLSX_TYPE:
            return self._workbook
        return self._cheap if cost <= CHEAP else self._heavy


@asynccontextmanager
async def watched(request: Request, seconds: float) -> AsyncIterator[None]:
    """Context in which the request has a budget, which is stopped after `seconds` and when the client is gone."""
    await request.body()  # After the body, the only message is the end of the connection.
    request.state.budget = Budget()
    task = asyncio.create_task(_watch(request, seconds, request.state.budget))
    try:
        yield
    finally:
        task.cancel()


async def _watch(request: Request, seconds: float, budget: Budget) -> None:
    lanes: Lanes = request.app.state.lanes
    try:
        async with asyncio.timeout(seconds):
            while (await request.receive())["type"] != "http.disconnect":
                pass
    except TimeoutError:
        lanes.stopped.labels("deadline").inc()
        budget.stop(Deadline(seconds, "s", 6))
    else:
        lanes.stopped.labels("client gone").inc()
        budget.stop("before its client was gone")

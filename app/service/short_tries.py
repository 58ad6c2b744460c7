"""Short computations that the event loop runs itself, each stopped when it takes too long."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from threading import Event, Thread, get_ident

from core import Budget
from core.language import phrase

# Longest estimated time of a computation that the event loop runs itself [s]: a thread costs a third of a millisecond,
# a sixth of the answer (2026-11-22). A computation that takes longer is stopped, and repeated once in a thread.
SHORT = 0.005
# Time after such a stop during which the loop runs no computation [s]: of 40 at once, each would delay all others.
REST = 0.1
# Number of looks without a computation after which the thread that stops them waits for the next one to begin [1].
LOOKS_IDLE = 200


def clock_of_this_thread() -> Callable[[], float]:
    """Clock of the calling thread's processor time [s], which any thread can read; outside Unix of elapsed time."""
    if not hasattr(time, "pthread_getcpuclockid"):
        return time.monotonic
    return partial(time.clock_gettime, time.pthread_getcpuclockid(get_ident()))


class ShortTries:
    """Computations that the event loop runs itself; a thread stops one that takes too long.

    The limit is on the processor time of the loop, because on a busy machine every wait is long.
    """

    def __init__(self) -> None:
        self._rests_until = 0.0
        self._now: tuple[float, Budget] | None = None
        self._clock: Callable[[], float] | None = None
        self._wake = Event()
        Thread(target=self._look, name="short tries", daemon=True).start()

    @property
    def resting(self) -> bool:
        """Whether computations are left to threads, because one took too long a moment ago."""
        return time.monotonic() < self._rests_until

    def rest(self) -> None:
        """Leave computations to threads for REST seconds, because one took too long."""
        self._rests_until = time.monotonic() + REST

    @contextmanager
    def budget(self) -> Iterator[Budget]:
        """A budget for one computation, which is stopped when SHORT is over."""
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
                time.sleep(SHORT / 2.0)
                now = self._now
                idle = 0 if now else idle + 1
                if now and self._clock and self._clock() - now[0] > SHORT:
                    now[1].stop(phrase("in a short try"))

"""The keeper of jobs in a process of the service: it opens the store, and starts a runner when there is work.

Every process of the service has a keeper. One of them holds the lock and starts a runner when there is work; the runner
ends with the process that started it. When that one is killed, the keeper of another process gets the lock.
"""

from __future__ import annotations

import logging
import signal
import sqlite3
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from threading import BoundedSemaphore, Event, Thread, Timer, current_thread, main_thread
from types import FrameType

from app.files.fonts import kept_list
from app.files.lock import FolderLock
from app.files.scratch import reclaim, temporary
from app.jobs.store import Store
from app.logs import Faults
from app.processes.child import Child
from app.settings import Settings

logger = logging.getLogger("uvicorn.error")

# Longest wait of new work for a keeper in another process [s].
KEEP_SECONDS = 1.0
# Time after the last fault of the store from which faults are over [s].
OVER_SECONDS = 60.0
# Longest time for a runner to end [s].
END_SECONDS = 5.0
# Time after which the children of a killed process have ended [s].
RECLAIM_SECONDS = 60.0
# Others wait while the store is cleared of removed jobs: this is done at most once in this time [s], and takes at most
# this share of it.
CLEAR_SECONDS, CLEAR_SHARE = 1.0, 0.05


class Keeper:
    """The jobs of one process of the service.

    free: places for more listeners; leaving: set when the process must end, so that listeners leave
    """

    def __init__(self, store: Store, settings: Settings) -> None:
        self.store, self.settings = store, settings
        self.faults = Faults(logger, "The store of the jobs failed, and is tried again each second: %s")
        self.free = BoundedSemaphore(settings.jobs_listeners_max)
        self.leaving = Event()
        self._lock = FolderLock(store.folder, "keeper")
        self._wake = Event()
        self._runner: Child | None = None
        self._clear_at = 0.0
        self._thread = Thread(target=self._keep, name="jobs", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def hurry(self) -> None:
        """Report new work, so that the keeper checks the store at once."""
        self._wake.set()

    def stop(self) -> None:
        """End the runner and its jobs; they continue when the service starts again."""
        self.leaving.set()
        self._wake.set()
        self._thread.join()
        if self._runner is not None:
            self._runner.end(END_SECONDS)
        self._lock.give_back()

    def _keep(self) -> None:
        while not self.leaving.is_set():
            try:
                self.store.check()
                if self._lock.take():
                    ended = self._runner is None or not self._runner.is_alive
                    if ended and self.store.has_work(self.settings.job_days_max):
                        self._runner = Child("app.jobs.runner", str(self.store.folder), answers=False)
                    self._clear()
                if time.monotonic() > self.faults.last + OVER_SECONDS:
                    self.faults.over()
            except (OSError, sqlite3.Error) as error:
                self.faults.log(str(error))  # The folder may be gone for hours.
            self._wake.wait(KEEP_SECONDS)
            self._wake.clear()

    def _clear(self) -> None:
        """Remove the last bytes of removed jobs, if it is time, through a connection of its own: calls read on."""
        begun = time.monotonic()
        if begun < self._clear_at or not self.store.must_clear():
            return
        with closing(Store(self.store.folder)) as own:
            own.clear()
        now = time.monotonic()
        self._clear_at = now + max(CLEAR_SECONDS, (now - begun) / CLEAR_SHARE)


@contextmanager
def kept(settings: Settings) -> Iterator[Keeper | str]:
    """The jobs of this process while it serves, or the reason why the data folder cannot be used."""
    with ExitStack() as stack:
        stack.callback(_reclaiming().cancel)
        stack.enter_context(kept_list())
        try:
            store = Store(settings.data or Path(stack.enter_context(scratch())))
        except (OSError, sqlite3.Error) as error:
            logger.error("The data folder %s cannot be used, so there are no jobs: %s", settings.data, error)
            yield "its data folder cannot be used"
            return
        stack.callback(store.close)
        keeper = Keeper(store, settings)
        stack.enter_context(_listeners_leave(keeper))
        keeper.start()
        stack.callback(keeper.stop)
        yield keeper


def _reclaiming() -> Timer:
    """Removes the temporary folders that killed processes left: now, and once more when their children have ended."""
    reclaim()
    again = Timer(RECLAIM_SECONDS, reclaim)
    again.daemon = True
    again.start()
    return again


@contextmanager
def scratch() -> Iterator[str]:
    """A temporary folder for jobs."""
    with temporary("data-") as folder:
        logger.warning("BENCH_DRAGON_DATA is not set: jobs are kept in %s, and only until the service ends", folder)
        yield folder


@contextmanager
def _listeners_leave(keeper: Keeper) -> Iterator[None]:
    """Context in which a signal to end makes listeners leave, because the server waits for them."""
    if current_thread() is not main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def leave(number: int, frame: FrameType | None) -> None:
        keeper.leaving.set()
        earlier = before[signal.Signals(number)]
        if callable(earlier):
            earlier(number, frame)

    for number in before:
        signal.signal(number, leave)
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)

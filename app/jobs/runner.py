"""The one process that runs the jobs of a data folder: python -m app.start app.jobs.runner FOLDER

A job has a process for itself while it runs (app.jobs.work). A limit, a client that dismisses the job, or the system
may kill it without harm to other jobs. The file that such a process has written counts as soon as the runner gives it
its final name; before that the job starts again and gives the same bytes, as an answer depends only on its call. After
its answer the process waits for the next job, which then begins at once.

input   the end of standard input, which means that the parent has ended: the runner ends too
state   the store, and the processes of the jobs that run
output  the store
"""

from __future__ import annotations

import contextlib
import logging
import queue
import sqlite3
import sys
import time
from collections import deque
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any

import orjson

from app.files.lock import FolderLock
from app.jobs.job import SWEEP
from app.jobs.store import Store
from app.logs import Faults, log_to_stderr
from app.processes.child import ProcessEnded
from app.processes.parent import follow_parent
from app.processes.pool import Pool
from app.settings import Settings, part
from app.wire.problem import problem_of
from core import Budget
from core.kernels import Halted
from core.quantities import Quantity

logger = logging.getLogger("app.jobs")

# Time between two checks of the store [s].
LOOK_SECONDS = 0.1
# Time without work after which a runner ends; it is started again for the next job [s].
IDLE_SECONDS = 10.0
# Longest time for the last runner to end after its keeper was killed [s].
LOCK_SECONDS = 5.0
# Time between two attempts to write to a full or failing disk [s].
RETRY_SECONDS = 1.0


@dataclass(eq=False)
class Run:
    """A job that runs.

    most: largest duration [s]; begun: its start on the monotonic clock [s]
    budget: stopped when the job has taken too long, or its result is no longer needed; its process is killed then
    first: time of its first report of progress [s], and the share done then
    """

    job: str
    most: float
    begun: float = field(default_factory=time.monotonic)
    budget: Budget = field(default_factory=Budget)
    first: tuple[float, float] | None = None

    @property
    def is_late(self) -> bool:
        return time.monotonic() - self.begun > self.most

    def rate(self, share: float) -> float | None:
        """Average rate of progress since the first report [1/s]; None before it."""
        now = time.monotonic()
        if self.first is None:
            self.first = now, share
        since, before = self.first
        return (share - before) / (now - since) if now > since and share > before else None


# A job with a message of its process, or with the reason why there is no answer.
Event = tuple[Run, dict[str, Any] | Exception]


class Runner:
    """Runs the waiting jobs of the store, up to a limit at the same time."""

    def __init__(self, store: Store, settings: Settings) -> None:
        self.store, self.settings = store, settings
        self.runs: dict[str, Run] = {}
        self._pool = Pool("app.jobs.work", str(store.folder), waiting=settings.jobs_running_max)
        self._events: queue.Queue[Event] = queue.Queue()
        self._faults = Faults(logger, "The store of the jobs failed, and is tried again each second: %s")
        # Ends of jobs that are not in the store yet, because a failing disk may refuse them for some time.
        self._pending: deque[Event] = deque()

    def run(self) -> None:
        """Run jobs until none has waited for a while."""
        self.store.begin()
        idle_since = time.monotonic()
        while self.runs or time.monotonic() - idle_since < IDLE_SECONDS:
            try:
                self.step()
            except (OSError, sqlite3.Error) as error:
                self._faults.log(str(error))  # A disk may be full for hours.
                time.sleep(RETRY_SECONDS)
            if self.runs:
                idle_since = time.monotonic()

    def close(self) -> None:
        """End the processes of the jobs."""
        self._pool.close()

    def step(self) -> None:
        """Process events, end late and dismissed jobs, start waiting ones."""
        self.store.check()
        self._listen()
        while self._pending:
            run, event = self._pending[0]
            try:
                self._process(run, event)
            except (OSError, sqlite3.Error) as error:
                if not is_report(event):
                    raise
                self._faults.log(str(error))
            self._pending.popleft()
        needed = self.store.running()
        for run in self.runs.values():
            if run.is_late or run.job not in needed:
                run.budget.stop()
        self.store.tidy(self.runs)
        self.store.expire(self.settings.job_days_max)
        while len(self.runs) < self.settings.jobs_running_max:
            of_client = part(self.settings.jobs_running_max, self.settings.jobs_running_client_max)
            job = self.store.take(self.settings.sweeps_running_max, of_client)
            if job is None:
                break
            self._start(job)

    def _start(self, job: str) -> None:
        known = self.store.get(job)
        is_sweep = known is not None and known.question == SWEEP
        run = Run(job, self.settings.sweep_seconds_max if is_sweep else self.settings.job_seconds_max)
        self.runs[job] = run
        Thread(target=self._follow, args=(run,), daemon=True).start()

    def _follow(self, run: Run) -> None:
        """Turn what the process of a job sends into events; the last one is its result, or why there is none."""

        def report(data: bytearray) -> None:
            self._events.put((run, orjson.loads(data)))

        try:
            # Not as an argument of the process, because every user can see arguments.
            report(self._pool.answer(run.job.encode(), run.budget, report))
        except (Halted, ProcessEnded, OSError) as error:  # OSError: the system has no room for another process
            self._events.put((run, error))

    def _listen(self) -> None:
        with contextlib.suppress(queue.Empty):
            self._pending.append(self._events.get(timeout=LOOK_SECONDS))
            while True:
                self._pending.append(self._events.get_nowait())

    def _process(self, run: Run, event: dict[str, Any] | Exception) -> None:
        job = run.job
        match event:
            case {"share": float(share), "rate": rate, "done": int(done), "total": int(total), "size": int(size)}:
                self.store.proceed(job, share, rate, done=done, total=total, size=size)
                return
            case {"share": float(share)}:
                self.store.proceed(job, share, run.rate(share))
                return
            case {"part": dict(part)}:
                self.store.tell(job, part)
                return
            case {"kept": int(kept)}:
                self.store.resume(job, kept)
                return
            case {"written": str(name), "media_type": str(media_type)}:
                self.store.succeed(job, Path(name), media_type, self.settings)
            case {"problem": str(text)}:
                self.store.fail(job, text.encode())
            case Halted():  # Changes nothing if the job was dismissed.
                self.store.fail(job, too_long(run.most))
            case ProcessEnded():
                self.store.die(job, died(event.how))
            case OSError():
                self.store.die(job, died(event.strerror or str(event)))
        del self.runs[job]


def is_report(event: dict[str, Any] | Exception) -> bool:
    """True for a message of a job that goes on; a full disk has no room for it, but for the end of the job."""
    return isinstance(event, dict) and not event.keys() & {"written", "problem"}


def too_long(seconds: float) -> bytes:
    """The problem of a job that exceeded its time limit."""
    words = "The job took longer than {most}, the limit here: ask for less."
    return problem_of(422, "too-much-work", words, most=Quantity(seconds, "s", 6)).to_json()


def died(how: str) -> bytes:
    """The problem of a job whose process died at each attempt. how: exit code or signal of the last one"""
    words = "The process of the job died at each attempt, the last time by {how}: the job may need too much memory."
    return problem_of(500, "process-ended", words, how=how).to_json()


def main() -> None:
    settings = Settings()
    log_to_stderr(settings.log_json)
    folder = Path(sys.argv[1])
    follow_parent()
    lock = FolderLock(folder, "runner")
    try:
        if not lock.take(LOCK_SECONDS):
            raise SystemExit(f"Another runner still holds {folder}")
        with closing(Runner(Store(folder), settings)) as runner:
            runner.run()
    except (OSError, sqlite3.Error) as error:
        raise SystemExit(f"The store of the jobs failed: {error}") from error

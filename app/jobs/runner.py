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
import os
import queue
import signal
import sqlite3
import subprocess
import sys
import time
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from typing import Any

import orjson

from app.files.lock import FolderLock
from app.jobs.job import SWEEP
from app.jobs.keeper import start
from app.jobs.store import Store
from app.logs import log_to_stderr
from app.settings import Settings, part
from app.wire.problem import problem_of
from core.errors import Quantity

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
class Work:
    """A process that does jobs, and its present one.

    job: None while it waits; begun: start of the job on the monotonic clock [s]; most: largest duration [s]
    over: True if the result of the job is no longer needed
    first: time of its first report of progress [s], and the share done then
    """

    process: subprocess.Popen[bytes]
    job: str | None = None
    begun: float = 0.0
    most: float = 0.0
    over: bool = False
    first: tuple[float, float] | None = None

    def give(self, job: str, most: float) -> None:
        """Begin a job."""
        self.job, self.begun, self.most, self.first = job, time.monotonic(), most, None
        assert self.process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            # Not as an argument, because every user can see arguments.
            self.process.stdin.write(f"{job}\n".encode())
            self.process.stdin.flush()

    def rate(self, share: float) -> float | None:
        """Average rate of progress since the first report [1/s]; None before it."""
        now = time.monotonic()
        if self.first is None:
            self.first = now, share
        since, before = self.first
        return (share - before) / (now - since) if now > since and share > before else None

    def end(self) -> None:
        """Kill the process and its children."""
        self.over = True
        if self.process.returncode is not None:
            return  # Another process may have its number by now.
        with contextlib.suppress(ProcessLookupError):
            if hasattr(os, "killpg"):
                os.killpg(self.process.pid, signal.SIGKILL)
            else:
                self.process.kill()


# A process with one of its messages; None after it has ended.
Word = tuple[Work, dict[str, Any] | None]


class Runner:
    """Runs the waiting jobs of the store, up to a limit at the same time."""

    def __init__(self, store: Store, settings: Settings) -> None:
        self.store, self.settings = store, settings
        self.works: dict[str, Work] = {}
        self._waiting: list[Work] = []
        self._words: queue.Queue[Word] = queue.Queue()
        # Changes that are not in the store yet, because a full disk may refuse them for some time.
        self._unheeded: deque[Word] = deque()

    def run(self) -> None:
        """Run jobs until none has waited for a while."""
        self.store.begin()
        idle_since, said = time.monotonic(), ""
        while self.works or time.monotonic() - idle_since < IDLE_SECONDS:
            try:
                self.step()
            except (OSError, sqlite3.Error) as error:
                if str(error) != said:  # Logged once, because a disk may be full for hours.
                    said = str(error)
                    logger.error("The store of the jobs failed, and is tried again each second: %s", said)
                time.sleep(RETRY_SECONDS)
            if self.works:
                idle_since = time.monotonic()

    def step(self) -> None:
        """Process messages, end dismissed jobs, start waiting ones."""
        self.store.check()
        self._listen()
        while self._unheeded:
            self._heed(*self._unheeded[0])
            self._unheeded.popleft()
        wanted = self.store.running()
        for job, work in self.works.items():
            if work.over:
                continue
            if job not in wanted:
                work.end()
            elif time.monotonic() - work.begun > work.most:
                self.store.fail(job, too_long(work.most))
                work.end()
        self.store.tidy(self.works)
        self.store.expire(self.settings.job_days_max)
        while len(self.works) < self.settings.jobs_running_max:
            of_client = part(self.settings.jobs_running_max, self.settings.jobs_running_client_max)
            taken = self.store.take(self.settings.sweeps_running_max, of_client)
            if taken is None:
                break
            known = self.store.get(taken)
            sweeps = known is not None and known.question == SWEEP
            work = self.works[taken] = self._free()
            work.give(taken, self.settings.sweep_seconds_max if sweeps else self.settings.job_seconds_max)

    def _free(self) -> Work:
        """A process without a job: one that has done others, or else a new one."""
        while self._waiting:
            work = self._waiting.pop()
            if work.process.poll() is None:
                return work
        work = Work(start("app.jobs.work", str(self.store.folder), stdout=subprocess.PIPE))
        Thread(target=self._hear, args=(work,), daemon=True).start()
        return work

    def _hear(self, work: Work) -> None:
        assert work.process.stdout is not None
        with work.process.stdout as lines:
            for line in lines:
                # A killed process may leave half a line.
                with contextlib.suppress(orjson.JSONDecodeError):
                    self._words.put((work, orjson.loads(line)))
        work.process.wait()
        self._words.put((work, None))

    def _listen(self) -> None:
        with contextlib.suppress(queue.Empty):
            self._unheeded.append(self._words.get(timeout=LOOK_SECONDS))
            while True:
                self._unheeded.append(self._words.get_nowait())

    def _heed(self, work: Work, said: dict[str, Any] | None) -> None:
        job = work.job
        if said is None:
            self._bury(work)
            return
        assert job is not None  # A process without a job sends no message.
        match said:
            case {"share": float(share), "rate": rate, "done": int(done), "total": int(total), "size": int(size)}:
                self.store.proceed(job, share, rate, done=done, total=total, size=size)
            case {"share": float(share)}:
                self.store.proceed(job, share, work.rate(share))
            case {"kept": int(kept)}:
                self.store.resume(job, kept)
            case {"written": str(name), "media_type": str(media_type), "again": bool(again)}:
                self.store.succeed(job, Path(name), media_type, self.settings)
                self._release(work, job, again)
            case {"problem": str(text), "again": bool(again)}:
                self.store.fail(job, text.encode())
                self._release(work, job, again)

    def _release(self, work: Work, job: str, again: bool) -> None:
        """Let a process that has done its job wait for the next one, or end it."""
        if again and not work.over:
            del self.works[job]
            work.job = None
            self._waiting.append(work)
        else:
            work.end()

    def _bury(self, work: Work) -> None:
        """Forget a process that has ended; its unfinished job is tried again, or fails."""
        if work.job is not None:
            if not work.over:
                self.store.die(work.job, died(work.process.returncode))
            del self.works[work.job]
        assert work.process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            work.process.stdin.close()


def too_long(seconds: float) -> bytes:
    """The problem of a job that exceeded its time limit."""
    words = "The job took longer than {most}, the limit here: ask for less."
    return problem_of(422, "too-much-work", words, most=Quantity(seconds, "s", 6)).to_json()


def died(code: int) -> bytes:
    """The problem of a job whose process died at each attempt. code: last exit code, or minus the signal"""
    how = f"signal {-code}" if code < 0 else f"exit code {code}"
    words = "The process of the job died at each attempt, the last time by {how}: the job may need too much memory."
    return problem_of(500, "process-ended", words, how=how).to_json()


def end_group() -> None:
    """End this process and its children."""
    if hasattr(os, "killpg") and os.getpgid(0) == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


def follow_input() -> None:
    """Read standard input, and end this process and its children when it ends, because their parent is gone."""

    def follow() -> None:
        while os.read(sys.stdin.fileno(), 1024):
            pass
        end_group()

    Thread(target=follow, daemon=True).start()


def main() -> None:
    settings = Settings()
    log_to_stderr(settings.log_json)
    folder = Path(sys.argv[1])
    follow_input()
    lock = FolderLock(folder, "runner")
    try:
        if not lock.take(LOCK_SECONDS):
            raise SystemExit(f"Another runner still holds {folder}")
        Runner(Store(folder), settings).run()
    except (OSError, sqlite3.Error) as error:
        raise SystemExit(f"The store of the jobs failed: {error}") from error

"""Room for a new job: which finished jobs give way to it, or when there will be room.

Each client has a quota of kept jobs and of bytes, and its own oldest finished jobs give way to its new ones. Where the
whole store is full, the oldest finished job of the client that has most gives way, but only if that client has at least
as much as the asking one would have: a client never loses a result to one that keeps more than it does. The latest
result of each client stays for FRESH seconds after its end, so that whoever follows a job gets its answer. What never
gives way is an unfinished job.

input   a row for each job that is kept (its result has not expired), the asking client, the limits
output  the jobs that give way; or Full, with the time after which one may
"""

from __future__ import annotations

import math
import sqlite3
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from app.jobs.job import SWEEP, UNFINISHED, Full, FullForClient, FullOfBytes, JobState, KeptByClient
from app.settings import Settings

# Time for which the latest result of a client does not give way [s].
FRESH = 600.0
DAY = 86_400.0  # [s]
# Columns of a KeptJob.
COLUMNS = "id, question, client, state, started, finished, updated, time_left, cost, size + call_size"


@dataclass(frozen=True)
class Counts:
    """What is in the store.

    states: number of kept jobs in each state; kept, used: of all of them, and bytes of their calls and results
    of_client: most jobs of one client; gave_way: number of jobs that ever gave way to newer ones
    done, total: answered designs, and all designs, of the unfinished sweeps
    """

    states: dict[str, int]
    kept: int
    used: int
    of_client: int
    gave_way: int
    done: int
    total: int


def counts(read: Callable[[str], list[Any]]) -> Counts:
    """What is in the store now. read: function from a query to its rows"""
    [(kept, used)] = read("SELECT count(*), coalesce(sum(size + call_size), 0) FROM jobs WHERE NOT expired")
    sums = "SELECT coalesce(sum(done), 0), coalesce(sum(total), 0) FROM jobs WHERE state IN ('accepted', 'running')"
    most = "SELECT count(*) AS jobs FROM jobs WHERE NOT expired GROUP BY client ORDER BY jobs DESC LIMIT 1"
    [(done, total)], [(gave_way,)] = read(sums), read("SELECT gave_way FROM removals")
    states = dict(read("SELECT state, count(*) FROM jobs WHERE NOT expired GROUP BY state"))
    return Counts(states, kept, used, sum(row[0] for row in read(most)), gave_way, done, total)


@dataclass(frozen=True)
class KeptJob:
    """One job that is kept. Times are in seconds since 1970.

    time_left, cost: of its run, as reported and as estimated [s]; size: of its call and its result [bytes]
    """

    id: str
    question: str
    client: str
    state: str
    started: float | None
    finished: float | None
    updated: float
    time_left: float | None
    cost: float
    size: int

    @property
    def is_finished(self) -> bool:
        return self.state not in UNFINISHED


def _bytes_of(jobs: Iterable[KeptJob]) -> int:
    return sum(job.size for job in jobs)


def has_room(run: sqlite3.Connection, client: str, size: int, limits: Settings) -> bool:
    """True if a new job of the client needs nobody's room, as most do. size: of its call [bytes]"""
    sums = "count(*), coalesce(sum(size + call_size), 0), coalesce(sum(state IN ('accepted', 'running')), 0)"
    kept, used, _ = run.execute(f"SELECT {sums} FROM jobs WHERE NOT expired").fetchone()
    own, own_used, unfinished = run.execute(
        f"SELECT {sums} FROM jobs WHERE NOT expired AND client = ?", (client,)
    ).fetchone()
    fits = kept < limits.jobs_max and used + size <= limits.jobs_bytes_max
    own_fits = own < limits.jobs_client_kept_max and own_used + size <= limits.jobs_client_bytes_max
    return bool(fits and own_fits and unfinished < limits.jobs_client_max)


class Room:
    """The kept jobs, some of which may give way. `gone` are those that do."""

    def __init__(self, jobs: Iterable[KeptJob], client: str, limits: Settings, now: float) -> None:
        self.limits, self.client, self.now = limits, client, now
        self.gone: list[str] = []
        self._of: dict[str, list[KeptJob]] = defaultdict(list)
        for job in sorted(jobs, key=lambda job: job.finished or math.inf):
            self._of[job.client].append(job)
        self._own = self._of[client]
        # No longer than a result is kept anyway.
        self._fresh = min(FRESH, limits.job_days_max * DAY)

    def make(self, size: int) -> None:
        """Room for a new job of the client. size: of its call [bytes]; raises: Full"""
        limits = self.limits
        unfinished = [job for job in self._own if not job.is_finished]
        if len(unfinished) >= limits.jobs_client_max:
            raise FullForClient(self._first_end(unfinished))
        while self._exceeds(1, size):
            if not self._give_way(self._own):
                raise KeptByClient(self._wait(self._own))
        while sum(map(len, self._of.values())) >= limits.jobs_max:
            if not self._give_way_of_most(len, 1):
                raise Full(self._wait_of_most(len, 1))
        while self._bytes() + size > limits.jobs_bytes_max:
            if not self._give_way_of_most(_bytes_of, size):
                raise FullOfBytes(self._wait_of_most(_bytes_of, size))

    def fit(self) -> None:
        """Room for a result that the client has just got, as far as others may give way."""
        while self._exceeds(0, 0) and self._give_way(self._own):
            pass
        while self._bytes() > self.limits.jobs_bytes_max and self._give_way_of_most(_bytes_of, 0):
            pass

    def _bytes(self) -> int:
        return sum(map(_bytes_of, self._of.values()))

    def _exceeds(self, more: int, size: int) -> bool:
        """True if the client would keep too much with so many more jobs. size: of these [bytes]"""
        own, limits = self._own, self.limits
        return len(own) + more > limits.jobs_client_kept_max or _bytes_of(own) + size > limits.jobs_client_bytes_max

    def _give_way(self, jobs: list[KeptJob]) -> bool:
        """Let the oldest finished job that may give way do so: False if there is none."""
        fresh = self._fresh_of(jobs)
        for job in jobs:  # The oldest end first.
            if job.is_finished and job is not fresh:
                jobs.remove(job)
                self.gone.append(job.id)
                return True
        return False

    def _fresh_of(self, jobs: Sequence[KeptJob]) -> KeptJob | None:
        """The latest result of a client, while it must stay."""
        done = [job for job in jobs if job.is_finished and job.state != JobState.DISMISSED]
        return done[-1] if done and (done[-1].finished or 0.0) > self.now - self._fresh else None

    def _ranked(self, measure: Callable[[list[KeptJob]], int], more: int) -> list[list[KeptJob]]:
        """The jobs of each client that may lose one, of the client that has most first; of the asking one on a tie.

        Of others with as much, the one whose oldest finished job is oldest comes first.
        """
        own_then = measure(self._own) + more
        others = [jobs for name, jobs in self._of.items() if name != self.client and measure(jobs) >= own_then]

        def rank(jobs: list[KeptJob]) -> tuple[int, bool, float]:
            most = own_then if jobs is self._own else measure(jobs)
            return -most, jobs is not self._own, jobs[0].finished or math.inf if jobs else math.inf

        return sorted([self._own, *others], key=rank)

    def _give_way_of_most(self, measure: Callable[[list[KeptJob]], int], more: int) -> bool:
        return any(self._give_way(jobs) for jobs in self._ranked(measure, more))

    def _wait_of_most(self, measure: Callable[[list[KeptJob]], int], more: int) -> float:
        return min(map(self._wait, self._ranked(measure, more)))

    def _wait(self, jobs: Sequence[KeptJob]) -> float:
        """Time after which one of these jobs may give way, as far as is known [s]."""
        fresh = self._fresh_of(jobs)
        waits = [(fresh.finished or 0.0) + self._fresh - self.now] if fresh else []
        unfinished = [job for job in jobs if not job.is_finished]
        if unfinished:
            waits.append(self._first_end(unfinished) + self._fresh)
        return min(waits, default=math.inf)

    def _first_end(self, jobs: Sequence[KeptJob]) -> float:
        """Time after which the first of these unfinished jobs should be done [s]."""
        running = [self._left(job) for many in self._of.values() for job in many if job.state == JobState.RUNNING]
        turn = min(running, default=0.0)
        return min(self._left(job) if job.state == JobState.RUNNING else turn + job.cost for job in jobs)

    def _left(self, job: KeptJob) -> float:
        """Time that a running job should still take [s]: as reported, or as estimated; a late one as long again."""
        ran = max(self.now - (job.started or self.now), 0.0)
        most = self.limits.sweep_seconds_max if job.question == SWEEP else self.limits.job_seconds_max
        if job.time_left is not None:
            left = job.time_left - (self.now - job.updated)
        else:
            left = job.cost - ran if ran < job.cost else ran
        return min(max(left, 0.0), max(most - ran, 0.0))

"""The store of all jobs: one SQLite database in the data folder, with the results beside it as files.

    FOLDER/jobs.sqlite   tables jobs, calls, events, turns; written ahead (WAL) and flushed at every change
    FOLDER/client.key    key of the names of clients
    FOLDER/results/ID    the bytes of an answer, complete or absent
    FOLDER/sweeps/ID     the shards of an unfinished sweep
    FOLDER/reserve       room to remove jobs on a full disk

Every change of a job is one transaction and one event, so a listener sees each change once. Only the runner moves a job
from accepted to running and later states; anyone may dismiss it.
"""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import sqlite3
import time
from collections.abc import Container, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import fields
from pathlib import Path
from threading import Lock
from typing import Any

import orjson

from app.files.flush import flush_folder
from app.jobs import room
from app.jobs.clock import follow_clock
from app.jobs.job import EXPIRED, GAVE_WAY, ID_BYTES, SWEEP, Job, JobState
from app.jobs.reserve import Reserve
from app.jobs.room import DAY, Counts, KeptJob, Room, counts, has_room
from app.jobs.tables import client_name, prepare
from app.jobs.turns import next_job, note_turn
from app.settings import Settings
from app.wire.question import UNKNOWN_COST

# Longest wait of a change for that of another process [s].
PATIENCE = 5.0
# Number of latest events that are kept for a job; a client that comes back later misses only steps of progress.
EVENTS_KEPT = 100
# Number of dead processes after which a job is not tried again.
DEATHS_MAX = 3
# Largest store that is rewritten whole after removals, which takes half a second [bytes].
REWRITTEN_MAX = 1 << 26
# Longest estimate of a run [s]; an estimate may be infinite.
COST_MAX = 1e9
# What is left of a job whose call and result are removed.
GONE: dict[str, Any] = {"call_size": 0, "size": 0, "client": ""}
# Length from which the log is copied into the database at once, so that it never holds more that has no room there than
# the reserve has [pages of 4 kB].
LOG_PAGES = 32
COLUMNS = ", ".join(field.name for field in fields(Job))


class Store:
    """The jobs of one data folder, for any number of threads and processes.

    raises: OSError or sqlite3.Error when the folder cannot be used
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self.results, self.sweeps = self.folder / "results", self.folder / "sweeps"
        for place in (self.folder, self.results, self.sweeps):
            place.mkdir(mode=0o700, parents=True, exist_ok=True)
        file = self.folder / "jobs.sqlite"
        file.touch(mode=0o600)  # Other users must not read the names of jobs, which give access to the results.
        self._reserve = Reserve(self.folder / "reserve")
        self._lock = Lock()
        self._file, self._inode = file, os.stat(file).st_ino
        self._connection = sqlite3.connect(file, timeout=PATIENCE, isolation_level=None, check_same_thread=False)
        try:
            with self._possible_on_full_disk():
                self._open()
        except BaseException:
            self._connection.close()
            raise

    def _open(self) -> None:
        # While another process makes the tables, or recovers the log of a killed one, SQLite refuses without waiting.
        end = time.monotonic() + PATIENCE
        while True:
            try:
                return self._prepare()
            except sqlite3.OperationalError as error:
                if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or time.monotonic() > end:
                    raise
                time.sleep(0.05)

    def _prepare(self) -> None:
        run = self._connection.execute
        run("PRAGMA journal_mode = WAL")
        run("PRAGMA synchronous = FULL")
        run("PRAGMA foreign_keys = ON")
        run("PRAGMA secure_delete = ON")  # Removed calls are overwritten on the disk; clear() removes their copies.
        run("PRAGMA temp_store = MEMORY")
        run(f"PRAGMA wal_autocheckpoint = {LOG_PAGES}")
        with self._transaction():
            self._key = prepare(self._connection, self.folder)

    def close(self) -> None:
        with self._lock:
            self._connection.close()

    def check(self, job: str | None = None) -> None:
        """See whether others can read the store, and a job in it.

        raises: OSError if the file was removed or replaced; sqlite3.Error if it is damaged
        """
        self.check_file()
        with closing(sqlite3.connect(f"{self._file.as_uri()}?mode=ro", timeout=PATIENCE, uri=True)) as other:
            known = other.execute("SELECT count(*) FROM jobs WHERE id = ?", (job,)).fetchone()[0]
        if job is not None and not known:
            raise OSError(errno.EIO, "a job that was written is not there")

    def check_file(self) -> None:
        """raises: OSError if the file was removed or replaced, with which the connection goes on as if it were not"""
        if not self._file.is_file() or os.stat(self._file).st_ino != self._inode:
            raise OSError(errno.ENOENT, "the file of the jobs was removed or replaced: start the service anew")

    @contextmanager
    def _change(self) -> Iterator[sqlite3.Connection]:
        """One transaction, isolated from other threads and processes, whose times are those of the clock now."""
        with self._transaction() as run:
            follow_clock(run)
            yield run

    def _now(self) -> float:
        """The time to which the ages of all jobs refer [s]."""
        with self._transaction() as run:
            return follow_clock(run)

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with self._lock:
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                # On a full disk SQLite has already rolled back.
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise

    @contextmanager
    def _possible_on_full_disk(self) -> Iterator[None]:
        """Context of a change that has the room of the reserve, which it gives back, as the log begins anew.

        On a full disk what it removes is overwritten later, by clear(): the log would need as much room as a call has.
        """
        with self._reserve.released() as is_full:
            if not is_full:
                yield
                return
            self._read("PRAGMA secure_delete = FAST")
            try:
                yield
            finally:
                self._read("PRAGMA secure_delete = ON")
                # Without room for it in the database the change is made all the same.
                with suppress(sqlite3.OperationalError):
                    self._empty_log()

    def _empty_log(self) -> None:
        """Copy the write-ahead log into the database; while another process does, SQLite refuses without waiting."""
        end = time.monotonic() + PATIENCE
        while self._read("PRAGMA wal_checkpoint(TRUNCATE)")[0][0] and time.monotonic() < end:
            time.sleep(0.01)

    @property
    def is_full(self) -> bool:
        """True if the disk has little room beside the reserve."""
        return self._reserve.is_needed

    def _read(self, question: str, *values: Any) -> list[Any]:
        with self._lock, closing(self._connection.execute(question, values)) as rows:
            return rows.fetchall()

    def _move(self, run: sqlite3.Connection, job: str, where: str, stamp: str = "updated", /, **values: Any) -> bool:
        """Set values of a job if the condition `where` holds, and inform listeners by an event; True if it held.

        stamp: column that becomes the time of this change, never before that of the last one
        """
        [(latest,)] = run.execute("SELECT max(updated) FROM jobs WHERE id = ?", (job,))
        values["updated"] = values[stamp] = max(time.time(), latest or 0.0)
        setting = ", ".join(f"{name} = :{name}" for name in values)
        changed = run.execute(f"UPDATE jobs SET {setting} WHERE id = :id AND {where}", values | {"id": job}).rowcount
        if changed:
            self._add_event(run, job)
        return bool(changed)

    def _add_event(self, run: sqlite3.Connection, job: str, **more: Any) -> None:
        changed = Job.of(run.execute(f"SELECT {COLUMNS} FROM jobs WHERE id = ?", (job,)).fetchone())
        last = run.execute("SELECT coalesce(max(number), 0) FROM events WHERE job = ?", (job,)).fetchone()[0]
        run.execute("INSERT INTO events VALUES (?, ?, ?)", (job, last + 1, orjson.dumps(changed.status() | more)))
        run.execute("DELETE FROM events WHERE job = ? AND number <= ?", (job, last + 1 - EVENTS_KEPT))

    # Calls for every process.

    def create(self, question: str, call: bytes, client: str, limits: Settings, cost: float = UNKNOWN_COST) -> Job:
        """A new job, safe on the disk; others may give way to it, as app.jobs.room says.

        client: its address; cost: estimated time of the run [s]
        raises: Full if there is no room for it; OSError if the folder is gone
        """
        self._reserve.keep(2 * len(call))  # in the log, and in the database
        job, name = secrets.token_hex(ID_BYTES), client_name(client, self._key)
        with self._change() as run:
            now, gone = time.time(), list[str]()
            if not has_room(run, name, len(call), limits):
                kept = self._kept(run, name, limits)
                kept.make(len(call))
                gone = kept.gone
                self._give_way(run, gone, limits.jobs_max)
            run.execute(
                "INSERT INTO jobs (id, question, call_size, client, state, created, updated, message, cost)"
                " VALUES (?, ?, ?, ?, 'accepted', ?, ?, 'Waiting for its turn.', ?)",
                (job, question, len(call), name, now, now, min(COST_MAX, cost)),
            )
            run.execute("INSERT INTO calls VALUES (?, ?)", (job, call))
            self._add_event(run, job)
        self._unlink(gone)
        self.check(job)
        return self.known(job)

    def _kept(self, run: sqlite3.Connection, client: str, limits: Settings) -> Room:
        rows = run.execute(f"SELECT {room.COLUMNS} FROM jobs WHERE NOT expired")
        return Room((KeptJob(*row) for row in rows), client, limits, time.time())

    def _give_way(self, run: sqlite3.Connection, jobs: list[str], most: int) -> None:
        """Remove calls and results of finished jobs. most: number of jobs without them that are remembered"""
        words = "Its result gave way to newer jobs."
        for job in jobs:
            run.execute("DELETE FROM events WHERE job = ?", (job,))
            run.execute("DELETE FROM calls WHERE job = ?", (job,))
            self._move(run, job, "NOT expired", message=words, expired=GAVE_WAY, **GONE)
        if jobs:
            past = f"SELECT id FROM jobs WHERE expired = {GAVE_WAY} ORDER BY updated DESC LIMIT -1 OFFSET ?"
            run.execute(f"DELETE FROM jobs WHERE id IN ({past})", (most,))
            run.execute("UPDATE removals SET made = made + 1, gave_way = gave_way + ?", (len(jobs),))

    def _unlink(self, jobs: list[str]) -> None:
        for job in jobs:
            with suppress(OSError):  # A new runner removes what is left.
                self.result(job).unlink(missing_ok=True)

    def get(self, job: str) -> Job | None:
        rows = self._read(f"SELECT {COLUMNS} FROM jobs WHERE id = ?", job)
        return Job.of(rows[0]) if rows else None

    def known(self, job: str) -> Job:
        """The job with that name. raises: KeyError if there is none"""
        known = self.get(job)
        if known is None:
            raise KeyError(job)
        return known

    def all(self) -> list[Job]:
        """All jobs, the newest first."""
        return [Job.of(row) for row in self._read(f"SELECT {COLUMNS} FROM jobs ORDER BY created DESC, id")]

    def counts(self) -> Counts:
        """What is in the store now."""
        return counts(self._read)

    def call(self, job: str) -> bytes:
        """The call of a job. raises: KeyError if there is none"""
        rows = self._read("SELECT data FROM calls WHERE job = ?", job)
        if not rows:
            raise KeyError(job)
        data: bytes = rows[0][0]
        return data

    def events(self, job: str, after: int) -> list[tuple[int, bytes]]:
        """Number and status of every event of a job after event number `after`."""
        return self._read("SELECT number, data FROM events WHERE job = ? AND number > ? ORDER BY number", job, after)

    def result(self, job: str) -> Path:
        """Path of the answer of a successful job."""
        return self.results / job

    def shards(self, job: str) -> Path:
        """Folder of the shards of a sweep; it does not exist before the sweep runs."""
        return self.sweeps / job

    def dismiss(self, job: str) -> bool:
        """Dismiss an unfinished job: True if it was unfinished. The runner ends its process."""
        dismissed, words = {"time_left": None, "size": 0}, "Dismissed before it was finished."
        return self._finish(job, JobState.DISMISSED, words, dismissed, "state IN ('accepted', 'running')")

    def remove(self, *jobs: str) -> None:
        """Remove jobs with their events and their results; clear() then removes their last bytes."""
        for job in jobs:
            self.result(job).unlink(missing_ok=True)  # First, because on a full disk this makes room for the rest.
        with self._possible_on_full_disk(), self._change() as run:
            run.executemany("DELETE FROM jobs WHERE id = ?", [(job,) for job in jobs])
            run.execute("UPDATE removals SET made = made + 1")

    def must_clear(self) -> bool:
        """True if something was removed since the store was cleared."""
        return bool(self._read("SELECT 1 FROM removals WHERE made > cleared"))

    def clear(self) -> None:
        """Leave no byte of what was removed: of its copies where SQLite moved rows between pages, and in the log.

        Other threads of this store and other processes wait meanwhile.
        """
        [(made,)] = self._read("SELECT made FROM removals")
        pages = "pragma_page_count, pragma_freelist_count, pragma_page_size"
        [(size,)] = self._read(f"SELECT (page_count - freelist_count) * page_size FROM {pages}")
        with self._reserve.released():
            try:
                if size <= REWRITTEN_MAX:
                    self._read("VACUUM")
                with self._change() as run:
                    run.execute("UPDATE removals SET cleared = ?", (made,))
            except sqlite3.OperationalError:  # The disk is full, or another process holds the store for long.
                pass
            self._empty_log()

    def has_work(self, days: float) -> bool:
        """True if a runner has work. days: time for which finished jobs are kept"""
        latest = self._now() - days * DAY
        due = "SELECT 1 FROM jobs WHERE state IN ('accepted', 'running') OR finished < ? AND NOT expired"
        known = self._read(f"{due} OR finished < ? LIMIT 1", latest, latest - days * DAY)
        return bool(known) or any(self.sweeps.iterdir())  # Shards of finished sweeps must be removed.

    # Calls for the runner only.

    def begin(self) -> None:
        """Prepare for a runner: jobs left running wait again, and half-written files are removed."""
        with self._possible_on_full_disk(), self._change() as run:
            words = "Its process was killed; the job continues."
            for (job,) in run.execute("SELECT id FROM jobs WHERE state = 'running'").fetchall():
                self._move(run, job, "1", state=JobState.ACCEPTED, message=words, rate=None, time_left=None)
            kept = {row[0] for row in run.execute("SELECT id FROM jobs WHERE state = 'successful' AND NOT expired")}
            for file in self.results.iterdir():
                if file.name not in kept:
                    file.unlink(missing_ok=True)

    def take(self, sweeps: int = 1, of_client: int | None = None) -> str | None:
        """Start the job whose turn it is, as app.jobs.turns says; None if none may run.

        sweeps: largest number of running sweeps; of_client: of running jobs of one client
        """
        with self._change() as run:
            job, question, client = next_job(run, sweeps, of_client) or (None, "", "")
            if job is not None:
                again = {} if question == SWEEP else {"progress": 0}  # A sweep goes on from its shards.
                self._move(run, job, "1", "started", state=JobState.RUNNING, message="Running.", **again)
                note_turn(run, client)
        return job

    def tidy(self, works: Container[str]) -> None:
        """Remove the shards of finished or removed sweeps. works: jobs with a process, which may still write"""
        for folder in self.sweeps.iterdir():
            known = self.get(folder.name)
            if folder.name not in works and (known is None or known.is_finished):
                shutil.rmtree(folder, ignore_errors=True)

    def running(self) -> set[str]:
        return {row[0] for row in self._read("SELECT id FROM jobs WHERE state = 'running'")}

    def proceed(self, job: str, share: float, rate: float | None, **more: int) -> None:
        """Record the progress of a job: share done, 0 to 1, and rate [1/s]. 100 percent come with the answer alone.

        more: for a sweep the designs `done` of the `total`, and the `size` of its shards [bytes]
        """
        left, percent = ((1.0 - share) / rate, 100.0 * rate) if rate else (None, None)
        progress = min(int(100.0 * share), 99)
        with self._change() as run:
            self._move(run, job, "state = 'running'", progress=progress, rate=percent, time_left=left, **more)

    def tell(self, job: str, part: dict[str, Any]) -> None:
        """Inform listeners of a running job about a part of its answer."""
        with self._change() as run:
            if run.execute("SELECT 1 FROM jobs WHERE id = ? AND state = 'running'", (job,)).fetchone():
                self._add_event(run, job, part=part)

    def resume(self, job: str, kept: int) -> None:
        """Record the number of designs from which a sweep continues; if it has grown, earlier deaths are forgotten."""
        with self._change() as run:
            self._move(run, job, f"state = 'running' AND kept < {kept:d}", kept=kept, deaths=0)

    def succeed(self, job: str, written: Path, media_type: str, limits: Settings | None = None) -> None:
        """Finish a job with its answer, which is safe on the disk before the status changes.

        limits: of the room that it may take, to which older results give way; None: they all stay
        """
        result = self.result(job)
        if written.exists():  # Otherwise this is a second attempt, after the disk refused the state.
            os.replace(written, result)
            flush_folder(self.results)
        size = result.stat().st_size if result.exists() else 0
        done = {"progress": 100, "rate": None, "time_left": 0.0, "media_type": media_type, "size": size}
        moved = self._finish(job, JobState.SUCCESSFUL, "Finished.", done)
        known = self.get(job)
        if not moved and (known is None or known.state is not JobState.SUCCESSFUL):
            result.unlink(missing_ok=True)
        elif moved and limits is not None:
            self._fit(job, limits)

    def _fit(self, job: str, limits: Settings) -> None:
        """Let older results give way to that of a job."""
        with self._change() as run:
            row = run.execute("SELECT client FROM jobs WHERE id = ?", (job,)).fetchone()
            kept = self._kept(run, row[0] if row else "", limits)
            kept.fit()
            self._give_way(run, kept.gone, limits.jobs_max)
        self._unlink(kept.gone)

    def fail(self, job: str, problem: bytes) -> None:
        """Finish a job with a problem."""
        failed = {"rate": None, "time_left": None, "problem": problem, "size": 0}
        self._finish(job, JobState.FAILED, orjson.loads(problem)["detail"], failed)

    def _finish(
        self, job: str, state: JobState, message: str, more: dict[str, Any], where: str = "state = 'running'"
    ) -> bool:
        """End a job if the condition `where` holds; True if it held."""
        ended = more | {"state": state, "message": message}
        with self._possible_on_full_disk(), self._change() as run:
            moved = self._move(run, job, where, "finished", **ended)
            if moved:
                # The answer has its parts too.
                is_part = "json_type(CAST(data AS TEXT), '$.part') = 'object'"
                run.execute(f"DELETE FROM events WHERE job = ? AND {is_part}", (job,))
                note_turn(run, run.execute("SELECT client FROM jobs WHERE id = ?", (job,)).fetchone()[0])
            return moved

    def die(self, job: str, problem: bytes) -> None:
        """Record a job's dead process: the job is tried again, but fails with this problem after DEATHS_MAX deaths."""
        known = self.get(job)
        if known is None:
            return
        deaths = known.deaths + 1
        if deaths >= DEATHS_MAX:
            self.fail(job, problem)
            return
        message = f"Its process died; the job is tried again ({deaths} of {DEATHS_MAX - 1})."
        with self._change() as run:
            self._move(run, job, "state = 'running'", state=JobState.ACCEPTED, deaths=deaths, message=message)

    def expire(self, days: float) -> None:
        """Remove calls and results of jobs this many days after their end, and the jobs after twice as many."""
        latest = self._now() - days * DAY
        for (job,) in self._read("SELECT id FROM jobs WHERE finished < ? AND NOT expired", latest):
            self.result(job).unlink(missing_ok=True)
            with self._change() as run:
                run.execute("DELETE FROM calls WHERE job = ?", (job,))
                self._move(run, job, "NOT expired", message="Its result has expired.", expired=EXPIRED, **GONE)
                run.execute("UPDATE removals SET made = made + 1")
        gone = [job for (job,) in self._read("SELECT id FROM jobs WHERE finished < ?", latest - days * DAY)]
        if gone:
            self.remove(*gone)

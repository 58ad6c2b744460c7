"""A process that does jobs, one after another: python -m app.start app.jobs.work FOLDER

It asks the question of a job and writes the answer into a new file, to which the runner gives its final name. It
changes nothing in the store, so its death at any moment loses nothing and leaves nothing half done. It takes another
job as long as none has needed much memory; otherwise it ends.

input   a job's id on each line; the end of the input means that the parent has ended: the process ends too
output  lines of JSON: {"share": 0.5}, {"written": FILE, "media_type": ...} or {"problem": TEXT}; the last two with
        {"again": true} if the process takes another job; for a sweep also {"kept": DESIGNS}, and with the share its
        rate, the designs and the bytes
"""

from __future__ import annotations

import logging
import os
import shutil
import sqlite3
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from queue import SimpleQueue
from threading import Thread

from app.files.flush import new_file
from app.jobs.job import SWEEP
from app.jobs.reports import Reports
from app.jobs.runner import end_group
from app.jobs.store import Store
from app.jobs.task import Task
from app.logs import log_to_stderr
from app.processes.limits import is_small, limit_memory, lower_priority
from app.settings import Settings
from app.wire.problem import Problem, problem_of

logger = logging.getLogger("app.jobs")


def answer(task: Task, settings: Settings, reports: Reports, shards: Path) -> bytes | Path | Problem:
    """The answer of the service to the task; for a sweep the file of its table. shards: folder of a sweep"""
    try:
        if task.call == SWEEP:
            from app.jobs.sweeping import swept  # The import takes 0.3 s, and no other job needs it.

            return swept(task, settings, shards, reports)
        return task.answer(settings, reports.share)
    except MemoryError:
        words = "The job needs more memory than {most} bytes, the limit here: ask for less."
        return problem_of(422, "too-much-work", words, most=settings.job_memory_max)
    except Exception:
        logger.exception("A job failed: %s", task.call)
        return problem_of(500, "internal-error", "The service failed on this job; its log has the reason.")


def written(found: bytes | Path, folder: Path) -> Path:
    """A new file with the answer, or with a copy of a file, safe on the disk. raises: OSError, and leaves no file"""
    with new_file(folder, ".") as file:
        if isinstance(found, Path):
            with found.open("rb") as source:
                shutil.copyfileobj(source, file)
        else:
            file.write(found)
    return Path(file.name)


def do(store: Store, job: str, settings: Settings, reports: Reports) -> dict[str, object]:
    """Run the job until it has an answer or a problem, and return the message that says so."""
    task = Task.from_bytes(store.call(job))
    found = answer(task, settings, reports, store.shards(job))
    most = settings.job_result_bytes_max
    if not isinstance(found, Problem):
        size = len(found) if isinstance(found, bytes) else found.stat().st_size
        if size > most:
            words = "The answer has {size} bytes, the limit for a kept one is {most}: ask for less."
            found = problem_of(413, "content-too-large", words, size=size, most=most)
    if not isinstance(found, Problem):
        try:
            return {"written": str(written(found, store.results)), "media_type": task.form}
        except OSError as error:
            words = "The answer could not be written into the data folder: {why}. Make room and ask again."
            found = problem_of(507, "insufficient-storage", words, why=str(error.strerror))
    return {"problem": found.to_json().decode()}


def jobs() -> Iterator[str]:
    """Job ids from standard input. When it ends, this process and its children end, also during a job."""
    asked: SimpleQueue[str] = SimpleQueue()

    def read() -> None:
        # Not sys.stdin, because Python cannot end while a thread holds the lock of a file object. Each read is one
        # line, because the next job is given after the answer to the last.
        while line := os.read(sys.stdin.fileno(), 1024):
            asked.put(line.decode().strip())
        end_group()

    Thread(target=read, daemon=True).start()
    while True:
        yield asked.get()


def main() -> None:
    lower_priority()
    settings, folder = Settings(), Path(sys.argv[1])
    log_to_stderr(settings.log_json)
    limit_memory(settings.job_memory_max)
    reports = Reports()
    for job in jobs():
        reports.begin()
        try:
            store = Store(folder)
        except (OSError, sqlite3.Error) as error:
            raise SystemExit(f"The store of the jobs failed: {error}") from error
        with closing(store):
            said = do(store, job, settings, reports)
        again = is_small()
        reports.say(**said, again=again)
        if not again:
            return

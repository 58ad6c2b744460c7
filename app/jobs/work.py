"""A process that does jobs, one after another: python -m app.start app.jobs.work FOLDER

It asks the question of a job and writes the answer into a new file, to which the runner gives its final name. It
changes nothing in the store, so its death at any moment loses nothing and leaves nothing half done.

task     the id of a job
reports  JSON: {"share": 0.5}; {"part": {...}}; of a sweep also {"kept": DESIGNS}, and beside the share rate, designs
         and bytes
answer   JSON: {"written": FILE, "media_type": ...} or {"problem": TEXT}
"""

from __future__ import annotations

import logging
import shutil
import sqlite3
import sys
from contextlib import closing
from pathlib import Path

import orjson

from app.files.flush import new_file
from app.jobs.job import SWEEP
from app.jobs.reports import Reports
from app.jobs.store import Store
from app.jobs.task import Task
from app.logs import log_to_stderr
from app.processes.limits import OOM_SCORE_JOB, end_first, limit_memory, lower_priority
from app.processes.parent import Report, answer_tasks
from app.settings import Settings
from app.wire.problem import Problem, problem_of

logger = logging.getLogger("app.jobs")


def answer(task: Task, settings: Settings, reports: Reports, shards: Path) -> bytes | Path | Problem:
    """The answer of the service to the task; for a sweep the file of its table. shards: folder of a sweep"""
    try:
        if task.call == SWEEP:
            from app.jobs.sweeping import answer_sweep  # The import takes 0.3 s, and no other job needs it.

            return answer_sweep(task, settings, shards, reports)
        return task.answer(settings, reports.share, reports.part)
    except MemoryError:
        words = "The job needs more memory than {most} bytes, the limit here: ask for less."
        return problem_of(422, "too-much-work", words, most=settings.job_memory_max)
    except Exception:
        logger.exception("A job failed: %s", task.call)
        return problem_of(500, "internal-error", "The service failed on this job; its log has the reason.")


def write(result: bytes | Path, folder: Path) -> Path:
    """A new file with the result, or with a copy of a file, safe on the disk. raises: OSError, and leaves no file"""
    with new_file(folder, ".") as file:
        if isinstance(result, Path):
            with result.open("rb") as source:
                shutil.copyfileobj(source, file)
        else:
            file.write(result)
    return Path(file.name)


def do(store: Store, job: str, settings: Settings, reports: Reports) -> dict[str, str]:
    """Run the job until it has an answer or a problem, and return the message that says so."""
    task = Task.from_bytes(store.call(job))
    result = answer(task, settings, reports, store.shards(job))
    most = settings.job_result_bytes_max
    if not isinstance(result, Problem):
        size = len(result) if isinstance(result, bytes) else result.stat().st_size
        if size > most:
            words = "The answer has {size} bytes, the limit for a kept one is {most}: ask for less."
            result = problem_of(413, "content-too-large", words, size=size, most=most)
    if not isinstance(result, Problem):
        try:
            return {"written": str(write(result, store.results)), "media_type": task.form}
        except OSError as error:
            words = "The answer could not be written into the data folder: {why}. Make room and ask again."
            result = problem_of(507, "insufficient-storage", words, why=str(error.strerror))
    return {"problem": result.to_json().decode()}


def main() -> None:
    lower_priority()
    end_first(OOM_SCORE_JOB)
    settings, folder = Settings(), Path(sys.argv[1])
    log_to_stderr(settings.log_json)
    limit_memory(settings.job_memory_max)

    def answer_job(job: bytearray, report: Report) -> bytes:
        try:
            store = Store(folder)
        except (OSError, sqlite3.Error) as error:
            raise SystemExit(f"The store of the jobs failed: {error}") from error
        with closing(store):
            return orjson.dumps(do(store, job.decode(), settings, Reports(report)))

    answer_tasks(answer_job)

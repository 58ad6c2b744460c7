"""The process of one job: python -m app.jobs.work FOLDER, with the job's id on standard input.

It asks the question and writes the answer into a new file, to which the runner gives its final name. It changes nothing
in the store, so its death at any moment loses nothing and leaves nothing half done.

output  lines of JSON: {"share": 0.5}, {"written": FILE, "media_type": ...} or {"problem": TEXT}; for a sweep also
        {"kept": DESIGNS}, and with the share its rate, the designs and the bytes
"""

from __future__ import annotations

import logging
import os
import shutil
import sys
import tempfile
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from app.jobs.job import SWEEP
from app.jobs.mouth import Mouth
from app.jobs.runner import follow_input
from app.jobs.store import Store
from app.jobs.task import Task
from app.logs import log_to_stderr
from app.settings import Settings
from app.wire.problem import Problem, problem_of

logger = logging.getLogger("app.jobs")

# Lower priority of jobs, so that direct answers come first (man 2 nice).
NICENESS = 10


def limit_memory(most: int) -> None:
    """Limit the memory of this process [bytes], if the system supports it."""
    if find_spec("resource"):
        resource = import_module("resource")
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def answer(task: Task, settings: Settings, mouth: Mouth, shards: Path) -> bytes | Path | Problem:
    """The answer of the service to the task; for a sweep the file of its table. shards: folder of a sweep"""
    try:
        if task.call == SWEEP:
            from app.jobs.sweeping import swept  # The import takes 0.3 s, and no other job needs it.

            return swept(task, settings, shards, mouth)
        return task.answer(settings, mouth.share)
    except MemoryError:
        most = settings.job_memory_max
        detail = f"The job needs more memory than {most} bytes, the limit here: ask for less."
        return problem_of(422, "too-much-work", detail)
    except Exception:
        logger.exception("A job failed: %s", task.call)
        return problem_of(500, "internal-error", "The service failed on this job; its log has the reason.")


def written(found: bytes | Path, folder: Path) -> Path:
    """A new file with the answer, or with a copy of a file, safe on the disk. raises: OSError, and leaves no file"""
    handle, name = tempfile.mkstemp(prefix=".", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            if isinstance(found, Path):
                with found.open("rb") as source:
                    shutil.copyfileobj(source, file)
            else:
                file.write(found)
            file.flush()
            os.fsync(file.fileno())
    except BaseException:
        os.unlink(name)
        raise
    return Path(name)


def do(store: Store, job: str, settings: Settings, mouth: Mouth) -> None:
    """Run the job until it has an answer or a problem."""
    task = Task.from_bytes(store.call(job))
    found = answer(task, settings, mouth, store.shards(job))
    most = settings.job_result_bytes_max
    if not isinstance(found, Problem):
        size = len(found) if isinstance(found, bytes) else found.stat().st_size
        if size > most:
            detail = f"The answer has {size} bytes, the limit for a kept one is {most}: ask for less."
            found = problem_of(413, "content-too-large", detail)
    if not isinstance(found, Problem):
        try:
            return mouth.say(written=str(written(found, store.results)), media_type=task.form)
        except OSError as error:
            detail = f"The answer could not be written into the data folder: {error.strerror}. Make room and ask again."
            found = problem_of(507, "insufficient-storage", detail)
    return mouth.say(problem=found.to_json().decode())


def main() -> None:
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    settings = Settings()
    log_to_stderr(settings.log_json)
    limit_memory(settings.job_memory_max)
    mouth = Mouth()
    # Read byte by byte, so that the rest of the input stays for the thread that waits for its end.
    job = b"".join(iter(lambda: os.read(sys.stdin.fileno(), 1).strip(), b"")).decode()
    if not job:  # The parent of this process is gone.
        return
    follow_input()
    store = Store(Path(sys.argv[1]))
    do(store, job, settings, mouth)


if __name__ == "__main__":
    main()

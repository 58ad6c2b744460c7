"""The process of one job: python -m app.jobs.work FOLDER, the job's id on standard input, what happens on output.

It asks the question and writes the answer into a new file, which the runner then names. It
changes nothing in the store: whatever becomes of it, nothing is lost or done by halves.

output  lines of JSON: {"share": 0.5}, {"written": FILE, "media_type": ...} or {"problem": TEXT}
"""

from __future__ import annotations

import logging
import os
import sys
import tempfile
import time
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import orjson

from app.jobs.runner import follow_input
from app.jobs.store import Store
from app.jobs.task import Task
from app.settings import Settings
from app.wire.problem import Problem, problem_of

logger = logging.getLogger("app.jobs")

# Jobs yield to whoever waits for an answer (man 2 nice).
NICENESS = 10
# Between two words about progress [s].
PROGRESS_SECONDS = 0.5


class Mouth:
    """Tells the runner what happens, on what was standard output; what others print goes to standard error."""

    def __init__(self) -> None:
        self._line = os.fdopen(os.dup(sys.stdout.fileno()), "wb", buffering=0)
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
        self._latest = 0.0

    def say(self, **words: Any) -> None:
        self._line.write(orjson.dumps(words) + b"\n")

    def share(self, done: float) -> None:
        """So much of the work is done, 0 to 1."""
        if time.monotonic() - self._latest >= PROGRESS_SECONDS:
            self._latest = time.monotonic()
            self.say(share=float(done))


def limit_memory(most: int) -> None:
    """More memory than this is not given to this process [bytes], where the system knows such a limit."""
    if find_spec("resource"):
        resource = import_module("resource")
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def answer(task: Task, settings: Settings, mouth: Mouth) -> bytes | Problem:
    """What the service says to the task."""
    try:
        return task.answer(settings, mouth.share)
    except MemoryError:
        most = settings.job_memory_max
        detail = f"The job needs more memory than the {most} bytes that one may have here: ask for less."
        return problem_of(422, "too-much-work", detail)
    except Exception:
        logger.exception("A job failed: %s", task.call)
        return problem_of(500, "internal-error", "The service failed on this job; the log of the service says why.")


def written(found: bytes, folder: Path) -> Path:
    """A new file with the answer, safe on the disk. raises: OSError, and leaves no file"""
    handle, name = tempfile.mkstemp(prefix=".", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(found)
            file.flush()
            os.fsync(file.fileno())
    except BaseException:
        os.unlink(name)
        raise
    return Path(name)


def do(store: Store, job: str, settings: Settings, mouth: Mouth) -> None:
    """The job, to its answer or its problem."""
    task = Task.from_bytes(store.call(job))
    found = answer(task, settings, mouth)
    most = settings.job_result_bytes_max
    if isinstance(found, bytes) and len(found) > most:
        detail = f"The answer has {len(found)} bytes, and one that is kept may have {most}: ask for less."
        found = problem_of(413, "content-too-large", detail)
    if isinstance(found, bytes):
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
    limit_memory(settings.job_memory_max)
    mouth = Mouth()
    # Byte by byte, so that nothing behind the line is taken from who follows the input.
    job = b"".join(iter(lambda: os.read(sys.stdin.fileno(), 1).strip(), b"")).decode()
    if not job:  # Whoever started this process is gone.
        return
    follow_input()
    store = Store(Path(sys.argv[1]))
    do(store, job, settings, mouth)


if __name__ == "__main__":
    main()

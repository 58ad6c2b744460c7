"""The process of one job: python -m app.jobs.work FOLDER, the job's id on standard input, what happens on output.

It puts the call to the service's own code and writes the answer into a new file, which the runner then names. It
changes nothing in the store: whatever becomes of it, nothing is lost or done by halves.

output  lines of JSON: {"share": 0.5}, {"written": FILE, "media_type": ...} or {"problem": TEXT}
"""

from __future__ import annotations

import asyncio
import os
import sys
import tempfile
import time
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import orjson
from fastapi import Request, Response

from app.jobs.call import Answer, Call, ask
from app.jobs.runner import follow_input
from app.jobs.store import Store
from app.main import create_app
from app.problems import problem
from app.reply import PROGRESS
from app.settings import Settings

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


def answer(call: Call, settings: Settings, mouth: Mouth) -> Answer:
    """What the service says to the call."""
    app = create_app(settings)
    most = settings.job_memory_max

    async def too_much(request: Request, error: Exception) -> Response:
        detail = f"The job needs more memory than the {most} bytes that one may have here: ask for less."
        return problem(422, "too-much-work", detail)

    app.add_exception_handler(MemoryError, too_much)
    return asyncio.run(ask(app, call, {}, {PROGRESS: mouth.share}))


def written(found: Answer, folder: Path) -> Path:
    """A new file with the answer, safe on the disk. raises: OSError, and leaves no file"""
    handle, name = tempfile.mkstemp(prefix=".", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(found.body)
            file.flush()
            os.fsync(file.fileno())
    except BaseException:
        os.unlink(name)
        raise
    return Path(name)


def do(store: Store, job: str, settings: Settings, mouth: Mouth) -> None:
    """The job, to its answer or its problem."""
    found = answer(Call.from_bytes(store.call(job)), settings, mouth)
    if found.status != 200:
        return mouth.say(problem=found.body.decode())
    most = settings.job_result_bytes_max
    if len(found.body) > most:
        detail = f"The answer has {len(found.body)} bytes, and one that is kept may have {most}: ask for less."
        return mouth.say(problem=_text(problem(413, "content-too-large", detail)))
    try:
        file = written(found, store.results)
    except OSError as error:
        detail = f"The answer could not be written into the data folder: {error.strerror}. Make room and ask again."
        return mouth.say(problem=_text(problem(507, "insufficient-storage", detail)))
    return mouth.say(written=str(file), media_type=found.headers["content-type"])


def _text(said: Response) -> str:
    return bytes(said.body).decode()


def main() -> None:
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    settings = Settings()
    limit_memory(settings.job_memory_max)
    mouth = Mouth()
    # Byte by byte, so that nothing behind the line is taken from who follows the input.
    job = b"".join(iter(lambda: os.read(sys.stdin.fileno(), 1).strip(), b"")).decode()
    follow_input()
    store = Store(Path(sys.argv[1]))
    do(store, job, settings, mouth)


if __name__ == "__main__":
    main()

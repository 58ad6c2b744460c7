"""Grading in processes of their own: python -m app.service.graders

A file is read by Python code for seconds, and of all threads of a process one at a time runs Python code: beside four
texts of 20 MB another client waited 1.8 s (measured 2026-11-22). So each file is graded in another process, with low
priority. The process is killed at the deadline, or when the client is gone; otherwise it may grade the next file.

input   name, bytes and language of a file, again and again; its end: whoever started this process is gone
output  what is said of each file
"""

from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from threading import Event, Thread
from typing import BinaryIO, cast

from app.files.tables import Language
from app.grade.report import FileAnswer, graded, too_long
from app.jobs.keeper import start
from app.jobs.work import NICENESS
from app.sweeps.worker import receive, send
from core import Budget

# Processes that wait for a file, of 60 to 90 MB each; and how often a file is tried whose process others kill.
WAITING, TRIES = 1, 2
# Between two looks at a budget [s].
LOOK_SECONDS = 0.05


class Graders:
    """The processes that grade for one process of the service."""

    def __init__(self) -> None:
        self._waiting: list[subprocess.Popen[bytes]] = []

    def graded(self, name: str, data: bytes, language: Language, budget: Budget) -> FileAnswer:
        """The grade of one file. raises: TooMuchWork when the budget is stopped; EOFError when no process survives"""
        for _ in range(TRIES):
            try:
                process = self._waiting.pop()
            except IndexError:
                process = start("app.service.graders", stdout=subprocess.PIPE)
            try:
                with _ended_with(process, budget):
                    send(cast(BinaryIO, process.stdin), (name, data, language))
                    answer: FileAnswer = pickle.loads(receive(cast(BinaryIO, process.stdout)))
            except (EOFError, OSError):
                _end(process)
                if budget.stopped:
                    raise too_long(data, budget) from None
                continue
            self._waiting.append(process)
            if len(self._waiting) > WAITING:
                _end(self._waiting.pop())
            return answer
        raise EOFError(f"a file of {len(data)} bytes ended {TRIES} processes that graded it")

    def close(self) -> None:
        """End the processes that wait."""
        while self._waiting:
            _end(self._waiting.pop())


@contextlib.contextmanager
def _ended_with(process: subprocess.Popen[bytes], budget: Budget) -> Iterator[None]:
    """A context in which the process is killed as soon as the budget is stopped."""
    done = Event()

    def watch() -> None:
        while not done.wait(LOOK_SECONDS):
            if budget.stopped:
                process.kill()
                break

    watcher = Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        # A pipe that nobody reads any more cannot be flushed.
        with contextlib.suppress(OSError):
            cast(BinaryIO, stream).close()


def main() -> None:
    """Grade what comes in until nothing does."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # What a library prints is no answer.
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            name, data, language = pickle.loads(receive(sys.stdin.buffer))
            send(sink, graded(name, data, language, Budget()))


if __name__ == "__main__":
    main()

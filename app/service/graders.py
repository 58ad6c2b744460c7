"""Reading of files in separate processes: python -m app.start app.service.graders

Python code reads a file for seconds, and only one thread of a process at a time runs Python code: beside four texts of
20 MB another client waited 1.8 s (measured on 2026-11-22). So each file is read in another process, with low priority.
The process is killed at the deadline, or when the client is gone; otherwise it may read the next file.

input   functions, each with its arguments except the budget; the input ends when the parent process ends
output  the value that each function returns
"""

from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from threading import Event, Thread
from typing import BinaryIO, TypeVar, cast

from app.jobs.keeper import start
from app.jobs.work import NICENESS
from app.sweeps.worker import end, receive, send
from core import Budget
from core.kernels import Halted

Answer = TypeVar("Answer")
# Largest number of processes that wait for a file, of 60 to 90 MB each; and number of tries of a file whose process is
# killed from outside [1].
WAITING, TRIES = 1, 2
# Time between two looks at a budget [s].
LOOK_SECONDS = 0.05


class Graders:
    """The processes that read files for one process of the service."""

    def __init__(self) -> None:
        self._waiting: list[subprocess.Popen[bytes]] = []

    def asked(self, budget: Budget, read: Callable[..., Answer], *given: object) -> Answer:
        """The value that a function of a module returns for a file; its last argument is a budget.

        raises: Halted when the budget is stopped; EOFError when no process survives
        """
        for _ in range(TRIES):
            try:
                process = self._waiting.pop()
            except IndexError:
                process = start("app.service.graders", stdout=subprocess.PIPE)
            try:
                with _ended_with(process, budget):
                    send(cast(BinaryIO, process.stdin), (read, given))
                    answer: Answer = pickle.loads(receive(cast(BinaryIO, process.stdout)))
            except (EOFError, OSError):
                end(process)
                if budget.stopped:
                    raise Halted(budget) from None
                continue
            self._waiting.append(process)
            with contextlib.suppress(IndexError):  # Other threads take some at the same time.
                if len(self._waiting) > WAITING:
                    end(self._waiting.pop())
            return answer
        raise EOFError(f"a file ended {TRIES} processes that read it")

    def close(self) -> None:
        """End the processes that wait."""
        while self._waiting:
            end(self._waiting.pop())


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


def main() -> None:
    """Answer inputs until they end."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # The output of libraries must not mix with the answers.
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            read, given = pickle.loads(receive(sys.stdin.buffer))
            send(sink, read(*given, Budget()))

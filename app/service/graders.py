"""Reading of files in separate processes: python -m app.start app.service.graders BYTES

Python code reads a file for seconds, and only one thread of a process at a time runs Python code: beside four texts of
20 MB another client waited 1.8 s (measured on 2026-11-22). So each file is read in another process, with low priority.
The process is killed at the deadline, or when the client is gone; otherwise it may read the next file. Its address
space has a limit, BYTES, and it is the first that the system ends when memory runs out: whatever a file holds, it costs
no more than one process.

input   functions, each with its arguments except the budget; the input ends when the parent process ends
output  for each function: None, when it has been received; then an Outcome
"""

from __future__ import annotations

import contextlib
import logging
import os
import pickle
import subprocess
import sys
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from threading import Event, Thread
from typing import BinaryIO, TypeVar, cast

from app.files.memory import READING_MAX, end_first, limit_memory, peak_memory, too_much_memory
from app.jobs.keeper import start
from app.jobs.work import NICENESS, is_small
from app.logs import log_to_stderr
from app.settings import Settings
from app.sweeps.worker import end, receive, send
from core import BenchDragonError, Budget, InvalidValue
from core.kernels import Halted

logger = logging.getLogger("app.service")

Answer = TypeVar("Answer")
# Largest number of processes that wait for a file, of 60 to 90 MB each; and number of processes that are tried, because
# one may have been killed while it waited [1].
WAITING, TRIES = 1, 3
# Time between two looks at a budget [s].
LOOK_SECONDS = 0.05


@dataclass(frozen=True)
class Outcome:
    """What became of a file.

    value: of the function, None if it raised `error`; peak: memory of the process so far [bytes]; again: True if it
    reads another file
    """

    value: object = None
    error: BenchDragonError | None = None
    peak: int = 0
    again: bool = True


class Graders:
    """The processes that read files for one process of the service."""

    def __init__(self, memory_max: int = READING_MAX, seen: Callable[[int | None], object] = lambda peak: None) -> None:
        """memory_max: address space of a process [bytes]

        seen: called after each file with the memory of its process so far [bytes]; None: the file ended it
        """
        self._waiting: list[subprocess.Popen[bytes]] = []
        self._memory_max, self._seen = memory_max, seen

    def asked(self, budget: Budget, read: Callable[..., Answer], *given: object) -> Answer:
        """The value that a function of a module returns for a file; its last argument is a budget.

        A file that ended a process is not tried again.
        raises: Halted when the budget is stopped; the error that the function raised; InvalidValue at the field `file`
            for a file that ended the process, or at which the function failed; TooMuchWork for one that needs too much
            memory; EOFError when no process starts
        """
        for _ in range(TRIES):
            process, received = self._taken(), False
            try:
                with _ended_with(process, budget):
                    send(cast(BinaryIO, process.stdin), (read, given))
                    receive(cast(BinaryIO, process.stdout))
                    received = True
                    outcome: Outcome = pickle.loads(receive(cast(BinaryIO, process.stdout)))
            except (EOFError, OSError):
                end(process)
                if budget.stopped:
                    raise Halted(budget) from None
                if not received:
                    continue
                self._seen(None)
                words = "the file must be simpler: reading it ended the process that read it"
                raise InvalidValue.in_words("file", words) from None
            self._keep(process, outcome.again)
            self._seen(outcome.peak)
            if outcome.error is not None:
                raise outcome.error
            return cast(Answer, outcome.value)
        raise EOFError(f"{TRIES} processes that read files could not be started")

    def _taken(self) -> subprocess.Popen[bytes]:
        with contextlib.suppress(IndexError):
            return self._waiting.pop()
        # Without threads, each of which reserves 40 MB of address space, one for each core of the machine.
        one = {"OPENBLAS_NUM_THREADS": "1"}
        return start("app.service.graders", str(self._memory_max), stdout=subprocess.PIPE, **one)

    def _keep(self, process: subprocess.Popen[bytes], again: bool) -> None:
        if not again:
            end(process)
            return
        self._waiting.append(process)
        with contextlib.suppress(IndexError):  # Other threads take some at the same time.
            if len(self._waiting) > WAITING:
                end(self._waiting.pop())

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


def outcome_of(read: Callable[..., object], given: tuple[object, ...], memory_max: int) -> Outcome:
    """What became of a file. Whatever the function raises is an answer."""
    value: object = None
    error: BenchDragonError | None = None
    try:
        value = read(*given, Budget())
    except BenchDragonError as refused:
        error = refused
    except MemoryError:
        error = too_much_memory(memory_max)
    except Exception as fault:
        error = _unexpected(fault)
    return Outcome(value, error, peak_memory(), is_small())


def _unexpected(fault: Exception) -> InvalidValue:
    """The refusal of a file at which a reader failed. The log has the places in the code, and nothing of the file."""
    kind = type(fault).__name__
    places = (f"{place.filename}:{place.lineno}" for place in traceback.extract_tb(fault.__traceback__))
    logger.error("A file could not be read: %s at %s", kind, ", ".join(places))
    words = "the file could not be read ({kind}): save it again, by another program if there is one"
    return InvalidValue.in_words("file", words, kind=kind)


def main() -> None:
    """Answer inputs until they end."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    memory_max = int(sys.argv[1])
    end_first()
    limit_memory(memory_max)
    log_to_stderr(Settings().log_json)
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # The output of libraries must not mix with the answers.
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            data = receive(sys.stdin.buffer)
            send(sink, None)
            _answer(sink, data, memory_max)
            del data


def _answer(sink: BinaryIO, data: bytes, memory_max: int) -> None:
    try:
        read, given = pickle.loads(data)
        outcome = outcome_of(read, given, memory_max)
        del read, given
        send(sink, outcome)
    except MemoryError:  # of the pickles
        send(sink, Outcome(error=too_much_memory(memory_max), peak=peak_memory(), again=False))

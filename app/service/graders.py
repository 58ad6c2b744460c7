"""Reading of files in separate processes: python -m app.start app.service.graders BYTES

Python code reads a file for seconds, and only one thread of a process at a time runs Python code: beside four texts of
20 MB another client waited 1.8 s (measured on 2026-11-22). So each file is read in another process, with low priority.
The process is killed at the deadline, or when the client is gone; otherwise it may read the next file. Its address
space has a limit, BYTES, and it is the first that the system ends when memory runs out: whatever a file holds, it costs
no more than one process.

task    a function, and its arguments except the budget
answer  a GradingOutcome
"""

from __future__ import annotations

import logging
import pickle
import sys
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeVar, cast

from app.logs import log_to_stderr
from app.processes.child import ProcessEnded
from app.processes.limits import (
    AWAITED_NICENESS,
    READING_MAX,
    end_first,
    limit_memory,
    lower_priority,
    peak_memory,
    too_much_memory,
)
from app.processes.parent import Report, answer_tasks
from app.processes.pool import Pool
from app.settings import Settings
from core import BenchDragonError, Budget, InvalidValue
from core.language import speaking, spoken

logger = logging.getLogger("app.service")

Answer = TypeVar("Answer")
# Largest number of processes that wait for a file, of 60 to 90 MB each [1].
WAITING = 1
# Threads and heaps reserve address space: OpenBLAS 40 MB for each core, glibc 64 MB for each thread with a heap.
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "MALLOC_ARENA_MAX": "1"}


@dataclass(frozen=True)
class GradingOutcome:
    """What became of a file.

    value: of the function, None if it raised `error`; peak: memory of the process so far [bytes]
    """

    value: object = None
    error: BenchDragonError | None = None
    peak: int = 0


class Graders:
    """The processes that read files for one process of the service."""

    def __init__(self, memory_max: int = READING_MAX, seen: Callable[[int | None], object] = lambda peak: None) -> None:
        """memory_max: address space of a process [bytes]

        seen: called after each file with the memory of its process so far [bytes]; None: the file ended it
        """
        self._pool = Pool("app.service.graders", str(memory_max), waiting=WAITING, environment=ENVIRONMENT)
        self._seen = seen

    def read(self, budget: Budget, reader: Callable[..., Answer], *arguments: object) -> Answer:
        """The value that a function of a module returns for a file; its last argument is a budget.

        A file that ended a process is not tried again.
        raises: Halted when the budget is stopped; the error that the function raised; InvalidValue at the field `file`
            for a file that ended the process, or at which the function failed; TooMuchWork for one that needs too much
            memory; ProcessEnded when no process starts
        """
        try:
            task = pickle.dumps((spoken(), reader, arguments))
            outcome: GradingOutcome = pickle.loads(self._pool.answer(task, budget))
        except ProcessEnded as end:
            if not end.received:
                raise
            self._seen(None)
            logger.error("The process that read a file was ended by %s. Without memory Linux sends 9.", end.how)
            words = "the file must be simpler: reading it ended the process that read it"
            raise InvalidValue.in_words("file", words) from None
        self._seen(outcome.peak)
        if outcome.error is not None:
            raise outcome.error
        return cast(Answer, outcome.value)

    def close(self) -> None:
        """End the processes."""
        self._pool.close()


def outcome_of(task: bytearray, report: Report, *, memory_max: int) -> bytes:
    """The GradingOutcome of a file, pickled. Whatever the function raises is an answer."""
    try:
        return pickle.dumps(GradingOutcome(_read(task), peak=peak_memory()))
    except BenchDragonError as refusal:
        error = refusal
    except MemoryError:
        error = too_much_memory(memory_max)
    except Exception as fault:
        error = _unexpected(fault)
    return pickle.dumps(GradingOutcome(error=error, peak=peak_memory()))


def _read(task: bytearray) -> object:
    language, reader, arguments = pickle.loads(task)
    with speaking(language):
        return reader(*arguments, Budget())


def _unexpected(fault: Exception) -> InvalidValue:
    """The refusal of a file at which a reader failed. The log has the places in the code, and nothing of the file."""
    kind = type(fault).__name__
    places = (f"{place.filename}:{place.lineno}" for place in traceback.extract_tb(fault.__traceback__))
    logger.error("A file could not be read: %s at %s", kind, ", ".join(places))
    words = "the file could not be read ({kind}): save it again, by another program if there is one"
    return InvalidValue.in_words("file", words, kind=kind)


def main() -> None:
    """Read files until the parent ends."""
    lower_priority(AWAITED_NICENESS)
    memory_max = int(sys.argv[1])
    end_first()
    limit_memory(memory_max)
    log_to_stderr(Settings().log_json)
    answer_tasks(partial(outcome_of, memory_max=memory_max))

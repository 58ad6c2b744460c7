"""The embedded engine: processes with one piece at a time (python -m app.start app.sweeps.processes).

A process starts when a piece waits for one, so a sweep of one shard has one process however many it may have.

task    a ShardPiece
answer  the result of attempt()
"""

from __future__ import annotations

import pickle
import queue
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress

from app.processes.child import ProcessEnded
from app.processes.parent import Report, answer_tasks
from app.processes.pool import STARTS, Pool
from app.sweeps.engines import Done, attempt, done_of
from app.sweeps.shards import ShardPiece
from core import BenchDragonError
from core.threads import usable_cores


class CannotStart(BenchDragonError):
    """Every process of a sweep ended before it answered a piece."""

    code = "cannot-start"


class Processes:
    """A number of processes at most; a dead one is replaced."""

    alone = True

    def __init__(self, workers: int | None = None) -> None:
        self._most = workers or usable_cores()
        self._pool = Pool("app.sweeps.processes", waiting=self._most)
        self._threads = ThreadPoolExecutor(self._most)  # each waits for one answer
        self._finished: queue.SimpleQueue[Future[Done]] = queue.SimpleQueue()

    @property
    def workers(self) -> int:
        """Largest number of processes."""
        return self._most

    @property
    def pids(self) -> list[int]:
        """Process ids."""
        return self._pool.pids

    def submit(self, piece: ShardPiece) -> None:
        """Take a piece, now or when a process is idle."""
        self._threads.submit(self._answer, piece).add_done_callback(self._finished.put)

    def wait(self, seconds: float) -> list[Done]:
        """Pieces answered since the last call. raises: CannotStart, NoAnswer"""
        done: list[Done] = []
        with suppress(queue.Empty):
            done.append(self._finished.get(timeout=seconds).result())
            while True:
                done.append(self._finished.get_nowait().result())
        return done

    def close(self) -> None:
        """End all processes."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._pool.close()
        self._threads.shutdown()

    def _answer(self, piece: ShardPiece) -> Done:
        try:
            result = pickle.loads(self._pool.answer(pickle.dumps(piece)))
        except ProcessEnded as end:
            if end.received:
                return Done(piece, None)
            words = "{count} processes in a row ended before they were ready"
            raise CannotStart.in_words("workers", words, count=STARTS) from None
        return done_of(piece, result)


def answer(task: bytearray, report: Report) -> bytes:
    """The rows of a piece, or the reason why there are none, pickled."""
    try:
        result = attempt(pickle.loads(task))
    except Exception as error:  # This process cannot import something that the piece needs.
        result = (None, f"{type(error).__name__}: {error}")
    return pickle.dumps(result)


def main() -> None:
    """Answer pieces until the parent ends. All need much the same memory, so no process is renewed for it."""
    answer_tasks(answer, again=lambda: True)

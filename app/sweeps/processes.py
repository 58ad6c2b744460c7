"""The embedded engine: processes of this machine, each with one piece at a time.

A process starts when a piece waits for one, so a sweep of one shard has one process however many it may have.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import subprocess
import sys
import threading
from collections import deque
from typing import Any, cast

from app.settings import usable_cores
from app.start import search_path
from app.sweeps.engines import Done, arrived
from app.sweeps.shards import ShardPiece
from app.sweeps.worker import end, receive, send
from core import BenchDragonError

# Message in place of an answer when a process has ended.
GONE = object()
# Number of processes in a row that may end before they are ready.
STARTS = 5
# Longest wait for a process to end after a request [s].
PATIENCE = 5.0


class CannotStart(BenchDragonError):
    """Every process of a sweep ended before it answered a piece."""

    code = "cannot-start"


class _Worker:
    """One process, and the thread that listens to it."""

    def __init__(self, events: queue.SimpleQueue[tuple[_Worker, Any]]) -> None:
        self.piece: ShardPiece | None = None
        self.ready = False
        self._events = events
        # In a new session, so that Ctrl-C stops the sweep and does not interrupt the workers one by one.
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", "app.sweeps.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
            env={**os.environ, **search_path()},
        )
        threading.Thread(target=self._listen, daemon=True).start()

    def give(self, piece: ShardPiece) -> None:
        """Send a piece to the process; the thread reports the answer, or that the process died."""
        self.piece = piece
        with contextlib.suppress(OSError):
            send(cast(Any, self.process.stdin), piece)

    def _listen(self) -> None:
        while True:
            try:
                answer = pickle.loads(receive(cast(Any, self.process.stdout)))
            except (EOFError, OSError, ValueError):
                self._events.put((self, GONE))
                return
            self._events.put((self, answer))


class Processes:
    """A number of processes at most; a dead one is replaced."""

    alone = True

    def __init__(self, workers: int | None = None) -> None:
        self._events: queue.SimpleQueue[tuple[_Worker, Any]] = queue.SimpleQueue()
        self._waiting: deque[ShardPiece] = deque()
        self._idle: list[_Worker] = []
        self._most = workers or usable_cores()
        self._all: set[_Worker] = set()
        self._failed_starts = 0

    @property
    def workers(self) -> int:
        """Largest number of processes."""
        return self._most

    @property
    def pids(self) -> list[int]:
        """Process ids."""
        return [worker.process.pid for worker in self._all]

    def submit(self, piece: ShardPiece) -> None:
        """Take a piece, now or when a process is idle."""
        self._waiting.append(piece)
        self._hand_out()

    def wait(self, seconds: float) -> list[Done]:
        """Pieces answered since the last call. raises: CannotStart, NoAnswer"""
        done: list[Done] = []
        with contextlib.suppress(queue.Empty):
            done += self._heard(*self._events.get(timeout=seconds))
            while True:
                done += self._heard(*self._events.get_nowait())
        self._hand_out()
        return done

    def close(self) -> None:
        """End all processes."""
        self._waiting.clear()
        for worker in self._all:
            end(worker.process, PATIENCE)

    def _hand_out(self) -> None:
        while self._waiting and self._idle:
            self._idle.pop().give(self._waiting.popleft())
        starting = sum(not worker.ready for worker in self._all)
        for _ in range(min(len(self._waiting) - starting, self._most - len(self._all))):
            self._all.add(_Worker(self._events))

    def _heard(self, worker: _Worker, answer: Any) -> list[Done]:
        piece, worker.piece = worker.piece, None
        if answer is GONE:
            self._forget(worker)
            return [Done(piece, None)] if piece else []
        self._idle.append(worker)
        if not worker.ready:
            worker.ready, self._failed_starts = True, 0
            return []
        assert piece is not None
        return [arrived(piece, answer)]

    def _forget(self, worker: _Worker) -> None:
        end(worker.process, PATIENCE)
        self._all.discard(worker)
        if worker in self._idle:
            self._idle.remove(worker)
        self._failed_starts += not worker.ready
        if self._failed_starts >= STARTS:
            words = "{count} processes in a row ended before they were ready"
            raise CannotStart.in_words("workers", words, count=STARTS)

"""The engine for a sweep on several machines: an existing Dask cluster, or a new one on this machine.

Workers need the same version of bench-dragon, but no common folder: this process receives and writes their answers. A
piece is submitted again if its worker, its future or the scheduler is lost.
"""

from __future__ import annotations

import asyncio
import logging
import queue
import time
from concurrent.futures import CancelledError, ThreadPoolExecutor
from contextlib import suppress

from distributed import Client, Future, KilledWorker, LocalCluster
from distributed.comm.core import connect

from app.sweeps.engines import Done, NoAnswer, NoScheduler, attempt, done_of
from app.sweeps.shards import ShardPiece

logger = logging.getLogger("app.sweeps")

# Stands in place of an address for a new cluster on this machine.
LOCAL = "local"
# Longest wait for a scheduler that is lost, and time between two attempts to reach it [s].
PATIENCE, RETRY_AFTER = 600.0, 1.0
# A run ends after so many failures in a row while the scheduler answers.
FAILURES_MOST = 8
# Longest time to connect, longest time for the transfer of an answer, and time between two checks for lost futures [s].
CONNECT, ANSWER, CHECK_EVERY = 10.0, 60.0, 2.0


def _local_cluster(workers: int | None) -> LocalCluster:
    """A new cluster on this machine. It does not retry a piece whose worker died, because the run does."""
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        silence_logs=logging.ERROR,
        scheduler_kwargs={"allowed_failures": 0},
    )


async def _connect_once(address: str) -> None:
    """Connect to an address and disconnect, because a Client would wait forever for an address that does not answer.

    raises: OSError, TimeoutError
    """
    if address.startswith("tcp://") or "://" not in address:
        async with asyncio.timeout(CONNECT):
            await (await connect(address, timeout=CONNECT)).close()


class Cluster:
    """A Dask cluster as a SweepEngine."""

    alone = False

    def __init__(
        self, address: str, workers: int | None = None, patience: float = PATIENCE, first: float = 0.0
    ) -> None:
        """Connect to a cluster, or start one.

        address: of the scheduler, or LOCAL; workers: their number in a local cluster, by default one for each core
        patience: longest wait for a scheduler that was lost [s]; first: longest wait for its first answer [s]
        raises: NoScheduler
        """
        self._own = _local_cluster(workers) if address == LOCAL else None
        self._address = self._own.scheduler_address if self._own else address
        self._patience = patience
        self._finished: queue.SimpleQueue[Future[tuple[bytes | None, str]]] = queue.SimpleQueue()
        self._out: dict[Future[tuple[bytes | None, str]], ShardPiece] = {}
        self._lost: list[ShardPiece] = []
        self._checked_at, self._workers, self._failures = 0.0, 1, 0
        self._client = self._connected(first)

    @property
    def workers(self) -> int:
        """Number of threads of all workers at the last count."""
        return self._workers

    def submit(self, piece: ShardPiece) -> None:
        """Submit a piece to the cluster, now or after the connection is restored."""
        # pure=False gives each future a key of its own. With the key of a cancelled future, Dask would return that one.
        try:
            future = self._client.submit(attempt, piece, pure=False)
        except Exception as error:
            self._failed(piece, error)
            return
        self._out[future] = piece
        future.add_done_callback(self._finished.put)

    def wait(self, seconds: float) -> list[Done]:
        """Pieces answered since the last call. raises: NoScheduler, NoAnswer"""
        done: list[Done] = []
        with suppress(queue.Empty):
            done += self._result_of(self._finished.get(timeout=seconds))
            while True:
                done += self._result_of(self._finished.get_nowait())
        if time.monotonic() - self._checked_at > CHECK_EVERY:
            self._check()
        return done

    def close(self) -> None:
        """Disconnect from the cluster, and end it if it is a local one."""
        for future in self._out:
            with suppress(Exception):
                future.cancel()
        with suppress(Exception):
            self._client.close(timeout=CONNECT)
        if self._own:
            self._own.close()

    def _result_of(self, future: Future[tuple[bytes | None, str]]) -> list[Done]:
        """The piece of a finished future with its rows; empty if it must be submitted again, or was already."""
        piece = self._out.pop(future, None)
        if piece is None:
            return []
        try:
            attempted = future.result(timeout=ANSWER)
        except KilledWorker:
            return [Done(piece, None)]
        except (CancelledError, OSError, TimeoutError):
            self._lost.append(piece)
        except Exception as error:
            self._failed(piece, error)
        else:
            self._failures = 0
            return [done_of(piece, attempted)]
        return []

    def _failed(self, piece: ShardPiece, error: Exception) -> None:
        """Note a piece whose future failed, to be submitted again: a failing cluster raises many kinds of errors.

        raises: NoAnswer after FAILURES_MOST of them in a row
        """
        self._failures += 1
        if self._failures >= FAILURES_MOST and self._client.status == "running":
            words, why = "workers of {address} cannot answer: {why}", f"{type(error).__name__}: {error}"
            raise NoAnswer.in_words("workers", words, address=self._address, why=why) from error
        self._lost.append(piece)

    def _check(self) -> None:
        """Reconnect if necessary, and submit the lost pieces again."""
        self._checked_at = time.monotonic()
        if self._client.status not in ("running", "connecting"):
            self._lost += self._out.values()
            self._out.clear()
            with suppress(Exception):
                self._client.close(timeout=CONNECT)
            self._client = self._connected(self._patience)
        if self._client.status != "running":
            return
        for future in [future for future in self._out if future.status in ("cancelled", "lost")]:
            self._lost.append(self._out.pop(future))
        lost, self._lost = self._lost, []
        for piece in lost:
            self.submit(piece)
        with suppress(Exception):
            self._workers = max(sum(self._client.nthreads().values()), 1)

    def _connected(self, patience: float) -> Client:
        """A client, as soon as the scheduler answers. raises: NoScheduler"""
        until, is_told = time.monotonic() + patience, False
        while True:
            try:
                with ThreadPoolExecutor(1) as thread:  # The caller's thread may have an event loop, as in a notebook.
                    thread.submit(asyncio.run, _connect_once(self._address)).result()
                client = Client(self._address, timeout=CONNECT, set_as_default=False)
                self._workers = max(sum(client.nthreads().values()), 1)
                return client
            except (OSError, TimeoutError, ValueError) as error:
                if time.monotonic() >= until:
                    words = "no Dask scheduler answers at {address}"
                    why = "start one there, or name another, and run the sweep again: it continues"
                    raise NoScheduler.in_words("dask", words, reason=why, address=self._address) from error
                if not is_told:
                    words = "No Dask scheduler answers at %s: the sweep waits for it, for %.0f s at most"
                    logger.warning(words, self._address, patience)
                    is_told = True
                time.sleep(RETRY_AFTER)

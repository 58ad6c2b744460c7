"""The service in several processes on one port: the Python around each answer then runs on several cores.

Threads of one process do not get there: only the search itself runs without Python's lock, a third of an answer, and
handing the lock to and fro costs what the second core gains. Against one process on one core, two cores give 1.0x the
requests per second to one process and 1.7x to two, with the client on the same cores (2026-11-21; in one process
sys.setswitchinterval from 0.05 to 100 ms, 2, 3 or 40 threads, asyncio's loop or uvloop change nothing for the better).
`make bench` measures it again.
"""

from __future__ import annotations

import errno
import logging
import multiprocessing
import os
import signal
import socket
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from tempfile import TemporaryDirectory, TemporaryFile
from threading import Thread
from typing import Any

import uvicorn
from fastapi import FastAPI
from prometheus_client.multiprocess import mark_process_dead
from uvicorn.supervisors import Multiprocess

from app.service.logs import log_config
from app.service.protocol import Protocol
from app.settings import SHARED_COUNTS, WORKERS_MAX, Settings
from core import InvalidValue

logger = logging.getLogger("uvicorn.error")

# Not httptools, though it saves a fifteenth of the time: it answers an unknown method before the service can, with 400
# and no problem details.
PARSER = Protocol
# Room for the counts of one process: three kinds of metrics, a file of 1 MiB each.
COUNTS_BYTES = 4 << 20
BACKLOG = 2048  # connections that wait to be taken, uvicorn's own number


def usable_cores() -> int:
    """Number of cores that this process may run on; those of the machine where the system has no such limit."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def process_count(asked: int | None, platform: str = sys.platform) -> int:
    """Number of processes of the service: as asked, else one for each core.

    platform: Python's name for the system
    raises: InvalidValue for several on Windows, which has no signals to end them and lets two services take one port
    """
    if platform != "win32":
        return asked or min(usable_cores(), WORKERS_MAX)
    if asked not in (None, 1):
        raise InvalidValue("workers", f"--workers must be 1 on Windows, where the service is one process, got {asked}")
    return 1


def listen(host: str, port: int) -> socket.socket:
    """A listening socket whose connections send at once.

    asyncio switches off Nagle's delay (TCP_NODELAY) only for sockets that name TCP as their protocol; with uvicorn's
    own shared socket the second packet of an answer waited for the client's delayed acknowledgement, 40 ms.
    raises: OSError when the port is taken or the address is not ours
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    shared = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    shared.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        shared.bind((host, port))
        # Now, not in the processes: until one listens, a second service could bind the same port and fail later.
        shared.listen(BACKLOG)
    except OSError:
        shared.close()
        raise
    shared.set_inheritable(True)
    return shared


class _Supervisor(Multiprocess):
    """uvicorn's, whose processes start without a word on Ctrl-C and leave no gauge behind when they die."""

    def __init__(self, config: uvicorn.Config, shared: socket.socket, counts: str | None) -> None:
        super().__init__(config, [shared])
        self.counts = counts
        self.counted: set[int | None] = set()

    def init_processes(self) -> None:
        # A terminal sends Ctrl-C to all processes, and one that still imports would end in a traceback: they ignore it
        # until they serve, and end by the word of this one.
        handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
        super().init_processes()
        signal.signal(signal.SIGINT, handler)

    def keep_subprocess_alive(self) -> None:
        super().keep_subprocess_alive()
        alive = {process.pid for process in self.processes}
        for gone in self.counted - alive if self.counts else ():
            mark_process_dead(gone, self.counts)  # type: ignore[no-untyped-call]
        self.counted = alive


@contextmanager
def _counts_folder(workers: int) -> Iterator[str | None]:
    """A folder in which the processes count; None, and a word in the log, where the system has no room for it.

    Their files are mapped into memory: on a full disk a process would die of its first count.
    """
    with ExitStack() as kept:
        try:
            folder = kept.enter_context(TemporaryDirectory(prefix="bench-dragon-"))
            with TemporaryFile(dir=folder, buffering=0) as room:
                for _ in range(workers):
                    if room.write(bytes(COUNTS_BYTES)) < COUNTS_BYTES:
                        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            why = error.strerror or str(error)
            logger.warning(
                "The folder for temporary files cannot be used (%s): /metrics shows one process alone. "
                "Free some space there, or set TMPDIR to another folder.",
                why,
            )
            kept.close()
            yield None
            return
        yield folder


def create_child_app() -> FastAPI:
    """create_app() in a process that ends when its parent has, also when that was killed and could not say so."""
    from app.service.main import create_app

    logging.captureWarnings(Settings().log_json)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def follow() -> None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)

    Thread(target=follow, daemon=True).start()
    return create_app()


def serve(host: str, port: int, workers: int) -> None:
    """Serve until interrupted, in one process or in several.

    raises: OSError when the port is taken or the address is not ours; with one process uvicorn says so and exits
    """
    settings = Settings()
    logging.captureWarnings(settings.log_json)
    given: dict[str, Any] = {
        "factory": True,
        "host": host,
        "port": port,
        "http": PARSER,
        "log_config": log_config(settings.log_json),
        "timeout_graceful_shutdown": settings.grace_seconds,
    }
    if workers == 1:
        uvicorn.run("app.service.main:create_app", **given)
        return
    config = uvicorn.Config("app.service.workers:create_child_app", workers=workers, **given)
    with listen(host, port) as shared, _counts_folder(workers) as counts:
        if counts:  # Where the processes add up what /metrics shows; prometheus_client reads it when they import it.
            os.environ[SHARED_COUNTS] = counts
        shown = f"[{host}]" if ":" in host else host
        at = f"http://{shown}:{shared.getsockname()[1]}"
        logger.info("Uvicorn running on %s in %d processes (Press CTRL+C to quit)", at, workers)
        _Supervisor(config, shared, counts).run()

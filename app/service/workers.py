"""The service in several processes on one port, so that the Python code around each answer runs on several cores.

Threads of one process do not achieve this: only the search itself, a third of an answer, runs without Python's lock,
and passing the lock between threads costs what the second core gains. With two cores in place of one, one process
answers 1.0x the requests per second and two processes 1.7x, with the client on the same cores (2026-11-21). One process
is no faster with sys.setswitchinterval from 0.05 to 100 ms, with 2, 3 or 40 threads, or with uvloop. `make bench`
measures it again.
"""

from __future__ import annotations

import errno
import logging.config
import multiprocessing
import os
import signal
import socket
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryFile
from threading import Thread
from typing import TYPE_CHECKING, Any

import uvicorn
from uvicorn.supervisors import Multiprocess
from uvicorn.supervisors.multiprocess import Process

from app.files.fonts import kept_list
from app.files.scratch import temporary
from app.jobs.keeper import scratch
from app.logs import log_config
from app.processes.child import cause_of
from app.settings import DATA, SHARED_COUNTS, WORKERS_MAX, Settings, refuse_open_port, unknown_variables
from app.start import importing
from core import InvalidValue
from core.quantities import Given
from core.threads import usable_cores

if TYPE_CHECKING:  # The first of several processes answers nothing and does not load the framework.
    from fastapi import FastAPI

logger = logging.getLogger("uvicorn.error")

# A parser by h11. httptools would save a fifteenth of the time, but answers an unknown method itself, with 400 and
# without problem details.
PARSER = "app.service.protocol:Protocol"
# Each process counts in files: their names in prometheus_client, and the size of each [bytes].
COUNTS, COUNTS_FILE = ("counter", "histogram", "gauge_livesum"), 1 << 20
# Free room that the service wants for the counts of each process, one file more than they have [bytes].
COUNTS_BYTES = 4 * COUNTS_FILE
# A process that is silent for longer is replaced [s]. It starts in up to ten seconds on a busy machine; once it serves,
# it answers within 0.4 s, also under all attacks of `make soak` at once (2026-11-23).
START_SECONDS, SILENT_SECONDS = 60, 10
# Longest time from the end of the pipe of a process to its own end [s].
ENDING_SECONDS = 1
# Time that a connection without a request stays open [s]: longer than a proxy keeps one (nginx: 60 s), which may send a
# request at the moment in which it is closed, and cannot know whether it may send it again.
IDLE_SECONDS = 75
BACKLOG = 2048  # Connections that may wait to be accepted; uvicorn's default.


def process_count(count: int | None, platform: str = sys.platform) -> int:
    """Number of processes of the service: the given count, otherwise one for each core up to WORKERS_MAX.

    platform: Python's name for the system
    raises: InvalidValue for several on Windows, which has no signals to end them and lets two services share one port
    """
    if platform != "win32":
        return count or min(usable_cores(), WORKERS_MAX)
    if count not in (None, 1):
        rule = "--workers must be 1 on Windows, where the service is one process"
        raise InvalidValue.in_words("workers", rule, got=Given(count))
    return 1


def listen(host: str, port: int) -> socket.socket:
    """A listening socket whose connections send without delay.

    asyncio switches off Nagle's delay (TCP_NODELAY) only for sockets that name TCP as their protocol; with uvicorn's
    own shared socket the second packet of an answer waited 40 ms for the client's delayed acknowledgement.
    raises: OSError when the port is taken or the address is not local
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    shared = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    shared.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        shared.bind((host, port))
        # Listen here, not in the processes: before one listens, a second service could bind the port and fail later.
        shared.listen(BACKLOG)
    except OSError:
        shared.close()
        raise
    shared.set_inheritable(True)
    return shared


class _Supervisor(Multiprocess):
    """uvicorn's supervisor, whose processes ignore Ctrl-C while they start, and leave no metrics behind when they die.

    It asks each process in turn through a pipe whether it is alive, and waits for the answer. It closes its own copy of
    the end that the process holds. A pipe then ends when its process is killed, and a new process starts at once.
    """

    def __init__(self, config: uvicorn.Config, shared: socket.socket, counts: str | None) -> None:
        super().__init__(config, [shared])
        self.counts = counts
        # Processes that have answered, and all of them, at the end of the last round of questions, by their ids.
        self.answered: set[int | None] = set()
        self.running: set[int | None] = set()

    def init_processes(self) -> None:
        # A terminal sends Ctrl-C to all processes, and one that still imports modules would end with a traceback. So
        # they ignore it until they serve, and this process ends them.
        handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
        super().init_processes()
        signal.signal(signal.SIGINT, handler)
        self._take_over()

    def terminate_all(self) -> None:
        # An open socket would let connections wait for processes that accept none, and be reset in the end. A client
        # whose connection is refused can ask another service.
        for shared in self.sockets:
            shared.close()
        super().terminate_all()

    def _take_over(self) -> None:
        for process in self.processes:
            process.child_conn.close()
            process.kill = partial(self._kill, process)  # type: ignore[method-assign]

    def _kill(self, process: Process) -> None:
        """End a process that does not answer; one that has ended by itself is logged with the cause."""
        process.process.join(ENDING_SECONDS)
        if process.exitcode is not None:
            cause = cause_of(process.exitcode)
            logger.error("Child process [%s] was ended by %s. Without memory Linux sends 9.", process.pid, cause)
        Process.kill(process)

    def keep_subprocess_alive(self) -> None:
        # uvicorn has one time limit for all processes: the long one as long as any of them has not answered.
        before = {process.pid for process in self.processes}
        self.config.timeout_worker_healthcheck = SILENT_SECONDS if before <= self.answered else START_SECONDS
        super().keep_subprocess_alive()
        self.config.timeout_worker_healthcheck = START_SECONDS
        self._take_over()
        after = {process.pid for process in self.processes}
        if self.counts and (gone := self.running - after):
            # Imported late, because a new process decides at the import whether its counts are shared.
            from prometheus_client.multiprocess import mark_process_dead

            for process in gone:
                mark_process_dead(process, self.counts)  # type: ignore[no-untyped-call]
        self.answered, self.running = before & after, after


@contextmanager
def _counts_folder(workers: int) -> Iterator[str | None]:
    """A folder for the counts of the processes; None, with a line in the log, if the system has no room for it.

    The files are mapped into memory, so that on a full disk a process would die at its first count.
    """
    with ExitStack() as kept:
        try:
            folder = kept.enter_context(temporary("counts-"))
            with TemporaryFile(dir=folder, buffering=0) as room:
                for _ in range(workers):
                    if room.write(bytes(COUNTS_BYTES)) < COUNTS_BYTES:
                        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            _warn_of_counts(error)
            kept.close()
            yield None
            return
        yield folder


def _warn_of_counts(error: OSError) -> None:
    """Log that each process counts for itself."""
    logger.warning(
        "The folder for temporary files cannot be used (%s): /metrics shows one process alone. "
        "Free some space there, or set TMPDIR to another folder.",
        error.strerror or str(error),
    )


def _reserve_counts() -> None:
    """Fill the files of this process's counts with zeros before they are mapped into memory.

    Otherwise a full disk would end the process at its first count in a new part of a file. If the files cannot be
    written, because there is no room or somebody removed the folder, this process counts for itself.
    """
    folder = os.environ.get(SHARED_COUNTS)
    if folder is None:
        return
    files = [Path(folder) / f"{kind}_{os.getpid()}.db" for kind in COUNTS]
    try:
        for file in files:
            file.write_bytes(bytes(COUNTS_FILE))
    except OSError as error:
        _warn_of_counts(error)
        for file in files:
            with suppress(OSError):
                file.unlink()
        del os.environ[SHARED_COUNTS]


def create_child_app() -> FastAPI:
    """create_app() in a process that ends when its parent ends, also when the parent is killed."""
    _reserve_counts()
    with importing():
        from app.service.main import create_app

    logging.captureWarnings(Settings().log_json)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def end_with_parent() -> None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)

    Thread(target=end_with_parent, daemon=True).start()
    return create_app()


def serve(host: str, port: int, workers: int) -> None:
    """Serve until interrupted, in one process or in several.

    raises: OSError when the port is taken or the address is not local; with one process uvicorn reports it and exits;
        InvalidValue for a port of a container that is open without a token
    """
    settings = Settings()
    refuse_open_port(settings)
    logging.captureWarnings(settings.log_json)
    options: dict[str, Any] = {
        "factory": True,
        "host": host,
        "port": port,
        "http": PARSER,
        "ws": "none",  # An upgrade is a request like others, whatever packages are installed.
        "log_config": log_config(settings.log_json),
        "proxy_headers": False,  # app/service/proxies.py
        "server_header": False,
        "timeout_graceful_shutdown": settings.grace_seconds,
        "timeout_keep_alive": IDLE_SECONDS,
        "timeout_worker_healthcheck": START_SECONDS,
    }
    logging.config.dictConfig(options["log_config"])
    for line in unknown_variables():
        logger.warning(line)
    if workers == 1:
        with importing():
            import_module("app.service.main")
        uvicorn.run("app.service.main:create_app", **options)
        return
    config = uvicorn.Config("app.service.workers:create_child_app", workers=workers, **options)
    with listen(host, port) as shared, _counts_folder(workers) as counts, ExitStack() as stack:
        stack.enter_context(kept_list())
        if settings.data is None:
            os.environ[DATA] = stack.enter_context(scratch())
        if counts:  # prometheus_client reads this variable in each process: there /metrics adds up the counts of all.
            os.environ[SHARED_COUNTS] = counts
        host_in_url = f"[{host}]" if ":" in host else host
        at = f"http://{host_in_url}:{shared.getsockname()[1]}"
        logger.info("Uvicorn running on %s in %d processes (Press CTRL+C to quit)", at, workers)
        _Supervisor(config, shared, counts).run()

"""The real service as users start it, with settings of a test."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.conftest import ROOT, STOP_TIMEOUT, wait_until_live

COMMAND = [sys.executable, "-c", "from app.command.main import app; app()", "serve"]


@dataclass
class Service:
    """A running service: where it answers, its first process, and the file of its log."""

    url: str
    process: subprocess.Popen[bytes]
    log: Path

    @property
    def address(self) -> tuple[str, int]:
        return "127.0.0.1", int(self.url.rpartition(":")[2])


@contextmanager
def serving(
    log: Path, workers: int = 1, limit: Callable[[], object] | None = None, **settings: object
) -> Iterator[Service]:
    """limit: called in the service's process before it starts; settings: by their names in app/settings.py"""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    given = {f"BENCH_DRAGON_{name.upper()}": str(value) for name, value in settings.items()}
    command = [*COMMAND, "--port", str(port), "--workers", str(workers)]
    with log.open("wb") as output:
        process = subprocess.Popen(
            command, cwd=ROOT, env=os.environ | given, stdout=output, stderr=output, preexec_fn=limit
        )
    try:
        wait_until_live(process, port, log)
        yield Service(f"http://127.0.0.1:{port}", process, log)
    finally:
        if process.poll() is None:
            process.terminate()
            process.wait(STOP_TIMEOUT)

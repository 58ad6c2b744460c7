"""The real service as users start it, with settings of a test."""

import os
import socket
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx

from tests.conftest import STOP_TIMEOUT, wait_until_live
from tests.support.command import ROOT, Process, serve

# Longest computation of one answer [s]: on a busy machine the ten seconds of the default are soon over.
PATIENT = 600.0


@dataclass
class Service:
    """A running service: where it answers, its first process, and the file of its log."""

    url: str
    process: Process
    log: Path

    @property
    def address(self):
        return "127.0.0.1", int(self.url.rpartition(":")[2])


def sample(url, name):
    """Value of one line of /metrics; 0 where it is not there yet."""
    lines = httpx.get(f"{url}/metrics").text.splitlines()
    return next((float(line.rpartition(" ")[2]) for line in lines if line.startswith(f"{name} ")), 0.0)


def free_port():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def environment_of(settings):
    """The environment of a service with these settings, by their names in app/settings.py."""
    outer = {name: value for name, value in os.environ.items() if not name.startswith("BENCH_DRAGON_")}
    return outer | {f"BENCH_DRAGON_{name.upper()}": str(value) for name, value in settings.items()}


@contextmanager
def serving(log, workers=1, limit=None, port=0, host="127.0.0.1", house=ROOT, **settings):
    """limit: called in the service's process before it starts; port: 0 for a free one; house: see command.run()"""
    port = port or free_port()
    process = serve(port, workers, environment_of(settings), log, limit, host, house)
    try:
        wait_until_live(process, port, log)
        yield Service(f"http://127.0.0.1:{port}", process, log)
    finally:
        if process.poll() is None:
            process.terminate()
            process.wait(STOP_TIMEOUT)

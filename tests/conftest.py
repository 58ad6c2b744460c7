"""Fixtures that several kinds of tests share."""

from __future__ import annotations

import http.client
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from core import kernels

ROOT = Path(__file__).parent.parent
START_TIMEOUT = 60.0  # [s] to the first answer; a cold start takes about one
STOP_TIMEOUT = 30.0  # [s] from the signal to the end; uvicorn lets running computations finish
# What takes seconds where there is no C compiler. The rest would take hours, as each search does: it needs the loops.
UNCOMPILED = ("test_architecture", "test_dragon", "test_kinematics", "test_paths", "test_problems", "test_rectangles")
UNCOMPILED += ("test_tables", "reference")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Without compiled loops, run what they are not needed for and the reference cases of first contact."""
    if kernels.COMPILED:
        return
    slow = pytest.mark.skip(reason="needs the compiled loops; without a C compiler this suite would take hours")
    for item in items:
        quick = any(name in item.nodeid for name in UNCOMPILED)
        if not quick or "test_design" in item.nodeid or "test_api" in item.nodeid:
            item.add_marker(slow)


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Base URL of the real service: uvicorn in its own process, on a free port, with the default settings."""
    log = tmp_path_factory.mktemp("server") / "server.log"
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("BENCH_DRAGON_")}
    command = [sys.executable, "-m", "uvicorn", "--factory", "app.main:create_app", "--port", str(port)]
    with log.open("wb") as output:
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=output, stderr=output)
    try:
        wait_until_live(process, port, log)
        yield f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        try:
            process.wait(STOP_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            raise


def wait_until_live(process: subprocess.Popen[bytes], port: int, log: Path) -> None:
    """Return when /healthz answers 200; fail with the server's own words when it cannot start."""
    end = time.monotonic() + START_TIMEOUT
    while process.poll() is None and time.monotonic() < end:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
        try:
            connection.request("GET", "/healthz")
            if connection.getresponse().status == http.client.OK:
                return
        except OSError:
            time.sleep(0.05)
        finally:
            connection.close()
    process.kill()
    pytest.fail(f"the server did not start:\n{log.read_text()}")

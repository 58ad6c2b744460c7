"""The rows of the performance table that go through the service, over loopback; nothing comes from a cache."""

from __future__ import annotations

import http.client
import itertools
import json
import os
import selectors
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from tests.conftest import wait_until_live

REQUESTS = 400  # in one round of the throughput rows
CLIENTS = 8
# No two requests of a run share a pitch, so no cache can answer.
PITCHES = (0.55 + k * 1e-9 for k in itertools.count())


def call(connection: http.client.HTTPConnection, method: str, path: str, body: str | None = None) -> bytes:
    connection.request(method, path, body, {"Content-Type": "application/json"} if body else {})
    response = connection.getresponse()
    answer = response.read()
    assert response.status == http.client.OK, answer
    return answer


def connect(server: str) -> http.client.HTTPConnection:
    return http.client.HTTPConnection(server.removeprefix("http://"))


@pytest.mark.parametrize("judged", ["dragon", "pair", "none"])
def test_get_collision_time(benchmark: BenchmarkFixture, server: str, judged: str) -> None:
    """Four engines judge the whole dragon, the touching pair alone, or nothing."""
    benchmark.group = "GET /collision-time"
    connection = connect(server)

    def get() -> bytes:
        return call(connection, "GET", f"/collision-time?pitch={next(PITCHES):.9f}&cross_check={judged}")

    benchmark.pedantic(get, rounds=200, warmup_rounds=10)


def test_post_trajectory(benchmark: BenchmarkFixture, server: str) -> None:
    benchmark.group = "POST /trajectory"
    connection = connect(server)

    def post() -> bytes:
        body = {"path": {"kind": "spiral", "pitch": next(PITCHES)}}
        return call(connection, "POST", "/trajectory", json.dumps(body))

    benchmark.pedantic(post, rounds=200, warmup_rounds=10)


@contextmanager
def serving(workers: int, cores: set[int], log: Path) -> Iterator[str]:
    """Base URL of `bench-dragon serve` with this number of processes, on these cores alone."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [Path(sys.executable).with_name("bench-dragon"), "serve", "--port", str(port), "--workers", str(workers)]
    own = os.sched_getaffinity(0)
    with log.open("wb") as output:
        os.sched_setaffinity(0, cores)  # a child inherits the cores of its parent
        try:
            process = subprocess.Popen(command, stdout=output, stderr=output)
        finally:
            os.sched_setaffinity(0, own)
    try:
        wait_until_live(process, port, log)
        yield f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        process.wait()


# Numbers of processes and cores: the second pair shows the gain by threads, the third by processes.
SERVICES = [(1, 1), (1, 2), (2, 2)]


@pytest.mark.parametrize("workers, cores", SERVICES, ids=[f"{w}on{c}" for w, c in SERVICES])
def test_throughput(benchmark: BenchmarkFixture, workers: int, cores: int, tmp_path: Path) -> None:
    """Requests per second of /collision-time with a check of the pair, from eight connections of one light client."""
    usable = sorted(os.sched_getaffinity(0))
    if len(usable) < cores:
        pytest.skip(f"needs {cores} cores")
    benchmark.group = "throughput"
    benchmark.extra_info["requests"] = REQUESTS

    def requests() -> tuple[tuple[list[bytes]], dict[str, object]]:
        head = "GET /collision-time?cross_check=pair&pitch={:.9f} HTTP/1.1\r\nHost: localhost\r\nConnection: close"
        count = REQUESTS if benchmark.enabled else CLIENTS
        return ([f"{head.format(next(PITCHES))}\r\n\r\n".encode() for _ in range(count)],), {}

    with serving(workers, set(usable[:cores]), tmp_path / "server.log") as server:
        port = int(server.rpartition(":")[2])
        benchmark.pedantic(lambda heads: answered(port, heads), setup=requests, rounds=9, warmup_rounds=3)


def answered(port: int, heads: list[bytes]) -> None:
    """Send all requests, CLIENTS at a time, and wait for the answers.

    Each request has its own connection, because a kept one would stay with one process. One thread waits for all: a
    client with threads takes half a core from the service.
    """
    waiting = heads[::-1]
    with selectors.DefaultSelector() as selector:

        def begin() -> None:
            connection = socket.create_connection(("127.0.0.1", port))
            connection.sendall(waiting.pop())
            selector.register(connection, selectors.EVENT_READ, bytearray())

        for _ in range(CLIENTS):
            begin()
        while selector.get_map():
            for key, _ in selector.select():
                connection, answer = key.fileobj, key.data
                assert isinstance(connection, socket.socket)
                part = connection.recv(65536)
                answer += part
                if not part:
                    assert answer.startswith(b"HTTP/1.1 200 "), bytes(answer)
                    selector.unregister(connection)
                    connection.close()
                    if waiting:
                        begin()

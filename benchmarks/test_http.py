"""The rows of the performance table that go through the service, over loopback, each answer computed anew."""

from __future__ import annotations

import http.client
import itertools
import json
import socket
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from tests.conftest import wait_until_live

REQUESTS = 200  # in one round of the throughput rows
CLIENTS = 8
# No two requests of a run share a pitch, so nothing can answer from a cache.
PITCHES = (0.55 + k * 1e-9 for k in itertools.count())


def call(connection: http.client.HTTPConnection, method: str, path: str, body: str | None = None) -> bytes:
    connection.request(method, path, body, {"Content-Type": "application/json"} if body else {})
    response = connection.getresponse()
    answer = response.read()
    assert response.status == http.client.OK, answer
    return answer


def connect(server: str) -> http.client.HTTPConnection:
    return http.client.HTTPConnection(server.removeprefix("http://"))


def test_get_collision_time(benchmark: BenchmarkFixture, server: str) -> None:
    benchmark.group = "GET /collision-time"
    connection = connect(server)
    benchmark.pedantic(
        lambda: call(connection, "GET", f"/collision-time?pitch={next(PITCHES):.9f}"), rounds=200, warmup_rounds=10
    )


def test_post_trajectory(benchmark: BenchmarkFixture, server: str) -> None:
    benchmark.group = "POST /trajectory"
    connection = connect(server)

    def post() -> bytes:
        body = {"path": {"kind": "spiral", "pitch": next(PITCHES)}}
        return call(connection, "POST", "/trajectory", json.dumps(body))

    benchmark.pedantic(post, rounds=200, warmup_rounds=10)


@contextmanager
def serving(workers: int, log: Path) -> Iterator[str]:
    """Base URL of `bench-dragon serve` with so many processes."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [Path(sys.executable).with_name("bench-dragon"), "serve", "--port", str(port), "--workers", str(workers)]
    with log.open("wb") as output, subprocess.Popen(command, stdout=output, stderr=output) as process:
        try:
            wait_until_live(process, port, log)
            yield f"http://127.0.0.1:{port}"
        finally:
            process.terminate()


@pytest.mark.parametrize("workers", [1, 2])
def test_throughput(benchmark: BenchmarkFixture, workers: int, tmp_path: Path) -> None:
    """Requests per second of /collision-time from eight clients, with one process and with two."""
    benchmark.group = "throughput"
    benchmark.extra_info["requests"] = REQUESTS

    def client(paths: list[str]) -> None:
        for path in paths:  # a connection each, as a kept one would stay with one process
            with closing(connect(server)) as connection:
                call(connection, "GET", path)

    def paths() -> tuple[tuple[list[list[str]]], dict[str, object]]:
        each = [
            [f"/collision-time?pitch={next(PITCHES):.9f}" for _ in range(REQUESTS // CLIENTS)] for _ in range(CLIENTS)
        ]
        return (each,), {}

    with serving(workers, tmp_path / "server.log") as server, ThreadPoolExecutor(CLIENTS) as pool:
        benchmark.pedantic(lambda each: list(pool.map(client, each)), setup=paths, rounds=7, warmup_rounds=2)

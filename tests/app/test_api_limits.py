"""Limits of the work: body bytes, also streamed, sizes from the environment, and simultaneous computations."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import httpx
import pytest

from app.files.tables import XLSX_TYPE
from app.settings import Settings, unknown_variables
from core import InvalidValue
from tests.support.serving import serving

BODY_BYTES_MAX = 1000
LIMITS = {
    "body_bytes_max": BODY_BYTES_MAX,
    "benches_max": 300,
    "cells_max": 200000,
    "cheap_max": 1,
    "heavy_max": 1,
    "retry_after": 7,
    "cache_seconds": 60,
}
# Seconds of work, and within the limits.
SLOW = {"times": {"stop": 400, "step": 0.5}}
BUSY_TIMEOUT = 60.0  # [s]


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """A real server with small limits."""
    with (
        serving(tmp_path_factory.mktemp("small") / "server.log", **LIMITS) as service,
        httpx.Client(base_url=service.url, timeout=BUSY_TIMEOUT) as client,
    ):
        yield client


def body(size: int) -> bytes:
    return b"{}".ljust(size)


@pytest.mark.parametrize(("size", "status"), [(BODY_BYTES_MAX, 200), (BODY_BYTES_MAX + 1, 413)])
@pytest.mark.parametrize("chunked", [False, True], ids=["stated_length", "chunked"])
def test_a_body_may_have_as_many_bytes_as_the_limit(small: httpx.Client, size: int, status: int, chunked: bool) -> None:
    content = iter([body(size)[:600], body(size)[600:]]) if chunked else body(size)
    answer = small.post("/trajectory", content=content, headers={"Content-Type": "application/json"})
    assert answer.status_code == status
    if status == 413:
        assert answer.headers["content-type"] == "application/problem+json"
        assert answer.json()["errors"][0]["pointer"] == ""
        assert f"at most {BODY_BYTES_MAX} bytes" in answer.json()["detail"]


def test_an_endless_body_is_cut_off(small: httpx.Client) -> None:
    sent = 0

    def endless() -> Iterator[bytes]:
        nonlocal sent
        while sent < 100_000_000:
            sent += 10_000
            yield b" " * 10_000

    headers = {"Content-Type": "application/json"}
    # The server answers and closes while the client still sends; the client may see either first.
    with contextlib.suppress(httpx.WriteError, httpx.RemoteProtocolError, httpx.ReadError):
        assert small.post("/trajectory", content=endless(), headers=headers).status_code == 413
    assert sent < 100_000_000
    assert small.get("/healthz").status_code == 200


@pytest.mark.parametrize(("benches", "status"), [(300, 200), (301, 422)])
def test_a_dragon_may_have_as_many_benches_as_the_limit(small: httpx.Client, benches: int, status: int) -> None:
    answer = small.post("/trajectory", json={"dragon": {"benches": benches}, "times": [0]})
    assert answer.status_code == status
    assert status == 200 or "at most 300" in answer.json()["detail"]


@pytest.mark.parametrize(("instants", "status"), [(1000, 200), (1001, 422)])
def test_a_table_may_have_as_many_cells_as_the_limit(small: httpx.Client, instants: int, status: int) -> None:
    times = {"stop": (instants - 1) * 0.1, "step": 0.1}
    answer = small.post("/trajectory", json={"dragon": {"benches": 199}, "times": times})
    assert answer.status_code == status
    assert status == 422 or len(answer.json()["time"]) == instants


def test_answers_may_be_kept_as_long_as_the_setting_says(small: httpx.Client) -> None:
    answer = small.post("/trajectory", json={"times": [0]})
    assert answer.headers["cache-control"] == "public, max-age=60"


def test_one_computation_too_many_is_asked_to_come_again(small: httpx.Client) -> None:
    with ThreadPoolExecutor(1) as pool:
        slow = pool.submit(small.post, "/trajectory", json=SLOW, headers={"Accept": XLSX_TYPE})
        end = time.monotonic() + BUSY_TIMEOUT
        while 'bench_dragon_computations{lane="workbook"} 1.0' not in small.get("/metrics").text:
            assert time.monotonic() < end
            assert not slow.done()
        refused = small.post("/trajectory", json=SLOW, headers={"Accept": XLSX_TYPE})
        cheap = small.post("/trajectory", json={"times": [0]})
        alive = small.get("/healthz")
        assert slow.result().status_code == 200
    assert refused.status_code == 503
    assert refused.headers["content-type"] == "application/problem+json"
    assert int(refused.headers["retry-after"]) >= 7
    assert cheap.status_code == 200
    assert alive.status_code == 200
    assert small.post("/trajectory", json={"times": [0]}).status_code == 200


def test_an_empty_variable_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("BENCH_DRAGON_DATA", "BENCH_DRAGON_JOBS_MAX"):
        monkeypatch.setenv(name, "")
    assert (Settings().data, Settings().jobs_max) == (None, 1000)


def test_a_misspelt_variable_is_named_with_what_was_meant(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("BENCH_DRAGON_JOB_MAX", "BENCH_DRAGON_SERVICE_HOST", "BENCH_DRAGON_TOKEN"):
        monkeypatch.setenv(name, "1")
    text = "The environment variable {} is not a setting and has no effect"
    meant = text.format("BENCH_DRAGON_JOB_MAX") + "; did you mean BENCH_DRAGON_JOBS_MAX?"
    assert unknown_variables() == [meant, text.format("BENCH_DRAGON_SERVICE_HOST")]


@pytest.mark.parametrize("name", ["dance.example:8000", "http://dance.example", "a,,b", "*", "a b"])
def test_a_host_is_a_name_without_a_port(name: str) -> None:
    with pytest.raises(InvalidValue, match="BENCH_DRAGON_HOSTS must be names of hosts without ports"):
        Settings(hosts=name)

"""Limits of the work: body bytes, also streamed, sizes from the environment, and simultaneous computations."""

import contextlib

import httpx
import pytest

from app.settings import Settings, unknown_variables
from app.wire.question import JSON
from core import InvalidValue
from tests.support.asking import Asking, assert_problem

BODY_BYTES_MAX = 1000
LIMITS = {
    "body_bytes_max": BODY_BYTES_MAX,
    "benches_max": 300,
    "cells_max": 200000,
    "cache_seconds": 60,
}
TYPE = {"Content-Type": JSON}


@pytest.fixture(scope="module")
def small(service_with):
    """The calls of a real server with small limits."""
    with httpx.Client(base_url=service_with(**LIMITS).url, timeout=60.0) as client:
        yield Asking(client)


@pytest.mark.parametrize("size, status", [(BODY_BYTES_MAX, 200), (BODY_BYTES_MAX + 1, 413)])
@pytest.mark.parametrize("chunked", [False, True], ids=["stated_length", "chunked"])
def test_a_body_may_have_as_many_bytes_as_the_limit(small, size, status, chunked):
    body = b"{}".ljust(size)
    answer = small.client.post("/trajectory", content=iter([body[:600], body[600:]]) if chunked else body, headers=TYPE)
    assert answer.status_code == status
    if status == 413:
        assert_problem(answer, 413, f" most {BODY_BYTES_MAX} bytes")


def test_an_endless_body_is_cut_off(small):
    sent = 0

    def endless():
        nonlocal sent
        while sent < 100_000_000:
            sent += 10_000
            yield b" " * 10_000

    # The server answers and closes while the client still sends; the client may see either first.
    with contextlib.suppress(httpx.WriteError, httpx.RemoteProtocolError, httpx.ReadError):
        assert small.client.post("/trajectory", content=endless(), headers=TYPE).status_code == 413
    assert sent < 100_000_000
    assert small.send("healthz").status_code == 200


def test_a_table_may_have_as_many_cells_as_the_limit(small):
    body = {"dragon": {"benches": 199}}
    whole = {"stop": 99.9, "step": 0.1}
    more = {"stop": 100, "step": 0.1}
    assert len(small("trajectory", body | {"times": whole})["time"]) == 1000
    small.refuses("/times/step", "trajectory", body | {"times": more})


def test_answers_may_be_kept_as_long_as_the_setting_says(small):
    assert small.send("trajectory", {"times": [0]}).headers["cache-control"] == "public, max-age=60"


def test_an_empty_variable_is_none(monkeypatch):
    for name in ("BENCH_DRAGON_DATA", "BENCH_DRAGON_JOBS_MAX"):
        monkeypatch.setenv(name, "")
    assert Settings().data is None
    assert Settings().jobs_max == 1000


def test_a_misspelt_variable_is_named_with_what_was_meant(monkeypatch):
    for name in ("BENCH_DRAGON_JOB_MAX", "BENCH_DRAGON_SERVICE_HOST", "BENCH_DRAGON_TOKEN"):
        monkeypatch.setenv(name, "1")
    text = "The environment variable {} is not a setting and has no effect"
    meant = text.format("BENCH_DRAGON_JOB_MAX") + "; did you mean BENCH_DRAGON_JOBS_MAX?"
    assert unknown_variables() == [meant, text.format("BENCH_DRAGON_SERVICE_HOST")]


@pytest.mark.parametrize("name", ["dance.example:8000", "http://dance.example", "a,,b", "*", "a b"])
def test_a_host_is_a_name_without_a_port(name):
    with pytest.raises(InvalidValue, match="BENCH_DRAGON_HOSTS must be names of hosts without ports"):
        Settings(hosts=name)

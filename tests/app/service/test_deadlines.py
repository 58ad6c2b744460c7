"""A computation ends at its deadline, and when its client is gone; as a job it continues."""

from __future__ import annotations

import http.client
import json
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.support.serving import serving

# Minutes of work.
HEAVY = {"benches": 6308, "head_length": 0.001, "body_length": 0.001, "overhang": 0}
HEAVY_BODY = {"dragon": HEAVY}
# At this pitch two benches graze to 1e-10 m, which takes exact decimals.
GRAZE = {"pitch": 0.45033739302602777}
# More than a small body: the service reads it in a thread of its own.
LONG_BODY = {
    "dragon": {
        "lengths": [2.2 + 0.001 * (k % 97) for k in range(2000)],
        "widths": [0.3] * 2000,
        "overhangs": [0.275123456] * 2000,
    },
    "path": {"kind": "turn"},
}
# Its plan takes a second to compute, and a minute to draw.
LONG_PLAN = {
    "dragon": {"benches": 2000},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [8000, 0]}], "start": 4000},
    "stop": 100,
}
# It takes a fifth of a second to compute, and many to draw.
DRAWN_PLAN = LONG_PLAN | {"dragon": {"benches": 1000}}
SHORT_DEADLINE = 0.1  # [s]
# The longest that anything may take here [s], where an answer alone would take minutes.
SOON = 10.0


@pytest.fixture(scope="module")
def hurried(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("hurried")
    with serving(folder / "server.log", deadline_seconds=SHORT_DEADLINE, data=folder / "data") as service:
        yield service.url


def sample(url: str, name: str) -> float:
    """Value of one line of /metrics; 0 where it is not there yet."""
    lines = httpx.get(f"{url}/metrics").text.splitlines()
    return next((float(line.rpartition(" ")[2]) for line in lines if line.startswith(f"{name} ")), 0.0)


def soon(holds: Callable[[], bool]) -> bool:
    until = time.monotonic() + SOON
    while not holds():
        if time.monotonic() > until:
            return False
        time.sleep(0.05)
    return True


@pytest.mark.parametrize(
    "query",
    [
        {"method": "GET", "url": "/minimum-pitch", "params": HEAVY},
        {"method": "POST", "url": "/minimum-pitch", "json": HEAVY_BODY},
        {"method": "POST", "url": "/check", "json": LONG_BODY},
        {"method": "GET", "url": "/pitch-scan", "params": {"samples": 401}},
        {"method": "GET", "url": "/figures/pitch-scan.svg", "params": {"samples": 401}},
        {"method": "POST", "url": "/plan", "json": LONG_PLAN},
    ],
    ids=["query", "body", "long-body", "scan", "figure", "plan"],
)
def test_the_answer_at_the_deadline_says_what_was_too_much_and_offers_a_job(
    hurried: str, query: dict[str, Any]
) -> None:
    with httpx.Client(base_url=hurried, timeout=SOON) as client:
        answer = client.request(**query)
    assert answer.status_code == 422
    response = answer.json()
    assert response["type"] == "urn:problem-type:bench-dragon:too-much-work"
    assert f"within {SHORT_DEADLINE:g} s, the time that one answer may take here" in response["detail"]
    assert ". Ask for it as a job, which may take longer: POST /jobs" in response["detail"]
    assert "Prefer: respond-async" in response["detail"]
    assert response["errors"][0].get("name") or response["errors"][0]["pointer"]
    assert sample(hurried, 'bench_dragon_computations{lane="heavy"}') == 0.0


def test_as_a_job_the_same_request_is_answered(hurried: str) -> None:
    with httpx.Client(base_url=hurried, timeout=SOON) as client:
        request = client.build_request("GET", "/pitch-scan", params={"samples": 401})
        assert client.send(request).json()["type"].endswith("too-much-work")
        request.headers["Prefer"] = "respond-async"
        job = client.send(request).headers["Location"]
        wait = time.monotonic() + 60.0
        while (state := client.get(job).json())["status"] in ("accepted", "running"):
            assert time.monotonic() < wait
            time.sleep(0.1)
        assert state["status"] == "successful"
        scan = client.get(f"{job}/result").json()
        assert len(scan["pitch"]) == 401
        assert scan["jumps"]


@pytest.mark.parametrize(
    "query",
    [
        {"method": "GET", "url": "/minimum-pitch", "params": HEAVY},
        {"method": "POST", "url": "/minimum-pitch", "json": HEAVY_BODY},
        {"method": "POST", "url": "/check", "json": LONG_BODY},
    ],
    ids=["query", "body", "long-body"],
)
def test_a_computation_ends_when_its_client_is_gone(patient: str, query: dict[str, Any]) -> None:
    running, gone = 'bench_dragon_computations{lane="heavy"}', 'bench_dragon_stopped_total{reason="client gone"}'
    before = sample(patient, gone)
    request = httpx.Request(query["method"], patient + query["url"], params=query.get("params"), json=query.get("json"))
    connection = http.client.HTTPConnection(request.url.netloc.decode())
    with closing(connection):
        target = request.url.raw_path.decode()
        connection.request(request.method, target, request.content or None, dict(request.headers))
        assert soon(lambda: sample(patient, running) == 1.0)
    assert soon(lambda: sample(patient, gone) == before + 1.0)
    assert soon(lambda: sample(patient, running) == 0.0)


def test_a_client_that_waits_is_answered(patient: str) -> None:
    """The watch ends no computation of a client that is there, also of one that has asked before."""
    with httpx.Client(base_url=patient, timeout=SOON) as client:
        times = {client.get("/collision-time", params={"benches": benches}).json()["time"] for benches in (40, 60, 223)}
        body = json.dumps({"times": {"stop": 3}}).encode()
        assert client.post("/trajectory", content=body, headers={"Content-Type": "application/json"}).status_code == 200
    assert None not in times


def test_what_takes_longer_than_expected_is_answered_all_the_same(patient: str) -> None:
    """The event loop gives up, and a thread answers to the last digit."""
    with httpx.Client(base_url=patient, timeout=SOON) as client:
        request = client.get("/collision-time", params=GRAZE | {"cross_check": "none"}).raise_for_status().json()
        answer = client.post("/collision-time", json={"path": {"kind": "spiral"} | GRAZE, "cross_check": "none"})
    assert request == answer.raise_for_status().json()


def test_the_deadline_ends_a_plan_that_is_being_drawn(tmp_path: Path) -> None:
    with serving(tmp_path / "server.log", deadline_seconds=2.0) as service:
        answer = httpx.post(f"{service.url}/plan", json=DRAWN_PLAN, timeout=30.0)
    assert answer.status_code == 422
    assert "the plan was not drawn within 2 s" in answer.json()["detail"]

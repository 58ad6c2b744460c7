"""A computation ends at its deadline, and when its client is gone; as a job it continues."""

import http.client
from contextlib import closing

import httpx
import pytest

from tests.support.depth import few
from tests.support.job_service import wait_for
from tests.support.largest import IN_TURN, THIN
from tests.support.serving import sample

# Its plan takes a second to compute, and another one to draw.
LONG_PLAN = {
    "dragon": {"benches": 2000},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [8000, 0]}], "start": 4000},
    "stop": 100,
}
SHORT_DEADLINE = 0.1  # [s]
PATIENCE = 60.0  # [s], where an answer alone would take minutes
SCAN = {"method": "GET", "url": "/pitch-scan", "params": {"samples": 401}}
TOO_MUCH = {
    "query": {"method": "GET", "url": "/minimum-pitch", "params": THIN},
    "long body": {"method": "POST", "url": "/check", "json": IN_TURN},
    "body": {"method": "POST", "url": "/minimum-pitch", "json": {"dragon": THIN}},
    "scan": SCAN,
    "plan": {"method": "POST", "url": "/plan", "json": LONG_PLAN},
}
RUNNING = 'bench_dragon_computations{lane="heavy"}'
GONE = 'bench_dragon_stopped_total{reason="client gone"}'


@pytest.fixture(scope="module")
def hurried(service_with):
    return service_with(deadline_seconds=SHORT_DEADLINE, data=True).url


@pytest.mark.parametrize("name", TOO_MUCH)
def test_the_answer_at_the_deadline_says_what_was_too_much_and_offers_a_job(hurried, name):
    with httpx.Client(base_url=hurried, timeout=PATIENCE) as client:
        answer = client.request(**TOO_MUCH[name])
    assert answer.status_code == 422
    problem = answer.json()
    assert problem["type"].endswith(":too-much-work")
    assert f"within {SHORT_DEADLINE:g} s, the time that one answer may take here" in problem["detail"]
    for words in ("POST /jobs", "Prefer: respond-async"):
        assert words in problem["detail"]
    assert problem["errors"][0].get("name") or problem["errors"][0]["pointer"]
    assert sample(hurried, RUNNING) == 0.0


@pytest.mark.thorough
def test_as_a_job_the_same_request_is_answered(hurried):
    with httpx.Client(base_url=hurried, timeout=PATIENCE) as client:
        job = client.request(**SCAN, headers={"Prefer": "respond-async"}).headers["Location"]
        client.get(f"{job}/events").raise_for_status()  # Its events end when it is finished.
        scan = client.get(f"{job}/result").raise_for_status().json()
    assert len(scan["pitch"]) == 401
    assert scan["jumps"]


@pytest.mark.parametrize("name", few([*TOO_MUCH][:3], 2))
def test_a_computation_ends_when_its_client_is_gone(patient, name):
    before = sample(patient, GONE)
    request = httpx.Client(base_url=patient).build_request(**TOO_MUCH[name])
    with closing(http.client.HTTPConnection(request.url.netloc.decode())) as connection:
        connection.request(request.method, request.url.raw_path.decode(), request.read(), dict(request.headers))
        wait_for(lambda: sample(patient, RUNNING) == 1.0)
    wait_for(lambda: (sample(patient, GONE), sample(patient, RUNNING)) == (before + 1.0, 0.0))

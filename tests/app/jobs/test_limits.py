"""Limits of the jobs of a service: each is refused with its status, and they hold together."""

import os
import re
import shutil

import pytest

from app.jobs.room import DAY, FRESH
from app.wire.problem import PROBLEM_TYPE
from app.wire.question import BYTES
from tests.support.job_service import ENDLESS, LONG, SHORT, JobService, wait_for

TOKEN = "correct horse"
RESULT_BYTES_MAX = 5_000
AGE = 2.0  # [s] that a finished job is kept


@pytest.fixture(scope="module")
def strict(tmp_path_factory):
    """A service with small limits, and a token that its client has."""
    limits = {"jobs_client_max": 2, "jobs_max": 4, "jobs_running_max": 1, "jobs_listeners_max": 1}
    limits["job_result_bytes_max"] = RESULT_BYTES_MAX
    with JobService(tmp_path_factory.mktemp("strict"), token=TOKEN, **limits) as service:
        yield service


def test_without_the_token_no_job_is_made_and_none_is_listed_and_no_file_taken(strict):
    later = {"Prefer": "respond-async"}
    typed = {"Content-Type": "application/json"}
    file = {"Content-Type": BYTES}
    for method, call, body, headers in (
        ("POST", "/jobs", b'{"question": "turn"}', typed),
        ("POST", "/sweeps", b'{"question": "turn", "over": {"pitch": [1.7]}}', typed),
        ("GET", "/jobs", None, {}),
        ("GET", "/collision-time", None, later),
        ("POST", "/grade?name=result1.csv", b"1,2", file),
        ("POST", "/places", b"{}", file),
    ):
        for stranger in ("", "Bearer wrong", TOKEN):
            answer = strict.client.request(method, call, content=body, headers=headers | {"Authorization": stranger})
            assert (answer.status_code, answer.headers["www-authenticate"][:6]) == (401, "Bearer"), call
        if headers == file:
            assert strict.client.post(call, content=body, headers=headers).status_code in (200, 422)
    # Questions, and answers that are typed and no file, need none.
    for method, call in (("GET", "/collision-time"), ("POST", "/grade?pitch=0.45")):
        assert strict.client.request(method, call, headers={"Authorization": ""}).status_code == 200


def test_who_has_the_token_sees_all_jobs_and_who_has_an_address_sees_that_job(strict):
    address = strict.done(SHORT)
    [job] = strict.client.get("/jobs").json()["jobs"]
    assert f"/jobs/{job['jobID']}" == job["links"][0]["href"] == address
    assert strict.client.get(address, headers={"Authorization": ""}).status_code == 200
    # Other users of the machine see nothing.
    for name in ("jobs.sqlite", "results"):
        assert os.stat(strict.folder / name).st_mode & 0o077 == 0
    numbers = dict(re.findall(r"^bench_dragon_jobs_(\w+) (\S+)$", strict.client.get("/metrics").text, re.MULTILINE))
    expected = {"kept": 1, "kept_limit": 4, "kept_of_client": 1, "bytes_limit": 1e10, "gave_way_total": 0}
    assert {name: float(numbers[name]) for name in expected} == expected
    assert float(numbers["bytes"]) > 0
    strict.remove(address)


def test_a_client_has_only_so_many_unfinished_jobs(strict):
    small = {"question": "trajectory", "request": {"dragon": {"benches": 2}, "times": [0]}}
    addresses = [strict.done(small), strict.post(ENDLESS), strict.post(ENDLESS)]
    assert strict.status(addresses[2])["status"] == "accepted"  # one runs at once, the other waits
    with strict.at("127.0.0.2") as other:
        theirs = other.post("/jobs", json=ENDLESS).headers["location"]
        refused = strict.client.post("/jobs", json=SHORT)
        full = other.post("/jobs", json=SHORT)
    assert refused.status_code == 429
    assert full.status_code == 503
    # It is estimated that the first one ends soon; then its result stays for a while.
    assert 0 < int(refused.headers["retry-after"]) <= 5
    assert 0 < int(full.headers["retry-after"]) <= FRESH + 5
    strict.remove(theirs)
    strict.remove(*addresses)


def test_a_result_that_is_too_long_is_not_kept(strict):
    address = strict.post({"question": "trajectory", "request": {"times": [0]}})
    assert strict.finished(address)["status"] == "failed"
    answer = strict.result(address)
    assert answer.status_code == 413
    assert str(RESULT_BYTES_MAX) in answer.text
    assert list((strict.folder / "results").iterdir()) == []
    strict.remove(address)


def test_only_so_many_clients_may_listen(strict):
    address = strict.post(LONG)
    with strict.client.stream("GET", f"{address}/events") as first:
        lines = first.iter_lines()  # It holds the connection.
        assert next(lines)
        refused = strict.client.get(f"{address}/events")
        assert refused.status_code == 503
        assert int(refused.headers["retry-after"]) > 0
    # The place of a client that is gone is free again.
    wait_for(lambda: strict.client.head(f"{address}/events").status_code in (200, 204))
    strict.remove(address)


@pytest.fixture(scope="module")
def brief(tmp_path_factory):
    """A service whose jobs have little memory and are soon forgotten."""
    limits = {"job_memory_max": 2**31, "job_days_max": AGE / DAY, "jobs_bytes_max": 1_000, "cells_max": 10**9}
    with JobService(tmp_path_factory.mktemp("brief"), **limits) as service:
        yield service


@pytest.mark.thorough
def test_results_expire_and_then_all_that_is_known_of_the_job(brief):
    address = brief.done(SHORT)
    full = brief.client.post("/jobs", json=SHORT)
    assert full.status_code == 507
    assert 1 <= int(full.headers["retry-after"]) <= AGE + 1
    wait_for(lambda: brief.result(address).status_code == 410)
    assert "expired" in brief.result(address).json()["detail"]
    assert list((brief.folder / "results").iterdir()) == []
    wait_for(lambda: brief.client.get(address).status_code == 404)


@pytest.mark.thorough
def test_a_job_that_wants_too_much_memory_fails_in_words(brief):
    address = brief.post({"question": "trajectory", "request": {"times": {"stop": 400, "step": 1e-4}}})
    assert brief.finished(address)["status"] == "failed"
    answer = brief.result(address)
    assert answer.status_code == 422
    assert str(2**31) in answer.text


@pytest.mark.thorough
def test_a_job_that_runs_too_long_is_ended(tmp_path):
    wanted = LONG | {"request": {"times": {"stop": 400, "step": 0.1}}}
    with JobService(tmp_path, job_seconds_max=1, workbook_cells_max=10**7) as service:
        status = service.finished(service.post(wanted))
        assert status["status"] == "failed"
        assert "took longer than 1 s" in status["message"]
        wait_for(lambda: not service.of("child"))


def assert_has_no_store(service):
    refused = service.client.post("/jobs", json=SHORT)
    assert refused.status_code == 503
    assert str(service.folder) not in refused.text


def test_a_data_folder_that_cannot_be_used_costs_the_jobs_alone(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    with JobService(blocked) as service:
        assert_has_no_store(service)
        assert service.client.get("/collision-time").status_code == 200
        assert service.client.get("/readyz").status_code == 503


def damage(folder):
    with (folder / "jobs.sqlite").open("r+b") as file:
        file.write(b"no database" * 1000)
    for rest in ("jobs.sqlite-wal", "jobs.sqlite-shm"):
        (folder / rest).unlink(missing_ok=True)


@pytest.mark.thorough
@pytest.mark.parametrize("harm", [shutil.rmtree, damage])
def test_a_store_that_fails_while_the_service_runs_promises_nothing(tmp_path, harm):
    folder = tmp_path / "data"
    fault = "and is tried again each second"
    with JobService(folder) as service:
        address = service.done(SHORT)
        harm(folder)

        def statuses(*paths):
            return [service.client.get(path).status_code for path in paths]

        # What SQLite still has in memory is read from a damaged file, and nothing of one that is gone.
        if harm is not damage:
            assert statuses(address, f"{address}/result") == [503, 503]
            assert service.client.delete(address).headers["content-type"] == PROBLEM_TYPE
            assert "bench_dragon_jobs_store_failed 1.0" in service.client.get("/metrics").text
        assert_has_no_store(service)
        assert statuses("/readyz", "/collision-time", "/metrics") == [503, 200, 200]
        # The keeper looks at the store each second, and says what is wrong.
        wait_for(lambda: fault in service.log.read_text("utf-8"))
        log = service.log.read_text("utf-8")
        assert "Traceback" not in log, log[log.find("Traceback") :]

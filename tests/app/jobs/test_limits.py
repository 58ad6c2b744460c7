"""Limits of the jobs of a service: each is refused in plain words, and they hold together."""

from __future__ import annotations

import os
import shutil
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import httpx
import pytest

from app.jobs.room import DAY, FRESH
from app.wire.problem import PROBLEM_TYPE
from tests.support.job_service import ENDLESS, LONG, PATIENCE, SHORT, JobService, wait_for

TOKEN = "correct horse"
BEARER = {"Authorization": f"Bearer {TOKEN}"}
RESULT_BYTES_MAX = 5_000
AGE = 2.0  # [s] that a finished job is kept


@pytest.fixture(scope="module")
def strict(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    """A service with small limits, and a token that its client has."""
    limits = {
        "token": TOKEN,
        "jobs_client_max": 2,
        "jobs_max": 4,
        "jobs_running_max": 1,
        "jobs_listeners_max": 1,
        "job_result_bytes_max": RESULT_BYTES_MAX,
    }
    with JobService(tmp_path_factory.mktemp("strict"), **limits) as service:
        service.client.headers.update(BEARER)
        yield service


def remove(service: JobService, address: str) -> None:
    while service.client.delete(address).status_code == 200:
        pass


@pytest.mark.parametrize("headers", [{}, {"Authorization": "Bearer wrong"}, {"Authorization": TOKEN}], ids=str)
def test_without_the_token_no_job_is_made_and_none_is_listed(strict: JobService, headers: dict[str, str]) -> None:
    own_headers = {"Authorization": "", **headers}
    answers = [
        strict.client.post("/jobs", json=SHORT, headers=own_headers),
        strict.client.get("/jobs", headers=own_headers),
        strict.client.get("/collision-time", headers={**own_headers, "Prefer": "respond-async"}),
        strict.client.post(
            "/grade?name=result1.csv", content=b"1,2", headers={**own_headers, "Content-Type": "text/csv"}
        ),
        strict.client.post(
            "/places", content=b"{}", headers={**own_headers, "Content-Type": "application/octet-stream"}
        ),
    ]
    for answer in answers:
        assert answer.status_code == 401
        assert answer.headers["www-authenticate"].startswith("Bearer")
        assert answer.headers["content-type"] == "application/problem+json"
    # Questions, and answers that are typed and no file, need none.
    assert strict.client.get("/collision-time", headers=own_headers).status_code == 200
    assert strict.client.post("/grade?pitch=0.45", headers=own_headers).status_code == 200


@pytest.mark.parametrize("call", ["/grade?name=result1.csv", "/places"])
def test_who_has_the_token_may_send_a_file(strict: JobService, call: str) -> None:
    headers = {**BEARER, "Content-Type": "application/octet-stream"}
    assert strict.client.post(call, content=b"1,2", headers=headers).status_code in {200, 422}


def test_who_has_the_token_sees_all_jobs_and_who_has_an_address_sees_that_job(strict: JobService) -> None:
    address = strict.post(SHORT)
    listed = strict.client.get("/jobs").json()["jobs"]
    assert [f"/jobs/{job['jobID']}" for job in listed] == [address]
    assert listed[0]["links"][0]["href"] == address
    assert strict.client.get(address, headers={"Authorization": ""}).status_code == 200
    strict.finished(address)
    remove(strict, address)


def test_a_client_has_only_so_many_unfinished_jobs_and_then_what_is_finished_gives_way(strict: JobService) -> None:
    small = {"question": "trajectory", "request": {"dragon": {"benches": 2}, "times": [0]}}
    addresses = [strict.post(small), strict.post(ENDLESS)]
    strict.finished(addresses[0])
    addresses.append(strict.post(ENDLESS))
    refused = strict.client.post("/jobs", json=SHORT)
    assert refused.status_code == 429
    assert "Your limit of 2 unfinished jobs is reached" in refused.json()["detail"]
    assert int(refused.headers["retry-after"]) > 0
    assert strict.status(addresses[2])["status"] == "accepted"  # one runs at once, the other waits
    assert strict.client.delete(addresses[2]).json()["status"] == "dismissed"
    # What is finished gives way, the oldest first, but the latest answer stays for a while.
    addresses.append(strict.post(ENDLESS))
    assert strict.client.delete(addresses[3]).json()["status"] == "dismissed"
    addresses.append(strict.post(ENDLESS))
    gone = strict.client.get(f"{addresses[2]}/result")
    assert (gone.status_code, "gave way to newer jobs" in gone.json()["detail"]) == (410, True)
    assert strict.client.get(f"{addresses[0]}/result").status_code == 200
    for address in addresses:
        remove(strict, address)
    remove(strict, strict.post(small))


def test_a_result_that_is_too_long_is_not_kept(strict: JobService) -> None:
    address = strict.post({"question": "trajectory", "request": {"times": [0]}})
    assert strict.finished(address)["status"] == "failed"
    answer = strict.client.get(f"{address}/result")
    assert answer.status_code == 413
    assert f"the limit for a kept one is {RESULT_BYTES_MAX}" in answer.json()["detail"]
    assert list((strict.folder / "results").iterdir()) == []
    remove(strict, address)


def test_only_so_many_clients_may_listen(strict: JobService) -> None:
    address = strict.post(LONG)
    with strict.client.stream("GET", f"{address}/events") as first:
        lines = first.iter_lines()
        assert next(lines)
        refused = strict.client.get(f"{address}/events")
        assert refused.status_code == 503
        assert int(refused.headers["retry-after"]) > 0
    remove(strict, address)
    other = strict.post(SHORT)
    # The place of a client that is gone is free again.
    wait_for(lambda: strict.client.get(f"{other}/events").status_code in (200, 204), 10.0)
    remove(strict, other)


@pytest.fixture(scope="module")
def brief(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    """A service whose jobs have little memory and are soon forgotten."""
    limits = {
        "job_memory_max": 2**31,
        "job_days_max": AGE / DAY,
        "jobs_bytes_max": 1_000,
        "cells_max": 10**9,
    }
    with JobService(tmp_path_factory.mktemp("brief"), **limits) as service:
        yield service


def test_results_expire_and_then_all_that_is_known_of_the_job(brief: JobService) -> None:
    address = brief.post(SHORT)
    assert brief.finished(address)["status"] == "successful"
    assert brief.client.get(f"{address}/result").status_code == 200
    full = brief.client.post("/jobs", json=SHORT)
    assert full.status_code == 507
    assert "all the room that they may have" in full.json()["detail"]
    assert 1 <= int(full.headers["retry-after"]) <= AGE + 1
    wait_for(lambda: brief.client.get(f"{address}/result").status_code == 410, 20 * AGE)
    assert "expired" in brief.client.get(f"{address}/result").json()["detail"]
    assert list((brief.folder / "results").iterdir()) == []
    wait_for(lambda: brief.client.get(address).status_code == 404, 20 * AGE)


def at(service: JobService, address: str) -> httpx.Client:
    """A client of the service at another address of this machine."""
    transport = httpx.HTTPTransport(local_address=address)
    return httpx.Client(base_url=f"http://127.0.0.1:{service.port}", transport=transport, timeout=PATIENCE)


def test_one_client_with_eight_long_jobs_keeps_nobody_waiting(tmp_path: Path) -> None:
    """With the default settings, and beside it how full the store is."""
    with JobService(tmp_path) as service, at(service, "127.0.0.2") as other:
        long = [service.post(ENDLESS) for _ in range(8)]
        wait_for(lambda: [service.status(one)["status"] for one in long].count("running") == 2)
        address = other.post("/jobs", json=SHORT).headers["location"]
        wait_for(lambda: other.get(f"{address}/result").status_code == 200, 10.0)
        assert [service.status(one)["status"] for one in long].count("running") == 2
        metrics = other.get("/metrics").text.splitlines()
        full = {line.split()[0]: float(line.split()[1]) for line in metrics if "_jobs_" in line and line[0] != "#"}
        assert full["bench_dragon_jobs_kept"] == 9
        assert full["bench_dragon_jobs_kept_limit"] == 1000
        assert full["bench_dragon_jobs_kept_of_client"] == 8
        assert full["bench_dragon_jobs_bytes"] > 0
        assert full["bench_dragon_jobs_bytes_limit"] == 1e10
        assert full["bench_dragon_jobs_gave_way_total"] == 0


def test_a_service_with_one_place_runs_the_jobs_of_each_client_in_turn(tmp_path: Path) -> None:
    with JobService(tmp_path, jobs_running_max=1) as service, at(service, "127.0.0.2") as other:
        first = service.post(ENDLESS)
        service.until(first, "running")
        samples = service.post({"question": "contact_probability", "request": {"samples": 100_000}})
        mine, theirs = service.post(SHORT), other.post("/jobs", json=SHORT).headers["location"]
        long = service.post(ENDLESS)
        service.client.delete(first)
        assert service.finished(theirs)["status"] == service.finished(mine)["status"] == "successful"
        assert service.status(theirs)["started"] < service.status(mine)["started"]
        service.until(long, "running")
        assert service.status(samples)["status"] == "accepted"  # By its estimate it takes longest.


def test_a_client_that_fills_the_store_closes_it_for_nobody(tmp_path: Path) -> None:
    limits = {"jobs_max": 12, "jobs_client_kept_max": 8, "jobs_client_max": 100}
    with (
        JobService(tmp_path, **limits) as service,
        at(service, "127.0.0.2") as other,
        at(service, "127.0.0.3") as third,
    ):
        theirs = other.post("/jobs", json=SHORT).headers["location"]
        wait_for(lambda: other.get(f"{theirs}/result").status_code == 200)
        greedy = []
        for _ in range(20):
            greedy.append(service.post(SHORT))
            service.finished(greedy[-1])
        last = [third.post("/jobs", json=SHORT) for _ in range(5)]
        assert {answer.status_code for answer in last} == {202}
        assert other.get(f"{theirs}/result").status_code == 200
        assert service.client.get(f"{greedy[-1]}/result").status_code == 200
        assert service.client.get(f"{greedy[11]}/result").status_code == 410
        assert "gave way" in service.status(greedy[11])["message"]
        assert len(list((tmp_path / "results").iterdir())) <= 12
        assert "bench_dragon_jobs_gave_way_total" in third.get("/metrics").text


def test_where_nothing_may_give_way_the_wait_is_known(tmp_path: Path) -> None:
    with JobService(tmp_path, jobs_max=2, jobs_client_max=2) as service, at(service, "127.0.0.2") as other:
        for _ in range(2):
            service.post(ENDLESS)
        own = service.client.post("/jobs", json=SHORT)
        full = other.post("/jobs", json=SHORT)
        assert (own.status_code, full.status_code) == (429, 503)
        assert "The limit of 2 kept jobs is reached: none gives way to yours yet" in full.json()["detail"]
        # It is estimated that the first one ends soon; then its result stays for a while.
        assert int(own.headers["retry-after"]) <= 5
        assert FRESH <= int(full.headers["retry-after"]) <= FRESH + 5


def test_a_job_that_wants_too_much_memory_fails_in_words(brief: JobService) -> None:
    wanted = {"question": "trajectory", "request": {"times": {"stop": 400, "step": 1e-4}}}
    address = brief.post(wanted)
    assert brief.finished(address)["status"] == "failed"
    answer = brief.client.get(f"{address}/result")
    assert answer.status_code == 422
    assert f"more memory than {2**31} bytes" in answer.json()["detail"]


def test_a_job_that_runs_too_long_is_ended(tmp_path: Path) -> None:
    wanted = LONG | {"request": {"times": {"stop": 400, "step": 0.1}}}
    with JobService(tmp_path, job_seconds_max=1, workbook_cells_max=10**7) as service:
        status = service.finished(service.post(wanted))
        assert status["status"] == "failed"
        assert "took longer than 1 s" in status["message"]
        wait_for(lambda: not service.of("child"), 5.0)


def test_a_data_folder_that_cannot_be_used_costs_the_jobs_alone(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    with JobService(blocked) as service:
        refused = service.client.post("/jobs", json=SHORT)
        assert refused.status_code == 503
        assert "data folder cannot be used" in refused.json()["detail"]
        assert service.client.get("/collision-time").status_code == 200

        assert str(tmp_path) not in refused.text
        assert service.client.get("/readyz").status_code == 503


def removed(folder: Path) -> None:
    shutil.rmtree(folder)


def damaged(folder: Path) -> None:
    with (folder / "jobs.sqlite").open("r+b") as file:
        file.write(b"no database" * 1000)
    for rest in ("jobs.sqlite-wal", "jobs.sqlite-shm"):
        (folder / rest).unlink(missing_ok=True)


@pytest.mark.parametrize("harm", [removed, damaged])
def test_a_store_that_fails_while_the_service_runs_promises_nothing(
    tmp_path: Path, harm: Callable[[Path], None]
) -> None:
    folder = tmp_path / "data"
    with JobService(folder) as service:
        address = service.post(SHORT)
        assert service.finished(address)["status"] == "successful"
        assert service.client.get("/readyz").status_code == 200
        assert "bench_dragon_jobs_store_failed 0.0" in service.client.get("/metrics").text
        harm(folder)
        # What SQLite still has in memory is read from a damaged file, and nothing of one that is gone.
        for method, path in (("GET", address), ("GET", f"{address}/result"), ("DELETE", address)):
            if harm is removed:
                answer = service.client.request(method, path)
                assert (answer.status_code, answer.headers["content-type"]) == (503, PROBLEM_TYPE), answer.text
        metrics = service.client.get("/metrics").raise_for_status().text
        assert "bench_dragon_requests_total" in metrics
        assert harm is damaged or "bench_dragon_jobs_store_failed 1.0" in metrics
        refused = service.client.post("/jobs", json=SHORT)
        assert refused.status_code == 503, refused.text
        assert str(tmp_path) not in refused.text
        ready = service.client.get("/readyz")
        assert ready.status_code == 503
        assert "The store of the jobs failed" in ready.json()["detail"]
        assert service.client.get("/collision-time").status_code == 200
        # The keeper looks at the store each second, and says once what is wrong.
        wait_for(lambda: "and is tried again each second" in service.log.read_text(encoding="utf-8"))
        time.sleep(3.0)  # time to say it again
        log = service.log.read_text(encoding="utf-8")
        assert "Traceback" not in log, log[log.find("Traceback") :]
        faults = Counter(line for line in log.splitlines() if "and is tried again each second" in line)
        assert faults
        assert max(faults.values()) <= 2  # of the keeper and of the runner


def test_other_users_of_the_machine_cannot_read_the_data_folder(strict: JobService) -> None:
    assert (os.stat(strict.folder / "jobs.sqlite").st_mode & 0o077) == 0
    assert (os.stat(strict.folder / "results").st_mode & 0o077) == 0

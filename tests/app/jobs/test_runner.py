"""Jobs outlive the death of any process that has to do with them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.app.jobs.kills import survive
from tests.app.jobs.service import LINGER, SCAN, SHORT, Service, direct, wait_for

KILLS, SEED = 5, 1


def test_processes_may_be_killed_at_any_moment(tmp_path: Path) -> None:
    assert sum(survive(tmp_path / "data", KILLS, SEED).values()) == KILLS


@pytest.mark.parametrize("role", ["child", "runner", "worker"])
def test_a_job_goes_on_when_a_process_is_killed(tmp_path: Path, role: str) -> None:
    with Service(tmp_path, workers=2) as service:
        address = service.post(SCAN)
        service.until(address, "running")
        wait_for(lambda: service.of("child"))
        for process in service.of(role):
            process.kill()
        assert service.finished(address)["status"] == "successful"
        assert service.client.get(f"{address}/result").content == direct(service.client, SCAN).content


def test_jobs_are_there_when_a_killed_service_is_started_again(tmp_path: Path) -> None:
    with Service(tmp_path, workers=2) as service:
        done = service.post(SHORT)
        service.finished(done)
        result = service.client.get(f"{done}/result").content
        begun, waits = service.post(SCAN), service.post(SHORT)
        service.until(begun, "running")
        service.process.kill()
        service.process.wait()
        # Runner, children and processes that serve follow the parent.
        wait_for(lambda: not service.processes(), LINGER)
        service.start()
        assert service.status(done)["status"] == "successful"
        assert service.client.get(f"{done}/result").content == result
        assert service.finished(waits)["status"] == "successful"
        assert service.finished(begun)["status"] == "successful"
        assert service.client.get(f"{begun}/result").content == direct(service.client, SCAN).content


def test_a_job_that_ends_its_process_three_times_has_failed(tmp_path: Path) -> None:
    with Service(tmp_path) as service:
        address, other = service.post(SCAN), ""
        for _ in range(3):
            wait_for(lambda: service.of("child"))
            for process in service.of("child"):
                process.kill()
                wait_for(lambda dead=process: dead not in service.processes())
        status = service.finished(address)
        assert status["status"] == "failed"
        assert "signal 9" in status["message"]
        assert service.client.get(f"{address}/result").status_code == 500
        other = service.post(SHORT)
        assert service.finished(other)["status"] == "successful"


def test_two_services_with_one_folder_have_one_runner(tmp_path: Path) -> None:
    with Service(tmp_path) as one, Service(tmp_path) as two:
        addresses = [one.post(SHORT), two.post(SHORT | {"request": {"pitch": 0.51}})]
        for address in addresses:
            assert two.finished(address)["status"] == "successful"
        assert len(one.of("runner") + two.of("runner")) == 1
        one.process.kill()
        one.process.wait()
        assert two.finished(two.post(SHORT))["status"] == "successful"
        assert len(two.of("runner")) == 1

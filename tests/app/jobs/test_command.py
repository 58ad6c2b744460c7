"""bench-dragon jobs, with a data folder and with a service."""

from __future__ import annotations

import json
import socketserver
import subprocess
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from datetime import datetime
from pathlib import Path

import pytest

from app.jobs.places import OfService
from core import BenchDragonError
from tests.support import command
from tests.support.job_service import ENDLESS, SHORT, JobService, direct, wait_for

TOKEN = "correct horse"


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    with JobService(tmp_path_factory.mktemp("jobs"), token=TOKEN) as service:
        service.client.headers["Authorization"] = f"Bearer {TOKEN}"
        yield service


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return command.run("jobs", *arguments)


@pytest.fixture(params=["folder", "service"])
def place(request: pytest.FixtureRequest, service: JobService) -> list[str]:
    if request.param == "folder":
        return ["--data", str(service.folder)]
    return ["--url", f"http://127.0.0.1:{service.port}", "--token", TOKEN]


def test_a_job_is_listed_shown_answered_and_removed(service: JobService, place: list[str], tmp_path: Path) -> None:
    address = service.post(SHORT)
    job = address.rpartition("/")[2]
    service.finished(address)
    listed = run("list", *place).stdout
    assert job in listed
    assert "successful" in listed
    assert json.loads(run("show", job, "--json", *place).stdout)["processID"] == "collision_time"
    output = tmp_path / "answer.json"
    assert run("result", job, "--output", str(output), *place).returncode == 0
    assert output.read_bytes() == direct(service.client, SHORT).content
    assert run("cancel", job, *place).stdout == f"{job}: removed\n"
    gone = run("show", job, *place)
    assert gone.returncode == 2
    assert f"there is no job {job}" in gone.stderr.lower().replace('"', "")


def test_all_jobs_or_the_old_ones_are_cancelled(service: JobService, place: list[str]) -> None:
    def listed() -> dict[str, str]:
        return {job["jobID"]: job["status"] for job in service.client.get("/jobs").json()["jobs"]}

    run("cancel", "--all", *place)
    run("cancel", "--all", *place)
    assert listed() == {}
    old = service.post(SHORT)
    service.finished(old)
    time.sleep(2.0)
    addresses = [service.post(ENDLESS), service.post(SHORT)]
    service.finished(addresses[1])
    kept = [address.rpartition("/")[2] for address in addresses]
    assert run("cancel", "--older-than", "1h", *place).stdout == "0 jobs dismissed, 0 jobs removed\n"
    created = service.status(old)["created"]
    age = time.time() - datetime.fromisoformat(created).timestamp()
    assert run("cancel", "--older-than", f"{age - 1:.3f}s", *place).stdout == "0 jobs dismissed, 1 job removed\n"
    assert sorted(listed()) == sorted(kept)
    assert run("cancel", "--all", *place).stdout == "1 job dismissed, 1 job removed\n"
    assert listed() == {kept[0]: "dismissed"}
    wait_for(lambda: not service.of("child"))
    assert list((service.folder / "results").iterdir()) == []


def test_a_result_goes_to_standard_output(service: JobService) -> None:
    address = service.post(SHORT)
    service.finished(address)
    done = run("result", address.rpartition("/")[2], "--data", str(service.folder))
    assert done.stdout == direct(service.client, SHORT).text


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["list"], "--data or --url must say where the jobs are"),
        (["list", "--data", "/nowhere"], "/nowhere without jobs"),
        (["list", "--data", ".", "--url", "http://127.0.0.1:1"], "give one of the two"),
        (["list", "--url", "http://127.0.0.1:1"], "--url http://127.0.0.1:1 does not answer"),
        (["list", "--url", "http://127.0.0.1:x"], "--url http://127.0.0.1:x does not answer: nonnumeric port: 'x'"),
        (["list", "--url", "ftp://x"], "--url must begin with http:// or https://"),
        (["cancel", "--data", "."], "give one of JOB, --all and --older-than"),
        (["cancel", "a", "--all", "--data", "."], "give one of JOB, --all and --older-than"),
        (["cancel", "--older-than", "7w", "--data", "."], "as in 7d, got 7w"),
        (["cancel", "--older-than", "-7d", "--data", "."], "as in 7d, got -7d"),
    ],
    ids=["nowhere", "no_folder", "both", "nobody", "no_port", "no_http", "no_job", "all_and_one", "weeks", "negative"],
)
def test_what_is_wrong_is_one_line(arguments: list[str], words: str) -> None:
    done = run(*arguments)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (b"HTTP/1.1 200 OK\r\nContent-Length: 13\r\n\r\n<html></html>", "does not answer as Bench Dragon does"),
        (b'HTTP/1.1 200 OK\r\nContent-Length: 13\r\n\r\n{"jobs": [{}]}', "does not answer as Bench Dragon does"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 99\r\n\r\n{", "does not answer: IncompleteRead"),
        (b"HTTP/1.1 520 Odd\r\nContent-Length: 0\r\n\r\n", "520 Odd"),
        (b"SSH-2.0-OpenSSH_9.2\r\n", "does not answer: SSH-2.0-OpenSSH_9.2"),
        (b"", "does not answer: Remote end closed connection without response"),
    ],
    ids=["page", "no_jobs", "broken_off", "odd_status", "no_http", "nothing"],
)
def test_an_address_of_something_else_is_refused_in_one_line(answer: bytes, words: str) -> None:
    class Answering(socketserver.StreamRequestHandler):
        def handle(self) -> None:
            while self.rfile.readline().strip():
                pass
            self.wfile.write(answer)

    with socketserver.TCPServer(("127.0.0.1", 0), Answering) as other, ThreadPoolExecutor() as beside:
        beside.submit(other.handle_request)
        with pytest.raises(BenchDragonError) as refused:
            OfService(f"http://127.0.0.1:{other.server_address[1]}", "").list()
    assert words in refused.value.message
    assert "\n" not in refused.value.message


def test_a_damaged_store_is_refused_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "jobs.sqlite").write_bytes(b"no database" * 1_000)
    done = run("list", "--data", str(tmp_path))
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert f"--data {tmp_path} cannot be used: file is not a database" in done.stderr


def test_a_service_says_what_it_refuses(service: JobService) -> None:
    done = run("list", "--url", f"http://127.0.0.1:{service.port}")
    assert done.returncode == 2
    assert "Jobs and uploads need the token" in done.stderr

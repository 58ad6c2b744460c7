"""bench-dragon jobs, with a data folder and with a service."""

import json
import re
import socket
import time
from concurrent.futures import ThreadPoolExecutor
from datetime import datetime

import pytest

from app.jobs.places import OfService
from core import BenchDragonError
from tests.support import command
from tests.support.command import said
from tests.support.job_service import ENDLESS, SHORT, JobService, direct, wait_for

TOKEN = "correct horse"
# What each wrong line must name.
WRONG = """
list                                            --data or --url
list --data /nowhere                            /nowhere
list --data . --url http://127.0.0.1:1          --url takes the place of --data
list --url http://127.0.0.1:1                   --url http://127.0.0.1:1
list --url http://127.0.0.1:x                   --url http://127.0.0.1:x does not answer: nonnumeric port: 'x'
list --url ftp://x                              --url must begin with http:// or https://
cancel --data .                                 JOB, --all and --older-than
cancel a --all --data .                         JOB, --all and --older-than
cancel --older-than 7w --data .                 got 7w
cancel --older-than -7d --data .                got -7d
"""


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    with JobService(tmp_path_factory.mktemp("jobs"), token=TOKEN) as service:
        yield service


def run(*arguments):
    return command.run("jobs", *arguments)


@pytest.fixture(params=["folder", "service"])
def place(request, service):
    if request.param == "folder":
        return ["--data", str(service.folder)]
    return ["--url", f"http://127.0.0.1:{service.port}", "--token", TOKEN]


def test_a_job_is_listed_shown_answered_and_removed(service, place, tmp_path):
    job = service.done(SHORT).rpartition("/")[2]
    assert re.search(rf"{job}.*successful", run("list", *place).stdout)
    assert json.loads(run("show", job, "--json", *place).stdout)["processID"] == "collision_time"
    answer = direct(service.client, SHORT)
    output = tmp_path / "answer.json"
    said("jobs", "result", job, "--output", str(output), *place, aside=None)
    assert output.read_bytes() == answer.content
    assert run("result", job, *place).stdout == answer.text
    assert run("cancel", job, *place).stdout == f"{job}: removed\n"
    gone = run("show", job, *place)
    assert gone.returncode == 2
    assert job in gone.stderr


@pytest.mark.thorough
def test_all_jobs_or_the_old_ones_are_cancelled(service, place):
    def cancelled(*options):
        """Numbers of jobs dismissed and removed."""
        words = run("cancel", *options, *place).stdout.split()
        assert words[2::3] == ["dismissed,", "removed"]
        return words[0], words[3]

    cancelled("--all")
    cancelled("--all")
    created = datetime.fromisoformat(service.status(service.done(SHORT))["created"]).timestamp()
    wait_for(lambda: time.time() > created + 2.0)
    endless = service.post(ENDLESS)
    service.done(SHORT)
    assert cancelled("--older-than", "1h") == ("0", "0")
    assert cancelled("--older-than", f"{time.time() - created - 1:.3f}s") == ("0", "1")
    assert cancelled("--all") == ("1", "1")
    [job] = service.client.get("/jobs").json()["jobs"]
    assert endless.endswith(job["jobID"])
    assert job["status"] == "dismissed"
    wait_for(lambda: not service.of("child"))


@pytest.mark.parametrize("row", WRONG.strip().splitlines())
def test_what_is_wrong_is_one_line(row):
    line, _, words = row.partition("  ")
    done = run(*line.split())
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert words.strip() in done.stderr


@pytest.mark.parametrize(
    "answer, words",
    [
        (b'HTTP/1.1 200 OK\r\nContent-Length: 13\r\n\r\n{"jobs": [{}]}', "as Bench Dragon does"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 99\r\n\r\n{", "IncompleteRead"),
        (b"HTTP/1.1 520 Odd\r\nContent-Length: 0\r\n\r\n", "520 Odd"),
        (b"SSH-2.0-OpenSSH_9.2\r\n", "SSH-2.0-OpenSSH_9.2"),
        (b"", "Remote end closed connection without response"),
    ],
    ids=["no_jobs", "broken_off", "odd_status", "no_http", "nothing"],
)
def test_an_address_of_something_else_is_refused_in_one_line(answer, words):
    def reply(server):
        peer, _ = server.accept()
        with peer, peer.makefile("rb") as lines:
            while lines.readline().strip():
                pass
            peer.sendall(answer)

    with socket.create_server(("127.0.0.1", 0)) as server, ThreadPoolExecutor() as beside:
        beside.submit(reply, server)
        with pytest.raises(BenchDragonError, match=words) as refused:
            OfService(f"http://127.0.0.1:{server.getsockname()[1]}", "").list()
    assert "\n" not in refused.value.message


def test_a_damaged_store_is_refused_in_one_line(tmp_path):
    (tmp_path / "jobs.sqlite").write_bytes(b"no database" * 1_000)
    done = run("list", "--data", str(tmp_path))
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert f"--data {tmp_path}" in done.stderr


def test_a_service_says_what_it_refuses(service):
    done = run("list", "--url", f"http://127.0.0.1:{service.port}")
    assert done.returncode == 2
    assert "token" in done.stderr

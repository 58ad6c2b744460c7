"""Jobs survive the death of any process of the service."""

import json
import os
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from app.jobs import runner
from app.jobs.store import Store
from app.processes.messages import MessageKind, send
from app.settings import Settings
from tests.campaigns.job_kills import post, survive
from tests.support.job_service import ENDLESS, SCAN, SHORT, JobService, direct, wait_for

KILLS = 4
SEED = 1


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    settings = {"jobs_client_max": 1000, "deadline_seconds": 600}
    with JobService(tmp_path_factory.mktemp("jobs"), workers=2, **settings) as service:
        yield service


def begun(service, wanted=SCAN):
    """Address of a new job that has a process by now."""
    address = service.post(wanted)
    service.until(address, "running")
    wait_for(lambda: service.of("child"))
    return address


def kill(service, role):
    """Kills the processes of this role, of which there is one at least, and returns when they are gone."""
    wait_for(lambda: service.of(role))
    killed = {process.pid for process in service.of(role) if process.kill() is None}
    wait_for(lambda: not killed & {process.pid for process in service.processes()})


def out_of_memory_score(service, role):
    """What Linux adds to the memory of a process when it looks for one to end."""
    (process,) = service.of(role)
    return int(Path(f"/proc/{process.pid}/oom_score_adj").read_text())


def assert_same(service, address, wanted):
    """The job ends with the bytes of the direct call."""
    assert service.finished(address)["status"] == "successful"
    assert service.result(address).content == direct(service.client, wanted).content


def test_a_process_does_one_job_after_another_and_a_job_begins_again_when_its_process_is_killed(tmp_path):
    with JobService(tmp_path) as service:
        spare = []
        for pitch in (0.5, 0.51):
            service.done(SHORT | {"request": {"pitch": pitch}})
            wait_for(lambda: service.of("spare"))
            spare += [process.pid for process in service.of("spare")]
        assert len(spare) == 2 == 1 + len(set(spare))
        unfinished = begun(service, ENDLESS)
        # Without memory the system ends the process of a job before those that answer everyone.
        assert out_of_memory_score(service, "parent") < out_of_memory_score(service, "child")
        kill(service, "child")
        wait_for(lambda: service.of("child"))
        assert service.until(unfinished, "running")["message"] == "Running."


@pytest.mark.deep  # The next one kills each of them once.
def test_processes_may_be_killed_at_any_moment(service):
    assert sum(survive(service, KILLS, SEED, pause=0.5, busy=1).values()) == KILLS


@pytest.mark.thorough
def test_jobs_go_on_when_a_process_or_all_of_the_service_is_killed(service):
    done = service.done(SHORT)  # Its process waits for another job.
    result = service.result(done).content
    kill(service, "spare")
    unfinished = begun(service)
    for role in ("child", "runner"):  # The job begins again.
        kill(service, role)
        wait_for(lambda: service.of("child"))
    kill(service, "worker")
    waits = post(service, SHORT)
    assert service.status(unfinished)["status"] in ("accepted", "running")
    service.start_again()
    assert service.status(done)["status"] == "successful"
    assert service.result(done).content == result
    assert_same(service, waits, SHORT)
    assert_same(service, unfinished, SCAN)


@pytest.mark.thorough
def test_two_services_with_one_folder_have_one_runner(tmp_path):
    with JobService(tmp_path) as one, JobService(tmp_path) as two:
        for address in (one.post(SHORT), two.post(SHORT | {"request": {"pitch": 0.51}})):
            assert two.finished(address)["status"] == "successful"
        assert len(one.of("runner") + two.of("runner")) == 1
        one.process.kill()
        one.process.wait()
        two.done(SHORT)
        assert len(two.of("runner")) == 1


LOGGING = """
import logging, os, sys
from app.jobs import runner, work
runner.follow_parent = lambda: None
def log_and_end(*arguments):
    logging.getLogger("app.jobs").error(module.__name__)
    raise SystemExit
runner.Runner.run = work.do = log_and_end
for module in runner, work:
    if os.fork() == 0:
        module.main()
    os.wait()
"""


def test_the_processes_of_jobs_log_in_the_form_of_the_service(tmp_path):
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    command = [sys.executable, "-c", LOGGING, str(tmp_path)]
    with subprocess.Popen(command, env=os.environ | {"BENCH_DRAGON_LOG_JSON": "true"}, **pipes) as process:
        send(process.stdin, MessageKind.TASK, b"job")
        assert [json.loads(line)["message"] for line in process.stderr] == ["app.jobs.runner", "app.jobs.work"]


def test_a_disk_that_stays_full_is_reported_once(tmp_path, monkeypatch, caplog):
    def step(self):
        raise sqlite3.OperationalError("database or disk is full")

    monkeypatch.setattr(runner.Runner, "step", step)
    monkeypatch.setattr(runner, "IDLE_SECONDS", 0.1)
    monkeypatch.setattr(runner, "RETRY_SECONDS", 0.01)
    with closing(Store(tmp_path)) as store:
        runner.Runner(store, Settings()).run()
    [message] = caplog.messages
    assert message.endswith("database or disk is full")

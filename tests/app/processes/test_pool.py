"""Pools of real processes: tasks, reports, deaths of processes and of their parent, budgets."""

import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import psutil
import pytest

from app.processes.child import ProcessEnded
from app.processes.pool import Pool
from core import Budget
from core.kernels import Halted
from tests.conftest import ROOT
from tests.support.job_service import is_gone, wait_for

MODULE = "tests.support.tasks"


@pytest.fixture(scope="module")
def pool():
    with closing(Pool(MODULE, waiting=2)) as pool:
        yield pool


def answered(pool, task=b"a", budget=None):
    """Process that answered, and the length of the task."""
    pid, length = map(int, pool.answer(task, budget).split())
    return pid, length


def test_tasks_at_the_same_time_have_processes_of_their_own_and_few_wait_afterwards(pool):
    reports = []
    budget = Budget()

    def sleep():
        with pytest.raises(Halted):
            pool.answer(b"sleep", budget, lambda report: reports.append(int(report)))

    with ThreadPoolExecutor() as threads:
        ends = [threads.submit(sleep) for _ in range(3)]
        wait_for(lambda: len(reports) == 3)
        assert len(pool.pids) >= 3
        budget.stop()
    assert [end.result() for end in ends] == [None] * 3
    wait_for(lambda: all(map(is_gone, reports)))  # The children of the processes end with them.
    with ThreadPoolExecutor() as threads:
        assert len(list(threads.map(answered, [pool] * 9))) == 9
    assert len(pool.pids) <= 2


def test_what_a_task_prints_is_no_answer(pool, capfd):
    with closing(Pool(MODULE, waiting=1)) as fresh:  # its standard error is the one that is captured here
        assert answered(fresh, b"print")[1] == 5
    assert capfd.readouterr().err == "straight to the file descriptor\nby Python\n"


def test_a_process_that_is_killed_while_it_waits_or_needed_much_memory_takes_no_other_task(pool):
    for _ in range(3):
        pid, _ = answered(pool)
        os.kill(pid, signal.SIGKILL)
        assert answered(pool)[0] != pid
    pid, _ = answered(pool, b"memory")
    assert is_gone(pid)
    assert answered(pool)[0] != pid


def test_a_pool_that_closes_ends_its_processes_and_starts_none():
    pool = Pool(MODULE, waiting=1)
    reports = []
    with ThreadPoolExecutor() as threads:
        answer = threads.submit(pool.answer, b"sleep", None, reports.append)
        wait_for(lambda: reports)
        [pid] = pool.pids
        pool.close()
        assert is_gone(pid)
        end = answer.exception()
    assert isinstance(end, ProcessEnded)
    assert end.how == "signal 9"
    with pytest.raises(ProcessEnded):
        pool.answer(b"a")
    assert pool.pids == []


PARENT = f"""
from app.processes.pool import Pool
Pool({MODULE!r}, waiting=1).answer(b"sleep", report=lambda report: print(report.decode(), flush=True))
"""


def test_a_process_ends_with_its_parent_even_during_a_task():
    with subprocess.Popen([sys.executable, "-c", PARENT], cwd=ROOT, stdout=subprocess.PIPE, text=True) as parent:
        grandchild = int(parent.stdout.readline())
        [child] = psutil.Process(parent.pid).children()
        parent.kill()
    wait_for(lambda: is_gone(child.pid) and is_gone(grandchild))


def test_a_process_has_a_session_of_its_own_and_none_of_the_counts_of_the_service(pool, monkeypatch):
    monkeypatch.setenv("PROMETHEUS_MULTIPROC_DIR", "/counts")
    with closing(Pool(MODULE, waiting=1, environment={"OWN": "variable"})) as fresh:
        pid, _ = answered(fresh)
        assert os.getsid(pid) == pid
        environment = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
        assert b"OWN=variable" in environment
        assert b"PROMETHEUS_MULTIPROC_DIR=/counts" not in environment

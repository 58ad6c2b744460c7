"""The clock of the machine jumps while jobs wait, run and are kept."""

import sys
import time

import pytest

from app.jobs.clock import STEP, TIMES
from app.jobs.room import DAY
from tests.app.jobs.test_store import PROBLEM, ended, make, run_in, written

MINUTE = 60.0
HOUR = 3600.0


def jump(store, step):
    """A step of the clock, as the store sees it: what it wrote before was written at another time."""
    for name in TIMES:
        run_in(store, f"UPDATE jobs SET {name} = {name} - ?", step)
    run_in(store, "UPDATE turns SET latest = latest - ?", step)
    run_in(store, "UPDATE clock SET ahead = ahead - ?", step)


def times_of(job):
    return [moment for moment in (job.created, job.started, job.finished) if moment]


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux names each start of the machine")
@pytest.mark.parametrize("step", [-1000 * DAY, -HOUR, DAY, 1000 * DAY])
def test_jobs_keep_their_ages_when_the_clock_jumps(store, step):
    kept = ended(store)
    running = make(store)
    waiting = make(store)
    assert store.take() == running
    jump(store, step)
    assert store.has_work(days=0.5)
    store.expire(days=0.5)
    assert store.result(kept).exists()
    store.succeed(running, written(store), "text/plain")
    assert store.take() == waiting
    now = time.time()
    for job in map(store.known, (kept, running, waiting)):
        assert now - MINUTE < job.created <= job.updated <= now
        assert times_of(job) == sorted(times_of(job))


def test_after_a_start_with_an_earlier_clock_no_job_is_from_the_future(store):
    kept = ended(store)
    waiting = make(store)
    jump(store, -1000 * DAY)
    run_in(store, "UPDATE clock SET boot = 'another start of this machine'")
    make(store)
    assert all(max(times_of(store.known(job))) <= time.time() for job in (kept, waiting))
    assert [latest for (latest,) in run_in(store, "SELECT latest FROM turns")] <= [time.time()]
    store.expire(days=0.0)
    assert not store.result(kept).exists()


def test_a_step_too_small_to_be_seen_turns_no_duration_negative(store):
    job = make(store)
    jump(store, -0.9 * STEP)
    assert store.take() == job
    store.fail(job, PROBLEM)
    assert times_of(store.known(job)) == sorted(times_of(store.known(job)))

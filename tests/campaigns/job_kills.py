"""Kills processes of a service at random moments while it works on jobs, and compares what comes out.

python -m tests.campaigns.job_kills KILLS SEED
"""

import random
import sys
import tempfile
import time
from pathlib import Path

import httpx

from app.files.tables import XLSX_TYPE
from app.jobs.job import JobState
from app.jobs.store import Store
from tests.support.job_service import JobService, direct, wait_for

ROLES = ("child", "spare", "runner", "worker", "parent")
# Between two kills, at most [s].
PAUSE = 2.0
# Jobs that are not finished, at least, while there are kills to come.
BUSY = 3
PATIENCE = 120.0  # [s]


def wanted(chance):
    """A call that takes a moment, or up to a second."""
    benches = chance.randrange(20, 80)
    return chance.choice(
        [
            {"question": "collision_time", "request": {"pitch": round(chance.uniform(0.4, 0.6), 3)}},
            {"question": "pitch_scan", "request": {"samples": chance.randrange(50, 200)}},
            {
                "question": "trajectory",
                "request": {"dragon": {"benches": benches}, "times": {"stop": 300, "step": 1.0}},
                "accept": XLSX_TYPE,
            },
        ]
    )


def post(service, request):
    """Address of a new job, also if a process dies during the request."""
    while True:
        try:
            return service.post(request)
        except httpx.TransportError:
            time.sleep(0.1)


def kill_one(service, chance):
    """Kills one process and says what it was; the parent is started again."""
    role = chance.choice(ROLES)
    # A spare process may be a job's by the time it is killed, and a job whose process dies three times has failed.
    if role in ("child", "spare") and any(job.deaths for job in Store(service.folder).all() if not job.is_finished):
        role = "runner"
    result = service.of(role)
    if not result:
        return ""
    chance.choice(result).kill()
    if role == "parent":
        service.start_again()
    return role


def survive(service, kills, seed, pause=PAUSE, busy=BUSY):
    """Kill a number of processes; then all jobs must be done, with the bytes of the direct calls.

    returns: number of processes killed, by role
    """
    chance = random.Random(seed)
    done = dict.fromkeys(ROLES, 0)
    store = Store(service.folder)
    request = {}
    while sum(done.values()) < kills:
        while sum(not job.is_finished for job in store.all()) < busy:
            call = wanted(chance)
            request[post(service, call)] = call
        time.sleep(chance.uniform(0.0, pause))
        if role := kill_one(service, chance):
            done[role] += 1
    wait_for(lambda: all(job.is_finished for job in store.all()), PATIENCE)
    for address, call in request.items():
        status = service.status(address)
        assert status["status"] == "successful", status
        answer = direct(service.client, call)
        assert answer.status_code == httpx.codes.OK, answer.text
        assert service.client.get(f"{address}/result").content == answer.content, call
    kept = {file.name for file in store.results.iterdir()}
    assert kept == {job.id for job in store.all() if job.state is JobState.SUCCESSFUL}
    print(f"{len(request)} jobs, kills: {done}")
    return done


if __name__ == "__main__":
    with (
        tempfile.TemporaryDirectory() as name,
        JobService(
            Path(name) / "data", workers=2, jobs_client_max=1000, jobs_client_kept_max=1000, deadline_seconds=600
        ) as service,
    ):
        survive(service, int(sys.argv[1]), int(sys.argv[2]))

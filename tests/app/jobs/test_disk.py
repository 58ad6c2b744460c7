"""A full disk: every call about jobs says so, no file is incomplete, and freed space is used."""

import subprocess
from contextlib import suppress

import pytest

from tests.support.job_service import ENDLESS, SHORT, JobService, wait_for
from tests.support.serving import environment_of

BENCH = {"y": 0.0, "heading": 0.1, "length": 2.2, "width": 0.3}
# About 5 MB of JSON, which the disk of four megabytes does not hold.
BIG = {"question": "trajectory", "request": {"times": {"stop": 400, "step": 1}}}
# A call of half a megabyte, whose removal would write as much into the log.
LONG = {"question": "overlaps", "request": {"benches": [BENCH | {"x": 5.0 * k} for k in range(6_000)]}}

JOB_SECONDS = 5.0

pytestmark = [pytest.mark.root, pytest.mark.thorough]


@pytest.fixture
def small_disk(tmp_path):
    """A disk of four megabytes, which only root may mount."""
    folder = tmp_path / "disk"
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4000000", "tmpfs", folder], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)


def fill(folder, name="filler"):
    """A file that takes the rest of the disk."""
    file = folder / name
    with file.open("wb", buffering=0) as filler, suppress(OSError):
        while filler.write(b"0" * 4096):
            pass
    return file


def test_a_full_disk_is_reported_and_freed_space_is_used(small_disk):
    with JobService(small_disk / "data") as service:
        first = service.done(SHORT)
        too_big = service.post(BIG)
        assert service.finished(too_big)["status"] == "failed"
        assert service.result(too_big).status_code == 507
        filler = fill(small_disk)
        refused = service.client.post("/jobs", json=SHORT)
        while refused.status_code == 202:  # SQLite has some room of its own.
            refused = service.client.post("/jobs", json=SHORT)
        assert refused.status_code == 507
        assert refused.headers["content-type"] == "application/problem+json"
        assert service.client.get("/collision-time").status_code == service.result(first).status_code == 200
        filler.unlink()
        again = service.done(SHORT)
        assert service.client.delete(too_big).status_code == 204
        assert service.result(again).content == service.result(first).content


def test_on_a_full_disk_every_job_ends_and_can_be_removed_and_readiness_says_it(small_disk):
    with JobService(small_disk / "data") as service:
        made = [service.done(SHORT) for _ in range(12)] + [service.done(LONG)]
        service.stop()
        service.environment |= environment_of({"job_seconds_max": JOB_SECONDS})
        service.start()
        ends_by_itself = service.post(ENDLESS)
        waits = service.post(ENDLESS)
        service.until(ends_by_itself, "running")
        filler = fill(small_disk)
        ready = service.client.get("/readyz")
        assert ready.status_code == 503
        assert "disk" in ready.json()["detail"]
        assert service.finished(ends_by_itself)["status"] == "failed"
        service.stop()
        service.start()
        for address in [*made, ends_by_itself]:
            fill(small_disk, address.rpartition("/")[2])
            answer = service.client.delete(address)
            assert answer.status_code == 204, answer.text
        service.remove(waits)
        assert {service.client.get(address).status_code for address in (*made, ends_by_itself, waits)} == {404}
        for file in (filler, *small_disk.glob("?" * 48)):
            file.unlink()
        wait_for(lambda: service.client.get("/readyz").status_code == 200)
        wait_for(lambda: b'"heading"' not in (small_disk / "data" / "jobs.sqlite").read_bytes())

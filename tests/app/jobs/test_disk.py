"""A full disk: every call about jobs says so, no file is incomplete, and freed space is used."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from tests.support.job_service import ENDLESS, SHORT, JobService

# About 1.3 MB of JSON, which the disk of one megabyte does not hold.
BIG = {"question": "trajectory", "request": {"times": {"stop": 100, "step": 1}}}

pytestmark = [pytest.mark.root, pytest.mark.thorough]


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of one megabyte, which only root may mount."""
    folder = tmp_path / "disk"
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1000000", "tmpfs", folder], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)


def fill(folder: Path, name: str = "filler") -> Path:
    """A file that takes the rest of the disk."""
    file = folder / name
    with file.open("wb", buffering=0) as filler, suppress(OSError):
        while filler.write(b"0" * 4096):
            pass
    return file


def test_a_full_disk_is_reported_and_freed_space_is_used(small_disk: Path) -> None:
    with JobService(small_disk / "data") as service:
        first, too_big = service.done(SHORT), service.post(BIG)
        assert service.finished(too_big)["status"] == "failed"
        assert service.result(too_big).status_code == 507
        filler = fill(small_disk)
        refused = service.client.post("/jobs", json=SHORT)
        while refused.status_code == 202:  # SQLite has some room of its own.
            refused = service.client.post("/jobs", json=SHORT)
        assert (refused.status_code, refused.headers["content-type"]) == (507, "application/problem+json")
        assert service.client.get("/collision-time").status_code == service.result(first).status_code == 200
        filler.unlink()
        again = service.done(SHORT)
        assert service.client.delete(too_big).status_code == 204
        assert service.result(again).content == service.result(first).content


def test_jobs_can_be_removed_one_after_the_other_while_the_disk_stays_full(small_disk: Path) -> None:
    with JobService(small_disk / "data") as service:
        made = [service.post(BIG) for _ in range(3)]  # They fail, so that no result is removed with them.
        for address in made:
            assert service.finished(address)["status"] == "failed"
        made.append(service.post(ENDLESS))
        for address in made:
            fill(small_disk, address.rpartition("/")[2])
            answer = service.client.delete(address)
            assert answer.status_code == (200 if address == made[-1] else 204), answer.text
        assert service.client.delete(made[-1]).status_code == 204
        assert {service.client.get(address).status_code for address in made} == {404}

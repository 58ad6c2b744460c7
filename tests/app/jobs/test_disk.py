"""A full disk: every call about jobs says so, no file is incomplete, and freed space is used."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.job_service import ENDLESS, SHORT, JobService

DISK_BYTES = 1_000_000
# About 1.3 MB of JSON, which the disk does not hold.
BIG = {"question": "trajectory", "request": {"times": {"stop": 100, "step": 1}}}


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of one megabyte, which only root may mount."""
    folder = tmp_path / "disk"
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK_BYTES}", "tmpfs", folder], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", "--lazy", folder], check=True)


def fill(folder: Path, name: str = "filler") -> Path:
    """A file that takes the rest of the disk."""
    file = folder / name
    with file.open("wb", buffering=0) as filler:
        try:
            while filler.write(b"0" * 4096):
                pass
        except OSError:
            return file


@pytest.mark.root
def test_a_full_disk_is_reported_and_freed_space_is_used(small_disk: Path) -> None:
    with JobService(small_disk / "data") as service:
        first = service.post(SHORT)
        assert service.finished(first)["status"] == "successful"
        too_big = service.post(BIG)
        assert service.finished(too_big)["status"] == "failed"
        answer = service.client.get(f"{too_big}/result")
        assert answer.status_code == 507
        assert "No space left on device" in answer.json()["detail"]
        filler = fill(small_disk)
        refused = service.client.post("/jobs", json=SHORT)
        while refused.status_code == 202:  # SQLite has some room of its own.
            refused = service.client.post("/jobs", json=SHORT)
        assert refused.status_code == 507
        assert refused.headers["content-type"] == "application/problem+json"
        assert "disk of the data folder is full" in refused.json()["detail"]
        assert service.client.get("/collision-time").status_code == 200
        assert service.client.get(f"{first}/result").status_code == 200
        filler.unlink()
        again = service.post(SHORT)
        assert service.finished(again)["status"] == "successful"
        assert service.client.delete(too_big).status_code == 204
        assert service.client.get(f"{again}/result").content == service.client.get(f"{first}/result").content


@pytest.mark.root
def test_jobs_can_be_removed_one_after_the_other_while_the_disk_stays_full(small_disk: Path) -> None:
    with JobService(small_disk / "data") as service:
        made = [service.post(BIG) for _ in range(3)]  # They fail, so that no result is removed with them.
        for address in made:
            assert service.finished(address)["status"] == "failed"
        waiting = service.post(ENDLESS)
        for k, address in enumerate([*made, waiting]):
            fill(small_disk, f"filler{k}")
            answer = service.client.delete(address)
            assert answer.status_code == (200 if address == waiting else 204), answer.text
        assert service.client.delete(waiting).status_code == 204
        assert {service.client.get(address).status_code for address in [*made, waiting]} == {404}

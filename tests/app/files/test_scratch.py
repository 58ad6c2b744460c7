"""Temporary folders: what a killed process leaves is removed at the next start, what a living one has is not."""

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import httpx
import psutil
import pytest

from app.files.lock import FolderLock
from app.files.scratch import reclaim, temporary
from tests.support.job_service import is_gone, wait_for
from tests.support.serving import PATIENT, serving

HOLD = """
import sys, time
from app.files.scratch import temporary
with temporary("test-") as folder:
    print(folder, flush=True)
    time.sleep(600)
"""
FILM = {"question": "films", "request": {}}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The folder of temporary files, of this process and of those that it starts."""
    place = tmp_path / "temporary"
    place.mkdir()
    monkeypatch.setenv("TMPDIR", str(place))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return place


def holding():
    """Another process with a temporary folder."""
    process = subprocess.Popen([sys.executable, "-c", HOLD], stdout=subprocess.PIPE, text=True)
    return process, Path(process.stdout.readline().strip())


def test_the_folder_of_a_killed_process_is_removed_and_that_of_a_living_one_stays():
    with temporary("own-") as own:
        processes, folders = zip(holding(), holding(), strict=True)
        try:
            assert reclaim() == []
            processes[0].kill()
            processes[0].wait()
            assert reclaim() == [folders[0]]
            assert [one.exists() for one in (*folders, Path(own))] == [False, True, True]
        finally:
            for process in processes:
                process.kill()
                process.wait()
                process.stdout.close()
        assert Path(own).is_dir()
    assert not Path(own).exists()


def test_what_has_no_lock_or_is_used_by_a_job_or_is_no_folder_is_left_alone(folder):
    for name in ("bench-dragon-strange", "bench-dragon-data-used", "other", "elsewhere"):
        (folder / name).mkdir()
    (folder / "bench-dragon-file").touch()
    (folder / "elsewhere" / "alive.lock").touch()
    (folder / "bench-dragon-link").symlink_to(folder / "elsewhere")
    (folder / "bench-dragon-data-used" / "keeper.lock").touch()
    runner = FolderLock(folder / "bench-dragon-data-used", "runner")
    assert runner.take()
    before = sorted(folder.rglob("*"))
    assert reclaim() == []
    assert sorted(folder.rglob("*")) == before
    runner.give_back()
    assert reclaim() == [folder / "bench-dragon-data-used"]


def unwritable(environment, tmp_path):
    """A home where matplotlib may not write: a file, because a test may run as root."""
    (tmp_path / "home").touch()
    environment("XDG_CONFIG_HOME", str(tmp_path / "home"))
    environment("XDG_CACHE_HOME", str(tmp_path / "home"))


@pytest.mark.thorough
@pytest.mark.parametrize("workers", [1, 2])
def test_what_a_killed_service_leaves_is_gone_after_the_next_start(folder, tmp_path, workers, monkeypatch):
    monkeypatch.delenv("MPLCONFIGDIR", raising=False)
    unwritable(monkeypatch.setenv, tmp_path)
    with serving(tmp_path / "log", workers, limit=os.setsid, deadline_seconds=PATIENT) as service:
        assert httpx.get(f"{service.url}/figures/trajectory.png", timeout=60.0).status_code == 200
        answer = httpx.post(f"{service.url}/jobs", json=FILM, timeout=60.0)
        assert answer.status_code == 202
        wait_for(lambda: list(folder.glob("bench-dragon-film-*")))
        family = psutil.Process(service.process.pid).children(recursive=True)
        os.killpg(service.process.pid, signal.SIGKILL)  # All of the service; its jobs are in groups of their own.
        service.process.wait()
    left = {place.name for place in folder.iterdir()}
    assert {name.split("-")[2] for name in left} >= {"data", "film", "fonts"}, left
    assert all(name.startswith("bench-dragon-") for name in left), left
    wait_for(lambda: all(is_gone(child.pid) for child in family))  # The runner ends with the service, and its jobs.
    with serving(tmp_path / "log", workers, limit=os.setsid, data=tmp_path / "data"):
        assert not left & {place.name for place in folder.iterdir()}
    assert list(folder.iterdir()) == []

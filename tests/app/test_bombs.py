"""Files that need much memory or time: the real service refuses each, and no reader exceeds its limit."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import httpx
import psutil
import pytest

from app.service.graders import Graders
from core import BenchDragonError, Budget, InvalidValue, TooMuchWork
from tests.support.bombs import GRADES, MAPS, end, fail, take_memory
from tests.support.serving import Service, serving

FILE = {"Content-Type": "application/octet-stream"}
# Memory of a reader of any of these files [MB]; some took 3 GB. A new reader has 75 to 110 MB.
MEMORY_MAX = 400.0
LIMIT = 600_000_000
# Longest answer on a busy machine [s]; an arc took all of its 20 s.
SECONDS_MAX = 15.0


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with serving(tmp_path_factory.mktemp("bombs") / "log", reader_memory_max=LIMIT, places_seconds=60) as service:
        yield service


def readers(pid: int) -> list[psutil.Process]:
    """The processes that read files for a process."""
    entries = []
    for child in psutil.Process(pid).children():
        with suppress(psutil.Error):
            entries += [child] if "app.service.graders" in child.cmdline() else []
    return entries


@contextmanager
def watched(pid: int) -> Iterator[list[float]]:
    """The memory of the readers of a service, looked at all the time [MB]."""
    seen, done = [0.0], threading.Event()

    def look() -> None:
        while not done.wait(0.02):
            for reader in readers(pid):
                with suppress(psutil.Error):
                    seen.append(reader.memory_info().rss / 1e6)

    thread = threading.Thread(target=look)
    thread.start()
    try:
        yield seen
    finally:
        done.set()
        thread.join()


def sent(service: Service, call: str, data: bytes) -> httpx.Response:
    return httpx.post(f"{service.url}/{call}", content=data, headers=FILE, timeout=120)


@pytest.mark.parametrize("name", MAPS)
def test_a_map_that_unfolds_is_refused_within_memory_and_time(service: Service, name: str) -> None:
    data = MAPS[name]()
    begun = time.monotonic()
    with watched(service.process.pid) as memory:
        answer = sent(service, "places", data)
    assert answer.status_code == 422, answer.text[:300]
    assert "must" in answer.json()["detail"]
    assert max(memory) < MEMORY_MAX
    assert time.monotonic() - begun < SECONDS_MAX
    assert "Traceback" not in service.log.read_text()


@pytest.mark.parametrize("name", GRADES)
def test_a_workbook_that_unfolds_is_unreadable_within_memory_and_time(service: Service, name: str) -> None:
    data = GRADES[name]()
    begun = time.monotonic()
    with watched(service.process.pid) as memory:
        [file] = sent(service, "grade", data).raise_for_status().json()["files"]
    assert file["verdict"] == "unreadable"
    assert max(memory) < MEMORY_MAX
    assert time.monotonic() - begun < SECONDS_MAX


def test_a_reader_has_a_limit_and_is_the_first_to_end(service: Service) -> None:
    sent(service, "places", b"{}")
    [reader] = readers(service.process.pid)
    assert reader.rlimit(psutil.RLIMIT_AS)[0] == LIMIT
    assert Path(f"/proc/{reader.pid}/oom_score_adj").read_text() == "1000\n"
    metrics = httpx.get(f"{service.url}/metrics").text
    assert "bench_dragon_readers_memory_limit_bytes 1.2e+09" in metrics
    assert 'bench_dragon_reader_memory_bytes_bucket{le="5e+08"}' in metrics


def test_files_have_places_of_their_own(tmp_path: Path) -> None:
    slow = b"0\nSECTION\n2\nENTITIES\n" + b"0\nPOINT\n10\n0\n20\n0\n" * 150_000 + b"0\nENDSEC\n0\nEOF\n"
    answers: list[httpx.Response] = []
    with serving(tmp_path / "log", readers_max=1) as service:
        clients = [
            threading.Thread(target=lambda: answers.append(sent(service, "places", slow)), name=str(k))
            for k in range(3)
        ]
        for client in clients:
            client.start()
        assert httpx.get(f"{service.url}/collision-time", timeout=120).status_code == 200
        for client in clients:
            client.join()
    assert sorted(answer.status_code for answer in answers)[-1] == 503
    refused = next(answer for answer in answers if answer.status_code == 503)
    assert int(refused.headers["retry-after"]) >= 1
    assert "1 file computation" in refused.json()["detail"]


# -- readers by themselves ----------------------------------------------------------------------------------


@pytest.fixture
def seen() -> list[int | None]:
    return []


@pytest.fixture
def graders(seen: list[int | None]) -> Iterator[Graders]:
    with closing(Graders(LIMIT, seen.append)) as graders:
        yield graders


def test_a_file_that_ended_its_reader_is_not_tried_again(
    graders: Graders, seen: list[int | None], tmp_path: Path
) -> None:
    with pytest.raises(InvalidValue, match="the file must be simpler: reading it ended the process"):
        graders.read(Budget(), end, tmp_path / "log")
    assert (tmp_path / "log").read_text() == "ended\n"
    assert seen == [None]


def test_a_file_that_needs_too_much_memory_is_refused_and_the_next_is_read(graders: Graders) -> None:
    with pytest.raises(TooMuchWork, match="must be simpler: reading it takes more than 600 MB of memory"):
        graders.read(Budget(), take_memory, b"x" * 100_000)
    assert graders.read(Budget(), take_memory, b"x") == 10_000


def test_any_fault_of_a_reader_is_an_answer_that_tells_nothing_of_the_file(
    graders: Graders, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(BenchDragonError, match=r"the file could not be read \(ZeroDivisionError\)"):
        graders.read(Budget(), fail, b"secret")
    log = capfd.readouterr().err
    assert "ZeroDivisionError" in log
    assert "bombs.py" in log
    assert "secret" not in log
    assert graders.read(Budget(), take_memory, b"x") == 10_000

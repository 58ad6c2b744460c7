"""Files that need much memory or time: the real service refuses each, and no reader exceeds its limit."""

import threading
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import httpx
import psutil
import pytest

from app.service.graders import Graders
from core import BenchDragonError, Budget, TooMuchWork
from tests.support.bombs import GRADES, MAPS, end, fail, take_memory
from tests.support.depth import often
from tests.support.refused import refused
from tests.support.serving import serving

FILE = {"Content-Type": "application/octet-stream"}
# Memory of a reader of any of these files [MB]; some took 3 GB. A new reader has 75 to 110 MB.
MEMORY_MAX = 400.0
LIMIT = 600_000_000
# Most processor time of a reader for one of these files [s]; an arc took all of its 20 s.
SECONDS_MAX = 15.0


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    with serving(tmp_path_factory.mktemp("bombs") / "log", reader_memory_max=LIMIT, places_seconds=60) as service:
        yield service


def readers(service):
    """The processes that read files for a service."""
    entries = []
    for child in psutil.Process(service.process.pid).children():
        with suppress(psutil.Error):
            entries += [child] if "app.service.graders" in child.cmdline() else []
    return entries


@contextmanager
def watched(service):
    """The memory [MB] and the processor time [s] of each reader of a service, looked at all the time."""
    seen = defaultdict(list)
    done = threading.Event()

    def look():
        while not done.wait(0.02):
            for reader in readers(service):
                with suppress(psutil.Error):
                    seen[reader.pid].append((reader.memory_info().rss / 1e6, sum(reader.cpu_times()[:2])))

    with ThreadPoolExecutor() as watcher:
        watcher.submit(look)
        try:
            yield seen
        finally:
            done.set()


def sent(service, call, data):
    return httpx.post(f"{service.url}/{call}", content=data, headers=FILE, timeout=120)


@pytest.mark.parametrize(
    "name",
    often(MAPS | GRADES, ("deep_toml", "bzip2_of_a_workbook")),
)
def test_a_file_that_unfolds_is_refused_within_memory_and_time(service, name):
    data = (MAPS | GRADES)[name]()
    with watched(service) as seen:
        answer = sent(service, "places" if name in MAPS else "grade", data)
    if name in MAPS:
        assert answer.status_code == 422, answer.text[:300]
        assert "must" in answer.json()["detail"]
    else:
        assert [file["verdict"] for file in answer.json()["files"]] == ["unreadable"]
    for looks in seen.values():
        assert max(memory for memory, _ in looks) < MEMORY_MAX
        assert looks[-1][1] - looks[0][1] < SECONDS_MAX
    assert "Traceback" not in service.log.read_text()


def test_a_reader_has_a_limit_and_is_the_first_to_end(service):
    sent(service, "places", b"{}")
    [reader] = readers(service)
    assert reader.rlimit(psutil.RLIMIT_AS)[0] == LIMIT
    assert Path(f"/proc/{reader.pid}/oom_score_adj").read_text() == "1000\n"
    metrics = httpx.get(f"{service.url}/metrics").text
    assert "bench_dragon_readers_memory_limit_bytes 1.2e+09" in metrics
    assert 'bench_dragon_reader_memory_bytes_bucket{le="5e+08"}' in metrics


# -- readers by themselves ----------------------------------------------------------------------------------


@pytest.fixture
def seen():
    return []


@pytest.fixture
def graders(seen):
    with closing(Graders(LIMIT, seen.append)) as graders:
        yield graders


def test_a_file_that_ended_its_reader_is_not_tried_again_and_the_log_says_how(graders, seen, tmp_path, caplog):
    with refused("file"):
        graders.read(Budget(), end, tmp_path / "log")
    assert (tmp_path / "log").read_text() == "ended\n"
    assert seen == [None]
    assert "was ended by exit code" in caplog.text


def test_a_file_that_needs_too_much_memory_is_refused_and_the_next_is_read(graders):
    with refused("file", TooMuchWork):
        graders.read(Budget(), take_memory, b"x" * 100_000)
    assert graders.read(Budget(), take_memory, b"x") == 10_000


def test_any_fault_of_a_reader_is_an_answer_that_tells_nothing_of_the_file(graders, capfd):
    with pytest.raises(BenchDragonError, match="ZeroDivisionError"):
        graders.read(Budget(), fail, b"secret")
    log = capfd.readouterr().err
    assert "ZeroDivisionError" in log
    assert "bombs.py" in log
    assert "secret" not in log
    assert graders.read(Budget(), take_memory, b"x") == 10_000

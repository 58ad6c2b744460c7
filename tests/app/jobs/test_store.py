"""The store of jobs: its content, and the transitions between states."""

from __future__ import annotations

import random
import re
import secrets
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from threading import Timer

import orjson
import pytest

from app.jobs import store as stores
from app.jobs.job import ID_PATTERN, Full, FullForClient, FullOfBytes, JobState
from app.jobs.store import DEATHS_MAX, EVENTS_KEPT, TABLES, Store
from app.settings import Settings

ROOM = Settings(jobs_max=10, jobs_client_max=10, jobs_bytes_max=1_000)
PROBLEM = orjson.dumps({"detail": "It does not work."})


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    store = Store(tmp_path / "data")
    yield store
    store.close()


def make(store: Store, question: str = "turn") -> str:
    return store.create(question, b"call", "client", ROOM).id


def written(store: Store, data: bytes) -> Path:
    file = store.results / ".new"
    file.write_bytes(data)
    return file


def test_jobs_run_in_the_order_in_which_they_were_asked_for(store: Store) -> None:
    made = [make(store) for _ in range(3)]
    assert [store.take() for _ in range(4)] == [*made, None]


def test_names_of_jobs_are_long_and_never_the_same(store: Store) -> None:
    names = {make(store) for _ in range(10)}
    assert len(names) == 10
    assert all(re.fullmatch(ID_PATTERN, name) for name in names)


def test_another_process_sees_what_this_one_wrote(store: Store) -> None:
    job = make(store)
    other = Store(store.folder)
    assert other.known(job) == store.known(job)
    assert other.call(job) == b"call"
    assert other.take() == job
    assert store.known(job).state is JobState.RUNNING
    other.close()


def test_what_was_running_waits_again_for_a_new_runner_and_half_results_go(store: Store) -> None:
    job = make(store)
    store.take()
    half = written(store, b"half")
    store.begin()
    assert store.known(job).state is JobState.ACCEPTED
    assert not half.exists()
    assert store.take() == job


def test_a_sweep_that_is_begun_again_keeps_its_progress_and_another_job_begins_anew(store: Store) -> None:
    made = [make(store, question) for question in ("sweep", "turn")]
    for job in made:
        assert store.take() == job
        store.proceed(job, 0.4, 0.1)
    store.begin()
    for job, progress in zip(made, (40, 0), strict=True):
        assert store.take() == job
        assert store.known(job).progress == progress


def test_a_result_stands_when_its_state_could_not_be_written_and_is_said_again(store: Store) -> None:
    job = make(store)
    store.take()
    file = written(store, b"answer")
    store.succeed(job, file, "text/plain")
    store.succeed(job, file, "text/plain")
    assert store.result(job).read_bytes() == b"answer"
    assert store.known(job).state is JobState.SUCCESSFUL
    assert len(store.events(job, 0)) == 3


def test_the_result_of_a_dismissed_job_is_not_kept(store: Store) -> None:
    job = make(store)
    store.take()
    assert store.dismiss(job)
    assert not store.dismiss(job)
    store.succeed(job, written(store, b"answer"), "text/plain")
    assert store.known(job).state is JobState.DISMISSED
    assert not store.result(job).exists()


def test_a_job_may_end_its_process_twice(store: Store) -> None:
    job = make(store)
    for death in range(1, DEATHS_MAX + 1):
        assert store.take() == job
        store.die(job, PROBLEM)
        assert store.known(job).state is (JobState.FAILED if death == DEATHS_MAX else JobState.ACCEPTED)
    assert store.known(job).message == "It does not work."


def test_a_finished_job_is_in_no_way_changed(store: Store) -> None:
    job = make(store)
    store.take()
    store.fail(job, PROBLEM)
    before = store.known(job), store.events(job, 0)
    store.proceed(job, 0.5, 0.1)
    store.die(job, PROBLEM)
    store.fail(job, PROBLEM)
    assert (store.known(job), store.events(job, 0)) == before


def test_only_the_latest_events_are_kept_under_their_numbers(store: Store) -> None:
    job = make(store)
    store.take()
    for k in range(2 * EVENTS_KEPT):
        store.proceed(job, k / (2 * EVENTS_KEPT), 0.1)
    numbers = [number for number, _ in store.events(job, 0)]
    assert numbers == list(range(EVENTS_KEPT + 3, 2 * EVENTS_KEPT + 3))
    assert [number for number, _ in store.events(job, numbers[-2])] == numbers[-1:]


@pytest.mark.parametrize(
    ("room", "error"),
    [
        (Settings(jobs_max=1, jobs_client_max=10, jobs_bytes_max=1_000), Full),
        (Settings(jobs_max=10, jobs_client_max=1, jobs_bytes_max=1_000), FullForClient),
        (Settings(jobs_max=10, jobs_client_max=10, jobs_bytes_max=6), FullOfBytes),
    ],
    ids=["jobs", "of_client", "bytes"],
)
def test_no_job_is_taken_where_there_is_no_room(store: Store, room: Settings, error: type[Full]) -> None:
    job = make(store)
    store.take()
    if error is FullOfBytes:
        store.succeed(job, written(store, b"answer"), "text/plain")
    with pytest.raises(error):
        store.create("turn", b"call", "client", room)
    assert len(store.all()) == 1
    store.remove(job)
    store.create("turn", b"call", "client", room)


def test_a_folder_of_another_layout_is_not_touched(store: Store) -> None:
    with sqlite3.connect(store.folder / "jobs.sqlite") as connection:
        connection.execute("PRAGMA user_version = 99")
    connection.close()
    with pytest.raises(OSError, match="to another version of this program"):
        Store(store.folder)


def test_a_broken_file_is_told(tmp_path: Path) -> None:
    (tmp_path / "jobs.sqlite").write_bytes(b"no database" * 1000)
    with pytest.raises(sqlite3.DatabaseError):
        Store(tmp_path)


def test_jobs_of_the_layout_before_are_taken_over(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "jobs.sqlite") as old:
        without = ",\n    done INTEGER, total INTEGER, kept INTEGER NOT NULL DEFAULT 0"
        assert without in TABLES
        for table in TABLES.replace(without, "").split(";"):
            old.execute(table)
        old.execute(
            "INSERT INTO jobs (id, question, call, client, state, created, updated, message)"
            " VALUES ('a', 'turn', x'', '', 'accepted', 1, 1, '')"
        )
        old.execute("PRAGMA user_version = 1")
    old.close()
    for _ in range(2):  # The second time it is of this layout.
        store = Store(tmp_path)
        found = store.known("a")
        assert (found.question, found.done, found.total) == ("turn", None, None)
        store.close()


def test_a_store_is_opened_while_another_process_makes_its_database(tmp_path: Path) -> None:
    """SQLite refuses at once to change the mode of a database while another connection writes."""
    with closing(sqlite3.connect(tmp_path / "jobs.sqlite", isolation_level=None, check_same_thread=False)) as other:
        other.execute("BEGIN IMMEDIATE")
        made = Timer(0.2, other.commit)
        made.start()
        with closing(Store(tmp_path)) as store:
            assert store.all() == []
        made.join()


def test_a_removal_leaves_no_copy_where_rows_were_moved_unless_the_store_is_too_large(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With these names SQLite moves rows between its pages, and copies stay behind."""
    seeded = random.Random(10)
    monkeypatch.setattr(secrets, "token_hex", lambda size: seeded.randbytes(size).hex())
    many = Settings(jobs_max=100, jobs_client_max=100)
    made = sorted(store.create("turn", seeded.randbytes(75).hex().encode(), "client", many).id for _ in range(100))
    for _ in made:
        store.fail(store.take() or "", PROBLEM)

    def kept() -> int:
        files = [file.read_bytes() for file in store.folder.glob("jobs.sqlite*")]
        return sum(any(name.encode() in data for data in files) for name in made[::2])

    monkeypatch.setattr(stores, "REWRITTEN_MAX", 0)
    store.remove(*made[:-2:2])
    store.clear()
    assert kept() > 1  # the last one, and copies of others
    monkeypatch.undo()
    store.remove(made[-2])
    assert store.must_clear()
    store.clear()
    assert not store.must_clear()
    assert kept() == 0
    assert len(store.all()) == 50


def test_expired_calls_and_jobs_leave_no_byte(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    day_ago = time.time() - 86_400.0
    with monkeypatch.context() as then:
        then.setattr(time, "time", lambda: day_ago)
        job = store.create("turn", b"a call like no other", "client", ROOM).id
        store.fail(store.take() or "", PROBLEM)
    data = (store.folder / "jobs.sqlite", store.folder / "jobs.sqlite-wal")
    for days, left, words in ((0.75, 1, b"a call like no other"), (0.25, 0, job.encode())):
        assert any(words in file.read_bytes() for file in data)
        store.expire(days)
        store.clear()
        assert not any(words in file.read_bytes() for file in data)
        assert len(store.all()) == left

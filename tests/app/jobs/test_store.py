"""The store of jobs: its content, and the transitions between states."""

import random
import re
import secrets
import sqlite3
import time
from collections import Counter
from contextlib import closing
from threading import Timer

import orjson
import pytest

from app.jobs import store as stores
from app.jobs.job import GAVE_WAY, ID_PATTERN, Full, FullForClient, FullOfBytes, JobState, KeptByClient
from app.jobs.room import DAY, FRESH, KeptJob, Room
from app.jobs.store import DEATHS_MAX, EVENTS_KEPT, Store
from app.settings import Settings

ROOM = Settings(jobs_max=10, jobs_client_max=10)
PROBLEM = orjson.dumps({"detail": "It does not work."})
ADDRESS = "192.0.2.77"


def make(store, client="client", limits=ROOM, question="turn"):
    return store.create(question, b"call", client, limits).id


def written(store, data=b"answer"):
    file = store.results / ".new"
    file.write_bytes(data)
    return file


def database(folder):
    """The database of a store, beside its own connection."""
    return closing(sqlite3.connect(folder / "jobs.sqlite", isolation_level=None, check_same_thread=False))


def run_in(store, command, *values):
    """Rows that a command finds or changes in the database of the store."""
    with database(store.folder) as other:
        return other.execute(command, values).fetchall()


def holds(folder, text):
    return any(text.encode() in file.read_bytes() for file in folder.iterdir() if file.is_file())


def ended(store, client="client", limits=ROOM):
    """A job of a client that has an answer."""
    job = make(store, client, limits)
    assert store.take() == job
    store.succeed(job, written(store), "text/plain", limits)
    return job


def in_turn(store, of_client=None):
    """The jobs one after the other; each fails when the next one is taken."""
    while job := store.take(of_client=of_client):
        yield job
        store.fail(job, PROBLEM)


def test_names_of_jobs_are_long_and_never_the_same_and_they_run_in_the_order_of_their_calls(store):
    made = [make(store) for _ in range(10)]
    assert len(set(made)) == 10
    assert all(re.fullmatch(ID_PATTERN, name) for name in made)
    assert list(in_turn(store)) == made


def test_what_was_running_waits_for_a_new_runner_a_sweep_with_its_progress_and_half_results_go(store):
    made = [make(store, question=question) for question in ("sweep", "turn")]
    for job in made:
        assert store.take() == job
        store.proceed(job, 0.4, 0.1)
        assert store.known(job).time_left == pytest.approx(6.0)
    half = written(store)
    store.begin()
    assert not half.exists()
    assert {store.known(job).state for job in made} == {JobState.ACCEPTED}
    assert [store.take(), store.take()] == made
    assert [store.known(job).progress for job in made] == [40, 0]


def test_a_result_is_kept_and_reported_again_when_its_state_could_not_be_written(store):
    job = ended(store)
    store.succeed(job, store.results / ".new", "text/plain")
    assert store.result(job).read_bytes() == b"answer"
    assert store.known(job).state == JobState.SUCCESSFUL
    assert store.known(job).progress == 100
    assert len(store.events(job, 0)) == 3


def test_the_result_of_a_dismissed_job_is_not_kept(store):
    job = make(store)
    store.take()
    assert [store.dismiss(job), store.dismiss(job)] == [True, False]
    store.succeed(job, written(store), "text/plain")
    assert store.known(job).state is JobState.DISMISSED
    assert not store.result(job).exists()


def test_a_job_may_end_its_process_twice_and_is_then_in_no_way_changed(store):
    job = make(store)
    for death in range(1, DEATHS_MAX + 1):
        assert store.take() == job
        store.die(job, PROBLEM)
        assert store.known(job).state is (JobState.FAILED if death == DEATHS_MAX else JobState.ACCEPTED)
    before = store.known(job), store.events(job, 0)
    assert before[0].message == "It does not work."
    store.proceed(job, 0.5, 0.1)
    store.die(job, PROBLEM)
    store.fail(job, PROBLEM)
    assert (store.known(job), store.events(job, 0)) == before


def test_only_the_latest_events_are_kept_under_their_numbers(store):
    """A job whose work is done is not at a hundred percent before its answer is there."""
    job = make(store)
    store.take()
    for k in range(2 * EVENTS_KEPT):
        store.proceed(job, (k + 1) / (2 * EVENTS_KEPT), 0.1)
    numbers = [number for number, _ in store.events(job, 0)]
    assert numbers == list(range(EVENTS_KEPT + 3, 2 * EVENTS_KEPT + 3))
    assert [number for number, _ in store.events(job, numbers[-2])] == numbers[-1:]
    assert store.known(job).state == JobState.RUNNING
    assert store.known(job).progress == 99


@pytest.mark.parametrize(
    "limit, most, error",
    [
        ("jobs_max", 1, Full),
        ("jobs_client_max", 1, FullForClient),
        ("jobs_client_kept_max", 1, KeptByClient),
        ("jobs_client_bytes_max", 6, KeptByClient),
        ("jobs_bytes_max", 6, FullOfBytes),
    ],
)
def test_no_job_is_taken_where_there_is_no_room(store, limit, most, error):
    job = (make if error is FullForClient else ended)(store)
    room = Settings(**{limit: most})
    store.take()
    with pytest.raises(error) as refused:
        make(store, limits=room)
    assert 0 < refused.value.seconds <= (1.0 if error is FullForClient else FRESH)
    assert len(store.all()) == 1
    store.remove(job)
    make(store, limits=room)


def test_a_folder_of_another_layout_is_not_touched(store):
    run_in(store, "PRAGMA user_version = 99")
    with pytest.raises(OSError, match="to another version"):
        Store(store.folder)


# The tables of earlier versions as they wrote them; the second without the table that came later in the same layout.
EVENTS = """
CREATE INDEX jobs_by_state ON jobs (state, created);
CREATE TABLE events (
    job TEXT NOT NULL REFERENCES jobs ON DELETE CASCADE, number INTEGER NOT NULL, data BLOB NOT NULL,
    PRIMARY KEY (job, number)
) WITHOUT ROWID;
"""
COLUMNS = """
    id TEXT PRIMARY KEY, question TEXT NOT NULL, call BLOB NOT NULL, client TEXT NOT NULL, state TEXT NOT NULL,
    created REAL NOT NULL, started REAL, finished REAL, updated REAL NOT NULL, message TEXT NOT NULL,
    progress INTEGER NOT NULL DEFAULT 0, rate REAL, time_left REAL, deaths INTEGER NOT NULL DEFAULT 0,
    media_type TEXT, size INTEGER NOT NULL DEFAULT 0, problem BLOB, expired INTEGER NOT NULL DEFAULT 0"""
LAYOUTS = {
    1: f"CREATE TABLE jobs ({COLUMNS});{EVENTS}",
    2: f"CREATE TABLE jobs ({COLUMNS}, done INTEGER, total INTEGER, kept INTEGER NOT NULL DEFAULT 0);{EVENTS}"
    "CREATE TABLE removals (id INTEGER PRIMARY KEY CHECK (id = 0), made INTEGER, cleared INTEGER);"
    "INSERT INTO removals VALUES (0, 4, 4);",
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_jobs_of_the_layouts_before_are_taken_over_without_the_addresses_of_their_clients(tmp_path, layout):
    rows = [
        ("a", ADDRESS, "accepted", 1, None),
        ("b", ADDRESS, "running", 2, None),
        ("c", "", "successful", 3, time.time()),
    ]
    with database(tmp_path) as old:
        old.executescript(LAYOUTS[layout])
        old.executemany(
            "INSERT INTO jobs (id, question, call, client, state, created, updated, message, finished)"
            " VALUES (?, 'turn', CAST('call' AS BLOB), ?, ?, ?, 1, '', ?)",
            rows,
        )
        old.execute(f"PRAGMA user_version = {layout}")
    for _ in range(2):  # The second time it is of this layout.
        with closing(Store(tmp_path)) as store:
            result = store.known("a")
            assert (result.question, result.done, result.total, store.call("a")) == ("turn", None, None, b"call")
            with pytest.raises(FullForClient):  # Its jobs are still those of its client.
                make(store, ADDRESS, Settings(jobs_client_max=2))
            assert store.counts().kept == 3
            if store.must_clear():
                store.clear()
            assert not store.must_clear()
    with closing(Store(tmp_path)) as store:
        store.begin()
        assert store.take() == "a"
    assert not holds(tmp_path, ADDRESS)


def test_jobs_of_the_layout_with_calls_among_the_jobs_are_taken_over(tmp_path):
    with closing(Store(tmp_path)) as store:
        job = make(store, ADDRESS)
    with database(tmp_path) as old:
        old.executescript(
            "ALTER TABLE jobs ADD COLUMN call BLOB; UPDATE jobs SET call = (SELECT data FROM calls WHERE job = id);"
            "DROP TABLE calls; ALTER TABLE jobs DROP COLUMN call_size; PRAGMA user_version = 3;"
        )
    with closing(Store(tmp_path)) as store:
        assert store.call(job) == b"call"
        assert store.counts().kept == 1
        assert store.counts().used == 4
        with pytest.raises(FullForClient):
            make(store, ADDRESS, Settings(jobs_client_max=1))


def test_of_a_client_a_hash_is_kept_which_another_folder_does_not_have(tmp_path):
    names = set()
    for folder in (tmp_path / "a", tmp_path / "b"):
        with closing(Store(folder)) as store:
            make(store, ADDRESS)
            assert not holds(folder, ADDRESS)
            names |= set(*run_in(store, "SELECT client FROM jobs"))
        assert (folder / "client.key").stat().st_mode & 0o077 == 0
    assert len([name for name in names if re.fullmatch("[0-9a-f]{24}", name)]) == 2


def gone(store, jobs):
    """The number of each job, from 0, whose result gave way."""
    return [number for number, job in enumerate(jobs) if store.known(job).expired == GAVE_WAY]


def test_the_oldest_finished_job_of_a_client_gives_way_to_its_next_one(store):
    room = Settings(jobs_client_kept_max=3)
    others = ended(store, "other", room)
    jobs = [ended(store, "client", room) for _ in range(5)]
    assert gone(store, jobs) == [0, 1]
    assert [store.result(job).exists() for job in [others, *jobs]] == [True, False, False, True, True, True]
    with pytest.raises(KeyError):
        store.call(jobs[0])
    assert (store.counts().kept, store.counts().gave_way, store.counts().of_client) == (4, 2, 3)


def test_a_result_takes_the_room_of_older_ones_of_its_client(store):
    assert gone(store, [ended(store, limits=Settings(jobs_client_bytes_max=25)) for _ in range(4)]) == [0, 1]
    assert store.counts().used == 20


@pytest.mark.parametrize("seed", range(200))
def test_only_who_has_at_least_as_much_makes_room_and_a_refusal_says_when_there_will_be_some(seed):
    """Whatever is in the store, against the words of app.jobs.room."""
    chance = random.Random(seed)
    now = 1e9
    names = [f"client {k}" for k in range(chance.randrange(1, 6))]
    rows = []
    for k in range(chance.randrange(1, chance.choice([5, 30]))):
        state = chance.choice(["successful", "successful", "dismissed", "failed"])
        finished = now - chance.choice([10.0, 2.0]) * FRESH * chance.random()
        rows.append(KeptJob(str(k), "turn", chance.choice(names), state, 0.0, finished, 0.0, None, 1.0, 1))
    rows.sort(key=lambda row: row.finished)
    limits = Settings(jobs_max=len(rows), jobs_client_kept_max=len(rows))
    asking = chance.choice(["asking", names[0]])
    counts = Counter([asking, *(row.client for row in rows)])
    latest = {row.client: row for row in rows if row.state != "dismissed"}.values()
    may = [row for row in rows if row not in latest or now - row.finished >= FRESH]
    may = [row for row in may if row.client == asking or counts[row.client] >= counts[asking]]

    def gone(later=0.0):
        room = Room(rows, asking, limits, now + later)
        room.make(1)
        return room.gone

    oldest = {row.client: row.finished for row in reversed(rows)}
    if may:
        first = min(may, key=lambda row: (-counts[row.client], row.client != asking, oldest[row.client]))
        assert gone() == [first.id]
        return
    with pytest.raises(Full) as refused:
        gone()
    gone(refused.value.seconds + 1e-3)
    with pytest.raises(Full):
        gone(refused.value.seconds - 1e-3)


def test_what_gave_way_is_remembered_only_so_long(store):
    room = Settings(jobs_client_kept_max=1, jobs_max=5, job_days_max=1e-9)
    for _ in range(20):
        ended(store, "client", room)
    assert len(store.all()) == 6
    assert len(store.events(store.all()[-1].id, 0)) == 1


def test_places_alternate_between_clients_and_short_jobs_come_first_within_one(store):
    wanted = [("a", 9.0), ("a", 1.0), ("a", 5.0), ("b", 50.0), ("b", 7.0), ("c", 99.0)]
    made = {store.create("turn", b"", client, ROOM, cost).id: (client, cost) for client, cost in wanted}
    turns = [made[job] for job in in_turn(store, of_client=1)]
    assert turns == [("a", 1.0), ("b", 7.0), ("c", 99.0), ("a", 5.0), ("b", 50.0), ("a", 9.0)]


def test_a_client_takes_no_more_places_than_its_share_and_who_has_fewest_comes_first(store):
    first = [make(store, "a") for _ in range(4)]
    assert [store.take(of_client=2) for _ in range(3)] == [*first[:2], None]
    store.fail(first[0], PROBLEM)
    other = [store.create("turn", b"", "b", ROOM, 99.0).id for _ in range(2)]
    assert [store.take(of_client=2) for _ in range(3)] == [other[0], first[2], other[1]]


def test_who_comes_under_a_new_address_or_removes_its_jobs_does_not_come_before_those_that_waited(store):
    patient = [make(store, "patient") for _ in range(3)]
    assert store.take() == patient[0]
    store.fail(patient[0], PROBLEM)
    sly = [make(store, "sly") for _ in range(3)]
    turns = []
    for job in in_turn(store):
        turns.append(job)
        if job in sly:
            store.fail(job, PROBLEM)
            store.remove(job)
    assert turns == [patient[1], sly[0], patient[2], sly[1], sly[2]]


def test_a_store_is_opened_while_another_process_makes_its_database(tmp_path):
    """SQLite refuses at once to change the mode of a database while another connection writes."""
    with database(tmp_path) as other:
        other.execute("BEGIN IMMEDIATE")
        made = Timer(0.2, other.commit)
        made.start()
        with closing(Store(tmp_path)) as store:
            assert store.all() == []
        made.join()


def test_a_removal_leaves_no_copy_where_rows_were_moved_unless_the_store_is_too_large(store, monkeypatch):
    """With these names SQLite moves rows between its pages, and copies stay behind."""
    seeded = random.Random(10)
    monkeypatch.setattr(secrets, "token_hex", lambda size: seeded.randbytes(size).hex())
    many = Settings(jobs_max=100, jobs_client_max=100)
    made = sorted(store.create("turn", seeded.randbytes(75).hex().encode(), "client", many).id for _ in range(100))
    assert len(list(in_turn(store))) == 100

    def kept():
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
    assert (store.must_clear(), kept(), len(store.all())) == (False, 0, 50)


def test_expired_calls_and_jobs_leave_no_byte(store):
    job = store.create("turn", b"a call like no other", "client", ROOM).id
    assert list(in_turn(store)) == [job]
    run_in(store, "UPDATE jobs SET finished = finished - ?", DAY)

    for days, left, words in ((0.75, 1, "a call like no other"), (0.25, 0, job)):
        assert holds(store.folder, words)
        store.expire(days)
        store.clear()
        assert (holds(store.folder, words), len(store.all())) == (False, left)

"""The calls about jobs on the real service: the result equals the direct answer, and waiting clients get events."""

from __future__ import annotations

import fcntl
import json
import socket
import sqlite3
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing
from pathlib import Path
from threading import Timer
from typing import Any

import httpx
import pytest

from app.service.job_calls import JOB_CALLS
from tests.support.job_service import ENDLESS, LONG, PATIENCE, SCAN, SHORT, JobService, direct, wait_for

ANSWERED = [
    SHORT,
    {"question": "trajectory", "request": {"dragon": {"benches": 3}, "times": [0, 1]}},
    {"question": "trajectory", "request": {"times": [0, 1]}, "accept": "text/csv"},
    {"question": "check", "request": {"path": {"kind": "spiral", "pitch": 0.8}, "stop": 20}},
    {"question": "trajectory_figure", "request": {"format": "svg", "time": 30, "benches": 20}},
]

# The byte of jobs.sqlite-shm that SQLite locks while it copies the log (https://sqlite.org/walformat.html).
CHECKPOINT_LOCK = 121
# Half of the time for which another process writes to the store [s]; a change of it may wait longer.
HELD = 1.0


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    with JobService(tmp_path_factory.mktemp("jobs")) as service:
        yield service


def events_of(service: JobService, address: str, last: int | None = None) -> list[tuple[int, Any]]:
    """Numbers and statuses, until the service ends the stream."""
    headers = {} if last is None else {"Last-Event-ID": str(last)}
    numbers, entries = [], []
    with service.client.stream("GET", f"{address}/events", headers=headers) as answer:
        assert answer.status_code == 200
        assert answer.headers["content-type"].startswith("text/event-stream")
        for line in answer.iter_lines():
            if line.startswith("id: "):
                numbers.append(int(line[4:]))
            elif line.startswith("data: "):
                entries.append(json.loads(line[6:]))
    return list(zip(numbers, entries, strict=True))


def test_a_job_answers_what_its_call_answers_to_the_byte(service: JobService) -> None:
    addresses = [service.post(wanted) for wanted in ANSWERED]
    for wanted, address in zip(ANSWERED, addresses, strict=True):
        assert service.finished(address)["status"] == "successful"
        kept, request = service.client.get(f"{address}/result"), direct(service.client, wanted)
        assert (kept.status_code, request.status_code) == (200, 200)
        assert kept.headers["content-type"] == request.headers["content-type"]
        assert kept.content == request.content


def test_any_question_is_answered_later_for_who_prefers_that(service: JobService) -> None:
    query = {"params": {"pitch": 0.51}}
    later = service.client.get("/collision-time", headers={"Prefer": "wait=5, respond-async"}, **query)
    assert later.status_code == 202
    assert later.headers["preference-applied"] == "respond-async"
    assert later.json()["processID"] == "collision_time"
    address = later.headers["location"]
    assert service.finished(address)["status"] == "successful"
    assert service.client.get(f"{address}/result").content == service.client.get("/collision-time", **query).content


@pytest.mark.parametrize("path", ["/healthz", "/metrics", "/docs", "/page/main.js"])
def test_what_is_no_question_is_answered_at_once(service: JobService, path: str) -> None:
    assert service.client.get(path, headers={"Prefer": "respond-async"}).status_code == 200


def test_head_makes_no_job(service: JobService) -> None:
    assert service.client.head("/collision-time", headers={"Prefer": "respond-async"}).status_code == 200


def test_what_the_client_has_already_needs_no_job(service: JobService) -> None:
    tag = service.client.get("/collision-time").headers["etag"]
    headers = {"Prefer": "respond-async", "If-None-Match": tag}
    assert service.client.get("/collision-time", headers=headers).status_code == 304


@pytest.mark.parametrize(
    ("wanted", "pointer"),
    [
        ({"question": "collision_time", "request": {"pitch": 55}}, "/request/pitch"),
        ({"question": "collision_time", "request": {"pitsh": 0.5}}, "/request/pitsh"),
        ({"question": "collision_time", "request": {"pitch": {"a": 1}}}, "/request/pitch"),
        ({"question": "trajectory", "request": {"dragon": {"width": -1}}}, "/request/dragon/width"),
        ({"question": "trajectory", "accept": "image/gif"}, "/accept"),
        ({"question": "trajectory", "request": {"dragon": {"benches": 10**30}}}, "/request/dragon/benches"),
        ({"question": "collision_tim"}, "/question"),
        ({"request": {}}, "/question"),
        ({"question": "collision_time", "requests": {}}, "/requests"),
    ],
    ids=lambda part: part if isinstance(part, str) else None,
)
def test_what_is_wrong_is_refused_at_once_by_its_place(service: JobService, wanted: Any, pointer: str) -> None:
    answer = service.client.post("/jobs", json=wanted)
    assert answer.status_code in (406, 422)
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["errors"][0]["pointer"] == pointer


def test_a_job_that_fails_answers_the_problem_of_its_call(service: JobService) -> None:
    wanted = {"question": "trajectory", "request": {"times": {"stop": 100, "step": 1e-3}}}
    address, request = service.post(wanted), direct(service.client, wanted)
    status, kept = service.finished(address), service.client.get(f"{address}/result")
    assert status["status"] == "failed"
    assert status["problem"] == request.json()
    assert status["message"] == request.json()["detail"]
    assert kept.status_code == request.status_code == 422
    assert kept.headers["content-type"] == "application/problem+json"
    assert kept.content == request.content


def test_a_large_result_is_sent_in_parts_and_an_odd_range_is_ignored(service: JobService) -> None:
    address = service.post({"question": "trajectory", "request": {"times": {"stop": 90}}})
    service.finished(address)
    whole = service.client.get(f"{address}/result")
    assert len(whole.content) > 1_000_001
    for wanted, status, content in (
        ("bytes=5-9", 206, whole.content[5:10]),
        ("bytes=1000000-", 206, whole.content[1_000_000:]),
        *((odd, 200, whole.content) for odd in ("bytes=5-1", "lines=1-2", "bytes=99999999999-", "bytes=1-2,5-6", "x")),
    ):
        answer = service.client.get(f"{address}/result", headers={"Range": wanted})
        assert (answer.status_code, answer.content == content) == (status, True), wanted


def test_a_player_may_jump_to_another_time_of_a_short_film(service: JobService) -> None:
    film = {"dragon": {"benches": 3}, "path": {"kind": "spiral", "pitch": 0.8}, "height": 90, "seconds": 1}
    address = service.post({"question": "films", "request": film, "accept": "video/mp4"})
    service.finished(address)
    whole = service.client.get(f"{address}/result")
    assert whole.headers["accept-ranges"] == "bytes"
    part = service.client.get(f"{address}/result", headers={"Range": "bytes=5-9"})
    assert (part.status_code, part.content) == (206, whole.content[5:10])


def test_head_of_events_ends_at_once(service: JobService) -> None:
    address = service.post(ENDLESS)
    answer = service.client.head(f"{address}/events", timeout=5.0)
    assert (answer.status_code, answer.content) == (200, b"")
    service.client.delete(address)


@pytest.fixture(scope="module")
def followed(service: JobService) -> tuple[str, list[tuple[int, Any]]]:
    """The address of a job that takes a moment, and its events after the first one, with which a stream broke."""
    address = service.post(SCAN)
    with service.client.stream("GET", f"{address}/events") as answer:
        assert next(line for line in answer.iter_lines() if line.startswith("id: ")) == "id: 1"
    return address, events_of(service, address, last=1)


def test_events_tell_every_change_and_a_stream_that_breaks_is_taken_up_where_it_broke(
    service: JobService, followed: tuple[str, list[tuple[int, Any]]]
) -> None:
    address, after_first = followed
    events = events_of(service, address)
    numbers, statuses = [number for number, _ in events], [status for _, status in events]
    assert numbers == list(range(1, len(events) + 1))
    assert events[1:] == after_first
    assert [status["status"] for status in statuses][:2] == ["accepted", "running"]
    assert statuses[-1]["status"] == "successful"
    assert [status["progress"] for status in statuses] == sorted(status["progress"] for status in statuses)
    assert statuses[-1]["progress"] == 100
    assert events_of(service, address, last=numbers[1]) == events[2:]
    # The word for a browser not to come again.
    after = service.client.get(f"{address}/events", headers={"Last-Event-ID": str(numbers[-1])})
    assert (after.status_code, after.content) == (204, b"")


def test_proposals_come_as_they_are_found_and_stay_in_the_answer_alone(service: JobService) -> None:
    ring = [[0, 0], [24, 0], [24, 20], [0, 20], [0, 0]]
    request = {"venue": {"type": "Polygon", "coordinates": [ring]}, "dragon": {"benches": 10}, "count": 4}
    address = service.post({"question": "proposals", "request": request})
    parts = [status["part"] for _, status in events_of(service, address) if "part" in status]
    answer = service.client.get(f"{address}/result").json()
    assert 1 <= len(parts) <= 5
    figures = [part["figure"] for part in parts]
    assert figures == sorted(figures, key=["ring", "spiral", "eight", "serpentine"].index)[: len(figures)]
    assert any(part in answer["proposals"] for part in parts)
    assert not any("part" in status for _, status in events_of(service, address))


@pytest.mark.parametrize(
    "last", ["9" * 18, "9" * 30, "9" * 5000, "-1", "a"], ids=lambda last: last[:2] + str(len(last))
)
def test_a_number_of_no_event_is_no_mistake_of_the_service(service: JobService, last: str) -> None:
    address = service.post(SHORT)
    service.finished(address)
    assert service.client.get(f"{address}/events", headers={"Last-Event-ID": last}).status_code in (200, 204)


def test_progress_comes_with_a_rate_and_the_time_left(followed: tuple[str, list[tuple[int, Any]]]) -> None:
    between = [status for _, status in followed[1] if status["rate"] is not None]
    assert between
    for status in between:
        left = (100 - status["progress"]) / status["rate"]
        assert 0 <= status["progress"] < 100  # whole percents, rounded down
        assert status["time_left"] == pytest.approx(left, abs=1.5 / status["rate"])


def test_a_dismissed_job_ends_its_process_and_a_second_word_removes_it_wholly(service: JobService) -> None:
    wait_for(lambda: not service.of("child"))
    address = service.post(LONG)
    service.until(address, "running")
    wait_for(lambda: len(service.of("child")) == 1)
    assert service.client.get(f"{address}/result").status_code == 409
    dismissed = service.client.delete(address)
    assert (dismissed.status_code, dismissed.json()["status"]) == (200, "dismissed")
    wait_for(lambda: not service.of("child"))
    assert service.client.get(f"{address}/result").status_code == 410
    assert service.client.delete(address).status_code == 204
    for left in (address, f"{address}/result", f"{address}/events"):
        answer = service.client.get(left)
        assert answer.status_code == 404
        assert answer.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("is_copied", [False, True])
def test_a_removed_job_leaves_no_byte_of_its_call_and_result(service: JobService, is_copied: bool) -> None:
    """is_copied: meanwhile another process copies SQLite's log, as its lock tells."""
    wanted = {"question": "collision_time", "request": {"pitch": 0.512345678901}}
    address = service.post(wanted)
    assert service.finished(address)["status"] == "successful"
    name = address.rpartition("/")[2].encode()

    def has_name(file: Path) -> bool:
        try:
            return name in file.name.encode() + file.read_bytes()
        except (FileNotFoundError, IsADirectoryError):  # a folder, or a file removed just now
            return False

    def kept() -> bool:
        return any(map(has_name, service.folder.rglob("*")))

    assert kept()
    with (service.folder / "jobs.sqlite-shm").open("r+b") as shared:
        if is_copied:
            fcntl.lockf(shared, fcntl.LOCK_EX, 1, CHECKPOINT_LOCK)
            Timer(0.3, fcntl.lockf, (shared, fcntl.LOCK_UN, 1, CHECKPOINT_LOCK)).start()
        assert service.client.delete(address).status_code == 204
        wait_for(lambda: not kept())


def test_nobody_is_shown_the_jobs_of_others(service: JobService) -> None:
    assert service.client.get("/jobs").status_code == 403
    assert service.client.get(f"/jobs/{'a' * 48}").status_code == 404


def test_asking_for_a_job_later_makes_one_job(service: JobService) -> None:
    answer = service.client.post("/jobs", json=SHORT, headers={"Prefer": "respond-async"})
    assert answer.status_code == 202
    assert answer.json()["processID"] == "collision_time"
    service.finished(answer.headers["location"])


def test_other_calls_answer_while_jobs_run(service: JobService) -> None:
    addresses = [service.post(LONG), service.post(LONG)]
    for address in addresses:
        service.until(address, "running")
    assert service.client.get("/healthz").status_code == 200
    # The answer did not wait for their end.
    assert {service.client.get(address).json()["status"] for address in addresses} == {"running"}
    for address in addresses:
        service.client.delete(address)


def test_a_service_that_ends_tells_its_listeners_so(tmp_path: Path) -> None:
    with JobService(tmp_path, workers=1) as service:
        address = service.post(LONG)
        with service.client.stream("GET", f"{address}/events", timeout=PATIENCE) as answer:
            lines = answer.iter_lines()
            assert next(lines)
            started = time.monotonic()
            service.process.terminate()
            for _ in lines:
                pass
        service.process.wait(PATIENCE)
        # A process that waited for a job, or is just starting, ends when it sees that its parent has ended.
        wait_for(lambda: not service.processes(), started + 10.0 - time.monotonic())


def test_a_service_without_a_data_folder_keeps_jobs_while_it_lives(server: str) -> None:
    with httpx.Client(base_url=server, timeout=PATIENCE) as client:
        answer = client.post("/jobs", json=SHORT)
        assert answer.status_code == 202
        address = answer.headers["location"]
        wait_for(lambda: client.get(address).json()["status"] == "successful")
        assert client.get(f"{address}/result").content == direct(client, SHORT).content
        assert client.delete(address).status_code == 204


def test_a_store_that_is_slow_keeps_nobody_else_waiting(service: JobService) -> None:
    """Another process writes to the store; a quick question that is to become a job waits for it, and no one else."""
    with ThreadPoolExecutor(1) as thread:
        with closing(sqlite3.connect(service.folder / "jobs.sqlite", isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            query = {"cross_check": "none", "pitch": 0.52}
            url, headers = f"http://127.0.0.1:{service.port}/collision-time", {"Prefer": "respond-async"}
            later = thread.submit(httpx.get, url, params=query, headers=headers, timeout=PATIENCE)
            time.sleep(HELD)
            assert service.client.get("/healthz", timeout=HELD).status_code == 200
            assert not later.done()
            other.execute("ROLLBACK")
        assert later.result().status_code == 202


def test_many_removals_keep_no_page_waiting(service: JobService) -> None:
    """Another process writes to the store, so that every removal waits: more of them than the service has threads."""
    addresses = [service.post(SHORT) for _ in range(10)]
    for address in addresses:
        service.finished(address)
    many = [f"http://127.0.0.1:{service.port}{address}" for address in addresses for _ in range(6)]
    with ThreadPoolExecutor(len(many)) as threads:
        with closing(sqlite3.connect(service.folder / "jobs.sqlite", isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            removals = [threads.submit(httpx.delete, url, timeout=PATIENCE) for url in many]
            time.sleep(HELD)
            for page in ("/", "/how", "/readyz"):
                assert service.client.get(page).status_code == 200
            assert not any(removal.done() for removal in removals)
            other.execute("ROLLBACK")
        assert {removal.result().status_code for removal in removals} == {204, 404}


SMALL_SWEEP = {"question": "collision_time", "request": {"benches": 20}, "over": {"pitch": [0.5, 0.55]}}
MAKING: dict[str, tuple[str, str, dict[str, Any]]] = {
    "jobs": ("POST", "/jobs", {"json": SHORT}),
    "sweeps": ("POST", "/sweeps", {"json": SMALL_SWEEP}),
    "body": ("POST", "/check", {"json": {"path": {"kind": "spiral"}}, "headers": {"Prefer": "respond-async"}}),
    "query": ("GET", "/minimum-pitch", {"params": {"benches": 30}, "headers": {"Prefer": "respond-async"}}),
}


@pytest.mark.parametrize("kind", MAKING)
def test_many_new_jobs_keep_no_page_waiting(service: JobService, kind: str) -> None:
    """Another process writes to the store, so that every job waits: more of them than the service has threads."""
    method, path, more = MAKING[kind]
    with ThreadPoolExecutor(60) as threads:
        with closing(sqlite3.connect(service.folder / "jobs.sqlite", isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            url = f"http://127.0.0.1:{service.port}{path}"
            asked = [threads.submit(httpx.request, method, url, timeout=PATIENCE, **more) for _ in range(60)]
            time.sleep(HELD)
            for page in ("/", "/how", "/readyz"):
                assert service.client.get(page).status_code == 200
            assert not any(one.done() for one in asked)
            other.execute("ROLLBACK")
        # A client may have so many unfinished jobs.
        assert {one.result().status_code for one in asked} <= {202, 429}


def test_bodies_that_come_slowly_take_no_place_of_those_that_are_there(service: JobService) -> None:
    body = json.dumps(SHORT).encode()
    head = f"POST /jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
    with ExitStack() as stack:
        for _ in range(JOB_CALLS + 1):
            slow = stack.enter_context(socket.create_connection(("127.0.0.1", service.port), timeout=PATIENCE))
            slow.sendall(head.encode() + body[:5])
        assert service.client.post("/jobs", json=SHORT).status_code in (202, 429)
        slow.sendall(body[5:])
        assert slow.recv(12) in (b"HTTP/1.1 202", b"HTTP/1.1 429")

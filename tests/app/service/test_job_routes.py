"""The calls about jobs on the real service: the result equals the direct answer, and waiting clients get events."""

import fcntl
import json
import socket
import sqlite3
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing
from threading import Timer

import httpx
import pytest

from app.service.job_calls import JOB_CALLS
from app.wire.problem import PROBLEM_TYPE
from tests.support.asking import assert_problem, box
from tests.support.depth import few, further
from tests.support.job_service import ENDLESS, PATIENCE, SCAN, SHORT, JobService, direct, wait_for

LATER = {"Prefer": "respond-async"}
# The byte of jobs.sqlite-shm that SQLite locks while it copies the log (https://sqlite.org/walformat.html).
CHECKPOINT_LOCK = 121
# For how long another process writes to the store [s]; a change of it may wait longer.
HELD = 0.5


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    with JobService(tmp_path_factory.mktemp("jobs")) as service:
        yield service


def keeps_no_page_waiting(service, ask):
    """Statuses of many changes of the store, more than the service has threads, while another process writes to it."""
    with ThreadPoolExecutor(60) as threads:
        with closing(sqlite3.connect(service.folder / "jobs.sqlite", isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            changes = [threads.submit(ask, k) for k in range(60)]
            time.sleep(HELD)
            for page in ("/", "/how", "/readyz"):
                assert service.client.get(page).status_code == 200
            assert not any(change.done() for change in changes)
        return {change.result().status_code for change in changes}


def events_of(service, address, last=None):
    """Numbers and statuses, until the service ends the stream."""
    headers = {} if last is None else {"Last-Event-ID": str(last)}
    numbers = []
    entries = []
    with service.client.stream("GET", f"{address}/events", headers=headers) as answer:
        assert answer.status_code == 200
        assert answer.headers["content-type"].startswith("text/event-stream")
        for line in answer.iter_lines():
            if line.startswith("id: "):
                numbers.append(int(line[4:]))
            elif line.startswith("data: "):
                entries.append(json.loads(line[6:]))
    return list(zip(numbers, entries, strict=True))


@pytest.mark.parametrize("path", ["/healthz", "/metrics", "/docs", "/page/main.js"])
def test_what_is_no_question_is_answered_at_once(service, path):
    assert service.client.get(path, headers=LATER).status_code == 200


def test_head_and_what_the_client_has_already_make_no_job(service):
    assert service.client.head("/collision-time", headers=LATER).status_code == 200
    known = LATER | {"If-None-Match": service.client.get("/collision-time").headers["etag"]}
    assert service.client.get("/collision-time", headers=known).status_code == 304


WRONG = {
    '{"question": "collision_time", "request": {"pitch": 55}}': "/request/pitch",
    '{"question": "collision_time", "request": {"pitsh": 0.5}}': "/request/pitsh",
    '{"question": "collision_time", "request": {"pitch": {"a": 1}}}': "/request/pitch",
    '{"question": "trajectory", "request": {"dragon": {"width": -1}}}': "/request/dragon/width",
    '{"question": "trajectory", "accept": "image/gif"}': "/accept",
    '{"question": "trajectory", "request": {"dragon": {"benches": 1000000000000000000000000000000}}}': (
        "/request/dragon/benches"
    ),
    '{"question": "collision_tim"}': "/question",
    '{"request": {}}': "/question",
    '{"question": "collision_time", "requests": {}}': "/requests",
}


@pytest.mark.parametrize("wanted", WRONG)
def test_what_is_wrong_is_refused_at_once_by_its_place(service, wanted):
    answer = service.client.post("/jobs", content=wanted, headers={"Content-Type": "application/json"})
    assert_problem(answer, 406 if "accept" in wanted else 422, WRONG[wanted])


def test_a_job_that_fails_answers_the_problem_of_its_call(service):
    wanted = {"question": "trajectory", "request": {"times": {"stop": 100, "step": 1e-3}}}
    address = service.post(wanted)
    request = direct(service.client, wanted)
    status = service.finished(address)
    kept = service.result(address)
    problem = request.json()
    assert (status["status"], status["problem"], status["message"]) == ("failed", problem, problem["detail"])
    assert (kept.status_code, kept.headers["content-type"], kept.content) == (422, PROBLEM_TYPE, request.content)


def test_a_large_result_is_sent_in_parts_and_an_odd_range_is_ignored(service):
    address = service.done({"question": "trajectory", "request": {"times": {"stop": 90}}})
    whole = service.result(address).content
    assert len(whole) > 1_000_001
    parts = {"bytes=5-9": whole[5:10], "bytes=1000000-": whole[1_000_000:]}
    for wanted in (*parts, "bytes=5-1", "lines=1-2", "bytes=99999999998-99999999999", "bytes=1-2,5-6", "x"):
        answer = service.client.get(f"{address}/result", headers={"Range": wanted})
        assert answer.content == parts.get(wanted, whole), wanted
        assert answer.status_code == (206 if wanted in parts else 200)


def test_head_of_events_ends_at_once(service):
    address = service.post(ENDLESS)
    answer = service.client.head(f"{address}/events")
    assert answer.status_code == 200
    assert answer.content == b""
    service.client.delete(address)


@pytest.fixture(scope="module")
def followed(service):
    """The address of a job that takes a moment, and its events after the first one, with which a stream broke."""
    address = service.post(SCAN)
    with service.client.stream("GET", f"{address}/events") as answer:
        assert "id: 1" in answer.iter_lines()
    return address, events_of(service, address, last=1)


def test_events_tell_every_change_and_a_stream_that_breaks_is_taken_up_where_it_broke(service, followed):
    address, after_first = followed
    events = events_of(service, address)
    numbers, statuses = zip(*events, strict=True)
    assert numbers == tuple(range(1, len(events) + 1))
    assert events[1:] == after_first
    assert events[2:] == events_of(service, address, last=2)
    assert [status["status"] for status in statuses][:2] == ["accepted", "running"]
    progress = [status["progress"] for status in statuses]
    assert (statuses[-1]["status"], progress[-1], progress) == ("successful", 100, sorted(progress))
    # The word for a browser not to come again.
    after = service.client.get(f"{address}/events", headers={"Last-Event-ID": str(numbers[-1])})
    assert after.status_code == 204
    assert after.content == b""


@pytest.mark.thorough
def test_proposals_come_as_they_are_found_and_stay_in_the_answer_alone(service):
    request = {"venue": box(0, 0, 24, 20), "dragon": {"benches": 10}, "count": 4}
    address = service.post({"question": "proposals", "request": request})
    parts = [status["part"] for _, status in events_of(service, address) if "part" in status]
    figures = [part["figure"] for part in parts]
    assert figures == sorted(figures, key=["ring", "spiral", "eight", "serpentine"].index) != []
    assert any(part in service.result(address).json()["proposals"] for part in parts)
    assert not any("part" in status for _, status in events_of(service, address))


def test_a_number_of_no_event_is_no_mistake_of_the_service(service, followed):
    for last in ("9" * 18, "9" * 30, "9" * 5000, "-1", "a"):
        answer = service.client.get(f"{followed[0]}/events", headers={"Last-Event-ID": last})
        assert answer.status_code in (200, 204), last[:9]


def test_a_dismissed_job_ends_its_process_and_a_second_word_removes_it_wholly(service):
    wait_for(lambda: not service.of("child"))
    address = service.post(ENDLESS)
    wait_for(lambda: len(service.of("child")) == 1)
    assert service.result(address).status_code == 409
    dismissed = service.client.delete(address)
    assert dismissed.status_code == 200
    assert dismissed.json()["status"] == "dismissed"
    wait_for(lambda: not service.of("child"))
    assert service.result(address).status_code == 410
    assert service.client.delete(address).status_code == 204
    assert {service.client.get(address + left).status_code for left in ("", "/result", "/events")} == {404}


@pytest.mark.parametrize("is_copied", further([False, True], 1))
def test_a_removed_job_leaves_no_byte_of_its_call_and_result(service, is_copied):
    """is_copied: meanwhile another process copies SQLite's log, as its lock tells."""
    address = service.post({"question": "collision_time", "request": {"pitch": 0.512345678901}})
    assert service.finished(address)["status"] == "successful"
    name = address.rpartition("/")[2].encode()

    def has_name(file):
        try:
            return name in file.name.encode() + file.read_bytes()
        except (FileNotFoundError, IsADirectoryError):  # a folder, or a file removed just now
            return False

    def kept():
        return any(map(has_name, service.folder.rglob("*")))

    assert kept()
    with (service.folder / "jobs.sqlite-shm").open("r+b") as shared:
        if is_copied:
            fcntl.lockf(shared, fcntl.LOCK_EX, 1, CHECKPOINT_LOCK)
            Timer(0.3, fcntl.lockf, (shared, fcntl.LOCK_UN, 1, CHECKPOINT_LOCK)).start()
        assert service.client.delete(address).status_code == 204
        wait_for(lambda: not kept())


def test_nobody_is_shown_the_jobs_of_others(service):
    assert service.client.get("/jobs").status_code == 403
    assert service.client.get(f"/jobs/{'a' * 48}").status_code == 404


@pytest.mark.thorough
def test_a_service_that_ends_tells_its_listeners_so(tmp_path):
    with JobService(tmp_path) as service:
        address = service.post(ENDLESS)
        with service.client.stream("GET", f"{address}/events", timeout=PATIENCE) as answer:
            lines = answer.iter_lines()
            assert next(lines)
            service.process.terminate()
            for _ in lines:
                pass
        service.process.wait(PATIENCE)
        # A process that waited for a job, or is just starting, ends when it sees that its parent has ended.
        wait_for(lambda: not service.processes())


SMALL_SWEEP = {"question": "collision_time", "request": {"benches": 20}, "over": {"pitch": [0.5, 0.55]}}
MAKING = {
    "POST /jobs": {"json": SHORT},
    "POST /sweeps": {"json": SMALL_SWEEP},
    "POST /check": {"json": {"path": {"kind": "spiral"}}, "headers": LATER},
    "GET /collision-time": {"params": {"cross_check": "none", "pitch": 0.52}, "headers": LATER},
}


@pytest.mark.parametrize("call", few([*MAKING], 1))
def test_many_new_jobs_keep_no_page_waiting(service, call):
    method, path = call.split()
    url = f"http://127.0.0.1:{service.port}{path}"
    statuses = keeps_no_page_waiting(service, lambda k: httpx.request(method, url, timeout=PATIENCE, **MAKING[call]))
    assert statuses <= {202, 429}  # A client may have so many unfinished jobs.


def test_bodies_that_come_slowly_take_no_place_of_those_that_are_there(service):
    body = json.dumps(SHORT).encode()
    head = f"POST /jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
    with ExitStack() as stack:
        for _ in range(JOB_CALLS + 1):
            slow = stack.enter_context(socket.create_connection(("127.0.0.1", service.port), timeout=PATIENCE))
            slow.sendall(head.encode() + body[:5])
        assert service.client.post("/jobs", json=SHORT).status_code in (202, 429)
        slow.sendall(body[5:])
        assert slow.recv(12) in (b"HTTP/1.1 202", b"HTTP/1.1 429")

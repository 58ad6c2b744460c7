"""Attacks: requests that once took the service down, each a function of its address; and a client that watches."""

from __future__ import annotations

import http.client
import json
import os
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from urllib.parse import urlencode, urlsplit

from app.files.tables import CSV_TYPE, XLSX_TYPE
from tests.support.bombs import GRADES, MAPS

Attack = Callable[[str, float], None]  # base URL and how long to go on [s]
ATTACKS: dict[str, Attack] = {}
# Longest wait for a short job beside long ones [s].
JOB_SECONDS = 20.0
# An error is short [bytes].
ERROR_BYTES = 20_000


def attack(result: Attack) -> Attack:
    ATTACKS[result.__name__] = result
    return result


def ask(
    url: str,
    method: str,
    path: str,
    body: bytes | None = None,
    timeout: float = 30.0,
    accept: str = "*/*",
    kind: str = "application/json",
    client: str = "",
    host: str = "",
) -> tuple[int, bytes]:
    """Status and body of one answer. client: the address from which to ask; host: another one than that of the URL"""
    place = (client, 0) if client else None
    connection = http.client.HTTPConnection(urlsplit(url).netloc, timeout=timeout, source_address=place)
    try:
        headers = {"Accept": accept} | ({"Host": host} if host else {})
        connection.request(method, path, body, headers | ({"Content-Type": kind} if body is not None else {}))
        response = connection.getresponse()
        return response.status, response.read()
    finally:
        connection.close()


def ask_and_leave(url: str, path: str, stay: float) -> None:
    """A client that hangs up after a while, whether it was answered or not."""
    with suppress(OSError):
        ask(url, "GET", path, timeout=stay)


def at_once(jobs: list[Callable[[], object]]) -> None:
    """Run each job in a thread of its own. A job may get no answer: the watching client reports what it sees."""

    def without_answer(job: Callable[[], object]) -> None:
        with suppress(OSError):
            job()

    threads = [threading.Thread(target=without_answer, args=(job,), daemon=True) for job in jobs]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def _many(url: str, path: str, count: int, stay: float) -> None:
    at_once([lambda: ask_and_leave(url, path, stay)] * count)


@attack
def heavy_speeds(url: str, seconds: float) -> None:
    """114 s of work each, their clients gone before the end."""
    query = {"benches": 2000, "pitch": 10, "start_turns": 200, "turning_diameter": 200}
    _many(url, "/maximum-head-speed?" + urlencode(query), 40, seconds)


@attack
def long_thin_dragon(url: str, seconds: float) -> None:
    query = {"benches": 6308, "body_length": 0.001, "head_length": 0.001, "overhang": 0}
    _many(url, "/minimum-pitch?" + urlencode(query), 8, seconds)


@attack
def equal_arcs(url: str, seconds: float) -> None:
    _many(url, "/shortest-turn?head_length=1.001&ratio=1", 8, seconds)


@attack
def uneven_dragons(url: str, seconds: float) -> None:
    """Half a minute of work each: 2,000 different benches through a turn."""
    dragon = {
        "lengths": [2.2 + 0.001 * (k % 97) for k in range(2000)],
        "widths": [0.3] * 2000,
        "overhangs": [0.275] * 2000,
    }
    body = json.dumps({"dragon": dragon, "path": {"kind": "turn"}}).encode()
    at_once([lambda: ask(url, "POST", "/check", body, timeout=seconds)] * 8)


@attack
def near_grazes(url: str, seconds: float) -> None:
    """A tenth of a second each, where a millisecond is expected: two benches pass within 1e-9 m of each other."""
    paths = (f"/collision-time?cross_check=pair&pitch={0.45033739302 + 1e-13 * k:.17g}" for k in range(40))
    at_once([lambda path=path: ask(url, "GET", path, timeout=seconds) for path in paths])


@attack
def polygon_of_holes(url: str, seconds: float) -> None:
    """140,000 rings of four points, 3.6 MB."""
    ring = [[0, 0], [1, 0], [0, 1], [0, 0]]
    venue = {
        "type": "FeatureCollection",
        "features": [
            {
                "type": "Feature",
                "properties": {"kind": "area"},
                "geometry": {"type": "Polygon", "coordinates": [ring] * 140_000},
            }
        ],
    }
    ask_once(url, "/check", json.dumps({"venue": venue}, separators=(",", ":")).encode(), seconds)


def ask_once(url: str, path: str, body: bytes, seconds: float) -> None:
    """One request with a body, which must be refused or answered."""
    status, answer = ask(url, "POST", path, body, timeout=max(seconds, 20.0))
    assert status in (200, 400, 413, 422, 503), (status, answer[:300])
    assert status == 200 or len(answer) < ERROR_BYTES


@attack
def names_twice(url: str, seconds: float) -> None:
    query = "&".join(f"n{k}=1&n{k}=1" for k in range(5_500))
    status, answer = ask(url, "GET", f"/collision-time?{query}")
    assert 400 <= status < 500
    assert len(answer) < ERROR_BYTES


@attack
def deep_brackets(url: str, seconds: float) -> None:
    ask_once(url, "/trajectory", b'{"path": {"kind": [' + b"[]," * 1_330_000 + b"[]]}}", seconds)


@attack
def tiny_chunks(url: str, seconds: float) -> None:
    """200,000 chunks of one byte."""
    with socket.create_connection((urlsplit(url).hostname or "", urlsplit(url).port or 80), timeout=30.0) as peer:
        head = f"POST /trajectory HTTP/1.1\r\nHost: {urlsplit(url).netloc}\r\nContent-Type: application/json\r\n"
        with suppress(OSError):
            peer.sendall(
                (head + "Transfer-Encoding: chunked\r\n\r\n").encode() + b"1\r\n \r\n" * 200_000 + b"0\r\n\r\n"
            )
            peer.recv(65536)


@attack
def large_csv(url: str, seconds: float) -> None:
    """Tables of a million cells, eight at once for each second, and 24 at most."""
    tables(url, min(round(8 * seconds), 24), CSV_TYPE)


def tables(url: str, count: int, accept: str) -> None:
    """`count` tables of a million cells at once."""
    body = json.dumps({"times": {"start": 0, "stop": 400, "step": 0.09}}).encode()
    at_once([lambda: ask(url, "POST", "/trajectory", body, timeout=60.0, accept=accept)] * count)


@attack
def workbooks(url: str, seconds: float) -> None:
    """A second of pure Python each."""
    at_once([lambda: ask(url, "POST", "/trajectory", b"{}", timeout=60.0, accept=XLSX_TYPE)] * 8)


@attack
def files_to_grade(url: str, seconds: float) -> None:
    """Texts of 20 MB, each read by Python code for a second."""
    text = b"word " * 3_999_000
    kind = "application/octet-stream"
    at_once([lambda: ask(url, "POST", "/grade", text, timeout=60.0, kind=kind)] * 4)


@attack
def files_that_unfold(url: str, seconds: float) -> None:
    """Archives, drawings and texts of a few bytes to 20 MB that would take gigabytes, or minutes."""
    kind = "application/octet-stream"
    some = [("/places", MAPS[name]) for name in ("bzip2", "deflated_that_lies", "arc_of_dxf", "brackets_of_json")]
    some += [("/grade", GRADES[name]) for name in ("workbook_that_lies", "attributes")]
    at_once(
        [lambda path=path, made=made: ask(url, "POST", path, made(), timeout=60.0, kind=kind) for path, made in some]
    )


@attack
def long_names(url: str, seconds: float) -> None:
    """A name of a million characters for a figure."""
    ring = [[0, 0], [30, 0], [30, 30], [0, 0]]
    venue = {
        "type": "Feature",
        "properties": {"name": "x" * 10**6},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    ask_once(url, "/figures/trajectory.svg", json.dumps({"venue": venue}).encode(), seconds)


@attack
def half_open(url: str, seconds: float) -> None:
    """200 connections that never send a whole request."""
    peers = []
    try:
        for _ in range(200):
            peer = socket.create_connection((urlsplit(url).hostname or "", urlsplit(url).port or 80), timeout=10.0)
            peer.sendall(b"GET /healthz HTTP/1.1\r\nX-Slow: ")
            peers.append(peer)
        time.sleep(seconds)
    finally:
        for peer in peers:
            peer.close()


def make_job(url: str, wanted: object, client: str) -> str:
    """Address of a new job of a client; empty if there is no room."""
    status, answer = ask(url, "POST", "/jobs", json.dumps(wanted).encode(), client=client)
    assert status in (202, 429, 503), (status, answer[:300])
    return f"/jobs/{json.loads(answer)['jobID']}" if status == http.client.ACCEPTED else ""


@attack
def full_store(url: str, seconds: float) -> None:
    """A client that makes small jobs as long as it may; another one must still get its answer, and keep it."""
    end, wanted = time.monotonic() + seconds, {"question": "turn", "request": {}}
    theirs = make_job(url, wanted, "127.0.0.8")
    while time.monotonic() < end:
        if not make_job(url, wanted, "127.0.0.7"):
            time.sleep(0.05)  # Its jobs wait for one another.
    answered(url, theirs, "127.0.0.8")
    assert make_job(url, wanted, "127.0.0.9")


@attack
def long_jobs(url: str, seconds: float) -> None:
    """Eight jobs of minutes each, and a short one of another client, which must be answered meanwhile."""
    endless = {"benches": 6308, "head_length": 0.001, "body_length": 0.001, "overhang": 0.0}
    wanted = {"question": "minimum_pitch", "request": endless}
    made = [make_job(url, wanted, "127.0.0.7") for _ in range(8)]
    try:
        answered(url, make_job(url, {"question": "turn", "request": {}}, "127.0.0.8"), "127.0.0.8")
        time.sleep(min(seconds, 2.0))
    finally:
        for job in filter(None, made):
            ask(url, "DELETE", job, client="127.0.0.7")


def answered(url: str, job: str, client: str) -> None:
    """Wait until a job has its answer, for JOB_SECONDS at most."""
    end = time.monotonic() + JOB_SECONDS
    while (status := ask(url, "GET", f"{job}/result", client=client)[0]) != http.client.OK:
        assert status == http.client.CONFLICT, (job, status)
        assert time.monotonic() < end, f"{job} was not answered within {JOB_SECONDS} s"
        time.sleep(0.05)


@attack
def strange_hosts(url: str, seconds: float) -> None:
    """Names of hosts that are long, odd or of somebody else; a service that knows its names refuses them."""
    for host in ("evil.example", "a" * 30_000, "localhost@evil.example", "[::1", "%00", "dance.example:99999999", "*"):
        for path in ("/turn", "/nothing", "/jobs"):
            status, answer = ask(url, "GET", path, host=host)
            assert status in (200, 400, 403, 404, 421), (host[:50], status)
            assert status == http.client.OK or len(answer) < ERROR_BYTES


@dataclass
class Watch:
    """Observations of another client: the slowest answers [s], and the bad ones."""

    slowest: dict[str, float] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)
    sent: int = 0


@contextmanager
def watching(url: str, paths: tuple[str, ...] = ("/healthz", "/collision-time")) -> Iterator[Watch]:
    """A client that asks each path every 50 ms until the block ends."""
    watch, done = Watch(), threading.Event()

    def look(path: str) -> None:
        request = 0
        while not done.wait(0.05) or not request:
            request += 1
            query = f"?pitch={0.55 + 1e-9 * request:.9f}&cross_check=pair" if path == "/collision-time" else ""
            started = time.perf_counter()
            try:
                status, answer = ask(url, "GET", path + query)
            except OSError as error:
                status, answer = 0, str(error).encode()
            seconds = time.perf_counter() - started
            watch.slowest[path] = max(seconds, watch.slowest.get(path, 0.0))
            watch.sent += 1
            if status != http.client.OK:
                watch.failures.append(f"{path} {status} {answer[:200]!r}")

    threads = [threading.Thread(target=look, args=(path,), daemon=True) for path in paths]
    for thread in threads:
        thread.start()
    try:
        yield watch
    finally:
        done.set()
        for thread in threads:
            thread.join()


def memory(pid: int) -> float:
    """Resident memory of a process and its children [MB]."""
    with open(f"/proc/{pid}/task/{pid}/children") as result:
        children = [int(child) for child in result.read().split()]
    with open(f"/proc/{pid}/statm") as pages:
        own = int(pages.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
    return own + sum(memory(child) for child in children)

"""Attacks: requests that once took the service down, each a function of its address; and a client that watches."""

import http.client
import json
import threading
import time
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from socket import create_connection
from urllib.parse import urlencode, urlsplit

import psutil

from app.files.tables import CSV_TYPE, XLSX_TYPE
from app.questions.registry import CALLS
from tests.support.bombs import GRADES, MAPS
from tests.support.largest import LARGEST, THIN

# Longest wait for a short job beside long ones [s].
JOB_SECONDS = 20.0
# An error is short [bytes].
ERROR_BYTES = 20_000
FILE = "application/octet-stream"
PATIENCE = 60.0  # [s] of a client that waits for its answer


def ask(url, method, path, body=None, timeout=30.0, accept="*/*", kind="application/json", client="", host=""):
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


def at_once(jobs):
    """Run each job in a thread of its own. A job may get no answer: the watching client reports what it sees."""

    def without_answer(job):
        with suppress(OSError):
            job()

    threads = [threading.Thread(target=without_answer, args=(job,), daemon=True) for job in jobs]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def crowd(count, path, url, seconds, body=None, stay=0.0, **more):
    """Clients that hang up after `stay`, or with the attack, whether they were answered or not."""
    call = ("POST", path, body()) if body else ("GET", path, None)
    at_once([lambda: ask(url, *call, timeout=stay or seconds, **more)] * count)


def once(path, body, url, seconds):
    """One request, which must be refused or answered."""
    status, answer = ask(url, "POST" if body else "GET", path, body and body(), max(seconds, 20.0))
    assert status in (200, 400, 413, 414, 422, 503), (status, answer[:300])
    assert status == http.client.OK or len(answer) < ERROR_BYTES


def near_grazes(url, seconds):
    """A tenth of a second each, where a millisecond is expected: two benches pass within 1e-9 m of each other."""
    paths = (f"/collision-time?cross_check=pair&pitch={0.45033739302 + 1e-13 * k:.17g}" for k in range(40))
    at_once([partial(ask, url, "GET", path, timeout=seconds) for path in paths])


def polygon(rings, **properties):
    """A body with a venue. rings: number of its rings of four points"""
    geometry = {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]] * rings}
    venue = {"type": "Feature", "properties": {"kind": "area", **properties}, "geometry": geometry}
    return json.dumps({"venue": venue}, separators=(",", ":")).encode()


def deep_brackets():
    return b'{"path": {"kind": [' + b"[]," * 1_330_000 + b"[]]}}"


def message_of_brackets():
    """A message of an assistant, of 3.9 MB."""
    call = b'{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{"name":"turn","arguments":{"x":[%s]}}}'
    return call % (b"[]," * 1_300_000 + b"[]")


def text():
    """20 MB, read by Python code for a second."""
    return b"word " * 3_999_000


def connect(stack, url, sent):
    """A connection that has sent this, and stays open."""
    peer = stack.enter_context(create_connection((urlsplit(url).hostname or "", urlsplit(url).port or 80), 30.0))
    with suppress(OSError):
        peer.sendall(sent)


def tiny_chunks(url, seconds):
    """200,000 chunks of one byte."""
    head = (
        b"POST /trajectory HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n"
    )
    with ExitStack() as stack:
        connect(stack, url, head + b"1\r\n \r\n" * 200_000 + b"0\r\n\r\n")


def half_open(url, seconds):
    """200 connections that never send a whole request."""
    with ExitStack() as stack:
        for _ in range(200):
            connect(stack, url, b"GET /healthz HTTP/1.1\r\nX-Slow: ")
        time.sleep(seconds)


def large_csv(url, seconds):
    """Tables of a million cells, eight at once for each second, and 24 at most."""
    tables(url, min(round(8 * seconds), 24), CSV_TYPE)


def million_cells():
    return b'{"times": {"start": 0, "stop": 400, "step": 0.09}}'


def tables(url, count, accept):
    """`count` tables of a million cells at once."""
    crowd(count, "/trajectory", url, 0.0, million_cells, PATIENCE, accept=accept)


def files_that_unfold(url, seconds):
    """Archives, drawings and texts of a few bytes to 20 MB that would take gigabytes, or minutes."""
    some = [("/places", MAPS[name]) for name in ("bzip2", "deflated_that_lies", "arc_of_dxf", "brackets_of_json")]
    some += [("/grade", GRADES[name]) for name in ("workbook_that_lies", "attributes")]
    at_once([partial(crowd, 1, path, url, seconds, made, PATIENCE, kind=FILE) for path, made in some])


def make_job(url, wanted, client):
    """Address of a new job of a client; empty if there is no room."""
    status, answer = ask(url, "POST", "/jobs", json.dumps(wanted).encode(), client=client)
    assert status in (202, 429, 503), (status, answer[:300])
    return f"/jobs/{json.loads(answer)['jobID']}" if status == http.client.ACCEPTED else ""


SMALL = {"question": "turn", "request": {}}
MINE = "127.0.0.7"
THEIRS = "127.0.0.8"


def full_store(url, seconds):
    """A client that makes small jobs as long as it may; another one must still get its answer, and keep it."""
    end = time.monotonic() + seconds
    theirs = make_job(url, SMALL, THEIRS)
    while time.monotonic() < end:
        if not make_job(url, SMALL, MINE):
            time.sleep(0.05)  # Its jobs wait for one another.
    wait_for_answer(url, theirs, THEIRS)
    assert make_job(url, SMALL, "127.0.0.9")


def long_jobs(url, seconds):
    """Eight jobs of minutes each, and a short one of another client, which must be answered meanwhile."""
    made = [make_job(url, {"question": "minimum_pitch", "request": THIN}, MINE) for _ in range(8)]
    try:
        wait_for_answer(url, make_job(url, SMALL, THEIRS), THEIRS)
        time.sleep(min(seconds, 2.0))
    finally:
        for job in filter(None, made):
            ask(url, "DELETE", job, client=MINE)


def wait_for_answer(url, job, client):
    """Wait until a job has its answer, for JOB_SECONDS at most."""
    end = time.monotonic() + JOB_SECONDS
    while (status := ask(url, "GET", f"{job}/result", client=client)[0]) != http.client.OK:
        assert status == http.client.CONFLICT, (job, status)
        assert time.monotonic() < end, f"{job} was not answered within {JOB_SECONDS} s"
        time.sleep(0.05)


def strange_hosts(url, seconds):
    """Names of hosts that are long, odd or of somebody else; a service that knows its names refuses them."""
    for host in ("evil.example", "a" * 30_000, "localhost@evil.example", "[::1", "%00", "dance.example:99999999", "*"):
        for path in ("/turn", "/nothing", "/jobs"):
            status, answer = ask(url, "GET", path, host=host)
            assert status in (200, 400, 403, 404, 421), (host[:50], status)
            assert status == http.client.OK or len(answer) < ERROR_BYTES


def largest_input(name, client=""):
    """A call at its largest input, from an address: a function of the service's URL."""
    call = CALLS[name]
    request = LARGEST[name]
    path = call.question.path.replace("{format}", next(iter(call.question.formats or ("",))))
    if call.method == "GET":
        return lambda url: ask(url, "GET", f"{path}?{urlencode(request)}", timeout=PATIENCE, client=client)
    return lambda url: ask(url, "POST", path, json.dumps(request).encode(), timeout=PATIENCE, client=client)


def largest_inputs(url, seconds):
    """Each call at its largest input, all at once."""
    at_once([partial(largest_input(name), url) for name in LARGEST])


def ten_at_once(url, name):
    """Ten clients ask for the largest input of a call."""
    at_once([partial(largest_input(name, f"127.0.0.{10 + k}"), url) for k in range(10)])


ATTACKS = {
    "long_thin_dragon": partial(crowd, 8, "/minimum-pitch?benches=6308&body_length=0.001&head_length=0.001&overhang=0"),
    "near_grazes": near_grazes,
    "polygon_of_holes": partial(once, "/check", partial(polygon, 140_000)),
    "names_twice": partial(once, "/collision-time?" + "&".join(f"n{k}=1&n{k}=1" for k in range(5_500)), None),
    "deep_brackets": partial(once, "/trajectory", deep_brackets),
    "messages": partial(crowd, 16, "/mcp", body=message_of_brackets, stay=PATIENCE),
    "tiny_chunks": tiny_chunks,
    "large_csv": large_csv,
    # A second of pure Python each.
    "workbooks": partial(crowd, 8, "/trajectory", body=partial(bytes, b"{}"), stay=PATIENCE, accept=XLSX_TYPE),
    "files_to_grade": partial(crowd, 4, "/grade", body=text, stay=PATIENCE, kind=FILE),
    "files_that_unfold": files_that_unfold,
    "long_names": partial(once, "/figures/trajectory.svg", partial(polygon, 1, name="x" * 10**6)),
    "half_open": half_open,
    "full_store": full_store,
    "long_jobs": long_jobs,
    "strange_hosts": strange_hosts,
    "largest_inputs": largest_inputs,
}


@dataclass
class Watch:
    """Observations of another client: the slowest answers [s], and the bad ones."""

    slowest: dict[str, float] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)
    sent: int = 0


@contextmanager
def watching(url, paths=("/healthz", "/collision-time"), pid=None):
    """A client that asks each path every 50 ms until the block ends.

    pid: of the service's process: of a wait counts at most its own work, so that other programs keep nobody waiting
    """
    watch = Watch()
    done = threading.Event()
    own = psutil.Process(pid) if pid else None

    def times():
        return [time.perf_counter(), *([sum(own.cpu_times()[:2])] if own else [])]

    def look(path):
        request = 0
        while not done.wait(0.05) or not request:
            request += 1
            query = f"?pitch={0.55 + 1e-9 * request:.9f}&cross_check=pair" if path == "/collision-time" else ""
            started = times()
            try:
                status, answer = ask(url, "GET", path + query)
            except OSError as error:
                status = 0
                answer = str(error).encode()
            waited = min(after - before for before, after in zip(started, times(), strict=True))
            watch.slowest[path] = max(waited, watch.slowest.get(path, 0.0))
            watch.sent += 1
            if status != http.client.OK:
                watch.failures.append(f"{path} {status} {answer[:200]!r}")

    watcher = threading.Thread(target=lambda: at_once([partial(look, path) for path in paths]), daemon=True)
    watcher.start()
    try:
        yield watch
    finally:
        done.set()
        watcher.join()


def memory(pid):
    """Resident memory of a process and its children [MB]."""
    parent = psutil.Process(pid)
    return sum(process.memory_info().rss for process in (parent, *parent.children(recursive=True))) / 1e6

"""The service with bad HTTP, slow clients, full lanes, signals and a full disk, over real sockets."""

from __future__ import annotations

import json
import os
import re
import resource
import shutil
import signal
import socket
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from html import escape
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import httpx
import pytest

from app.files.tables import CSV_TYPE
from tests.app.conftest import ANSWER_TIMEOUT
from tests.support.depth import some
from tests.support.serving import Service, serving

HEAD_SECONDS, GRACE_SECONDS = 0.5, 1
# Longest wait for what should come within the times above on a busy machine [s].
SOON = 15.0
# Seconds of compiled work that nothing stops: under the limits, and refused to a second client.
HEAVY = "/minimum-pitch?benches=6308&body_length=0.001&head_length=0.001&overhang=0"
SQUARE = {"type": "Polygon", "coordinates": [[[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]]]}
PROBLEM = "application/problem+json"
# Default of deadline_seconds: a computation that blocks a place is over then [s].
DEADLINE = 10


@pytest.fixture(scope="module")
def held(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A service with short times and few places, and a log in JSON."""
    log = tmp_path_factory.mktemp("held") / "server.log"
    settings = {"head_seconds": HEAD_SECONDS, "body_seconds": HEAD_SECONDS, "stalled_seconds": HEAD_SECONDS}
    settings |= {"heavy_max": 2, "heavy_client_max": 1, "grace_seconds": GRACE_SECONDS}
    with serving(log, log_json=True, **settings) as service:
        yield service


def send(service: Service, sent: bytes) -> bytes:
    """All that the service answers until it closes the connection; fails if it keeps it for long."""
    with socket.create_connection(service.address, timeout=SOON) as peer:
        peer.sendall(sent)
        return b"".join(iter(lambda: peer.recv(65536), b""))


def until(result: Callable[[], bool]) -> None:
    end = time.monotonic() + SOON
    while not result():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_an_upgrade_is_answered_like_any_other_request(held: Service) -> None:
    upgrade = b"Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    key = b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
    answer = send(held, b"GET /nothing HTTP/1.1\r\nHost: x\r\n" + upgrade + key)
    assert answer.startswith(b"HTTP/1.1 404 ")
    assert b"nosniff" in answer
    assert PROBLEM.encode() in answer


def test_a_head_that_never_ends_is_answered_408(held: Service) -> None:
    begun = [b"", b"GET /healthz HTTP/1.1\r\nX-Slow: ", b"GET"]
    with ThreadPoolExecutor() as clients:  # at once: the service waits for each by itself
        answers = list(clients.map(partial(send, held), begun))
    assert [answer[:13] for answer in answers] == [b"HTTP/1.1 408 "] * len(begun)


def test_a_body_that_never_ends_loses_its_connection(held: Service) -> None:
    sent = b"POST /trajectory HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 9\r\n\r\n{"
    with suppress(ConnectionResetError):
        assert send(held, sent) == b""


def test_a_body_that_its_client_breaks_off_or_garbles_is_no_error_of_the_service(held: Service) -> None:
    head = b"POST /shortest-turn HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    with socket.create_connection(held.address, timeout=SOON) as peer:
        peer.sendall(head + b"Content-Length: 9\r\n\r\n{")
    assert send(held, head + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n").startswith(b"HTTP/1.1 400 ")
    until(lambda: 'requests_total{path="/shortest-turn",status="400"} 2.0' in httpx.get(f"{held.url}/metrics").text)
    assert 'path="/shortest-turn",status="500"' not in httpx.get(f"{held.url}/metrics").text
    assert "/shortest-turn failed" not in held.log.read_text()


def test_a_client_that_takes_nothing_of_its_answer_loses_its_connection(held: Service) -> None:
    body = json.dumps({"times": {"stop": 400, "step": 0.1}}).encode()
    head = "POST /trajectory HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    whole, taken = int(1e7), 0
    with socket.create_connection(held.address, timeout=SOON) as peer:
        peer.sendall(head.encode() + f"Content-Length: {len(body)}\r\n\r\n".encode() + body)
        peer.recv(1)
        time.sleep(4 * HEAD_SECONDS)
        with suppress(ConnectionResetError):
            while block := peer.recv(1 << 20):  # Fails by the time-out of the socket if the service waits on.
                taken += len(block)
    assert taken < whole


def test_a_connection_may_rest_between_requests(held: Service) -> None:
    with httpx.Client(base_url=held.url) as client:
        assert client.get("/healthz").status_code == 200
        time.sleep(2 * HEAD_SECONDS)
        assert client.get("/healthz").status_code == 200


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"nonsense\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\n\r\n", 400),
        (b"POST /overlaps HTTP/1.1\r\nHost: x\r\nContent-Length: 2, 3\r\nConnection: close\r\n\r\n{}", 400),
        (
            b"POST /turn HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
            400,
        ),
        (b"GET /turn?" + b"a=1&" * 4_000 + b" HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", 414),
    ],
    ids=["no HTTP", "no host", "two lengths", "length and chunks", "long query"],
)
def test_malformed_http_is_a_problem(held: Service, sent: bytes, status: int) -> None:
    head, _, body = send(held, sent).partition(b"\r\n\r\n")
    assert head.startswith(f"HTTP/1.1 {status} ".encode())
    assert PROBLEM.encode() in head
    assert head.lower().count(b"x-content-type-options: nosniff") == 1
    assert json.loads(body)["status"] == status


@pytest.mark.parametrize(
    ("target", "path", "status"),
    [
        ("http://service:80/healthz", "/healthz", 200),
        ("HTTPS://service/turn?pitch=1.7", "/turn?pitch=1.7", 200),
        ("http://service", "/", 200),
        ("http://service/paper%2F", "/paper%2F", 404),
        ("http:///healthz", "http:///healthz", 404),
    ],
)
def test_a_target_in_absolute_form_is_that_in_origin_form(held: Service, target: str, path: str, status: int) -> None:
    values = [
        send(held, f"GET {one} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n".encode()) for one in (target, path)
    ]
    heads, bodies = zip(*(one.split(b"\r\n\r\n", 1) for one in values), strict=True)
    assert heads[0].startswith(f"HTTP/1.1 {status} ".encode())
    assert bodies[0] == bodies[1]


@pytest.mark.parametrize("workers", [1, 2])
def test_who_asks_for_another_host_is_refused_where_a_setting_names_the_hosts(tmp_path: Path, workers: int) -> None:
    """A stranger's page can give its own name the address of this machine: its requests come under that name."""
    with serving(tmp_path / "log", workers, hosts="Dance.Example., 192.0.2.7,[2001:db8::7]", token="secret") as service:
        port = service.address[1]

        def status(path: str, host: str | None, target: str = "") -> int:
            line = "" if host is None else f"Host: {host}\r\n"
            kind = "1.0" if host is None else "1.1"
            answer = send(service, f"GET {target}{path} HTTP/{kind}\r\n{line}Connection: close\r\n\r\n".encode())
            head, _, body = answer.partition(b"\r\n\r\n")
            if b" 421 " in head[:20]:
                assert PROBLEM.encode() in head
                assert head.lower().count(b"x-content-type-options: nosniff") == 1
                assert json.loads(body)["errors"][0]["name"] == "Host"
            return int(head.split()[1])

        ours = ("dance.example", f"DANCE.example.:{port}", "192.0.2.7", f"192.0.2.7:{port}", "[2001:db8::7]:80")
        assert {status(path, host) for host in ours for path in ("/", "/turn", "/docs")} == {200}
        strangers = ("evil.example", f"127.0.0.1:{port}", "localhost", "dance.example.evil.example", "x.dance.example")
        strangers += ("dance.example:x", "dance.example@evil.example", "192.0.2.70", "[2001:db8::71]", "", None)
        for path in ("/", "/turn", "/metrics", "/docs", "/openapi.json", "/page/main.js", "/jobs", "/nothing"):
            assert {status(path, host) for host in strangers} <= {421, 400}, path
        assert status("/turn", "evil.example") == status("/turn", None) == 421
        # Probes come by any address.
        assert {status(path, f"127.0.0.1:{port}") for path in ("/healthz", "/readyz")} == {200}
        # The host of a target in absolute form counts, not the header.
        assert status("/turn", "dance.example", "http://evil.example") == 421
        assert status("/turn", "evil.example", f"http://dance.example:{port}") == 200


def test_without_the_setting_any_host_is_served(held: Service) -> None:
    answer = send(held, b"GET /turn HTTP/1.1\r\nHost: anything.example\r\nConnection: close\r\n\r\n")
    assert answer.startswith(b"HTTP/1.1 200 ")


@pytest.mark.parametrize(
    "body", [b'{"\\ud800":1}', b'{"dragon":{"a\\u0000":1}}', b'{"path":{"kind":"\\udc00"}}', b'["\\u0000"]']
)
@pytest.mark.parametrize("path", ["/trajectory", "/check", "/overlaps", "/figures/trajectory.svg"])
def test_half_a_character_or_nul_is_refused(held: Service, path: str, body: bytes) -> None:
    answer = httpx.post(held.url + path, content=body, headers={"Content-Type": "application/json"})
    assert (answer.status_code, answer.headers["content-type"]) == (422, PROBLEM)


@pytest.mark.parametrize("name", ["a$\\frac{$", "$$", "<&>", "龙", "_^{}"])
def test_a_name_is_drawn_as_it_is(held: Service, name: str) -> None:
    venue = {"type": "Feature", "properties": {"name": name}, "geometry": SQUARE}
    answer = httpx.post(f"{held.url}/figures/trajectory.svg", json={"venue": venue}, timeout=SOON)
    assert answer.status_code == 200
    assert any(escape(name) in str(node.text) for node in comments(answer.text))


def comments(svg: str) -> list[Any]:
    """matplotlib writes every text of a figure into a comment beside its outlines."""
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    return [node for node in ElementTree.fromstring(svg, parser).iter() if node.tag is ElementTree.Comment]


@pytest.mark.parametrize("name", ["x" * 201, "a\u0007", "a\nb"])
def test_a_name_is_one_line_of_plain_text(held: Service, name: str) -> None:
    venue = {"type": "Feature", "properties": {"name": name}, "geometry": SQUARE}
    answer = httpx.post(f"{held.url}/check", json={"venue": venue})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["pointer"] == "/venue/properties/name"


def test_a_problem_is_short(held: Service) -> None:
    with httpx.Client(base_url=held.url) as client:
        answers = [
            client.post("/trajectory", json={f"{'n' * 1000}{k}": 1 for k in range(90)}),
            client.post("/trajectory", json={"x" * 1_000_000: 1}),
            client.post("/check", json={"venue": {"type": "x" * 1_000_000}}),
            client.get("/turn?" + "&".join(f"n{k}=1&n{k}=1" for k in range(400))),
        ]
    assert [answer.status_code for answer in answers] == [422] * 4
    assert max(len(answer.content) for answer in answers) < 20_000


def test_a_problem_about_a_query_speaks_of_no_body(held: Service) -> None:
    answer = httpx.get(f"{held.url}/turn?" + "&".join(f"n{k}=1" for k in range(150)))
    assert answer.status_code == 422
    assert "body" not in answer.text


@contextmanager
def working(service: Service, *clients: str) -> Iterator[None]:
    """While a heavy computation runs for each client, given by its address; their clients then leave."""
    with ExitStack() as peers:
        for client in clients:
            peer = socket.create_connection(service.address, timeout=SOON, source_address=(client, 0))
            peers.enter_context(peer).sendall(f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        until(lambda: computing(service) == len(clients))
        yield
    until(lambda: computing(service) == 0)


def computing(service: Service) -> float:
    match = re.search(r'computations{lane="heavy"} (\S+)', httpx.get(f"{service.url}/metrics").text)
    return float(match[1]) if match else 0.0


def client_at(address: str, seconds: float = SOON) -> httpx.Client:
    return httpx.Client(transport=httpx.HTTPTransport(local_address=address), timeout=seconds)


def test_a_full_lane_says_when_to_come_again_and_others_pass(held: Service) -> None:
    with client_at("127.0.0.3") as client, working(held, "127.0.0.1", "127.0.0.2"):
        refused = client.get(held.url + HEAVY)
        cheap = client.get(f"{held.url}/collision-time")
    assert (refused.status_code, refused.headers["content-type"]) == (503, PROBLEM)
    assert 1 <= int(refused.headers["retry-after"]) <= DEADLINE
    assert cheap.status_code == 200


def test_a_client_has_only_so_many_heavy_computations_and_leaves_places_to_others(held: Service) -> None:
    with client_at("127.0.0.1") as client, client_at("127.0.0.2") as other, working(held, "127.0.0.1"):
        refused = client.get(held.url + HEAVY)
        answer = other.get(f"{held.url}/maximum-head-speed?benches=20")
    assert (refused.status_code, refused.headers["content-type"]) == (429, PROBLEM)
    assert "Your limit of 1 heavy computation at once is reached" in refused.json()["detail"]
    assert 1 <= int(refused.headers["retry-after"]) <= DEADLINE
    assert answer.status_code == 200


def test_by_default_one_client_cannot_take_all_places(tmp_path: Path) -> None:
    """Of two heavy places, of two for files, and of two for large bodies."""
    text, kind = b"word " * 3_999_000, {"Content-Type": "application/octet-stream"}
    large = b'{"pitch": [' + b"0," * 1_900_000
    with serving(tmp_path / "log", heavy_max=2, large_bodies_max=2, parts_max=10**8) as service:
        with client_at("127.0.0.1") as client, client_at("127.0.0.2") as other, working(service, "127.0.0.1"):
            refused = client.get(service.url + HEAVY)
            assert (refused.status_code, "Your limit of 1 heavy computation" in refused.text) == (429, True)
            assert other.get(f"{service.url}/maximum-head-speed?benches=20").status_code == 200

        def post(address: str, path: str, body: bytes) -> tuple[int, str]:
            with client_at(address, ANSWER_TIMEOUT) as client:
                headers = kind if path == "/grade" else {"Content-Type": "application/json"}
                answer = client.post(service.url + path, content=body, headers=headers)
            return answer.status_code, answer.text

        for path, body, lane in (("/grade", text, "file"), ("/check", large, "large body")):
            with ThreadPoolExecutor() as threads:
                mine = [threads.submit(post, "127.0.0.1", path, body) for _ in range(4)]
                none = f'refused_total{{lane="{lane}"}} 0.0'
                until(lambda none=none: none not in httpx.get(f"{service.url}/metrics").text)
                theirs = threads.submit(post, "127.0.0.2", path, body).result()
            statuses = [one.result()[0] for one in mine]
            assert 429 in statuses, statuses
            assert set(statuses) <= {200, 400, 422, 429}
            assert theirs[0] in {200, 400, 422}, theirs


@pytest.mark.parametrize("accept", ["*/*", CSV_TYPE])
def test_a_large_answer_is_sent_as_gzip_to_who_takes_it(held: Service, accept: str) -> None:
    body = {"times": {"stop": 400, "step": 2.0}}
    with httpx.Client(base_url=held.url, timeout=SOON) as client:
        simple, zipped = (
            client.post("/trajectory", json=body, headers={"Accept": accept, "Accept-Encoding": coding})
            for coding in ("identity", "gzip")
        )
        known = {"Accept": accept, "If-None-Match": zipped.headers["etag"]}
        again = client.post("/trajectory", json=body, headers=known)
    assert "content-encoding" not in simple.headers
    assert zipped.headers["content-encoding"] == "gzip"
    assert simple.content == zipped.content
    assert simple.headers["etag"] != zipped.headers["etag"]
    assert again.status_code == 304


def test_any_tag_at_all_is_unchanged_and_what_is_refused_is_not(held: Service) -> None:
    star = {"If-None-Match": "*"}
    assert httpx.get(f"{held.url}/turn", headers=star).status_code == 304
    assert httpx.get(f"{held.url}/turn?pitch=99", headers=star).status_code == 422


def test_the_refusal_of_a_broken_body_names_the_place(held: Service) -> None:
    answer = httpx.post(f"{held.url}/turn", content='{"pitch', headers={"Content-Type": "application/json"})
    assert answer.json()["detail"].startswith("The body is not JSON: Unterminated string starting at character 1.")


def test_tags_on_several_lines_are_one_list(held: Service) -> None:
    tag = httpx.get(f"{held.url}/turn").headers["etag"]
    lines = [("If-None-Match", '"another"'), ("If-None-Match", tag)]
    assert httpx.get(f"{held.url}/turn", headers=lines).status_code == 304


def test_a_request_keeps_its_name_and_the_log_has_it(held: Service) -> None:
    answers = [httpx.get(f"{held.url}/turn", headers={"X-Request-ID": name}) for name in ("dance-7", "no name!")]
    assert answers[0].headers["x-request-id"] == "dance-7"
    assert answers[1].headers["x-request-id"] != "no name!"
    lines = [json.loads(line) for line in held.log.read_text().splitlines()]
    assert [line["message"] for line in lines if line["request_id"] == "dance-7"]


def test_a_long_path_is_cut_in_the_log(held: Service) -> None:
    path = "/" + "a" * 60_000
    assert httpx.get(held.url + path).status_code == 404
    until(lambda: "aaa... (60001 characters)" in held.log.read_text())
    assert max(map(len, held.log.read_text().splitlines())) < 5_000


def test_no_python_is_served_and_no_page_frames_another(held: Service) -> None:
    for path in ("/docs/assets/__init__.py", "/page/__init__.py"):
        assert httpx.get(held.url + path).status_code == 404
    assert "frame-ancestors 'none'" in httpx.get(held.url).headers["content-security-policy"]


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):  # It may end between opening and reading.
        return False


def children(pid: int) -> list[int]:
    entries = [int(one) for one in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    return entries + [inner for one in entries for inner in children(one)]


STOPS = [
    (1, signal.SIGTERM),
    (1, signal.SIGINT),
    (2, signal.SIGKILL),
    (2, signal.SIGTERM),
    (1, signal.SIGKILL),
]


@pytest.mark.parametrize(("workers", "stop"), some(STOPS, 2))
def test_the_service_leaves_with_heavy_work_running(tmp_path: Path, workers: int, stop: signal.Signals) -> None:
    fields: dict[str, Any] = {"workers": workers, "grace_seconds": GRACE_SECONDS}
    # A shell that starts the service in its background has Ctrl-C ignored.
    ignored = partial(signal.signal, signal.SIGINT, signal.SIG_IGN) if stop == signal.SIGTERM else None
    with serving(tmp_path / "log", limit=ignored, **fields) as service:
        leaves(service, stop)


def leaves(service: Service, stop: signal.Signals) -> None:
    """Stop a service while it computes, and see that none of its processes is left."""
    with socket.socket() as peer:
        peer.connect(service.address)
        peer.sendall(f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        # Where each process shows its own metrics, one look may meet the other process.
        until(lambda: computing(service) == 1)
        family = [service.process.pid, *children(service.process.pid)]
        os.kill(service.process.pid, stop)
        service.process.wait(SOON)
        until(lambda: not any(alive(pid) for pid in family))


@pytest.mark.parametrize("workers", [1, 2])
def test_a_service_that_ends_answers_who_has_connected_and_refuses_others(tmp_path: Path, workers: int) -> None:
    """A proxy sends a request to another service if this one refuses the connection, not if it resets it."""
    fields: dict[str, Any] = {"workers": workers, "grace_seconds": 10}
    with serving(tmp_path / "log", **fields) as service, ExitStack() as peers:
        until(lambda: service.log.read_text().count("startup complete") == workers)
        busy, *new = (peers.enter_context(socket.create_connection(service.address, timeout=SOON)) for _ in range(4))
        busy.sendall(f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        until(lambda: computing(service) == 1)
        service.process.terminate()
        for peer in new:
            peer.sendall(
                b"POST /turn HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}"
            )
        for peer in new:
            answer = b"".join(iter(lambda peer=peer: peer.recv(65536), b""))
            assert answer.startswith(b"HTTP/1.1 200 ")
        assert service.process.poll() is None
        with pytest.raises(ConnectionRefusedError):
            until(lambda: send(service, b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n") == b"never")


def test_bodies_are_judged_before_they_are_held(tmp_path: Path) -> None:
    head = "POST /{} HTTP/1.1\r\nHost: x\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
    with serving(tmp_path / "log", token="correct horse", bodies_bytes_max=150_000) as service:
        # Without the token a file is refused by its head, of which nothing has to be kept.
        large = head.format("grade", "application/octet-stream", 19_000_000) + "\r\n"
        assert send(service, large.encode()).startswith(b"HTTP/1.1 401 ")
        small = head.format("check", "application/json", 120_000) + "Connection: close\r\n\r\n"
        begun = small.encode() + b" " * 100_000
        with socket.create_connection(service.address, timeout=SOON) as waiting:
            waiting.sendall(begun)
            time.sleep(0.3)
            refused = send(service, begun)
            assert refused.startswith(b"HTTP/1.1 503 ")
            assert b"The limit of 150000 bytes of bodies at once is reached: try again in 1 s." in refused
            assert httpx.post(f"{service.url}/check", json={"dragon": {"benches": 9}}).status_code == 200
        until(lambda: send(service, begun + b" " * 20_000).startswith(b"HTTP/1.1 400 "))


def test_figures_whose_clients_leave_keep_no_file_open_in_each_thread(tmp_path: Path) -> None:
    """matplotlib opens the two files of a font once for each thread that draws."""
    with serving(tmp_path / "log") as service:

        def leave(number: int) -> None:
            with suppress(httpx.ReadTimeout):
                httpx.get(f"{service.url}/figures/trajectory.png?time={number}", timeout=0.2)

        with ThreadPoolExecutor(24) as clients:
            list(clients.map(leave, range(240)))
        until(lambda: httpx.get(f"{service.url}/figures/trajectory.png", timeout=SOON).status_code == 200)
        files = [os.path.realpath(one) for one in Path(f"/proc/{service.process.pid}/fd").iterdir()]
        fonts = [name for name in files if name.endswith(".ttf")]
        assert fonts
        assert len(fonts) == len(set(fonts))


def test_a_service_whose_counts_were_removed_answers_and_replaces_its_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    with serving(tmp_path / "log", workers=2, grace_seconds=GRACE_SECONDS) as service:
        counts = next((tmp_path / "temporary").glob("bench-dragon-*/counter_*.db"))
        files = list(counts.parent.iterdir())
        # Every file has its room: a full disk cannot end the process that has it mapped into memory.
        assert all(file.stat().st_blocks * 512 >= file.stat().st_size for file in files)
        shutil.rmtree(counts.parent)
        assert "bench_dragon_requests" in httpx.get(f"{service.url}/metrics").text
        known = int(counts.stem.rpartition("_")[2])
        os.kill(known, signal.SIGKILL)
        until(lambda: "shows one process alone" in service.log.read_text())
        for _ in range(10):
            assert httpx.get(f"{service.url}/collision-time").status_code == 200
        until(lambda: not alive(known))


def test_a_full_disk_leaves_metrics_of_one_process_and_a_word_and_ctrl_c_ends_all(tmp_path: Path) -> None:
    def little_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

    with serving(tmp_path / "log", workers=2, limit=little_room, job_max=1, grace_seconds=GRACE_SECONDS) as service:
        for _ in range(10):
            assert httpx.get(f"{service.url}/collision-time").status_code == 200
        assert "bench_dragon_requests" in httpx.get(f"{service.url}/metrics").text
        assert "/metrics shows one process alone" in service.log.read_text()
        assert "died" not in service.log.read_text()
        assert "BENCH_DRAGON_JOB_MAX is not a setting and has no effect; did you mean" in service.log.read_text()
        leaves(service, signal.SIGINT)

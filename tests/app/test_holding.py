"""The service with bad HTTP, slow clients, full lanes, signals and a full disk, over real sockets."""

import json
import os
import re
import resource
import shutil
import signal
import socket
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager, suppress
from functools import partial
from html import escape
from http.client import HTTPConnection
from select import select

import httpx
import psutil
import pytest

from app.files.tables import CSV_TYPE
from app.processes.limits import AWAITED_NICENESS
from tests.app.conftest import ANSWER_TIMEOUT
from tests.support.asking import box
from tests.support.attacks import million_cells
from tests.support.depth import further, thorough
from tests.support.job_service import is_gone, wait_for
from tests.support.serving import sample, serving

HEAD_SECONDS = 0.5
GRACE_SECONDS = 1
# Longest wait for what should come within the times above on a busy machine [s].
SOON = 15.0
# Seconds of compiled work that nothing stops: under the limits, and refused to a second client.
HEAVY = "/minimum-pitch?benches=6308&body_length=0.001&head_length=0.001&overhang=0"
PROBLEM = "application/problem+json"
# Default of deadline_seconds: a computation that blocks a place is over then [s].
DEADLINE = 10


@pytest.fixture(scope="module")
def held(tmp_path_factory):
    """A service with short times and few places, and a log in JSON."""
    log = tmp_path_factory.mktemp("held") / "server.log"
    settings = {"head_seconds": HEAD_SECONDS, "body_seconds": HEAD_SECONDS, "stalled_seconds": HEAD_SECONDS}
    settings |= {"heavy_max": 2, "heavy_client_max": 1, "grace_seconds": GRACE_SECONDS}
    with serving(log, log_json=True, **settings) as service:
        yield service


JSON_HEAD = b"POST /%s HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"


def connected(service, sent=b"", client=""):
    """A connection of a client, given by its address, which has sent this."""
    peer = socket.create_connection(service.address, timeout=SOON, source_address=(client, 0))
    peer.sendall(sent)
    return peer


def received(peer):
    """All that the service answers until it closes the connection; fails if it keeps it for long."""
    return b"".join(iter(lambda: peer.recv(65536), b""))


def send(service, sent):
    with connected(service, sent) as peer:
        return received(peer)


def metrics(service):
    return httpx.get(f"{service.url}/metrics").text


def test_a_head_that_never_ends_is_answered_408_and_a_connection_may_rest_as_long(held):
    begun = [b"", b"GET /healthz HTTP/1.1\r\nX-Slow: ", b"GET"]
    with httpx.Client(base_url=held.url) as client, ThreadPoolExecutor() as clients:
        assert client.get("/healthz").status_code == 200
        # At once: the service waits for each by itself.
        answers = list(clients.map(partial(send, held), begun))
        assert [answer[:13] for answer in answers] == [b"HTTP/1.1 408 "] * len(begun)
        assert client.get("/healthz").status_code == 200


@pytest.mark.thorough
def test_a_connection_stays_open_between_requests(held):
    with closing(HTTPConnection(*held.address)) as connection:
        connection.request("GET", "/healthz")
        assert connection.getresponse().read()
        connection.sock.settimeout(6.0)  # uvicorn by itself waits for 5 s, less than any proxy
        with pytest.raises(TimeoutError):
            connection.sock.recv(1)


def test_a_body_that_never_ends_loses_its_connection(held):
    with suppress(ConnectionResetError):
        assert send(held, JSON_HEAD % b"trajectory" + b"Content-Length: 9\r\n\r\n{") == b""


def test_a_body_that_its_client_breaks_off_or_garbles_is_no_error_of_the_service(held):
    head = JSON_HEAD % b"shortest-turn"
    connected(held, head + b"Content-Length: 9\r\n\r\n{").close()
    assert send(held, head + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n").startswith(b"HTTP/1.1 400 ")
    wait_for(lambda: 'requests_total{path="/shortest-turn",status="400"} 2.0' in metrics(held))
    assert 'path="/shortest-turn",status="500"' not in metrics(held)
    assert "/shortest-turn failed" not in held.log.read_text()


def test_a_client_that_takes_nothing_of_its_answer_loses_its_connection(held):
    body = json.dumps({"times": {"stop": 400, "step": 0.1}}).encode()
    whole = int(1e7)
    taken = 0
    with connected(held, JSON_HEAD % b"trajectory" + b"Content-Length: %d\r\n\r\n%s" % (len(body), body)) as peer:
        peer.recv(1)
        ours = peer.getsockname()
        service = psutil.Process(held.process.pid)
        wait_for(lambda: all(other.raddr != ours for other in service.net_connections()))
        with suppress(ConnectionResetError):
            while block := peer.recv(1 << 20):
                taken += len(block)
    assert taken < whole


UPGRADE = b"""Connection: Upgrade, close\r
Upgrade: websocket\r
Sec-WebSocket-Version: 13\r
Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r
\r
"""


@pytest.mark.parametrize(
    "sent, status",
    [
        (b"nonsense\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\n\r\n", 400),
        (JSON_HEAD % b"overlaps" + b"Content-Length: 2, 3\r\nConnection: close\r\n\r\n{}", 400),
        (JSON_HEAD % b"turn" + b"Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 400),
        (b"GET /turn?" + b"a=1&" * 4_000 + b" HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", 414),
        (
            b"GET /nothing HTTP/1.1\r\nHost: x\r\n" + UPGRADE,
            404,
        ),
    ],
    ids=["no HTTP", "no host", "two lengths", "length and chunks", "long query", "upgrade"],
)
def test_malformed_http_and_an_upgrade_are_a_problem(held, sent, status):
    assert problem_of(send(held, sent))["status"] == status


def problem_of(answer):
    """The problem in an answer, whose head fits it."""
    head, _, body = answer.partition(b"\r\n\r\n")
    assert PROBLEM.encode() in head
    assert head.lower().count(b"x-content-type-options: nosniff") == 1
    problem = json.loads(body)
    assert head.startswith(b"HTTP/1.1 %d " % problem["status"])
    return problem


def get(service, path, host="x"):
    """An answer, as it comes. host: None for none, which the first version of HTTP does without"""
    head = f"GET {path} HTTP/1.0\r\n" if host is None else f"GET {path} HTTP/1.1\r\nHost: {host}\r\n"
    return send(service, f"{head}Connection: close\r\n\r\n".encode())


@pytest.mark.parametrize(
    "target, path, status",
    [
        ("HTTPS://service/turn?pitch=1.7", "/turn?pitch=1.7", 200),
        ("http://service", "/", 200),
        ("http:///healthz", "http:///healthz", 404),
    ],
)
def test_a_target_in_absolute_form_is_that_in_origin_form(held, target, path, status):
    """Without the setting below any host is served."""
    answers = [get(held, place, "any.example") for place in (target, path)]
    assert answers[0].startswith(f"HTTP/1.1 {status} ".encode())
    assert answers[0].partition(b"\r\n\r\n")[2] == answers[1].partition(b"\r\n\r\n")[2]


def test_who_asks_for_another_host_is_refused_where_a_setting_names_the_hosts(tmp_path):
    """A stranger's page can give its own name the address of this machine: its requests come under that name."""
    with serving(tmp_path / "log", hosts="Dance.Example., 192.0.2.7,[2001:db8::7]", token="secret") as service:
        port = service.address[1]

        def statuses(paths, *hosts):
            """Of each path from each host."""
            answers = [get(service, path, host) for path in paths.split() for host in hosts]
            for answer in answers:
                assert b" 421 " not in answer[:20] or problem_of(answer)["errors"][0]["name"] == "Host"
            return {int(answer.split()[1]) for answer in answers}

        ours = ("dance.example", f"DANCE.example.:{port}", "192.0.2.7", f"192.0.2.7:{port}", "[2001:db8::7]:80")
        assert statuses("/ /turn /docs", *ours) == {200}
        strangers = "evil.example localhost dance.example.evil.example x.dance.example dance.example:x"
        strangers += " dance.example@evil.example 192.0.2.70 [2001:db8::71]"
        everything = "/ /turn /metrics /docs /openapi.json /page/main.js /jobs /nothing"
        assert statuses(everything, f"127.0.0.1:{port}", *strangers.split(), "", None) <= {421, 400}
        assert statuses("/turn", "evil.example", None) == {421}
        # Probes come by any address.
        assert statuses("/healthz /readyz", f"127.0.0.1:{port}") == {200}
        # The host of a target in absolute form counts, not the header.
        assert statuses("http://evil.example/turn", "dance.example") == {421}
        assert statuses(f"http://dance.example:{port}/turn", "evil.example") == {200}


@pytest.mark.parametrize("name", ["a$\\frac{$", "<&>", "龙", "_^{}"])
def test_a_name_is_drawn_as_it_is(held, name):
    body = {"venue": box(-30, -30, 30, 30, name=name)}
    answer = httpx.post(f"{held.url}/figures/trajectory.svg", json=body, timeout=SOON).raise_for_status()
    # matplotlib writes every text of a figure into a comment beside its outlines.
    assert any(escape(name) in comment for comment in re.findall("<!--(.*?)-->", answer.text, re.DOTALL))


@contextmanager
def working(service, *clients):
    """While a heavy computation runs for each client, given by its address; their clients then leave."""
    with ExitStack() as peers:
        for client in clients:
            peers.enter_context(connected(service, f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode(), client))
        wait_for(lambda: computing(service) == len(clients))
        yield
    wait_for(lambda: computing(service) == 0)


def computing(service):
    return sample(service.url, 'bench_dragon_computations{lane="heavy"}')


def client_at(address, seconds=SOON):
    return httpx.Client(transport=httpx.HTTPTransport(local_address=address), timeout=seconds)


@pytest.mark.parametrize(
    "others, status", [(("127.0.0.1", "127.0.0.2"), 503), (("127.0.0.3",), 429)], ids=["lane", "client"]
)
def test_who_finds_no_place_for_heavy_work_hears_when_to_come_again_and_others_pass(held, others, status):
    with client_at("127.0.0.3") as client, client_at("127.0.0.4") as other, working(held, *others):
        refused = client.get(held.url + HEAVY)
        cheap = client.get(f"{held.url}/collision-time")
        heavy = other.get(f"{held.url}/maximum-head-speed?benches=20")
    assert refused.status_code == status
    assert refused.headers["content-type"] == PROBLEM
    assert 1 <= int(refused.headers["retry-after"]) <= DEADLINE
    # Beside a full lane one may compute what is cheap, beside a full client also what is heavy.
    assert cheap.status_code == 200
    assert heavy.status_code == (503 if status == 503 else 200)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has a priority of each thread")
def test_the_loop_that_takes_requests_comes_before_long_computations(held):
    pid = held.process.pid
    # 19 is the largest niceness (man 2 setpriority): tests may themselves run with a low priority.
    expected = min(os.getpriority(os.PRIO_PROCESS, pid) + AWAITED_NICENESS, 19)

    def lowered():
        return expected in {os.getpriority(os.PRIO_PROCESS, int(task)) for task in os.listdir(f"/proc/{pid}/task")}

    with working(held, ""):
        wait_for(lowered)


@pytest.mark.thorough
def test_by_default_one_client_cannot_take_all_places(tmp_path):
    """Of two for files, and of two for large bodies."""
    text = b"word " * 3_999_000
    large = b'{"pitch": [' + b"0," * 1_900_000

    def post(address, call, kind, body):
        with client_at(address, ANSWER_TIMEOUT) as client:
            return client.post(call, content=body, headers={"Content-Type": kind}).status_code

    with serving(tmp_path / "log", large_bodies_max=2, parts_max=10**8) as service, ThreadPoolExecutor() as threads:
        for lane, path, *file in (
            ("file", "/grade", "application/octet-stream", text),
            ("large body", "/check", "application/json", large),
        ):
            mine = [threads.submit(post, "127.0.0.1", service.url + path, *file) for _ in range(4)]
            none = f'refused_total{{lane="{lane}"}} 0.0'
            wait_for(lambda none=none: none not in metrics(service))
            assert post("127.0.0.2", service.url + path, *file) in {200, 400, 422}
            # Who comes while the other client has a place finds none (503), in place of no second one (429).
            assert {429} <= {each.result() for each in mine} <= {200, 400, 422, 429, 503}


def test_a_large_answer_is_sent_as_gzip_to_who_takes_it(held):
    def answer(**headers):
        body = {"times": {"stop": 400, "step": 2.0}}
        return httpx.post(f"{held.url}/trajectory", json=body, headers={"Accept": CSV_TYPE} | headers, timeout=SOON)

    simple = answer(**{"Accept-Encoding": "identity"})
    zipped = answer(**{"Accept-Encoding": "gzip"})
    assert "content-encoding" not in simple.headers
    assert zipped.headers["content-encoding"] == "gzip"
    assert simple.content == zipped.content
    assert simple.headers["etag"] != zipped.headers["etag"]
    assert answer(**{"If-None-Match": zipped.headers["etag"]}).status_code == 304


def test_any_tag_or_one_on_several_lines_is_unchanged_and_what_is_refused_is_not(held):
    tag = httpx.get(f"{held.url}/turn").headers["etag"]
    for query, tags, status in (("", ["*"], 304), ("?pitch=99", ["*"], 422), ("", ['"another"', tag], 304)):
        lines = [("If-None-Match", each) for each in tags]
        assert httpx.get(f"{held.url}/turn{query}", headers=lines).status_code == status


def test_a_request_keeps_its_name_and_the_log_has_it(held):
    answers = [httpx.get(f"{held.url}/turn", headers={"X-Request-ID": name}) for name in ("dance-7", "no name!")]
    assert answers[0].headers["x-request-id"] == "dance-7"
    assert answers[1].headers["x-request-id"] != "no name!"
    lines = [json.loads(line) for line in held.log.read_text().splitlines()]
    assert [line["message"] for line in lines if line["request_id"] == "dance-7"]


def test_a_long_path_is_cut_in_the_log(held):
    assert httpx.get(f"{held.url}/{'a' * 60_000}").status_code == 404
    wait_for(lambda: "aaa... (60001 characters)" in held.log.read_text())
    assert max(map(len, held.log.read_text().splitlines())) < 5_000


def leaves(service, stop):
    """Stop a service while it computes, and see that none of its processes is left."""
    with connected(service, f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode()):
        # Where each process shows its own metrics, one look may meet the other process.
        wait_for(lambda: computing(service) == 1)
        parent = psutil.Process(service.process.pid)
        processes = [parent, *parent.children(recursive=True)]
        os.kill(service.process.pid, stop)
        service.process.wait(SOON)
        wait_for(lambda: all(is_gone(process.pid) for process in processes))


MORE = [(1, signal.SIGTERM), (2, signal.SIGKILL), (2, signal.SIGTERM), (1, signal.SIGKILL)]


@pytest.mark.parametrize("workers, stop", [(1, signal.SIGINT), *thorough(*MORE)])
def test_the_service_leaves_with_heavy_work_running(tmp_path, workers, stop):
    # A shell that starts the service in its background has Ctrl-C ignored.
    ignored = partial(signal.signal, signal.SIGINT, signal.SIG_IGN) if stop == signal.SIGTERM else None
    with serving(tmp_path / "log", workers, ignored, grace_seconds=GRACE_SECONDS) as service:
        leaves(service, stop)


@pytest.mark.parametrize("workers", further([1, 2], 1))
def test_a_service_that_ends_answers_who_has_connected_and_refuses_others(tmp_path, workers):
    """A proxy sends a request to another service if this one refuses the connection, not if it resets it."""
    with serving(tmp_path / "log", workers, grace_seconds=10) as service, ExitStack() as peers:
        wait_for(lambda: service.log.read_text().count("startup complete") == workers)
        busy, *new = (peers.enter_context(connected(service)) for _ in range(4))
        busy.sendall(f"GET {HEAVY} HTTP/1.1\r\nHost: x\r\n\r\n".encode())
        wait_for(lambda: computing(service) == 1)
        service.process.terminate()
        for peer in new:
            peer.sendall(JSON_HEAD % b"turn" + b"Content-Length: 2\r\n\r\n{}")
        assert {received(peer)[:13] for peer in new} == {b"HTTP/1.1 200 "}
        assert service.process.poll() is None
        with pytest.raises(ConnectionRefusedError):
            wait_for(lambda: get(service, "/healthz") == b"never")


def test_bodies_are_judged_before_they_are_held(tmp_path):
    with serving(tmp_path / "log", token="correct horse", bodies_bytes_max=150_000) as service, ExitStack() as peers:
        # Without the token a file is refused by its head, of which nothing has to be kept.
        large = b"POST /grade HTTP/1.1\r\nHost: x\r\nContent-Type: application/octet-stream\r\n"
        assert send(service, large + b"Content-Length: 19000000\r\n\r\n").startswith(b"HTTP/1.1 401 ")
        begun = JSON_HEAD % b"check" + b"Content-Length: 120000\r\nConnection: close\r\n\r\n" + b" " * 100_000
        both = [peers.enter_context(connected(service, begun)) for _ in range(2)]
        [refused], _, _ = select(both, [], [], SOON)
        answer = received(refused)
        assert answer.startswith(b"HTTP/1.1 503 ")
        assert problem_of(answer)["values"]["most"]["value"] == 150_000
        assert httpx.post(f"{service.url}/check", json={"dragon": {"benches": 9}}).status_code == 200
        peers.close()
        wait_for(lambda: send(service, begun + b" " * 20_000).startswith(b"HTTP/1.1 400 "))


@pytest.mark.thorough
def test_figures_whose_clients_leave_keep_no_file_open_in_each_thread(tmp_path):
    """matplotlib opens the two files of a font once for each thread that draws."""
    with serving(tmp_path / "log") as service:
        figure = f"{service.url}/figures/trajectory.png"

        def leave(number):
            with suppress(httpx.ReadTimeout):
                httpx.get(f"{figure}?time={number}", timeout=0.2)

        with ThreadPoolExecutor(24) as clients:
            list(clients.map(leave, range(240)))
        wait_for(lambda: httpx.get(figure, timeout=SOON).status_code == 200)
        files = [file.path for file in psutil.Process(service.process.pid).open_files() if file.path.endswith(".ttf")]
        assert len(files) == len(set(files)) > 0


@pytest.mark.thorough
def test_a_service_whose_counts_were_removed_answers_and_replaces_its_processes(tmp_path, monkeypatch):
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    with serving(tmp_path / "log", workers=2, grace_seconds=GRACE_SECONDS) as service:
        counts = next((tmp_path / "temporary").glob("bench-dragon-*/counter_*.db"))
        # Every file has its room: a full disk cannot end the process that has it mapped into memory.
        for file in counts.parent.iterdir():
            assert file.stat().st_blocks * 512 >= file.stat().st_size
        shutil.rmtree(counts.parent)
        assert "bench_dragon_requests" in metrics(service)
        worker = int(counts.stem.rpartition("_")[2])
        os.kill(worker, signal.SIGKILL)
        wait_for(lambda: "shows one process alone" in service.log.read_text())
        for _ in range(10):
            assert httpx.get(f"{service.url}/collision-time").status_code == 200
        wait_for(lambda: is_gone(worker))


@pytest.mark.thorough
def test_an_answer_whose_process_is_killed_is_never_taken_for_a_whole_one(tmp_path):
    table = {"content": million_cells(), "headers": {"Accept": CSV_TYPE, "Content-Type": "application/json"}}
    with serving(tmp_path / "log", workers=2) as service, httpx.Client(base_url=service.url, timeout=SOON) as client:
        with client.stream("POST", "/trajectory", **table) as answer:
            blocks = answer.iter_raw()
            next(blocks)
            ours = answer.extensions["network_stream"].get_extra_info("client_addr")
            for process in psutil.Process(service.process.pid).children():
                if any(other.raddr == ours for other in process.net_connections()):
                    process.kill()
            with pytest.raises(httpx.RemoteProtocolError):
                list(blocks)
        assert client.get("/collision-time").status_code == 200


@pytest.mark.thorough
def test_a_full_disk_leaves_metrics_of_one_process_and_a_word_and_ctrl_c_ends_all(tmp_path):
    def little_room():
        resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

    with serving(tmp_path / "log", workers=2, limit=little_room, job_max=1, grace_seconds=GRACE_SECONDS) as service:
        for _ in range(10):
            assert httpx.get(f"{service.url}/collision-time").status_code == 200
        assert "bench_dragon_requests" in metrics(service)
        log = service.log.read_text()
        assert "/metrics shows one process alone" in log
        assert "died" not in log
        assert "BENCH_DRAGON_JOB_MAX is not a setting and has no effect; did you mean" in log
        leaves(service, signal.SIGINT)

"""Promises of every call in addition to its numbers: formats, caching, HEAD and OPTIONS, health, documentation."""

import re
from urllib.parse import urljoin

import pytest

from app.files.tables import CSV_TYPE
from app.service.version import build
from tests.support.asking import line

SMALL = {"dragon": {"benches": 3}, "times": [0.0, 1.5]}


# -- trajectories --------------------------------------------------------------------------------------------


def test_trajectory_without_a_body_is_the_default_one(ask):
    assert ask.client.post("/trajectory").content == ask.file("trajectory", {})


@pytest.mark.parametrize(
    "times, instants",
    [
        ({"start": 0, "stop": 0.3, "step": 0.1}, [0.0, 0.1, 0.2, 0.3]),
        ({"start": -1, "stop": 0.9, "step": 1}, [-1.0, 0.0]),
        ({"start": 2, "stop": 2}, [2.0]),
        ([3.0, 1.0, 2.5], [3.0, 1.0, 2.5]),
    ],
    ids=["tenths", "stop_between_steps", "one", "list"],
)
def test_times_are_a_range_with_both_ends_or_a_list(ask, times, instants):
    assert ask("trajectory", SMALL | {"times": times})["time"] == pytest.approx(instants, rel=1e-15)


def test_decimals_round_all_but_the_time(ask):
    request = SMALL | {"times": [0.123456789], "path": {"start_turns": 8}}
    full, rounded = (ask("trajectory", request | extra) for extra in ({}, {"decimals": 2}))
    assert rounded["time"] == [0.123456789]
    for name in ("x", "y", "speed"):
        assert list(map(str, rounded[name][0])) == [str(round(value, 2) + 0.0) for value in full[name][0]]


def test_without_engines_the_answer_is_the_same(ask):
    assert ask("minimum-pitch", cross_check="none") == ask("minimum-pitch") | {"cross_check": None}


# -- HTTP ----------------------------------------------------------------------------------------------------


ON_LANE = {"dragon": {"benches": 4}, "path": line((0, 0), (60, 0))}


@pytest.mark.parametrize(
    "call, body",
    [
        ("minimum-pitch", None),
        ("figures/contact.png?benches=40", None),
        ("check", ON_LANE),
        ("figures/trajectory.svg", ON_LANE | {"time": 20.0}),
    ],
)
def test_an_answer_that_the_client_has_is_not_sent_again(ask, call, body):
    first = ask.send(call, body)
    tag = first.headers["etag"]
    method = "POST" if body else "GET"
    assert re.fullmatch(r"public, max-age=\d+", first.headers["cache-control"])
    again, other = (
        ask.client.request(method, call, json=body, headers={"If-None-Match": tags})
        for tags in (f'"other", W/{tag}', '"other"')
    )
    assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
    assert other.content == first.content
    if body:
        assert ask.send(call, body | {"head_speed": 1.1}).headers["etag"] != tag


def test_the_tag_follows_the_values_and_the_form_and_nothing_else(ask):
    def tag(call, *body):
        return ask.send(call, *body).headers["etag"]

    assert tag("clearance?stop=1") == tag("clearance?stop=1.0&pitch=0.55&step=1")
    assert tag("clearance?stop=1") != tag("clearance?stop=2")
    posted = ask.send("trajectory", SMALL)
    assert posted.headers["vary"] == "Accept, Accept-Encoding, Accept-Language"
    assert posted.headers["etag"] != tag("trajectory", SMALL, CSV_TYPE)
    assert posted.headers["etag"] == tag("trajectory", {"path": {"kind": "spiral", "pitch": 0.55}, **SMALL})


@pytest.mark.parametrize("path", ["/healthz", "/collision-time", "/docs", "/"])
@pytest.mark.parametrize("taken", ["identity", "gzip"])
def test_head_has_the_headers_of_get_and_no_body(client, path, taken):
    accept = {"Accept-Encoding": taken}
    head = client.head(path, headers=accept)
    with client.stream("GET", path, headers=accept) as get:
        sent = len(b"".join(get.iter_raw()))
    assert head.status_code == 200
    assert head.content == b""
    assert head.headers["content-length"] == get.headers["content-length"] == str(sent)


def test_the_service_is_alive_and_ready(ask):
    assert ask("healthz") == {"status": "ok"}
    assert ask("readyz") == {"status": "ready"}
    assert ask.send("readyz").headers["cache-control"] == "no-store"


@pytest.mark.parametrize("path", ["/", "/docs"])
def test_pages_load_from_this_service_alone(client, path):
    page = client.get(path)
    assert page.headers["content-security-policy"].startswith("default-src 'self'")
    assert "<script>" not in page.text
    links = re.findall(r'(?:src|href)="([^"]+)"', page.text)
    assert links
    assert not [link for link in links if "//" in link]
    for link in links:
        assert client.get(urljoin(path, link)).status_code == 200, link


def test_tags_depend_on_the_installed_libraries(tmp_path, monkeypatch):
    before = build.__wrapped__()
    assert build.__wrapped__() == before
    (tmp_path / "matplotlib-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert build.__wrapped__() != before

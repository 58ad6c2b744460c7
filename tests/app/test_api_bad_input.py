"""Every bad request gets a problem that names the place, the value and the limit, and the next request is answered."""

from __future__ import annotations

import gzip
import json
from typing import Any, NamedTuple

import httpx
import pytest

from app.files.tables import XLSX_TYPE
from app.wire.question import BYTES

PROBLEM_TYPE = "application/problem+json"
GOOD: dict[str, Any] = {"times": [0.0], "dragon": {"benches": 2}}


class Bad(NamedTuple):
    """A bad request, where the problem points, and words that its detail has."""

    name: str
    sent: Any
    place: str
    words: tuple[str, ...]


BAD_QUERIES = [
    Bad("nan", "pitch=NaN", "pitch", ("finite", "NaN")),
    Bad("infinity", "pitch=inf", "pitch", ("finite", "inf")),
    Bad("beyond_double", "pitch=1e400", "pitch", ("finite", "1e400")),
    Bad("text", "pitch=wide", "pitch", ("number", "[m]", "wide")),
    Bad("empty", "pitch=", "pitch", ("number", "[m]")),
    Bad("negative", "width=-0.3", "width", ("at least 0.001 m", "got -0.3 m")),
    Bad("zero", "body_length=0", "body_length", ("at least 0.001 m", "got 0 m")),
    Bad("negative_overhang", "overhang=-0.1", "overhang", ("at least 0 m", "got -0.1 m")),
    Bad("huge", "head_length=1e308", "head_length", ("at most 50 m", "got 1e308 m")),
    Bad("centimetre_pitch", "pitch=55", "pitch", ("at most 10 m", "got 55 m", "metres", "0.55 m")),
    Bad("centimetre_width", "width=30", "width", ("at most 5 m", "metres", "0.3 m")),
    Bad("centimetre_head", "head_length=341", "head_length", ("at most 50 m", "metres", "3.41 m")),
    Bad("centimetre_body", "body_length=220", "body_length", ("at most 50 m", "metres", "2.2 m")),
    Bad("centimetre_overhang", "overhang=27.5", "overhang", ("at most 5 m", "metres", "0.275 m")),
    Bad("centimetre_margin", "margin=5", "margin", ("at most 2 m", "metres", "0.05 m")),
    Bad("speed_in_centimetres", "head_speed=100", "head_speed", ("at most 20 m/s", "metres per second")),
    Bad("half_a_bench", "overhang=1.1", "overhang", ("half", "2.2 m", "got 1.1 m")),
    Bad("no_benches", "benches=0", "benches", ("at least 1", "got 0")),
    Bad("part_of_a_bench", "benches=2.5", "benches", ("whole number", "2.5")),
    Bad("million_benches", "benches=1000000", "benches", ("at most 100000", "got 1000000", "shorten")),
    Bad("endless_benches", "benches=1" + "0" * 30, "benches", ("at most 10000000",)),
    Bad("unknown_name", "colour=red", "colour", ("unknown", "leave it out")),
    Bad("misspelt_name", "pich=0.55", "pich", ("unknown", "did you mean pitch?")),
    Bad("given_twice", "pitch=0.5&pitch=0.6", "pitch", ("more than once",)),
    Bad("no_room_at_the_start", "start_turns=0.5", "start_turns", ("turns",)),
]
BAD_BODIES = [
    Bad("nan", '{"path": {"pitch": NaN}}', "/path/pitch", ("finite", "NaN")),
    Bad("infinity", '{"path": {"pitch": Infinity}}', "/path/pitch", ("finite", "Infinity")),
    Bad("beyond_double", '{"path": {"pitch": 1e400}}', "/path/pitch", ("finite",)),
    Bad("huge", '{"path": {"pitch": 1e308}}', "/path/pitch", ("at most 10 m",)),
    Bad("number_as_text", '{"path": {"pitch": "0.55"}}', "/path/pitch", ("number", '"0.55"')),
    Bad("truth_as_number", '{"dragon": {"width": true}}', "/dragon/width", ("number", "true")),
    Bad("nothing_as_number", '{"dragon": {"width": null}}', "/dragon/width", ("number", "null")),
    Bad("centimetres", '{"dragon": {"width": 30}}', "/dragon/width", ("at most 5 m", "metres", "0.3 m")),
    Bad("long_number", '{"dragon": {"benches": ' + "9" * 4000 + "}}", "/dragon/benches", ("at most 10000000",)),
    Bad("million_benches", '{"dragon": {"benches": 1000000}}', "/dragon/benches", ("at most 100000",)),
    Bad("billion_times", '{"times": {"step": 1e-6}}', "/times/step", ("at most 1000000", "larger step")),
    Bad("endless_times", '{"times": {"stop": 1e9}}', "/times/stop", ("at most 1000000 s",)),
    Bad("no_step", '{"times": {"step": 0}}', "/times/step", ("at least 1e-06 s", "got 0 s")),
    Bad("stop_before_start", '{"times": {"start": 5, "stop": 1}}', "/times/stop", ("before", "5 s", "got 1 s")),
    Bad("no_times", '{"times": []}', "/times", ("at least 1 entry",)),
    Bad("text_among_times", '{"times": [0, "1"]}', "/times/1", ("number", '"1"')),
    Bad("times_as_text", '{"times": "all"}', "/times", ("JSON object", "list")),
    Bad("after_the_fold", '{"times": [0, 500]}', "/times/1", ("432.9179", "folds", "got 500 s")),
    Bad("range_after_the_fold", '{"times": {"stop": 600}}', "/times/stop", ("432.9179", "folds", "got 600 s")),
    Bad("missing_lists", '{"dragon": {"lengths": [2]}}', "/dragon/widths", ("missing",)),
    Bad(
        "uneven_lists",
        '{"dragon": {"lengths": [2, 2], "widths": [1], "overhangs": [0, 0]}}',
        "/dragon/widths",
        ("2 numbers",),
    ),
    Bad(
        "half_a_bench",
        '{"dragon": {"lengths": [2, 2], "widths": [1, 1], "overhangs": [0, 1]}}',
        "/dragon/overhangs/1",
        ("half",),
    ),
    Bad("other_path", '{"path": {"kind": "maze"}}', "/path/kind", ('"spiral"', '"route"', "maze")),
    Bad("kind_of_null", '{"path": {"kind": null}}', "/path/kind", ('"spiral"', "got null")),
    Bad("kind_as_number", '{"path": {"kind": 3}}', "/path/kind", ('"spiral"', "got 3")),
    Bad(
        "forgotten_kind",
        '{"path": {"points": [[0, 0], [9, 9]]}}',
        "/path/points",
        ('in the kind "spiral"', 'belongs to "waypoints"'),
    ),
    Bad(
        "field_of_another_piece",
        '{"path": {"kind": "route", "pieces": [{"kind": "line", "pitch": 1}]}}',
        "/path/pieces/0/pitch",
        ('in the kind "line"', 'belongs to "coil"'),
    ),
    Bad("name_twice", '{"path": {"kind": "spiral", "pitch": 0.5, "pitch": 0.6}}', "", ('name "pitch" more than once',)),
    Bad("number_beyond_double", '{"path": {"pitch": 1' + "0" * 400 + "}}", "/path/pitch", ("finite number [m]",)),
    Bad("part_of_a_bench", '{"dragon": {"benches": 2.5}}', "/dragon/benches", ("whole number", "got 2.5")),
    Bad("path_as_list", '{"path": []}', "/path", ("JSON object",)),
    Bad("unknown_field", '{"path": {"pich": 0.5}}', "/path/pich", ("unknown", "did you mean pitch?")),
    Bad("slash_in_name", '{"a/b": 1}', "/a~1b", ("unknown",)),
    Bad("too_many_decimals", '{"decimals": 99}', "/decimals", ("at most 15",)),
    Bad("too_many_names", json.dumps(dict.fromkeys(map(str, range(1000)), 0)), "", ("at most 100 names",)),
    Bad("list", "[]", "", ("JSON object",)),
    Bad("number", "3", "", ("JSON object",)),
    Bad("null", "null", "", ("JSON object",)),
]
BROKEN_BODIES = {
    "broken": (b"{bad", "is not JSON: Expecting property name"),
    "cut_off": (b'{"times": [1, 2', "is not JSON: Expecting ',' delimiter at character 15"),
    "two_values": (b"{} {}", "is not JSON: Extra data at character 3"),
    "no_utf8": (b'{"a": "\xff"}', "is not text in UTF-8: byte 0xff at position 7"),
    "deep": (b"[" * 100_000, "nests too many objects and lists"),
    "endless_digits": (b'{"times": [' + b"9" * 10_000 + b"]}", "has a whole number of more than 4300 digits"),
}


def assert_problem(answer: httpx.Response, status: int, place: str | None, words: tuple[str, ...] = ()) -> None:
    assert answer.status_code == status
    assert answer.headers["content-type"] == PROBLEM_TYPE
    assert answer.headers["cache-control"] == "no-store"
    body = answer.json()
    assert body["status"] == status
    assert body["type"].startswith("urn:problem-type:bench-dragon:")
    assert body["title"]
    assert "Traceback" not in answer.text
    if place is not None:
        (item,) = [one for one in body["errors"] if place in (one.get("pointer"), one.get("name"))][:1]
        assert all(word in item["detail"] for word in words), item["detail"]
        assert item["detail"] in body["detail"] or len(body["errors"]) > 1


@pytest.fixture(autouse=True)
def next_request_is_answered(client: httpx.Client) -> Any:
    yield
    assert client.post("/trajectory", json=GOOD).status_code == 200


@pytest.mark.parametrize("bad", BAD_QUERIES, ids=lambda bad: bad.name)
def test_a_bad_query_is_a_problem(client: httpx.Client, bad: Bad) -> None:
    assert_problem(client.get(f"/collision-time?{bad.sent}"), 422, bad.place, bad.words)


@pytest.mark.parametrize("bad", BAD_BODIES, ids=lambda bad: bad.name)
def test_a_bad_body_is_a_problem(client: httpx.Client, bad: Bad) -> None:
    answer = client.post("/trajectory", content=bad.sent, headers={"Content-Type": "application/json"})
    assert_problem(answer, 422, bad.place, bad.words)


@pytest.mark.parametrize(("body", "words"), BROKEN_BODIES.values(), ids=BROKEN_BODIES)
def test_a_body_that_is_no_json_is_a_problem(client: httpx.Client, body: bytes, words: str) -> None:
    answer = client.post("/trajectory", content=body, headers={"Content-Type": "application/json"})
    assert_problem(answer, 400, "", (f"The body {words}",))


@pytest.mark.parametrize(("path", "kind"), [("/trajectory", "application/json"), ("/grade", "application/zip")])
def test_a_compressed_body_is_a_problem(client: httpx.Client, path: str, kind: str) -> None:
    headers = {"Content-Type": kind, "Content-Encoding": "gzip"}
    answer = client.post(path, content=gzip.compress(b"{}"), headers=headers)
    assert_problem(answer, 415, "Content-Encoding", ("must not be compressed", "got Content-Encoding: gzip"))
    assert answer.headers["accept-encoding"] == "identity"


def test_an_unknown_format_is_not_found_and_the_known_ones_are_named(client: httpx.Client) -> None:
    assert_problem(client.get("/figures/contact.pdf"), 404, "format", ('must be "svg" or "png", got "pdf"',))


def test_a_whole_number_may_have_a_fraction_of_nought(client: httpx.Client) -> None:
    """JSON has one type for numbers: 5.0 is the integer 5 of the schema."""
    bodies = ('{"dragon": {"benches": 5.0}, "times": [0]}', '{"dragon": {"benches": 5}, "times": [0]}')
    one, other = (client.post("/trajectory", content=b, headers={"Content-Type": "application/json"}) for b in bodies)
    assert one.json() == other.json()
    assert len(one.json()["x"][0]) == 6


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", "application/xml", ""])
def test_another_content_type_is_a_problem(client: httpx.Client, kind: str) -> None:
    answer = client.post("/trajectory", content=b"{}", headers={"Content-Type": kind})
    assert_problem(answer, 415, "Content-Type", ("application/json",))


@pytest.mark.parametrize(
    ("query", "place", "words"),
    [
        ("/minimum-pitch?turning_diameter=900", "turning_diameter", ("at most 200 m", "metres", "9 m")),
        ("/minimum-pitch?turning_diameter=0", "turning_diameter", ("at least",)),
        ("/minimum-pitch?overhang=0.6&body_length=2.2", "overhang", ("0.55 m", "0.6 m", "straight line")),
        ("/pitch-scan?benches=10001", "benches", ("at most 10000", "got 10001")),
        ("/clearance?step=0", "step", ("at least",)),
        ("/clearance?stop=433", "stop", ("432.9179", "folds")),
        ("/clearance?step=0.0001", "step", ("at most 1000000", "larger step")),
        ("/figures/trajectory.svg?time=500", "time", ("432.9179", "folds")),
        ("/figures/contact.svg?benches=50000", "benches", ("at most 5000",)),
        ("/paper?pitch=1", "pitch", ("unknown",)),
        ("/healthz?pitch=1", "pitch", ("unknown",)),
    ],
)
def test_a_bad_query_of_another_call_is_a_problem(
    client: httpx.Client, query: str, place: str, words: tuple[str, ...]
) -> None:
    assert_problem(client.get(query), 422, place, words)


def test_a_query_on_a_call_with_a_body_is_a_problem(client: httpx.Client) -> None:
    assert_problem(client.post("/trajectory?pitch=0.5", json={}), 422, "pitch", ("unknown",))


BENCH = {"x": 0, "y": 0, "heading": 0, "length": 2, "width": 0.3}


@pytest.mark.parametrize(
    ("body", "place", "words"),
    [
        ({}, "/benches", ("missing",)),
        ({"benches": []}, "/benches", ("at least 1 entry",)),
        ({"benches": [BENCH, BENCH | {"width": 0}]}, "/benches/1/width", ("at least 0.001 m",)),
        ({"benches": [BENCH | {"length": 220}]}, "/benches/0/length", ("metres", "2.2 m")),
        ({"benches": [BENCH | {"heading": 1e4}]}, "/benches/0/heading", ("at most 1000 rad", "radians")),
        ({"benches": [{"x": 0}]}, "/benches/0/width", ("missing",)),
        ({"benches": [BENCH], "chained": 1}, "/chained", ("boolean",)),
        ({"benches": [BENCH] * 20_001}, "/benches", ("at most 20000", "got 20001")),
        ({"benches": [BENCH] * 400, "chained": False}, "/benches", ("overlapping pairs must be at most 20000",)),
    ],
    ids=["none", "empty", "flat", "centimetres", "turned", "parts", "chained", "many", "heap"],
)
def test_bad_benches_are_a_problem(
    client: httpx.Client, body: dict[str, Any], place: str, words: tuple[str, ...]
) -> None:
    assert_problem(client.post("/overlaps", json=body), 422, place, words)


@pytest.mark.parametrize(
    ("method", "path", "status", "header"),
    [
        ("GET", "/nowhere", 404, ""),
        ("POST", "/nowhere", 404, ""),
        ("GET", "/figures/contact.gif", 404, ""),
        ("GET", "/trajectory/", 404, ""),
        ("GET", "/page/nowhere.js", 404, ""),
        ("GET", "/trajectory", 405, "OPTIONS, POST"),
        ("DELETE", "/collision-time", 405, "GET, HEAD, OPTIONS, POST"),
        ("BREW", "/collision-time", 405, "GET, HEAD, OPTIONS, POST"),
    ],
)
def test_a_wrong_path_or_method_is_a_problem(
    client: httpx.Client, method: str, path: str, status: int, header: str
) -> None:
    answer = client.request(method, path)
    assert_problem(answer, status, None)
    assert answer.headers.get("allow", "") == header


def test_an_answer_that_takes_too_much_work_is_a_problem(client: httpx.Client) -> None:
    answer = client.get("/minimum-pitch?body_length=0.001&overhang=0&turning_diameter=6")
    words = ("their minimum pitch was not found within ", "the turning circle 6 m across")
    assert_problem(answer, 422, "body_length", words)
    assert answer.json()["type"] == "urn:problem-type:bench-dragon:too-much-work"


@pytest.mark.parametrize(
    ("path", "accept"),
    [
        ("/collision-time", "text/html"),
        ("/collision-time", "application/json;q=0"),
        ("/figures/contact.svg", "image/png"),
        ("/paper", "text/csv"),
    ],
)
def test_a_media_type_that_the_call_does_not_offer_is_a_problem(client: httpx.Client, path: str, accept: str) -> None:
    assert_problem(client.get(path, headers={"Accept": accept}), 406, "Accept", (accept,))


TURNED = "Li\u202e.csv"
BENCH = {"lengths": [2.2], "widths": [0.3], "overhangs": [0.275], "names": [TURNED]}
VILLAGE = {"path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [40, 0]}]}}
NAMED: dict[str, tuple[str, dict[str, Any]]] = {
    "gate": ("/plan", {"json": VILLAGE | {"gates": [{"name": TURNED, "x": 0, "y": 0}]}}),
    "plan": ("/plan", {"json": VILLAGE | {"title": TURNED}}),
    "cues": ("/cues", {"json": VILLAGE | {"title": TURNED}}),
    "crew": ("/crew", {"json": VILLAGE | {"title": TURNED}}),
    "film": ("/films", {"json": VILLAGE | {"title": TURNED}}),
    "bench": ("/check", {"json": VILLAGE | {"dragon": BENCH}}),
    "workbook": ("/grade", {"params": {"name": TURNED}, "content": b"PK", "headers": {"Content-Type": XLSX_TYPE}}),
    "map": ("/places", {"params": {"name": TURNED}, "content": b"{}", "headers": {"Content-Type": BYTES}}),
}


@pytest.mark.parametrize("door", NAMED)
def test_a_name_that_turns_the_writing_around_is_refused_and_not_repeated(client: httpx.Client, door: str) -> None:
    path, sent = NAMED[door]
    refused = client.post(path, **sent)
    assert refused.status_code == 422, refused.text
    detail = refused.json()["detail"]
    assert "one line of plain text" in detail
    assert "\u202e" not in detail

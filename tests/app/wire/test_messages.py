"""Names and units in messages. For an unknown name only names are suggested that the call itself has at that place."""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages
from typing import Any

import httpx
import pytest

import app
from app.questions.check import CheckRequest
from app.questions.collision_time import CollisionQuery
from app.questions.overlaps import OverlapsRequest
from app.questions.trajectory import TrajectoryRequest
from app.wire.messages import names_at, owners
from app.wire.problem import BYTES_MAX
from app.wire.question import unit_of


def refusals(answer: httpx.Response) -> list[tuple[str, str, str]]:
    """Kind of the place, place and sentence of each error."""
    places = (("name" if "name" in one else "pointer", one) for one in answer.json()["errors"])
    return [(place, one[place], one["detail"]) for place, one in places]


@pytest.mark.parametrize(
    ("call", "name", "words"),
    [
        ("collision-time?pich=1", "pich", "did you mean pitch?"),
        ("collision-time?entry_radus=1", "entry_radus", "leave it out"),
        ("collision-time?turning_diameters=1", "turning_diameters", "leave it out"),
        ("minimum-pitch?turning_diameters=1", "turning_diameters", "did you mean turning_diameter?"),
        ("turn?entry_radus=1", "entry_radus", "did you mean entry_radius?"),
        ("turn?head_sped=1", "head_sped", "leave it out"),
        ("collision-time?start=1", "start", "leave it out"),
    ],
)
def test_an_unknown_name_in_a_query_gets_advice_from_its_own_call(
    client: httpx.Client, call: str, name: str, words: str
) -> None:
    answer = client.get(f"/{call}")
    assert answer.status_code == 422
    assert refusals(answer) == [("name", name, f'"{name}" is unknown here: {words}')]


@pytest.mark.parametrize(
    ("call", "body", "pointer", "words"),
    [
        ("check", {"path": {"kind": "turn", "entry_radus": 4}}, "/path/entry_radus", "did you mean entry_radius?"),
        ("check", {"path": {"entry_radus": 4}}, "/path/entry_radus", "leave it out"),
        ("check", {"dragon": {"lengths": [1], "widths": [1], "overhangs": [0], "width": 1}}, "/dragon/width",
         "did you mean widths?"),
        ("check", {"dragon": {"widhts": 1}}, "/dragon/widhts", "did you mean width?"),
        ("check", {"path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0], "stat": 0}]}},
         "/path/pieces/0/stat", "did you mean start?"),
        ("check", {"path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0], "pich": 0}]}},
         "/path/pieces/0/pich", "leave it out"),
        ("trajectory", {"time": {}}, "/time", "did you mean times?"),
        ("trajectory", {"times": {"stpo": 4}}, "/times/stpo", "did you mean stop?"),
        ("check", {"times": {}}, "/times", "leave it out"),
        ("turn", {"pitch": 1.7}, "/pitch", "it belongs in path"),
        ("overlaps", {"benches": [{"x": 0, "y": 0, "heading": 0, "length": 1, "width": 1, "hedding": 1}]},
         "/benches/0/hedding", "did you mean heading?"),
    ],
)  # fmt: skip
def test_an_unknown_name_in_a_body_gets_advice_from_its_own_place(
    client: httpx.Client, call: str, body: dict[str, Any], pointer: str, words: str
) -> None:
    answer = client.post(f"/{call}", json=body)
    assert answer.status_code == 422
    assert refusals(answer) == [("pointer", pointer, f'"{pointer.split("/")[-1]}" is unknown here: {words}')]


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity"])
def test_a_number_that_is_not_finite_is_shown_as_it_was_written(client: httpx.Client, number: str) -> None:
    body, headers = f'{{"path": {{"pitch": {number}}}}}', {"Content-Type": "application/json"}
    answer = client.post("/trajectory", content=body, headers=headers)
    assert answer.status_code == 422
    detail = f"pitch must be a finite number [m], got {number}"
    assert refusals(answer) == [("pointer", "/path/pitch", detail)]


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("pitch", "55cm", '[m], got "55cm": lengths are in metres, and 55 cm is 0.55 m'),
        ("width", "27.5 cm", '[m], got "27.5 cm": lengths are in metres, and 27.5 cm is 0.275 m'),
        ("head_speed", "55cm", '[m/s], got "55cm"'),
        ("pitch", "55in", '[m], got "55in"'),
    ],
)
def test_the_refusal_of_a_length_in_centimetres_names_it_in_metres(
    client: httpx.Client, name: str, text: str, words: str
) -> None:
    answer = client.get("/collision-time", params={name: text})
    assert answer.status_code == 422
    assert refusals(answer) == [("name", name, f"{name} must be a number {words}")]


def test_a_refusal_has_the_parts_of_its_sentence_with_numbers_and_units(client: httpx.Client) -> None:
    problem = client.get("/collision-time?pitch=55&benches=x").json()
    benches, pitch = problem["errors"]
    assert pitch == {
        "name": "pitch",
        "detail": "pitch must be at most 10 m, got 55 m: lengths are in metres, and 55 cm is 0.55 m",
        "template": "{field} must be at most {most}",
        "got": {"text": "55 m", "value": 55.0, "unit": "m"},
        "reason": "lengths are in metres, and {cm} is {m}",
        "values": {
            "field": {"text": "pitch", "parameter": "pitch"},
            "most": {"text": "10 m", "value": 10.0, "unit": "m"},
            "cm": {"text": "55 cm", "value": 55.0, "unit": "cm"},
            "m": {"text": "0.55 m", "value": 0.55, "unit": "m"},
        },
    }
    parts = {
        "template": "{field} must be a whole number",
        "got": {"text": '"x"', "value": "x"},
        "values": {"field": {"text": "benches", "parameter": "benches"}},
    }
    assert benches == {"name": "benches", "detail": 'benches must be a whole number, got "x"', **parts}
    assert {word: problem[word] for word in parts} == parts


def test_the_names_of_a_place_are_those_of_its_type() -> None:
    assert names_at(CollisionQuery, ()) == list(CollisionQuery.model_fields)
    assert "entry_radius" in names_at(CheckRequest, ("path", "turn"))
    assert names_at(CheckRequest, ("dragon", "bench_by_bench")) == ["lengths", "widths", "overhangs", "names"]
    assert names_at(CheckRequest, ("path", "route", "pieces", 3, "line")) == ["kind", "start", "end"]
    assert names_at(TrajectoryRequest, ("times", "range")) == ["start", "stop", "step"]
    assert names_at(OverlapsRequest, ("benches", 0))[:3] == ["x", "y", "heading"]
    assert names_at(CheckRequest, ("venue", "features")) == []


def test_a_name_has_the_same_unit_in_all_requests() -> None:
    """Sentences take the unit from the name, whichever requests this process knows; pieces of a path and entries of a
    list say whose they are."""
    for room in walk_packages(app.__path__, "app."):
        if room.name != "app.sweeps.cluster":
            import_module(room.name)
    units: dict[str, set[str]] = {}
    for model, before in owners().items():
        for name, field in {} if before else model.model_fields.items():
            units.setdefault(name, set()).add(unit_of(field))
    assert {name: result for name, result in units.items() if len(result) > 1} == {}


@pytest.mark.parametrize("text", ["龙" * 500, "\x01" * 300, '"\\' * 300, "{field}"])
def test_a_problem_stays_short_whatever_its_values_hold(client: httpx.Client, text: str) -> None:
    answer = client.post("/trajectory", json={f"{k}{text}": 1 for k in range(50)})
    assert answer.status_code == 422
    assert len(answer.content) <= BYTES_MAX
    assert answer.json()["detail"].endswith(" is unknown here: leave it out (and 49 more)") or len(text) > 100
    assert answer.json()["errors"]


def test_a_number_of_many_digits_is_reported_by_its_value(client: httpx.Client) -> None:
    problem = client.get("/collision-time", params={"pitch": f"{'0' * 3000}55"}).json()
    assert problem["detail"] == "pitch must be at most 10 m, got 55 m: lengths are in metres, and 55 cm is 0.55 m"
    assert problem["got"] == {"text": "55 m", "value": 55.0, "unit": "m"}


@pytest.mark.parametrize(
    ("body", "template", "reason"),
    [
        (b'{"a": 1,}', "{text} is not JSON", "{why} at character {place}. Send an object such as {}."),
        (b'{"a": \xff}', "{text} is not text in UTF-8", "byte {byte} at position {place}. Send an object such as {}."),
        (b'{"a": 1, "a": 2}', "{text} has an object with the name {name} more than once", "send an object such as {}."),
    ],
)
def test_a_body_that_cannot_be_read_has_a_template_of_its_own(
    client: httpx.Client, body: bytes, template: str, reason: str
) -> None:
    problem = client.post("/check", content=body, headers={"Content-Type": "application/json"}).json()
    assert (problem["template"], problem["reason"]) == (template, reason)
    assert problem["values"]["text"]["text"] == "The body"
    assert problem["errors"][0]["pointer"] == ""

"""A question over a body gives the same answer as over a query, and for any path and dragon the answer of core."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

import core
from app.questions.registry import QUESTIONS
from app.wire.dances import TimeSteps, UniformBody
from app.wire.paths import TurnFields
from app.wire.question import Question
from core.tolerance.curve import time_on_circle

# A value of each parameter of a query that differs from its default and leaves the answer short.
VALUES: dict[str, Any] = {
    "benches": 9,
    "width": 0.25,
    "start_turns": 12,
    "ratio": 1.5,
    "head_speed": 2,
    "turning_diameter": 8.5,
    "margin": 0.05,
    "cross_check": "pair",
    "speed_limit": 1.5,
    "samples": 2,
    "start": 10,
    "stop": 20,
    "step": 5,
    "time": 20,
}
BOTH = {name: question for name, question in QUESTIONS.items() if question.flat and question.body}
LENGTHS, WIDTHS, OVERHANGS = [3.41, 2.2, 2.0, 2.2, 1.9, 2.2], [0.3] * 6, [0.275] * 6
BENCHES = {"lengths": LENGTHS, "widths": WIDTHS, "overhangs": OVERHANGS}
POINTS = [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]
CROSSING = {"kind": "waypoints", "points": POINTS}


def in_body(question: Question, flat: dict[str, Any]) -> dict[str, Any]:
    """The body that asks what a query asks."""
    assert question.flat is not None
    assert question.body is not None
    kind = "turn" if issubclass(question.flat, TurnFields) else "spiral"
    body: dict[str, Any] = {}
    for name, value in flat.items():
        if name in question.body.model_fields:
            body[name] = value
        elif name in UniformBody.model_fields:
            body.setdefault("dragon", {})[name] = value
        elif name in TimeSteps.model_fields:
            body.setdefault("times", {})[name] = value
        else:
            body.setdefault("path", {"kind": kind})[name] = value
    return body


def test_only_a_question_without_a_dragon_is_asked_one_way_alone() -> None:
    assert [name for name, question in QUESTIONS.items() if question.flat and not question.body] == ["paper"]


@pytest.mark.parametrize("question", BOTH.values(), ids=BOTH)
def test_both_ways_of_asking_have_one_answer(client: httpx.Client, question: Question) -> None:
    assert question.flat is not None
    flat = {name: VALUES[name] for name in question.flat.model_fields if name in VALUES}
    path = question.path.format(format="svg")
    over_query, over_body = client.get(path, params=flat), client.post(path, json=in_body(question, flat))
    assert over_query.status_code == over_body.status_code == 200
    assert over_query.content == over_body.content
    assert over_query.headers["content-type"] == over_body.headers["content-type"]


def test_a_circle_ends_the_dance_where_a_time_would(client: httpx.Client) -> None:
    flat = {"benches": 30, "pitch": 0.6, "start_turns": 9, "turning_diameter": 8}
    path = {"kind": "spiral", "pitch": 0.6, "start_turns": 9}
    stop = time_on_circle(core.Dance(core.Dragon(30), core.Spiral(0.6, 9.0)), 4.0)
    over_body = client.post("/tolerance", json={"dragon": {"benches": 30}, "path": path, "stop": stop})
    assert over_body.raise_for_status().content == client.get("/tolerance", params=flat).content


@pytest.mark.parametrize("question", BOTH.values(), ids=BOTH)
def test_an_empty_body_asks_what_an_empty_query_asks(question: Question) -> None:
    assert question.flat is not None
    assert question.body is not None
    flat, body = question.flat(), question.body()
    shared = question.flat.model_fields.keys() & question.body.model_fields.keys() - {"time"}
    if question.name == "tolerance":  # over a body any dance, to its own end
        shared -= {"turning_diameter"}
    assert {name: getattr(flat, name) for name in shared} == {name: getattr(body, name) for name in shared}


def test_the_first_contact_of_any_dragon_on_any_path_is_that_of_core(client: httpx.Client) -> None:
    dragon = core.Dragon.of(LENGTHS, WIDTHS, OVERHANGS)
    dance = core.Dance(dragon, core.Route([core.Waypoints(tuple((x, y) for x, y in POINTS))]), 2.0)
    contact = core.first_contact(dance, margin=0.1, start=dance.begin)
    body = {"dragon": BENCHES, "path": CROSSING, "head_speed": 2, "margin": 0.1}
    answer = client.post("/collision-time", json=body).raise_for_status().json()
    assert (answer["outcome"], answer["time"]) == (contact.outcome.value, contact.time)
    check = client.post("/check", json=body).raise_for_status().json()
    assert check["first_contact"] == answer
    until = client.post("/collision-time", json=body | {"stop": 10}).raise_for_status().json()
    assert (until["outcome"], until["end"]["reason"]) == ("clear", "stop")


def test_the_times_of_a_highest_head_speed_are_those_of_the_given_dance(client: httpx.Client) -> None:
    """The same stretch of a path has other times at another head speed."""
    body = {"dragon": BENCHES, "path": CROSSING, "speed_limit": 3}
    slow = client.post("/maximum-head-speed", json=body | {"start": 20, "stop": 30}).raise_for_status().json()
    fast = client.post("/maximum-head-speed", json=body | {"head_speed": 2, "start": 10, "stop": 15})
    assert fast.raise_for_status().json() == slow
    refused = client.post("/maximum-head-speed", json={"dragon": BENCHES, "path": {"kind": "spiral"}})
    assert refused.json()["errors"][0]["pointer"] == "/stop"


def test_only_what_repeats_itself_may_be_long(client: httpx.Client) -> None:
    long = {"benches": 2_001}
    assert client.post("/collision-time", json={"dragon": long, "cross_check": "none"}).status_code == 200
    assert client.post("/minimum-pitch", json={"dragon": long, "cross_check": "none"}).status_code == 200
    on_a_turn = client.post("/collision-time", json={"dragon": long, "path": {"kind": "turn"}})
    assert on_a_turn.json()["detail"].startswith("benches must be at most 2000 here")
    listed = {"lengths": [2.2] * 2_001, "widths": [0.3] * 2_001, "overhangs": [0.275] * 2_001}
    for call in ("collision-time", "minimum-pitch", "pitch-scan", "shortest-turn", "turn-time", "quickest-turn"):
        refused = client.post(f"/{call}", json={"dragon": listed})
        assert refused.json()["errors"][0]["pointer"] == "/dragon/lengths"

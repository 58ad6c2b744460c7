"""The course of a path, with the stretches on which its dance breaks a limit."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

import core
from core import Area, Dragon, Line, Route, Venue
from core.breaches import breaches

RING = [[-9, -9], [39, -9], [39, 9], [-9, 9], [-9, -9]]
TREE = [[14, 0.2], [16, 0.2], [16, 2.2], [14, 2.2], [14, 0.2]]
VENUE = {
    "type": "FeatureCollection",
    "features": [
        {"type": "Feature", "properties": {"name": name}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
        for name, ring in (("square", RING), ("tree", TREE))
    ],
}
BODY: dict[str, Any] = {
    "dragon": {"benches": 3},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [30, 0]}]},
    "venue": VENUE,
}


def course(client: httpx.Client, **more: Any) -> dict[str, Any]:
    answer: dict[str, Any] = client.post("/course", json=BODY | more).raise_for_status().json()
    return answer


def test_stretches_are_those_of_core_and_come_only_if_asked_for(client: httpx.Client) -> None:
    assert course(client, margin=0.1)["breaches"] is None
    assert course(client, breaches=True)["breaches"] == []
    answer = course(client, breaches=True, margin=0.06, stray=0.1, speed_limit=0.5)
    square, tree = (Area(name, (tuple(map(tuple, ring)),)) for name, ring in (("square", RING), ("tree", TREE)))
    dance = core.Dance(Dragon(3), Route([Line((0, 0), (30, 0))]))
    result = breaches(dance, Venue(square, (tree,)), margin=0.06, stray=0.1, speed_limit=0.5)
    assert [one["kind"] for one in answer["breaches"]] == [one.kind.value for one in result]
    assert {one["kind"] for one in answer["breaches"]} == {"speed", "margin", "stray"}
    assert [one["start"] for one in answer["breaches"]] == [one.start for one in result]
    assert answer["breaches"][0]["points"] == result[0].points.tolist()
    late = course(client, breaches=True, margin=0.06, start=14.0)["breaches"]
    assert late[0]["start"] > next(one["start"] for one in answer["breaches"] if one["kind"] == "margin")


@pytest.mark.parametrize(
    "more",
    [
        {"path": {"kind": "waypoints", "points": [[0, 0], [2, 0], [2, 2]], "straight": [0, 1], "radius": 0.5}},
        {"dragon": {"benches": 60}},
    ],
    ids=["tight bend", "too short for the dragon"],
)
def test_a_path_that_the_dragon_cannot_follow_has_a_course_without_stretches(
    client: httpx.Client, more: dict[str, Any]
) -> None:
    answer = course(client, breaches=True, **more)
    assert answer["breaches"] is None
    assert len(answer["x"]) > 5

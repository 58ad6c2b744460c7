"""The course of a path, with the stretches on which its dance breaks a limit."""

from __future__ import annotations

from typing import Any

import pytest

import core
from core import Area, Dragon, Line, Route, Venue
from core.breaches import breaches
from tests.support.asking import Asking, box, line

CORNERS = {"square": (-9, -9, 39, 9), "tree": (14, 0.2, 16, 2.2)}
BODY = {
    "dragon": {"benches": 3},
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [30, 0]}]},
    "venue": {"type": "FeatureCollection", "features": [box(*CORNERS[name], name=name) for name in CORNERS]},
}


def test_stretches_are_those_of_core_and_come_only_if_asked_for(ask: Asking) -> None:
    assert ask("course", BODY | {"margin": 0.1})["breaches"] is None
    assert ask("course", BODY | {"breaches": True})["breaches"] == []
    limits = {"margin": 0.06, "stray": 0.1, "speed_limit": 0.5}
    got = ask("course", BODY | limits | {"breaches": True})["breaches"]
    rings = [box(*corners)["coordinates"][0] for corners in CORNERS.values()]
    square, tree = (Area(name, (tuple(map(tuple, ring)),)) for name, ring in zip(CORNERS, rings, strict=True))
    result = breaches(core.Dance(Dragon(3), Route([Line((0, 0), (30, 0))])), Venue(square, (tree,)), **limits)
    assert [(one["kind"], one["start"]) for one in got] == [(one.kind.value, one.start) for one in result]
    assert {one["kind"] for one in got} == {"speed", "margin", "stray"}
    assert got[0]["points"] == result[0].points.tolist()
    late = ask("course", BODY | {"breaches": True, "margin": 0.06, "start": 14.0})["breaches"]
    assert late[0]["start"] > next(one["start"] for one in got if one["kind"] == "margin")


@pytest.mark.parametrize(
    "more",
    [{"path": line((0, 0), (2, 0), (2, 2), straight=[0, 1], radius=0.5)}, {"dragon": {"benches": 60}}],
    ids=["tight bend", "too short for the dragon"],
)
def test_a_path_that_the_dragon_cannot_follow_has_a_course_without_stretches(ask: Asking, more: Any) -> None:
    answer = ask("course", BODY | {"breaches": True} | more)
    assert answer["breaches"] is None
    assert len(answer["x"]) > 5

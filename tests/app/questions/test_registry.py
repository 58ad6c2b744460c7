"""The questions: each stands in a file of its own, and its answer has the numbers of core."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

import core
from app.questions import registry
from core import Dance, Dragon, Route, Spiral, Turn, Waypoints

DRAGON, CLOSE = Dragon(20), Dance(Dragon(40), Spiral(0.5, 8.0))
POINTS = [[0.0, 0.0], [20.0, 0.0], [21.0, 2.0], [0.0, 3.0]]


def listed(value: Any) -> Any:
    """Numbers as JSON has them."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return [listed(part) for part in value] if isinstance(value, list | tuple) else value


def fields_of(result: object, *names: str) -> dict[str, Any]:
    return {name: listed(getattr(result, name)) for name in names}


def clearance() -> dict[str, Any]:
    return fields_of(core.clearance_profile(CLOSE, [10.0, 20.5]), "time", "clearance", "benches")


def course() -> dict[str, Any]:
    result = core.course(Route([Waypoints(POINTS)]), DRAGON)
    return {"x": result.points[:, 0].tolist(), "y": result.points[:, 1].tolist()} | fields_of(result, "s", "length")


def maximum_head_speed() -> dict[str, Any]:
    result = core.maximum_head_speed(Dance(DRAGON, Turn(1.7)), 1.5)
    return fields_of(result, "head_speed", "head_speed_bracket", "speed_ratio", "handles", "time")


def shortest_turn() -> dict[str, Any]:
    result = core.deepest_turn(Dragon(14, 1.6, 1.6), 1.2, margin=0.1)
    assert result.limited_by is core.TurnLimit.CONTACT
    return fields_of(result, "entry_bracket", "benches", "time", "evaluations") | {"length": result.turn.length}


def turn_time() -> dict[str, Any]:
    result = core.turn_time(DRAGON, Turn(1.7, exit_radius=4.45), 1.5)
    return fields_of(result, "length", "head_speed", "time", "handles")


def quickest_turn() -> dict[str, Any]:
    result = core.quickest_turn(Dragon(8), 1.7, speed_limit=1.5, margin=0.01)
    return fields_of(result, "length", "head_speed", "time", "handles") | fields_of(
        result.turn, "entry_radius", "exit_radius"
    )


REQUESTS: dict[str, tuple[dict[str, Any], Callable[[], dict[str, Any]]]] = {
    "clearance": (
        {"dragon": {"benches": 40}, "path": {"pitch": 0.5, "start_turns": 8}, "times": [10, 20.5]},
        clearance,
    ),
    "course": ({"dragon": {"benches": 20}, "path": {"kind": "waypoints", "points": POINTS}}, course),
    "maximum_head_speed": ({"dragon": {"benches": 20}, "speed_limit": 1.5}, maximum_head_speed),
    "turn_time": (
        {"dragon": {"benches": 20}, "path": {"kind": "turn", "exit_radius": 4.45}, "speed_limit": 1.5},
        turn_time,
    ),
    "quickest_turn": ({"dragon": {"benches": 8}, "speed_limit": 1.5, "margin": 0.01}, quickest_turn),
    "shortest_turn": (
        {
            "dragon": {"benches": 14, "head_length": 1.6, "body_length": 1.6},
            "pitch": 1.2,
            "margin": 0.1,
            "exit_opposite": True,
        },
        shortest_turn,
    ),
}


@pytest.mark.parametrize("question", REQUESTS)
def test_an_answer_has_the_numbers_of_core(client: httpx.Client, question: str) -> None:
    body, request = REQUESTS[question]
    known = request()
    got = client.post(f"/{question.replace('_', '-')}", json=body).raise_for_status().json()
    assert {name: got[name] for name in known} == known


def test_a_pitch_scan_has_the_first_contacts_of_core(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 30}, "samples": 3, "locate": False}
    got = client.post("/pitch-scan", json=body).raise_for_status().json()
    assert got["minimum_pitch"] == core.minimum_pitch(Dragon(30)).pitch
    heads = [core.first_contact(Dance(Dragon(30), Spiral(pitch, 16.0))).head for pitch in got["pitch"]]
    assert got["radius"] == pytest.approx([head.radius for head in heads if head], rel=0, abs=1e-9)  # [m]
    assert len(heads) == 3


def test_overlaps_are_those_of_core(client: httpx.Client) -> None:
    places = [(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (0.5, 0.2, 1.0), (9.2, 0.1, 0.5)]
    benches = [dict(zip(("x", "y", "heading"), place, strict=True), length=2.2, width=0.3) for place in places]
    got = client.post("/overlaps", json={"benches": benches}).raise_for_status().json()["overlaps"]
    result = core.overlaps(places, [2.2] * 4, [0.3] * 4)
    assert [one["benches"] for one in got] == result.pairs.tolist() == [[0, 2], [1, 3]]
    assert [one["separation"] for one in got] == result.contact.separation.tolist()


def test_every_file_of_this_folder_has_its_question() -> None:
    files = {path.stem for path in Path(registry.__file__).parent.glob("*.py")} - {"__init__", "registry"}
    assert {question.answer.__module__.rpartition(".")[2] for question in registry.QUESTIONS.values()} == files

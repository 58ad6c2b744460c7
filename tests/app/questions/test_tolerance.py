"""Tolerance over HTTP and from a terminal: core's answers, and refusals."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

from app.questions.tolerance import ToleranceRequest
from app.settings import Settings
from core import (
    Dance,
    Dragon,
    Spiral,
    bench_poses,
    first_contact,
    minimum_pitch,
    overlaps,
    performance_tolerance,
    tolerance,
    tolerance_curve,
    uncertain_tolerance,
)
from core.tolerance.curve import time_on_circle
from tests.support.command import run

SMALL = {"benches": 40, "start_turns": 9}
SQUARE = {"type": "Polygon", "coordinates": [[[-15, -15], [15, -15], [15, 15], [-15, 15], [-15, -15]]]}


def test_the_way_to_the_circle_has_the_tolerance_of_core_and_a_pose_that_overlaps(client: httpx.Client) -> None:
    got = client.get("/tolerance", params=SMALL | {"pitch": 0.6}).raise_for_status().json()
    dance = Dance(Dragon(40), Spiral(0.6, 9.0))
    result = tolerance(dance, stop=time_on_circle(dance, 4.5))
    assert (got["stray"], tuple(got["stray_bracket"])) == (result.stray, result.stray_bracket)
    assert (got["time"], tuple(got["benches"]), got["limited_by"]) == (result.time, result.benches, "benches")
    handles = np.array(got["exhibit"]["handles"])
    touching = overlaps(bench_poses(handles), dance.dragon.lengths, dance.dragon.widths)
    assert result.benches in {tuple(pair) for pair in touching.pairs.tolist()}


def test_any_dance_in_any_venue_has_a_tolerance(client: httpx.Client) -> None:
    square = [[-9, -9], [9, -9], [9, 9], [-9, 9], [-9, -9]]
    venue = {"type": "Polygon", "coordinates": [square]}
    path = {"kind": "spiral", "pitch": 0.9, "start_turns": 9.0}
    body = {"dragon": {"benches": 12}, "path": path, "stop": 20.0, "venue": venue}
    got = client.post("/tolerance", json=body).raise_for_status().json()
    alone = client.post("/tolerance", json={**body, "venue": None}).raise_for_status().json()
    assert got["limited_by"] == "venue"
    assert got["benches"][1] is None
    assert 0.0 < got["stray"] < alone["stray"]


def test_sizes_may_be_known_only_to_within_an_error(client: httpx.Client) -> None:
    errors = {"length_error": 0.01, "pitch_error": 0.005}
    got = client.get("/tolerance", params=SMALL | errors | {"pitch": 0.7}).raise_for_status().json()
    assert got["stray_with_errors"] == uncertain_tolerance(Dragon(40), 0.7, **errors)
    assert 0.0 < got["stray_with_errors"] < got["stray"]
    spiral = {"kind": "spiral", "pitch": 0.7, "start_turns": 9}
    body = {"dragon": {"benches": 40}, "path": spiral, "turning_diameter": 9} | errors
    assert client.post("/tolerance", json=body).raise_for_status().json() == got
    exact = client.get("/tolerance", params=SMALL | {"pitch": 0.7}).json()
    assert exact == got | {"stray_with_errors": None}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"turning_diameter": None}, "length_error must be 0, unless the dance has no venue and ends on"),
        ({"venue": SQUARE}, "length_error must be 0, unless the dance has no venue"),
        ({"path": {"kind": "turn"}, "turning_diameter": None}, "length_error must be 0, unless the dance"),
        ({"length_error": 0.9}, "length_error must be at most 0.825 m, got 0.9 m"),
    ],
    ids=["no circle", "venue", "turn", "too large"],
)
def test_errors_of_sizes_are_for_a_spiral_to_a_circle(client: httpx.Client, change: dict[str, Any], words: str) -> None:
    body = {"dragon": {"benches": 12}, "turning_diameter": 9, "length_error": 0.01}
    refused = client.post("/tolerance", json=body | change)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == "/length_error"
    assert refused.json()["detail"].startswith(words)


def test_the_curve_begins_at_the_minimum_pitch_and_holds_the_tolerances_of_core(client: httpx.Client) -> None:
    got = client.get("/tolerance-curve", params={"benches": 40, "samples": 3}).raise_for_status().json()
    least = minimum_pitch(Dragon(40)).pitch
    assert got["pitch"] == pytest.approx([least, 1.5 * least, 2.0 * least], rel=1e-5)
    curve = tolerance_curve(Dragon(40), got["pitch"])
    assert got["stray"] == curve.stray.tolist()
    assert got["touching"] == [one.stray_bracket[1] for one in curve.tolerances]
    assert got["stray"][0] == pytest.approx(0.0, abs=1e-6)


def test_a_body_may_end_on_a_circle_as_the_query_does_and_only_on_a_spiral(client: httpx.Client) -> None:
    request = {"dragon": {"benches": 40}, "turning_diameter": 12}
    query = {"benches": 40, "turning_diameter": 12}
    assert (
        client.post("/tolerance", json=request).json()
        == client.get("/tolerance", params=query).raise_for_status().json()
    )


@pytest.mark.parametrize("call", ["/tolerance", "/contact-probability"])
@pytest.mark.parametrize(
    ("more", "pointer", "words"),
    [
        (
            {"path": {"kind": "turn"}},
            "/turning_diameter",
            "must be left out, unless the path is a spiral and stop is left out, got 12 m",
        ),
        (
            {"stop": 10},
            "/turning_diameter",
            "must be left out, unless the path is a spiral and stop is left out, got 12 m",
        ),
        ({"start": 300}, "/start", "must be before the head is on the turning circle, at 236.721489 s, got 300 s"),
        ({"turning_diameter": 40}, "/turning_diameter", "must be smaller, got 40 m"),
    ],
    ids=["turn", "stop", "start", "too large"],
)
def test_a_circle_that_cannot_end_a_dance_is_refused(
    client: httpx.Client, call: str, more: dict[str, Any], pointer: str, words: str
) -> None:
    refused = client.post(call, json={"dragon": {"benches": 40}, "turning_diameter": 12} | more)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == pointer
    assert words in refused.json()["detail"]


def test_a_curve_is_answered_where_a_dance_at_the_minimum_pitch_begins_on_the_circle(client: httpx.Client) -> None:
    got = (
        client.get("/tolerance-curve", params={"benches": 2, "start_turns": 9, "samples": 2}).raise_for_status().json()
    )
    assert got["pitch"][0] == pytest.approx(0.5, rel=1e-5)
    assert got["limited_by"] == ["chord", "chord"]


def test_a_stray_on_other_calls_is_that_of_core(client: httpx.Client) -> None:
    first = client.get("/collision-time", params={"stray": 0.02}).raise_for_status().json()
    assert first["time"] == first_contact(Dance(Dragon(), Spiral()), stray=0.02).time
    assert first["cross_check"]["agree"]
    assert len(first["cross_check"]["judged"]) == Dragon().benches
    play = client.get("/collision-time", params={"stray": 0.01, "hole": 0.05, "pin": 0.03}).raise_for_status().json()
    assert play["time"] == pytest.approx(first["time"], abs=1e-8)
    pitch = client.get("/minimum-pitch", params={"stray": 0.02}).raise_for_status().json()
    assert pitch["pitch"] == minimum_pitch(Dragon(), stray=0.02).pitch
    assert pitch["cross_check"]["agree"]


@pytest.mark.parametrize("call", ["/collision-time", "/minimum-pitch"])
def test_a_stray_of_0_gives_the_same_bytes(client: httpx.Client, call: str) -> None:
    assert client.get(call, params={"stray": 0, "hole": 0, "pin": 0}).content == client.get(call).content


@pytest.mark.parametrize(
    ("call", "query", "field", "words"),
    [
        ("/collision-time", {"stray": 1}, "stray", "at most half the chord of bench 1"),
        ("/collision-time", {"stray": -0.1}, "stray", "-0.1"),
        ("/minimum-pitch", {"hole": 0.05, "pin": 0.06}, "pin", "no wider than its hole (0.05 m), got 0.06 m"),
        ("/tolerance", {"turning_diameter": 40}, "turning_diameter", "must be smaller, got 40 m: at a pitch of 0.55 m"),
        ("/tolerance", {"turning_diameter": 17.6}, "turning_diameter", "the dance starts on that circle"),
        ("/tolerance-curve", {"from_pitch": 0.6, "to_pitch": 0.6}, "to_pitch", "larger than the lowest pitch (0.6 m)"),
        ("/tolerance", {"turning_diameter": 1}, "turning_diameter", "before the head is on that circle"),
    ],
)
def test_impossible_values_are_refused_with_their_limit(
    client: httpx.Client, call: str, query: dict[str, Any], field: str, words: str
) -> None:
    answer = client.get(call, params=query)
    assert answer.status_code == 422
    error = answer.json()["errors"][0]
    assert error["name"] == field
    assert words in error["detail"]


def test_an_answer_says_which_stray_it_allows_for(client: httpx.Client) -> None:
    fields = SMALL | {"stray": 0.01, "hole": 0.05, "pin": 0.04}
    for call in ("/collision-time", "/minimum-pitch"):
        assert client.get(call, params=fields).json()["stray"] == pytest.approx(0.015)
        assert client.get(call, params=SMALL).json()["stray"] is None


def test_the_command_prints_the_json_of_the_service(client: httpx.Client) -> None:
    options = ["--benches", "40", "--start-turns", "9", "--pitch", "0.6"]
    assert (
        json.loads(run("tolerance", *options, "--json").stdout)
        == client.get("/tolerance", params=SMALL | {"pitch": 0.6}).json()
    )


# -- several dances ------------------------------------------------------------------------------------------

LANES = [{"kind": "waypoints", "points": points} for points in ([[0, 0], [30, 0]], [[30, 0.8], [0, 0.8]])]
SEVERAL: dict[str, Any] = {
    "dances": [
        {"name": name, "dragon": {"benches": 4}, "path": path} for name, path in zip(("a", "b"), LANES, strict=True)
    ]
}


def test_several_dances_have_the_tolerance_of_core(client: httpx.Client) -> None:
    got = client.post("/tolerance", json=SEVERAL).raise_for_status().json()
    performance, _ = ToleranceRequest.model_validate(SEVERAL).to_placed(Settings())
    result = performance_tolerance(performance)
    assert (got["stray"], tuple(got["stray_bracket"])) == (result.stray, result.stray_bracket)
    assert (got["dragons"], got["names"], got["limited_by"]) == ([0, 1], ["a", "b"], "benches")
    assert (got["time"], tuple(got["benches"])) == (result.time, result.benches)
    assert got["own"] == [one.stray for one in result.own]
    assert result.exhibit is not None
    assert got["exhibit"]["handles"] == [own.tolist() for own in result.exhibit.handles]
    assert got["certificate"]["claim"]["stray"] == got["stray"]
    clear = client.post("/encounter", json=SEVERAL | {"stray": got["stray"]}).raise_for_status().json()
    assert clear["outcome"] == "clear"


def test_a_wall_may_limit_several_dances(client: httpx.Client) -> None:
    square = [[-10, -0.3], [40, -0.3], [40, 9], [-10, 9], [-10, -0.3]]
    venue = {"type": "Polygon", "coordinates": [square]}
    got = client.post("/tolerance", json=SEVERAL | {"venue": venue}).raise_for_status().json()
    alone = {"dragon": {"benches": 4}, "path": LANES[0], "venue": venue}
    assert got["stray"] == client.post("/tolerance", json=alone).raise_for_status().json()["stray"]
    assert (got["limited_by"], got["dragons"], got["benches"][1]) == ("venue", [0], None)


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        ({"turning_diameter": 9}, "/turning_diameter"),
        ({"length_error": 0.01}, "/length_error"),
        ({"path": LANES[0]}, "/path"),
        ({"start": -9}, "/start"),
    ],
)
def test_what_is_for_one_dance_is_refused_beside_several(
    client: httpx.Client, change: dict[str, Any], pointer: str
) -> None:
    refused = client.post("/tolerance", json=SEVERAL | change)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == pointer


def test_the_command_takes_a_file_of_several(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "lanes.json"
    file.write_text(json.dumps(SEVERAL))
    known = client.post("/tolerance", json=SEVERAL).raise_for_status()
    assert run("tolerance", str(file), "--json").stdout.encode() == known.content + b"\n"
    result = run("tolerance", str(file))
    assert (result.returncode, result.stderr) == (0, "")
    assert "a, b" in result.stdout

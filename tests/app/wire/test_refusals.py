"""Each error of core reaches the client with a name that the client used or can use, and with the given value."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, NamedTuple

import httpx
import pytest

from tests.support.command import run

# Names of core that no request has.
INSIDE = re.compile(r"turning_radius|path\.path|pieces|times\[|dragon\.|path\.")


class Wrong(NamedTuple):
    """A question with one wrong value, the name of that value, and what the refusal says."""

    call: str
    query: dict[str, Any]
    name: str
    words: str


# Benches i and i + 2 are 4e-9 m apart on a straight line, and overlap on the widest spiral that is allowed.
HARDLY_APART = {"benches": 5, "head_length": 2.2, "overhang": 0.549999999}
FLAT = [
    Wrong("collision-time", {"start_turns": 0.5}, "start_turns", "must be more than 2.345"),
    Wrong("collision-time", {"overhang": 1.1}, "overhang", "must be less than half of body_length (2.2 m / 2 = 1.1 m)"),
    Wrong("collision-time", {"head_length": 0.5, "overhang": 0.25}, "overhang", "less than half of head_length"),
    Wrong("collision-time", {"benches": 100_001}, "benches", "must be at most 100000 here, got 100001"),
    Wrong(
        "minimum-pitch", HARDLY_APART, "overhang", "must be smaller, got 0.549999999 m: at a pitch of 10000 m benches"
    ),
    Wrong("minimum-pitch", {"margin": 1.0999999}, "margin", "must be smaller, got 1.0999999 m: at a pitch of 10000 m"),
    Wrong(
        "minimum-pitch", {"margin": 1.09}, "margin", "must be smaller, got 1.09 m: the minimum pitch is 708.344074 m"
    ),
    Wrong("minimum-pitch", {"start_turns": 0.2}, "start_turns", "must be at least 0.45 turns, or the turning circle"),
    Wrong(
        "minimum-pitch", {"start_turns": 0.2}, "start_turns", "got 0.2 turns: the minimum pitch is 22.5 m, and pitch"
    ),
    Wrong(
        "minimum-pitch",
        {"overhang": 0.549},
        "overhang",
        "must be smaller, or the benches narrower, got 0.549 m: the min",
    ),
    Wrong("minimum-pitch", {"overhang": 0.56}, "overhang", "must be less than a quarter of body_length (2.2 m / 4 = "),
    Wrong("minimum-pitch", {"margin": 1.2}, "margin", "must be less than 1.1 m, got 1.2 m"),
    Wrong("minimum-pitch", {"start_turns": 1e-5}, "start_turns", "must be at least 0.00045 turns"),
    Wrong("shortest-turn", {"turning_diameter": 8}, "turning_diameter", "must be larger, got 8 m: a turn that"),
    Wrong("shortest-turn", {"turning_diameter": 8}, "turning_diameter", "got 8 m"),
    Wrong("shortest-turn", {"margin": 0.4}, "turning_diameter", "come within 0.4 m"),
    Wrong("shortest-turn", {"pitch": 0.8}, "turning_diameter", "benches 0 and 15 touch 13.286258 s after the entry"),
    Wrong(
        "shortest-turn", {"start_turns": 2}, "start_turns", "must be more than 2.64706 turns, so that the coil begins"
    ),
    Wrong("turn", {"start_turns": 2}, "start_turns", "must be more than 2.64706 turns, so that the coil begins"),
    Wrong("turn", {"entry_radius": 5}, "entry_radius", "must be at most 4.5 m, got 5 m"),
    Wrong("turn", {"pitch": 0.001, "turning_diameter": 0.002}, "turning_diameter", "must leave arcs with radii from"),
    Wrong("turn", {"pitch": 0.001, "turning_diameter": 0.01, "ratio": 0.01}, "ratio", "must leave arcs with radii"),
    Wrong("maximum-head-speed", {"turning_diameter": 4}, "turning_diameter", "must be larger than 4 m: the turn"),
    Wrong("maximum-head-speed", {"turning_diameter": 4}, "turning_diameter", "the turn bends to a radius of 0.6727"),
    Wrong("maximum-head-speed", {"entry_radius": 2}, "entry_radius", "must be larger than 2 m: the turn bends"),
    Wrong("maximum-head-speed", {"ratio": 20}, "ratio", "must be nearer to 1 than 20: the turn bends to a radius of 0"),
    Wrong("maximum-head-speed", {"entry_radius": 4.4, "ratio": 2.1}, "entry_radius", "must be larger than 4.4 m: the"),
    Wrong("maximum-head-speed", {"turning_diameter": 8}, "turning_diameter", "must be larger than 8 m: the turn bends"),
    Wrong("maximum-head-speed", {"turning_diameter": 4, "entry_radius": 2, "ratio": 3}, "turning_diameter", "than 4 m"),
    Wrong("maximum-head-speed", {"pitch": 0.55, "turning_diameter": 8.58}, "pitch", "must be larger than 0.55 m"),
    Wrong("maximum-head-speed", {"start_turns": 2}, "start_turns", "must be more than 2.64706 turns"),
]
FLAT_GET = [
    Wrong("clearance", {"stop": 440.5}, "stop", "must be at most 432.917924228 s, when bench 0 folds, got 440.5 s"),
    Wrong("clearance", {"start": 432.9179242284, "stop": 433}, "start", "must be at most 432.917924228 s, when bench"),
    Wrong("clearance", {"start": 432.9179242284, "stop": 433}, "start", "got 432.9179242284 s"),
    Wrong("clearance", {"start": 435, "stop": 440}, "start", "must be at most 432.917924228 s"),
    Wrong("clearance", {"start": 5, "stop": 1}, "stop", "must not be before start (5 s), got 1 s"),
    Wrong("clearance", {"step": 1e-4}, "step", "instants x handles must be at most 1000000 here"),
    Wrong("clearance", {"benches": 2}, "benches", "must be at least 3, so that two share no handle, got 2"),
    Wrong("pitch-scan", HARDLY_APART, "overhang", "must be smaller, got 0.549999999 m: at a pitch of 10000 m"),
    Wrong("pitch-scan", {"turning_diameter": 0.036, "benches": 1, "head_length": 0.005, "overhang": 0},
          "turning_diameter", "must allow pitches of 0.00125 m and more, got 0.036 m"),
    Wrong("figures/trajectory.svg", {"time": 440}, "time", "must be at most 432.917924228 s, when bench 0"),
    Wrong("figures/contact.svg", {"start_turns": 0.5}, "start_turns", "must be more than 2.345"),
]  # fmt: skip
LINE = {"kind": "line", "start": [0, 0], "end": [60, 0]}
ROUTE = {"kind": "route", "pieces": [LINE]}
BODIES = [
    Wrong("trajectory", {"path": {"start_turns": 0.5}}, "/path/start_turns", "path.start_turns must be more than 2.3"),
    Wrong("trajectory", {"dragon": {"overhang": 1.1}}, "/dragon/overhang", "dragon.overhang must be less than half of"),
    Wrong("trajectory", {"times": {"stop": 440.5}}, "/times/stop", "times.stop must be at most 432.917924228 s"),
    Wrong("trajectory", {"times": {"stop": 440.5}}, "/times/stop", "got 440.5 s"),
    Wrong("trajectory", {"times": {"start": 435, "stop": 440}}, "/times/start", "times.start must be at most 432.9179"),
    Wrong("trajectory", {"times": [0, 440]}, "/times/1", "times[1] must be at most 432.917924228 s"),
    Wrong("trajectory", {"path": {"pitch": 0.3, "start_turns": 12}}, "/times/stop", "times.stop must be at most"),
    Wrong("trajectory", {"path": {"pitch": 0.3, "start_turns": 12}}, "/times/stop", "got 300 s"),
    Wrong("trajectory", {"path": ROUTE, "times": {"stop": 5}, "dragon": {"benches": 9}}, "/times/stop",
          "times.stop must be at least 16.0"),
    Wrong("trajectory", {"path": ROUTE, "times": {"start": 5}, "dragon": {"benches": 9}}, "/times/start",
          "times.start must be at least 16.0"),
    Wrong("trajectory", {"path": ROUTE, "times": [-1e5], "dragon": {"benches": 9}}, "/times/0", "times[0] must be"),
    Wrong("trajectory", {"path": {"kind": "turn", "start_turns": 2}}, "/path/start_turns", "path.start_turns must be"),
    Wrong("trajectory", {"path": {"kind": "turn", "turning_diameter": 0.002, "pitch": 0.001}},
          "/path/turning_diameter", "path.turning_diameter must leave arcs with radii from"),
    Wrong("trajectory", {"path": {"kind": "turn", "turning_diameter": 0.002, "pitch": 0.001}},
          "/path/turning_diameter", "got 0.002 m"),
    Wrong("trajectory", {"path": {"kind": "turn", "entry_radius": 9}}, "/path/entry_radius", "path.entry_radius must"),
    Wrong("trajectory", {"path": {"kind": "turn", "turning_diameter": 4}}, "/path/turning_diameter",
          "path.turning_diameter must be larger than 4 m: the turn bends to a radius of 0.6727 m, and bench 0 follows"),
    Wrong("check", {"path": {"kind": "turn", "turning_diameter": 4}}, "/path/turning_diameter", "must be larger than"),
    Wrong("check", {"path": {"kind": "turn", "ratio": 20}}, "/path/ratio", "path.ratio must be nearer to 1 than 20"),
    Wrong("check", {"path": {"kind": "turn", "entry_radius": 2}}, "/path/entry_radius", "must be larger than 2 m: the"),
    Wrong("check", {"path": {"kind": "turn"}, "dragon": {"lengths": [4], "widths": [0.3], "overhangs": [0]}},
          "/path/turning_diameter", "bench 0 follows none below 2.00"),
    Wrong("clearance", {"path": {"kind": "turn", "turning_diameter": 4}}, "/path/turning_diameter", "must be larger"),
    Wrong("figures/contact.svg", {"path": {"kind": "turn", "turning_diameter": 4}}, "/path/turning_diameter", "larger"),
    Wrong("trajectory", {"path": {"kind": "waypoints", "points": [[0, 0], [9, 0], [9, 0]]}}, "/path/points/2",
          "path.points[2] must be at least 0.001 m from the point before it"),
    Wrong("trajectory", {"path": {"kind": "route", "pieces": [LINE, LINE]}}, "/path/pieces/1", "must close"),
    Wrong("trajectory", {"path": ROUTE}, "/path", "path is too short for the whole dragon"),
    Wrong("clearance", {"dragon": {"benches": 2}}, "/dragon/benches", "dragon.benches must be at least 3"),
    Wrong("check", {"start": 500}, "/start", "start must be before 432.917924228 s, when bench 0 folds, got 500 s"),
    Wrong("check", {"start": 5, "stop": 5}, "/stop", "stop must be after start (5 s), got 5 s"),
    Wrong("check", {"path": ROUTE, "dragon": {"benches": 9}, "stop": 1e4}, "/stop", "stop must be at most 60.0"),
    Wrong("check", {"path": {"kind": "turn"}, "stop": 1e5}, "/stop", "stop must be at most"),
    Wrong("check", {"path": {"kind": "turn", "turning_diameter": 0.002, "pitch": 0.001, "entry_radius": 0.001}},
          "/path/entry_radius", "path.entry_radius must leave arcs"),
    Wrong("maximum-head-speed", {"path": {"kind": "spiral"}}, "/stop",
          "stop must be given: the run ends at a fold, towards which speeds grow without bound; it must be before 432"),
    Wrong("maximum-head-speed", {"path": {"kind": "spiral"}, "stop": None}, "/stop", "stop must be given: the run"),
    Wrong("figures/trajectory.svg", {"time": 440}, "/time", "time must be at most 432.917924228 s, when bench 0"),
    Wrong("figures/contact.svg", {"path": {"kind": "turn"}, "stop": 1e5}, "/stop", "stop must be at most"),
]  # fmt: skip


def label_of(request: Wrong) -> str:
    return f"{request.call} {request.name} {request.words[:30]}"


@pytest.mark.parametrize("wanted", FLAT + FLAT_GET, ids=label_of)
def test_a_query_is_refused_by_its_own_name_and_value(client: httpx.Client, wanted: Wrong) -> None:
    answer = client.get(f"/{wanted.call}", params=wanted.query)
    assert answer.status_code == 422
    ((item,), detail) = answer.json()["errors"], answer.json()["detail"]
    assert (item["name"], item["detail"]) == (wanted.name, detail)
    assert wanted.words in detail
    assert not INSIDE.search(detail)
    calls = client.get("/openapi.json").json()["paths"]
    parameters = calls[f"/{wanted.call.replace('.svg', '.{format}')}"]["get"]["parameters"]
    assert wanted.name in {parameter["name"] for parameter in parameters}


@pytest.mark.parametrize("wanted", FLAT, ids=label_of)
def test_an_option_is_refused_in_the_same_words(client: httpx.Client, wanted: Wrong) -> None:
    options = [f"--{name.replace('_', '-')}={value}" for name, value in wanted.query.items()]
    done = run(wanted.call, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"Error: {client.get(f'/{wanted.call}', params=wanted.query).json()['detail']}\n"


@pytest.mark.parametrize("wanted", BODIES, ids=label_of)
def test_a_body_is_refused_by_a_place_in_it(client: httpx.Client, wanted: Wrong) -> None:
    answer = client.post(f"/{wanted.call}", json=wanted.query)
    assert answer.status_code == 422
    ((item,), detail) = answer.json()["errors"], answer.json()["detail"]
    assert (item["pointer"], item["detail"]) == (wanted.name, detail)
    assert wanted.words in detail
    assert not re.search(r"turning_radius|path\.path", detail)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["trajectory", "--stop", "440.5"], "stop must be at most 432.917924228 s, when bench 0 folds, got 440.5 s"),
        (
            ["trajectory", "--start", "435", "--stop", "440"],
            "start must be at most 432.917924228 s, when bench 0 folds",
        ),
        (["trajectory", "--times", "0,440"], "times[1] must be at most 432.917924228 s, when bench 0 folds, got 440 s"),
        (["overlaps", "--time", "440"], "time must be at most 432.917924228 s, when bench 0 folds, got 440 s"),
        (["figures", ".", "--kind", "trajectory", "--time", "440"], "time must be at most 432.917924228 s, when bench"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_an_instant_is_refused_by_the_option_that_asked_for_it(arguments: list[str], words: str) -> None:
    done = run(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"Error: {words}")
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize("wanted", [one for one in BODIES if one.call == "check"], ids=label_of)
def test_a_file_of_a_dance_is_refused_as_a_body_is(client: httpx.Client, tmp_path: Path, wanted: Wrong) -> None:
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(wanted.query))
    done = run("check", str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"Error: {client.post('/check', json=wanted.query).json()['detail']}\n"


def test_the_instant_of_a_drawn_check_is_named(tmp_path: Path) -> None:
    file = tmp_path / "dance.json"
    file.write_text('{"dragon": {"benches": 5}, "stop": 100}')
    done = run("check", str(file), "--figure", str(tmp_path / "dance.svg"), "--time", "1000")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: time must be at most 432.917924228 s, when bench 0 folds, got 1000 s")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["dance.json"]

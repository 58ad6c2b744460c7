"""Contact probability over HTTP, as a job and from a terminal: core's answers, and refusals."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

import core
from tests.support.command import run

MODEL = {"lateral": 0.02, "forward": 0.005, "correlation_time": 4.0, "step": 0.5, "hole": 0.055, "pin": 0.05}
REQUEST = {"dragon": {"benches": 20}, **MODEL, "samples": 60, "seed": 3, "start": 395.0, "stop": 405.0}


def output_of(*options: str, wrong: bool = False) -> str:
    """What the command prints, on standard error if it refuses."""
    done = run("contact-probability", *options)
    assert done.returncode == (2 if wrong else 0), done.stderr
    return done.stderr if wrong else done.stdout


def test_the_service_and_the_command_answer_what_core_answers(client: httpx.Client, tmp_path: Path) -> None:
    got = client.post("/contact-probability", json=REQUEST).raise_for_status().json()
    dance = core.Dance(core.Dragon(20), core.Spiral())
    result = core.contact_probability(dance, core.Wobble(**MODEL), 60, 3, start=395.0, stop=405.0)
    assert 5 < result.contacts < 60
    names = (
        "probability",
        "contacts",
        "samples",
        "tolerance",
        "strayed",
        "step",
        "instants",
        "start",
        "stop",
        "method",
    )
    assert {name: got[name] for name in names} == {name: getattr(result, name) for name in names}
    assert tuple(got["limits"]) == result.limits
    assert got["claim"] == asdict(result.claim)
    assert got["time_quantiles"] == np.quantile(result.time, (0.05, 0.5, 0.95)).tolist()
    pairs = [tuple(pair) for pair in result.benches.tolist()]
    assert tuple(got["benches"]) == max(sorted(set(pairs)), key=pairs.count)
    file = tmp_path / "dance.json"
    file.write_text(json.dumps(REQUEST))
    assert json.loads(output_of(str(file), "--json")) == got


def test_the_command_asks_for_the_way_to_the_circle(client: httpx.Client) -> None:
    options = ["--benches", "12", "--start-turns", "7", "--pitch", "0.5", "--turning-diameter", "6", "--samples", "20"]
    got = json.loads(output_of(*options, "--lateral", "0.03", "--json"))
    dance = core.Dance(core.Dragon(12), core.Spiral(0.5, 7.0))
    assert dance.path.head(got["stop"]).radius == pytest.approx(3.0, abs=1e-9)
    same = {"dragon": {"benches": 12}, "path": {"kind": "spiral", "pitch": 0.5, "start_turns": 7}, "lateral": 0.03}
    body = same | {"samples": 20, "stop": got["stop"]}
    assert client.post("/contact-probability", json=body).raise_for_status().json() == got
    body = same | {"samples": 20, "turning_diameter": 6}
    assert client.post("/contact-probability", json=body).raise_for_status().json() == got
    assert got["union_bound"] == 1.0


def test_without_a_contact_or_with_a_pitch_error_some_fields_are_null(client: httpx.Client) -> None:
    still = {"dragon": {"benches": 20}, "lateral": 0, "forward": 0, "samples": 2, "stop": 10}
    clear = client.post("/contact-probability", json=still).raise_for_status().json()
    assert (clear["contacts"], clear["time_quantiles"], clear["benches"], clear["strayed"]) == (0, None, None, 0)
    assert 0.0 < clear["union_bound"] < 1e-9
    other = client.post("/contact-probability", json=still | {"pitch_error": 0.01}).raise_for_status().json()
    assert other["contacts"] == 0
    assert other["tolerance"] is other["strayed"] is other["union_bound"] is None


@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"samples": 1_000_000}, "/samples", "samples must be at most 100000 here, got 1000000"),
        ({"samples": 0}, "/samples", "1"),
        ({"correlation_time": 0}, "/correlation_time", "0"),
        ({"step": 0.9}, "/step", "step must be at most 0.8 s, 1 / 5 of correlation_time, got 0.9 s"),
        ({"correlation_benches": 0}, "/correlation_benches", "0"),
        ({"lateral": -0.01}, "/lateral", "-0.01"),
        ({"lateral": 0.5}, "/lateral", "lateral must be at most 0.1 of the chord of bench 1"),
        ({"pin": 0.06}, "/pin", "pin must be no wider than its hole (0.055 m), got 0.06 m"),
        ({"pitch_error": 0.3}, "/pitch_error", "pitch_error must be at most 0.1 of the pitch"),
        ({"stop": 1000.0}, "/stop", "stop"),
    ],
)
def test_what_cannot_be_is_refused_with_its_limit(
    client: httpx.Client, changes: dict[str, Any], pointer: str, words: str
) -> None:
    answer = client.post("/contact-probability", json=REQUEST | changes)
    assert answer.status_code == 422
    error = answer.json()["errors"][0]
    assert error["pointer"] == pointer
    assert words in error["detail"]


def test_the_command_refuses_in_its_own_words() -> None:
    assert output_of("--hole", "0.05", "--pin", "0.06", wrong=True) == (
        "Error: pin must be no wider than its hole (0.05 m), got 0.06 m\n"
    )

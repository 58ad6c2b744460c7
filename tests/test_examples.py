"""Every file under examples/ is a request that runs, with the verdict that its comment promises."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import core
from app.maps.dances import read_dance
from app.questions.check import CheckRequest
from core import FailureKind, Outcome, Report, check
from tests.support.reference import reference, reference_cases

EXAMPLES = Path(__file__).parents[1] / "examples"
REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]


def report(name: str) -> Report:
    """The verdict on an example, read as the command reads it."""
    request = CheckRequest.model_validate(read_dance(EXAMPLES / f"{name}.toml"))
    dance = request.to_dance(1000)
    limits = {
        "margin": request.margin,
        "speed_limit": request.speed_limit,
        "start": request.start,
        "stop": request.stop,
    }
    return check(dance, venue=request.to_place(dance.dragon).venue, **limits)


def test_every_example_has_its_test() -> None:
    # docs/sweeps.md runs the sweep, docs/performances.md the several dragons.
    names = {
        "paper_dance",
        "contest_turn",
        "clothoid_turn",
        "village_square",
        "two_dragons",
        "crossing_streets",
        "sweep",
    }
    assert {path.stem for path in EXAMPLES.glob("*.toml")} == names
    others = {path.name for path in EXAMPLES.glob("*.*") if path.suffix != ".toml"}
    assert others == {
        "tour.py",
        "verify.py",
        "village_square.geojson",
    }  # test_tour.py, test_verify.py; the village reads it


def test_the_turn_with_clothoids_is_that_of_the_library_and_passes() -> None:
    request = CheckRequest.model_validate(read_dance(EXAMPLES / "clothoid_turn.toml"))
    turn = core.ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5)
    s = np.linspace(turn.begin, turn.end, 2_001)
    assert np.abs(request.to_dance(1000).path.position(s) - turn.position(s)).max() < REFERENCE_ERROR
    verdict = report("clothoid_turn")
    assert verdict.passed
    assert verdict.highest_speed.speed < 2.0


def test_the_papers_dance_ends_where_the_head_touches_bench_8() -> None:
    time = reference_cases("first_contact")["default"]["time"]
    result = report("paper_dance")
    assert not result.passed
    assert [(failure.kind, failure.benches) for failure in result.failures] == [(FailureKind.CONTACT, (0, 8))]
    assert result.first_contact.time == pytest.approx(time, abs=REFERENCE_ERROR)
    assert result.stop == pytest.approx(time, abs=REFERENCE_ERROR)


def test_the_contests_turn_passes_below_2_metres_a_second() -> None:
    clearance = reference("turn")["clearance"]
    speed = reference("maximum_head_speed")
    result = report("contest_turn")
    assert result.passed
    assert result.least_clearance is not None
    assert result.least_clearance.distance == pytest.approx(clearance["least"], abs=REFERENCE_ERROR)
    assert result.highest_speed is not None
    assert result.highest_speed.speed == pytest.approx(speed["speed_ratio"], abs=REFERENCE_ERROR)


def test_the_village_dragon_keeps_half_a_metre_from_everything() -> None:
    result = report("village_square")
    assert result.passed, result.failures
    assert result.first_contact.outcome is Outcome.CLEAR
    assert result.venue is not None
    assert result.venue.misplaced is None
    names = [area.name for area in result.venue.areas]
    assert names == ["square", "well", "stage", "linden tree", "chestnut tree"]
    for area in result.venue.areas:
        assert area.nearest.at_least is not None
        assert area.nearest.at_least > 0.5, area.name

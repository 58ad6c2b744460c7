"""The service gives the values of tests/reference/ over HTTP; tests/core has every value of them."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.asking import Asking
from tests.support.reference import reference

POSITION_TOLERANCE = 1e-11  # [m], and [m/s] for speeds
TOLERANCE = 1e-9  # of contacts [s] and [m], and of pitches [m]


def assert_engines(got: Any, before: bool | None = False) -> None:
    assert got["cross_check"]["agree"]
    assert [*got["cross_check"]["engines"].values()] == [{"before": before, "after": True}] * 4


@pytest.mark.parametrize("instant", reference("trajectory")["full"], ids=lambda one: f"{one['time']:g}s")
def test_trajectory_has_every_handle_at_one_instant(ask: Asking, instant: Any) -> None:
    table = ask("trajectory", {"times": [instant["time"]]})
    for name in ("x", "y", "speed"):
        known = [handle[name] for handle in instant["handles"]]
        assert table[name][0] == pytest.approx(known, rel=0, abs=POSITION_TOLERANCE), name


@pytest.mark.parametrize("case", reference("first_contact")["cases"], ids=lambda case: case["name"])
def test_collision_time_meets_the_reference(ask: Asking, case: Any) -> None:
    spiral = {name: case[name] for name in ("pitch", "start_turns", "head_speed")}
    got = ask("collision-time", **case["dragon"], **spiral)
    assert got["outcome"] == case["outcome"]
    if case["outcome"] == "contact":
        numbers = [got["time"], *got["point"], got["head"]["theta"], got["head"]["radius"]]
        known = [case["time"], *case["point"], case["head_theta"], case["head_radius"]]
        assert numbers == pytest.approx(known, rel=0, abs=TOLERANCE)
        assert [got[name] for name in ("benches", "corner", "edge")] == [case["benches"], case["corner"], case["edge"]]
        assert_engines(got)
    elif case["outcome"] == "clear":
        assert got["time"] is got["benches"] is got["cross_check"] is None
        assert got["end"]["reason"] == case["end"]["reason"]
        assert got["end"]["time"] == pytest.approx(case["end"]["time"], rel=0, abs=TOLERANCE)
    else:
        assert got["time"] == 0
        assert_engines(got, before=None)


@pytest.mark.parametrize("case", reference("minimum_pitch")["cases"], ids=lambda case: case["name"])
def test_minimum_pitch_meets_the_reference(ask: Asking, case: Any) -> None:
    got = ask(
        "minimum-pitch", **case["dragon"], turning_diameter=case["turning_diameter"], start_turns=case["start_turns"]
    )
    assert got["pitch"] == pytest.approx(case["pitch"], rel=0, abs=TOLERANCE)
    assert got["limited_by"] == case["limited_by"]
    assert len(got["other_feasible_intervals"]) == len(case["other_feasible_intervals"])
    if case["limited_by"] != "start":
        assert got["benches"] == case["benches"]
        assert_engines(got)


def test_a_minimum_pitch_says_from_where_and_up_to_where_every_pitch_is_proven(ask: Asking) -> None:
    """The head of the second dragon folds on its circle: below some pitch only single ones are proven."""
    got = ask("minimum-pitch")
    assert (got["justified_by"], got["proven_from"], got["scan_step"]) == ("bound", got["pitch"], None)
    folding = {"benches": 14, "head_length": 2.21, "body_length": 1.47, "width": 0.06, "overhang": 0.12}
    got = ask("minimum-pitch", **folding, turning_diameter=1.7, start_turns=5)
    assert got["pitch"] == pytest.approx(0.525552677857343, rel=0, abs=TOLERANCE)
    assert (got["limited_by"], got["benches"], got["bench"], got["justified_by"]) == ("fold", None, 0, "scan")
    assert got["pitch"] < got["proven_from"] - got["scan_step"]

"""The service gives the values of tests/reference/ over HTTP."""

from __future__ import annotations

import hashlib
from typing import Any

import pytest

from tests.support.asking import Asking
from tests.support.reference import reference

POSITION_TOLERANCE = 1e-11  # [m], and [m/s] for speeds
CONTACT_TOLERANCE = 1e-9  # [s], [m] and [rad]
PITCH_TOLERANCE = 1e-9  # [m]
# At a graze the clearance is flat along the way, so its place is known to the square root of the accuracy [m].
GRAZE_RADIUS_TOLERANCE = 1e-6
COLUMNS = ("x", "y", "speed")
TRAJECTORY = reference("trajectory")
BEFORE_AND_AFTER = {"before": False, "after": True}


@pytest.fixture(scope="module")
def default_trajectory(ask: Asking) -> Any:
    return ask("trajectory", {})


def assert_handles(table: Any, row: int, handles: list[dict[str, Any]]) -> None:
    for name in COLUMNS:
        got, known = ([one[name] for one in handles], [table[name][row][one["handle"]] for one in handles])
        assert got == pytest.approx(known, rel=0, abs=POSITION_TOLERANCE), name


def assert_near(got: Any, case: Any, names: str, tolerance: float) -> None:
    for name in names.split():
        assert got[name] == pytest.approx(case[name], rel=0, abs=tolerance), name


def assert_engines(got: Any) -> None:
    check = got["cross_check"]
    assert check["agree"]
    assert all(word == BEFORE_AND_AFTER for word in check["engines"].values())


@pytest.mark.parametrize("instant", TRAJECTORY["selected"], ids=lambda one: f"{one['time']:g}s")
def test_default_trajectory_has_the_selected_handles(default_trajectory: Any, instant: dict[str, Any]) -> None:
    assert_handles(default_trajectory, default_trajectory["time"].index(instant["time"]), instant["handles"])


@pytest.mark.parametrize("instant", TRAJECTORY["full"], ids=lambda one: f"{one['time']:g}s")
def test_trajectory_has_every_handle_at_one_instant(ask: Asking, instant: dict[str, Any]) -> None:
    table = ask("trajectory", {"times": [instant["time"]]})
    assert len(table["x"][0]) == len(instant["handles"]) == 224
    assert_handles(table, 0, instant["handles"])


def test_all_rows_of_the_default_trajectory_have_the_known_sha256(default_trajectory: Any) -> None:
    def rounded(value: float) -> str:
        text = f"{value:.6f}"
        return "0.000000" if text == "-0.000000" else text

    digest = hashlib.sha256()
    for time, *columns in zip(*(default_trajectory[name] for name in ("time", *COLUMNS)), strict=True):
        for handle, values in enumerate(zip(*columns, strict=True)):
            digest.update(f"{time:.0f} {handle} {' '.join(map(rounded, values))}\n".encode())
    assert digest.hexdigest() == TRAJECTORY["sha256_of_all_six_decimal_rows"]["t=0..300 step 1"]


@pytest.mark.parametrize("case", reference("first_contact")["cases"], ids=lambda case: case["name"])
def test_collision_time_meets_the_reference(ask: Asking, case: dict[str, Any]) -> None:
    got = ask(
        "collision-time", **case["dragon"], **{name: case[name] for name in ("pitch", "start_turns", "head_speed")}
    )
    assert got["outcome"] == case["outcome"]
    if case["outcome"] == "contact":
        assert_near(got, case, "time point", CONTACT_TOLERANCE)
        clear_until, overlapping_at = got["time_bracket"]
        assert clear_until <= got["time"] <= overlapping_at <= clear_until + CONTACT_TOLERANCE
        head = {"theta": case["head_theta"], "radius": case["head_radius"]}
        assert_near(got["head"], head, "theta radius", CONTACT_TOLERANCE)
        assert [got["benches"], got["corner"], got["edge"]] == [case["benches"], case["corner"], case["edge"]]
        assert_engines(got)
    if case["outcome"] == "clear":
        assert got["time"] is got["benches"] is got["cross_check"] is None
        assert got["end"]["reason"] == case["end"]["reason"]
        assert_near(got["end"], case["end"], "time", CONTACT_TOLERANCE)
    if case["outcome"] == "contact_at_start":
        assert got["time"] == 0


@pytest.mark.parametrize("case", reference("minimum_pitch")["cases"], ids=lambda case: case["name"])
def test_minimum_pitch_meets_the_reference(ask: Asking, case: dict[str, Any]) -> None:
    circle = {name: case[name] for name in ("turning_diameter", "start_turns")}
    got = ask("minimum-pitch", **case["dragon"], **circle)
    assert_near(got, case, "pitch", PITCH_TOLERANCE)
    infeasible, feasible = got["pitch_bracket"]
    assert infeasible <= feasible <= infeasible + PITCH_TOLERANCE
    assert got["limited_by"] == case["limited_by"]
    assert len(got["other_feasible_intervals"]) == len(case["other_feasible_intervals"])
    for interval, known in zip(got["other_feasible_intervals"], case["other_feasible_intervals"], strict=True):
        assert interval == pytest.approx(known, rel=0, abs=PITCH_TOLERANCE)
    if case["limited_by"] != "start":
        assert got["benches"] == case["benches"]
        assert_near(got, case, "head_radius", GRAZE_RADIUS_TOLERANCE)
        assert_engines(got)


def test_a_minimum_pitch_says_from_where_and_up_to_where_every_pitch_is_proven(ask: Asking) -> None:
    """The head of the second dragon folds on its circle: below some pitch only single ones are proven."""
    got = ask("minimum-pitch")
    assert (got["justified_by"], got["proven_from"], got["proven_up_to"]) == ("bound", got["pitch"], None)
    assert got["scan_step"] is None
    folding = {"benches": 14, "head_length": 2.21, "body_length": 1.47, "width": 0.06, "overhang": 0.12}
    got = ask("minimum-pitch", **folding, turning_diameter=1.7, start_turns=5)
    assert got["pitch"] == pytest.approx(0.525552677857343, rel=0, abs=PITCH_TOLERANCE)
    assert (got["limited_by"], got["benches"], got["justified_by"]) == ("fold", None, "scan")
    assert (got["bench"], got["proven_up_to"]) == (0, None)
    assert got["pitch"] < got["proven_from"] - got["scan_step"]

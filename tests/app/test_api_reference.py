"""The service gives the values of tests/reference/ over HTTP."""

from __future__ import annotations

import hashlib
from typing import Any

import httpx
import pytest

from tests.support.reference import reference

POSITION_TOLERANCE = 1e-11  # [m], and [m/s] for speeds
CONTACT_TOLERANCE = 1e-9  # [s], [m] and [rad]
PITCH_TOLERANCE = 1e-9  # [m]
# At a graze the clearance is flat along the way, so its place is known to the square root of the accuracy [m].
GRAZE_RADIUS_TOLERANCE = 1e-6
PATH_NAMES = ("pitch", "start_turns", "head_speed")


TRAJECTORY = reference("trajectory")
CONTACTS = reference("first_contact")["cases"]
PITCHES = reference("minimum_pitch")["cases"]


@pytest.fixture(scope="module")
def default_trajectory(client: httpx.Client) -> Any:
    return client.post("/trajectory", json={}).raise_for_status().json()


def assert_handles(table: Any, row: int, handles: list[dict[str, Any]]) -> None:
    for handle in handles:
        for name in ("x", "y", "speed"):
            got = table[name][row][handle["handle"]]
            assert got == pytest.approx(handle[name], rel=0, abs=POSITION_TOLERANCE), (name, handle["handle"])


@pytest.mark.parametrize("instant", TRAJECTORY["selected"], ids=lambda one: f"{one['time']:g}s")
def test_default_trajectory_has_the_selected_handles(default_trajectory: Any, instant: dict[str, Any]) -> None:
    assert_handles(default_trajectory, default_trajectory["time"].index(instant["time"]), instant["handles"])


@pytest.mark.parametrize("instant", TRAJECTORY["full"], ids=lambda one: f"{one['time']:g}s")
def test_trajectory_has_every_handle_at_one_instant(client: httpx.Client, instant: dict[str, Any]) -> None:
    table = client.post("/trajectory", json={"times": [instant["time"]]}).raise_for_status().json()
    assert len(table["x"][0]) == len(instant["handles"]) == 224
    assert_handles(table, 0, instant["handles"])


def test_all_rows_of_the_default_trajectory_have_the_known_sha256(default_trajectory: Any) -> None:
    def rounded(value: float) -> str:
        text = f"{value:.6f}"
        return "0.000000" if text == "-0.000000" else text

    digest = hashlib.sha256()
    for time, *columns in zip(*(default_trajectory[name] for name in ("time", "x", "y", "speed")), strict=True):
        for handle, values in enumerate(zip(*columns, strict=True)):
            digest.update(f"{time:.0f} {handle} {' '.join(map(rounded, values))}\n".encode())
    assert digest.hexdigest() == TRAJECTORY["sha256_of_all_six_decimal_rows"]["t=0..300 step 1"]


@pytest.mark.parametrize("case", CONTACTS, ids=lambda case: case["name"])
def test_collision_time_meets_the_reference(client: httpx.Client, case: dict[str, Any]) -> None:
    query = case["dragon"] | {name: case[name] for name in PATH_NAMES}
    got = client.get("/collision-time", params=query).raise_for_status().json()
    assert got["outcome"] == case["outcome"]
    if case["outcome"] == "contact":
        assert got["time"] == pytest.approx(case["time"], rel=0, abs=CONTACT_TOLERANCE)
        clear_until, overlapping_at = got["time_bracket"]
        assert clear_until <= got["time"] <= overlapping_at
        assert overlapping_at - clear_until <= CONTACT_TOLERANCE
        assert got["head"]["theta"] == pytest.approx(case["head_theta"], rel=0, abs=CONTACT_TOLERANCE)
        assert got["head"]["radius"] == pytest.approx(case["head_radius"], rel=0, abs=CONTACT_TOLERANCE)
        assert [got["benches"], got["corner"], got["edge"]] == [case["benches"], case["corner"], case["edge"]]
        assert got["point"] == pytest.approx(case["point"], rel=0, abs=CONTACT_TOLERANCE)
        assert got["cross_check"]["agree"]
        assert all(word == {"before": False, "after": True} for word in got["cross_check"]["engines"].values())
    if case["outcome"] == "clear":
        assert got["time"] is got["benches"] is got["cross_check"] is None
        assert got["end"]["reason"] == case["end"]["reason"]
        assert got["end"]["time"] == pytest.approx(case["end"]["time"], rel=0, abs=CONTACT_TOLERANCE)
    if case["outcome"] == "contact_at_start":
        assert got["time"] == 0


@pytest.mark.parametrize("case", PITCHES, ids=lambda case: case["name"])
def test_minimum_pitch_meets_the_reference(client: httpx.Client, case: dict[str, Any]) -> None:
    query = case["dragon"] | {name: case[name] for name in ("turning_diameter", "start_turns")}
    got = client.get("/minimum-pitch", params=query).raise_for_status().json()
    assert got["pitch"] == pytest.approx(case["pitch"], rel=0, abs=PITCH_TOLERANCE)
    infeasible, feasible = got["pitch_bracket"]
    assert infeasible <= feasible <= infeasible + PITCH_TOLERANCE
    assert got["limited_by"] == case["limited_by"]
    assert len(got["other_feasible_intervals"]) == len(case["other_feasible_intervals"])
    for interval, known in zip(got["other_feasible_intervals"], case["other_feasible_intervals"], strict=True):
        assert interval == pytest.approx(known, rel=0, abs=PITCH_TOLERANCE)
    if case["limited_by"] != "start":
        assert got["benches"] == case["benches"]
        assert got["head_radius"] == pytest.approx(case["head_radius"], rel=0, abs=GRAZE_RADIUS_TOLERANCE)
        assert got["cross_check"]["agree"]
        assert all(word == {"before": False, "after": True} for word in got["cross_check"]["engines"].values())


def test_a_minimum_pitch_says_from_where_and_up_to_where_every_pitch_is_proven(client: httpx.Client) -> None:
    """The head of the second dragon folds on its circle: below some pitch only single ones are proven."""
    got = client.get("/minimum-pitch").raise_for_status().json()
    assert (got["justified_by"], got["proven_from"], got["proven_up_to"]) == ("bound", got["pitch"], None)
    assert got["scan_step"] is None
    folding = {"benches": 14, "head_length": 2.21, "body_length": 1.47, "width": 0.06, "overhang": 0.12}
    query = folding | {"turning_diameter": 1.7, "start_turns": 5}
    got = client.get("/minimum-pitch", params=query).raise_for_status().json()
    assert got["pitch"] == pytest.approx(0.525552677857343, rel=0, abs=PITCH_TOLERANCE)
    assert (got["limited_by"], got["benches"], got["justified_by"]) == ("fold", None, "scan")
    assert got["bench"] == 0
    assert got["pitch"] < got["proven_from"] - got["scan_step"]
    assert got["proven_up_to"] is None

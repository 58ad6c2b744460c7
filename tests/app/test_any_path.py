"""Turns, routes, waypoints and venues through the real service."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Any

import httpx
import numpy as np
import pytest
from scipy.special import fresnel

import core
from app.wire.paths import path_of
from tests.support.reference import reference

REFERENCE_TOLERANCE = 1e-9  # [m], [rad], [s] and [m/s]
SAME_PATH_TOLERANCE = 1e-10  # [m] and [m/s]
BEGIN_TOLERANCE = 1e-7  # [s]: the first place with room for the whole dragon is bisected
TURN = {"kind": "turn", "pitch": 1.7, "turning_diameter": 9, "ratio": 2}
TURN_QUERY = "pitch=1.7&turning_diameter=9&ratio=2"
LANE = {"kind": "line", "start": [0, 0], "end": [60, 0]}
BEND = {"kind": "arc", "centre": [60, 20], "radius": 20, "start_angle": -math.pi / 2, "sweep": math.pi / 2}
SHORT = {"benches": 4}


def posted(client: httpx.Client, call: str, **body: Any) -> Any:
    return client.post(call, json=body).raise_for_status().json()


def route(*pieces: dict[str, Any], start: float = 0) -> dict[str, Any]:
    return {"kind": "route", "pieces": list(pieces), "start": start}


def polygon(name: str, *ring: tuple[float, float]) -> dict[str, Any]:
    geometry = {"type": "Polygon", "coordinates": [[*map(list, ring), list(ring[0])]]}
    return {"type": "Feature", "properties": {"name": name}, "geometry": geometry}


def box(name: str, left: float, low: float, right: float, high: float) -> dict[str, Any]:
    return polygon(name, (left, low), (right, low), (right, high), (left, high))


def venue(*areas: dict[str, Any]) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(areas)}


def test_the_turn_is_the_known_one(client: httpx.Client) -> None:
    known, got = reference("turn")["turn"], client.get(f"/turn?{TURN_QUERY}").raise_for_status().json()
    for name, value in known.items():
        assert np.array(got[name]) == pytest.approx(np.array(value), rel=0, abs=REFERENCE_TOLERANCE), name


@pytest.mark.parametrize("table", reference("turn")["tables"], ids=lambda one: f"{one['time']:g}s")
def test_trajectory_through_the_turn_has_the_known_handles(client: httpx.Client, table: dict[str, Any]) -> None:
    got = posted(client, "/trajectory", path=TURN, times=[table["time"]])
    assert len(got["x"][0]) == len(table["handles"]) == 224
    for handle in table["handles"]:
        for name in ("x", "y", "speed"):
            value = got[name][0][handle["handle"]]
            assert value == pytest.approx(handle[name], rel=0, abs=REFERENCE_TOLERANCE), (name, handle["handle"])


def test_the_shortest_turn_is_a_turn_and_what_limits_it(client: httpx.Client) -> None:
    got = (
        client.get("/shortest-turn?pitch=1.7&turning_diameter=9&ratio=1&margin=0.2&exit_opposite=true")
        .raise_for_status()
        .json()
    )
    query = f"pitch=1.7&turning_diameter=9&ratio=1&entry_radius={got['entry_radius']!r}"
    turn = client.get(f"/turn?{query}").raise_for_status().json()
    assert {name: got[name] for name in turn} == turn
    assert got["entry_bracket"][1] == got["entry_radius"]
    assert (got["limited_by"], got["benches"], got["scan_step"]) == ("contact", [0, 13], 0.045)


def test_the_shortest_turn_of_any_exit_has_a_proven_bracket(client: httpx.Client) -> None:
    got = client.get("/shortest-turn?pitch=1.7&turning_diameter=9").raise_for_status().json()
    query = f"pitch=1.7&turning_diameter=9&entry_radius={got['entry_radius']!r}&exit_radius={got['exit_radius']!r}"
    turn = client.get(f"/turn?{query}").raise_for_status().json()
    assert {name: got[name] for name in turn} == turn
    low, high = got["length_bracket"]
    assert 0 < high - low <= 1e-6
    assert (high, got["exit_radius"]) == (got["length"], 4.5)
    assert (got["limited_by"], got["benches"], got["time"], got["scan_step"]) == ("bend", None, None, 0)
    opposite = client.get("/shortest-turn?pitch=1.7&turning_diameter=9&exit_opposite=true").raise_for_status().json()
    assert (opposite["length_bracket"], opposite["exit_bracket"]) == (None, None)
    assert opposite["exit_radius"] == opposite["entry_radius"]
    assert opposite["length"] > high + 1


def test_the_shortest_turn_of_any_ratio_has_equal_arcs_and_a_proven_bracket(client: httpx.Client, patient: str) -> None:
    """One bench touches nothing, so that closed forms are enough; and what is given as the ratio does not matter."""
    got = httpx.get(f"{patient}/shortest-turn?benches=1&any_ratio=true&ratio=3", timeout=600).raise_for_status().json()
    low, high = got["length_bracket"]
    assert 0 < high - low <= 1.1e-6
    assert (got["ratio"], high) == (pytest.approx(1, abs=1e-6), got["length"])
    equal = client.get("/shortest-turn?benches=1&ratio=1").raise_for_status().json()
    assert got["length"] == pytest.approx(equal["length"], abs=2e-6)
    assert client.get("/shortest-turn?benches=1&ratio=1.1").raise_for_status().json()["length"] > high


def test_the_quickest_turn_is_a_turn_with_its_time(client: httpx.Client) -> None:
    """It is neither the contest's turn nor the shortest one, and quicker than both."""
    known = reference("maximum_head_speed")
    query = "pitch=1.7&turning_diameter=9&ratio=2&speed_limit=2"
    contest = client.get(f"/turn-time?{query}").raise_for_status().json()
    assert contest["head_speed"] == pytest.approx(known["head_speed"], rel=0, abs=REFERENCE_TOLERANCE)
    assert contest["time"] == contest["length"] / contest["head_speed"]
    shortest = client.get("/shortest-turn?pitch=1.7&turning_diameter=9").raise_for_status().json()
    quickest = client.get(f"/quickest-turn?{query}").raise_for_status().json()
    times = []
    for turn in (shortest, quickest):
        ends = f"entry_radius={turn['entry_radius']!r}&exit_radius={turn['exit_radius']!r}"
        times.append(client.get(f"/turn-time?{query}&{ends}").raise_for_status().json())
    assert {name: quickest[name] for name in times[1]} == times[1]
    assert shortest["length"] < quickest["length"] < contest["length"]
    assert quickest["time"] < min(contest["time"], times[0]["time"])
    assert quickest["scan_step"] == pytest.approx(0.09)
    body = {"path": {"kind": "turn", "entry_radius": quickest["entry_radius"], "exit_radius": quickest["exit_radius"]}}
    assert posted(client, "/turn-time", **body)["time"] == quickest["time"]


def test_a_turn_with_clothoids_is_a_turn_for_every_question(client: httpx.Client) -> None:
    """As in docs/contest.md, and as its pieces."""
    path = {"kind": "turn", "pitch": 1.7, "ratio": 1.0, "middle": 4.0, "ends": 0.5}
    smooth = core.ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5)
    timed = posted(client, "/turn-time", path=path)
    assert (round(timed["length"], 4), round(timed["head_speed"], 4), round(timed["time"], 2)) == (13.4102, 1.739, 7.71)
    assert timed == client.get("/turn-time?pitch=1.7&ratio=1&middle=4&ends=0.5").raise_for_status().json()
    assert (timed["length"], timed["radii"]) == (smooth.length, list(smooth.radii))
    turn = client.get("/turn?pitch=1.7&ratio=1&middle=4&ends=0.5").raise_for_status().json()
    assert turn == {name: timed[name] for name in turn}
    for call, more in (("/trajectory", {"times": [-5.0, 0.0, 20.0]}), ("/check", {"start": -20.0, "stop": 40.0})):
        pieces = [posted(client, call, dragon=SHORT, path=one, **more) for one in (path, path_of(smooth))]
        assert pieces[0] == pieces[1]


def test_the_maximum_head_speed_is_the_known_one(client: httpx.Client) -> None:
    known = reference("maximum_head_speed")
    got = client.get(f"/maximum-head-speed?{TURN_QUERY}&speed_limit=2").raise_for_status().json()
    for name in ("head_speed", "speed_ratio", "time_at_unit_head_speed"):
        assert got[name] == pytest.approx(known[name], rel=0, abs=REFERENCE_TOLERANCE), name
    assert set(got["handles"]) <= set(known["handles_exactly_tied"])
    low, high = got["head_speed_bracket"]
    assert low <= got["head_speed"] <= high


def test_the_check_of_the_turn_meets_the_known_clearance_and_passes(client: httpx.Client) -> None:
    known = reference("turn")["clearance"]
    got = posted(client, "/check", path=TURN, start=-100, stop=100, speed_limit=2)
    assert (got["passed"], got["failures"], got["venue"]) == (True, [], None)
    assert got["least_clearance"]["distance"] == pytest.approx(known["least"], abs=REFERENCE_TOLERANCE)
    assert got["least_clearance"]["at_least"] <= got["least_clearance"]["distance"]
    assert got["first_contact"]["end"] == {"reason": "stop", "time": 100.0, "theta": None, "bench": None}


def test_a_spiral_as_a_route_gives_the_answers_of_the_spiral(client: httpx.Client) -> None:
    times = [-20.0, 0.0, 150.0, 300.0]
    as_route = route({"kind": "coil", "pitch": 0.55, "start_turns": 16, "end_turns": 3})
    for call, names in (("/trajectory", ("x", "y", "speed")), ("/clearance", ("clearance",))):
        spiral, same = (posted(client, call, path=path, times=times) for path in ({"kind": "spiral"}, as_route))
        for name in names:
            assert np.array(same[name]) == pytest.approx(np.array(spiral[name]), rel=0, abs=SAME_PATH_TOLERANCE)
    result = posted(client, "/check", path=as_route, margin=0.05)["first_contact"]
    known = client.get("/collision-time?margin=0.05").json()
    assert result["time"] == pytest.approx(known["time"], rel=0, abs=REFERENCE_TOLERANCE)
    assert (result["benches"], result["cross_check"]["agree"]) == (known["benches"], True)
    assert result["head"]["theta"] is None


RAMP = {"kind": "clothoid", "start": [0, 0], "heading": 0, "start_curvature": 0, "end_curvature": 0.5, "length": 2}


def test_a_clothoid_is_a_piece(client: httpx.Client) -> None:
    """A clothoid of one curvature is an arc, and a ramp ends at its Fresnel integrals."""
    bend = RAMP | {"start": [60, 0], "start_curvature": 0.25, "end_curvature": 0.25}
    arc = {"kind": "arc", "centre": [60, 4], "radius": 4, "start_angle": -0.5 * math.pi, "sweep": 0.5}
    paths = [route(LANE, piece) for piece in (bend, arc)]
    one, other = (posted(client, "/trajectory", dragon=SHORT, path=path, times=[50.0, 61.5]) for path in paths)
    for name in ("x", "y", "speed"):
        assert np.array(one[name]) == pytest.approx(np.array(other[name]), rel=0, abs=SAME_PATH_TOLERANCE)
    result = posted(client, "/trajectory", dragon=SHORT, path=route(LANE, RAMP | {"start": [60, 0]}), times=[62.0])
    unit = 2.0 * math.sqrt(math.pi)
    sine, cosine = fresnel(2.0 / unit)
    assert (result["x"][0][0], result["y"][0][0]) == pytest.approx((60 + unit * cosine, unit * sine), abs=1e-11)


def test_waypoints_are_a_path_and_a_piece(client: httpx.Client) -> None:
    curve = {"kind": "waypoints", "points": [[0, 0], [20, 3], [40, -3], [60, 0]], "start_heading": 0}
    alone = posted(client, "/trajectory", dragon=SHORT, path=curve, times=[30.0, 45.0])
    assert alone == posted(client, "/trajectory", dragon=SHORT, path=route(curve), times=[30.0, 45.0])
    x, y = np.array(alone["x"]), np.array(alone["y"])
    chords = np.hypot(np.diff(x, axis=1), np.diff(y, axis=1))
    assert chords == pytest.approx(np.tile(core.Dragon(**SHORT).chords, (2, 1)), rel=0, abs=SAME_PATH_TOLERANCE)


@pytest.mark.parametrize("start", [0, 20, -7.5])
def test_waypoints_start_as_far_along_as_a_route_does(client: httpx.Client, start: float) -> None:
    curve = {"kind": "waypoints", "points": [[0, 0], [20, 3], [40, -3], [60, 0]]}
    times = [30.0 - start, 45.0 - start]
    alone, later = (
        posted(client, "/trajectory", dragon=SHORT, path=path, times=times)
        for path in (curve | {"start": start}, route(curve, start=start))
    )
    assert alone == later
    from_beginning = posted(client, "/trajectory", dragon=SHORT, path=curve, times=[30.0, 45.0])
    for name in ("x", "y", "speed"):
        assert np.array(alone[name]) == pytest.approx(np.array(from_beginning[name]), rel=0, abs=SAME_PATH_TOLERANCE)


# Four benches are 7.81 m from handle 0 to handle 4.
CURVE = {"kind": "waypoints", "points": [[0, 0], [20, 0], [40, 0], [60.5, 0]]}
LONG_LANE = route(LANE | {"end": [900, 0]})


@pytest.mark.parametrize("call", ["/trajectory", "/clearance"])
@pytest.mark.parametrize(
    ("path", "seconds"),
    [
        (route(LANE), range(8, 61)),
        (route(LANE, start=5), range(3, 56)),
        (route(LANE, start=9), range(52)),
        (CURVE, range(8, 61)),
        (CURVE | {"start": 5}, range(3, 56)),
        (LONG_LANE, range(8, 309)),
        (TURN, range(301)),
        ({"kind": "spiral"}, range(301)),
    ],
    ids=["route", "start", "past", "waypoints", "waypoints_start", "long", "turn", "spiral"],
)
def test_without_times_a_dance_has_seconds_that_its_path_has(
    client: httpx.Client, call: str, path: Any, seconds: range
) -> None:
    assert posted(client, call, dragon=SHORT, path=path)["time"] == list(seconds)
    assert posted(client, call, dragon=SHORT, path=path, times=None)["time"] == list(seconds)


@pytest.mark.parametrize("call", ["/trajectory", "/clearance"])
@pytest.mark.parametrize(
    ("path", "times", "seconds"),
    [
        (route(LANE), {"stop": 20}, range(8, 21)),
        (route(LANE), {"start": 20}, range(20, 61)),
        (route(LANE), {"step": 10}, range(8, 61, 10)),
        (CURVE, {"stop": 20, "step": 5}, range(8, 21, 5)),
        (LONG_LANE, {"start": 7.9, "step": 100}, [7.9, 107.9, 207.9]),
        (TURN, {"start": -50, "step": 50}, range(-50, 301, 50)),
        (TURN, {"stop": 20, "step": 10}, range(0, 21, 10)),
    ],
)
def test_a_start_or_stop_that_is_left_out_lies_in_the_run(
    client: httpx.Client, call: str, path: Any, times: dict[str, float], seconds: Sequence[float]
) -> None:
    assert posted(client, call, dragon=SHORT, path=path, times=times)["time"] == list(seconds)


@pytest.mark.parametrize(("times", "words"), [
    ({"start": 2}, "times.start must be at least 7.810001 s, when the whole dragon is on the path, got 2 s"),
    ({"stop": 2}, "times.stop must be at least 7.810001 s, when the whole dragon is on the path, got 2 s"),
    ({"stop": 99}, "times.stop must be at most 60.000000000 s, when the path ends, got 99 s"),
])  # fmt: skip
def test_a_start_or_stop_that_is_given_is_refused_outside_the_run(
    client: httpx.Client, times: dict[str, float], words: str
) -> None:
    answer = client.post("/trajectory", json={"dragon": SHORT, "path": route(LANE), "times": times})
    assert (answer.status_code, answer.json()["detail"]) == (422, words)


@pytest.mark.parametrize("start", [0, 9], ids=["late", "past"])
def test_without_a_start_a_search_begins_when_the_whole_dragon_is_on_the_path(
    client: httpx.Client, start: float
) -> None:
    path = route(LANE, start=start)
    got = posted(client, "/collision-time", dragon=SHORT, path=path, margin=1.2, cross_check="none")
    assert got["outcome"] == "contact_at_start"
    assert got["time"] == pytest.approx(7.81 - start, rel=0, abs=BEGIN_TOLERANCE)


@pytest.mark.parametrize("call", ["/figures/trajectory.svg", "/figures/contact.svg", "/check"])
@pytest.mark.parametrize("path", [route(LANE), CURVE, TURN, {"kind": "spiral", "pitch": 2}])
def test_without_times_any_path_is_drawn_and_checked(client: httpx.Client, call: str, path: Any) -> None:
    assert client.post(call, json={"dragon": SHORT, "path": path}).status_code == 200


@pytest.mark.parametrize("call", ["/trajectory", "/clearance", "/check", "/figures/trajectory.svg"])
@pytest.mark.parametrize("path", [route(LANE), CURVE], ids=["route", "waypoints"])
def test_a_path_too_short_for_the_dragon_is_a_problem_that_says_so(client: httpx.Client, call: str, path: Any) -> None:
    words = ("too short for the whole dragon", "369.16 m", "handle 223", "got 60")
    assert_refused(client.post(call, json={"path": path}), "/path", words)


def test_times_by_default_and_the_same_times_given_have_tags_of_their_own(client: httpx.Client) -> None:
    request = {"dragon": SHORT, "path": route(LANE)}
    tags = [client.post("/trajectory", json=request | more).headers["etag"] for more in ({}, {"times": [8.0]})]
    assert tags[0] != tags[1]


def test_clearance_on_a_spiral_is_the_same_by_get_and_by_post(client: httpx.Client) -> None:
    got = client.get("/clearance?start=409&stop=410&step=0.5").json()
    assert got == posted(client, "/clearance", times={"start": 409, "stop": 410, "step": 0.5})


def test_a_check_names_what_fails_in_order_of_time(client: httpx.Client) -> None:
    square = venue(box("square", -2, -3, 62, 3), box("stall", 40, 1, 42, 2), box("tree", 30, -2, 31, -1))
    got = posted(
        client, "/check", dragon=SHORT, path=route(LANE), venue=square, margin=0.9, speed_limit=0.5, start=15.0
    )
    assert not got["passed"]
    assert {(one["kind"], one["area"]) for one in got["failures"]} == {
        ("venue", "stall"), ("venue", "tree"), ("speed", None),
    }  # fmt: skip
    times = [one["time"] for one in got["failures"]]
    assert times == sorted(times)
    # On a straight line the edge of the bench is half its width off the lane.
    nearest = {area["name"]: area["nearest"]["distance"] for area in got["venue"]["areas"]}
    assert nearest["tree"] == pytest.approx(1 - 0.15, abs=REFERENCE_TOLERANCE)
    assert nearest["square"] == pytest.approx(2 - 0.275, abs=REFERENCE_TOLERANCE)


@pytest.mark.parametrize("left", [20.0, 9.0], ids=["all_outside", "tail_outside"])
def test_a_dragon_that_starts_outside_the_venue_is_a_verdict(client: httpx.Client, left: float) -> None:
    got = posted(client, "/check", dragon=SHORT, path=route(LANE), venue=box("yard", left, -3, 70, 3), start=15.0)
    assert got["failures"][0]["kind"] == "outside"
    assert got["failures"][0]["time"] == 15.0
    assert got["venue"]["stray"]["name"] == "yard"


BAD_PATHS = {
    "gap": (route(LANE, BEND | {"centre": [60.1, 20]}), "/path/pieces/1", ("close", "0.1 m")),
    "kink": (route(LANE, BEND | {"centre": [60, 20], "start_angle": -1.5, "radius": 20}), "/path/pieces/1", ("close",)),
    "corner": (
        route(LANE, {"kind": "line", "start": [60, 0], "end": [60, 9]}), "/path/pieces/1", ("smooth", "1.57 rad"),
    ),
    "no_length": (route(LANE | {"end": [0, 0]}), "/path/pieces/0", ("1e-06 m", "got 0 m")),
    "no_sweep": (route(BEND | {"sweep": 0}), "/path/pieces/0", ("got 0 m",)),
    "no_radius": (route(BEND | {"radius": 0}), "/path/pieces/0/radius", ("at least 0.001 m", "got 0 m")),
    "tight_bend": (route(BEND | {"radius": 1}), "/path", ("bench 0", "got 1 m", "near (")),
    "no_pieces": (route(), "/path/pieces", ("at least 1 entry",)),
    "many_pieces": (route(*[LANE] * 1001), "/path/pieces", ("at most 1000",)),
    "piece_without_kind": (route({"start": [0, 0], "end": [1, 0]}), "/path/pieces/0/kind", ("missing",)),
    "unknown_piece": (route({"kind": "loop"}), "/path/pieces/0/kind", ('"line"', '"coil"', '"loop"')),
    "piece_as_number": (route(3), "/path/pieces/0", ("JSON object",)),  # type: ignore[arg-type]
    "point_of_one": (route(LANE | {"start": [0]}), "/path/pieces/0/start", ("at least 2 entries", "got 1")),
    "point_of_three": (route(LANE | {"start": [0, 0, 0]}), "/path/pieces/0/start", ("at most 2 entries",)),
    "text_in_a_point": (route(LANE | {"start": [0, "a"]}), "/path/pieces/0/start/1", ("start[1]", "[m]")),
    "one_waypoint": ({"kind": "waypoints", "points": [[0, 0]]}, "/path/points", ("at least 2 entries",)),
    "way_there_and_back": (
        {"kind": "waypoints", "points": [[k % 2, 0] for k in range(1000)]}, "/path/points", ("turn on the spot",),
    ),
    "way_there_and_back_in_a_route": (
        route(LANE, {"kind": "waypoints", "points": [[60, 0], [99, 0], [60, 0]]}),
        "/path/pieces/1/points", ("path.pieces[1].points", "between points 0 and 1"),
    ),
    "many_waypoints": (
        {"kind": "waypoints", "points": [[k, 0] for k in range(1001)]}, "/path/points", ("at most 1000",),
    ),
    "many_waypoints_in_pieces": (
        route(*[{"kind": "waypoints", "points": [[k, 0] for k in range(600)]}] * 2), "/path/pieces", ("at most 1000",),
    ),
    "gap_after_a_clothoid": (
        route(RAMP, LANE | {"start": [1.95, 0.33], "end": [9, 9]}), "/path/pieces/1", ("close", "1.95057538, 0.3274"),
    ),
    "sharp_clothoid": (route(RAMP | {"end_curvature": 1e4}), "/path/pieces/0/end_curvature", ("at most 1000 1/m",)),
    "clothoid_without_heading": (
        route({k: v for k, v in RAMP.items() if k != "heading"}), "/path/pieces/0/heading", ("heading is missing",),
    ),
    "long_clothoid": (route(RAMP | {"length": 2001}), "/path/pieces/0/length", ("at most 2000 m", "1000 rad")),
    "many_clothoids": (route(*[RAMP | {"length": 1999}] * 3), "/path/pieces", ("at most 2500", "got 2999")),
    "tight_clothoid": (route(LANE, RAMP | {"start": [60, 0], "end_curvature": 3}), "/path", ("bench 0", "s = 62 m")),
    "same_waypoint_twice": (
        {"kind": "waypoints", "points": [[0, 0], [1, 0], [1, 0]]}, "/path/points/2", ("path.points[2]", "0.001 m"),
    ),
    "turn_outside_its_coil": (TURN | {"start_turns": 2}, "/path/start_turns", ("2.64706 turns", "path.start_turns")),
    "turn_too_tight": (TURN | {"turning_diameter": 2}, "/path/turning_diameter", ("radius", "bench 0")),
    "entry_outside_the_circle": (TURN | {"entry_radius": 5}, "/path/entry_radius", ("at most 4.5 m", "got 5")),
    "lopsided_turn": (TURN | {"ratio": 1000}, "/path/ratio", ("at most 100", "got 1000")),
    "unknown_name": (TURN | {"radius": 4.5}, "/path/radius", ("unknown",)),
    "kind_as_list": ({"kind": []}, "/path/kind", ('"turn"',)),
}  # fmt: skip
BAD_DANCES = {
    "before_the_path": ({"start": 1}, "/start", ("at least 7.81", "whole dragon", "got 1 s")),
    "after_the_path": ({"stop": 61}, "/stop", ("60.0", "path ends")),
    "stop_before_start": ({"start": 30, "stop": 20}, "/stop", ("after start", "got 20 s")),
    "no_limit": ({"speed_limit": 0}, "/speed_limit", ("at least 0.001 m/s",)),
    "self_crossing": (
        {"venue": polygon("bow", (0, 0), (9, 9), (9, 0), (0, 9))},
        "/venue",
        ("'bow'", "self-intersection", "(4.5, 4.5)"),
    ),
    "point_as_venue": ({"venue": {"type": "Point", "coordinates": [0, 0]}}, "/venue/type", ("Polygon", "'Point'")),
    "empty_venue": ({"venue": {}}, "/venue/type", ("Polygon",)),
    "venue_as_text": ({"venue": "square"}, "/venue", ("JSON object",)),
    "number_as_position": (
        {"venue": {"type": "Polygon", "coordinates": [[1, 2, 3]]}}, "/venue/coordinates/0/0", ("list",),
    ),
    "open_ring": (
        {"venue": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9]]]}}, "/venue", ("closed",),
    ),
    "deep_venue": ({"venue": {"a": json.loads("[" * 900 + "]" * 900)}}, "/venue", ("at most 20",)),
    "same_name_twice": ({"venue": venue(box("a", -9, -9, 99, 9), box("a", 0, 5, 1, 6))}, "/venue", ("'a' twice",)),
    "many_edges": (
        {"venue": polygon("ring", *[(9 * math.cos(k / 400), 9 * math.sin(k / 400)) for k in range(2400)])},
        "/venue", ("at most 2000 edges", "2400"),
    ),
    "long_dragon": ({"dragon": {"benches": 2_001}}, "/dragon/benches", ("at most 2000", "got 2001")),
}  # fmt: skip


def assert_refused(answer: httpx.Response, place: str, words: tuple[str, ...]) -> None:
    assert answer.status_code == 422, answer.text
    (item,) = [one for one in answer.json()["errors"] if place in (one.get("pointer"), one.get("name"))][:1]
    assert [word for word in words if word not in item["detail"]] == [], item["detail"]


@pytest.mark.parametrize("call", ["/trajectory", "/clearance", "/check", "/figures/trajectory.svg"])
@pytest.mark.parametrize(("path", "place", "words"), BAD_PATHS.values(), ids=BAD_PATHS)
def test_an_invalid_path_is_a_problem_that_names_the_place(
    client: httpx.Client, call: str, path: Any, place: str, words: tuple[str, ...]
) -> None:
    assert_refused(client.post(call, json={"path": path}), place, words)


@pytest.mark.parametrize(("fields", "place", "words"), BAD_DANCES.values(), ids=BAD_DANCES)
def test_an_invalid_dance_is_a_problem_that_names_the_place(
    client: httpx.Client, fields: dict[str, Any], place: str, words: tuple[str, ...]
) -> None:
    body = {"dragon": SHORT, "path": route(LANE), **fields}
    assert_refused(client.post("/check", json=body), place, words)


@pytest.mark.parametrize(
    ("query", "place", "words"),
    [
        ("/turn?ratio=0", "ratio", ("at least 0.01",)),
        ("/turn?start_turns=1", "start_turns", ("2.64706 turns",)),
        ("/turn?entry_radius=9", "entry_radius", ("at most 4.5 m",)),
        ("/shortest-turn?ratio=0", "ratio", ("at least 0.01",)),
        ("/shortest-turn?start_turns=1", "start_turns", ("2.64706 turns",)),
        ("/shortest-turn?entry_radius=4", "entry_radius", ("unknown",)),
        ("/shortest-turn?exit_opposite=true&any_ratio=true", "any_ratio", ("must be false with exit_opposite",)),
        ("/turn?exit_radius=9", "exit_radius", ("at most 4.5 m",)),
        ("/shortest-turn?margin=3", "margin", ("at most 2 m",)),
        ("/shortest-turn?turning_diameter=7.9&exit_opposite=true", "turning_diameter", ("too tight", "2.86 m")),
        ("/shortest-turn?turning_diameter=8", "turning_diameter", ("too tight", "2.86 m")),
        ("/shortest-turn?pitch=0.8", "turning_diameter", ("benches 0 and 15 touch", "13.286258 s after")),
        ("/shortest-turn?benches=2001", "benches", ("at most 2000",)),
        ("/turn-time?entry_radius=2", "entry_radius", ("must be larger than 2 m", "bends to a radius of")),
        ("/turn?ends=1", "ends", ("must be 0 where no clothoid is in the middle", "1 m")),
        ("/turn?middle=40", "middle", ("no turn between these coils is found", "40 m")),
        ("/turn?middle=0", "middle", ("at least 0.001 m",)),
        ("/turn-time?ratio=1&middle=6&head_length=4.6", "middle", ("must be shorter than 6 m", "radius of 1.928 m")),
        ("/turn-time?speed_limit=0", "speed_limit", ("at least 0.001 m/s",)),
        ("/quickest-turn?speed_limit=0", "speed_limit", ("at least 0.001 m/s",)),
        ("/quickest-turn?turning_diameter=7", "turning_diameter", ("too tight", "2.86 m")),
        ("/quickest-turn?margin=0.8", "turning_diameter", ("must be larger", "within 0.8 m")),
        ("/quickest-turn?entry_radius=4", "entry_radius", ("unknown",)),
        ("/quickest-turn?benches=2001", "benches", ("at most 2000",)),
        ("/maximum-head-speed?speed_limit=0", "speed_limit", ("at least 0.001 m/s",)),
        ("/maximum-head-speed?turning_diameter=2", "turning_diameter", ("radius", "bench 0")),
        ("/maximum-head-speed?benches=2001", "benches", ("at most 2000",)),
    ],
)
def test_an_invalid_turn_is_a_problem(client: httpx.Client, query: str, place: str, words: tuple[str, ...]) -> None:
    assert_refused(client.get(query), place, words)


@pytest.mark.parametrize("call", ["/check", "/clearance", "/figures/trajectory.svg", "/figures/contact.png"])
def test_an_equal_question_is_answered_from_the_cache(client: httpx.Client, call: str) -> None:
    request = {"dragon": SHORT, "path": route(LANE)}
    if call == "/clearance":
        request["times"] = [20.0]
    elif call == "/figures/trajectory.svg":
        request["time"] = 20.0
    elif call == "/figures/contact.png":
        request["start"] = 20.0
    first = client.post(call, json=request).raise_for_status()
    again = client.post(call, json=request, headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
    other = client.post(call, json=request | {"head_speed": 1.1}, headers={"If-None-Match": first.headers["etag"]})
    assert other.status_code == 200


def test_a_figure_draws_the_venue_with_its_names(client: httpx.Client) -> None:
    areas = venue(box("market square", -2, -3, 62, 3), box("well", 55, 1, 57, 2))
    request = {"dragon": SHORT, "path": route(LANE), "venue": areas, "time": 58}
    drawn = client.post("/figures/trajectory.svg", json=request).raise_for_status()
    assert drawn.headers["content-type"].startswith("image/svg+xml")
    for name in ("market square", "well", "58 s"):
        assert f"{name} -->" in drawn.text
    answer = client.post("/figures/trajectory.svg", json=request | {"venue": None}).raise_for_status()
    assert "market square" not in answer.text

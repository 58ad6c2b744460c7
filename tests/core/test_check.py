"""One verdict: each part is what its own search says, and what fails is told in order of time."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import (
    Arc,
    Coil,
    Dragon,
    FailureKind,
    InvalidValue,
    Line,
    Outcome,
    OutsideRun,
    Route,
    Spiral,
    Venue,
    check,
    clearance_profile,
    first_contact,
    highest_speed,
    least_clearance,
    maximum_head_speed,
    sharpest_bend,
    trajectory,
    turn,
    venue_clearance,
)

BEND_LIMIT = 0.999  # half a chord over the radius of the tightest bend that a route may have [1]
REFERENCE = Path(__file__).parents[1] / "reference"
CLEARANCE = json.loads((REFERENCE / "turn.json").read_text())["clearance"]
SPEED = json.loads((REFERENCE / "maximum_head_speed.json").read_text())

REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]
ANGLE_ERROR = 1e-12  # [rad]
ONSET_ERROR = 1e-5  # [s]: the root of the error of the angle, some times over
PROVEN = 1.1e-5  # [m]: a least clearance is proven to this

TURN = turn(1.7).path
SQUARE = Venue.from_geojson(
    {"type": "Polygon", "coordinates": [[[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]]]}
)


def box(name: str, x: float, y: float, right: float, top: float) -> dict:
    ring = [[x, y], [right, y], [right, top], [x, top], [x, y]]
    return {"type": "Feature", "properties": {"name": name}, "geometry": {"type": "Polygon", "coordinates": [ring]}}


def venue(*boxes: dict) -> Venue:
    return Venue.from_geojson({"type": "FeatureCollection", "features": list(boxes)})


# -- the verdict ---------------------------------------------------------------------------------------------


@pytest.mark.uncompiled
def test_the_turn_passes_with_the_reference_values() -> None:
    start, stop = CLEARANCE["interval"]
    report = check(Dragon(), TURN, venue=SQUARE, margin=0.25, speed_limit=1.7, start=start, stop=stop)
    assert report.passed
    assert report.failures == ()
    assert (report.start, report.stop) == (start, stop)
    assert report.first_contact.outcome is Outcome.CLEAR
    assert report.least_clearance is not None
    assert report.least_clearance.distance == pytest.approx(CLEARANCE["least"], abs=REFERENCE_ERROR)
    assert report.least_clearance.time == pytest.approx(CLEARANCE["time"], abs=REFERENCE_ERROR)
    assert report.least_clearance.benches == tuple(CLEARANCE["benches"])
    assert report.highest_speed is not None
    assert report.highest_speed.speed == pytest.approx(SPEED["speed_ratio"], abs=REFERENCE_ERROR)
    assert report.highest_speed.time == pytest.approx(SPEED["time_at_unit_head_speed"], abs=REFERENCE_ERROR)
    assert set(report.highest_speed.handles) <= set(SPEED["handles_exactly_tied"])


def test_each_part_is_what_its_own_search_says() -> None:
    span = {"start": -40.0, "stop": 40.0, "head_speed": 1.3}
    report = check(Dragon(), TURN, venue=SQUARE, margin=0.3, **span)
    assert report.first_contact == first_contact(Dragon(), TURN, margin=0.3, **span)
    assert report.least_clearance == least_clearance(Dragon(), TURN, **span)
    assert report.venue == venue_clearance(Dragon(), TURN, SQUARE, margin=0.3, **span)
    assert report.highest_speed == highest_speed(Dragon(), TURN, **span)
    assert report.sharpest_bend == sharpest_bend(Dragon(), TURN, **span)


def test_all_that_fails_is_told_in_order_of_time() -> None:
    crowded = venue(box("square", -30, -30, 30, 30), box("post", -0.05, -0.05, 0.05, 0.05), box("van", 5, 5, 8, 8))
    report = check(Dragon(), TURN, venue=crowded, margin=0.3, speed_limit=1.5, start=-100.0, stop=100.0)
    assert not report.passed
    times = [failure.time for failure in report.failures]
    assert times == sorted(times)
    assert {failure.kind for failure in report.failures} == {
        FailureKind.VENUE,
        FailureKind.SPEED,
        FailureKind.CONTACT,
        FailureKind.OUTSIDE,
    }
    assert report.failures[0].time == -100.0
    by_kind = {failure.kind: failure for failure in report.failures}
    assert by_kind[FailureKind.SPEED].time == pytest.approx(SPEED["time_at_unit_head_speed"], abs=REFERENCE_ERROR)
    assert "above 1.5 m/s" in by_kind[FailureKind.SPEED].message
    assert by_kind[FailureKind.CONTACT].benches == report.first_contact.benches
    assert by_kind[FailureKind.CONTACT].time == report.first_contact.time
    assert by_kind[FailureKind.OUTSIDE].area == "van"
    assert "starts inside 'van'" in by_kind[FailureKind.OUTSIDE].message


def test_a_dragon_that_starts_outside_the_venue_fails_and_is_no_error() -> None:
    report = check(Dragon(), TURN, venue=venue(box("square", 50, 50, 60, 60)), start=-50.0, stop=50.0)
    assert [(failure.kind, failure.time, failure.area) for failure in report.failures] == [
        (FailureKind.OUTSIDE, -50.0, "square")
    ]
    assert report.failures[0].message.startswith("Bench 0 starts outside 'square', at (")


def test_the_dance_stops_where_benches_touch() -> None:
    report = check(Dragon(), Spiral(), venue=SQUARE, speed_limit=2.0)
    contact = first_contact(Dragon(), Spiral())
    assert report.stop == pytest.approx(contact.time, abs=REFERENCE_ERROR)
    assert [failure.kind for failure in report.failures] == [FailureKind.CONTACT]
    assert report.failures[0].benches == (0, 8)
    assert report.failures[0].message == "Benches 0 and 8 touch at 412.473838 s."
    assert report.least_clearance is not None
    assert report.least_clearance.distance == 0.0
    assert report.highest_speed is not None
    assert report.sharpest_bend is not None
    assert report.sharpest_bend.time <= report.stop


def test_a_margin_is_missed_before_the_touch_and_the_dance_goes_on_until_then() -> None:
    report = check(Dragon(), Spiral(), margin=0.05)
    assert report.first_contact.time is not None
    assert report.first_contact.time < 412.0 < report.stop
    assert "come within 0.05 m" in report.failures[0].message


def test_benches_that_touch_at_the_start_are_a_verdict() -> None:
    report = check(Dragon(), Spiral(pitch=0.3), venue=SQUARE, speed_limit=2.0)
    assert report.first_contact.outcome is Outcome.CONTACT_AT_START
    assert [(failure.kind, failure.time) for failure in report.failures] == [(FailureKind.CONTACT, 0.0)]
    assert 0.0 < report.stop < 0.01


def test_without_a_limit_a_run_to_the_fold_has_no_highest_speed() -> None:
    dragon, spiral = Dragon(benches=3), Spiral()
    report = check(dragon, spiral)
    assert report.highest_speed is None
    limited = check(dragon, spiral, speed_limit=5.0)
    speed = limited.failures[-1]
    assert speed.kind is FailureKind.SPEED
    assert "without bound" in speed.message
    assert speed.time == report.stop


def test_towards_the_fold_the_venue_is_followed_as_far_as_it_can_be() -> None:
    post = venue(box("square", -50, -50, 50, 50), box("post", 0.0, 0.0, 0.02, 0.02))
    report = check(Dragon(benches=3), Spiral(), venue=post)
    undecided = report.failures[0]
    assert undecided.kind is FailureKind.UNDECIDED
    assert 429.0 < undecided.time < report.stop
    head = trajectory(Dragon(benches=3), Spiral(), [undecided.time]).position[0, 0]
    assert np.hypot(*head) == pytest.approx(0.5 * 2.86 / BEND_LIMIT, abs=1e-2)  # the curvature is not quite 1 / r
    assert report.venue is not None
    assert all(area.outcome is Outcome.CLEAR for area in report.venue.areas)


# The head is followed to 1.43 m from the centre; two chords, an overhang and half a width reach 4.94 m further.
@pytest.mark.parametrize(("x", "passed"), [(6.3, False), (6.45, True)])
def test_to_the_fold_nothing_may_stand_where_only_the_leading_benches_get(x: float, passed: bool) -> None:
    scene = venue(box("square", -50, -50, 50, 50), box("post", x, 0, x + 0.01, 0.01))
    report = check(Dragon(3), Spiral(0.8, 3.0), venue=scene)
    assert report.passed is passed
    assert [failure.kind for failure in report.failures] == ([] if passed else [FailureKind.UNDECIDED])


def test_a_long_dragon_on_a_spiral_passes_in_a_square_around_it() -> None:
    assert check(Dragon(), Spiral(0.8), venue=SQUARE).passed


@pytest.mark.parametrize("benches", [1, 2])
def test_so_few_benches_cannot_touch(benches: int) -> None:
    report = check(Dragon(benches=benches), TURN, start=-10.0, stop=20.0, venue=SQUARE)
    assert report.passed
    assert report.least_clearance is None
    assert (report.sharpest_bend is None) == (benches == 1)
    assert report.venue is not None


def test_at_the_maximum_head_speed_the_limit_is_kept_and_just_above_it_is_not() -> None:
    span = {"start": -20.0, "stop": 40.0}
    fastest = maximum_head_speed(Dragon(benches=30), TURN, 2.0, **span).head_speed
    assert fastest == pytest.approx(SPEED["head_speed"], abs=REFERENCE_ERROR)
    for factor, passed in ((1.0, True), (1.0 + 1e-9, False)):
        speed = factor * fastest
        scaled = {name: time / speed for name, time in span.items()}
        assert check(Dragon(benches=30), TURN, speed_limit=2.0, head_speed=speed, **scaled).passed is passed


def test_a_wall_at_the_margin_to_rounding_is_undecided() -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    square = venue(box("square", -70, -9, 70, 0.35 + 1e-14))
    report = check(Dragon(benches=5), route, venue=square, margin=0.2, start=0.0)
    assert [(failure.kind, failure.area) for failure in report.failures] == [(FailureKind.UNDECIDED, "square")]
    assert report.venue is not None
    assert report.venue.areas[0].nearest.distance == pytest.approx(0.2, abs=1e-13)


# -- bad input -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "field"),
    [
        ({"margin": -0.1}, "margin"),
        ({"margin": math.nan}, "margin"),
        ({"speed_limit": 0.0}, "speed_limit"),
        ({"speed_limit": -2}, "speed_limit"),
        ({"speed_limit": math.nan}, "speed_limit"),
        ({"speed_limit": "2"}, "speed_limit"),
        ({"head_speed": 0.0}, "head_speed"),
        ({"start": math.inf}, "start"),
        ({"start": 5.0, "stop": 5.0}, "stop"),
        ({"stop": math.nan}, "stop"),
    ],
)
def test_broken_input_is_an_error(words: dict, field: str) -> None:
    with pytest.raises(InvalidValue) as e:
        check(Dragon(benches=5), TURN, **words)
    assert e.value.field == field


@pytest.mark.parametrize("words", [{"start": -1e4}, {"stop": 1e4}], ids=["before the path", "after the path"])
def test_a_time_that_the_path_does_not_have_is_an_error(words: dict) -> None:
    route = Route([Line((0, 0), (100, 0))])
    with pytest.raises(OutsideRun) as e:
        check(Dragon(benches=5), route, **words)
    assert e.value.field == next(iter(words))


def test_the_default_start_is_when_the_whole_dragon_is_on_the_route() -> None:
    dragon = Dragon(benches=5)
    report = check(dragon, Route([Line((0, 0), (100, 0))]), head_speed=2.0)
    assert report.start == pytest.approx(0.5 * float(dragon.chords.sum()), abs=1e-6)
    assert report.stop == 50.0
    assert check(dragon, Spiral(), stop=50.0).start == 0.0


# -- least clearance -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("dragon", "path", "start", "stop"),
    [
        (Dragon(), Spiral(), 0.0, 412.0),
        (Dragon(benches=60), Spiral(pitch=0.7), 100.0, 250.0),
        (Dragon(benches=40, head_length=2.2), TURN, -10.0, 60.0),
        (Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 4, [0.3, 0.5] * 10, [0.2] * 20), TURN, 0.0, 40.0),
    ],
    ids=["default", "wide coil", "turn", "benches of many sizes"],
)
def test_the_least_clearance_is_below_dense_samples_and_proven(
    dragon: Dragon, path: Spiral | Route, start: float, stop: float
) -> None:
    least = least_clearance(dragon, path, start=start, stop=stop)
    profile = clearance_profile(dragon, path, np.linspace(start, stop, 800))
    assert least is not None
    assert least.at_least is not None
    lowest = min(profile.clearance.min(), *(graze.clearance for graze in profile.grazes))
    assert least.at_least <= least.distance <= lowest + 1e-12
    assert least.distance - least.at_least < PROVEN
    there = clearance_profile(dragon, path, [least.time])
    assert there.clearance[0] == pytest.approx(least.distance, abs=1e-12)
    assert tuple(there.benches[0]) == least.benches


def test_a_first_touch_is_a_least_clearance_of_zero() -> None:
    least = least_clearance(Dragon(), Spiral())
    contact = first_contact(Dragon(), Spiral())
    assert least is not None
    assert (least.distance, least.at_least, least.benches) == (0.0, 0.0, contact.benches)
    assert least.time == pytest.approx(contact.time, abs=1e-12)


# -- sharpest bend -------------------------------------------------------------------------------------------


def test_there_is_no_bend_on_a_line() -> None:
    route = Route([Line((0, 0), (60, 0))])
    found = sharpest_bend(Dragon(benches=5), route, start=20.0)
    assert found is not None
    assert found.angle == 0.0


def test_a_bend_on_an_arc_is_half_of_both_chords_angles() -> None:
    route = Route([Line((-60, 0), (0, 0)), Arc((0, 4), 4.0, -0.5 * math.pi, 9.0)], start=60.0)
    dragon = Dragon(benches=8)
    found = sharpest_bend(dragon, route, start=0.0, stop=30.0)
    assert found is not None
    head, body = (math.asin(0.5 * chord / 4.0) for chord in dragon.chords[:2])
    assert found.angle == pytest.approx(head + body, abs=ANGLE_ERROR)
    assert found.benches == (0, 1)
    # once all three handles are on it; until then it falls short by the square of the arc left
    assert found.time == pytest.approx(4.0 * 2.0 * (head + body), abs=ONSET_ERROR)


def dense_bends(dragon: Dragon, path: Spiral | Route, times: np.ndarray) -> np.ndarray:
    along = np.diff(trajectory(dragon, path, times).position, axis=1)
    heading = np.unwrap(np.arctan2(along[..., 1], along[..., 0]), axis=1)
    return np.abs(np.diff(heading, axis=1))


@pytest.mark.parametrize(
    ("dragon", "path", "start", "stop"),
    [
        (Dragon(), TURN, -100.0, 100.0),
        (Dragon(benches=50), TURN, 30.0, 34.0),
        (Dragon(benches=50), TURN, 60.0, 60.9),
        (Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 4, [0.3, 0.5] * 10, [0.2] * 20), TURN, 0.0, 40.0),
        (Dragon(benches=40), Spiral(), 0.0, 400.0),
    ],
    ids=["turn", "turn behind the head", "a moment", "benches of many sizes", "spiral"],
)
def test_no_dense_sample_bends_more_sharply(dragon: Dragon, path: Spiral | Route, start: float, stop: float) -> None:
    found = sharpest_bend(dragon, path, start=start, stop=stop)
    assert found is not None
    dense = dense_bends(dragon, path, np.linspace(start, stop, 2_500))
    assert found.angle >= dense.max() - ANGLE_ERROR
    there = dense_bends(dragon, path, np.array([found.time]))[0]
    assert there[found.benches[0]] == pytest.approx(found.angle, abs=ANGLE_ERROR)


@settings(max_examples=15, deadline=None)
@given(st.lists(st.tuples(st.floats(2.0, 6.0), st.floats(-2.5, 2.5)), min_size=2, max_size=4), st.floats(0.1, 3.0))
@example([(3.25, 1.875), (5.5, 0.0)], 0.5)  # the nearest dip was not among the lowest samples
def test_scaling_every_length_scales_the_verdict(bends: list[tuple[float, float]], scale: float) -> None:
    def made(size: float) -> tuple[Dragon, Route]:
        place, heading, pieces = 0j, 0.0, [Line((-40 * size, 0), (0, 0))]
        for radius, sweep in bends:
            turned = math.copysign(max(abs(sweep), 0.3), sweep)
            angle = heading - math.copysign(0.5 * math.pi, turned)
            centre = place - radius * size * complex(math.cos(angle), math.sin(angle))
            pieces.append(Arc((centre.real, centre.imag), radius * size, angle, turned))
            place = centre + radius * size * complex(math.cos(angle + turned), math.sin(angle + turned))
            heading += turned
        sizes = {"head_length": 3.41, "body_length": 2.2, "width": 0.3, "overhang": 0.275}
        return Dragon(12, **{name: size * value for name, value in sizes.items()}), Route(pieces, start=40 * size)

    one, other = (check(*made(size), start=0.0, head_speed=size) for size in (1.0, scale))
    assert one.passed == other.passed
    assert one.sharpest_bend is not None
    assert other.sharpest_bend is not None
    assert one.sharpest_bend.angle == pytest.approx(other.sharpest_bend.angle, abs=1e-10)
    assert one.least_clearance is not None
    assert other.least_clearance is not None
    assert other.least_clearance.distance == pytest.approx(scale * one.least_clearance.distance, abs=1e-9)
    assert one.highest_speed is not None
    assert other.highest_speed is not None
    assert other.highest_speed.speed == pytest.approx(scale * one.highest_speed.speed, rel=1e-9)


def test_coils_in_three_pieces_have_the_verdict_of_one() -> None:
    whole = Route([Coil(0.6, 14, 4)])
    parts = Route([Coil(0.6, a, b) for a, b in pairwise((14, 9, 6.5, 4))])
    one, other = (check(Dragon(benches=60), route, start=0.0) for route in (whole, parts))
    assert one.passed == other.passed
    assert one.least_clearance is not None
    assert other.least_clearance is not None
    assert one.least_clearance.distance == pytest.approx(other.least_clearance.distance, abs=1e-10)

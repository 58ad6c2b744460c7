"""The verdict: each part agrees with its own search, and failures are in order of time."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import (
    Arc,
    Area,
    Coil,
    Dance,
    Dragon,
    EndReason,
    FailureKind,
    InvalidValue,
    Judgement,
    Line,
    Outcome,
    OutsideRun,
    Route,
    Spiral,
    Turn,
    Venue,
    bench_outlines,
    check,
    first_contact,
    highest_speed,
    least_clearance,
    maximum_head_speed,
    quick_check,
    sharpest_bend,
    trajectory,
    venue_clearance,
)
from core.contact.search import ContactSearch
from tests.support.reference import reference

CLEARANCE, SPEED = reference("turn")["clearance"], reference("maximum_head_speed")
REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]

TURN = Turn(1.7)


def box(name: str, x: float, y: float, right: float, top: float) -> Area:
    return Area(name, (((x, y), (right, y), (right, top), (x, top), (x, y)),))


def venue(square: Area, *obstacles: Area) -> Venue:
    return Venue(square, obstacles)


SQUARE = venue(box("square", -30, -30, 30, 30))


# -- the verdict ---------------------------------------------------------------------------------------------


@pytest.mark.uncompiled
def test_the_turn_passes_with_the_reference_values() -> None:
    start, stop = CLEARANCE["interval"]
    report = check(Dance(Dragon(), TURN), venue=SQUARE, margin=0.25, speed_limit=1.7, start=start, stop=stop)
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
    span = {"start": -40.0, "stop": 40.0}
    dance = Dance(Dragon(), TURN, 1.3)
    report = check(dance, venue=SQUARE, margin=0.3, **span)
    assert report.first_contact == first_contact(dance, margin=0.3, **span)
    assert report.least_clearance == least_clearance(dance, **span)
    assert report.venue == venue_clearance(dance, SQUARE, margin=0.3, **span)
    assert report.highest_speed == highest_speed(dance, **span)
    assert report.sharpest_bend == sharpest_bend(dance, **span)


def test_all_failures_are_listed_in_order_of_time() -> None:
    crowded = venue(box("square", -30, -30, 30, 30), box("post", -0.05, -0.05, 0.05, 0.05), box("van", 5, 5, 8, 8))
    report = check(Dance(Dragon(), TURN), venue=crowded, margin=0.3, speed_limit=1.5, start=-100.0, stop=100.0)
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
    speed = by_kind[FailureKind.SPEED]
    assert speed.peak_time == pytest.approx(SPEED["time_at_unit_head_speed"], abs=REFERENCE_ERROR)
    assert speed.peak_speed == pytest.approx(SPEED["speed_ratio"], abs=REFERENCE_ERROR)
    assert "first exceeds 1.5 m/s at 14.1296" in speed.message
    assert "the highest speed is 1.604793 m/s, of handle 3 at 14.479970 s" in speed.message
    assert by_kind[FailureKind.CONTACT].benches == report.first_contact.benches
    assert by_kind[FailureKind.CONTACT].time == report.first_contact.time
    assert by_kind[FailureKind.OUTSIDE].area == "van"
    assert "starts inside 'van'" in by_kind[FailureKind.OUTSIDE].message


def test_benches_that_touch_at_the_start_are_a_verdict() -> None:
    report = check(Dance(Dragon(), Spiral(pitch=0.3)), venue=SQUARE, speed_limit=2.0)
    assert report.first_contact.outcome is Outcome.CONTACT_AT_START
    assert [(failure.kind, failure.time) for failure in report.failures] == [(FailureKind.CONTACT, 0.0)]
    assert 0.0 < report.stop < 0.01


def test_without_a_limit_a_run_to_the_fold_has_no_highest_speed() -> None:
    dragon, spiral = Dragon(benches=3), Spiral()
    report = check(Dance(dragon, spiral))
    assert report.highest_speed is None
    limited = check(Dance(dragon, spiral), speed_limit=5.0)
    speed, fold = limited.failures
    assert (speed.kind, fold.kind) == (FailureKind.SPEED, FailureKind.FOLDS)
    assert "without bound" in speed.message
    assert speed.time < fold.time == report.stop
    assert (speed.peak_speed, speed.peak_time) == (None, fold.time)


def test_towards_the_fold_the_venue_is_followed_to_the_fold() -> None:
    post = venue(box("square", -50, -50, 50, 50), box("post", 0.0, 0.0, 0.02, 0.02))
    dance = Dance(Dragon(benches=3), Spiral())
    report = check(dance, venue=post)
    met, fold = report.failures
    assert (met.kind, met.area, fold.kind) == (FailureKind.VENUE, "post", FailureKind.FOLDS)
    assert met.time == pytest.approx(432.622776, abs=1e-6)  # after the curvature exceeds that of a bend of a route
    assert report.venue is not None
    assert report.venue.areas[1].nearest.distance == 0.0


@pytest.mark.parametrize(("y", "passed"), [(-1.5, False), (-1.9, True)])
def test_a_post_beside_the_benches_is_met_or_passed_before_the_fold(y: float, passed: bool) -> None:
    dance = Dance(Dragon(3), Spiral(0.8, 3.0))
    times = dance.end.time - np.linspace(0.0, 2.0, 2_000)[1:] ** 2  # the last four seconds
    outlines = bench_outlines(dance.dragon, trajectory(dance, times).position)
    slow = shapely.distance(shapely.polygons(outlines), shapely.box(0.0, y - 0.01, 0.01, y)).min()
    assert bool(slow > 0.0) is passed
    scene = venue(box("square", -50, -50, 50, 50), box("post", 0.0, y - 0.01, 0.01, y))
    report = check(dance, venue=scene, start=dance.end.time - 4.0)
    undecided = [] if passed else [FailureKind.VENUE]
    assert [failure.kind for failure in report.failures] == [*undecided, FailureKind.FOLDS]


def test_a_long_dragon_on_a_spiral_passes_in_a_square_around_it_until_it_folds() -> None:
    fold = Dance(Dragon(), Spiral(0.8)).end.time
    assert [failure.kind for failure in check(Dance(Dragon(), Spiral(0.8)), venue=SQUARE).failures] == [
        FailureKind.FOLDS
    ]
    assert check(Dance(Dragon(), Spiral(0.8)), venue=SQUARE, stop=fold - 10.0).passed


def test_a_head_that_starts_where_no_bend_of_a_route_is_as_tight_is_judged_all_the_same() -> None:
    dragon, path = Dragon(1), Spiral(0.55, 2.5)
    report = check(Dance(dragon, path), venue=SQUARE, stop=0.1)
    assert report.passed
    assert report.venue is not None
    assert report.venue.areas[0].nearest.at_least is not None


# -- a dance that folds --------------------------------------------------------------------------------------


SHORT = Dance(Dragon(40), Spiral(1.2, 8.0))  # nothing touches, and the head folds 1.12 m from the centre


def test_a_dance_that_stops_before_its_fold_passes() -> None:
    before = SHORT.end.time - 1e-3
    assert check(SHORT, stop=before).passed


def test_a_dance_to_the_centre_passes() -> None:
    dragon, path = Dragon(5), Spiral(9.0, 3.0)
    assert Dance(dragon, path).end.reason is EndReason.CENTRE
    report = check(Dance(dragon, path))
    assert (report.verdict, report.passed, report.failures) == (Judgement.PASSES, True, ())


def test_a_fold_behind_the_touch_at_which_the_dance_stops_is_not_told() -> None:
    report = check(Dance(Dragon(), Spiral()), stop=1_000.0)
    assert [failure.kind for failure in report.failures] == [FailureKind.CONTACT]
    assert report.stop < Dance(Dragon(), Spiral()).end.time


def test_a_fold_behind_a_margin_that_is_missed_is_reported_too() -> None:
    report = check(SHORT, margin=0.88)
    assert [failure.kind for failure in report.failures] == [FailureKind.CONTACT, FailureKind.FOLDS]
    assert report.failures[0].time < report.failures[1].time


def test_no_clearance_is_proven_for_benches_that_overlap_from_the_start() -> None:
    report = check(Dance(Dragon(), Spiral(0.3)))
    assert report.least_clearance is not None
    assert report.least_clearance.distance == pytest.approx(-0.114627, abs=1e-6)
    assert report.least_clearance.at_least is None
    assert report.stop < 0.01


@pytest.mark.parametrize("benches", [1, 2])
def test_so_few_benches_cannot_touch(benches: int) -> None:
    report = check(Dance(Dragon(benches=benches), TURN), start=-10.0, stop=20.0, venue=SQUARE)
    assert report.passed
    assert report.least_clearance is None
    assert (report.sharpest_bend is None) == (benches == 1)
    assert report.venue is not None


def test_at_the_maximum_head_speed_the_limit_is_kept_and_just_above_it_is_not() -> None:
    span = {"start": -20.0, "stop": 40.0}
    fastest = maximum_head_speed(Dance(Dragon(benches=30), TURN), 2.0, **span).head_speed
    assert fastest == pytest.approx(SPEED["head_speed"], abs=REFERENCE_ERROR)
    for factor, passed in ((1.0, True), (1.0 + 1e-9, False)):
        speed = factor * fastest
        scaled = {name: time / speed for name, time in span.items()}
        assert check(Dance(Dragon(benches=30), TURN, speed), speed_limit=2.0, **scaled).passed is passed


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
        ({"start": math.inf}, "start"),
        ({"start": 5.0, "stop": 5.0}, "stop"),
        ({"stop": math.nan}, "stop"),
    ],
)
def test_broken_input_is_an_error(words: dict, field: str) -> None:
    with pytest.raises(InvalidValue) as e:
        check(Dance(Dragon(benches=5), TURN), **words)
    assert e.value.field == field


@pytest.mark.parametrize("words", [{"start": -1e4}, {"stop": 1e4}], ids=["before the path", "after the path"])
def test_a_time_that_the_path_does_not_have_is_an_error(words: dict) -> None:
    route = Route([Line((0, 0), (100, 0))])
    with pytest.raises(OutsideRun) as e:
        check(Dance(Dragon(benches=5), route), **words)
    assert e.value.field == next(iter(words))


def test_a_check_lays_out_one_search_for_each_question_and_area(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[int] = []
    lay_out = ContactSearch.__init__

    def recording(search: ContactSearch, *args: Any, **kwargs: Any) -> None:
        lay_out(search, *args, **kwargs)
        made.append(len(search.edges))

    monkeypatch.setattr(ContactSearch, "__init__", recording)
    route = Route([Line((0, 0), (100, 0))])
    square = venue(box("square", -10, -10, 110, 10), box("well", 40, 4, 44, 8), box("tree", 60, 4, 61, 5))
    check(Dance(Dragon(benches=5), route), venue=square, margin=0.5, speed_limit=2.0)
    assert made == [0, 0, 4, 4, 4, 0]  # first contact, least clearance, three areas, highest speed
    made.clear()
    quick_check(Dance(Dragon(benches=5), route), venue=square, margin=0.5, speed_limit=2.0)
    assert made == [0, 4, 4, 4, 0]


def test_the_default_start_is_when_the_whole_dragon_is_on_the_route() -> None:
    dragon = Dragon(benches=5)
    report = check(Dance(dragon, Route([Line((0, 0), (100, 0))]), 2.0))
    assert report.start == pytest.approx(0.5 * float(dragon.chords.sum()), abs=1e-6)
    assert report.stop == 50.0
    assert check(Dance(dragon, Spiral()), stop=50.0).start == 0.0


# -- laws ----------------------------------------------------------------------------------------------------


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

    one, other = (check(Dance(*made(size), size), start=0.0) for size in (1.0, scale))
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
    one, other = (check(Dance(Dragon(benches=60), route), start=0.0) for route in (whole, parts))
    assert one.passed == other.passed
    assert one.least_clearance is not None
    assert other.least_clearance is not None
    assert one.least_clearance.distance == pytest.approx(other.least_clearance.distance, abs=1e-10)


@pytest.mark.parametrize(
    ("dance", "query"),
    [
        (Dance(Dragon(12), Spiral(0.5, 6.0)), {}),
        (Dance(Dragon(12), Spiral(0.5, 6.0)), {"margin": 0.05}),
        (Dance(Dragon(12), Spiral(1.2, 6.0)), {"speed_limit": 1.5, "venue": venue(box("square", -8, -8, 8, 8))}),
        (Dance(Dragon(9), Turn(1.7)), {"speed_limit": 1.1, "stop": 30.0}),
        (Dance(Dragon(9), Turn(1.7)), {"venue": venue(box("square", -50, -50, 50, 50), box("well", 6, 0, 7, 1))}),
    ],
    ids=["contact", "margin", "folds and leaves", "too fast", "meets the well"],
)
def test_a_quick_check_has_the_failures_of_the_whole_one(dance: Dance, query: dict[str, Any]) -> None:
    whole, quick = check(dance, **query), quick_check(dance, **query)
    assert whole.failures
    assert quick.failures == whole.failures
    assert (quick.start, quick.stop, quick.verdict) == (whole.start, whole.stop, whole.verdict)
    assert quick.sharpest_bend is None
    assert all(area.nearest is None for area in quick.venue.areas) if quick.venue else whole.venue is None

"""The verdict on a performance: each dragon by itself as by check(), and encounters; and where everyone is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core import (
    Area,
    Dance,
    Dragon,
    FailureKind,
    InvalidValue,
    Judgement,
    Line,
    Part,
    Performance,
    Route,
    Spiral,
    Venue,
    bench_outlines,
    check,
    envelope,
    first_encounter,
    performance_check,
    performance_envelope,
    performance_least_clearance,
    performance_trajectory,
    quick_check,
    trajectory,
)

SQUARE = Venue(Area("square", (((-35, -30), (30, -30), (30, 30), (-35, 30), (-35, -30)),)))
STREETS = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
DANCES = [Dance(Dragon(5), Route([street])) for street in STREETS]
CROSSING = Performance([Part(dance, name=name) for dance, name in zip(DANCES, ("east", "north"), strict=True)])


@pytest.mark.parametrize("venue", [None, SQUARE], ids=["no venue", "venue"])
@pytest.mark.parametrize(
    "dance", [Dance(Dragon(30), Spiral(0.5, 9.0)), CROSSING.parts[0].dance], ids=["spiral", "street"]
)
def test_a_single_dragon_has_the_report_of_check_to_the_last_bit(dance: Dance, venue: Venue | None) -> None:
    options = {"margin": 0.01, "speed_limit": 1.2}
    alone = check(dance, venue=venue, **options)
    report = performance_check(Performance([Part(dance)], venue), **options)
    assert report.reports == (alone,)
    assert [failure.failure for failure in report.failures] == list(alone.failures)
    assert [failure.message for failure in report.failures] == [failure.message for failure in alone.failures]
    assert (report.verdict, report.passed) == (alone.verdict, alone.passed)
    assert (report.start, report.stop) == (dance.begin, dance.end.time)


def test_failures_of_all_dragons_stand_in_order_of_time_and_name_their_dragon() -> None:
    performance = replace(CROSSING, venue=SQUARE)
    report = performance_check(performance)
    met = first_encounter(performance)
    assert report.encounter == met
    assert report.least_clearance == performance_least_clearance(performance)
    assert report.verdict is Judgement.FAILS
    times = [failure.time for failure in report.failures]
    assert times == sorted(times)
    assert [failure.time for failure in report.failures if len(failure.dragons) == 2] == [met.time]
    messages = [failure.message for failure in report.failures]
    assert f"Bench 0 of east and bench 0 of north touch at {met.time:.6f} s." in messages
    for k, name in enumerate(("East", "North")):
        own = [failure.failure for failure in report.failures if failure.dragons == (k,)]
        assert own == list(check(performance.parts[k].dance, venue=SQUARE).failures)
        assert all(failure.message.startswith(name) for failure in report.failures if failure.dragons == (k,))


def test_a_delay_shifts_the_failures_of_a_dragon_and_its_brackets() -> None:
    parts = [CROSSING.parts[0], replace(CROSSING.parts[1], delay=30.0)]
    early, late = (performance_check(Performance(some, SQUARE)) for some in (CROSSING.parts, parts))
    assert not [failure for failure in late.failures if len(failure.dragons) == 2]
    one, two = ([failure for failure in report.failures if failure.dragons == (1,)] for report in (early, late))
    assert len(one) == len(two) > 0
    for before, after in zip(one, two, strict=True):
        assert after.time == pytest.approx(before.time + 30.0, abs=1e-9)
        assert after.kind is before.kind is not FailureKind.CONTACT
        assert f"{after.time:.6f} s of the performance" in after.message


def test_without_details_the_failures_are_the_same_and_the_rest_is_left_out() -> None:
    performance = replace(CROSSING, venue=SQUARE)
    full, quick = (performance_check(performance, margin=0.1, details=details) for details in (True, False))
    assert quick.failures == full.failures
    assert quick.reports == tuple(quick_check(part.dance, venue=SQUARE, margin=0.1) for part in performance.parts)
    assert quick.least_clearance is None
    assert full.least_clearance == performance_least_clearance(performance)


def test_a_dragon_that_stands_all_the_time_has_no_report_of_its_own() -> None:
    performance = Performance([CROSSING.parts[0], replace(CROSSING.parts[1], delay=500.0)])
    report = performance_check(performance, stop=40.0)
    assert report.reports[1] is None
    assert report.reports[0] is not None
    assert report.passed


def test_everyone_is_where_its_own_dance_puts_it_and_stands_before_and_after() -> None:
    part = replace(CROSSING.parts[1], delay=20.0)
    times = [0.0, 30.5, 45.0, 99.0, 200.0]
    first, second = performance_trajectory(Performance([CROSSING.parts[0], part]), times)
    own = trajectory(part.dance, [part.own_time(time) for time in times])
    assert (second.position == own.position).all()
    assert second.time.tolist() == times
    dances = np.array([part.begin <= time <= part.end for time in times])
    assert dances.tolist() == [False, True, True, True, False]
    assert (second.velocity[dances] == own.velocity[dances]).all()
    assert not second.speed[~dances].any()
    alone = trajectory(CROSSING.parts[0].dance, times[1:3])
    assert (first.position[1:3] == alone.position).all()
    (same,) = performance_trajectory(Performance([CROSSING.parts[0]]), times[1:3])
    assert (same.velocity == alone.velocity).all()
    assert same.dance == CROSSING.parts[0].dance
    assert performance_trajectory(CROSSING, 30.0)[0].position.shape == (6, 2)


def test_the_ground_of_each_dragon_is_that_of_its_dance_and_of_the_place_where_it_stands() -> None:
    late = replace(CROSSING.parts[1], delay=20.0)
    first, second = performance_envelope(Performance([CROSSING.parts[0], late]), stop=30.0, excess=0.01)
    assert first == envelope(CROSSING.parts[0].dance, stop=30.0, excess=0.01)
    assert second == envelope(late.dance, stop=late.own_time(30.0), excess=0.01)
    standing = replace(CROSSING.parts[1], delay=500.0)
    _, still = performance_envelope(Performance([CROSSING.parts[0], standing]), stop=30.0, excess=0.01)
    assert still.stop - still.start == pytest.approx(1e-3)
    outlines = bench_outlines(late.dance.dragon, trajectory(late.dance, late.dance.begin).position)
    width, height = (float(np.ptp(outlines[..., axis])) for axis in (0, 1))  # its benches overlap in a row
    assert width * height <= still.area <= (width + 0.021) * (height + 0.021)


@pytest.mark.parametrize("times", ["now", [np.nan], [np.inf], [True], [[1.0]]])
def test_impossible_times_are_refused(times: object) -> None:
    with pytest.raises(InvalidValue):
        performance_trajectory(CROSSING, times)  # type: ignore[arg-type]

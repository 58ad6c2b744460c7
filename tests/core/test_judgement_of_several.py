"""The verdict on a performance: each dragon by itself as by check(), and encounters; and where everyone is."""

from dataclasses import replace

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    FailureKind,
    Judgement,
    Part,
    Performance,
    Spiral,
    Venue,
    bench_outlines,
    check,
    envelope,
    first_encounter,
    least_clearance,
    quick_check,
    trajectory,
)
from tests.support.near import assert_near
from tests.support.random_squares import box
from tests.support.shared_dances import EAST, NORTH, on_lanes

SQUARE = Venue(box("square", -35, -30, 65, 60))
CROSSING = Performance(
    [replace(part, name=name) for part, name in zip(on_lanes(EAST, NORTH).parts, ("east", "north"), strict=True)]
)
IN_SQUARE = replace(CROSSING, venue=SQUARE)


def delayed(seconds, venue=None):
    """The second dragon begins so much later."""
    return Performance([CROSSING.parts[0], replace(CROSSING.parts[1], delay=seconds)], venue)


@pytest.mark.parametrize("question", [check, quick_check])
@pytest.mark.parametrize("venue", [None, SQUARE], ids=["no venue", "venue"])
def test_a_single_dragon_has_the_report_of_its_dance_to_the_last_bit(question, venue):
    dance = Dance(Dragon(30), Spiral(0.5, 9.0))
    options = {"margin": 0.01, "speed_limit": 1.2}
    alone = question(dance, venue=venue, **options)
    report = question(Performance([Part(dance)], venue), **options)
    assert report.reports == (alone,)
    assert [(one.failure, one.message) for one in report.failures] == [(one, one.message) for one in alone.failures]
    assert report.verdict == alone.verdict
    assert report.passed == alone.passed
    assert report.start == dance.begin
    assert report.stop == dance.end.time


def test_failures_of_all_dragons_stand_in_order_of_time_and_name_their_dragon():
    report = check(IN_SQUARE)
    met = first_encounter(IN_SQUARE)
    assert report.encounter == met
    assert report.verdict == Judgement.FAILS
    assert report.least_clearance == least_clearance(IN_SQUARE)
    failures = report.failures
    assert [one.time for one in failures] == sorted(one.time for one in failures)
    (both,) = (one for one in failures if len(one.dragons) == 2)
    assert both.message == f"Bench 0 of east and bench 0 of north touch at {met.time:.6f} s."
    for k, part in enumerate(CROSSING.parts):
        alone = check(part.dance, venue=SQUARE).failures
        assert [one.failure for one in failures if one.dragons == (k,)] == list(alone)
        assert all(one.message.lower().startswith(part.name) for one in failures if one.dragons == (k,))


def test_a_delay_shifts_the_failures_of_a_dragon_and_its_brackets():
    reports = check(IN_SQUARE), check(delayed(30.0, SQUARE))
    assert not [failure for failure in reports[1].failures if len(failure.dragons) == 2]
    early, late = ([one for one in report.failures if one.dragons == (1,)] for report in reports)
    assert late
    for before, after in zip(early, late, strict=True):
        assert_near(after.time, before.time + 30.0, 1e-9)
        assert after.kind is before.kind is not FailureKind.CONTACT


def test_a_dragon_that_stands_all_the_time_has_no_report_of_its_own():
    report = check(delayed(500.0), stop=40.0)
    assert (report.reports[0] is None, report.reports[1], report.passed) == (False, None, True)


def test_everyone_is_where_its_own_dance_puts_it_and_stands_before_and_after():
    performance = delayed(20.0)
    times = [0.0, 30.5, 45.0, 99.0, 200.0]
    first, second = trajectory(performance, times)
    alone = trajectory(CROSSING.parts[1].dance, [performance.parts[1].own_time(time) for time in times])
    assert (second.position == alone.position).all()
    assert second.time.tolist() == times
    assert (second.velocity[1:4] == alone.velocity[1:4]).all()
    assert not second.speed[[0, 4]].any()
    alone = trajectory(CROSSING.parts[0].dance, times[1:3])
    assert (first.position[1:3] == alone.position).all()
    assert trajectory(CROSSING, 30.0)[0].position.shape == (6, 2)


def test_the_ground_of_a_dragon_that_stands_is_that_of_its_place():
    dance = CROSSING.parts[1].dance
    query = {"stop": 30.0, "excess": 0.01}
    _, still = envelope(delayed(500.0), **query)
    width, height = np.ptp(bench_outlines(dance.dragon, trajectory(dance, dance.begin).position), axis=(0, 1))
    assert width * height <= still.area <= (width + 0.021) * (height + 0.021)  # its benches overlap in a row

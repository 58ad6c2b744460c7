"""Failures: the first instant of each, and its sentence."""

from __future__ import annotations

import re

import numpy as np
import pytest

import core.extremes.speed
from core import (
    Dance,
    Dragon,
    FailureKind,
    Judgement,
    Line,
    Route,
    Spiral,
    check,
    first_contact,
    highest_speed,
    trajectory,
)
from core.extremes.speed import SPEED_ROUNDING
from tests.core.test_judgement import REFERENCE_ERROR, SHORT, SQUARE, TURN, box, venue

EXCESS_ERROR = 1e-9  # [s]: a first excess is bracketed so closely at 1 m/s and more


def test_a_dragon_that_starts_outside_the_venue_fails_and_is_no_error() -> None:
    report = check(Dance(Dragon(), TURN), venue=venue(box("square", 50, 50, 60, 60)), start=-50.0, stop=50.0)
    assert [(failure.kind, failure.time, failure.area) for failure in report.failures] == [
        (FailureKind.OUTSIDE, -50.0, "square")
    ]
    assert report.failures[0].message.startswith("Bench 0 starts outside 'square', at (")


def test_the_dance_stops_where_benches_touch() -> None:
    report = check(Dance(Dragon(), Spiral()), venue=SQUARE, speed_limit=2.0)
    contact = first_contact(Dance(Dragon(), Spiral()))
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
    report = check(Dance(Dragon(), Spiral()), margin=0.05)
    assert report.first_contact.time is not None
    assert report.first_contact.time < 412.0 < report.stop
    assert (
        report.failures[0].message == "Benches 0 and 14 come within 0.05 m at 383.867583 s, with a gap of 0.050000 m."
    )
    assert report.failures[1].message == "Benches 0 and 8 have no gap left at 412.473838 s, where the dance stops."


@pytest.mark.parametrize("stop", [None, 500.0, SHORT.end.time], ids=["no stop", "a later stop", "at the fold"])
def test_a_dance_that_folds_fails_with_place_time_and_bench(stop: float | None) -> None:
    end = SHORT.end
    report = check(SHORT, stop=stop)
    assert (report.verdict, report.passed) == (Judgement.FAILS, False)
    (fold,) = report.failures
    assert (fold.kind, fold.time, fold.benches) == (FailureKind.FOLDS, end.time, (end.bench,))
    assert report.stop == end.time
    head = trajectory(SHORT, end.time).position[0]
    assert fold.head is not None
    assert (fold.head.x, fold.head.y) == pytest.approx(head.tolist(), abs=REFERENCE_ERROR)
    assert fold.head.theta == pytest.approx(end.theta, abs=REFERENCE_ERROR)
    assert fold.message.startswith("Bench 0 folds at 238.214985 s, the head at (1.012010, -0.471973) m, theta = 5.8468")


@pytest.mark.parametrize(
    ("dragon", "path", "limit", "head_speed", "start", "stop"),
    [
        (Dragon(), TURN, 1.2, 1.0, -100.0, 100.0),
        (Dragon(), TURN, 1.6047, 1.0, -100.0, 100.0),
        (Dragon(), TURN, 2.0, 1.9, -50.0, 50.0),
        (Dragon(40), Spiral(1.2, 8.0), 2.0, 1.0, 0.0, 500.0),
        (Dragon(5), Spiral(1.2, 8.0), 3.0, 2.5, 50.0, None),
    ],
    ids=["turn", "close to the peak", "fast head", "to the fold", "late start"],
)
def test_a_speed_failure_is_at_the_first_instant_above_the_limit(
    dragon: Dragon, path: Spiral | Route, limit: float, head_speed: float, start: float, stop: float | None
) -> None:
    report = check(Dance(dragon, path, head_speed), speed_limit=limit, start=start, stop=stop)
    (speed,) = [failure for failure in report.failures if failure.kind is FailureKind.SPEED]
    assert speed.time_bracket is not None
    kept, above = speed.time_bracket
    assert above == speed.time
    assert above - kept < EXCESS_ERROR
    ends = trajectory(Dance(dragon, path, head_speed), [kept, above]).speed
    assert ends[0].max() <= limit * (1.0 + SPEED_ROUNDING) < ends[1].max()
    assert ends[1][speed.benches[0]] >= ends[1].max() * (1.0 - SPEED_ROUNDING)  # on one arc handles are equally fast
    before = np.concatenate([np.linspace(start, kept, 2_000), kept - np.geomspace(1e-8, 1.0, 200)])
    assert trajectory(Dance(dragon, path, head_speed), before).speed.max() <= limit * (1.0 + SPEED_ROUNDING)
    assert f"first exceeds {limit:g} m/s at {speed.time:.6f} s" in speed.message


def test_a_head_that_is_too_fast_is_so_from_the_start() -> None:
    (speed,) = check(Dance(Dragon(5), TURN, 1.5), speed_limit=1.0000001, start=-20.0, stop=0.0).failures
    assert "exceeds 1.0000001 m/s" in speed.message
    assert (speed.time, speed.time_bracket, speed.benches) == (-20.0, (-20.0, -20.0), (0,))


def test_an_excess_so_near_to_the_fold_that_its_proof_ends_is_bracketed() -> None:
    dragon, path = SHORT.dragon, SHORT.path
    speed, _ = check(Dance(dragon, path), speed_limit=5_000.0).failures
    assert speed.time_bracket is not None
    kept, above = speed.time_bracket
    assert kept < above == speed.time < Dance(dragon, path).end.time
    ends = trajectory(Dance(dragon, path), [kept, above]).speed.max(axis=1)
    assert ends[0] < 5_000.0 < ends[1]


def test_a_limit_beyond_what_doubles_reach_before_the_fold_fails_at_the_fold() -> None:
    dragon, path = SHORT.dragon, SHORT.path
    report = check(Dance(dragon, path, 1e-5), speed_limit=1e4)
    speed, fold = report.failures
    assert (speed.kind, speed.time, speed.benches) == (FailureKind.SPEED, fold.time, ())
    assert "is proven to be kept up to" in speed.message


def test_a_proof_that_runs_short_of_work_leaves_a_kept_limit_undecided_and_a_broken_one_broken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    span = {"start": -100.0, "stop": 100.0}
    monkeypatch.setattr(core.extremes.speed, "LINKS_BUDGET", 10)
    monkeypatch.setattr(core.extremes.speed, "EXCESS_LINKS", 10)
    peak = highest_speed(Dance(Dragon(), TURN), **span).speed
    kept = check(Dance(Dragon(), TURN), speed_limit=peak * (1.0 + 1e-9), **span)
    assert [failure.kind for failure in kept.failures] == [FailureKind.UNDECIDED]
    assert (kept.verdict, kept.passed) == (Judgement.UNDECIDED, False)
    broken = check(Dance(Dragon(), TURN), speed_limit=1.5, **span)
    (speed,) = broken.failures
    assert (broken.verdict, speed.kind) == (Judgement.FAILS, FailureKind.SPEED)
    assert "at the latest" in speed.message
    assert trajectory(Dance(Dragon(), TURN), speed.time).speed.max() > 1.5


def test_with_a_margin_every_sentence_says_within_it_and_the_gap() -> None:
    wall = venue(box("square", -30, -30, 30, 30), box("lamp", 4.95, -3, 5, -2.9))
    failures = check(Dance(Dragon(), TURN), venue=wall, margin=0.35, start=-100.0, stop=100.0).failures
    near = [failure.message for failure in failures if failure.kind in (FailureKind.CONTACT, FailureKind.VENUE)]
    assert len(near) == 2
    for message in near:
        assert "within 0.35 m" in message
        assert message.endswith(" m.")
        assert not re.search("touch|meet", message)
    assert "Benches 0 and 16 come within 0.35 m at 13.630164 s, with a gap of 0.350000 m." in near


def test_with_a_margin_benches_that_overlap_from_the_start_say_how_deep() -> None:
    (contact,) = check(Dance(Dragon(), Spiral(0.3)), margin=0.2).failures
    assert contact.message == "Benches 8 and 28 come within 0.2 m at 0.000000 s, and overlap by 0.114627 m."


def test_with_a_margin_a_bench_on_a_wall_from_the_start_says_how_deep() -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    report = check(Dance(Dragon(benches=5), route), venue=venue(box("square", -70, -9, 70, 0.1)), margin=0.2, start=0.0)
    (near,) = [failure.message for failure in report.failures if failure.kind is FailureKind.VENUE]
    assert near.endswith(" comes within 0.2 m of 'square' at 0.000000 s, and overlaps it by 0.050000 m.")


def test_a_wall_at_the_margin_to_rounding_is_undecided_and_that_is_no_failure() -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    square = venue(box("square", -70, -9, 70, 0.35 + 1e-14))
    report = check(Dance(Dragon(benches=5), route), venue=square, margin=0.2, start=0.0)
    assert [(failure.kind, failure.area) for failure in report.failures] == [(FailureKind.UNDECIDED, "square")]
    assert (report.verdict, report.passed) == (Judgement.UNDECIDED, False)
    assert "within 0.2 m of 'square' is not decided" in report.failures[0].message
    assert report.venue is not None
    assert report.venue.areas[0].nearest.distance == pytest.approx(0.2, abs=1e-13)

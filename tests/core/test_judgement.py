"""The verdict: each part agrees with its own search, and failures are in order of time."""

import pytest

from core import (
    Dance,
    Dragon,
    FailureKind,
    Judgement,
    Spiral,
    Turn,
    Venue,
    check,
    first_contact,
    highest_speed,
    least_clearance,
    maximum_head_speed,
    quick_check,
    sharpest_bend,
    venue_clearance,
)
from tests.support.random_squares import box
from tests.support.shared_dances import lane, square

TURN = Turn(1.7)
SQUARE = square(30)
SHORT = Dance(Dragon(40), Spiral(1.2, 8.0))  # nothing touches, and the head folds 1.12 m from the centre
DEFAULT, TIGHT = (Dance(Dragon(), Spiral(pitch)) for pitch in (0.55, 0.3))
AROUND = Dance(Dragon(), TURN)
FEW = Dance(Dragon(3), Spiral())
ALONG = Dance(Dragon(5), lane((-60, 0), (60, 0), start=60.0))
SPAN = {"start": -100.0, "stop": 100.0}


def around(*obstacles, half=30):
    return {"venue": Venue(square(half).square, obstacles)}


FOLD = "Bench 0 folds at 238.214985 s, the head at (1.012010, -0.471973) m, theta = 5.846801 rad: it cannot follow the"
# Dances, what is asked about them, and how the sentences of their failures begin.
VERDICTS = {
    "starts outside": (AROUND, {"venue": Venue(box("square", 50, 50, 10, 10)), "start": -50.0, "stop": 50.0}, [
        "Bench 0 starts outside 'square', at (5.98761, 3.18713) m."]),
    "touches": (DEFAULT, {"venue": SQUARE, "stop": 1000.0}, ["Benches 0 and 8 touch at 412.473838 s."]),
    "misses a margin, and goes on until it touches": (DEFAULT, {"margin": 0.05}, [
        "Benches 0 and 14 come within 0.05 m at 383.867583 s, with a gap of 0.050000 m.",
        "Benches 0 and 8 have no gap left at 412.473838 s, where the dance stops."]),
    "folds": (SHORT, {}, [FOLD]),
    "folds at the stop": (SHORT, {"stop": SHORT.end.time}, [FOLD]),
    "stops before the fold": (SHORT, {"stop": SHORT.end.time - 1e-3}, []),
    "touches at the start": (TIGHT, {"venue": SQUARE, "speed_limit": 2.0}, ["Benches 8 and 28 touch at 0.000000 s."]),
    "overlaps at the start": (TIGHT, {"margin": 0.2}, [
        "Benches 8 and 28 come within 0.2 m at 0.000000 s, and overlap by 0.114627 m."]),
    # After the curvature exceeds that of a bend of a route.
    "post near the fold": (FEW, around(box("post", 0, 0, 0.02, 0.02), half=50), [
        "Bench 0 touches 'post' at 432.622776 s.", "Bench 0 folds at 432.917924 s"]),
    "head too fast": (Dance(Dragon(5), TURN, 1.5), {"speed_limit": 1.0000001, "start": -20.0, "stop": 0.0}, [
        "Handle 0 first exceeds 1.0000001 m/s at -20.000000 s; the highest speed is 1.500000 m/s, of handle 0 at -20"]),
    "too fast before the fold": (FEW, {"speed_limit": 5.0}, [
        "Handle 1 first exceeds 5 m/s at 432.911821 s; towards 432.917924 s, when bench 0 folds, speeds grow without",
        "Bench 0 folds at 432.917924 s"]),
    "limit beyond what doubles reach": (Dance(SHORT.dragon, SHORT.path, 1e-5), {"speed_limit": 1e4}, [
        "A handle exceeds 10000 m/s: towards 23821498.539161 s, when bench 0 folds, speeds grow without bound",
        "Bench 0 folds at 23821498.539161 s"]),
    "on a wall": (ALONG, {"venue": Venue(box("square", -70, -9, 140, 9.1)), "margin": 0.2, "start": 0.0}, [
        "Bench 0 comes within 0.2 m of 'square' at 0.000000 s, and overlaps it by 0.050000 m."]),
    "wall at the margin": (ALONG, {"venue": Venue(box("square", -70, -9, 140, 9.35 + 1e-14)), "margin": 0.2,
                                   "start": 0.0}, [
        "Whether a bench comes within 0.2 m of 'square' is not decided from 0.000000 s on."]),
    "lamp within a margin": (AROUND, {**around(box("lamp", 4.95, -3, 0.05, 0.1)), "margin": 0.35, **SPAN}, [
        "Benches 0 and 16 come within 0.35 m at 13.630164 s, with a gap of 0.350000 m.",
        "Bench 0 comes within 0.35 m of 'lamp' at 37.798993 s, with a gap of 0.350000 m."]),
    "everything": (AROUND, {**around(box("post", -0.05, -0.05, 0.1, 0.1), box("van", 5, 5, 3, 3)), "margin": 0.3,
                            "speed_limit": 1.5, **SPAN}, [
        "Bench 1 starts inside 'van', at (5.59446, 6.65864) m.",
        "Bench 0 comes within 0.3 m of 'van' at -100.000000 s, and overlaps it by 1.039253 m.",
        "Handle 1 first exceeds 1.5 m/s at 14.129639 s; the highest speed is 1.604793 m/s, of handle 3 at 14.479970 s.",
        "Benches 0 and 16 come within 0.3 m at 29.940099 s, with a gap of 0.300000 m."]),
}  # fmt: skip


@pytest.mark.parametrize("name", VERDICTS)
def test_all_failures_are_named_in_order_of_time_also_by_a_quick_check(name):
    dance, query, sentences = VERDICTS[name]
    report = check(dance, **query)
    quick = quick_check(dance, **query)
    for failure, words in zip(report.failures, sentences, strict=True):
        assert failure.message.startswith(words)
    times = [failure.time for failure in report.failures]
    assert times == sorted(times)
    undecided = any(failure.kind is FailureKind.UNDECIDED for failure in report.failures)
    judgement = Judgement.UNDECIDED if undecided else Judgement.FAILS if sentences else Judgement.PASSES
    assert report.verdict == judgement
    assert report.passed == (not sentences)
    assert quick.failures == report.failures
    assert quick.verdict == report.verdict
    assert (quick.start, quick.stop, quick.sharpest_bend) == (report.start, report.stop, None)
    assert not quick.venue or {area.nearest for area in quick.venue.areas} == {None}


def test_each_part_is_what_its_own_search_says():
    span = {"start": -40.0, "stop": 40.0}
    dance = Dance(Dragon(), TURN, 1.3)
    report = check(dance, venue=SQUARE, margin=0.3, **span)
    assert report.first_contact == first_contact(dance, margin=0.3, **span)
    assert report.least_clearance == least_clearance(dance, **span)
    assert report.venue == venue_clearance(dance, SQUARE, margin=0.3, **span)
    assert report.highest_speed == highest_speed(dance, **span)
    assert report.sharpest_bend == sharpest_bend(dance, **span)


def test_a_dance_is_judged_up_to_the_touch():
    report = check(DEFAULT, venue=SQUARE, speed_limit=2.0)
    contact = first_contact(DEFAULT)
    (failure,) = report.failures
    assert (report.stop, failure.time, failure.benches) == (contact.time, contact.time, contact.benches)
    assert report.least_clearance.distance == 0.0
    assert report.sharpest_bend.time <= report.stop
    assert 0.0 < check(TIGHT).stop < 0.01


@pytest.mark.parametrize("benches", [1, 2])
def test_so_few_benches_cannot_touch(benches):
    report = check(Dance(Dragon(benches), TURN), start=-10.0, stop=20.0, venue=SQUARE)
    assert (report.passed, report.least_clearance, report.venue is None) == (True, None, False)
    assert (report.sharpest_bend is None) == (benches == 1)


def test_at_the_maximum_head_speed_the_limit_is_kept_and_just_above_it_is_not():
    fastest = maximum_head_speed(Dance(Dragon(30), TURN), 2.0, start=-20.0, stop=40.0).head_speed
    for speed, passed in ((fastest, True), (fastest * (1.0 + 1e-9), False)):
        dance = Dance(Dragon(30), TURN, speed)
        assert check(dance, speed_limit=2.0, start=-20.0 / speed, stop=40.0 / speed).passed is passed

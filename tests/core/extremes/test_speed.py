"""The highest speed and the largest head speed: reference, dense samples, nearly equal peaks, and what is left out."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import core.extremes.speed
from core import (
    Arc,
    Coil,
    Dance,
    Dragon,
    EndReason,
    InvalidValue,
    Legs,
    Line,
    Passage,
    Route,
    Spiral,
    Turn,
    Waypoints,
    first_excess,
    highest_speed,
    maximum_head_speed,
    trajectory,
)
from core.extremes.speed import RATE_TOLERANCE
from tests.support.random_dances import unlike_dance
from tests.support.reference import reference
from tests.support.refused import refused
from tests.support.searches import search_on

SPEED = reference("maximum_head_speed")
REFERENCE_ERROR = 1e-9  # [m/s] and [s]
ROUNDING = 1e-12  # of a speed ratio, relative [1]
TURN = Turn(1.7)


def sampled(dance, times):
    """The highest speed seen at these times."""
    return float(trajectory(dance, times).speed.max())


def assert_highest(dance, times, **span):
    """The highest speed in a span [s]: no sample is faster than is proven, and there each handle has that speed."""
    result = highest_speed(dance, **span)
    speed, proven = result.speed_bracket
    assert result.speed == speed
    assert proven is None or sampled(dance, times) <= proven * (1.0 + ROUNDING)
    at_peak = trajectory(dance, [result.time]).speed[0]
    assert at_peak[list(result.handles)] == pytest.approx(speed, rel=ROUNDING)
    assert at_peak.max() == pytest.approx(speed, rel=ROUNDING)
    return result


@pytest.mark.uncompiled
def test_the_turn_has_the_reference_speed_proven_from_both_sides():
    result = maximum_head_speed(Dance(Dragon(), TURN), SPEED["speed_limit"], start=-100.0, stop=100.0)
    for name in ("head_speed", "speed_ratio", "time_at_unit_head_speed"):
        assert getattr(result, name) == pytest.approx(SPEED[name], abs=REFERENCE_ERROR), name
    assert set(result.handles) == set(SPEED["handles_exactly_tied"])
    low, high = result.head_speed_bracket
    assert low <= result.head_speed <= high <= low + 2.0 * RATE_TOLERANCE


@settings(max_examples=25, deadline=None)
@given(
    st.floats(0.6, 3.0),
    st.floats(0.6, 3.0),
    st.floats(1.0, 2.5),
    st.floats(3.0, 6.0),
    st.floats(0.5, 3.0),
    st.integers(2, 40),
)
def test_no_dense_sample_is_faster(head, body, pitch, radius, ratio, benches):
    try:
        dance = Dance(Dragon(benches, head, body, overhang=0.0), Turn(pitch, radius, ratio))
        highest_speed(dance, start=-40.0, stop=60.0)
    except InvalidValue:
        return  # the smaller arc is too tight for a chord
    assert_highest(dance, np.linspace(-40.0, 60.0, 4_001), start=-40.0, stop=60.0)


def test_benches_that_follow_calmly_change_nothing():
    path = Turn(1.7, start_turns=40.0)
    few, many = (highest_speed(Dance(Dragon(benches), path), start=-60.0, stop=80.0) for benches in (60, 2_000))
    assert few.speed == many.speed
    assert few.handles == many.handles


@pytest.mark.parametrize(
    "path, start, stop",
    [
        (Route([Line((-60, 0), (0, 0)), Arc((0, 4), 4.0, -np.pi / 2, 2.0)], start=60.0), 0.0, 8.0),
        (Route([Arc((0, -5), 5.0, 4.0, np.pi / 2 - 4.0), Line((0, 0), (30, 0))], start=10.0), 5.0, 25.0),
        (Route([Coil(1.5, 9.0, 3.0)]), 10.0, 200.0),
        (Route([Waypoints(((0, 0), (15, 0), (25, 8), (35, 0), (50, 0)))]), 25.0, 45.0),
    ],
    ids=["line, arc", "arc, line", "coil inwards", "waypoints"],
)
def test_on_every_kind_of_piece_dense_samples_come_up_to_the_highest(path, start, stop):
    dance = Dance(Dragon(8), path)
    times = np.linspace(start, stop, 20_001)
    result = assert_highest(dance, times, start=start, stop=stop)
    assert result.speed - sampled(dance, times) < 1e-3
    assert result.speed_bracket[1] - result.speed < 1e-6


# Most intervals in which a peak is proven [1]; most links that a search follows, see LINKS_BUDGET; and the least number
# of links for which an interval counts [1].
FEW = 5_000
LINKS_MOST = 12 * core.extremes.speed.LINKS_BUDGET
INTERVAL_LINKS = 20
# A sample may exceed the highest speed found by what its proof leaves open [1].
UNSEEN = 1e-6


def intervals_of(dance, stop):
    """Number of intervals in the proof of the highest speed, the head at 1 m/s."""
    search = search_on(dance.dragon, dance.path)
    search.resize(dance.dragon.benches)
    return core.extremes.speed.peak_over(search, 0.0, stop).intervals


# The rear handle turns back before its bench could fold, and is 3.7 times as fast as the head on its way outwards: the
# peak is so sharp, and so near the centre, that a slope alone bounded it by nothing in a hundred thousand intervals.
@pytest.mark.parametrize("benches, pitch", [(1, 3.82), (4, 3.9), (2, 4.2)])
def test_a_peak_beside_the_centre_is_proven_in_few_intervals(benches, pitch):
    dance = Dance(Dragon(benches, 2.2, 2.2, 0.3, 0.0), Spiral(pitch, 5.0))
    end = dance.end.time
    assert dance.end.reason is EndReason.CENTRE
    assert intervals_of(dance, end) < FEW
    before = np.concatenate([np.linspace(0.0, 2.0, 20_001), np.geomspace(1e-9, 2.0, 5_001)])
    speed, proven = assert_highest(dance, end - before).speed_bracket
    assert proven - speed <= 1.1 * RATE_TOLERANCE


@pytest.mark.parametrize("seed", range(12))
def test_the_work_of_a_search_is_bounded_and_its_bracket_true(seed):
    rng = np.random.default_rng(seed)
    dance = unlike_dance(rng)
    stop = dance.end.time * (1.0 - (dance.end.reason is EndReason.FOLD) * 10 ** rng.uniform(-6.0, -2.0))
    assert INTERVAL_LINKS * intervals_of(dance, stop) < LINKS_MOST
    times = stop * (1.0 - np.concatenate([np.linspace(0.0, 1.0, 5_001), np.geomspace(1e-9, 1.0, 2_001)]))
    assert sampled(dance, times) <= assert_highest(dance, times, stop=stop).speed * (1.0 + UNSEEN)


@pytest.mark.parametrize("then, excess", [(5.0, 12.0), (0.0, None)], ids=["too fast after it", "a pause"])
def test_a_proof_given_up_before_another_passage_is_unknown_for_the_whole_dance(monkeypatch, then, excess):
    """The bracket of an excess begins where the proof was given up, and ends with an excess or the interval."""
    for name in ("LINKS_BUDGET", "EXCESS_LINKS"):
        monkeypatch.setattr(core.extremes.speed, name, 20)
    dance = Dance(Dragon(10), TURN, passages=[Passage(1.0, until_time=12.0), Passage(then, until_time=15.0)])
    if not then:
        assert highest_speed(dance, start=0.0, stop=15.0).speed_bracket[1] is None
        assert maximum_head_speed(dance.steady, 2.0, stop=15.0).head_speed_bracket[0] is None
    result = first_excess(dance, 2.0, start=0.0, stop=15.0)
    proven, until = result.time_bracket
    assert 0.0 < proven < 12.0
    assert result.time == excess
    assert until == (excess or 15.0)


def test_a_run_to_a_fold_without_a_stop_asks_for_one():
    with refused("stop"):
        highest_speed(Dance(Dragon(), Spiral()))


@pytest.mark.thorough
def test_near_a_fold_there_is_always_a_handle_that_reaches_the_highest_speed():
    """There two chains of the same instant differ by more than what counts as equal."""
    dance = Dance(Dragon(1, 900.0, 900.0, 20.0, 0.0), Spiral(300.0, 40.0))
    assert highest_speed(dance, stop=1506595.0796309002).handles == (1,)


def test_a_handle_that_becomes_too_fast_at_a_corner_does_so_when_the_head_passes_it():
    points = np.cumsum([0.0, *([10.0, 1.3, 16.0] * np.exp(1j * np.radians([-40.0, 45.0, 0.0])))])
    path = Legs([(one.real, one.imag) for one in points.tolist()], [0, 1, 2], radius=0.0)
    excess = first_excess(Dance(Dragon(1, 2.4, 2.4, 0.3, 0.2), path), 1.2)
    assert (excess.time, excess.handle) == (pytest.approx(11.3, abs=1e-6), 1)
    assert excess.time_bracket == pytest.approx((11.3, 11.3), abs=1e-6)

"""Tolerance: brackets around known values, a shown contact above, no contact in a million poses below."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import (
    Area,
    Budget,
    Dance,
    Dragon,
    Line,
    Route,
    Spiral,
    TooMuchWork,
    Turn,
    Venue,
    bench_outlines,
    first_contact,
    tolerance,
    trajectory,
)
from core.sampling import bisected
from core.tolerance.tolerance import Limit, Tolerance
from tests.core.tolerance.adversaries import CIRCLE, seek, to_circle

# Largest width of a bracket, as a part of its proven end [1].
BRACKET = 2e-3
WIDE_SPIRAL = 6e-3  # the same of 40 benches with strays of 38 cm [1]
FAR = 0.6  # strays at which a chain bends visibly [m]
CHORD_ERROR = 1e-12  # [m]
# pitch [m], a bound by hand and a contact found by hand [m], both sampled in time and rounded to 1e-5.
KNOWN = [(0.5, 0.02321, 0.02325), (0.55, 0.04654, 0.04668), (0.7, 0.11662, 0.11749), (1.0, 0.24298, 0.26305)]
ROUNDED = 2e-5
# By the simple bound at these pitches [m], and by how much less of it the hulls may know [1].
SIMPLE = {0.5: 0.01931, 0.55: 0.03874, 0.7: 0.09735, 1.0: 0.21590}
SIMPLE_SHORT = 1e-3


@pytest.fixture(scope="module")
def default() -> Tolerance:
    dance, stop = to_circle(0.55)
    return tolerance(dance, stop=stop)


@pytest.mark.parametrize(("pitch", "bound", "contact"), KNOWN, ids=[f"{known[0]} m" for known in KNOWN])
def test_brackets_lie_between_the_bounds_and_the_contacts_known(pitch: float, bound: float, contact: float) -> None:
    dance, stop = to_circle(pitch)
    found = tolerance(dance, stop=stop)
    safe, shown = found.stray_bracket
    assert shown is not None
    assert bound - ROUNDED < safe < shown < contact + ROUNDED
    assert shown < safe * (1.0 + BRACKET)
    assert found.limited_by is Limit.BENCHES
    assert found.independent == safe
    assert SIMPLE[pitch] * (1.0 - SIMPLE_SHORT) < found.simple < SIMPLE[pitch] + ROUNDED


def test_the_pose_that_is_shown_overlaps_little_also_where_the_first_one_tried_does_not() -> None:
    found = tolerance(Dance(Dragon(40, 2.6, 2.4, 0.2, 0.2), Spiral(1.1, start_turns=10)), stop=40.0)
    shown = found.stray_bracket[1]
    assert shown is not None
    assert shown < found.stray * (1.0 + WIDE_SPIRAL)


def test_the_benches_between_two_that_stray_far_stray_no_further() -> None:
    found = tolerance(Dance(Dragon(36, 3.6, 1.95, 0.2, 0.06), Spiral(1.08, start_turns=10)), stop=22.0)
    shown = found.stray_bracket[1]
    assert shown is not None
    assert found.stray > FAR
    assert shown < found.stray * (1.0 + BRACKET)


def test_the_shown_contact_is_one(default: Tolerance) -> None:
    dance, _ = to_circle(0.55)
    shown = default.exhibit
    assert shown is not None
    assert shown.benches == default.benches == (0, 19)
    nominal = trajectory(dance, shown.time).position
    assert np.hypot(*(shown.handles - nominal).T).max() == shown.stray == default.stray_bracket[1]
    chords = np.hypot(*np.diff(shown.handles, axis=0).T)
    assert np.abs(chords - dance.dragon.chords).max() < CHORD_ERROR
    a, b = (shapely.Polygon(bench_outlines(dance.dragon, shown.handles)[k]) for k in shown.benches)
    assert a.intersection(b).area > 0.0


def test_none_of_a_million_poses_that_seek_contact_find_it(default: Tolerance) -> None:
    sought = seek(to_circle(0.55)[0], default)
    assert sought.poses >= 1_000_000
    # of twice the stray and more in the nominal places: the search does come near
    assert 0.0 < sought.nearest < 0.005 * default.stray


def test_the_same_search_finds_contacts_with_strays_beyond_the_bracket(default: Tolerance) -> None:
    assert seek(to_circle(0.55)[0], default, part=1.002, draws=2_000).nearest < 0.0


def test_all_lengths_times_k_make_the_answer_k_times_as_large(default: Tolerance) -> None:
    _dance, stop = to_circle(0.55)
    dragon = Dragon(223, 6.82, 4.40, 0.60, 0.55)
    found = tolerance(Dance(dragon, Spiral(1.1), 2.0), stop=stop)
    assert found.stray == pytest.approx(2.0 * default.stray, rel=1e-5)


def test_speed_changes_when_but_not_how_far(default: Tolerance) -> None:
    dance, stop = to_circle(0.55)
    assert default.time is not None
    faster = tolerance(Dance(dance.dragon, dance.path, 4.0), stop=stop / 4.0)
    assert faster.stray == pytest.approx(default.stray, rel=1e-6)
    assert faster.time == pytest.approx(default.time / 4.0, rel=1e-6)


def test_a_dance_that_touches_as_it_is_allows_none() -> None:
    dance = Dance(Dragon(), Spiral())
    found = tolerance(dance)
    assert found.stray == 0.0
    assert found.stray_bracket[1] is not None
    assert found.stray_bracket[1] < 1e-6
    assert found.time == pytest.approx(first_contact(dance).time, abs=1e-8)
    assert found.benches == (0, 8)


def test_a_run_to_its_fold_has_its_tolerance_too() -> None:
    found = tolerance(Dance(Dragon(benches=60), Spiral(0.9)))
    safe, shown = found.stray_bracket
    assert shown is not None
    assert 0.05 < safe < shown < safe * (1.0 + BRACKET)


def test_benches_of_many_sizes_on_a_route() -> None:
    dragon = Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 8, [0.3, 0.5] * 20, [0.2] * 40)
    found = tolerance(Dance(dragon, Turn(1.7)), stop=60.0)
    safe, shown = found.stray_bracket
    assert shown is not None
    assert 0.01 < safe < shown < safe * (1.0 + BRACKET)


def test_benches_next_but_one_to_each_other_are_held_apart_by_the_one_between() -> None:
    dance = Dance(Dragon(20), Route([Line((0.0, 0.0), (80.0, 0.0))]))
    found = tolerance(dance)
    assert found.limited_by is Limit.CHORD
    assert found.stray == 0.5 * dance.dragon.chords.min()
    assert found.independent == pytest.approx(0.5 * (1.65 - 2.0 * 0.275), rel=0.05)
    assert "are held apart by it" in found.certificate.method


def test_on_a_wide_spiral_the_next_turn_limits_the_stray_and_not_the_next_bench_but_one() -> None:
    dance = Dance(Dragon(60), Spiral(2.0))
    found = tolerance(dance, stop=dance.path.travel_to(CIRCLE))
    safe, shown = found.stray_bracket
    assert shown is not None
    assert found.benches is not None
    assert found.benches[1] is not None
    assert found.benches[1] - found.benches[0] > 2
    assert found.independent < safe < shown < 1.03 * safe


@pytest.mark.parametrize("width", [0.5, 0.4])
def test_where_benches_next_but_one_limit_the_stray_a_pose_of_all_three_shows_a_contact(width: float) -> None:
    """Short chords and wide benches: a small bend of all three is enough."""
    dragon = Dragon(20, body_length=1.2, width=width)
    found = tolerance(Dance(dragon, Route([Line((0.0, 0.0), (50.0, 0.0))])))
    safe, shown = found.stray_bracket
    assert shown is not None
    assert found.exhibit is not None
    a, b = found.exhibit.benches
    assert b == a + 2
    assert "are held apart by it" in found.certificate.method
    assert 1.5 * found.independent < safe < shown < 1.06 * safe
    chords = np.hypot(*np.diff(found.exhibit.handles, axis=0).T)
    assert np.abs(chords - dragon.chords).max() < CHORD_ERROR
    rows = [shapely.Polygon(bench_outlines(dragon, found.exhibit.handles)[k]) for k in (a, b)]
    assert rows[0].intersection(rows[1]).area > 0.0


def test_the_pose_is_of_those_three_in_a_row_that_fold_with_the_least_strays() -> None:
    """The head and bench 2 come first where benches are taken to be independent, but fold with 10 cm only."""
    dance = Dance(Dragon(20, body_length=1.2, width=0.5), Spiral(5.0))
    found = tolerance(dance, stop=dance.path.travel_to(20.0))
    safe, shown = found.stray_bracket
    assert shown is not None
    assert found.exhibit is not None
    assert found.benches == found.exhibit.benches == (1, 3)
    assert 0.06 < safe < shown < 1.03 * safe


def test_two_benches_on_a_line_have_nothing_to_touch() -> None:
    found = tolerance(Dance(Dragon(benches=2), Route([Line((0.0, 0.0), (30.0, 0.0))])), start=5.0)
    assert found.limited_by is Limit.CHORD
    assert found.stray == pytest.approx(0.825, abs=1e-12)
    assert found.stray_bracket == (found.stray, None)
    assert found.benches is found.time is found.exhibit is None


def test_a_bench_that_passes_a_wall_may_stray_to_it() -> None:
    """Between its holes a side moves by the stray, its corner by A: towards a long wall the corner counts."""
    dragon = Dragon(benches=1)
    wall = Area("wall", [[(0.0, 0.5), (40.0, 0.5), (40.0, 1.0), (0.0, 1.0), (0.0, 0.5)]])
    square = Area("square", [[(-20.0, -20.0), (60.0, -20.0), (60.0, 20.0), (-20.0, 20.0), (-20.0, -20.0)]])
    line = Route([Line((0.0, 0.0), (30.0, 0.0))])
    found = tolerance(Dance(dragon, line), Venue(square, [wall]), start=5.0, stop=25.0)
    stray = bisected(lambda stray: corner_reach(stray) >= 0.5, 0.0, 1.0, width=1e-9)[1]
    assert found.limited_by is Limit.VENUE
    assert found.area == "wall"
    safe, shown = found.stray_bracket
    assert shown is not None
    assert safe <= stray <= shown + 1e-6
    assert shown < safe * (1.0 + BRACKET)


def corner_reach(stray: float) -> float:
    """How far to the left the front left corner of a default head can come, by the places of its holes [m].

    Where the bench is turned by phi the rear hole strays by w more than the front one, so the front hole is in two
    discs; its furthest place to the left is the top of one of them, or where they cross.
    """
    chord, phi = 2.86, np.linspace(0.0, 2.0 * math.asin(stray / 2.86), 200_001)
    w = chord * (1.0 - np.exp(1j * phi))
    top, other = 1j * stray, 1j * stray - w
    half = np.sqrt(np.maximum(stray**2 - 0.25 * np.abs(w) ** 2, 0.0))
    crossing = -0.5 * w + half * 1j * np.exp(1j * np.angle(w))
    mirrored = -0.5 * w - (crossing + 0.5 * w)
    left = np.maximum(crossing.imag, mirrored.imag)
    left = np.where(np.abs(top + w) <= stray, stray, left)
    left = np.where(np.abs(other) <= stray, np.maximum(left, other.imag), left)
    return float((left + (np.exp(1j * phi) * (0.275 + 0.15j)).imag).max())


def test_a_budget_that_is_spent_ends_the_question() -> None:
    dance, stop = to_circle(0.55)
    with pytest.raises(TooMuchWork, match="how far people may stray was not found"):
        tolerance(dance, stop=stop, budget=Budget(1000.0))


def test_where_benches_touch_as_they_are_nothing_is_called_safe() -> None:
    dance, stop = to_circle(0.42)
    found = tolerance(dance, stop=stop)
    assert (found.stray, found.time) == (0.0, pytest.approx(first_contact(dance).time, abs=1e-6))
    assert "no stray is known to be safe: a bench touches another as it is." in found.certificate.method
    assert repr(found).startswith("<Tolerance: no stray is known to be safe")

"""Places of handles along the path, and times at which they pass a place."""

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Line, Route, Spiral, Turn, trajectory
from core.motion.places import ROWS_MAX, STEP, Passing, handle_places
from core.passages import Passage
from tests.support.near import assert_near

# Rounding of places along a path [m], and how well a passing time is known [m of travel].
PLACE_ROUNDING = 1e-11
PASSED = 0.01
DANCES = {
    "spiral": Dance(Dragon(30), Spiral()),
    "spiral elsewhere, counter-clockwise": Dance(Dragon(12), Spiral(0.9, 8, (5.0, -2.0), 1.0, False)),
    "turn": Dance(Dragon(30), Turn(1.7, 4.5)),
}


def assert_passed(dance, passing, places):
    """Each of these handles is at its arc length when it is said to pass that."""
    for handle, s in places:
        assert_near(handle_places(dance, [passing.when(handle, s)])[0, handle], s, PASSED)


@pytest.mark.parametrize("dance", DANCES.values(), ids=DANCES)
def test_handles_are_at_their_places_on_the_path(dance):
    times = np.array([0.0, 7.5, 30.0])
    result = dance.path.position(handle_places(dance, times))
    assert_near(result, trajectory(dance, times).position, PLACE_ROUNDING)


def test_a_handle_passes_its_place_at_the_answered_time_and_waits_through_a_pause():
    dance = Dance(Dragon(20), Turn(1.7, 4.5), 2.0, [Passage(1.0, until_s=5.0), Passage(0.0, until_time=20.0)])
    passing = Passing(dance, 0.0, 40.0)
    assert_passed(dance, passing, ((0, 3.0), (0, 30.0), (7, 0.0), (20, -20.0)))
    assert [passing.when(0, s) for s in (4.999, 5.001)] == pytest.approx([4.999, 20.0005])
    assert passing.when(0, -1.0) is None
    assert passing.when(20, 30.0) is None


def test_on_a_long_way_through_a_stadium_places_are_as_good():
    # Twenty lanes of 100 m, with turns of 2 m between.
    pieces = []
    for k in range(20):
        (x, end), y = sorted((0.0, 100.0), reverse=k % 2 == 1), 4.0 * k
        pieces += [Line((x, y), (end, y)), Arc((end, y + 2.0), 2.0, -0.5 * np.pi, np.pi * (1 - k % 2 * 2))]
    dance = Dance(Dragon(24), Route(pieces, 45.0))
    assert dance.end.time > 4.0 * STEP * ROWS_MAX
    passing = Passing(dance, 0.0, dance.end.time)
    for handle in (1, 12, 24):
        there = 12.0 * (100.0 + 2.0 * np.pi) - 45.0
        assert_passed(dance, passing, ((handle, s) for s in there + np.arange(80.0, 110.0, 0.07)))

"""Places of handles along the path, and times at which they pass a place."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from core import Arc, Budget, Dance, Dragon, Line, Route, Spiral, TooMuchWork, Turn, trajectory
from core.motion.places import ROWS_MAX, STEP, Passing, handle_places
from core.passages import Passage

# Lanes of a stadium [m], twenty of them, with turns of 2 m between.
LANE, LANES, RADIUS = 100.0, 20, 2.0
# Rounding of places along a path [m], and how well a passing time is known [m of travel].
PLACE_ROUNDING, PASSED = 1e-11, 0.01
DANCES = {
    "spiral": Dance(Dragon(30), Spiral()),
    "spiral elsewhere, counter-clockwise": Dance(Dragon(12), Spiral(0.9, 8, (5.0, -2.0), 1.0, False)),
    "turn": Dance(Dragon(30), Turn(1.7, 4.5)),
}


@pytest.mark.parametrize("ask", [partial(handle_places, times=[0.0, 1.0]), partial(Passing, start=0.0, stop=9.0)])
def test_the_end_of_the_budget_is_reported(ask: Callable[..., object]) -> None:
    with pytest.raises(TooMuchWork, match="the places of the handles were not found within 1 steps of work"):
        ask(DANCES["turn"], budget=Budget(1.0))


@pytest.mark.parametrize("dance", DANCES.values(), ids=DANCES)
def test_handles_are_at_their_places_on_the_path(dance: Dance) -> None:
    times = np.array([0.0, 7.5, 30.0])
    result = dance.path.position(handle_places(dance, times))
    assert np.abs(result - trajectory(dance, times).position).max() < PLACE_ROUNDING


def test_a_handle_passes_its_place_at_the_answered_time_and_waits_through_a_pause() -> None:
    dance = Dance(Dragon(20), Turn(1.7, 4.5), 2.0, [Passage(1.0, until_s=5.0), Passage(0.0, until_time=20.0)])
    passing = Passing(dance, 0.0, 40.0)
    for handle, s in ((0, 3.0), (0, 30.0), (7, 0.0), (20, -20.0)):
        time = passing.when(handle, s)
        assert time is not None
        assert abs(handle_places(dance, [time])[0, handle] - s) < PASSED
    before, after = passing.when(0, 4.999), passing.when(0, 5.001)
    assert before == pytest.approx(4.999)
    assert after == pytest.approx(20.0005)
    assert passing.when(0, -1.0) is None
    assert passing.when(20, 30.0) is None


def test_on_a_long_way_through_a_stadium_places_are_as_good() -> None:
    pieces: list[Line | Arc] = []
    for k in range(LANES):
        ends, y = (0.0, LANE) if k % 2 == 0 else (LANE, 0.0), 2.0 * RADIUS * k
        pieces.append(Line((ends[0], y), (ends[1], y)))
        pieces.append(Arc((ends[1], y + RADIUS), RADIUS, -0.5 * np.pi, (1.0 if k % 2 == 0 else -1.0) * np.pi))
    dance = Dance(Dragon(24), Route(pieces, 45.0))
    assert dance.end.time > 4.0 * STEP * ROWS_MAX
    passing = Passing(dance, 0.0, dance.end.time)
    turn = LANE + np.pi * RADIUS
    for handle in (1, 12, 24):
        for s in np.arange(0.8 * LANE, 1.1 * LANE, 0.07) + 12.0 * turn - 45.0:
            time = passing.when(handle, s)
            assert time is not None
            assert abs(handle_places(dance, [time])[0, handle] - s) < PASSED

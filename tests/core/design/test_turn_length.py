"""Lengths between which the shortest turn is justifiable: what others found is between, what cannot be is not."""

import numpy as np
import pytest

from core import Budget, Dragon, TooMuchWork, Turn, shortest_turn, turn_length_bounds
from tests.core.design.test_shortest_turn import compared
from tests.support.depth import further
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

GRID = 0.1  # [m]
# Lengths that others found [m].
FOUND = {2.0: (11.7915, 11.8105, 11.8336, 12.9494379, 13.6212449)}


@pytest.mark.parametrize("ratio", further([2.0, 1.5, 1.1], 1))
def test_every_turn_on_a_grid_that_is_shorter_than_the_lower_bound_has_a_contact(ratio):
    """No bend is tighter than half the chord of the contest's head; benches with shorter heads can follow it."""
    low, high = turn_length_bounds(Dragon(), 1.7, ratio=ratio)
    assert high == Turn(1.7, ratio=ratio).length
    assert [length for length in FOUND.get(ratio, ()) if not low <= length <= high + 5e-8] == []
    radii = np.arange(1.3, 4.5 + 1e-12, GRID).tolist()
    turns = [(ratio, entry, leaving) for entry in radii for leaving in radii]
    shorter, longer = compared(low, turns, Dragon(60, 2.2), 1.43)
    assert longer
    assert bool(shorter) is (ratio < 1.3)
    assert low <= shortest_turn(Dragon(), 1.7, ratio=ratio).turn.length <= low + 0.05


def test_a_circle_in_which_no_length_is_proven_is_named():
    with refused("turning_radius", TooMuchWork):
        turn_length_bounds(Dragon(), 1.7, budget=Budget(1.0))

"""Lengths between which the shortest turn is justifiable: what others found is between, what cannot be is not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Dance, Dragon, Turn, first_contact, shortest_turn, turn_length_bounds
from core.design.turn_boxes import sizes_of
from tests.support.boxes_of_turns import GROWTH
from tests.support.further import further
from tests.support.refused import refused

TIGHTEST = 1.43  # [m], half the chord of the contest's head
GRID = 0.004  # [m]
# Lengths that others found [m].
FOUND = {2.0: (11.7915, 11.8105, 11.8336, 12.9494379, 13.6212449)}


@pytest.mark.uncompiled
@pytest.mark.parametrize("ratio", further([2.0, 1.5, 1.1], 1))
def test_every_turn_on_a_grid_that_is_shorter_than_the_lower_bound_has_a_contact(ratio: float) -> None:
    low, high = turn_length_bounds(Dragon(), 1.7, ratio=ratio)
    assert high == Turn(1.7, ratio=ratio).length
    assert [length for length in FOUND.get(ratio, ()) if not low <= length <= high + 5e-8] == []
    entry, leaving = (axis.ravel() for axis in np.meshgrid(*[np.arange(1.3, 4.5 + 1e-12, GRID)] * 2))
    sizes = sizes_of(GROWTH, entry, (leaving - entry) / GROWTH, np.full(entry.size, math.log(ratio)))
    lengths = np.where(sizes[:2].min(axis=0) >= TIGHTEST, sizes[4], np.inf)
    if ratio > 1.3:  # no contact is shorter
        assert low <= lengths.min() <= low + 15.0 * GRID
        return
    for k in np.random.default_rng(2).choice(np.flatnonzero(lengths < low), 40):
        turn = Turn(1.7, 30.0, ratio, start_turns=30.0, entry_radius=float(entry[k]), exit_radius=float(leaving[k]))
        assert first_contact(Dance(Dragon(60, 2.2), turn), start=0.0, stop=60.0).time is not None
    assert low <= shortest_turn(Dragon(), 1.7, ratio=ratio).turn.length <= low + 0.05


@pytest.mark.uncompiled
def test_a_turn_too_tight_for_any_arc_is_refused() -> None:
    with refused("turning_radius"):
        turn_length_bounds(Dragon(), 1e-3, 1e-3)

"""Turns in boxes: every turn of a box has its sizes within the box's, and is not shorter than its lower bounds."""

import math

import numpy as np
import pytest

from core import Turn
from core.design.turn_bounds import Multipliers, lower_lengths
from core.design.turn_boxes import sizes_of, too_tight, turns_in
from tests.support.boxes_of_turns import GROWTH, LEAST, place_in
from tests.support.near import assert_near

pytestmark = pytest.mark.uncompiled

BOXES = 1_500
PLACES = 30
ROUNDED = 1e-9  # [m], [rad]


def boxes(rng, largest):
    middles = [rng.uniform(1.5, 4.5, BOXES), rng.uniform(-6.0, 6.0, BOXES), rng.uniform(-0.6, 0.8, BOXES)]
    centres = np.array(middles)
    halves = rng.uniform(0.0, largest, (3, BOXES))
    inside = centres[0] + GROWTH * centres[1] > 1.2
    return centres[:, inside], halves[:, inside]


@pytest.mark.parametrize("ratio, entry, leaving", [(2.0, 4.3, 4.5), (0.8, 4.3, 3.83), (1.3, 2.3, 4.4)])
def test_the_sizes_are_those_of_the_turn(ratio, entry, leaving):
    turn = Turn(1.7, 9.0, ratio, entry_radius=entry, exit_radius=leaving)
    result = sizes_of(GROWTH, *np.array([[entry], [(leaving - entry) / GROWTH], [math.log(ratio)]]))[:, 0]
    assert_near(result, [*turn.radii, *turn.angles, turn.length, leaving], ROUNDED)


@pytest.mark.parametrize("largest", [0.002, 0.05, 0.3])
def test_every_turn_of_a_box_is_within_its_spans_and_above_its_bounds(largest):
    rng = np.random.default_rng(3)
    centres, halves = boxes(rng, largest)
    turns = turns_in(GROWTH, centres, halves)
    every = np.ones(centres.shape[1], dtype=bool)
    lows = lower_lengths(turns)
    of_followed = lower_lengths(turns, LEAST)
    weighted = Multipliers(GROWTH, LEAST, 4.5, np.array([2.0, 5.0, 0.3, 0.1])).lower(turns, centres, halves)
    spans = (*turns.radii, *turns.angles, turns.length, turns.exit)
    holds = (every, every, turns.whole, turns.whole, turns.whole, every)
    for _ in range(PLACES):
        at = place_in(centres, halves, rng)
        sizes = sizes_of(GROWTH, *at)
        for span, size, counts in zip(spans, sizes, holds, strict=True):
            assert not (counts & ((size < span.low - ROUNDED) | (size > span.high + ROUNDED))).any()
        follows = sizes[:2].min(axis=0) >= LEAST
        inside = np.maximum(at[0], sizes[5]) <= 4.5
        for bound, counts in ((lows, every), (of_followed, follows), (weighted, follows & inside)):
            assert (sizes[4] >= bound - ROUNDED)[counts].all()
    assert turns.whole.mean() > 0.05


@pytest.mark.parametrize("largest, missed", [(1e-9, 0.0), (0.01, 0.03), (0.1, 0.3)])
def test_boxes_that_are_too_tight_have_no_turn_that_benches_can_follow(largest, missed):
    """A box is called so where all its turns are, apart from some that are nearly wide enough; also at ratios so far
    from 1 that the radii alone say nothing."""
    rng = np.random.default_rng(8)
    centres, halves = boxes(rng, largest)
    centres[2] *= 7.0
    tight = too_tight(GROWTH, centres, halves, LEAST)
    followed = np.zeros(centres.shape[1], dtype=bool)
    for _ in range(PLACES):
        radii = sizes_of(GROWTH, *place_in(centres, halves, rng))[:2]
        followed |= radii.min(axis=0) >= LEAST
    assert followed.sum() > 20
    assert not (tight & followed).any()
    assert (~tight & ~followed).mean() <= missed

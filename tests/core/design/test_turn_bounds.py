"""Boxes of turns in a branch and bound: their lower bounds and their division."""

import math

import numpy as np
import pytest

from core.design.turn_bounds import Boxes, divided, joined, multipliers_at
from core.design.turn_boxes import sizes_of, turns_in
from tests.core.design.test_turn_boxes import boxes
from tests.support.boxes_of_turns import GROWTH, LEAST
from tests.support.near import assert_near

pytestmark = pytest.mark.uncompiled


def test_multipliers_make_the_bound_good_to_the_second_order():
    """At the shortest turn of ratio 2 both the bend and the circle hold it, and a ten times smaller box is 100 times
    nearer."""
    entry, missing = 4.290395288338, []  # [m], where the second arc has the least radius
    point = np.array([entry, (4.5 - entry) / GROWTH, math.log(2.0)])
    known = multipliers_at(GROWTH, point, LEAST, 4.5, free=False)
    at = point[:, None]
    for half in (1e-2, 1e-3, 1e-4):
        halves = np.array([[half], [half], [0.0]])
        missing.append(sizes_of(GROWTH, *at)[4, 0] - known.lower(turns_in(GROWTH, at, halves), at, halves)[0])
    assert missing[0] > 50.0 * missing[1] > 2_500.0 * missing[2] > 0.0


def test_boxes_that_are_divided_or_joined_cover_the_same_turns():
    rng = np.random.default_rng(4)
    centres, halves = boxes(rng, 0.1)
    count = centres.shape[1]
    whole = Boxes(centres, halves, np.arange(count), rng.uniform(0.0, 9.0, count), rng.uniform(0.0, 1.0, (count, 5)))
    slope = rng.uniform(0.0, 9.0, (3, count))
    slope[0, 0] = np.nan
    parts = divided(whole, slope)
    assert parts.halves.prod(axis=0).sum() == pytest.approx(halves.prod(axis=0).sum())
    for sign in (-1.0, 1.0):
        ends = (parts.centres + sign * parts.halves).reshape(3, 2, count)
        assert_near((sign * ends).max(axis=1), sign * centres + halves, 1e-15)
    again = joined([whole.taken(slice(0, 7)), whole.taken(slice(7, None))])
    assert np.array_equal(again.centres, centres)

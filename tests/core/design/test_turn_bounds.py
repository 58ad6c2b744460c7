"""Boxes of turns in a branch and bound: their lower bounds and their division."""

import numpy as np
import pytest

from core.design.turn_bounds import Boxes, divided, joined
from tests.core.design.test_turn_boxes import boxes

pytestmark = pytest.mark.uncompiled


def test_boxes_that_are_divided_or_joined_cover_the_same_turns():
    rng = np.random.default_rng(4)
    centres, halves = boxes(rng, 0.1)
    count = centres.shape[1]
    whole = Boxes(centres, halves, np.arange(count), rng.uniform(0.0, 9.0, count))
    slope = rng.uniform(0.0, 9.0, (3, count))
    slope[0, 0] = np.nan
    parts = divided(whole, slope)
    assert parts.halves.prod(axis=0).sum() == pytest.approx(halves.prod(axis=0).sum())
    for sign in (-1.0, 1.0):
        ends = (parts.centres + sign * parts.halves).reshape(3, 2, count)
        assert (sign * ends).max(axis=1) == pytest.approx(sign * centres + halves, abs=1e-15)
    again = joined([whole.taken(slice(0, 7)), whole.taken(slice(7, None))])
    assert np.array_equal(again.centres, centres)

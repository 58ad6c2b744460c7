"""Places from which the search for the shortest turn begins: shorter than all their neighbours, and followed."""

import math

import numpy as np
import pytest

from core.design.turn_boxes import sizes_of
from core.design.turn_places import locally_shortest, starts
from tests.support.boxes_of_turns import GROWTH, LEAST
from tests.support.depth import further

pytestmark = pytest.mark.uncompiled

INNER, CIRCLE = 1.4, 4.5  # [m]
APART = 1e-3  # [m], of the neighbours
ROUNDED = 1e-9  # [m]


@pytest.mark.parametrize("ratio", further([2.0, 0.7, 1.3, 1.0], 2))
def test_a_polished_place_is_followed_and_no_neighbour_is_shorter(ratio):
    count = 0
    for start in starts(GROWTH, INNER, CIRCLE, ratio, LEAST):
        place = locally_shortest(GROWTH, start, INNER, CIRCLE, ratio, LEAST)
        if place is None:
            continue
        count += 1
        size = sizes_of(GROWTH, *place[:, None])[:, 0]
        assert min(size[:2]) >= LEAST
        assert INNER <= place[0] <= CIRCLE >= size[5] - ROUNDED
        around = np.linspace(0.0, 2.0 * math.pi, 90)
        entry = place[0] + APART * np.cos(around)
        leaving = size[5] + APART * np.sin(around)
        others = sizes_of(GROWTH, entry, (leaving - entry) / GROWTH, np.full(90, math.log(ratio)))
        fits = (others[:2].min(axis=0) >= LEAST) & (entry <= CIRCLE) & (leaving <= CIRCLE)
        assert (others[4][fits] >= size[4] - ROUNDED).all()
    assert count


def test_a_circle_too_small_for_any_coil_has_no_place():
    assert list(starts(GROWTH, 4.5, 4.5, 2.0, LEAST)) == []

"""Moves of a turn within a box: no point and no curvature differs by more than the bounds."""

import math

import numpy as np
import pytest

from core.design.turn_moves import apart_from_circle, bent, displaced
from tests.support.boxes_of_turns import CROSSING, SMALL, box_at, turns_drawn
from tests.support.depth import examples, further

pytestmark = pytest.mark.uncompiled

BESIDE = [(4.2, 4.3, 1.4), (4.29, 4.4, 2.0)]
SAMPLES = 400
STEP = 1e-4  # [m], of the sums of curvatures


def points(turn, s):
    """Points of a turn at places from M, in the frame that rotates with the entry."""
    x, y = turn.entry
    frame = np.array([[x, y], [-y, x]]) / math.hypot(x, y)
    return turn.position(s + turn.radii[0] * turn.angles[0]) @ frame.T


@pytest.mark.parametrize("place", [*CROSSING, *BESIDE])
@pytest.mark.parametrize("size", [0.2, 1.0, 4.0])
def test_points_at_one_place_are_no_further_apart_than_the_bound(place, size):
    box, centre = box_at(*place, size * SMALL)
    assert [box.entry, box.turned] == pytest.approx(size * SMALL[:2])  # the nominal turn is in the middle
    s = np.linspace(-25.0, 25.0, SAMPLES)
    nearest = 0.0
    most = np.array([displaced(box, at, at) for at in s.tolist()])
    for turn in turns_drawn(centre, size * SMALL, examples(20, 200), 0.3):
        moved = np.linalg.norm(points(turn, s) - points(box.nominal, s), axis=-1)
        assert (moved <= most + 1e-9).all()
        nearest = max(nearest, float((moved / most).max()))
    assert nearest > 0.1  # the bound is not far too wide


@pytest.mark.parametrize("place", further([CROSSING[0], CROSSING[3], *BESIDE], 1))
def test_curvatures_differ_by_no_more_than_the_bound(place):
    box, centre = box_at(*place, SMALL)
    nearest = 0.0
    for turn in turns_drawn(centre, SMALL, examples(4, 40), 1.0):
        for low in np.arange(-12.0, 12.0, 1.7).tolist():
            s = np.arange(low, low + 1.7, STEP)
            a, b = (one.curvature(s + one.radii[0] * one.angles[0]) for one in (turn, box.nominal))
            total = float(np.abs(a - b).sum()) * STEP
            most = 2.0 * bent(box, low, low + 1.7)
            assert total <= most + 3.0 * STEP  # a sum may count one sample of a jump too many
            nearest = max(nearest, total / most)
    assert nearest > 0.3


def test_arcs_far_outside_their_coils_are_not_refused():
    assert apart_from_circle(5.0, 2.0, 30.0, 3.0).length > 200.0

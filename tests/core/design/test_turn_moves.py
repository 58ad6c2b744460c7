"""Moves of a turn within a box: no point and no curvature differs by more than the bounds."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.design.turn_moves import bent, coil_bend, displaced
from core.paths.spiral import Spiral
from core.values import Floats
from tests.support.boxes_of_turns import CROSSING, SMALL, box_at, turn_at
from tests.support.depth import examples

BESIDE = [(4.2, 4.3, 1.4), (4.29, 4.4, 2.0)]
SAMPLES = 400
STEP = 1e-4  # [m], of the sums of curvatures


def points(turn: object, s: Floats) -> Floats:
    """Points of a turn at places from M, in the frame that rotates with the entry."""
    x, y = turn.entry  # type: ignore[attr-defined]
    frame = np.array([[x, y], [-y, x]]) / math.hypot(x, y)
    return turn.position(s + turn.radii[0] * turn.angles[0]) @ frame.T  # type: ignore[attr-defined]


@pytest.mark.uncompiled
@pytest.mark.parametrize(("entry", "leaving", "ratio"), [*CROSSING, *BESIDE])
@pytest.mark.parametrize("size", [0.2, 1.0, 4.0])
def test_points_at_one_place_are_no_further_apart_than_the_bound(
    entry: float, leaving: float, ratio: float, size: float
) -> None:
    half = size * SMALL
    box, centre = box_at(entry, leaving, ratio, half)
    if box is None:
        pytest.fail("benches can follow no corner of the box")
    s, rng, nearest = np.linspace(-25.0, 25.0, SAMPLES), np.random.default_rng(7), 0.0
    most = np.array([displaced(box, float(place), float(place)) for place in s])
    for _ in range(examples(20, 200)):
        turn = turn_at(centre + half * rng.choice([-1.0, 1.0], 3) * rng.uniform(0.3, 1.0, 3))
        if turn is not None:
            moved = np.linalg.norm(points(turn, s) - points(box.nominal, s), axis=-1)
            assert (moved <= most + 1e-9).all()
            nearest = max(nearest, float((moved / most).max()))
    assert nearest > 0.1  # the bound is not far too wide


@pytest.mark.uncompiled
@pytest.mark.parametrize(("entry", "leaving", "ratio"), [CROSSING[0], CROSSING[3], *BESIDE])
def test_curvatures_differ_by_no_more_than_the_bound(entry: float, leaving: float, ratio: float) -> None:
    box, centre = box_at(entry, leaving, ratio, SMALL)
    if box is None:
        pytest.fail("benches can follow no corner of the box")
    rng, nearest = np.random.default_rng(8), 0.0
    for _ in range(examples(4, 40)):
        turn = turn_at(centre + SMALL * rng.choice([-1.0, 1.0], 3))
        if turn is None:
            continue
        for low in np.arange(-12.0, 12.0, 1.7):
            s = np.arange(low, low + 1.7, STEP)
            curvatures = [one.curvature(s + one.radii[0] * one.angles[0]) for one in (turn, box.nominal)]
            total = float(np.abs(curvatures[0] - curvatures[1]).sum()) * STEP
            most = 2.0 * bent(box, float(low), float(low + 1.7))
            assert total <= most + 3.0 * STEP  # a sum may count one sample of a jump too many
            nearest = max(nearest, total / most)
    assert nearest > 0.3


@pytest.mark.uncompiled
def test_the_bend_of_a_coil_is_that_of_the_spiral() -> None:
    spiral = Spiral(1.7, 16.0)
    s = spiral.end - 40.0
    radius = float(np.hypot(*spiral.position(s)))
    assert coil_bend(1.7 / (2.0 * math.pi), radius) == pytest.approx(abs(float(spiral.curvature(s))), rel=1e-9)

"""The ground of a bench in balls: it holds all places, as tightly as the search's, and its sides keep others off."""

import cmath
import math

import numpy as np
import pytest
from flint import acb, arb, ctx

from core.proof.ground import AT_ONCE, ONE_BY_ONE, SIDES, WHOLE, BenchGround, PolygonSide
from core.shapes.reach import bench_hulls, directions, supports
from tests.support.near import assert_near

# Rounding of places and supports in doubles [m].
ROUNDING = 1e-11
SHAPES = [(1.65, 0.275, 0.3, 0.05), (2.86, 0.275, 0.3, 0.26), (1.65, 0.275, 0.3, 0.82), (1.0, 0.0, 0.2, 0.3)]
IDS = ["body", "head", "half a chord", "no overhang"]


def ground_of(chord, overhang, width, stray):
    half = arb(chord) / 2
    with ctx.workprec(96):
        return BenchGround(half, half + arb(overhang), arb(width) / 2, arb(stray))


@pytest.mark.parametrize("chord, overhang, width, stray", SHAPES, ids=IDS)
def test_two_derivations_of_the_ground_agree_and_hold_every_place(chord, overhang, width, stray):
    ground = ground_of(chord, overhang, width, stray)
    hulls = bench_hulls(supports(chord, overhang, 0.5 * width, stray))
    furthest = (hulls * directions()).sum(axis=-1)
    assert_near(ground.rough_supports[:WHOLE], furthest, ROUNDING)
    assert_near(ground.rough_corners[:WHOLE], hulls @ [1.0, 1.0j], ROUNDING)
    assert max(float(value.rad()) for row in ground.supports for value in row) < 1e-24
    # The polygon around both holds them, and so all places: tests/core/shapes/test_reach.py.
    assert (ground.rough_supports[WHOLE] >= furthest.max(axis=0) - ROUNDING).all()


@pytest.mark.parametrize("spread", [0.001, 0.05, 0.4, 2.0])
def test_corners_of_a_side_are_all_that_can_be_nearest_while_a_bench_turns(spread):
    ground = ground_of(1.65, 0.275, 0.3, 0.05)
    rng = np.random.default_rng(5)
    for number, hulls in [(3, AT_ONCE[0]), (40, ONE_BY_ONE[1]), (70, ONE_BY_ONE[3]), (100, ONE_BY_ONE[8])]:
        heading = rng.uniform(-math.pi, math.pi)
        side = PolygonSide(number, hulls, ground, ground)
        ends = [acb(cmath.rect(1.0, heading + off)) for off in (-spread, 0.0, spread)]
        corners = [complex(corner) for corner in side.corners(ends[0].union(ends[1]).union(ends[2]))]
        everyone = ground.rough_corners[hulls[0] if number >= SIDES else hulls[1]]
        for turn in np.linspace(-spread, spread, 21):
            axis = cmath.rect(1.0, heading + turn)
            nearest = min((axis * corner).real for corner in corners)
            assert_near(nearest, (axis * everyone).real.min(), ROUNDING)
        assert len(corners) <= 3 + 2.5 * spread * SIDES / math.tau or spread > 1.0

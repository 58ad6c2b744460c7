"""Figures: closed ones close, each is as long as its parts, and impossible sizes give none."""

import math
from functools import reduce

import numpy as np
import pytest

from core import Dragon, Figure, Route
from core.proposal.figures import DANCED, Shape, eight, ring, serpentine, shapes, tight_rings
from core.proposal.needs import Needs
from core.proposal.walks import moved
from tests.support.near import assert_near

NEEDS = Needs(Dragon(20), 0.05, 0.0)
CLOSED = [(Figure.RING, (8.0, 5.0, 3.0)), (Figure.EIGHT, (4.0, 1.4))]


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize("figure, sizes", CLOSED)
def test_a_closed_figure_ends_where_it_began(figure, sizes, mirror):
    shape = Shape(figure, sizes, mirror)
    pose = reduce(moved, shape.steps, shape.first)
    assert_near(pose[:2], shape.first[:2], 1e-9)
    assert_near(math.remainder(pose[2] - shape.first[2], math.tau), 0.0, 1e-9)
    assert_near(shape.around, Route(shape.pieces).end, 1e-9)


def test_impossible_sizes_give_no_figure():
    spiral = Shape(Figure.SPIRAL, (5.0, 6.0, 1.7)).pieces
    assert [ring(3.0, 2.0, 2.5), eight(4.0, 1.0), serpentine(3.0, 0.0, 2.0), spiral] == [None] * 4


# Least lengths that hold the dragon: on a lobe of an eight, on each coil of a spiral [m].
ROUND = NEEDS.length + NEEDS.gap
LEAST = {Figure.RING: ROUND, Figure.EIGHT: 2.0 * ROUND, Figure.SPIRAL: 2.0 * ROUND,
         Figure.SERPENTINE: (1.0 + DANCED) * NEEDS.length}  # fmt: skip


@pytest.mark.parametrize("gated", [False, True])
@pytest.mark.parametrize("figure", Figure)
def test_shapes_hold_the_dragon_and_bend_no_tighter_than_it_can(figure, gated):
    every = list(shapes(figure, NEEDS, 1e3, gated=gated))
    assert bool(every) == (figure is not Figure.PARADE)
    lengths = []
    extents = []
    for shape in every:
        route = Route(shape.pieces)
        assert route.sharpest[0] <= 1.0 / NEEDS.tight + 1e-9
        lengths.append(route.end - route.begin)
        extents.append(np.ptp(route.position(np.linspace(route.begin, route.end, 500)), axis=0).max())
    assert list(shapes(figure, NEEDS, 30.0, gated=gated)) == [
        shape for shape, extent in zip(every, extents, strict=True) if extent <= 30.0
    ]
    if figure in LEAST and (not gated or every[0].closed):
        assert 1.0 < min(lengths) / LEAST[figure] < 1.25


def test_tight_rings_hold_a_short_dragon_and_bend_no_tighter_than_it_can():
    needs = Needs(Dragon(4), 0.05, 0.0)
    every = [(shape, Route(shape.pieces)) for shape in tight_rings(needs, 20.0)]
    assert every[0][0].round
    assert min(route.end for _, route in every) >= needs.length + needs.gap
    bends = [route.sharpest[0] * needs.tight for _, route in every]
    assert_near(max(bends), 1.0, 2e-3)
    assert max(bends) <= 1.0
    assert list(tight_rings(Needs(Dragon(60), 0.05, 0.0), 20.0)) == []

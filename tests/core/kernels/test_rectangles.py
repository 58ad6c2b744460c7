"""Two benches of a chain: their gap, and what realises it. Any two rectangles: tests/core/shapes/test_rectangles.py."""

import pytest

from core import Dragon, Spiral
from core.kernels import bench_separation, gap_at
from tests.support.near import assert_near
from tests.support.searches import search_on

ROUNDING = 1e-13  # [m]


@pytest.mark.parametrize("travel", [0.0, 400.0, 412.5, 425.0])
def test_witnesses_lie_the_gap_apart_along_the_normal(travel):
    search = search_on(Dragon(40), Spiral())
    search.clearance(travel)
    for b in range(2, 40):
        met = bench_separation(0, b, search.sizes, search.placed)
        normal = complex(met.nx, met.ny)
        assert_near(abs(normal), 1.0, ROUNDING)
        assert_near(complex(met.bx - met.ax, met.by - met.ay), met.separation * normal, ROUNDING)
        gap = gap_at(search.scene, search.place - travel, 0, b, search.tried)
        assert_near(met.separation, gap, ROUNDING)

"""The clearance at an instant, against all pairs; rates against difference quotients."""

import pytest

from core import Dragon, Spiral, Turn
from core.kernels import gap_at, gap_rate_at
from tests.support.near import assert_near
from tests.support.searches import search_on

# Step of difference quotients [m], and the error that it leaves in a rate [1].
STEP = 1e-5
QUOTIENT = 1e-6
PATHS = pytest.mark.parametrize("path, travel", [(Spiral(), 395.0), (Turn(1.7), 20.0)], ids=["spiral", "turn"])


def gap(search, travel, pair):
    return gap_at(search.scene, search.place - travel, *pair, search.tried)


@PATHS
@pytest.mark.parametrize("pair", [(0, 9), (3, 13), (7, 20)])
def test_a_gap_changes_as_fast_as_said(path, travel, pair):
    search = search_on(Dragon(45), path)
    quotient = (gap(search, travel + STEP, pair) - gap(search, travel - STEP, pair)) / (2.0 * STEP)
    rate = gap_rate_at(search.scene, search.place - travel, *pair, search.tried)
    assert_near(rate, quotient, QUOTIENT)

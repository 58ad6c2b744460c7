"""Chains on curves of either kind: rates. Places: tests/core/test_rounding.py."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, Turn, trajectory
from core.kernels import place_chain
from core.kernels.constants import RATE
from tests.support.near import assert_near
from tests.support.searches import search_on

ROUNDING = 1e-11  # of rates [1]


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
@pytest.mark.parametrize("travel", [0.0, 11.0, 37.5])
def test_a_chain_moves_as_fast_as_the_trajectory_says(path, travel):
    search = search_on(Dragon(30), path)
    assert search.curve.is_spiral == isinstance(path, Spiral)
    assert place_chain(search.curve, search.place - travel, 30, search.sizes, search.placed) == 30
    speed = trajectory(Dance(Dragon(30), path), travel).speed
    assert_near(np.abs(search.placed[:31, RATE]), speed, ROUNDING)

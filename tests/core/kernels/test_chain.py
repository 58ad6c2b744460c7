"""Chains on curves of either kind."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, Route, Spiral, Turn, trajectory
from core.contact.search import ContactSearch
from core.kernels import place_chain
from core.kernels.constants import MX, MY, RATE

ROUNDING = 1e-11  # [m], and of rates [1]


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
@pytest.mark.parametrize("travel", [0.0, 11.0, 37.5])
def test_a_chain_stands_and_moves_as_the_trajectory_says(path: Spiral | Route, travel: float) -> None:
    search = ContactSearch(Dragon(30), path, 0.0)
    assert search.curve.is_spiral == isinstance(path, Spiral)
    assert place_chain(search.curve, search.place - travel, 30, search.sizes, search.placed) == 30
    there = trajectory(Dance(Dragon(30), path), travel)
    assert np.abs(search.placed[:31, RATE]) == pytest.approx(there.speed, abs=ROUNDING)
    handles, centres = there.position @ [1.0, 1.0j], search.placed[:30, [MX, MY]] @ [1.0, 1.0j]
    # The frame of a spiral's chain turns with its head: distances of neighbours stay.
    apart = np.abs(np.diff(0.5 * (handles[1:] + handles[:-1])))
    assert np.abs(np.diff(centres)) == pytest.approx(apart, abs=ROUNDING)

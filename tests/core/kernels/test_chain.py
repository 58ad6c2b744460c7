"""Chains on curves of either kind."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, Route, Spiral, Turn, kernels, trajectory
from core.contact.search import ContactSearch

ROUNDING = 1e-11  # [m], and of rates [1]


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
@pytest.mark.parametrize("travel", [0.0, 11.0, 37.5])
def test_a_chain_stands_and_moves_as_the_trajectory_says(path: Spiral | Route, travel: float) -> None:
    search = ContactSearch(Dragon(30), path, 0.0)
    chain = search.placed
    assert kernels.place_chain(search.curve, search.place - travel, 30, search.sizes, chain) == 30
    there = trajectory(Dance(Dragon(30), path), travel)
    assert np.abs(chain[:31, kernels.RATE]) == pytest.approx(there.speed, abs=ROUNDING)
    centres = 0.5 * (there.position[1:] + there.position[:-1])
    apart = np.linalg.norm(centres[1:] - centres[:-1], axis=1)  # the frame of a spiral's chain turns with its head
    middles = chain[:30, kernels.MX : kernels.MY + 1]
    assert np.linalg.norm(np.diff(middles, axis=0), axis=1) == pytest.approx(apart, abs=ROUNDING)


def test_curves_say_what_they_are() -> None:
    assert kernels.spiral_curve(0.2).is_spiral
    assert kernels.spiral_curve(0.2).growth == 0.2
    assert not kernels.route_curve(Turn(1.7).table).is_spiral

"""A march: its brackets, and the error of its travels to 50 digits."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb

from core import Dragon, Spiral
from core.contact.march import BRACKET, BRACKETS_GRAZING, TRAVEL_ROUNDING
from core.contact.search import ContactSearch
from tests.support.exact_chain import spiral_place


def test_wider_brackets_are_tried_one_after_the_other() -> None:
    assert (BRACKET, *BRACKETS_GRAZING) == tuple(sorted((BRACKET, *BRACKETS_GRAZING)))


@pytest.mark.parametrize("seed", range(4))
def test_no_travel_is_off_by_more_than_its_rounding(seed: int) -> None:
    rng = np.random.default_rng(seed)
    spiral = Spiral(10 ** rng.uniform(-1.0, 1.0), 10 ** rng.uniform(0.5, 3.5))
    search = ContactSearch(Dragon(3), spiral, 0.0)
    whole = spiral.growth * spiral_place(arb(spiral.start_theta))
    for travel in rng.uniform(0.0, spiral.length, 50).tolist():
        exact = whole - spiral.growth * spiral_place(arb(search.theta_at(travel)))
        assert abs(float(exact - travel)) <= TRAVEL_ROUNDING * spiral.length

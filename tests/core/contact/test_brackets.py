"""A march: the error of its travels to 50 digits."""

import numpy as np
import pytest
from flint import arb

from core import Dragon, Spiral
from core.contact.brackets import TRAVEL_ROUNDING
from tests.support.exact_chain import spiral_place
from tests.support.searches import search_on


@pytest.mark.parametrize("seed", range(4))
def test_no_travel_is_off_by_more_than_its_rounding(seed):
    rng = np.random.default_rng(seed)
    spiral = Spiral(*10 ** rng.uniform([-1.0, 0.5], [1.0, 3.5]))
    search = search_on(Dragon(3), spiral)
    for travel in rng.uniform(0.0, spiral.length, 50).tolist():
        start, end = (spiral_place(arb(theta)) for theta in (spiral.start_theta, search.theta_at(travel)))
        assert abs(float(spiral.growth * (start - end) - travel)) <= TRAVEL_ROUNDING * spiral.length

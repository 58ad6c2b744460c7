"""The highest rate of any handle: at least every sample, at most its bound."""

import numpy as np
import pytest

from core import Dragon, Turn
from core.kernels import Peak
from core.kernels.constants import FREE
from tests.support.near import assert_near
from tests.support.searches import search_on

ROUNDING = 1e-11


@pytest.mark.parametrize("radius", [4.5, 5.2, 6.5])
@pytest.mark.parametrize("start", [pytest.param(-30.0, id="from before"), pytest.param(18.0, id="from within")])
def test_what_is_proven_of_the_way_out_is_what_following_all_of_it_proves(radius, start):
    search = search_on(Dragon(12), Turn(1.7, turning_radius=radius))
    rates = []
    for alike in (1, 11):  # with the last bench alone alike, none repeats
        peak = Peak(search.interval, search.probed, FREE, alike, start, 200.0, 1e-12)
        peak.sample(0.5)
        peak.prove(0.5, 1e-9, 1e-3, 10**6)
        assert peak.rate <= peak.upper <= peak.rate + 2e-9
        assert_near(np.abs(search.rates(peak.travel)).max(), peak.rate, ROUNDING)
        rates.append(peak.rate)
    assert_near(rates[0], rates[1], 1e-9)

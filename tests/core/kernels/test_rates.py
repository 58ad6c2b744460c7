"""Rates of handles, and the slopes of the rates."""

from core import Dragon, Turn
from core.kernels import climbs, place_chain
from core.kernels.constants import CLIMB
from tests.support.near import assert_near
from tests.support.searches import search_on


def test_slopes_of_rates_are_their_difference_quotients():
    search = search_on(Dragon(6), Turn(1.7))
    step = 1e-5
    travel = 12.0
    place_chain(search.curve, search.place - travel, 6, search.sizes, search.tried)
    climbs(search.curve, 6, search.sizes, search.tried)
    quotient = (search.rates(travel + step) - search.rates(travel - step)) / (2.0 * step)
    assert_near(search.tried[:7, CLIMB], quotient, 1e-6)

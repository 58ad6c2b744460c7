"""Rates of handles, and the slopes of the rates."""

from __future__ import annotations

import pytest

from core import Dragon, Turn, kernels
from core.contact.search import ContactSearch


def test_slopes_of_rates_are_their_difference_quotients() -> None:
    search, step = ContactSearch(Dragon(6), Turn(1.7), 0.0), 1e-5
    travel = 12.0
    kernels.place_chain(search.curve, search.place - travel, 6, search.sizes, search.tried)
    kernels.climbs(search.curve, 6, search.sizes, search.tried)
    quotient = (search.rates(travel + step) - search.rates(travel - step)) / (2.0 * step)
    assert search.tried[:7, kernels.CLIMB] == pytest.approx(quotient, abs=1e-6)

"""The first excess over a limit, against samples."""

from functools import cache

import numpy as np
import pytest

from core import Dragon, Turn
from core.contact.search import ContactSearch
from core.kernels import Excess, Judged

WIDTH, STOP = 1e-9, 25.0
SEARCH = ContactSearch(Dragon(6), Turn(1.7), 0.0)
PLACES = np.linspace(0.0, STOP, 3_000)


@cache
def highest_rates():
    """The highest rate at each of these places of the head [1]."""
    return np.array([np.abs(SEARCH.rates(travel)).max() for travel in PLACES])


def excess_over(limit, links=10**6):
    excess = Excess(SEARCH.interval, 0.0)
    return excess.run(0.0, STOP, 0.5, limit, limit * (1.0 + 1e-9), WIDTH, 1e-13, links), excess


@pytest.mark.parametrize("part", [0.2, 0.7, 0.99])
def test_before_the_first_excess_no_sample_exceeds_the_limit_and_there_one_handle_does(part):
    rates = highest_rates()
    limit = 1.0 + part * (rates.max() - 1.0)
    outcome, excess = excess_over(limit)
    assert outcome is Judged.EXCEEDED
    assert excess.exceeded - 2.0 * WIDTH <= excess.proven <= excess.exceeded
    assert (rates[: np.searchsorted(PLACES, excess.proven)] <= limit).all()
    assert abs(SEARCH.rates(excess.exceeded)[excess.handle]) > limit


def test_a_search_without_links_is_given_up():
    assert excess_over(1.2, links=0)[0] is Judged.UNDECIDED

"""The first excess over a limit, against samples."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Turn, kernels
from core.contact.search import ContactSearch

WIDTH, LINKS = 1e-9, 10**6
START, STOP = 0.0, 25.0


def excess_over(limit: float, links: int = LINKS) -> tuple[int, kernels.Excess, ContactSearch]:
    search = ContactSearch(Dragon(6), Turn(1.7), 0.0)
    excess = kernels.Excess(search.interval, 0.0)
    outcome = excess.run(START, STOP, 0.5, limit, limit * (1.0 + 1e-9), WIDTH, 1e-13, links)
    return outcome, excess, search


def sampled(search: ContactSearch) -> tuple[np.ndarray, np.ndarray]:
    travels = np.linspace(START, STOP, 3_000)
    return travels, np.array([np.abs(search.rates(travel)).max() for travel in travels])


@pytest.mark.parametrize("part", [0.2, 0.7, 0.99])
def test_before_the_first_excess_no_sample_exceeds_the_limit_and_there_one_handle_does(part: float) -> None:
    travels, rates = sampled(ContactSearch(Dragon(6), Turn(1.7), 0.0))
    limit = 1.0 + part * (rates.max() - 1.0)
    outcome, excess, search = excess_over(limit)
    assert outcome is kernels.Judged.EXCEEDED
    assert excess.exceeded - 2.0 * WIDTH <= excess.proven <= excess.exceeded
    assert (rates[travels < excess.proven] <= limit).all()
    assert abs(search.rates(excess.exceeded)[excess.handle]) > limit


def test_a_limit_above_all_rates_is_kept_to_the_end() -> None:
    _, rates = sampled(ContactSearch(Dragon(6), Turn(1.7), 0.0))
    outcome, excess, _ = excess_over(rates.max() + 0.01)
    assert (outcome, excess.proven) == (kernels.Judged.KEPT, STOP)


def test_a_search_without_links_is_given_up() -> None:
    assert excess_over(1.2, links=0)[0] is kernels.Judged.UNDECIDED

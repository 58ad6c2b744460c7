"""The highest rate of any handle: at least every sample, at most its bound."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Route, Spiral, Turn, kernels
from core.contact.search import Search

RUNS = {"spiral": (Spiral(1.2, 3.0), 0.0, 30.0), "turn": (Turn(1.7), 0.0, 25.0)}
CALM = 0.0  # no handle is left out
ROUNDING = 1e-11


def peak_of(path: Spiral | Route, start: float, stop: float) -> tuple[Search, kernels.Peak]:
    search = Search(Dragon(6), path, 0.0)
    return search, kernels.Peak(
        search.interval, search.rows[2], CALM if isinstance(path, Route) else 1e9, start, stop, 1e-12
    )


@pytest.mark.parametrize("name", RUNS)
def test_the_highest_rate_is_met_and_no_sample_exceeds_its_bound(name: str) -> None:
    path, start, stop = RUNS[name]
    search, peak = peak_of(path, start, stop)
    peak.sample(0.5)
    peak.prove(0.5, 1e-9, 1e-3, 10**6)
    assert start <= peak.travel <= stop
    assert np.abs(search.rates(peak.travel)).max() == pytest.approx(peak.rate, abs=ROUNDING)
    seen = max(np.abs(search.rates(travel)).max() for travel in np.linspace(start, stop, 3_000))
    assert seen <= peak.upper <= peak.rate + 1e-8


def test_a_proof_without_links_is_given_up() -> None:
    _, peak = peak_of(*RUNS["turn"])
    peak.sample(0.5)
    peak.prove(0.5, 1e-9, 1e-9, 0)
    assert peak.upper == kernels.FREE


def test_slopes_of_rates_are_their_difference_quotients() -> None:
    search, step = Search(Dragon(6), Turn(1.7), 0.0), 1e-5
    travel = 12.0
    kernels.place_chain(search.curve, search.place - travel, 6, search.sizes, search.rows[1])
    kernels.climbs(search.curve, 6, search.sizes, search.rows[1])
    quotient = (search.rates(travel + step) - search.rates(travel - step)) / (2.0 * step)
    assert search.rows[1, :7, kernels.CLIMB] == pytest.approx(quotient, abs=1e-6)

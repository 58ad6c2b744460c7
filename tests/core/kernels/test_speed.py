"""The highest rate of any handle: at least every sample, at most its bound."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Route, Spiral, Turn, kernels
from core.contact.search import ContactSearch

RUNS = {
    "spiral": (Spiral(1.2, 3.0), 0.0, 30.0),
    "turn": (Turn(1.7), 0.0, 25.0),
    "turn and a long way out": (Turn(1.7), 0.0, 300.0),
    "way out alone": (Turn(1.7), 30.0, 300.0),
}
ROUNDING = 1e-11


def peak_of(
    path: Spiral | Route, start: float, stop: float, alike: int = 1, benches: int = 6
) -> tuple[ContactSearch, kernels.Peak]:
    search = ContactSearch(Dragon(benches), path, 0.0)  # no handle is left out as calm
    return search, kernels.Peak(search.interval, search.probed, kernels.FREE, alike, start, stop, 1e-12)


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


@pytest.mark.parametrize(
    "radius", [pytest.param(4.5, id="tight"), pytest.param(5.2, id="wide"), pytest.param(6.5, id="wider")]
)
@pytest.mark.parametrize("start", [pytest.param(-30.0, id="from before"), pytest.param(18.0, id="from within")])
def test_what_is_proven_of_the_way_out_is_what_following_all_of_it_proves(radius: float, start: float) -> None:
    path = Turn(1.7, turning_radius=radius)
    stop = 200.0
    _, short = peak_of(path, start, stop, benches=12)
    search, whole = peak_of(path, start, stop, alike=11, benches=12)  # the last bench alone is alike: none repeats
    for peak in (short, whole):
        peak.sample(0.5)
        peak.prove(0.5, 1e-9, 1e-3, 10**6)
        assert peak.rate <= peak.upper <= peak.rate + 2e-9
    assert short.rate == pytest.approx(whole.rate, abs=1e-9)
    assert np.abs(search.rates(short.travel)).max() == pytest.approx(short.rate, abs=ROUNDING)


def test_the_way_out_of_the_turn_is_not_followed_to_its_end() -> None:
    _, near = peak_of(Turn(1.7), -30.0, 60.0, benches=100)
    _, far = peak_of(Turn(1.7), -30.0, 1e4, benches=100)
    for peak in (near, far):
        peak.sample(0.5)
        peak.prove(0.5, 1e-9, 1e-3, 10**6)
    assert (near.rate, near.upper, near.travel, near.intervals) == (far.rate, far.upper, far.travel, far.intervals)


def test_a_proof_without_links_is_given_up() -> None:
    _, peak = peak_of(*RUNS["turn"])
    peak.sample(0.5)
    peak.prove(0.5, 1e-9, 1e-9, 0)
    assert peak.upper == kernels.FREE

"""The highest rate of any handle: at least every sample, at most its bound."""

import numpy as np
import pytest

from core import Dragon, Turn
from core.contact.search import ContactSearch
from core.kernels import Peak
from core.kernels.constants import FREE

ROUNDING = 1e-11
TURN = Turn(1.7)


def peak_of(
    path,
    start,
    stop,
    benches=6,
    alike=1,
    width=1e-3,
    work=10**6,
):
    """The search, and the peak between two places of the head, sampled and proven with this width and work."""
    search = ContactSearch(Dragon(benches), path, 0.0)  # no handle is left out as calm
    peak = Peak(search.interval, search.probed, FREE, alike, start, stop, 1e-12)
    peak.sample(0.5)
    peak.prove(0.5, 1e-9, width, work)
    return search, peak


@pytest.mark.parametrize("radius", [4.5, 5.2, 6.5])
@pytest.mark.parametrize("start", [pytest.param(-30.0, id="from before"), pytest.param(18.0, id="from within")])
def test_what_is_proven_of_the_way_out_is_what_following_all_of_it_proves(radius, start):
    path = Turn(1.7, turning_radius=radius)
    # With the last bench alone alike, none repeats.
    (_, short), (search, whole) = (peak_of(path, start, 200.0, 12, alike) for alike in (1, 11))
    for peak in (short, whole):
        assert peak.rate <= peak.upper <= peak.rate + 2e-9
    assert short.rate == pytest.approx(whole.rate, abs=1e-9)
    assert np.abs(search.rates(short.travel)).max() == pytest.approx(short.rate, abs=ROUNDING)


def test_a_proof_without_links_is_given_up():
    assert peak_of(TURN, 0.0, 25.0, width=1e-9, work=0)[1].upper == FREE

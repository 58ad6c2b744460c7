"""Bounds on the separation of benches that are unions of hulls, against samples of an interval."""

from __future__ import annotations

import numpy as np

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.kernels.constants import CENTRE_SPEED, FREE, MX, MY

ROUNDING = 1e-12  # [m]


def strayed(rng: np.random.Generator) -> tuple[ContactSearch, int, int]:
    """A random dragon of nine benches whose people stray, and two of its benches."""
    search = ContactSearch(Dragon(9, 2.0, rng.uniform(1.2, 2.0)), Spiral(0.5, 3.0), 0.0, stray=rng.uniform(0.002, 0.1))
    a = int(rng.integers(0, 3))
    return search, a, int(rng.integers(a + 2, 9))


def test_what_may_touch_for_certain_stays_so_over_the_interval() -> None:
    rng = np.random.default_rng(6)
    touching = 0
    for _ in range(60):
        search, a, b = strayed(rng)
        h, place = 10 ** rng.uniform(-9.0, -1.0), search.place - rng.uniform(0.0, 6.0)
        most = kernels.pair_most(search.scene, search.probe, place, h, a, b)
        places = place - np.linspace(0.0, 1.0, 9) * h
        gaps = [kernels.gap_at(search.scene, at, a, b, search.placed) for at in places.tolist()]
        assert max(gaps) <= max(most, 0.0)
        touching += most <= 0.0
    assert 5 < touching < 55


def test_no_two_benches_that_stray_are_nearer_over_the_interval_than_their_bound() -> None:
    rng = np.random.default_rng(7)
    proven = 0
    for _ in range(60):
        search, a, b = strayed(rng)
        h, place = 10 ** rng.uniform(-6.0, -1.0), search.place - rng.uniform(0.0, 6.0)
        if not search.probe.lay_out(place, h, b + 1):
            continue
        before = search.probed  # of the probe
        distance = (
            np.hypot(*(before[b, [MX, MY]] - before[a, [MX, MY]])) + h * search.motion[[a, b], CENTRE_SPEED].sum()
        )
        least, _ = kernels.pair_least(search.scene, search.probe, a, b, FREE, float(distance))
        places = place - np.linspace(0.0, 1.0, 9) * h
        gaps = [kernels.gap_at(search.scene, at, a, b, search.placed) for at in places.tolist()]
        assert least <= max(min(gaps), 0.0) + ROUNDING
        proven += least > 0.9 * min(gaps) > 0.0
    assert proven > 15

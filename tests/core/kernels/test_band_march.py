"""A band of pitches: how it ends. What it proves: tests/core/design/test_pitch_bands.py."""

from __future__ import annotations

import math

import numpy as np

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.design.pitch_bands import Bands

LOW, HIGH, CIRCLE, WORK = 0.5, 0.501, 4.5, 1e7


def band_march_of(pitch: float, benches: int = 60) -> tuple[ContactSearch, kernels.BandMarch]:
    search = ContactSearch(Dragon(benches), Spiral(pitch), 0.0)
    return search, Bands(search, CIRCLE, 16.0, 0.0).march_to((pitch + HIGH - LOW) / (2.0 * math.pi))


def test_a_band_that_reaches_the_circle_is_clear_at_samples() -> None:
    search, band = band_march_of(LOW)
    assert band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, WORK) is kernels.Ended.REACHED
    assert band.result()[:2] == (CIRCLE, None)
    for pitch in np.linspace(LOW, HIGH, 5):
        search.use(Spiral(pitch), 0.0)
        for radius in np.linspace(CIRCLE, 6.0, 40):
            assert search.clearance(search.travel_at(radius / search.growth))[0] > 0.0


def test_a_band_too_narrow_for_its_benches_touches() -> None:
    search, band = band_march_of(0.42)
    assert band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, WORK) is kernels.Ended.TOUCHED
    result = band.result()
    assert result.touching is not None
    travel = search.travel_at(result.touching / search.growth)
    assert kernels.gap_at(search.scene, search.place - travel, *result.benches, search.placed) <= 0.0


def test_without_work_a_band_is_stuck_and_more_leaders_than_rows_do_not_fit() -> None:
    _, band = band_march_of(LOW)
    assert band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, 0.0) is kernels.Ended.STUCK
    assert band.result().proven == 6.0
    assert band.run(6.0, CIRCLE, 61, 1e-12, 1e-9, WORK) is kernels.Ended.CAPACITY

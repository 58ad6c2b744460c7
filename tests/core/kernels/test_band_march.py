"""A band of pitches: how it ends. What it proves: test_nearest.py and tests/core/design/test_pitch_bands.py."""

import math

import pytest

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.design.pitch_bands import Bands
from core.kernels import Ended, gap_at

CIRCLE, WORK = 4.5, 1e7


def band_march_of(pitch):
    search = ContactSearch(Dragon(60), Spiral(pitch), 0.0)
    return search, Bands(search, CIRCLE, 16.0, 0.0).march_to((pitch + 0.001) / (2.0 * math.pi))


@pytest.mark.parametrize(
    ("pitch", "leaders", "work", "ended"),
    [(0.5, 2, WORK, Ended.REACHED), (0.5, 2, 0.0, Ended.STUCK), (0.5, 61, WORK, Ended.CAPACITY)],
)
def test_a_band_reaches_the_circle_or_has_not_begun(pitch, leaders, work, ended):
    """Without work, and with more leaders than rows, nothing is proven."""
    _, band = band_march_of(pitch)
    assert band.run(6.0, CIRCLE, leaders, 1e-12, 1e-9, work) is ended
    if ended is not Ended.CAPACITY:
        assert band.result()[:2] == (CIRCLE if ended is Ended.REACHED else 6.0, None)


def test_a_band_too_narrow_for_its_benches_touches():
    search, band = band_march_of(0.42)
    assert band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, WORK) is Ended.TOUCHED
    result = band.result()
    assert result.touching is not None
    travel = search.travel_at(result.touching / search.growth)
    assert gap_at(search.scene, search.place - travel, *result.benches, search.placed) <= 0.0

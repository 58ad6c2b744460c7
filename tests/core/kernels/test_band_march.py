"""A band of pitches: how it ends. What it proves: test_nearest.py and tests/core/design/test_pitch_bands.py."""

import math

import pytest

from core import Dragon, Spiral
from core.design.pitch_bands import Bands
from core.kernels import Ended, gap_at
from tests.support.searches import search_on

CIRCLE = 4.5
WORK = 1e7


@pytest.mark.parametrize(
    "pitch, leaders, work, ended",
    [
        *((0.5, 2, WORK, Ended.REACHED), (0.5, 2, 0.0, Ended.STUCK), (0.5, 61, WORK, Ended.CAPACITY)),
        (0.42, 2, WORK, Ended.TOUCHED),
    ],
)
def test_a_band_reaches_the_circle_or_touches_or_has_not_begun(pitch, leaders, work, ended):
    """Without work, and with more leaders than rows, nothing is proven."""
    search = search_on(Dragon(60), Spiral(pitch))
    band = Bands(search, CIRCLE, 16.0, 0.0).march_to((pitch + 0.001) / (2.0 * math.pi))
    result = band.run(6.0, CIRCLE, leaders, 1e-12, 1e-9, work)
    assert result.ended is ended
    if ended is Ended.TOUCHED:
        assert CIRCLE <= result.touching <= result.proven <= 6.0
        travel = search.travel_at(result.touching / search.growth)
        assert gap_at(search.scene, search.place - travel, *result.pair, search.placed) <= 0.0
    elif ended is not Ended.CAPACITY:
        assert result[1:3] == (CIRCLE if ended is Ended.REACHED else 6.0, None)

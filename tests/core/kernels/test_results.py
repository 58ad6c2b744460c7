"""Results of a march and of a band: numbers of Python that say what a second look finds."""

import pytest

from core.kernels import gap_at
from core.kernels.results import Dip, Marched
from tests.core.kernels.test_band_march import CIRCLE, WORK, band_march_of
from tests.core.kernels.test_marching import forty, marched

GAP = 1e-9  # [m]: the bottom of a dip is found to this by steps of the march


def test_a_march_hands_over_numbers_of_python_and_a_graze_that_a_second_look_finds():
    search = forty()
    _, result = marched(search)
    graze = result.graze
    assert graze is not None
    assert [type(value) for value in result] == [float, float, tuple, int, float, Dip]
    assert [type(value) for value in (*result.benches, *graze)] == [int, int, float, float, tuple]
    assert result.steps > 0
    assert result.gap_curvature > 0.0
    there = gap_at(search.scene, search.place - graze.travel, *graze.benches, search.placed)
    assert there == pytest.approx(graze.gap, abs=GAP)


def test_a_band_hands_over_a_radius_and_no_graze():
    _, band = band_march_of(0.42)
    band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, WORK)
    result = band.result()
    assert isinstance(result, Marched)
    assert [type(value) for value in result[:2]] == [float, float]
    assert result.touching is not None
    assert CIRCLE <= result.touching <= result.proven <= 6.0
    assert result.graze is None

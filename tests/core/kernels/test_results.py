"""Results of a march and of a band: numbers of Python that say what a second look finds."""

from __future__ import annotations

import pytest

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.kernels.results import Dip, Marched
from tests.core.kernels.test_band_march import CIRCLE, WORK, band_march_of
from tests.core.kernels.test_marching import ended, march_of

GAP = 1e-9  # [m]: the bottom of a dip is found to this by steps of the march


def test_a_march_hands_over_numbers_of_python() -> None:
    search = ContactSearch(Dragon(40), Spiral(), 0.0)
    march = march_of(search)
    ended(march, 380.0, 420.0)
    result = march.result()
    assert isinstance(result, Marched)
    assert [type(value) for value in result] == [float, float, tuple, int, float, Dip]
    assert [type(bench) for bench in result.benches] == [int, int]
    assert result.graze is not None
    assert [type(value) for value in result.graze] == [float, float, tuple]
    assert result.steps > 0
    assert result.gap_curvature > 0.0


def test_the_graze_of_a_march_has_the_gap_of_its_pair_there() -> None:
    search = ContactSearch(Dragon(40), Spiral(), 0.0)
    march = march_of(search)
    ended(march, 380.0, 420.0)
    graze = march.result().graze
    assert graze is not None
    gaps = [
        kernels.gap_at(search.scene, search.place - graze.travel - shift, *graze.benches, search.placed)
        for shift in (-1e-2, 0.0, 1e-2)
    ]
    assert gaps[1] == pytest.approx(graze.gap, abs=GAP)
    assert min(gaps) == gaps[1]


def test_a_band_hands_over_a_radius_and_no_graze() -> None:
    _, band = band_march_of(0.42)
    band.run(6.0, CIRCLE, 2, 1e-12, 1e-9, WORK)
    result = band.result()
    assert isinstance(result, Marched)
    assert [type(value) for value in result[:2]] == [float, float]
    assert result.touching is not None
    assert CIRCLE <= result.touching <= result.proven <= 6.0
    assert result.graze is None

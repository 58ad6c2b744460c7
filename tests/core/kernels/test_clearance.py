"""The clearance at an instant, against all pairs; rates against difference quotients."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Spiral, Turn, kernels
from core.contact.search import ContactSearch

# Step of difference quotients [m], and the error that it leaves in a rate [1].
STEP, QUOTIENT = 1e-5, 1e-6
PATHS = {"spiral": (Spiral(), 395.0), "turn": (Turn(1.7), 20.0)}


def searched(name: str) -> tuple[ContactSearch, float]:
    path, travel = PATHS[name]
    return ContactSearch(Dragon(45), path, 0.0), travel


@pytest.mark.parametrize("name", PATHS)
def test_the_clearance_is_the_least_gap_of_all_pairs(name: str) -> None:
    search, travel = searched(name)
    for at in (0.0, travel, travel + 7.3):
        place = search.place - at
        gap, *pair = kernels.clearance_at(search.scene, place, 45, 45, search.placed, search.motion)
        gaps = {
            (a, b): kernels.gap_at(search.scene, place, a, b, search.tried) for a in range(45) for b in range(a + 2, 45)
        }
        assert gap == min(gaps.values()) == gaps[tuple(pair)]


@pytest.mark.parametrize("name", PATHS)
@pytest.mark.parametrize("pair", [(0, 9), (3, 13), (7, 20)])
def test_a_gap_changes_as_fast_as_said(name: str, pair: tuple[int, int]) -> None:
    search, travel = searched(name)
    before, after = (
        kernels.gap_at(search.scene, search.place - travel - side * STEP, *pair, search.tried) for side in (-1, 1)
    )
    rate = kernels.gap_rate_at(search.scene, search.place - travel, *pair, search.tried)
    assert rate == pytest.approx((after - before) / (2.0 * STEP), abs=QUOTIENT)


def test_the_bottom_of_a_dip_is_its_least_gap() -> None:
    search, _ = searched("spiral")
    travels = np.linspace(409.0, 410.5, 301)
    gaps = [kernels.gap_at(search.scene, search.place - at, 0, 11, search.tried) for at in travels]
    k = int(np.argmin(gaps))
    assert 0 < k < 300
    bottom = kernels.bottom_between(search.scene, travels[k - 1], travels[k + 1], 0, 11, 1e-9, search.tried)
    assert kernels.gap_at(search.scene, search.place - bottom, 0, 11, search.tried) <= min(gaps)

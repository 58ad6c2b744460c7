"""The clearance at an instant, against all pairs; rates against difference quotients."""

import pytest

from core import Dragon, Spiral, Turn
from core.contact.search import ContactSearch
from core.kernels import clearance_at, gap_at, gap_rate_at
from tests.support.intervals import checked_pairs

# Step of difference quotients [m], and the error that it leaves in a rate [1].
STEP, QUOTIENT = 1e-5, 1e-6
PATHS = pytest.mark.parametrize(("path", "travel"), [(Spiral(), 395.0), (Turn(1.7), 20.0)], ids=["spiral", "turn"])


def gap(search, travel, pair):
    return gap_at(search.scene, search.place - travel, *pair, search.tried)


@PATHS
def test_the_clearance_is_the_least_gap_of_all_pairs(path, travel):
    search = ContactSearch(Dragon(45), path, 0.0)
    for at in (0.0, travel, travel + 7.3):
        least, *pair = clearance_at(search.scene, search.place - at, 45, 45, search.placed, search.motion)
        gaps = {each: gap(search, at, each) for each in checked_pairs(45)}
        assert least == min(gaps.values()) == gaps[tuple(pair)]


@PATHS
@pytest.mark.parametrize("pair", [(0, 9), (3, 13), (7, 20)])
def test_a_gap_changes_as_fast_as_said(path, travel, pair):
    search = ContactSearch(Dragon(45), path, 0.0)
    quotient = (gap(search, travel + STEP, pair) - gap(search, travel - STEP, pair)) / (2.0 * STEP)
    rate = gap_rate_at(search.scene, search.place - travel, *pair, search.tried)
    assert rate == pytest.approx(quotient, abs=QUOTIENT)

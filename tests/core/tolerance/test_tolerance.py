"""Tolerance: brackets around known values, a shown contact above, no contact in a million poses below."""

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    Spiral,
    Venue,
    tolerance,
)
from core.tolerance.tolerance import Limit
from tests.campaigns.adversaries import seek, to_circle
from tests.support.near import assert_near
from tests.support.random_squares import box
from tests.support.random_strays import moved_points, random_strays
from tests.support.shared_dances import lane, square

# Largest width of a bracket, as a part of its proven end [1].
BRACKET = 2e-3


@pytest.fixture(scope="module")
def default():
    dance, stop = to_circle(0.55)
    return tolerance(dance, stop=stop)


@pytest.mark.thorough
def test_none_of_a_million_poses_that_seek_contact_find_it(default):
    gaps = seek(to_circle(0.55)[0], default)
    assert gaps.size >= 1_000_000
    # of twice the stray and more in the nominal places: the search does come near
    assert 0.0 < gaps.min() < 0.005 * default.stray


@pytest.mark.thorough
def test_the_same_search_finds_contacts_with_strays_beyond_the_bracket(default):
    assert seek(to_circle(0.55)[0], default, part=1.002, rounds=30).min() < 0.0


def test_speed_changes_when_but_not_how_far_and_all_lengths_times_k_how_far(default):
    stop = to_circle(0.55)[1] / 4.0
    dance = Dance(Dragon(223, 6.82, 4.40, 0.60, 0.55), Spiral(1.1), 8.0)
    result = tolerance(dance, stop=stop)
    assert result.stray == pytest.approx(2.0 * default.stray, rel=1e-5)
    assert result.time == pytest.approx(default.time / 4.0, rel=1e-6)


def test_two_benches_on_a_line_have_nothing_to_touch():
    result = tolerance(Dance(Dragon(2), lane((0.0, 0.0), (30.0, 0.0))), start=5.0)
    assert result.limited_by is Limit.CHORD
    assert_near(result.stray, 0.825, 1e-12)
    assert result.stray_bracket == (result.stray, None)
    assert result.benches is result.time is result.exhibit is None


def test_a_bench_that_passes_a_wall_may_stray_to_it():
    """Towards a long wall the corner counts, which moves further than the holes."""
    venue = Venue(square(60.0).square, [box("wall", 0.0, 0.5, 40.0, 0.5)])
    result = tolerance(Dance(Dragon(1), lane((0.0, 0.0), (30.0, 0.0))), venue, start=5.0, stop=25.0)
    assert result.limited_by is Limit.VENUE
    assert result.area == "wall"
    safe, touching = result.stray_bracket
    assert touching < safe * (1.0 + BRACKET)
    corner = np.array([[0.5 * 2.86 + 0.275, 0.15]])
    chord = 2.86
    reached = [
        moved_points(corner, random_strays(np.random.default_rng(1), chord, stray, 100_000), chord)[..., 1].max()
        for stray in (safe, 1.002 * touching)
    ]
    assert reached[0] <= 0.5 < reached[1]

"""Benches too far out to touch, against chains."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, bench_outlines, trajectory
from core.kernels import (
    clear_radius,
    leaders_reach,
    radius_beyond,
    ring_clears,
    ring_least,
    ring_rounding,
    spirals_least,
)
from core.kernels.constants import FREE
from tests.campaigns.hunt_contacts import random_dragon
from tests.support.searches import search_on


@pytest.mark.parametrize("seed", range(20))
def test_benches_led_from_beyond_a_radius_lie_outside_it_and_leaders_within_their_reach(seed):
    rng = np.random.default_rng(seed)
    dragon = Dragon(40, 3.4, rng.uniform(0.8, 2.2), 0.3, rng.uniform(0.0, 0.3))
    spiral = Spiral(rng.uniform(0.3, 1.5))
    search = search_on(dragon, spiral)
    position = trajectory(Dance(dragon, spiral), rng.uniform(0.0, 100.0)).position
    far, handles = (np.linalg.norm(points, axis=-1) for points in (bench_outlines(dragon, position), position))
    for k in range(40):
        assert far[k].max() <= leaders_reach(spiral.growth, handles[k], handles[k + 1], search.rings)
    for radius in np.linspace(0.5, handles[-1], 30):
        outside = handles[1:-1] >= radius_beyond(spiral.growth, radius, search.rings)
        assert (far[1:][outside] >= radius).all()


def random_case(seed):
    """A random dragon on a pitch of some of its widths, whose people do not stray."""
    rng = np.random.default_rng(seed)
    dragon = random_dragon(rng)
    chord = float(dragon.chords[-1])
    return dragon, max(1.2 * float(dragon.widths[0]), chord * 10 ** rng.uniform(-1.0, 0.4)), 0.0


@pytest.mark.parametrize(
    "dragon, pitch, stray",
    [
        (Dragon(60), 0.45, 0.0),
        (Dragon(60), 5.0, 0.0),  # the nearest benches have one bench between them
        (Dragon(60), 0.5, 0.01),
        (Dragon(60), 0.6, 0.03),
        (Dragon(60), 1.0, 0.15),
        # When these stray far, their ends are wider than their middles, and come nearest to the benches inside them.
        (Dragon(60, 2.2, 2.2, 0.1, 0.24), 1.0, 0.3),
        *map(random_case, range(20)),
    ],
)
def test_no_clearance_falls_below_the_ring_bound_further_out(dragon, pitch, stray):
    search = search_on(dragon, Spiral(pitch), stray=stray)
    bounds = []
    for travel in np.linspace(0.0, 0.95, 30) * search.travel_at(0.0):
        at = search.growth, search.growth * search.theta_at(travel), search.rings
        bounds.append(ring_least(search.growth, *at) - ring_rounding(*at))
        assert search.clearance(travel)[0] >= bounds[-1]
    assert bounds[0] > 0.0 or search.clear_radius > search.growth * search.theta_at(0.0)


@pytest.mark.parametrize("margin", [0.0, 0.1])
@pytest.mark.parametrize("pitch", [0.45, 0.55, 1.7])
def test_the_clear_radius_is_the_least_from_which_the_ring_bound_exceeds_the_margin(pitch, margin):
    rings = search_on(Dragon(), Spiral(pitch), margin).rings
    growth = Spiral(pitch).growth
    radii = np.array([0.998, 1.0, 1.1, 10.0]) * rings.clear_radius
    assert [ring_clears(growth, growth, radius, margin, rings) for radius in radii] == [False, True, True, True]


def test_no_radius_is_clear_where_rings_are_narrower_than_benches():
    assert search_on(Dragon(), Spiral(0.29)).clear_radius == FREE


@pytest.mark.parametrize("angle", [3.0, 2.0])
def test_the_bound_for_two_spirals_over_a_range_of_growths_is_none_above_that_of_a_growth_in_it(angle):
    rings = search_on(Dragon(40), Spiral(), copies=2).rings
    for low, high in ((0.2, 0.21), (0.2, 0.4), (0.5, 0.9)):
        least = spirals_least(high, angle, 20.0, rings, low)
        inside = [spirals_least(growth, angle, 20.0, rings) for growth in np.linspace(low, high, 9)]
        assert 0.0 < least <= min(inside)
    clear = clear_radius(0.3, 0.1, rings, angle)
    assert 0.1 < spirals_least(0.3, angle, clear, rings) < 0.101


@pytest.mark.parametrize("angle", [1.0, 2.0, 2.0 * np.pi])
def test_the_bound_for_turns_apart_is_the_distance_of_their_line_from_the_origin(angle):
    """Points at polar angles x apart are G + growth x apart radially, and 2 rho |x| / pi sideways: the bound is the
    least of both together. G is growth times the angle of the spirals less the bows, so the bound grows with it."""
    rings = search_on(Dragon(40), Spiral()).rings
    growth = 0.8
    radius = 8.0
    foot = max(0.5 * rings.all_chord, 1.67 * growth)
    rho = np.sqrt(radius**2 - foot**2) - rings.all_half_width
    x = np.linspace(-np.pi, np.pi, 2_000_001)
    gap = growth * angle
    least = np.hypot(np.maximum(gap + growth * x, 0.0), 2.0 * rho * x / np.pi).min()
    more, less = (spirals_least(growth, 6.0 + end * angle, radius, rings) for end in (1.0, 0.0))
    assert more - less == pytest.approx(least, rel=1e-9)


@pytest.mark.parametrize("pitch, radius", [(0.5, 9.0), (0.55, 4.0), (0.55, 9.0), (0.7, 3.0)])
def test_benches_of_one_dragon_a_turn_apart_have_the_bound_of_spirals_a_turn_apart(pitch, radius):
    rings = search_on(Dragon(40), Spiral(pitch)).rings
    growth = Spiral(pitch).growth
    alone = ring_least(growth, growth, radius, rings)
    assert 0.0 < alone == pytest.approx(spirals_least(growth, 2.0 * np.pi, radius, rings), rel=1e-12)

"""The room that a dragon needs beside its path, compared with benches on circles."""

import math

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Route, bench_outlines, trajectory
from core.paths.following import tightest_bend
from core.proposal.needs import SPARE, Needs
from core.shapes.reach import gains
from tests.support.near import assert_near

DRAGON = Dragon(3)
TIGHTEST = tightest_bend(DRAGON)[0]


def distances(dragon, radius):
    """Distances of the sides of the benches from the centre of a circle on which they dance [m]."""
    dance = Dance(dragon, Route([Arc((0.0, 0.0), radius, 0.0, 12.0 / radius + 0.5)]))
    corners = bench_outlines(dragon, trajectory(dance, dance.end.time).position)
    way = np.linspace(0.0, 1.0, 2001)[:, None, None, None]
    return np.linalg.norm(corners + way * (np.roll(corners, -1, axis=1) - corners), axis=-1)


@pytest.mark.parametrize("dragon", [DRAGON, Dragon(3, 3.0, 3.0, overhang=1.2)], ids=["inside", "outside"])
@pytest.mark.parametrize("radius", [1.6, 2.2, 3.0, 6.0, 20.0])
def test_the_sides_on_a_circle_are_those_of_the_benches(radius, dragon):
    away = distances(dragon, radius)
    most = max(away.max() - radius, radius - away.min())
    assert_near(Needs(dragon, 0.0, 0.0).sides(np.array([1.0 / radius, -1.0 / radius])), most, 1e-6)


def test_the_longest_bench_turns_in_the_circle_on_the_tightest_bend():
    needs = Needs(DRAGON, 0.05, 0.1)
    assert needs.radii == pytest.approx(TIGHTEST * np.array([2.0, 1.55, 1.1]))
    assert needs.turning_width == pytest.approx(2.0 * (distances(DRAGON, needs.tight).max() + needs.free))


def test_margin_and_stray_take_room_on_both_sides_and_at_both_ends():
    dragon = Dragon.of([3.41, 2.2, 2.2], [0.3] * 3, [0.275, 0.275, 0.4])
    needs = Needs(dragon, 0.1, 0.2)
    strayed = 0.1 * float(gains(dragon).max())
    assert (needs.free, needs.least_width) == pytest.approx((0.2 + strayed, 0.9))
    assert needs.gap == pytest.approx(0.275 + 0.4 + 0.2 + 2.0 * strayed + SPARE)
    assert needs.least_area == pytest.approx((3.41 + 2.2) * 0.3)


def test_a_straight_path_needs_half_a_width():
    assert Needs(DRAGON, 0.1, 0.2).straight_side == pytest.approx(0.15)


def test_the_length_along_a_circle_is_that_of_the_arcs_under_the_chords():
    needs = Needs(Dragon(30), 0.0, 0.0)
    route = Route([Arc((0.0, 0.0), 5.0, 0.0, 4.0 * math.pi)])
    assert_near(needs.length_along(5.0), Dance(Dragon(30), route).begin, 1e-6)
    assert needs.length == pytest.approx(2.86 + 29 * 1.65)

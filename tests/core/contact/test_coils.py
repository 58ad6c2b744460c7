"""Bounds in closed form on coils: benches are as far apart as stated."""

import math

import numpy as np
import pytest
import shapely

from core import Dance, Dragon, Spiral, Turn, bench_outlines, trajectory
from core.contact.coils import rings_clear, wholly_outside
from core.design.deepest_turn import coils_of


def benches_on(dragon, pitch, radius, turned=0.0):
    """Polygons of the benches whose head has come to a radius of a coil, which is turned about its centre."""
    dance = Dance(dragon, Spiral(pitch, radius / pitch, rotation=turned))
    return shapely.polygons(bench_outlines(dragon, trajectory(dance, 0.0).position))


# If the growth exceeds the chord, the foot of the perpendicular from the centre lies in front of the inner handle,
# and an overhang on that side reaches centimetres further in than the chord does.
@pytest.mark.parametrize("radius", [3.0, 8.0, 20.0])
@pytest.mark.parametrize(
    "pitch, chord, overhang",
    [(0.6, 1.65, 0.275), (3.0, 0.5, 0.2), (6.0, 0.5, 0.2), (9.0, 0.5, 0.24), (12.0, 0.5, 0.2), (9.9, 0.3, 0.14)],
)
def test_benches_claimed_wholly_outside_a_radius_are_outside(pitch, chord, overhang, radius):
    length = chord + 2.0 * overhang
    dragon = Dragon(4, length, length, 0.05, overhang)
    beyond = wholly_outside(dragon, pitch / (2.0 * math.pi), radius)
    for further in np.linspace(0.0, pitch, 5):
        assert shapely.distance(benches_on(dragon, pitch, beyond + further), shapely.Point(0.0, 0.0)).min() >= radius
    assert beyond < radius + chord + overhang


# A short head lies between no two benches, so its chord of 0.451 m does not weaken the bound.
@pytest.mark.parametrize("head_length", [2.2, 1.001])
@pytest.mark.parametrize("pitch", [0.9, 1.2, 1.7, 3.0])
def test_two_coils_claimed_apart_are_apart_by_more_than_the_margin(pitch, head_length):
    coils = coils_of(Turn(pitch))
    dragon = Dragon(60, head_length)
    equal = Dragon(60, 2.2)
    radii = []
    # along a coil, with one between them, two benches are known to be 0.6 m apart
    for margin in np.linspace(0.0, min(0.5 * pitch - 0.35, 0.55), 5):
        radii.append(rings_clear(dragon, coils, margin))
        tree = shapely.STRtree(benches_on(equal, pitch, radii[-1]))
        for shift in np.linspace(0.0, 2.0, 9):
            others = benches_on(equal, pitch, radii[-1] + shift, math.pi)
            assert tree.query_nearest(others, return_distance=True)[1].min() > margin
    assert radii == sorted(radii)
    assert rings_clear(dragon, coils, 0.5 * pitch - 0.3) is None

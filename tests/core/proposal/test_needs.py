"""The room that a dragon needs beside its path, compared with benches on circles."""

import math

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Route, bench_outlines, trajectory
from core.proposal.needs import Needs

DRAGON = Dragon(3)


@pytest.mark.parametrize("radius", [1.6, 2.2, 3.0, 6.0, 20.0])
def test_the_sides_on_a_circle_are_those_of_the_benches(radius):
    dance = Dance(DRAGON, Route([Arc((0.0, 0.0), radius, 0.0, 12.0 / radius + 0.5)]))
    corners = bench_outlines(DRAGON, trajectory(dance, dance.end.time).position)
    way = np.linspace(0.0, 1.0, 2001)[:, None, None, None]
    away = np.linalg.norm(corners + way * (np.roll(corners, -1, axis=1) - corners), axis=-1)
    most = max(away.max() - radius, radius - away.min())
    assert Needs(DRAGON, 0.0, 0.0).sides(np.array([1.0 / radius, -1.0 / radius])) == pytest.approx(most, abs=1e-6)


def test_a_straight_path_needs_half_a_width():
    assert Needs(DRAGON, 0.1, 0.2).straight_side == pytest.approx(0.15)


def test_the_length_along_a_circle_is_that_of_the_arcs_under_the_chords():
    needs, route = Needs(Dragon(30), 0.0, 0.0), Route([Arc((0.0, 0.0), 5.0, 0.0, 4.0 * math.pi)])
    assert needs.length_along(5.0) == pytest.approx(Dance(Dragon(30), route).begin, abs=1e-6)
    assert needs.length == pytest.approx(2.86 + 29 * 1.65)

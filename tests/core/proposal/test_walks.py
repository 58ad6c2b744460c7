"""Steps and Dubins paths: they end where they must, and no random path of the same curvature is shorter."""

import math
from functools import reduce

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import Coil, Route
from core.proposal.walks import along, dubins, joined, length_of, mirrored, moved, placed, stretch
from tests.support.depth import examples
from tests.support.near import assert_near

PLACE = 1e-9  # [m], [rad]: rounding of a few steps
NEAR = 1e-4  # [m], [rad]: rounding may leave no path between poses that are nearer
SIZES = st.floats(0.1, 12.0)
ANGLES = st.floats(-7.0, 7.0)
POSES = st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), ANGLES)
ORIGIN = (0.0, 0.0, 0.0)


def apart(a, b):
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), abs(math.remainder(a[2] - b[2], math.tau)))


@settings(max_examples=examples(100, 1000), deadline=None)
@given(POSES, POSES, st.floats(0.5, 5.0))
def test_every_word_ends_at_the_pose(begin, end, radius):
    paths = dubins(begin, end, radius)
    assert len(paths) >= (2 if apart(begin, end) > NEAR else 0)
    lengths = [length_of(path) for path in paths]
    assert lengths == sorted(lengths)
    for path in paths:
        assert min(length for length, _ in path) >= 0.0
        assert {abs(curvature) for _, curvature in path} <= {0.0, 1.0 / radius}
        assert apart(reduce(moved, path, begin), end) < PLACE


@settings(max_examples=examples(60, 1000), deadline=None)
@example(ORIGIN, [(0.75, 5e-324)], 0.5)
@given(POSES, st.lists(st.tuples(SIZES, st.floats(-0.98, 0.98)), min_size=1, max_size=5), st.floats(0.5, 4.0))
def test_no_path_of_at_most_that_curvature_is_shorter(begin, steps, radius):
    walk = [(length, share / radius) for length, share in steps]
    shortest = dubins(begin, reduce(moved, walk, begin), radius)[0]
    assert length_of(shortest) <= length_of(walk) + PLACE


@pytest.mark.parametrize("curvature", [0.5, -0.5])
def test_the_shortest_path_along_one_arc_is_that_arc(curvature):
    begin = (1.0, -2.0, 0.3)
    assert joined(dubins(begin, moved(begin, (2.5, curvature)), 2.0)[0]) == [(pytest.approx(2.5), curvature)]


def test_a_stretch_goes_round_a_closed_path():
    round_once = 2.0 * math.pi
    loop = [(round_once, 1.0), (round_once, -1.0)]
    assert length_of(stretch(loop, 5.0, 30.0)) == pytest.approx(30.0)
    assert stretch(loop, round_once, 1.0) == [(1.0, -1.0)]
    assert apart(along(ORIGIN, loop, 2.0 * round_once + 1.0), moved(ORIGIN, (1.0, 1.0))) < PLACE
    assert mirrored(loop) == loop[::-1]


def test_pieces_are_placed_as_a_whole():
    pieces = [Coil(1.0, 4.0, 2.0)]
    s = np.linspace(0.0, 20.0, 7)
    plane = np.array([1.0, 1.0j])
    expected = Route(pieces).position(s) @ plane * np.exp(0.7j) + (3.0 - 1.0j)
    assert_near(Route(placed(pieces, (3.0, -1.0, 0.7))).position(s) @ plane, expected, PLACE)

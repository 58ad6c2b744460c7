"""Steps and Dubins paths: they end where they must, and no random path of the same curvature is shorter."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import Arc, Coil, Line, Route
from core.proposal.walks import along, dubins, joined, length_of, mirrored, moved, pieces_of, placed, stretch
from tests.support.depth import examples

PLACE = 1e-9  # [m], [rad]: rounding of a few steps
NEAR = 1e-4  # [m], [rad]: rounding may leave no path between poses that are nearer
SIZES, ANGLES = st.floats(0.1, 12.0), st.floats(-7.0, 7.0)
POSES = st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), ANGLES)


def apart(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), abs(math.remainder(a[2] - b[2], math.tau)))


@settings(max_examples=examples(100, 1000), deadline=None)
@given(POSES, POSES, st.floats(0.5, 5.0))
def test_every_word_ends_at_the_pose(begin, end, radius) -> None:
    paths = dubins(begin, end, radius)
    assert len(paths) >= (2 if apart(begin, end) > NEAR else 0)
    assert [length_of(path) for path in paths] == sorted(length_of(path) for path in paths)
    for path in paths:
        pose = begin
        for length, curvature in path:
            assert length >= 0.0
            assert abs(curvature) in (0.0, 1.0 / radius)
            pose = moved(pose, (length, curvature))
        assert apart(pose, end) < PLACE


@settings(max_examples=examples(60, 1000), deadline=None)
@example((0.0, 0.0, 0.0), [(0.75, 5e-324)], 0.5)
@given(POSES, st.lists(st.tuples(SIZES, st.floats(-0.98, 0.98)), min_size=1, max_size=5), st.floats(0.5, 4.0))
def test_no_path_of_at_most_that_curvature_is_shorter(begin, steps, radius) -> None:
    walk = [(length, share / radius) for length, share in steps]
    end = begin
    for step in walk:
        end = moved(end, step)
    assert length_of(dubins(begin, end, radius)[0]) <= length_of(walk) + PLACE


@pytest.mark.parametrize("curvature", [0.5, -0.5])
def test_the_shortest_path_along_one_arc_is_that_arc(curvature: float) -> None:
    end = moved((1.0, -2.0, 0.3), (2.5, curvature))
    assert joined(dubins((1.0, -2.0, 0.3), end, 2.0)[0]) == [(pytest.approx(2.5), curvature)]


def test_pieces_join_and_have_the_length_of_the_steps() -> None:
    steps = [(3.0, 0.0), (2.0, 0.4), (1.0, 0.4), (0.0, -1.0), (4.0, -0.25)]
    pieces, end = pieces_of((1.0, 2.0, 0.5), steps)
    route = Route(pieces)
    assert [type(piece) for piece in pieces] == [Line, Arc, Arc]
    assert route.end - route.begin == pytest.approx(length_of(steps), abs=PLACE)
    assert tuple(route.position(route.end)) == pytest.approx(end[:2], abs=PLACE)
    assert joined(steps) == [(3.0, 0.0), (3.0, 0.4), (4.0, -0.25)]


def test_a_stretch_goes_round_a_closed_path() -> None:
    loop = [(2.0 * math.pi, 1.0), (2.0 * math.pi, -1.0)]
    assert length_of(stretch(loop, 5.0, 30.0)) == pytest.approx(30.0)
    assert stretch(loop, 2.0 * math.pi, 1.0) == [(1.0, -1.0)]
    assert apart(along((0.0, 0.0, 0.0), loop, 4.0 * math.pi + 1.0), moved((0.0, 0.0, 0.0), (1.0, 1.0))) < PLACE
    assert mirrored(loop) == [(2.0 * math.pi, -1.0), (2.0 * math.pi, 1.0)]


def test_pieces_are_placed_as_a_whole() -> None:
    pieces = [Coil(1.0, 4.0, 2.0)]
    there, pose = Route(placed(pieces, (3.0, -1.0, 0.7))), (3.0, -1.0, 0.7)
    s = np.linspace(0.0, 20.0, 7)
    x, y = Route(pieces).position(s).T
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    turned = np.stack([3.0 + cos * x - sin * y, -1.0 + sin * x + cos * y], axis=-1)
    assert there.position(s) == pytest.approx(turned, abs=PLACE)

"""A path through points: smooth everywhere, contains its points, and is straight on straight legs."""

import math

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from core import InvalidValue, Legs
from tests.support.near import assert_near
from tests.support.refused import refused

ON_THE_PATH = 1e-9  # [m]
CORNER = [(0.0, 0.0), (16.0, 12.0), (4.0, 28.0)]
POINT = st.tuples(st.integers(-40, 40), st.integers(-40, 40))


def test_a_corner_of_straight_legs_is_rounded_by_an_arc_of_the_radius_or_as_large_as_the_legs_allow():
    line, arc, _ = Legs(CORNER, [0, 1], radius=4.0).pieces
    assert_near(line.end, [12.8, 9.6], ON_THE_PATH)
    assert_near([*arc.centre, arc.radius, arc.sweep], [10.4, 12.8, 4.0, math.pi / 2], ON_THE_PATH)
    assert 9.0 < Legs(CORNER, [0, 1], radius=400.0).pieces[1].radius < 10.0


def test_without_a_radius_corners_stay_and_one_of_a_right_angle_or_more_is_refused_by_its_point():
    flat = [(0.0, 0.0), (20.0, 0.0), (24.0, 8.0), (24.0, 20.0)]
    path = Legs(flat, [0, 1, 2], radius=0.0)
    assert_near(path.position(path.corners), flat[1:3], ON_THE_PATH)
    assert path == Legs(flat, [0, 1, 2], radius=0.0)
    for last, angle in (((12.0, 8.0), 116.565051), ((20.0, 0.0), 180.0)):
        words = f"corner at path.points.2. must turn by less than 90 degrees, got {angle:.6g} degrees: no bench"
        with pytest.raises(InvalidValue, match=words):
            Legs([*flat[:3], last], [0, 1, 2], radius=0.0)


@settings(max_examples=40, deadline=None)
@given(st.lists(POINT, min_size=2, max_size=7, unique=True), st.sets(st.integers(0, 5)))
def test_every_drawn_path_is_smooth_and_goes_through_its_points(points, legs):
    straight = {leg for leg in legs if leg < len(points) - 1}
    try:
        path = Legs(points, sorted(straight), radius=3.0)  # Route refuses a gap or a kink between two pieces.
    except InvalidValue as error:
        if not {"gap", "kink"} & error.values.keys():  # two straight legs turn back, or a curve turns on the spot
            reject()
        raise
    far = np.hypot(*(path.position(path.knots) - np.array(points)).T)
    curved = [k for k in range(len(points)) if not {k - 1, k} <= straight]
    assert far[curved].max(initial=0.0) < ON_THE_PATH
    assert (np.diff(path.knots) > 0.0).all()


@pytest.mark.parametrize(
    "points, straight, field",
    [
        (CORNER[:1], [], "path.points"),
        ([*CORNER, CORNER[-1]], [], "path.points.3"),
        (CORNER, [2], "path.straight.0"),
        (CORNER, [0.5], "path.straight.0"),
        ([(0.0, 0.0), (20.0, 0.0), (1.0, 0.0)], [0, 1], "path.points.1"),
    ],
    ids=["one point", "twice the same", "no such leg", "half a leg", "turns back"],
)
def test_what_cannot_be_drawn_is_refused_by_its_place(points, straight, field):
    with refused(field):
        Legs(points, straight)

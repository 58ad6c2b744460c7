"""Curves as points: within 5 mm of the true curve, on it at both ends, and counted before they are made."""

from itertools import pairwise
from math import hypot, pi

import ezdxf
import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.spatial import KDTree

from app.maps.curves import SAG, Damaged, points_of
from core import InvalidValue
from tests.support.near import assert_near

ROUNDING = 1e-9  # of places [m]
SPACE = ezdxf.new("R2010").modelspace()


def middles(points):
    """Points along the straight lines between points."""
    shares = np.linspace(0.0, 1.0, 9)[:, None]
    return np.concatenate([a + shares * (b - a) for a, b in pairwise(points)])


def circle_of(points, x, y):
    """Distances of the lines between points from a place."""
    return np.hypot(*(middles(points) - (x, y)).T)


@pytest.mark.parametrize("radius", [0.01, 1.0, 100.0, 5_000.0])
@pytest.mark.parametrize("start, end", [(0.0, 90.0), (350.0, 20.0), (10.0, 370.0), (0.0, 0.0)])
def test_an_arc_is_as_round_as_it_is(radius, start, end):
    points = points_of(SPACE.add_arc((3, 4), radius, start, end), 1.0)
    away = circle_of(points, 3.0, 4.0)
    assert abs(away - radius).max() <= SAG
    assert away.max() <= radius + ROUNDING
    angles = np.radians([start, end])
    ends = [3.0, 4.0] + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    assert_near(points[[0, -1]], ends, ROUNDING)
    swept = np.unwrap(np.arctan2(*(points - (3.0, 4.0)).T[::-1]))
    assert swept[-1] - swept[0] == pytest.approx((end - start) % 360 * pi / 180 or 2 * pi)


def test_a_mirrored_arc_is_mirrored():
    arc = SPACE.add_arc((3, 4), 2.0, 0, 90, dxfattribs={"extrusion": (0, 0, -1)})
    assert points_of(arc, 1.0)[[0, -1]] == pytest.approx(np.array([(-5.0, 4.0), (-3.0, 6.0)]))


@pytest.mark.parametrize("bulge", [0.2, -0.2, 1.0, -1.0, 3.0, 1e-5, 1e-9, -0.5])
def test_a_bulge_is_the_arc_that_it_says(bulge):
    points = points_of(SPACE.add_lwpolyline([(0, 0, bulge), (10, 5, 0)], format="xyb"), 1.0)
    assert points[[0, -1]].tolist() == [[0.0, 0.0], [10.0, 5.0]]
    if abs(bulge) < 1e-3:
        assert len(points) == 2
        return
    # A positive bulge turns to the left, so its top is to the right of the straight line.
    middle = np.array([5.0, 2.5])
    left = np.array([-5.0, 10.0])
    top = middle - 0.5 * bulge * left
    centre = middle + (1.0 - bulge**2) / (4.0 * bulge) * left
    radius = hypot(*(top - centre))
    assert np.hypot(*(points - centre).T) == pytest.approx(radius)
    assert abs(circle_of(points, *centre) - radius).max() <= SAG
    assert np.hypot(*(points - top).T).min() < 0.5


def test_a_squeezed_circle_is_an_ellipse_and_a_part_of_it():
    whole = points_of(SPACE.add_ellipse((1, 2), major_axis=(30, 0), ratio=0.5), 1.0)
    x, y = (middles(whole) - (1.0, 2.0)).T
    assert abs(np.hypot(x, 2.0 * y) - 30.0).max() <= 2.0 * SAG
    assert whole[0] == pytest.approx(whole[-1])
    half = points_of(SPACE.add_ellipse((0, 0), major_axis=(0, 4), ratio=0.5, end_param=pi), 1.0)
    assert_near(half[[0, -1]], [(0.0, 4.0), (0.0, -4.0)], ROUNDING)
    assert_near(half[:, 0].min(), -2.0, SAG)


def spline(points, degree, knots, weights=None):
    entity = SPACE.add_spline(degree=degree)
    entity.control_points = [(*point, 0.0) for point in points]
    entity.knots = knots
    if weights:
        entity.weights = weights
    return entity


WRAPPED = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]
CURVES = {
    "wrapped": (WRAPPED, 3, [float(k) for k in range(11)]),
    "clamped": ([(0.0, 0.0), (5.0, 9.0), (20.0, -3.0), (30.0, 0.0)], 3, [0, 0, 0, 0, 1, 1, 1, 1]),
    "with a corner": ([(0.0, 0.0), (5.0, 9.0), (9.0, 0.0), (20.0, 5.0), (30.0, 0.0)], 2, [0, 0, 0, 1, 1, 2, 2, 2]),
    "of degree 5": ([(3.0 * k, 20.0 * (k % 3)) for k in range(9)], 5, [0] * 6 + [1, 2, 4] + [5] * 6),
}


@pytest.mark.parametrize("name", CURVES)
def test_a_spline_is_where_another_program_computes_it(name):
    control, degree, knots = CURVES[name]
    points = points_of(spline(control, degree, knots), 1.0)
    low = knots[degree]
    high = knots[len(control)]
    truth = BSpline(np.array(knots, dtype=float), np.array(control), degree)(np.linspace(low, high, 300_001))
    assert points[[0, -1]] == pytest.approx(truth[[0, -1]])
    apart, _ = KDTree(truth).query(middles(points))
    assert apart.max() <= SAG + 1e-3  # as far as the points of the truth are from one another


@pytest.mark.parametrize("place", [0.0, 3_220_000.0])
def test_a_spline_with_weights_is_a_circle(place):
    root = 0.5**0.5
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    control = [(place + 30.0 * x, place + 30.0 * y) for x, y in corners]
    circle = spline(control, 2, [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], [1, root, 1, root, 1, root, 1, root, 1])
    points = points_of(circle, 1.0) - place
    assert abs(circle_of(points, 0.0, 0.0) - 30.0).max() <= SAG
    assert len(points) < 3_000


def test_a_spline_whose_numbers_do_not_fit_is_damaged():
    ends = [0, 0, 0, 0, 1]
    clamped = [0, 0, 0, 0, 1, 1, 1]
    # Too few knots, knots that fall, a weight of zero.
    for knots, weights in ((ends, None), ([*clamped, 0.5], None), ([*clamped, 1], [1, 0, 1, 1])):
        with pytest.raises((Damaged, ezdxf.DXFError, ValueError)):
            points_of(spline(CURVES["clamped"][0], 3, knots, weights), 1.0)


@pytest.mark.parametrize(
    "entity, words",
    [
        (SPACE.add_arc((0, 0), 1e300, 0, 90), r"1000000000 m, got 1e\+300 m"),
        (SPACE.add_arc((0, 0), float("nan"), 0, 90), "radius"),
        (SPACE.add_arc((0, 0), 9e8, 0, 359), "100000 points"),
        (SPACE.add_lwpolyline([(0, 0, 1), (1e9, 0, 0)], format="xyb"), "100000 points"),
        (SPACE.add_ellipse((0, 0), major_axis=(1e12, 0), ratio=0.5), "radius"),
        (spline([(0, 0), (1e12, 0), (0, 1e12), (1, 1)], 3, [0, 0, 0, 0, 1, 1, 1, 1]), "100000 points"),
    ],
    ids=["arc", "no number", "large arc", "bulge", "ellipse", "spline"],
)
def test_a_curve_that_takes_too_many_points_is_refused_before_one_is_made(entity, words):
    with pytest.raises(InvalidValue, match=words):
        points_of(entity, 1.0)


def test_control_points_of_a_smoothed_polyline_are_no_places():
    line = SPACE.add_polyline2d([(0, 0), (5, 9), (5, 5), (10, 0)])
    line.vertices[1].dxf.flags = 16
    assert points_of(line, 1.0).tolist() == [[0, 0], [5, 5], [10, 0]]

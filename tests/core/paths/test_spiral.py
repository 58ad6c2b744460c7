"""Spiral: points, tangents and limits, against quadrature and difference quotients."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from core import Spiral
from core.errors import SIZE_MAX, SIZE_MIN
from core.paths.spiral import START_TURNS_MAX
from tests.support.near import assert_near
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

SPIRALS = st.builds(Spiral, pitch=st.floats(0.01, 10.0), start_turns=st.floats(0.5, 50.0))
SPIRAL = Spiral()


@pytest.mark.parametrize("turns", [0.01, 0.7, 3.0, 16.0])
def test_the_length_is_the_integral_of_the_speed(turns):
    spiral = Spiral(0.8, turns)
    way, _ = quad(lambda theta: math.hypot(1.0, theta), 0.0, spiral.start_theta, epsabs=0.0, epsrel=1e-13)
    assert spiral.length == pytest.approx(spiral.growth * way, rel=2e-13)


@settings(max_examples=60, deadline=None)
@given(SPIRALS, st.floats(-1.0, 1.0))
def test_points_lie_on_the_spiral_at_their_arc_length(spiral, share):
    s, growth = share * spiral.length, spiral.growth
    theta, point = float(spiral.theta(s)), spiral.position(s)
    assert math.hypot(*point) == pytest.approx(growth * theta, rel=1e-14)
    back = spiral.length - growth / 2 * (theta * math.sqrt(1 + theta**2) + math.asinh(theta))
    assert_near(back, s, 1e-14 * spiral.length)
    assert_near(math.remainder(math.atan2(*point[::-1]) - theta, 2 * math.pi), 0.0, 1e-12)


def test_the_centre_is_at_the_full_length():
    off = np.hypot(*SPIRAL.position(SPIRAL.length))
    assert SPIRAL.growth * SPIRAL.theta(SPIRAL.length) == pytest.approx(off)
    assert off <= np.spacing(SPIRAL.length)  # the length is a double
    assert SPIRAL.theta(np.nextafter(SPIRAL.length, np.inf)) == 0.0


@pytest.mark.parametrize(
    ("pitch", "turns"),
    [(SIZE_MIN, 16.0), (SIZE_MAX, 16.0), (0.55, START_TURNS_MAX), (0.55, 1e-6)],
)
def test_a_spiral_at_its_limits_is_accepted(pitch, turns):
    assert 0.0 < Spiral(pitch, turns).length < math.inf


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("pitch", SIZE_MIN * 0.999),
        ("pitch", SIZE_MAX * 1.001),
        ("start_turns", START_TURNS_MAX * 1.001),
    ],
)
def test_a_spiral_beyond_its_limits_is_refused_by_its_field(name, value):
    with refused(f"path.{name}"):
        Spiral(**{name: value})

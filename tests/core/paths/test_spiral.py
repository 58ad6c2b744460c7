"""Spiral: points, tangents and limits, against quadrature and difference quotients."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad

from core import InvalidValue, Spiral
from core.errors import SIZE_MAX, SIZE_MIN
from core.paths.spiral import START_TURNS_MAX
from tests.support.near import assert_near

pytestmark = pytest.mark.uncompiled

SPIRALS = st.builds(Spiral, pitch=st.floats(0.01, 10.0), start_turns=st.floats(0.5, 50.0))
# Rounding of positions relative to the radius of the start: a few ulp of the arc length, which is longer [1].
ROUNDING = 1e-12
# Step of difference quotients, relative to the way [1]; their error is about its square.
STEP = 1e-5


def test_the_length_is_that_of_the_paper() -> None:
    assert_near(Spiral().length, 442.590256, 5e-7)


@pytest.mark.parametrize("turns", [0.01, 0.7, 3.0, 16.0])
def test_the_length_is_the_integral_of_the_speed(turns: float) -> None:
    spiral = Spiral(0.8, turns)
    speed = quad(
        lambda theta: spiral.growth * math.sqrt(1.0 + theta**2), 0.0, spiral.start_theta, epsabs=0.0, epsrel=1e-13
    )
    assert spiral.length == pytest.approx(speed[0], rel=2e-13)


@given(SPIRALS, st.floats(-1.0, 1.0))
def test_points_lie_on_the_spiral_at_their_arc_length(spiral: Spiral, share: float) -> None:
    s = share * spiral.length
    theta = float(spiral.theta(s))
    x, y = spiral.position(s)
    assert math.hypot(x, y) == pytest.approx(spiral.growth * theta, rel=1e-14)
    back = spiral.length - spiral.growth / 2 * (theta * math.sqrt(1 + theta**2) + math.asinh(theta))
    assert_near(back, s, 1e-14 * spiral.length)
    assert_near(math.remainder(math.atan2(y, x) - theta, 2 * math.pi), 0.0, 1e-12)


@given(SPIRALS, st.floats(-0.5, 0.999))
def test_the_tangent_is_the_difference_quotient_of_the_position(spiral: Spiral, share: float) -> None:
    s, h = share * spiral.length, STEP * spiral.length * (1 - share)
    quotient = (spiral.position(s + h) - spiral.position(s - h)) / (2 * h)
    tangent = spiral.tangent(s)
    assert_near(np.linalg.norm(tangent), 1.0, 1e-14)
    np.testing.assert_allclose(quotient, tangent, atol=1e-5)


# The square of one number and of an array differ in the last digit here if NumPy takes them as powers.
@example(Spiral(1.9033671822025784, 1.4088606096694036), [0.5378478684013417, 0.0])
@given(SPIRALS, st.lists(st.floats(-1.0, 1.0), max_size=6))
def test_a_batch_equals_a_loop(spiral: Spiral, shares: list[float]) -> None:
    s = np.array(shares) * spiral.length
    for batched, single in (
        (spiral.theta(s), [spiral.theta(one) for one in s]),
        (spiral.position(s), [spiral.position(one) for one in s]),
        (spiral.tangent(s), [spiral.tangent(one) for one in s]),
        (spiral.curvature(s), [spiral.curvature(one) for one in s]),
    ):
        assert np.array_equal(batched, np.array(single).reshape(batched.shape))


def test_every_shape_of_s_keeps_its_axes() -> None:
    assert Spiral().theta(np.zeros((2, 3))).shape == (2, 3)
    assert Spiral().position(np.zeros((2, 3))).shape == (2, 3, 2)
    assert Spiral().tangent(5.0).shape == (2,)


def test_the_centre_is_at_the_full_length() -> None:
    spiral = Spiral()
    off = np.hypot(*spiral.position(spiral.length))
    assert spiral.growth * spiral.theta(spiral.length) == pytest.approx(off)
    assert off <= np.spacing(spiral.length)  # the length is a double
    assert spiral.theta(np.nextafter(spiral.length, np.inf)) == 0.0


def test_the_dance_goes_inwards_and_clockwise() -> None:
    spiral = Spiral()
    x, y = spiral.position(1.0)
    assert math.hypot(x, y) < 8.8
    assert y < 0.0


@given(SPIRALS, st.floats(0.1, 10.0), st.floats(-1.0, 1.0))
def test_scaling_the_pitch_scales_the_points(spiral: Spiral, k: float, share: float) -> None:
    scaled = Spiral(k * spiral.pitch, spiral.start_turns)
    point = k * spiral.position(share * spiral.length)
    size = k * spiral.growth * spiral.start_theta
    assert_near(scaled.position(share * scaled.length), point, ROUNDING * 100 * size)


@pytest.mark.parametrize(
    ("pitch", "turns"),
    [(SIZE_MIN, 16.0), (SIZE_MAX, 16.0), (0.55, START_TURNS_MAX), (0.55, 1e-6)],
)
def test_a_spiral_at_its_limits_is_accepted(pitch: float, turns: float) -> None:
    spiral = Spiral(pitch, turns)
    assert 0.0 < spiral.length < math.inf


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("pitch", 0.0, "must be positive, got 0 m"),
        ("pitch", -0.55, "must be positive, got -0.55 m"),
        ("pitch", SIZE_MIN * 0.999, "at least 0.001 m"),
        ("pitch", SIZE_MAX * 1.001, "at most 10000 m"),
        ("pitch", float("nan"), "finite"),
        ("pitch", "0.55", "number"),
        ("pitch", True, "number"),
        ("start_turns", 0.0, "must be positive, got 0 turns"),
        ("start_turns", -1.0, "must be positive, got -1 turns"),
        ("start_turns", START_TURNS_MAX * 1.001, "at most 100000 turns"),
        ("start_turns", float("inf"), "finite"),
        ("start_turns", None, "number"),
    ],
)
def test_a_spiral_beyond_its_limits_is_refused_with_field_value_unit_and_limit(
    name: str, value: object, words: str
) -> None:
    with pytest.raises(InvalidValue) as refused:
        Spiral(**{name: value})  # type: ignore[arg-type]
    assert refused.value.field == f"path.{name}"
    assert words in str(refused.value)

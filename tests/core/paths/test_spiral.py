"""Spiral: points, tangents and limits, against quadrature and difference quotients."""

import math

import numpy as np
import pytest

from core import Spiral
from core.checks import SIZE_MAX, SIZE_MIN
from core.paths.spiral import START_TURNS_MAX
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

SPIRAL = Spiral()


def test_the_centre_is_at_the_full_length():
    off = np.hypot(*SPIRAL.position(SPIRAL.length))
    assert SPIRAL.growth * SPIRAL.theta(SPIRAL.length) == pytest.approx(off)
    assert off <= np.spacing(SPIRAL.length)  # the length is a double
    assert SPIRAL.theta(np.nextafter(SPIRAL.length, np.inf)) == 0.0


@pytest.mark.parametrize(
    "pitch, turns",
    [(SIZE_MIN, 16.0), (SIZE_MAX, 16.0), (0.55, START_TURNS_MAX), (0.55, 1e-6)],
)
def test_a_spiral_at_its_limits_is_accepted(pitch, turns):
    assert 0.0 < Spiral(pitch, turns).length < math.inf


def test_a_pitch_below_its_limit_is_refused():
    with refused("path.pitch"):
        Spiral(SIZE_MIN * 0.999)

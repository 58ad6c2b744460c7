"""The spiral: arc length, the next handle, the chain."""

import numpy as np
import pytest

from core.kernels import spiral_arc, spiral_theta

# Arc lengths are good to this part of themselves [1], chords to this [m].
PART = 1e-13


@pytest.mark.parametrize("theta", [1e-3, 0.5, 7.0, 300.0])
def test_arc_length_is_the_integral_of_the_speed_and_theta_its_inverse(theta):
    from scipy.integrate import quad

    arc = spiral_arc(theta)
    assert arc == pytest.approx(quad(lambda t: np.hypot(1.0, t), 0.0, theta, epsabs=0.0, epsrel=PART)[0], rel=PART)
    assert spiral_theta(arc) == pytest.approx(theta, rel=PART)
    assert spiral_theta(-arc) == 0.0

"""The series of clothoids against its integral, to the rounding that its derivation gives."""

import flint
import numpy as np
import pytest
from flint import acb, arb

from core.kernels import clothoid_joints
from core.kernels.clothoid import clothoid_way
from core.kernels.constants import POINT_COLUMNS, POINT_CURVATURE, TX, TY, ULP
from tests.support.exact_chain import BITS

# Bound of clothoid.py on an error in either part [ULP of the way].
WAY = 14.0


@pytest.mark.parametrize("p", [0.25, -0.25, 0.1, 1e-9, 0.0])
@pytest.mark.parametrize("q", [0.5, -0.5, -0.25, 1e-7, 0.0])
def test_the_way_is_its_integral_to_the_stated_rounding(p, q):
    """The integral of e^(i (p x + q x^2 / 2)) from 0 to 1, by quadrature in balls."""
    flint.ctx.prec = BITS
    exact = acb.integral(lambda x, _: (acb(0, 1) * (p * x + q * x * x / 2)).exp(), 0, 1)
    x, y = clothoid_way(p, q)
    assert abs(float(exact.real - x)) <= WAY * ULP
    assert abs(float(exact.imag - y)) <= WAY * ULP


def test_directions_at_joints_keep_their_digits_after_a_thousand_radians():
    flint.ctx.prec = BITS
    places = np.linspace(0.0, 1_000.0, 4_001)
    clothoid_joints(0.0, 0.0, 0.3, 0.9, -0.7, 1_000.0, places, joints := np.empty((4_001, POINT_COLUMNS)))
    for place, joint in zip(places[::100].tolist(), joints[::100], strict=True):
        v = arb(place)
        angle = arb(0.3) + v * (arb(0.9) + (arb(-0.7) - arb(0.9)) / 1_000 * v / 2)
        assert abs(float(angle.cos()) - joint[TX]) < 4.0 * ULP
        assert abs(float(angle.sin()) - joint[TY]) < 4.0 * ULP
    assert joints[-1, POINT_CURVATURE] == -0.7

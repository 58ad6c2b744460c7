"""The series of clothoids against its integral, to the rounding that its derivation gives."""

import flint
import pytest
from flint import acb

from core.kernels.clothoid import clothoid_way
from core.kernels.constants import ULP
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

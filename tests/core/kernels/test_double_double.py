"""Arc lengths of spirals and their inverse in double-double, against ball arithmetic."""

import flint
import numpy as np
import pytest
from flint import arb

from core.error_free import paired
from core.kernels import coil_arc, growth_pair, spiral_thetas
from tests.support.exact_chain import BITS, spiral_place

# Largest error of an arc length, in units of the growth: of asinh, which is up to 14 [1].
ARC_ERROR = 4e-15
TURNS = (1e-9, 1e-3, 0.5, 1.0, 3.0, 16.0, 1e3, 1e4, 1e5)


@pytest.mark.parametrize("turns", TURNS[-5:])
def test_an_angle_has_the_arc_length_from_which_it_was_found(turns):
    """From the start to a nanometre from the centre: the error of an arc length stays that of asinh."""
    flint.ctx.prec = BITS
    growth, length = growth_pair(0.55), coil_arc(0.55, turns)
    s = length[0] * np.concatenate([[-0.5, 0.0], 1.0 - np.logspace(0.0, -9.0, 40)])
    s = paired(s, 0.3 * np.spacing(s))
    thetas = np.empty_like(s)
    spiral_thetas(*growth, *length, s, thetas)
    for way, theta in zip(s.tolist(), thetas.tolist(), strict=True):
        exact_growth, exact_length, travel, angle = (arb(high) + low for high, low in (growth, length, way, theta))
        error = exact_growth * spiral_place(angle) - exact_length + travel
        assert abs(float(error)) <= 2.0 * ARC_ERROR * growth[0] + 1e-31 * length[0]


def test_beyond_the_centre_there_is_no_angle():
    s = paired(np.array([10.0, 11.0]))
    spiral_thetas(0.1, 0.0, 10.0, 0.0, s, thetas := np.ones_like(s))
    assert not thetas.any()

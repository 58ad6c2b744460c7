"""A stray for sizes that are known only to within an error: safe for every draw of them, and not far too small."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, tolerance, uncertain_tolerance
from core.tolerance.curve import time_on_circle
from tests.support.depth import further

CIRCLE = 4.5  # radius of the turning circle [m]


@pytest.mark.parametrize("seed", further(range(12), 4))
def test_no_benches_and_no_pitch_within_their_errors_allow_less(seed):
    """Half of the draws have benches that are as long or as short as can be, and the narrowest spiral."""
    rng = np.random.default_rng(seed)
    dragon = Dragon(70, width=rng.uniform(0.2, 0.4), overhang=rng.uniform(0.1, 0.3))
    pitch = rng.uniform(0.7, 1.0)
    error = rng.uniform(0.0, 0.2)
    spread = rng.uniform(0.0, 0.05)
    safe = uncertain_tolerance(dragon, pitch, length_error=error, pitch_error=spread, turning_radius=CIRCLE)
    off = rng.uniform(-1.0, 1.0, 71)
    if seed % 2:
        off = np.append(rng.choice([-1.0, 1.0], 70), -1.0)
    drawn = Dragon.of(dragon.lengths + error * off[:70], dragon.widths, dragon.overhangs)
    dance = Dance(drawn, Spiral(pitch + spread * off[70], 9.0))
    known = tolerance(dance, stop=time_on_circle(dance, CIRCLE)).stray
    assert 0.0 < safe < known < 2.0 * safe


@pytest.mark.parametrize(
    "pitch, radius, error, spread",
    [(0.7, CIRCLE, 0.1, 0.0), (0.7, CIRCLE, 0.0, 0.03), (0.7, CIRCLE, 0.1, 0.03), (9.0, 50.0, 0.1, 0.0)],
    ids=["lengths", "pitch", "both", "benches next but one"],
)
def test_errors_allow_no_more_than_the_dragons_and_spirals_at_their_ends(pitch, radius, error, spread):
    dragon = Dragon()
    safe = uncertain_tolerance(dragon, pitch, length_error=error, pitch_error=spread, turning_radius=radius)
    ends = [
        uncertain_tolerance(
            Dragon.of(dragon.lengths + off, dragon.widths, dragon.overhangs), pitch + more, turning_radius=radius
        )
        for off in (-error, error)
        for more in (-spread, spread)
    ]
    assert 0.9 * min(ends) < safe <= min(ends) < uncertain_tolerance(dragon, pitch, turning_radius=radius)


def test_where_nothing_is_proven_the_stray_is_none():
    assert uncertain_tolerance(Dragon(), 0.6, pitch_error=0.2) == 0.0
    assert uncertain_tolerance(Dragon(), 0.45) == 0.0


def test_no_stray_is_longer_than_half_a_chord():
    dragon = Dragon(20, head_length=0.5, width=0.1, overhang=0.05)
    assert uncertain_tolerance(dragon, 9.0, length_error=0.02, turning_radius=50.0) == pytest.approx(0.5 * (0.4 - 0.02))

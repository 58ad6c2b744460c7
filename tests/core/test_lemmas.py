"""The lemmas under the searches, each against dense random samples of what it claims."""

import math

import numpy as np
import pytest

from core import Dance, Dragon, Outcome, Turn, first_contact
from core.contact.march import BRACKET
from tests.support.depth import some

# Points of a random curve; its angles and chords are sums of that many terms, good to this [rad], relative [1].
POINTS = 20_001
SUMMED = 2e-4
# Rounding of a distance beside its lower bound, relative [1].
ROUNDING = 1e-12


@pytest.mark.parametrize("seed", some(range(60), 20))
def test_angles_of_a_chord_lie_between_those_of_two_circles(seed):
    """The chord lemma, one-sided and two-sided, and Vogt's theorem: core/kernels/bounds.py."""
    rng = np.random.default_rng(seed)
    most, growing = 10 ** rng.uniform(-1.0, 1.0), seed % 3 == 1
    least = -most if seed % 3 == 0 else most * rng.uniform(0.0, 1.0)
    # A curve a little longer than pi / most: its curvature is linear between random places, phi its tangent angle.
    t, step = np.linspace(0.0, 1.05 * math.pi / most, POINTS, retstep=True)
    bends = rng.choice([least, most, rng.uniform(least, most)], int(rng.integers(2, 12)))
    bends = np.sort(bends) if growing else bends
    bend = np.interp(t, np.sort(rng.uniform(0.0, t[-1], bends.size)), bends)
    phi = np.concatenate([[0.0], np.cumsum(0.5 * (bend[1:] + bend[:-1]) * step)])
    points = np.concatenate([[0.0], np.cumsum(np.exp(0.5j * (phi[1:] + phi[:-1])) * step)])
    chord = 2.0 * rng.uniform(0.05, 0.999) / most
    back = int(np.argmax(np.abs(points[-1] - points[::-1]) >= chord))
    length = back * step
    assert 0.0 < length <= math.pi / most
    beta = np.angle(points[-1] - points[-1 - back])
    turned = math.remainder(phi[-1] - beta, 2.0 * math.pi), math.remainder(beta - phi[-1 - back], 2.0 * math.pi)
    for angle in turned:
        assert 0.5 * least * length - SUMMED <= angle <= 0.5 * most * length + SUMMED
        assert 0.5 * least * chord - SUMMED <= math.sin(angle) <= 0.5 * most * chord + SUMMED
    assert turned[0] >= turned[1] - SUMMED or not growing


def test_points_of_two_rings_are_apart_by_the_bound_wherever_they_stand_to_each_other():
    """The radial gap G + growth x may be negative: core/kernels/rings.py."""
    rng = np.random.default_rng(7)
    count = 400_000
    growth, rho = 10 ** rng.uniform(-2.0, 1.0, count), 10 ** rng.uniform(-1.0, 1.5, count)
    gap = 2.0 * math.pi * growth * rng.uniform(0.0, 1.0, count)
    x = rng.uniform(-math.pi, math.pi, count)
    radial = gap + growth * x
    assert (radial < 0.0).mean() > 0.05

    def further():
        """Zero or more, as often as not [1]."""
        return rng.exponential(0.3, count) * rng.integers(0, 2, count)

    inner = rho * (1.0 + further())
    outer = np.maximum(inner + radial + further() * rho, rho)  # the bound assumes of the radii only that both reach rho
    distance = np.sqrt((outer - inner) ** 2 + 4.0 * outer * inner * np.sin(0.5 * x) ** 2)
    assert (distance >= gap / np.sqrt(1.0 + (0.5 * math.pi * growth / rho) ** 2) * (1.0 - ROUNDING)).all()


def test_ten_thousand_benches_through_the_turn_are_decided_as_two_hundred_are():
    few, many, *touching = (first_contact(Dance(Dragon(n), Turn(pitch))) for pitch in (1.7, 1.0) for n in (223, 10_000))
    assert (few.outcome, many.outcome, many.end) == (Outcome.CLEAR, Outcome.CLEAR, few.end)
    assert many.certificate.steps == few.certificate.steps
    # The steps are the same but for the rounding of travels, which grows with the length of the dragon.
    assert touching[0].time == pytest.approx(touching[1].time, abs=BRACKET)

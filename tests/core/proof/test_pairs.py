"""Two benches in balls: nearness as shapely measures it, and bounds over a stretch."""

import numpy as np
import pytest
from flint import acb, arb

from core.proof.pairs import Benches, Size, stays_positive
from tests.support.proof_shapes import polygon

# Distances in doubles are this near to the true ones [m].
DOUBLES = 1e-11
# A margin that differs from the distance by this is on a certain side of it [m].
MARGIN_OFF = 1e-6


@pytest.mark.parametrize("seed", range(6))
def test_benches_are_within_a_margin_exactly_when_shapely_says_so(seed):
    random = np.random.default_rng(seed)
    for _ in range(60):
        sizes = [Size(*random.uniform([0.5, 0.1, 0.0], [3.0, 0.6, 0.2])) for _ in range(2)]
        benches = Benches(sizes)
        shapes = []
        for size in sizes:
            angle = random.uniform(0.0, 7.0)
            place = complex(*random.uniform(-1.6, 1.6, 2))
            benches.centres.append(acb(place.real, place.imag))
            benches.along.append((acb(0, 1) * arb(angle)).exp())
            shapes.append(polygon(benches.centres[-1], benches.along[-1], size))
        distance = shapes[0].distance(shapes[1])
        assert benches.nearest(1)[0] == pytest.approx(distance, abs=DOUBLES) or distance == 0.0
        assert benches.within(1, arb(distance + MARGIN_OFF))
        assert distance < MARGIN_OFF or not benches.within(1, arb(distance - MARGIN_OFF))


def test_the_bound_on_a_stretch_never_calls_a_dip_positive():
    # g = first + rate x + bow x^2 on [0, width]: with the exact range of g' the bound may only be too careful.
    random = np.random.default_rng(5)
    proven = 0
    for first, rate, bow, width in random.uniform([0.0, -2.0, -3.0, 0.1], [1.0, 2.0, 3.0, 2.0], (4000, 4)):
        end = first + rate * width + bow * width**2
        end_rate = rate + 2 * bow * width
        inside = -rate / (2 * bow) if 0.0 < -rate / (2 * bow) < width else 0.0
        least = min(first, end, first + rate * inside + bow * inside**2)
        positive = stays_positive(arb(first), arb(end), arb(rate).union(arb(end_rate)), arb(width))
        assert not positive or least > 0.0
        proven += positive
    assert proven > 1000

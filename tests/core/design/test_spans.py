"""Intervals with derivatives: they hold every value that a quantity and its derivatives take on a box."""

import numpy as np
import pytest

from core.design.spans import mean_value, parameters
from tests.support.boxes_of_turns import place_in

pytestmark = pytest.mark.uncompiled

BOXES = 300
PLACES = 40
STEP = 1e-6  # of difference quotients [1]
ROUNDED, QUOTIENT_ERROR = 1e-12, 1e-6  # of values, and of difference quotients of numbers below 100 [1]


def value(x, y):
    return np.sin(x) - np.exp(0.3 * x) * np.cos(y) / (y * y + 1.0)


def test_spans_hold_the_values_and_slopes_of_a_formula():
    """One of all operations but the root, without which the spans of boxes of turns would be false."""
    rng = np.random.default_rng(1)
    widest = 0.0
    centres = rng.uniform(-4.0, 4.0, (2, BOXES))
    halves = rng.uniform(0.0, 0.6, (2, BOXES))
    x, y = parameters(centres, halves)
    result = x.sine() + -(x.scaled(0.3).exponential() * y.cosine() / y.squared().plus(1.0))
    form = mean_value(value(*centres), result.slopes, halves)
    for _ in range(PLACES):
        x, y = place_in(centres, halves, rng)
        at = value(x, y)
        by_x = value(x + STEP, y) - value(x - STEP, y)
        by_y = value(x, y + STEP) - value(x, y - STEP)
        for span, inside, error in (
            (result.value, at, ROUNDED),
            (form, at, ROUNDED),
            (result.slopes[0], by_x / (2.0 * STEP), QUOTIENT_ERROR),
            (result.slopes[1], by_y / (2.0 * STEP), QUOTIENT_ERROR),
        ):
            assert ((span.low - error <= inside) & (inside <= span.high + error)).all()
        widest = max(widest, float(((at - form.low) / (form.high - form.low + ROUNDED)).max()))
    assert widest > 0.6  # the spans are not wide for nothing

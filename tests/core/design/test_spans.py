"""Intervals with derivatives: they hold every value that a quantity and its derivatives take on a box."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from core.design.spans import Known, Span, angle_slopes, mean_value, parameters
from core.values import Floats

BOXES, PLACES = 300, 40
STEP = 1e-6  # of difference quotients [1]
QUOTIENT_ERROR = 1e-6  # of difference quotients of numbers below 100 [1]
FORMULAS: dict[str, tuple[Callable[[Known, Known], Known], Callable[[Floats, Floats], Floats]]] = {
    "product": (lambda x, y: x * y + x, lambda x, y: x * y + x),
    "quotient": (lambda x, y: x / y.squared().plus(1.0), lambda x, y: x / (y * y + 1.0)),
    "root": (lambda x, y: (x.squared() + y.squared()).plus(0.5).root(), lambda x, y: np.sqrt(x * x + y * y + 0.5)),
    "waves": (lambda x, y: x.sine() * y.cosine() - y, lambda x, y: np.sin(x) * np.cos(y) - y),
    "exponential": (lambda x, y: -(x.scaled(0.3).exponential() * y), lambda x, y: -(np.exp(0.3 * x) * y)),
}


@pytest.mark.uncompiled
@pytest.mark.parametrize("name", FORMULAS)
def test_spans_hold_the_values_and_slopes_of_a_formula(name: str) -> None:
    known, value = FORMULAS[name]
    rng = np.random.default_rng(1)
    centres, halves = rng.uniform(-4.0, 4.0, (2, BOXES)), rng.uniform(0.0, 0.6, (2, BOXES))
    result = known(*parameters(centres, halves))
    form = mean_value(value(*centres), result.slopes, halves)
    widest = 0.0
    for _ in range(PLACES):
        x, y = centres + halves * rng.uniform(-1.0, 1.0, centres.shape)
        at = value(x, y)
        for span in (result.value, form):
            assert (span.low - 1e-12 <= at).all()
            assert (at <= span.high + 1e-12).all()
        slopes = (
            (value(x + STEP, y) - value(x - STEP, y)) / (2.0 * STEP),
            (value(x, y + STEP) - value(x, y - STEP)) / (2.0 * STEP),
        )
        for slope, span in zip(slopes, result.slopes, strict=True):
            assert (span.low - QUOTIENT_ERROR <= slope).all()
            assert (slope <= span.high + QUOTIENT_ERROR).all()
        widest = max(widest, float(((at - form.low) / (form.high - form.low + 1e-12)).max()))
    assert widest > 0.6  # the spans are not wide for nothing


@pytest.mark.uncompiled
def test_the_slopes_of_an_angle_are_those_of_its_vector() -> None:
    x, y = parameters(np.array([[3.0], [4.0]]), np.array([[0.0], [0.0]]))
    slopes = angle_slopes(x, y, Span(np.array([25.0]), np.array([25.0])))
    assert [float(slope.low[0]) for slope in slopes] == pytest.approx([-4.0 / 25.0, 3.0 / 25.0], abs=1e-15)

"""The model of wobbling people: its refusals, and those of a dance that it does not fit."""

import pytest

from core import Dance, Dragon, Spiral, Turn, Wobble
from core.errors import Quantity
from core.tolerance.wobble import check_sizes
from tests.support.refused import refused


@pytest.mark.parametrize(
    ("fields", "field"),
    [
        ({"lateral": -0.01}, "lateral"),
        ({"correlation_time": 0.0}, "correlation_time"),
        ({"step": 1.01}, "step"),
        ({"step": 0}, "step"),
        ({"correlation_benches": 0}, "correlation_benches"),
        ({"hole": 0.05, "pin": 0.06}, "pin"),
        ({"pitch_error": float("nan")}, "pitch_error"),
    ],
    ids=str,
)
def test_a_model_that_cannot_be_is_refused(fields, field):
    with refused(f"model.{field}"):
        Wobble(**fields)
    Wobble(step=1.0, hole=0.05, pin=0.05)


@pytest.mark.parametrize(
    ("field", "size", "most"),
    [("lateral", 0.2, 0.165), ("forward", 0.2, 0.165), ("hole", 0.5, 0.165), ("pitch_error", 0.06, 0.055)],
)
def test_a_model_that_does_not_fit_a_dance_is_refused(field, size, most):
    """People move by at most a tenth of the shortest chord, and the pitch by a tenth of itself."""
    dance = Dance(Dragon(5), Spiral())
    check_sizes(dance, Wobble(**{field: 2.0 * most if field == "hole" else most}))
    with refused(f"model.{field}", most=Quantity(pytest.approx(most), "m", 9)):
        check_sizes(dance, Wobble(**{field: size}))


def test_a_path_that_is_no_spiral_has_no_error_of_the_pitch():
    dance = Dance(Dragon(5), Turn(1.7))
    check_sizes(dance, Wobble())
    with refused("model.pitch_error"):
        check_sizes(dance, Wobble(pitch_error=0.01))

"""The model of wobbling people: its refusals, and those of a dance that it does not fit."""

import pytest

from core import Dance, Dragon, Spiral, Turn, Wobble
from core.tolerance.wobble import check_sizes
from tests.support.refused import refused


@pytest.mark.parametrize("step", [0, 1.01])
def test_a_step_above_a_second_or_none_is_refused(step):
    with refused("model.step"):
        Wobble(step=step)
    Wobble(step=1.0, hole=0.05, pin=0.05)


@pytest.mark.parametrize(
    "path, field, most",
    [
        *((Spiral(), "lateral", 0.165), (Spiral(), "forward", 0.165), (Spiral(), "hole", 0.33)),
        *((Spiral(), "pitch_error", 0.055), (Turn(1.7), "pitch_error", 0.0)),
    ],
)
def test_a_model_that_does_not_fit_a_dance_is_refused(path, field, most):
    """People move by at most a tenth of the shortest chord, and the pitch of a spiral by a tenth of itself."""
    dance = Dance(Dragon(5), path)
    check_sizes(dance, Wobble(**{field: most}))
    with refused(f"model.{field}"):
        check_sizes(dance, Wobble(**{field: most + 1e-3}))

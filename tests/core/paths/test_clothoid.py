"""Clothoids against Fresnel integrals to 50 digits, at their ends, as arcs and lines, and what they refuse."""

import numpy as np
import pytest
from flint import acb

from core import (
    Budget,
    Clothoid,
    Route,
    TooMuchWork,
)
from core.kernels.constants import K_END, K_START, S_END, S_START
from core.paths import pieces
from tests.support.exact_chain import clothoid_place
from tests.support.near import assert_near

# Stated accuracy of a place up to 20 m from the origin [m]; one curve written in two ways [m].
PLACE = 1e-11
SAME = 1e-12


CASES = {
    "ramp": Clothoid((3.0, -2.0), 0.7, 0.0, 0.6, 3.0),
    "to both sides": Clothoid((-5.0, 4.0), 1e5, -0.6, 0.4, 12.0),
    "almost an arc": Clothoid((0.0, 0.0), -2.0, 0.3, 0.3 + 1e-9, 14.0),
    "almost a line": Clothoid((0.0, 0.0), 3.0, 1e-7, -1e-8, 15.0),
    "wound up": Clothoid((0.0, 0.0), 0.2, 0.0, 1.0, 1_000.0),
    "long": Clothoid((10.0, 10.0), -9.0, 0.0, 0.1, 10_000.0),
    "small": Clothoid((1.0, 1.0), 0.0, -900.0, 700.0, 0.01),
}


@pytest.mark.parametrize("piece", CASES.values(), ids=CASES)
def test_places_are_those_of_fresnel_integrals(piece):
    route = Route([piece])
    for v in (piece.length * np.linspace(0.0, 1.0, 41)).tolist():
        exact = clothoid_place(piece, v)
        assert float(abs(acb(*route.position(v).tolist()) - exact)) < max(PLACE, 1e-12 * float(abs(exact)))
    assert_near(piece.end, route.position(route.end), SAME)


def test_every_row_turns_little():
    table = Route([CASES["to both sides"]]).table
    lengths = table[:, S_END] - table[:, S_START]
    assert (np.abs(table[:, [K_START, K_END]]).max(axis=1) * lengths <= pieces.ROW_TURN * (1.0 + 1e-9)).all()
    assert (table[1:, K_START] == table[:-1, K_END]).all()


def test_a_spent_budget_ends_the_layout():
    budget = Budget(1.0)
    budget.spend(2.0)
    with pytest.raises(TooMuchWork, match=r"path\.pieces\[0\]"):
        Route([CASES["wound up"]], budget=budget)


@pytest.mark.parametrize(
    "first, last, calm", [(0.1, 0.4, True), (0.0, -0.4, True), (0.4, 0.1, False), (-0.1, 0.4, False)]
)
def test_a_growing_clothoid_at_the_beginning_is_calm(first, last, calm):
    """No handle is faster than its leader where the curvature grows in the direction of travel."""
    assert Route([Clothoid((0, 0), 0.0, first, last, 40.0)]).calm_beginning is calm

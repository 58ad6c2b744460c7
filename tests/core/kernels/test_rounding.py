"""Rounding of the points of a table of pieces; tests/core/test_rounding.py tests whole answers."""

import numpy as np
import pytest

from core import Line, Route
from core.kernels import joint_misses
from core.kernels.constants import LOOSE, MISS_ACROSS, MISS_ALONG, MISS_COLUMNS, MISS_KINK


def test_misses_of_a_joint_are_those_that_were_made():
    route = Route([Line((0.0, 0.0), (30.0, 0.0)), Line((30.0, 9e-10), (60.0, 9e-10))])
    table = route.table.copy()
    misses = np.zeros((2, MISS_COLUMNS))
    table[:, LOOSE] = 0.0  # which holds these misses already
    joint_misses(table, misses)
    assert misses[1, MISS_ACROSS] == pytest.approx(9e-10, rel=1e-3)
    assert misses[1, MISS_ALONG] < 1e-13
    assert misses[1, MISS_KINK] < 1e-13

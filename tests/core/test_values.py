"""Types of arrays and points: results of numbers given as integers hold doubles, as their annotations say."""

from typing import get_args

import numpy as np
import pytest

import core
from core.values import Floats, Point
from tests.core.test_display import DANCE, hints

RESULTS = [
    core.trajectory(DANCE, [0, 300]),
    core.first_contact(DANCE, start=410),
    core.course(core.Route([core.Line((0, 0), (9, 0))]), core.Dragon(2)),
    core.Dragon.of([3, 2], [1, 1], [0, 0]),
    core.Line((0, 0), (9, 0)),
]


@pytest.mark.parametrize("result", RESULTS, ids=lambda result: type(result).__name__)
def test_arrays_hold_doubles_and_points_two_floats(result):
    values = {name: hint for name, hint in hints(type(result)).items() if hint in (Floats, Point, Point | None)}
    assert values
    for name, hint in values.items():
        value = getattr(result, name)
        if hint == Floats:
            assert (type(value), value.dtype) == (np.ndarray, get_args(get_args(Floats)[1])[0])
        else:
            assert tuple(type(part) for part in value) == get_args(Point)

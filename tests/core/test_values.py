"""Types of arrays and points of every public value, also of integers: doubles, as their annotations say."""

from dataclasses import is_dataclass

import numpy as np

import core
from core.values import Floats, Point
from tests.core.test_display import DANCE, INPUTS, hints, parts, results


def test_arrays_hold_doubles_and_points_two_floats():
    line = core.Line((0, 0), (9, 0))
    of_integers = [core.trajectory(DANCE, [0, 300]), core.first_contact(DANCE, start=410)]
    course = core.course(core.Route([line]), core.Dragon(2))
    dragon = core.Dragon.of([3, 2], [1, 1], [0, 0])
    for one in filter(is_dataclass, parts([*results(), *INPUTS, *of_integers, course, dragon, line])):
        for name, hint in hints(type(one)).items():
            value = getattr(one, name)
            if hint == Floats:
                assert type(value) is np.ndarray
                assert value.dtype == np.float64
            elif value is not None and hint in (Point, Point | None):
                assert [*map(type, value)] == [float, float]

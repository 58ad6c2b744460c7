"""Numbers of users: in range they become floats, else the error names the value, its unit and the limit."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from core import InvalidValue, Spiral
from core.values import SIZE_MAX, SIZE_MIN, checked_number, checked_size, checked_type

pytestmark = pytest.mark.uncompiled


@pytest.mark.parametrize("value", [0.0, 2, 3.0, np.float64(1.5), np.int64(2), Fraction(1, 2)], ids=repr)
def test_a_number_in_range_is_a_float(value: Any) -> None:
    number = checked_number("time", value, "s", 0.0, 3.0)
    assert type(number) is float
    assert number == value


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (3.5, "time must be at most 3 s, got 3.5 s"),
        (0.5, "time must be at least 1 s, got 0.5 s"),
        (math.inf, "time must be a finite number, got inf s"),
        (math.nan, "time must be a finite number, got nan s"),
        ("2", "time must be a number, got '2'"),
        (True, "time must be a number, got True"),
        (None, "time must be a number, got None"),
        (2j, "time must be a number, got 2j"),
        (Decimal(2), "time must be a number, got Decimal('2')"),
        (10**400, "time must be from 1 to 3 s, got 1e308 or more"),
    ],
)
def test_what_is_no_number_in_range_is_refused(value: Any, said: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_number("time", value, "s", 1.0, 3.0)
    assert refused.value.field == "time"
    assert refused.value.message == said


def test_a_range_may_be_open_at_zero() -> None:
    assert checked_number("turns", 0.0, "turns", 0.0, 1.0) == 0.0
    with pytest.raises(InvalidValue, match=r"^turns must be positive, got 0 turns$"):
        checked_number("turns", 0.0, "turns", 0.0, 1.0, open_low=True)


def test_a_number_without_a_unit_is_told_without_one() -> None:
    with pytest.raises(InvalidValue, match=r"^ratio must be at most 3, got 4$"):
        checked_number("ratio", 4.0, "", 1.0, 3.0)


@pytest.mark.parametrize("value", [SIZE_MIN, 1, SIZE_MAX])
def test_a_size_at_its_limits_is_accepted(value: float) -> None:
    assert checked_size("width", value) == value


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (0.0, "width must be positive, got 0 m"),
        (-0.3, "width must be positive, got -0.3 m"),
        (0.5 * SIZE_MIN, "width must be at least 0.001 m, got 0.0005 m"),
        (2.0 * SIZE_MAX, "width must be at most 10000 m, got 20000 m"),
    ],
)
def test_a_size_beyond_its_limits_is_refused(value: float, said: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_size("width", value)
    assert refused.value.message == said


def test_a_value_of_another_type_is_refused_by_what_it_must_be() -> None:
    checked_type("path", Spiral(), Spiral)
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral or a dict, got 'spiral'$"):
        checked_type("path", "spiral", (Spiral, dict))
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral, got the class Spiral$"):
        checked_type("path", Spiral, Spiral)

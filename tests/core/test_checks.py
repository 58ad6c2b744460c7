"""Numbers of users: in range they become floats, else the error names the value, its unit and the limit."""

import math
from fractions import Fraction

import numpy as np
import pytest

from core import Spiral
from core.checks import SIZE_MAX, SIZE_MIN, checked_list, checked_number, checked_size, checked_type
from core.errors import InvalidValue
from core.quantities import Given
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled


def number(name="time", value=3.5, unit="s", low=1.0, **options):
    return lambda: checked_number(name, value, unit, low, 3.0, **options)


@pytest.mark.parametrize(
    "message, call",
    [
        ("time must be at most 3 s, got 3.5 s", number()),
        ("time must be at least 1 s, got 0.5 s", number(value=0.5)),
        ("time must be a finite number, got nan s", number(value=math.nan)),
        ("time must be a number, got True", number(value=True)),
        ("time must be from 1 to 3 s, got 1e308 or more", number(value=10**400)),
        ("turns must be positive, got 0 turns", number("turns", 0.0, "turns", 0.0, open_low=True)),
        ("width must be positive, got -0.3 m", lambda: checked_size("width", -0.3)),
        ("width must be at least 0.001 m, got 0.0005 m", lambda: checked_size("width", 0.5 * SIZE_MIN)),
        ("path must be a Spiral or a dict, got 'spiral'", lambda: checked_type("path", "spiral", (Spiral, dict))),
        ("path must be a Spiral, got the class Spiral", lambda: checked_type("path", Spiral, Spiral)),
    ],
)
def test_what_is_no_such_value_is_refused_with_its_unit_and_limit(message, call):
    with pytest.raises(InvalidValue) as caught:
        call()
    assert caught.value.field == message.split()[0]
    assert caught.value.message == message


@pytest.mark.parametrize("value", [SIZE_MIN, 1, np.float64(1.5), np.int64(2), Fraction(1, 2), SIZE_MAX], ids=repr)
def test_a_size_in_range_is_a_float(value):
    size = checked_size("width", value)
    assert type(size) is float
    assert size == value


@pytest.mark.parametrize("value", [(1, 2), iter([1, 2])])
def test_a_sequence_is_listed(value):
    assert checked_list("points", value, "a list of points") == [1, 2]


@pytest.mark.parametrize("value", ["ab", b"ab", {"a": 1}, 7, None])
def test_what_is_no_sequence_is_refused_with_what_it_must_be(value):
    with refused("points", got=Given(value)):
        checked_list("points", value, "a list of points")

"""The tree of errors: codes for programs, and messages with the caller's names.

Numbers of users: in range they become floats, else the error names the value, its unit and the limit.
"""

from __future__ import annotations

import copy
import math
import pickle
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import core.errors
from core import Spiral
from core.errors import (
    SIZE_MAX,
    SIZE_MIN,
    BenchDragonError,
    Given,
    InvalidValue,
    Parameter,
    Quantity,
    TooLarge,
    TooMuchWork,
    checked_list,
    checked_number,
    checked_size,
    checked_type,
    fill_template,
    format_bound,
    format_field,
    format_number,
    quantities,
)

pytestmark = pytest.mark.uncompiled

KINDS = [kind for kind in vars(core.errors).values() if isinstance(kind, type) and issubclass(kind, BenchDragonError)]


def test_every_error_has_a_code_of_its_own_and_stands_in_the_tree() -> None:
    assert len({kind.code for kind in KINDS}) == len(KINDS) == 6
    assert [kind.__name__ for kind in KINDS if kind.__name__ not in str(core.errors.__doc__)] == []


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_an_error_is_a_template_what_was_given_and_a_reason(kind: type[BenchDragonError]) -> None:
    message = quantities("s", got=12.5, limit=9.0)
    error = kind("times.3", "must be at most {limit}: the run ends there", **message, unused="a word that is not there")
    assert error.message == str(error) == "times[3] must be at most 9 s, got 12.5 s: the run ends there"
    assert (error.field, error.template, error.reason) == (
        "times.3",
        "{field} must be at most {limit}",
        "the run ends there",
    )
    assert (error.got, error.values) == (
        Quantity(12.5, "s"),
        {"field": Parameter("times.3"), "limit": Quantity(9.0, "s")},
    )
    other = error.with_field("stop", Quantity(25.0, "s"))
    assert (type(other), other.field, other.got) == (kind, "stop", Quantity(25.0, "s"))
    assert other.message == "stop must be at most 9 s, got 25 s: the run ends there"
    assert error.message == "times[3] must be at most 9 s, got 12.5 s: the run ends there"


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_an_error_reaches_another_process_whole(kind: type[BenchDragonError]) -> None:
    error = kind("pitch", "must be at least {low}: {why}", got=Given("x"), low=Quantity(1.0, "m"), why="so it is")
    for other in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert (type(other), vars(other), str(other), other.args) == (kind, vars(error), str(error), error.args)


def test_an_error_about_what_no_other_process_can_have_is_told_there_all_the_same() -> None:
    error = InvalidValue("width", "must be a number", got=Given(lambda: 1))
    other = pickle.loads(pickle.dumps(error))
    assert (type(other), other.message, str(other.got)) == (InvalidValue, error.message, str(error.got))


def test_a_sentence_of_its_own_stays_the_same_under_another_name() -> None:
    long = TooLarge.in_words("benches", "the dragon has {benches} benches", benches=9).with_field("dragon")
    assert (long.field, long.message, str(long)) == ("dragon", *2 * ("the dragon has 9 benches",))


def test_the_other_parameters_of_a_message_get_their_new_names_too() -> None:
    error = InvalidValue("times.stop", "must not be before {start} by {count}", start=Parameter("times.start"), count=2)
    assert error.message == "times.stop must not be before times.start by 2"
    renamed = error.renamed(lambda name: f"--{name.removeprefix('times.')}", count=3)
    assert (renamed.field, renamed.message) == ("--stop", "--stop must not be before --start by 3")


def test_what_was_stopped_stays_so_under_another_name() -> None:
    error = TooMuchWork("pitch", "was not found")
    error.stopped = True
    assert error.with_field("width").stopped
    assert not TooMuchWork("pitch", "was not found").with_field("width").stopped


@pytest.mark.parametrize("value", [0.0, 2, 3.0, np.float64(1.5), np.int64(2), Fraction(1, 2)], ids=repr)
def test_a_number_in_range_is_a_float(value: Any) -> None:
    number = checked_number("time", value, "s", 0.0, 3.0)
    assert type(number) is float
    assert number == value


@pytest.mark.parametrize(
    ("value", "message"),
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
def test_what_is_no_number_in_range_is_refused(value: Any, message: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_number("time", value, "s", 1.0, 3.0)
    assert refused.value.field == "time"
    assert refused.value.message == message


def test_a_range_may_be_open_at_zero() -> None:
    assert checked_number("turns", 0.0, "turns", 0.0, 1.0) == 0.0
    with pytest.raises(InvalidValue, match=r"^turns must be positive, got 0 turns$"):
        checked_number("turns", 0.0, "turns", 0.0, 1.0, open_low=True)


def test_a_number_without_a_unit_is_displayed_without_one() -> None:
    with pytest.raises(InvalidValue, match=r"^ratio must be at most 3, got 4$"):
        checked_number("ratio", 4.0, "", 1.0, 3.0)


@pytest.mark.parametrize("value", [SIZE_MIN, 1, SIZE_MAX])
def test_a_size_at_its_limits_is_accepted(value: float) -> None:
    assert checked_size("width", value) == value


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (0.0, "width must be positive, got 0 m"),
        (-0.3, "width must be positive, got -0.3 m"),
        (0.5 * SIZE_MIN, "width must be at least 0.001 m, got 0.0005 m"),
        (2.0 * SIZE_MAX, "width must be at most 10000 m, got 20000 m"),
    ],
)
def test_a_size_beyond_its_limits_is_refused(value: float, message: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_size("width", value)
    assert refused.value.message == message


def test_a_value_of_another_type_is_refused_by_what_it_must_be() -> None:
    checked_type("path", Spiral(), Spiral)
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral or a dict, got 'spiral'$"):
        checked_type("path", "spiral", (Spiral, dict))
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral, got the class Spiral$"):
        checked_type("path", Spiral, Spiral)


def test_what_a_caller_gave_may_hold_braces() -> None:
    assert InvalidValue("pitch", "must be a number", got=Given({"low": 1}), low=2).message.endswith("got {'low': 1}")
    assert fill_template("{a} and {b}", {"a": "{b}", "b": 1.0}) == "{b} and 1"


@pytest.mark.parametrize("number", [432.9179242286, -432.9179242286, 0.1, -0.1, 1e-12, 5.0])
@pytest.mark.parametrize("decimals", [0, 3, 9])
def test_a_bound_is_rounded_to_the_side_on_which_it_is_true(number: float, decimals: int) -> None:
    low, high = (float(format_bound(number, decimals, up=up)) for up in (False, True))
    assert low <= number <= high
    assert high - low <= 1.000001 * 10.0**-decimals


def test_numbers_and_fields_are_written_as_people_do() -> None:
    assert [format_number(number) for number in (9.0, -0.0, 1e300, 0.1 + 0.2)] == [
        "9",
        "0",
        "1e+300",
        "0.30000000000000004",
    ]
    assert format_field("path.pieces.0.points.12") == "path.pieces[0].points[12]"
    assert format_field("dragon.width") == "dragon.width"


@pytest.mark.parametrize("value", [[1, 2], (1, 2), range(1, 3), iter([1, 2])])
def test_a_sequence_is_listed(value: Any) -> None:
    assert checked_list("points", value, "a list of points") == [1, 2]


@pytest.mark.parametrize("value", ["ab", b"ab", {"a": 1}, 7, None])
def test_what_is_no_sequence_is_refused_with_what_it_must_be(value: Any) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_list("points", value, "a list of points")
    assert refused.value.message == f"points must be a list of points, got {value!r}"

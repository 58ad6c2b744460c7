"""The tree of errors: codes for programs, and messages with the caller's names.

Numbers of users: in range they become floats, else the error names the value, its unit and the limit.
"""

import copy
import math
import pickle
from fractions import Fraction

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
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

KINDS = [kind for kind in vars(core.errors).values() if isinstance(kind, type) and issubclass(kind, BenchDragonError)]
EVERY_KIND = pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)


def test_every_error_has_a_code_of_its_own_and_stands_in_the_tree():
    assert len({kind.code for kind in KINDS}) == len(KINDS)
    assert [kind.__name__ for kind in KINDS if kind.__name__ not in core.errors.__doc__] == []


@EVERY_KIND
def test_an_error_is_a_template_what_was_given_and_a_reason(kind):
    rule = "must be at most {limit}: the run ends there"
    error = kind("times.3", rule, **quantities("s", got=12.5, limit=9.0), unused="a word that is not there")
    words = "must be at most 9 s, got {} s: the run ends there"
    assert error.message == str(error) == f"times[3] {words.format(12.5)}"
    assert error.template == "{field} must be at most {limit}"
    assert error.reason == "the run ends there"
    assert error.field == "times.3"
    assert error.got == Quantity(12.5, "s")
    assert error.values == {"field": Parameter("times.3"), "limit": Quantity(9.0, "s")}
    other = error.with_field("stop", Quantity(25.0, "s"))
    assert (type(other), other.field, other.got) == (kind, "stop", Quantity(25.0, "s"))
    assert other.message == f"stop {words.format(25)}"
    assert error.message == f"times[3] {words.format(12.5)}"


@EVERY_KIND
def test_an_error_reaches_another_process_whole(kind):
    error = kind("pitch", "must be at least {low}: {why}", got=Given("x"), low=Quantity(1.0, "m"), why="so it is")
    for other in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert (type(other), vars(other), str(other), other.args) == (kind, vars(error), str(error), error.args)
    error = kind("width", "must be a number", got=Given(lambda: 1))  # which no other process can have
    assert pickle.loads(pickle.dumps(error)).message == error.message


def test_a_sentence_of_its_own_stays_the_same_under_another_name():
    long = TooLarge.in_words("benches", "the dragon has {benches} benches", benches=9).with_field("dragon")
    assert (long.field, long.message, str(long)) == ("dragon", *2 * ("the dragon has 9 benches",))


def test_the_other_parameters_of_a_message_get_their_new_names_too():
    error = InvalidValue("times.stop", "must not be before {start} by {count}", start=Parameter("times.start"), count=2)
    assert error.message == "times.stop must not be before times.start by 2"
    renamed = error.renamed(lambda name: f"--{name.removeprefix('times.')}", count=3)
    assert renamed.field == "--stop"
    assert renamed.message == "--stop must not be before --start by 3"


@pytest.mark.parametrize("stopped", [True, False])
def test_what_was_stopped_stays_so_under_another_name(stopped):
    error = TooMuchWork("pitch", "was not found")
    error.stopped = stopped
    assert error.with_field("width").stopped is stopped


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


def test_what_a_caller_gave_may_hold_braces():
    assert InvalidValue("pitch", "must be a number", got=Given({"low": 1}), low=2).message.endswith("got {'low': 1}")
    assert fill_template("{a} and {b}", {"a": "{b}", "b": 1.0}) == "{b} and 1"


@pytest.mark.parametrize("number", [432.9179242286, -432.9179242286, 0.1, -0.1, 1e-12, 5.0])
@pytest.mark.parametrize("decimals", [0, 3, 9])
def test_a_bound_is_rounded_to_the_side_on_which_it_is_true(number, decimals):
    low, high = (float(format_bound(number, decimals, up=up)) for up in (False, True))
    assert low <= number <= high <= low + 1.000001 * 10.0**-decimals


def test_numbers_and_fields_are_written_as_people_do():
    words = "9 0 1e+300 0.30000000000000004"
    assert " ".join(map(format_number, (9.0, -0.0, 1e300, 0.1 + 0.2))) == words
    assert format_field("path.pieces.0.points.12") == "path.pieces[0].points[12]"


@pytest.mark.parametrize("value", [(1, 2), iter([1, 2])])
def test_a_sequence_is_listed(value):
    assert checked_list("points", value, "a list of points") == [1, 2]


@pytest.mark.parametrize("value", ["ab", b"ab", {"a": 1}, 7, None])
def test_what_is_no_sequence_is_refused_with_what_it_must_be(value):
    with refused("points", got=Given(value)):
        checked_list("points", value, "a list of points")

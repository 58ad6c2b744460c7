"""The tree of errors: codes for programs, and messages with the caller's names."""

import copy
import pickle

import pytest

import core.errors
from core.errors import BenchDragonError, InvalidValue, TooLarge, TooMuchWork
from core.quantities import (
    Given,
    Parameter,
    Quantity,
    quantities,
)

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

"""The tree of errors: codes for programs, and messages with the caller's names."""

from __future__ import annotations

import pytest

import core.errors
from core.errors import BenchDragonError, InvalidValue, TooLarge, TooMuchWork, said, said_bound, spoken

KINDS = [kind for kind in vars(core.errors).values() if isinstance(kind, type) and issubclass(kind, BenchDragonError)]


def test_every_error_has_a_code_of_its_own_and_stands_in_the_tree() -> None:
    assert len({kind.code for kind in KINDS}) == len(KINDS) == 6
    assert [kind.__name__ for kind in KINDS if kind.__name__ not in str(core.errors.__doc__)] == []


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_number_that_breaks_a_rule_is_named_with_its_unit_and_why(kind: type[BenchDragonError]) -> None:
    error = kind.of("times.3", "must be at most 9 s: the run ends there", 12.5, "s")
    assert error.message == str(error) == "times[3] must be at most 9 s, got 12.5 s: the run ends there"
    assert (error.field, error.got) == ("times.3", 12.5)
    other = error.named("stop", 25.0)
    assert (type(other), other.field, other.got) == (kind, "stop", 25.0)
    assert other.message == "stop must be at most 9 s, got 25 s: the run ends there"


def test_a_message_without_a_number_changes_its_first_words_alone() -> None:
    error = InvalidValue("path.pieces.1", "path.pieces[1] must close up with path.pieces[0]")
    assert error.named("path").message == "path must close up with path.pieces[0]"
    assert TooLarge("benches", "the dragon is too long").named("dragon").message == "the dragon is too long"


def test_the_other_parameters_of_a_message_get_their_new_names_too() -> None:
    error = InvalidValue("times.stop", "{field} must not be before {start}", start="times.start")
    assert error.message == "times.stop must not be before times.start"
    renamed = error.renamed(lambda name: f"--{name.removeprefix('times.')}")
    assert (renamed.field, renamed.message) == ("--stop", "--stop must not be before --start")


def test_what_was_stopped_stays_so_under_another_name() -> None:
    error = TooMuchWork("pitch", "pitch was not found")
    error.stopped = True
    assert error.named("width").stopped
    assert not TooMuchWork("pitch", "pitch was not found").named("width").stopped


@pytest.mark.parametrize("number", [432.9179242286, -432.9179242286, 0.1, -0.1, 1e-12, 5.0])
@pytest.mark.parametrize("decimals", [0, 3, 9])
def test_a_bound_is_rounded_to_the_side_on_which_it_is_true(number: float, decimals: int) -> None:
    low, high = (float(said_bound(number, decimals, side)) for side in (-1, 1))
    assert low <= number <= high
    assert high - low <= 1.000001 * 10.0**-decimals


def test_numbers_and_fields_are_written_as_people_do() -> None:
    assert [said(number) for number in (9.0, -0.0, 1e300, 0.1 + 0.2)] == ["9", "0", "1e+300", "0.30000000000000004"]
    assert spoken("path.pieces.0.points.12") == "path.pieces[0].points[12]"
    assert spoken("dragon.width") == "dragon.width"

"""Numbers and fields in sentences: as people write them, and rounded to the side on which a bound is true."""

import pytest

from core import Dance, Dragon
from core.errors import InvalidValue
from core.language import speaking
from core.quantities import Given, fill_template, format_bound, format_field, format_number, with_article

pytestmark = pytest.mark.uncompiled


def test_an_object_that_a_caller_gave_is_named_by_its_kind_in_the_language_spoken():
    values = [Given(Dragon()), Given([Dragon()] * 2), Given(Dragon)]
    assert [str(value) for value in values] == ["a Dragon", "a list", "the class Dragon"]
    with speaking("zh"):
        message = InvalidValue("dance", "must be {kinds}", got=values[0], kinds=with_article(Dance, Dragon)).message
    assert message == "dance 应为 Dance 对象或 Dragon 对象，现为 Dragon 对象"


def test_what_a_caller_gave_may_hold_braces():
    assert InvalidValue("pitch", "must be a number", got=Given({"low": 1}), low=2).message.endswith("got {'low': 1}")
    assert str(Given("x" * 99)) == f"'{'x' * 59}..."
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

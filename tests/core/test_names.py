"""Names that a caller gave."""

import pytest

from core.errors import InvalidValue
from core.names import NAME_MAX, checked_name

pytestmark = pytest.mark.uncompiled
LONG = "n" * (NAME_MAX + 1)


@pytest.mark.parametrize(
    "name, message",
    [
        (7, "must be a string, got 7"),
        (LONG, f"must have at most {NAME_MAX} characters, got {NAME_MAX + 1}"),
        ("a\nb", "must be one line of plain text, got 'a\\nb'"),
        ("Li\u202e.csv", "must be one line of plain text, got 'Li\\u202e.csv'"),
        ("\ud800", "must be one line of plain text, got '\\ud800'"),
        # A noncharacter, which XML cannot hold.
        ("\U0001ffff", "must be one line of plain text, got '\\U0001ffff'"),
    ],
)
@pytest.mark.parametrize("what, before", [("", "venue"), ("the name of a polygon", "the name of a polygon")])
def test_a_name_is_one_line_of_plain_text(name, message, what, before):
    with pytest.raises(InvalidValue) as caught:
        checked_name("venue", name, what)
    assert caught.value.field == "venue"
    assert caught.value.message == f"{before} {message}"


@pytest.mark.parametrize("name", ["", "Zhou", "\u5468\u5bb6", LONG[1:]])
def test_a_plain_name_is_accepted(name):
    checked_name("dragon.names.0", name)

"""Names that a caller gave."""

from __future__ import annotations

import pytest

from core.errors import InvalidValue
from core.names import NAME_MAX, checked_name

pytestmark = pytest.mark.uncompiled


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (7, "must be a string, got 7"),
        ("n" * (NAME_MAX + 1), f"must have at most {NAME_MAX} characters, got {NAME_MAX + 1}"),
        ("a\nb", "must be one line of plain text, got 'a\\nb'"),
        ("Li\u202e.csv", "must be one line of plain text, got 'Li\\u202e.csv'"),
        ("\ud800", "must be one line of plain text, got '\\ud800'"),
    ],
)
def test_a_name_is_one_line_of_plain_text(name: object, message: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        checked_name("dragon.names.3", name)
    assert refused.value.message == f"dragon.names[3] {message}"
    with pytest.raises(InvalidValue) as refused:
        checked_name("venue", name, "the name of a polygon")
    assert (refused.value.field, refused.value.message) == ("venue", f"the name of a polygon {message}")


def test_a_plain_name_is_accepted() -> None:
    for name in ("", "Zhou", "\u5468\u5bb6", "n" * NAME_MAX):
        checked_name("dragon.names.0", name)

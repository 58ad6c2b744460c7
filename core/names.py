"""Check of the names that a caller gave."""

from __future__ import annotations

from unicodedata import category

from core.errors import InvalidValue
from core.quantities import Given, Value

# Longest name of a bench or an area [characters].
NAME_MAX = 200
# Unicode's categories of control characters, half characters, and ends of lines and paragraphs.
UNPRINTABLE = ("Cc", "Cs", "Zl", "Zp")
# Characters that turn the direction of writing around for what follows, beyond the name (Unicode, report 9).
TURNING = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
# Characters that no text holds, such as U+FFFE, and that XML forbids: two at the end of each plane, and these.
NONCHARACTERS = range(0xFDD0, 0xFDF0)


def is_printable(character: str) -> bool:
    """True for a character that a line of text may hold."""
    code = ord(character)
    return category(character) not in UNPRINTABLE and code & 0xFFFE != 0xFFFE and code not in NONCHARACTERS


def checked_name(field: str, name: object, what: str = "") -> None:
    """Refuse a name that is not one line of plain text, because it appears in sentences and figures.

    what: the beginning of the message, if it is not the field
    raises: InvalidValue
    """
    got: Value = Given(name, f"{name!a:.60}" if isinstance(name, str) else "")
    if not isinstance(name, str):
        rule = "must be a string"
    elif len(name) > NAME_MAX:
        rule, got = "must have at most {most} characters", len(name)
    elif not all(is_printable(one) and one not in TURNING for one in name):
        rule = "must be one line of plain text"
    else:
        return
    if what:
        raise InvalidValue.in_words(field, f"{{what}} {rule}", got=got, what=what, most=NAME_MAX)
    raise InvalidValue(field, rule, got=got, most=NAME_MAX)

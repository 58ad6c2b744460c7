"""Numbers, texts and names of parameters as they stand in a sentence: with their unit, in the language spoken."""

from __future__ import annotations

import re
from collections.abc import Mapping
from numbers import Real
from typing import Any, NamedTuple, Self

from core.language import Listed, Phrases, phrase, say, say_clauses

# Units that are words, which each language has its own for.
UNITS: Phrases = {"turns": "turns", "degrees": "degrees"}
# Most characters of what a caller gave in a message; the rest is cut.
GIVEN_MOST = 60
# A word in a template.
WORD = re.compile(r"\{(\w+)\}")


def say_unit(unit: str) -> str:
    """A unit in the language that is spoken: that of a turn is a word."""
    return say(UNITS[unit]) if unit in UNITS else unit


class Quantity(NamedTuple):
    """A number with its unit in a message.

    digits: significant ones in the message; by default all of them; text: the whole text there, in place of both

    >>> str(Quantity(12.5, "s")), str(Quantity(1 / 3, "m", 4)), str(Quantity(3.0, ""))
    ('12.5 s', '0.3333 m', '3')
    """

    value: float
    unit: str
    digits: int = 17
    text: str = ""

    def __str__(self) -> str:
        number = format_number(self.value) if self.digits == 17 else f"{self.value:.{self.digits}g}"
        return self.text or f"{number} {self.unit}".rstrip()

    def said(self) -> str:
        """The text in the language that is spoken."""
        return str(self).replace(self.unit, say_unit(self.unit))


class Parameter(NamedTuple):
    """A parameter in a message, by its dotted name.

    >>> from core import InvalidValue
    >>> start = Parameter("times.start")
    >>> str(InvalidValue("times.stop", "must be after {start}", got=3.0, start=start))
    'times.stop must be after times.start, got 3'
    """

    name: str

    def __str__(self) -> str:
        return format_field(self.name)


class Given(NamedTuple):
    """What a caller gave, in a message. text: its form there; by default a short repr(), or the kind of an object

    >>> from core import InvalidValue
    >>> str(InvalidValue("lengths", "must be a number", got=Given("3,41 m")))
    "lengths must be a number, got '3,41 m'"
    """

    value: object
    text: str = ""

    def __str__(self) -> str:
        return str(self.in_words())

    def said(self) -> str:
        """The text in the language that is spoken."""
        words = self.in_words()
        return words.said() if isinstance(words, Clause) else words

    def in_words(self) -> str:
        """The text, a Clause where each language has its own."""
        if self.text:
            return self.text
        if isinstance(self.value, type):
            return Clause(phrase("the class {kind}"), kind=Given(None, self.value.__name__))
        try:
            text = repr(self.value) if _is_plain(self.value) else ""
        except (RecursionError, ValueError):  # a list in itself, an integer of too many digits
            text = ""
        if not text:
            return with_article(type(self.value))
        return text if len(text) <= GIVEN_MOST else f"{text[:GIVEN_MOST]}..."

    def __reduce__(self) -> tuple[Any, ...]:
        # What a caller gave may be anything, also what no other process can have.
        can_be_sent = self.value is None or isinstance(self.value, (str, int, float))
        return Given, (self.value, self.text) if can_be_sent else (None, str(self))


def _is_plain(value: object) -> bool:
    """True for None, texts, numbers, and lists of them, whose repr() says what was given."""
    if isinstance(value, (list, tuple, dict)):
        return all(map(_is_plain, value.values() if isinstance(value, dict) else value))
    return value is None or isinstance(value, (str, bytes, Real))


def with_article(*kinds: type) -> Clause:
    """Classes in a sentence: "a Dance or a Route"."""
    kind, *others = kinds
    template = phrase("an {kind}") if kind.__name__[0] in "AEIOUaeiou" else phrase("a {kind}")
    words = Clause(template, kind=Given(None, kind.__name__))
    return Clause(phrase("{one} or {other}"), one=words, other=with_article(*others)) if others else words


class Clause(str):
    """A text in a message that each language puts in its own words.

    >>> Clause("the gates {name}", name="A")
    'the gates A'
    """

    template: str
    values: Mapping[str, Any]

    def __new__(cls, template: str, **values: Any) -> Self:
        clause = super().__new__(cls, fill_template(template, values))
        clause.template, clause.values = template, values
        return clause

    def __str__(self) -> str:
        return str.__str__(self)

    def said(self) -> str:
        """The text in the language that is spoken."""
        return fill_message(self.template, self.values)


# What may stand in a template. A number or a text stands there as it is.
Value = Quantity | Parameter | Given | Listed | int | float | str


def quantities(unit: str, digits: int = 17, /, **numbers: float) -> dict[str, Value]:
    """Values of one unit, by their words."""
    return {word: Quantity(float(number), unit, digits) for word, number in numbers.items()}


def fill_template(template: str, values: Mapping[str, Value]) -> str:
    """A template with the values in the places of their words; other words stay."""
    return WORD.sub(lambda word: format_value(values[word[1]]) if word[1] in values else word[0], template)


def fill_message(template: str, values: Mapping[str, Value]) -> str:
    """What fill_template() gives, in the language that is spoken."""
    text = say_clauses(template)
    return WORD.sub(lambda word: say_value(values[word[1]]) if word[1] in values else word[0], text)


def message_of(template: str, reason: str, got: Value | None, values: Mapping[str, Value]) -> str:
    """A refusal with the given value and the reason, in the language that is spoken."""
    got_text = "" if got is None else say(", got ") + say_value(got)
    return fill_message(template, values) + got_text + (say(": ") + fill_message(reason, values) if reason else "")


def say_value(value: Value) -> str:
    """A value as it stands in a sentence of the language that is spoken."""
    if (said := getattr(value, "said", None)) is not None:
        return str(said())
    return say(value) if isinstance(value, str) and value else format_value(value)


def format_value(value: Value) -> str:
    """A value as it stands in a sentence."""
    return format_number(value) if isinstance(value, float) else str(value)


def format_number(number: float) -> str:
    """A number for sentences: all its digits, no trailing point, and no sign before zero.

    >>> format_number(0.1 + 0.2), format_number(9.0), format_number(-0.0)
    ('0.30000000000000004', '9', '0')
    """
    return repr(float(number) + 0.0).removesuffix(".0")


def format_bound(number: float, decimals: int, *, up: bool = False) -> str:
    """A bound with some decimals, rounded to the side on which it stays true: a lower bound down, an upper one up.

    >>> format_bound(432.9179242286, 9), format_bound(16.0000001, 6, up=True)
    ('432.917924228', '16.000001')
    """
    text, side = f"{number:.{decimals}f}", 1 if up else -1
    return text if side * (float(text) - number) >= 0.0 else f"{float(text) + side * 10.0**-decimals:.{decimals}f}"


def bound(number: float, decimals: int, unit: str, *, up: bool = False) -> Quantity:
    """A bound in a message, rounded as format_bound() does."""
    text = format_bound(number, decimals, up=up)
    return Quantity(float(text), unit, text=f"{text} {unit}")


def format_field(field: str) -> str:
    """A dotted field as messages write it: path.pieces[0] for path.pieces.0."""
    return re.sub(r"\.(\d+)", r"[\1]", field)


def from_to(unit: str, low: float, high: float) -> dict[str, Value]:
    """Values of "from {least} to {most}", with the unit in the message only once."""
    return {"least": Quantity(low, unit, text=f"{low:g}"), "most": Quantity(high, unit, 6)}

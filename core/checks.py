"""Checks of what a caller gave: each hands over the value, or raises the error that names the field and the limit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import StrEnum
from numbers import Real
from typing import TYPE_CHECKING, Any, TypeVar

from core.errors import InvalidValue
from core.language import Listed
from core.quantities import Given, Quantity, from_to, quantities, with_article

if TYPE_CHECKING:  # NumPy takes as long to import as all of a process that runs jobs.
    from core.values import Point

Member = TypeVar("Member", bound=StrEnum)

# Smallest and largest size [m]: sizes outside describe no dance, and lose digits in c^2 / b^2.
SIZE_MIN = 1e-3
SIZE_MAX = 1e4
# Largest coordinate [m]: larger ones lose the digits that the chords need.
COORDINATE_MAX = 1e5
# Largest angle [rad]: larger ones lose the digits that the joints need.
ANGLE_MAX = 1e6


def checked_number(name: str, value: object, unit: str, low: float, high: float, *, open_low: bool = False) -> float:
    """The value as a float if it is a finite number in [low, high] ((low, high] with open_low).

    raises: InvalidValue naming the field, the value, its unit and the limit
    """
    if type(value) is not float and (not isinstance(value, Real) or isinstance(value, bool)):
        raise InvalidValue(name, "must be a number", got=Given(value))
    try:
        number = float(value)
    except OverflowError as error:  # an int of Python may have any number of digits
        rule = "must be from {least} to {most}"
        raise InvalidValue(name, rule, got="1e308 or more", **from_to(unit, low, high)) from error
    if low <= number <= high and math.isfinite(number) and not (open_low and number == low):
        return number
    if not math.isfinite(number):
        rule = "must be a finite number"
    elif number > high:
        rule = "must be at most {most}"
    elif number <= 0.0 <= low:
        rule = "must be positive" if open_low or low > 0.0 else "must be zero or more"
    else:
        rule = "must be at least {least}"
    raise InvalidValue(name, rule, got=Quantity(number, unit), **quantities(unit, 6, least=low, most=high))


def checked_count(name: str, value: object, low: int, high: int) -> int:
    """The value as an int if it is a whole number in [low, high]; 5.0 is one. raises: InvalidValue"""
    number = checked_number(name, value, "", float(low), float(high))
    if number != int(number):
        raise InvalidValue(name, "must be a whole number", got=number)
    return int(number)


def checked_type(name: str, value: object, kinds: type | tuple[type, ...]) -> None:
    """Check the type of a value. raises: InvalidValue naming the parameter if the value is of none of the kinds"""
    if not isinstance(value, kinds):
        words = with_article(*kinds) if isinstance(kinds, tuple) else with_article(kinds)
        raise InvalidValue(name, "must be {kinds}", got=Given(value), kinds=words)


def checked_size(name: str, value: object) -> float:
    """A positive length in [SIZE_MIN, SIZE_MAX] metres."""
    return checked_number(name, value, "m", SIZE_MIN, SIZE_MAX)


def checked_point(name: str, value: Any) -> Point:
    """The value as a point with both coordinates within COORDINATE_MAX. raises: InvalidValue"""
    try:
        x, y = value
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, "must be a point [x, y] in metres", got=Given(value)) from error
    limits = (-COORDINATE_MAX, COORDINATE_MAX)
    return (checked_number(f"{name}.0", x, "m", *limits), checked_number(f"{name}.1", y, "m", *limits))


def checked_angle(name: str, value: Any) -> float:
    """The value as an angle within ANGLE_MAX. raises: InvalidValue"""
    return checked_number(name, value, "rad", -ANGLE_MAX, ANGLE_MAX)


def checked_member(name: str, value: str, kind: type[Member]) -> Member:
    """The value as a member of an enumeration of texts. raises: InvalidValue"""
    try:
        return kind(value)
    except ValueError as error:
        raise InvalidValue(name, "must be one of {names}", got=Given(value), names=Listed(kind)) from error


def checked_list(name: str, value: Any, rule: str) -> list[Any]:
    """The entries of a value that is a sequence and not a text.

    rule: "must be a list of ..."; raises: InvalidValue naming the field
    """
    try:
        if not isinstance(value, str | bytes | Mapping):
            return list(value)
    except TypeError:
        pass
    raise InvalidValue(name, rule, got=Given(value))

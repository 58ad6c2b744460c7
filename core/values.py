"""Checks of the numbers that users give: finite, in range, in their unit."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import wraps
from numbers import Real
from typing import Any, ParamSpec, TypeVar
from unicodedata import category

import numpy as np
from numpy.typing import NDArray

from core.errors import InvalidValue, said

Floats = NDArray[np.float64]
Point = tuple[float, float]
P = ParamSpec("P")
R = TypeVar("R")

# Smallest and largest size [m]: sizes outside describe no dance, and lose digits in c^2 / b^2.
SIZE_MIN = 1e-3
SIZE_MAX = 1e4
# Largest coordinate [m]: larger ones lose the digits that the chords need.
COORDINATE_MAX = 1e5
# Largest angle [rad]: larger ones lose the digits that the joints need.
ANGLE_MAX = 1e6
# Longest name of a bench or an area [characters].
NAME_MAX = 200
# Unicode's categories of control characters, half characters, and ends of lines and paragraphs.
NOT_PLAIN = ("Cc", "Cs", "Zl", "Zp")


def checked_number(name: str, value: object, unit: str, low: float, high: float, *, open_low: bool = False) -> float:
    """The value as a float if it is a finite number in [low, high] ((low, high] with open_low).

    raises: InvalidValue naming the field, the value, its unit and the limit
    """
    if type(value) is not float and (not isinstance(value, Real) or isinstance(value, bool)):
        raise InvalidValue(name, f"{name} must be a number, got {value!r}")
    try:
        number = float(value)
    except OverflowError as error:  # an int of Python may have any number of digits
        rule = f"from {low:g} to {high:g} {unit}".rstrip()
        raise InvalidValue(name, f"{name} must be {rule}, got 1e308 or more") from error
    if low <= number <= high and math.isfinite(number) and not (open_low and number == low):
        return number
    limit_unit = f" {unit}" if unit else ""
    if not math.isfinite(number):
        rule = "a finite number"
    elif number > high:
        rule = f"at most {high:g}{limit_unit}"
    elif number <= 0.0 <= low:
        rule = "positive" if open_low or low > 0.0 else "zero or more"
    else:
        rule = f"at least {low:g}{limit_unit}"
    raise InvalidValue(name, f"{name} must be {rule}, got {said(number)}{limit_unit}")


def checked_type(name: str, value: object, kinds: type | tuple[type, ...]) -> None:
    """Check the type of a value. raises: InvalidValue naming the parameter if the value is of none of the kinds"""
    if not isinstance(value, kinds):
        words = " or a ".join(kind.__name__ for kind in (kinds if isinstance(kinds, tuple) else (kinds,)))
        plain = value is None or isinstance(value, (str, bytes, Real, list, tuple, dict))
        given = f"{value!r:.60}" if plain else f"a {type(value).__name__}"
        if isinstance(value, type):
            given = f"the class {value.__name__}"
        raise InvalidValue(name, f"{name} must be a {words}, got {given}")


def asked_of(name: str, kind: type) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorator of a question that checks the type of its first argument before Python checks the number of arguments.

    A call of the old kind with a dragon and a spiral would else get Python's message on the number of arguments, which
    does not say that the first one must be a dance.
    """

    def checking(question: Callable[P, R]) -> Callable[P, R]:
        @wraps(question)
        def asked(*args: P.args, **kwargs: P.kwargs) -> R:
            if args or name in kwargs:
                checked_type(name, args[0] if args else kwargs[name], kind)
            return question(*args, **kwargs)

        return asked

    return checking


def checked_size(name: str, value: object) -> float:
    """A positive length in [SIZE_MIN, SIZE_MAX] metres."""
    return checked_number(name, value, "m", SIZE_MIN, SIZE_MAX)


def checked_point(name: str, value: Any) -> Point:
    """The value as a point with both coordinates within COORDINATE_MAX.

    raises: InvalidValue
    """
    try:
        x, y = value
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, f"{name} must be a point [x, y] in metres, got {value!r}") from error
    limits = (-COORDINATE_MAX, COORDINATE_MAX)
    return (checked_number(f"{name}.0", x, "m", *limits), checked_number(f"{name}.1", y, "m", *limits))


def checked_angle(name: str, value: Any) -> float:
    """The value as an angle within ANGLE_MAX. raises: InvalidValue"""
    return checked_number(name, value, "rad", -ANGLE_MAX, ANGLE_MAX)


def listed(name: str, value: Any, what: str) -> list[Any]:
    """The entries of a value that is a sequence and not a text.

    raises: InvalidValue naming the field and what it must be
    """
    try:
        if not isinstance(value, str | bytes | Mapping):
            return list(value)
    except TypeError:
        pass
    raise InvalidValue(name, f"{name} must be {what}, got {value!r}")


def checked_name(what: str, name: object, field: str) -> None:
    """Refuse a name that is not one line of plain text, because it appears in sentences and figures.

    what: the beginning of the message; field: of the name
    raises: InvalidValue
    """
    if not isinstance(name, str):
        raise InvalidValue(field, f"{what} must be a text, got {name!r:.60}")
    if len(name) > NAME_MAX:
        raise InvalidValue(field, f"{what} must have at most {NAME_MAX} characters, got {len(name)}")
    if any(category(character) in NOT_PLAIN for character in name):
        raise InvalidValue(field, f"{what} must be one line of plain text, got {name!a:.60}")

"""Every error that core raises, the checks of numbers that raise them, and how a question ends. One tree:

    BenchDragonError          code, field, message
      InvalidValue            a parameter is outside what its type allows (also a ValueError)
      TooLarge                the requested work is beyond a stated limit
      TooMuchWork             an answer was not found within the work that one question may take
      OutsideRun              a time is after the end of the run, or before the whole dragon is on the path
      ProofRefused            a claim could not be proven, or a certificate does not prove its claim

A message names the field, the value, its unit and the limit. A collision is an answer, never an error.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from functools import wraps
from inspect import signature
from numbers import Real
from typing import TYPE_CHECKING, Any, ParamSpec, Self, TypeVar
from unicodedata import category

from core.kernels import Budget, Halted

if TYPE_CHECKING:  # NumPy takes as long to import as all of a process that runs jobs.
    from core.values import Point

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


class BenchDragonError(Exception):
    """Every error of this library; catch it for all of them.

    code: stable word for programs; field: dotted name of the wrong parameter
    rule: what the parameter must be, with {word} in the place of each other parameter; the message is the field, in the
        form of spoken(), and the rule. in_words() makes an error whose message does not begin with the field
    others: the other parameters by their words: names, which are spoken, or numbers, which stand as they are unless
        renamed() changes them; got: the given number, if of() made the error

    >>> InvalidValue("times.stop", "must not be before {start}", start="times.start").renamed(
    ...     lambda name: name.removeprefix("times.")
    ... ).message
    'stop must not be before start'
    """

    code = "error"
    got: float | None = None
    _unit = ""
    _is_whole = False

    def __init__(self, field: str, rule: str, **others: str | int) -> None:
        self.field, self._rule, self._others = field, rule, others
        if others:
            rule = rule.format(**{word: spoken(one) if isinstance(one, str) else one for word, one in others.items()})
        self.message = f"{spoken(field)} {rule}"
        super().__init__(self.message)

    @classmethod
    def in_words(cls, field: str, message: str) -> Self:
        """The error with this message, which stays the same whatever the field is called."""
        error = cls(field, "")
        error.message, error.args, error._is_whole = message, (message,), True
        return error

    @classmethod
    def of(cls, field: str, rule: str, got: float, unit: str) -> Self:
        """The error of a number that breaks a rule; the part of the rule after a colon, the reason, comes last.

        >>> InvalidValue.of("times.3", "must be at most 9 s", 12.5, "s").message
        'times[3] must be at most 9 s, got 12.5 s'
        """
        rule_itself, colon, why = rule.partition(": ")
        error = cls(field, f"{rule_itself}, got {f'{said(got)} {unit}'.rstrip()}{colon}{why}")
        error.got, error._rule, error._unit = got, rule, unit
        return error

    def named(self, field: str, got: float | None = None) -> Self:
        """The same error under another parameter name, and with another value if `got` is given.

        For a caller that computes the parameters of core from others, such as times from a range, or a radius from a
        diameter.
        """
        if self.got is not None:
            return type(self).of(field, self._rule, self.got if got is None else got, self._unit)
        if self._is_whole:
            return type(self).in_words(field, self.message)
        return type(self)(field, self._rule, **self._others)

    def renamed(self, name_of: Callable[[str], str], number_of: Callable[[int], int] = int) -> Self:
        """The same error with other names for its field, and other names and numbers of the others in its message."""
        error = self.named(name_of(self.field))
        if self._others:
            others = self._others.items()
            told = {word: name_of(one) if isinstance(one, str) else number_of(one) for word, one in others}
            return type(self)(error.field, self._rule, **told)
        return error


def said(number: float) -> str:
    """A number for sentences: all its digits, no trailing point, and no sign before zero.

    >>> said(0.1 + 0.2), said(9.0), said(-0.0)
    ('0.30000000000000004', '9', '0')
    """
    return repr(float(number) + 0.0).removesuffix(".0")


def said_bound(number: float, decimals: int, side: int) -> str:
    """A bound with some decimals, rounded to the side (-1: down, 1: up) on which it stays true.

    >>> said_bound(432.9179242286, 9, -1), said_bound(16.0000001, 6, 1)
    ('432.917924228', '16.000001')
    """
    text = f"{number:.{decimals}f}"
    return text if side * (float(text) - number) >= 0.0 else f"{float(text) + side * 10.0**-decimals:.{decimals}f}"


def spoken(field: str) -> str:
    """A dotted field as messages write it.

    >>> spoken("path.pieces.0.points.2")
    'path.pieces[0].points[2]'
    """
    return re.sub(r"\.(\d+)", r"[\1]", field)


class InvalidValue(BenchDragonError, ValueError):
    """A parameter is outside what its type allows."""

    code = "invalid-value"


class TooLarge(BenchDragonError):
    """The requested work is beyond a stated limit."""

    code = "too-large"


class TooMuchWork(BenchDragonError):
    """An answer was not found within the work that one question may take, or before it was stopped.

    stopped: True if another thread stopped it
    """

    code = "too-much-work"
    stopped = False

    def named(self, field: str, got: float | None = None) -> Self:
        """As in the base class; `stopped` is kept."""
        error = super().named(field, got)
        error.stopped = self.stopped
        return error


def too_much(budget: Budget, field: str, rule: str, got: float, unit: str) -> TooMuchWork:
    """The error of a question that ended early. The rule ends with a clause on the missing answer and {then}."""
    error = TooMuchWork.of(field, rule.format(then=budget.then), got, unit)
    error.stopped = budget.stopped
    return error


class OutsideRun(BenchDragonError):
    """A time is after the end of the run, or before the whole dragon is on the path."""

    code = "outside-run"


class ProofRefused(BenchDragonError):
    """A claim could not be proven, or a certificate does not prove its claim."""

    code = "proof-refused"


def checked_number(name: str, value: object, unit: str, low: float, high: float, *, open_low: bool = False) -> float:
    """The value as a float if it is a finite number in [low, high] ((low, high] with open_low).

    raises: InvalidValue naming the field, the value, its unit and the limit
    """
    if type(value) is not float and (not isinstance(value, Real) or isinstance(value, bool)):
        raise InvalidValue(name, f"must be a number, got {value!r}")
    try:
        number = float(value)
    except OverflowError as error:  # an int of Python may have any number of digits
        rule = f"from {low:g} to {high:g} {unit}".rstrip()
        raise InvalidValue(name, f"must be {rule}, got 1e308 or more") from error
    if low <= number <= high and math.isfinite(number) and not (open_low and number == low):
        return number
    if not math.isfinite(number):
        rule = "a finite number"
    elif number > high:
        rule = f"at most {high:g} {unit}".rstrip()
    elif number <= 0.0 <= low:
        rule = "positive" if open_low or low > 0.0 else "zero or more"
    else:
        rule = f"at least {low:g} {unit}".rstrip()
    raise InvalidValue(name, f"must be {rule}, got {said(number)} {unit}".rstrip())


def checked_type(name: str, value: object, kinds: type | tuple[type, ...]) -> None:
    """Check the type of a value. raises: InvalidValue naming the parameter if the value is of none of the kinds"""
    if not isinstance(value, kinds):
        words = " or a ".join(kind.__name__ for kind in (kinds if isinstance(kinds, tuple) else (kinds,)))
        plain = value is None or isinstance(value, (str, bytes, Real, list, tuple, dict))
        given = f"{value!r:.60}" if plain else f"a {type(value).__name__}"
        if isinstance(value, type):
            given = f"the class {value.__name__}"
        raise InvalidValue(name, f"must be a {words}, got {given}")


def asked_of(name: str, kind: type, found: str = "") -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorator of a question: the first argument must be of this kind, and the end of the budget raises TooMuchWork.

    found: clause on the missing answer, which {then} completes; without it the question itself raises TooMuchWork
    The type is checked before Python checks the number of arguments. Otherwise a call as in 0.1.0, with a dragon and a
    spiral, would get Python's message on that number, which does not say that the first one must be a dance.
    """

    def checking(question: Callable[P, R]) -> Callable[P, R]:
        @wraps(question)
        def asked(*args: P.args, **kwargs: P.kwargs) -> R:
            if args or name in kwargs:
                checked_type(name, args[0] if args else kwargs[name], kind)
            if (budget := kwargs.get("budget")) is not None:
                checked_type("budget", budget, Budget)
            try:
                return question(*args, **kwargs)
            except Halted as halted:
                if not found:
                    raise
                spent, given = halted.budget, signature(question).bind(*args, **kwargs).arguments
            dance = given.get("dance") or getattr(given.get("contact"), "dance", None)
            if dragon := given.get("dragon") or (dance and dance.dragon):
                rule = "must be fewer" + (", or the time asked about shorter" if dance else "")
                raise too_much(spent, "dragon.benches", f"{rule}: {found} {{then}}", dragon.benches, "")
            raise too_much(spent, "benches", f"must be fewer: {found} {{then}}", len(given["poses"]), "")

        return asked

    return checking


def checked_size(name: str, value: object) -> float:
    """A positive length in [SIZE_MIN, SIZE_MAX] metres."""
    return checked_number(name, value, "m", SIZE_MIN, SIZE_MAX)


def checked_point(name: str, value: Any) -> Point:
    """The value as a point with both coordinates within COORDINATE_MAX. raises: InvalidValue"""
    try:
        x, y = value
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, f"must be a point [x, y] in metres, got {value!r}") from error
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
    raise InvalidValue(name, f"must be {what}, got {value!r}")


def checked_name(field: str, name: object, what: str = "") -> None:
    """Refuse a name that is not one line of plain text, because it appears in sentences and figures.

    what: the beginning of the message, if it is not the field
    raises: InvalidValue
    """
    if not isinstance(name, str):
        rule = f"must be a string, got {name!r:.60}"
    elif len(name) > NAME_MAX:
        rule = f"must have at most {NAME_MAX} characters, got {len(name)}"
    elif any(category(one) in NOT_PLAIN for one in name):
        rule = f"must be one line of plain text, got {name!a:.60}"
    else:
        return
    raise InvalidValue.in_words(field, f"{what} {rule}") if what else InvalidValue(field, rule)

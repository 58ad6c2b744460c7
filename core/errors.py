"""Every error that core raises, one tree:

    BenchDragonError          code, field, message
      InvalidValue            a parameter is outside what its type allows (also a ValueError)
      TooLarge                the requested work is beyond a stated limit
      TooMuchWork             an answer was not found within the work that one question may take
      OutsideRun              an instant lies after the end of the run (fold, centre or end of path)
      ProofRefused            a claim could not be proven, or a certificate does not prove its claim

A message names the field, the value, its unit and the limit. A collision is an answer, never an error.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Self


class BenchDragonError(Exception):
    """Root of the tree.

    code: stable word for programs; field: dotted name of the wrong parameter, which the message contains in the form
    of spoken(); got: the given number, if of() made the error
    others: further parameters in the message, which then has {word} and {field} in their places

    >>> InvalidValue("times.stop", "{field} must not be before {start}", start="times.start").renamed(
    ...     lambda name: name.removeprefix("times.")
    ... ).message
    'stop must not be before start'
    """

    code = "error"
    got: float | None = None
    _rule = ""
    _unit = ""

    def __init__(self, field: str, message: str, **others: str) -> None:
        self._template, self._others = message, others
        if others:
            message = message.format(field=spoken(field), **{word: spoken(name) for word, name in others.items()})
        elif spoken(field) != field:
            message = message.replace(field, spoken(field), 1)
        super().__init__(message)
        self.field = field
        self.message = message

    @classmethod
    def of(cls, field: str, rule: str, got: float, unit: str) -> Self:
        """The error of a number that breaks a rule; the part of the rule after a colon, the reason, comes last.

        >>> InvalidValue.of("times.3", "must be at most 9 s", 12.5, "s").message
        'times[3] must be at most 9 s, got 12.5 s'
        """
        rule_itself, colon, why = rule.partition(": ")
        value = f"{said(got)} {unit}".rstrip()
        error = cls(field, f"{spoken(field)} {rule_itself}, got {value}{colon}{why}")
        error.got, error._rule, error._unit = got, rule, unit
        return error

    def named(self, field: str, got: float | None = None) -> Self:
        """The same error under another parameter name, and with another value if `got` is given.

        For a caller that computes the parameters of core from others, such as times from a range, or a radius from a
        diameter.
        """
        if self.got is not None:
            return type(self).of(field, self._rule, self.got if got is None else got, self._unit)
        old = spoken(self.field)
        if self.message.startswith(old):
            return type(self)(field, spoken(field) + self.message[len(old) :])
        return type(self)(field, self.message)

    def renamed(self, name_of: Callable[[str], str]) -> Self:
        """The same error with other names for its field and for the other parameters in its message."""
        if self._others:
            return type(self)(name_of(self.field), self._template, **{k: name_of(v) for k, v in self._others.items()})
        return self.named(name_of(self.field))


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
    """A dotted field in the notation of people.

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


class OutsideRun(BenchDragonError):
    """An instant lies after the end of the run."""

    code = "outside-run"


class ProofRefused(BenchDragonError):
    """A claim could not be proven, or a certificate does not prove its claim."""

    code = "proof-refused"

"""Every error that core raises, one tree:

    BenchDragonError          code, field, message
      InvalidValue            a parameter is outside what its type allows (also a ValueError)
      TooLarge                the work asked for is beyond a stated limit
      TooMuchWork             an answer was not found within the work that one question may take
      OutsideRun              an instant lies after the end of the run (fold, centre or end of path)
      ProofRefused            a claim could not be proven, or a certificate does not prove what it says

A message names the field, the value, its unit and the limit. A collision is an answer, never an error.
"""

from __future__ import annotations

import re
from typing import Self


class BenchDragonError(Exception):
    """Root of the tree.

    code: stable word for programs; field: the parameter at fault, dotted; got: the number given, where of() made it
    """

    code = "error"
    got: float | None = None
    _rule = ""
    _unit = ""

    def __init__(self, field: str, message: str) -> None:
        super().__init__(message)
        self.field = field
        self.message = message

    @classmethod
    def of(cls, field: str, rule: str, got: float, unit: str) -> Self:
        """The error of a number that breaks a rule.

        >>> InvalidValue.of("times.3", "must be at most 9 s", 12.5, "s").message
        'times[3] must be at most 9 s, got 12.5 s'
        """
        error = cls(field, f"{_spoken(field)} {rule}, got {got:.12g} {unit}".rstrip())
        error.got, error._rule, error._unit = got, rule, unit
        return error

    def named(self, field: str, got: float | None = None) -> Self:
        """The same error about a parameter of another name, and of another value where `got` is given.

        For a caller whose own parameters became those of core: a range of times, a diameter.
        """
        if self.got is not None:
            return type(self).of(field, self._rule, self.got if got is None else got, self._unit)
        for old in (_spoken(self.field), re.sub(r"\.(\d+)$", r"[\1]", self.field), self.field):
            if self.message.startswith(old):
                return type(self)(field, _spoken(field) + self.message[len(old) :])
        return type(self)(field, self.message)


def _spoken(field: str) -> str:
    """A dotted field as people write it: times.3 -> times[3]."""
    return re.sub(r"\.(\d+)", r"[\1]", field)


class InvalidValue(BenchDragonError, ValueError):
    """A parameter is outside what its type allows."""

    code = "invalid-value"


class TooLarge(BenchDragonError):
    """The work asked for is beyond a stated limit."""

    code = "too-large"


class TooMuchWork(BenchDragonError):
    """An answer was not found within the work that one question may take."""

    code = "too-much-work"


class OutsideRun(BenchDragonError):
    """An instant lies after the end of the run."""

    code = "outside-run"


class ProofRefused(BenchDragonError):
    """A claim could not be proven, or a certificate does not prove what it says."""

    code = "proof-refused"

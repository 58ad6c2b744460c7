"""Every error that core raises, one tree:

    BenchDragonError          code, field, message
      InvalidValue            a parameter is outside what its type allows (also a ValueError)
      TooLarge                the work asked for is beyond a stated limit
      OutsideRun              an instant lies after the end of the run (fold, centre or end of path)
      ProofRefused            a claim could not be proven, or a certificate does not prove what it says

A message names the field, the value, its unit and the limit. A collision is an answer, never an error.
"""

from __future__ import annotations


class BenchDragonError(Exception):
    """Root of the tree. code: stable word for programs; field: the parameter at fault, dotted."""

    code = "error"

    def __init__(self, field: str, message: str) -> None:
        super().__init__(message)
        self.field = field
        self.message = message


class InvalidValue(BenchDragonError, ValueError):
    """A parameter is outside what its type allows."""

    code = "invalid-value"


class TooLarge(BenchDragonError):
    """The work asked for is beyond a stated limit."""

    code = "too-large"


class OutsideRun(BenchDragonError):
    """An instant lies after the end of the run."""

    code = "outside-run"


class ProofRefused(BenchDragonError):
    """A claim could not be proven, or a certificate does not prove what it says."""

    code = "proof-refused"

"""Every error that core raises, in one tree:

    BenchDragonError          code, field, template, got, reason, values, message
      InvalidValue            a parameter is outside what its type allows (also a ValueError)
      TooLarge                the requested work is beyond a stated limit
      TooMuchWork             an answer was not found within the work that one question may take
      OutsideRun              a time is after the end of the run, or before the whole dragon is on the path
      ProofRefused            a claim could not be proven, or a certificate does not prove its claim

A message names the field, the value, its unit and the limit. A collision is an answer, never an error.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import copy
from copyreg import __newobj__  # type: ignore[attr-defined]
from typing import Any, Self

from core.quantities import WORD, Parameter, Value, message_of


class BenchDragonError(Exception):
    """Every error of this library; catch it for all of them.

    code:     stable word for programs
    field:    dotted name of the wrong parameter
    template: what the parameter must be, with {field} in its place and {word} in the place of each value
    got:      the given value; None if the template names it
    reason:   template of the reason, or of what to change; empty without one
    values:   of both templates, by their words
    message:  the sentence: the template, the given value, and the reason, in the language spoken when it is raised;
              the others are English in every language

    >>> start = Parameter("times.start")
    >>> error = InvalidValue("times.stop", "must be after {start}: it is earlier", got=3.0, start=start)
    >>> error.renamed(lambda name: name.removeprefix("times.")).message
    'stop must be after start, got 3: it is earlier'
    """

    code = "error"

    def __init__(self, field: str, rule: str, /, *, got: Value | None = None, **values: Value) -> None:
        """rule: the rest of the template after the field; what follows a colon is the reason"""
        rule, _, reason = rule.partition(": ")
        self.compose(field, f"{{field}} {rule}", reason, got, {"field": Parameter(field), **values})

    def compose(self, field: str, template: str, reason: str, got: Value | None, values: Mapping[str, Value]) -> None:
        """Put the sentence together, in the language that is spoken."""
        self.field, self.template, self.reason, self.got = field, template, reason, got
        self.values = {word: values[word] for word in WORD.findall(f"{template} {reason}") if word in values}
        self.message = message_of(template, reason, got, values)
        self.args = (self.message,)

    @classmethod
    def in_words(
        cls, field: str, template: str, /, *, got: Value | None = None, reason: Value = "", **values: Value
    ) -> Self:
        """The error with this template, which need not begin with the field."""
        error = cls.__new__(cls)
        error.compose(field, template, str(reason), got, values)
        return error

    def with_field(self, field: str, got: Value | None = None) -> Self:
        """The same error under another parameter name, and with another value if `got` is given.

        For a caller that computes the parameters of core from others, such as times from a range, or a radius from a
        diameter.
        """
        error = copy(self)
        values = {**self.values, "field": Parameter(field)} if "field" in self.values else self.values
        error.compose(field, self.template, self.reason, self.got if got is None else got, values)
        return error

    def renamed(self, name_of: Callable[[str], str], **values: Value) -> Self:
        """The same error with other names for all its parameters, and other values in the place of these."""
        error = copy(self)
        names = {word: Parameter(name_of(one.name)) for word, one in self.values.items() if isinstance(one, Parameter)}
        error.compose(name_of(self.field), self.template, self.reason, self.got, {**self.values, **names, **values})
        return error

    def because(self, reason: str) -> Self:
        """The same error with another reason."""
        error = copy(self)
        error.compose(self.field, self.template, reason, self.got, self.values)
        return error

    def __reduce__(self) -> tuple[Any, ...]:
        # An exception is copied by the arguments of its constructor, which are not kept here.
        return __newobj__, (type(self), self.message), self.__dict__


class InvalidValue(BenchDragonError, ValueError):
    """A parameter is outside what its type allows.

    >>> from core import Dragon
    >>> try:
    ...     Dragon(width=-0.3)
    ... except InvalidValue as error:
    ...     print(error)
    dragon.width must be positive, got -0.3 m
    """

    code = "invalid-value"


class TooLarge(BenchDragonError):
    """The requested work is beyond a stated limit.

    >>> from core import Dance, Dragon, Relief, Spiral, crew
    >>> try:
    ...     crew(Dance(Dragon(3), Spiral()), [8, 2, 2], Relief(spares=20_000))
    ... except TooLarge as error:
    ...     print(error)
    people must be at most 20000, spares among them, got 20012
    """

    code = "too-large"


class TooMuchWork(BenchDragonError):
    """An answer was not found within the work that one question may take, or before it was stopped.

    stopped: True if another thread stopped it

    >>> from core import Budget, Dragon, minimum_pitch
    >>> try:
    ...     minimum_pitch(Dragon(), budget=Budget(1e4))
    ... except TooMuchWork as error:
    ...     print(error.stopped)
    False
    """

    code = "too-much-work"
    stopped = False


class OutsideRun(BenchDragonError):
    """A time is after the end of the run, or before the whole dragon is on the path.

    >>> from core import Dance, Dragon, Spiral, trajectory
    >>> try:
    ...     trajectory(Dance(Dragon(), Spiral()), 500.0)
    ... except OutsideRun as error:
    ...     print(error)
    times must be at most 432.917924228 s, when bench 0 folds, got 500 s
    """

    code = "outside-run"


class ProofRefused(BenchDragonError):
    """A claim could not be proven, or a certificate does not prove its claim.

    >>> str(ProofRefused("certificate", "does not prove its claim"))
    'certificate does not prove its claim'
    """

    code = "proof-refused"

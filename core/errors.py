"""Every error that core raises, the checks of numbers that raise them, and how a question ends. One tree:

    BenchDragonError          code, field, template, got, reason, values, message
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
from copy import copy
from copyreg import __newobj__  # type: ignore[attr-defined]
from enum import StrEnum
from functools import wraps
from inspect import signature
from numbers import Real
from typing import TYPE_CHECKING, Any, Concatenate, NamedTuple, ParamSpec, Protocol, Self, TypeVar, cast, overload

from core.kernels import Budget, Halted
from core.language import Listed, Phrases, phrase, say, say_clauses

if TYPE_CHECKING:  # NumPy takes as long to import as all of a process that runs jobs.
    from core.values import Point

P = ParamSpec("P")
R = TypeVar("R")
A_contra = TypeVar("A_contra", contravariant=True)
B_contra = TypeVar("B_contra", contravariant=True)
R_co = TypeVar("R_co", covariant=True)
S_co = TypeVar("S_co", covariant=True)
Member = TypeVar("Member", bound=StrEnum)

# Smallest and largest size [m]: sizes outside describe no dance, and lose digits in c^2 / b^2.
SIZE_MIN = 1e-3
SIZE_MAX = 1e4
# Largest coordinate [m]: larger ones lose the digits that the chords need.
COORDINATE_MAX = 1e5
# Largest angle [rad]: larger ones lose the digits that the joints need.
ANGLE_MAX = 1e6
# What to change if a question ended early: by what it was about, whether also about a stretch of time, and whether
# somebody stopped it.
LESS = {
    ("benches", False, False): phrase("allow more work, or take fewer benches"),
    ("benches", False, True): phrase("allow more time, or take fewer benches"),
    ("benches", True, False): phrase("allow more work, or take fewer benches, or a shorter time"),
    ("benches", True, True): phrase("allow more time, or take fewer benches, or a shorter time"),
    ("dragons", True, False): phrase("allow more work, or take fewer dragons, or a shorter time"),
    ("dragons", True, True): phrase("allow more time, or take fewer dragons, or a shorter time"),
}
# Units that are words, which each language has its own for.
UNITS: Phrases = {"turns": "turns", "degrees": "degrees"}
# A word in a template.
WORD = re.compile(r"\{(\w+)\}")


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
        return str(self).replace(self.unit, say(UNITS[self.unit])) if self.unit in UNITS else str(self)


class Parameter(NamedTuple):
    """A parameter in a message, by its dotted name.

    >>> start = Parameter("times.start")
    >>> str(InvalidValue("times.stop", "must be after {start}", got=3.0, start=start))
    'times.stop must be after times.start, got 3'
    """

    name: str

    def __str__(self) -> str:
        return format_field(self.name)


class Given(NamedTuple):
    """What a caller gave, in a message. text: its form there; by default the first 60 characters of its repr()

    >>> str(InvalidValue("lengths", "must be a number", got=Given("3,41 m")))
    "lengths must be a number, got '3,41 m'"
    """

    value: object
    text: str = ""

    def __str__(self) -> str:
        return self.text or f"{self.value!r:.60}"

    def __reduce__(self) -> tuple[Any, ...]:
        # What a caller gave may be anything, also what no other process can have.
        can_be_sent = self.value is None or isinstance(self.value, (str, int, float))
        return Given, (self.value, self.text) if can_be_sent else (None, str(self))


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

    >>> from core import Dragon, minimum_pitch
    >>> try:
    ...     minimum_pitch(Dragon(), budget=Budget(1e4))
    ... except TooMuchWork as error:
    ...     print(error.stopped)
    False
    """

    code = "too-much-work"
    stopped = False


def too_much(budget: Budget, field: str, rule: str, got: Value, **values: Value) -> TooMuchWork:
    """The error of a question that ended early.

    rule: what must be smaller, then which answer is missing, with {then}: when the budget ended
    """
    error = TooMuchWork(field, rule, got=got, then=_then(budget), **values)
    error.stopped = budget.stopped
    return error


def _then(budget: Budget) -> Value:
    """When a budget ended, as the end of a sentence."""
    if budget.stopped:
        return cast("Value", budget.then)
    words = "within {work} steps of work, each a bench placed or a pair of benches tried"
    return Clause(words, work=f"{budget.work:g}")


def unanswered(
    budget: Budget, field: str, missing: str, count: int, things: str = "benches", *, timed: bool = False
) -> TooMuchWork:
    """The error of a question that ended early, whatever took long: it states the limit and what was asked about.

    missing: which answer is missing; count, things: what the question was about; timed: about a stretch of time too
    """
    template = f"{missing} {{then}}, with {{count}} {things}"
    advice = LESS[things, timed, budget.stopped]
    error = TooMuchWork.in_words(field, template, reason=advice, then=_then(budget), count=count)
    error.stopped = budget.stopped
    return error


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
        some = (*(kinds if isinstance(kinds, tuple) else (kinds,)), type(value))
        *words, own = (f"{'an' if one.__name__[0] in 'AEIOU' else 'a'} {one.__name__}" for one in some)
        as_is = value is None or isinstance(value, (str, bytes, Real, list, tuple, dict))
        got = f"the class {value.__name__}" if isinstance(value, type) else Given(value) if as_is else own
        raise InvalidValue(name, "must be {kinds}", got=got, kinds=" or ".join(words))


class Question(Protocol[A_contra, B_contra, P, R_co, S_co]):
    """A question that takes a subject of either kind, and has an answer for each."""

    @overload
    def __call__(self, subject: A_contra, /, *args: P.args, **kwargs: P.kwargs) -> R_co: ...
    @overload
    def __call__(self, subject: B_contra, /, *args: P.args, **kwargs: P.kwargs) -> S_co: ...


def or_about(
    kind: type[B_contra], answer: Callable[..., S_co]
) -> Callable[[Callable[Concatenate[A_contra, P], R_co]], Question[A_contra, B_contra, P, R_co, S_co]]:
    """Decorator of a question, whose first argument may also be of this kind; `answer` then answers it, with the same
    further arguments."""

    def either(question: Callable[Concatenate[A_contra, P], R_co]) -> Question[A_contra, B_contra, P, R_co, S_co]:
        name = next(iter(signature(question).parameters))

        @wraps(question)
        def asked(*args: Any, **kwargs: Any) -> Any:
            subject = args[0] if args else kwargs.get(name)
            if not isinstance(subject, kind):
                return question(*args, **kwargs)
            return answer(subject, *args[1:], **{key: value for key, value in kwargs.items() if key != name})

        return asked

    return either


def question_about(
    name: str, kind: type | tuple[type, ...], missing: str = ""
) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Decorator of a question: the first argument must be of this kind, and the end of the budget raises TooMuchWork.

    kind: with those that or_about() takes
    missing: which answer is missing then, as a clause of the message: "the first contact was not decided"; if empty,
        the question itself raises TooMuchWork, and whatever else of it ends early has a general clause
    The type is checked before Python checks the number of arguments. Otherwise a call as in 0.1.0, with a dragon and a
    spiral, would get Python's message on that number, which does not say that the first one must be a dance.
    """

    def checking(question: Callable[P, R]) -> Callable[P, R]:
        @wraps(question)
        def answer(*args: P.args, **kwargs: P.kwargs) -> R:
            if args or name in kwargs:
                subject = args[0] if args else kwargs[name]
                checked_type(name, subject, kind)
            if (budget := cast("Budget | None", kwargs.get("budget"))) is not None:
                checked_type("budget", budget, Budget)
            try:
                return question(*args, **kwargs)
            except (Halted, TooMuchWork) as ended:  # TooMuchWork comes from a part of the question
                spent = ended.budget if isinstance(ended, Halted) else budget if missing and ended.stopped else None
                if spent is None:
                    raise
            arguments = signature(question).bind(*args, **kwargs).arguments
            what = missing or "the answer was not found"
            result = arguments.get("contact") or arguments.get("encounter")
            if performance := arguments.get("performance") or getattr(result, "performance", None):
                raise unanswered(spent, "parts", what, len(performance.parts), "dragons", timed=True)
            dance = arguments.get("dance") or getattr(result, "dance", None)
            if dragon := arguments.get("dragon") or getattr(dance or next(iter(arguments.values())), "dragon", None):
                raise unanswered(spent, "dragon.benches", what, dragon.benches, timed=bool(dance))
            raise unanswered(spent, "benches", what, len(arguments["poses"]))

        return answer

    return checking


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

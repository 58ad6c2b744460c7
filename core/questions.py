"""How a question is asked, of a dance or of several, and how it ends when its budget does."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar, cast, overload

from core.checks import checked_type
from core.errors import TooMuchWork
from core.kernels import Budget, Halted
from core.language import phrase
from core.quantities import Clause, Value

P = ParamSpec("P")
R = TypeVar("R")
A_contra = TypeVar("A_contra", contravariant=True)
B_contra = TypeVar("B_contra", contravariant=True)
R_co = TypeVar("R_co", covariant=True)
S_co = TypeVar("S_co", covariant=True)

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


# The end of the sentence if a budget is stopped at no limit, see Budget.stop().
STOPPED = phrase("before it was stopped")


def too_much(budget: Budget, field: str, rule: str, got: Value, **values: Value) -> TooMuchWork:
    """The error of a question that ended early.

    rule: what must be smaller, then which answer is missing, with {then}: when the budget ended. Where somebody just
        stopped it, nothing need be smaller
    """
    if budget.stopped and budget.then == STOPPED:
        missing = rule.partition(": ")[2]
        error = TooMuchWork.in_words(field, missing, reason=phrase("allow more time"), then=_then(budget), **values)
    else:
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


def drawn(subject: Any, missing: str, draw: Callable[[], bytes]) -> bytes:
    """What is drawn of a dance, or of several. missing: as in unanswered(); raises: TooMuchWork when a budget ends"""
    try:
        return draw()
    except Halted as ended:
        if parts := getattr(subject, "parts", ()):
            raise unanswered(ended.budget, "parts", missing, len(parts), "dragons", timed=True) from ended
        raise unanswered(ended.budget, "dragon.benches", missing, subject.dragon.benches, timed=True) from ended


class EitherQuestion(Protocol[A_contra, B_contra, P, R_co, S_co]):
    """A question that takes a subject of either kind, and has an answer for each."""

    @overload
    def __call__(self, subject: A_contra, /, *args: P.args, **kwargs: P.kwargs) -> R_co: ...
    @overload
    def __call__(self, subject: B_contra, /, *args: P.args, **kwargs: P.kwargs) -> S_co: ...


def or_about(
    kind: type[B_contra], answer: Callable[..., S_co]
) -> Callable[[Callable[Concatenate[A_contra, P], R_co]], EitherQuestion[A_contra, B_contra, P, R_co, S_co]]:
    """Decorator of a question, whose first argument may also be of this kind; `answer` then answers it, with the same
    further arguments."""

    def either(question: Callable[Concatenate[A_contra, P], R_co]) -> EitherQuestion[A_contra, B_contra, P, R_co, S_co]:
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

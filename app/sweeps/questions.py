"""The questions that a sweep may ask: those of the registry with numbers as answers, and the cost of a design of each.

Your own question can be swept in the same way, if a worker can import its functions and models.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from pydantic import BaseModel

from app.questions import registry
from app.questions.check import LeastClearance
from app.settings import Settings
from app.sweeps.rows import (
    ClearanceRow,
    OverlapsRow,
    TrajectoryRow,
    clearance_row,
    least_clearance,
    overlaps_row,
    trajectory_row,
)
from app.wire.dances import DanceFields
from app.wire.messages import checked
from app.wire.question import Answer, DanceQuery, Terms
from app.wire.refusals import refusing
from core import BenchDragonError, InvalidValue

# The service's default limits, so that a row does not depend on the machine that computes it.
LIMITS = Settings.model_construct()


@dataclass(frozen=True, slots=True)
class Question:
    """One question in one form.

    name: the operation id; request, answer: models of the input and of the output
    ask: function from a request to its answer
    seconds: estimated cost of a design [s]; it fixes the number of designs in a shard, equal on every machine
    shown: the default column of a map
    left_out: columns that no table needs
    """

    name: str
    request: type[BaseModel]
    answer: type[BaseModel]
    ask: Callable[[Any], BaseModel]
    seconds: float
    shown: str
    left_out: frozenset[str] = frozenset()

    def answered(self, values: dict[str, Any]) -> BaseModel:
        """The answer to a request given by its values. raises: BenchDragonError in the words of the request"""
        request = checked(self.request, values)
        with refusing(request):
            return self.ask(request)


def _ways(question: registry.Question, seconds: float, shown: str, *left_out: str) -> tuple[Question, ...]:
    """A question of the registry in both forms: with flat parameters and with a body."""
    assert question.model is not None
    ask, requests = partial(question.answer, terms=Terms(LIMITS)), (question.flat, question.body)
    known = (question.model, ask, seconds, shown, frozenset(left_out))
    return tuple(Question(question.name, request, *known) for request in requests if request)


def _known(name: str) -> registry.Question:
    return registry.QUESTIONS[name]


def _row(answer: Callable[..., Answer], model: type[Answer], name: str) -> registry.Question:
    """A question of the registry with lists as its answer, changed to answer with a row."""
    return replace(_known(name), answer=answer, model=model)


_LEAST = registry.Question(least_clearance, LeastClearance, flat=DanceQuery, body=DanceFields)
# The forms of each question, the flat one first. The seconds are for the defaults on one core of a small machine.
_ALL = {
    "collision_time": _ways(_known("collision_time"), 1e-3, "time", "certificate.method"),
    "minimum_pitch": _ways(_known("minimum_pitch"), 2e-2, "pitch"),
    "turn": _ways(_known("turn"), 1e-4, "length"),
    "shortest_turn": _ways(_known("shortest_turn"), 0.5, "length"),
    "maximum_head_speed": _ways(_known("maximum_head_speed"), 5e-2, "head_speed"),
    "least_clearance": _ways(_LEAST, 2e-2, "distance"),
    "check": _ways(_known("check"), 0.1, "least_clearance.distance", "first_contact.certificate.method"),
    "tolerance": _ways(_known("tolerance"), 0.3, "stray", "certificate.method"),
    "contact_probability": _ways(_known("contact_probability"), 3.0, "probability", "method"),
    "clearance": _ways(_row(clearance_row, ClearanceRow, "clearance"), 0.2, "clearance"),
    "trajectory": _ways(_row(trajectory_row, TrajectoryRow, "trajectory"), 2e-3, "greatest_speed"),
    "overlaps": _ways(_row(overlaps_row, OverlapsRow, "overlaps"), 1e-2, "separation"),
}
QUESTIONS = _ALL | {name: ways[1:] for own, ways in _ALL.items() if (name := f"{own}_of") in registry.CALLS}
# Questions of the service whose answers cannot be a row, with the reason.
PICTURE = "its answer is a picture: sweep the question behind its numbers"
NO_ROWS = {
    "pitch_scan": "it is a sweep itself: sweep collision_time over pitch",
    "tolerance_curve": "it is a sweep itself: sweep tolerance over pitch",
    "envelope": "its answer is polygons: sweep check with a venue",
    "course": "its answer is a drawn path: sweep check",
    "paper": "it takes no parameters",
    **{name: PICTURE for name, question in registry.QUESTIONS.items() if question.model is None},
}


def question_of(name: str, parameters: Collection[str] = ()) -> Question:
    """The question with that operation id, in the form that has most of these parameters; flat if both have all.

    raises: InvalidValue
    """
    if why := NO_ROWS.get(name.removesuffix("_of")):
        raise InvalidValue("question", f"{name} has no row for a table, as {why}")
    if name not in QUESTIONS:
        raise InvalidValue("question", f"must be one of {', '.join(QUESTIONS)}, got {name!r:.60}")
    names = [parameter.partition(".")[0] for parameter in parameters]
    return max(QUESTIONS[name], key=lambda way: sum(one in way.request.model_fields for one in names))


def refusal(error: Exception) -> tuple[str, str]:
    """Code and message of the error that a design raised."""
    if isinstance(error, BenchDragonError):
        return error.code, error.message
    return "internal-error", f"{type(error).__name__}: {error}"

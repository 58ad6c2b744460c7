"""The questions that a sweep may ask: those of the registry whose answers are numbers, and what a design of each costs.

A question of one's own is swept alike, as long as a worker can import what it is made of.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from pydantic import BaseModel

from app.questions import registry
from app.questions.check import LeastClearance
from app.questions.question import Terms
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
from app.wire.dances import DanceFields, DanceQuery
from app.wire.messages import checked
from app.wire.models import Answer
from app.wire.refusals import refusing
from core import BenchDragonError, InvalidValue

# Answered within the limits that the service has by default, so that a row does not depend on who computes it.
LIMITS = Settings.model_construct()


@dataclass(frozen=True, slots=True)
class Question:
    """One question, asked in one way.

    name: the operation id; request, answer: models of what goes in and what comes out
    ask: the answer to a request
    seconds: estimated cost of a design [s]; it decides how many designs a shard has, alike on every machine
    shown: the column that a map draws unless told otherwise
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
    """A question of the registry, flat and as a body."""
    assert question.model is not None
    ask, requests = partial(question.answer, terms=Terms(LIMITS)), (question.flat, question.body)
    known = (question.model, ask, seconds, shown, frozenset(left_out))
    return tuple(Question(question.name, request, *known) for request in requests if request)


def _known(name: str) -> registry.Question:
    return registry.QUESTIONS[name]


def _row(answer: Callable[..., Answer], model: type[Answer], name: str) -> registry.Question:
    """A question of the registry that answers with lists, with another answer: a row."""
    return replace(_known(name), answer=answer, model=model)


_LEAST = registry.Question(least_clearance, LeastClearance, flat=DanceQuery, body=DanceFields)
# The ways to ask each, the flat one first. The seconds are those of the defaults on one core of a small machine.
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
# Questions of the service whose answers are no row, and why.
PICTURE = "it answers with a picture: sweep the question whose numbers it draws"
NO_ROWS = {
    "pitch_scan": "it is a sweep itself: sweep collision_time over pitch",
    "tolerance_curve": "it is a sweep itself: sweep tolerance over pitch",
    "envelope": "it answers with polygons: sweep check with a venue",
    "course": "it answers with a drawn path: sweep check",
    "paper": "it takes no parameters",
    **{name: PICTURE for name, question in registry.QUESTIONS.items() if question.model is None},
}


def question_of(name: str, parameters: Collection[str] = ()) -> Question:
    """The question with that operation id, asked in the way that knows most of these parameters; flat if all do.

    raises: InvalidValue
    """
    if why := NO_ROWS.get(name.removesuffix("_of")):
        raise InvalidValue("question", f"question {name} has no row for a table, as {why}")
    if name not in QUESTIONS:
        raise InvalidValue("question", f"question must be one of {', '.join(QUESTIONS)}, got {name!r:.60}")
    names = [parameter.partition(".")[0] for parameter in parameters]
    return max(QUESTIONS[name], key=lambda way: sum(one in way.request.model_fields for one in names))


def refusal(error: Exception) -> tuple[str, str]:
    """Code and message of the error that a design raised."""
    if isinstance(error, BenchDragonError):
        return error.code, error.message
    return "internal-error", f"{type(error).__name__}: {error}"

"""The questions that a sweep may ask: those of the registry whose answers are numbers, and what a design of each costs.

A question of one's own is swept alike, as long as a worker can import what it is made of.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import partial
from typing import Any

from pydantic import BaseModel

import core
from app import questions
from app.questions.check import LeastClearance
from app.settings import Settings
from app.wire.dances import DanceFields, DanceQuery
from app.wire.messages import checked
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


def least_clearance(asked: DanceQuery | DanceFields, settings: Settings) -> LeastClearance:
    """The least separation of two benches that share no handle, over the whole dance."""
    found = core.least_clearance(asked.to_dance(settings.checked_benches_max))
    if found is None:
        raise InvalidValue.of("dragon.benches", "must be at least 3 for two to share no handle", asked.benches, "")
    return LeastClearance.model_validate(found)


def _ways(question: questions.Question, seconds: float, shown: str, *left_out: str) -> tuple[Question, ...]:
    """A question of the registry, flat and as a body."""
    assert question.model is not None
    ask, requests = partial(question.answer, settings=LIMITS), (question.flat, question.body)
    known = (question.model, ask, seconds, shown, frozenset(left_out))
    return tuple(Question(question.name, request, *known) for request in requests if request)


_LEAST = questions.Question(least_clearance, LeastClearance, flat=DanceQuery, body=DanceFields)
# The ways to ask each, the flat one first. The seconds are those of the defaults on one core of a small machine.
QUESTIONS = {
    ways[0].name: ways
    for ways in (
        _ways(questions.QUESTIONS["collision_time"], 1e-3, "time", "certificate.method"),
        _ways(questions.QUESTIONS["minimum_pitch"], 2e-2, "pitch"),
        _ways(questions.QUESTIONS["turn"], 1e-4, "length"),
        _ways(questions.QUESTIONS["shortest_turn"], 0.5, "length"),
        _ways(questions.QUESTIONS["maximum_head_speed"], 5e-2, "head_speed"),
        _ways(_LEAST, 2e-2, "distance"),
        _ways(questions.QUESTIONS["check"], 0.1, "least_clearance.distance", "first_contact.certificate.method"),
    )
}


def question_of(name: str, parameters: Collection[str] = ()) -> Question:
    """The question with that operation id, asked in the way that knows most of these parameters; flat if all do.

    raises: InvalidValue
    """
    if name not in QUESTIONS:
        raise InvalidValue("question", f"question must be one of {', '.join(QUESTIONS)}, got {name!r:.60}")
    names = [parameter.partition(".")[0] for parameter in parameters]
    return max(QUESTIONS[name], key=lambda way: sum(one in way.request.model_fields for one in names))


def refusal(error: Exception) -> tuple[str, str]:
    """Code and message of what keeps a design from an answer."""
    if isinstance(error, BenchDragonError):
        return error.code, error.message
    return "internal-error", f"{type(error).__name__}: {error}"

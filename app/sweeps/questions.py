"""The questions that a sweep may ask: the only file here that knows how the rest of the program answers.

A question is the operation id of a call, its request and its answer, and what a design costs. A question of one's own
is swept alike, as long as a worker can import what it is made of.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from pydantic import BaseModel

import core
from app import answers, report, schemas
from app.options import checked
from app.refusals import refusing
from app.settings import Settings, check_limit
from core import BenchDragonError, InvalidValue

# Answered within the limits that the service has by default, so that a row does not depend on who computes it.
LIMITS = Settings.model_construct()


@dataclass(frozen=True, slots=True)
class Question:
    """One kind of question.

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


@lru_cache(maxsize=32)
def _dragon(benches: int, head_length: float, body_length: float, width: float, overhang: float) -> core.Dragon:
    """A dragon: most designs of a sweep share one with others."""
    return core.Dragon(benches, head_length, body_length, width, overhang)


def _collision_time(asked: schemas.CollisionQuery) -> answers.CollisionTime:
    check_limit("benches", "benches", asked.benches, LIMITS.benches_max, "shorten the dragon")
    dragon = _dragon(asked.benches, asked.head_length, asked.body_length, asked.width, asked.overhang)
    path = asked.to_path()
    found = core.first_contact(core.Dance(dragon, path, asked.head_speed), margin=asked.margin)
    return answers.CollisionTime.of(found, dragon, path, asked)


def _minimum_pitch(asked: schemas.MinimumPitchQuery) -> answers.MinimumPitch:
    dragon, radius = asked.to_dragon(LIMITS.benches_max), asked.turning_diameter / 2
    found = core.minimum_pitch(dragon, turning_radius=radius, start_turns=asked.start_turns, margin=asked.margin)
    return answers.MinimumPitch.of(found, dragon, asked)


def _turn(asked: schemas.TurnQuery) -> report.Turn:
    return report.Turn.of(asked.to_turn())


def _shortest_turn(asked: schemas.ShortestTurnQuery) -> report.ShortestTurn:
    return report.ShortestTurn.of_shortest(asked.to_shortest_turn(LIMITS.checked_benches_max))


def _maximum_head_speed(asked: schemas.MaximumHeadSpeedQuery) -> report.MaximumHeadSpeed:
    dance = core.Dance(asked.to_dragon(LIMITS.checked_benches_max), asked.to_turn())
    return report.MaximumHeadSpeed.model_validate(core.maximum_head_speed(dance, asked.speed_limit))


def _least_clearance(asked: schemas.DanceQuery) -> report.LeastClearance:
    dance = core.Dance(asked.to_dragon(LIMITS.checked_benches_max), asked.to_path(), asked.head_speed)
    found = core.least_clearance(dance)
    if found is None:
        raise InvalidValue("benches", f"benches must be at least 3 for two to share no handle, got {asked.benches}")
    return report.LeastClearance.model_validate(found)


def _check(asked: schemas.CheckRequest) -> report.Report:
    dragon, path = asked.dragon.to_dragon(LIMITS.checked_benches_max), asked.path.to_path()
    place = asked.to_place(dragon)
    return report.Report.of(asked.to_report(dragon, path, place), dragon, path, asked, place.origin)


# The seconds are those of the defaults on one core of a small machine.
QUESTIONS = {
    question.name: question
    for question in (
        Question(
            "collision_time", schemas.CollisionQuery, answers.CollisionTime, _collision_time, 1e-3, "time",
            frozenset({"certificate.method"}),
        ),
        Question("minimum_pitch", schemas.MinimumPitchQuery, answers.MinimumPitch, _minimum_pitch, 2e-2, "pitch"),
        Question("turn", schemas.TurnQuery, report.Turn, _turn, 1e-4, "length"),
        Question("shortest_turn", schemas.ShortestTurnQuery, report.ShortestTurn, _shortest_turn, 0.5, "length"),
        Question(
            "maximum_head_speed", schemas.MaximumHeadSpeedQuery, report.MaximumHeadSpeed, _maximum_head_speed, 5e-2,
            "head_speed",
        ),
        Question(
            "least_clearance", schemas.DanceQuery, report.LeastClearance, _least_clearance, 2e-2, "distance",
        ),
        Question(
            "check", schemas.CheckRequest, report.Report, _check, 0.1, "least_clearance.distance",
            frozenset({"first_contact.certificate.method"}),
        ),
    )
}  # fmt: skip


def question_of(name: str) -> Question:
    """The question with that operation id. raises: InvalidValue"""
    if name not in QUESTIONS:
        raise InvalidValue("question", f"question must be one of {', '.join(QUESTIONS)}, got {name!r:.60}")
    return QUESTIONS[name]


def refusal(error: Exception) -> tuple[str, str]:
    """Code and message of what keeps a design from an answer."""
    if isinstance(error, BenchDragonError):
        return error.code, error.message
    return "internal-error", f"{type(error).__name__}: {error}"

"""The questions that a sweep may ask: those of the registry with numbers as answers, and the cost of a design of each.

Your own question can be swept in the same way, if a worker can import its functions and models.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from pydantic import BaseModel

import core
from app.questions import clearance, overlaps
from app.questions.check import DanceCheck, DragonsClearance
from app.questions.clearance import DanceClearance
from app.questions.registry import CALLS
from app.questions.registry import QUESTIONS as KNOWN
from app.questions.tolerance import DanceTolerance
from app.questions.trajectory import DanceTrajectory, TrajectoryRequest
from app.settings import Settings
from app.wire.dances import DanceFields
from app.wire.fields import Answer, DanceQuery
from app.wire.messages import checked
from app.wire.performances import PerformanceFields
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import BenchDragonError, InvalidValue
from core.language import Listed
from core.quantities import Given
from core.values import Floats, Pair, Point

# The service's default limits, so that a row does not depend on the machine that computes it.
LIMITS = Settings.model_construct()


@dataclass(frozen=True, slots=True)
class SweepQuestion:
    """One question in one form.

    name: the operation id; request, answer: models of the input and of the output
    ask: function from a request to its answer
    seconds: estimated cost of a design [s]; it fixes the number of designs in a shard, equal on every machine
    map_column: the default column of a map
    left_out: fields that no table needs, with all that is in them
    """

    name: str
    request: type[BaseModel]
    answer: type[BaseModel]
    ask: Callable[[Any], BaseModel]
    seconds: float
    map_column: str
    left_out: frozenset[str] = frozenset()

    def answer_to(self, values: dict[str, Any]) -> BaseModel:
        """The answer to a request given by its values. raises: BenchDragonError in the words of the request"""
        request = checked(self.request, values)
        with refusing(request):
            return self.ask(request)


def _ways(name: str, seconds: float, column: str, *left_out: str, **own: Any) -> tuple[SweepQuestion, ...]:
    """A question of the registry in both forms: with flat parameters and with a body.

    column: the default one of a map; own: fields of the question in the registry that differ for a row
    """
    question = replace(KNOWN[name], **own)
    assert question.model is not None
    ask, requests = partial(question.answer, terms=Terms(LIMITS)), (question.flat, question.body)
    shared = (question.model, ask, seconds, column, frozenset(left_out))
    return tuple(SweepQuestion(question.name, request, *shared) for request in requests if request)


def _several(name: str, seconds: float, column: str, *left_out: str, **own: Any) -> tuple[SweepQuestion, ...]:
    """The form of a question about several dances, whose rows have columns of their own. own: as for _ways()"""
    question = KNOWN[name]
    return _ways(name, seconds, column, *left_out, **({"flat": None, "model": question.several} | own))


def _words(place: str) -> tuple[str, str]:
    """The fields of a certificate that say in words and in values what a row says anyway. place: where they are"""
    return f"{place}method", f"{place}claim"


# Questions with lists as answers, answered with the numbers that a table of many designs has.


class ClearanceRow(Answer):
    """The smallest clearance between the first and the last instant of the request.

    clearance: smallest separation of two benches that are not neighbours [m]
    time: time of that clearance [s]
    benches: the pair with that separation
    """

    clearance: float
    time: float
    benches: Pair


class TrajectoryRow(Answer):
    """The two ends of the dragon at the last instant of the request, and the speeds at all instants.

    time: last instant [s]
    head_x: x of the first handle at the last instant [m]
    head_y: y of the first handle at the last instant [m]
    tail_x: x of the last handle at the last instant [m]
    tail_y: y of the last handle at the last instant [m]
    tail_speed: speed of the last handle at the last instant [m/s]
    least_speed: lowest speed of any handle at any instant [m/s]
    greatest_speed: highest speed of any handle at any instant [m/s]
    """

    time: float
    head_x: float
    head_y: float
    tail_x: float
    tail_y: float
    tail_speed: float
    least_speed: float
    greatest_speed: float


class OverlapsRow(Answer):
    """The number of overlapping pairs, and the deepest overlap.

    pairs: pairs that overlap or come within the margin
    separation: smallest separation of these pairs; null: there is no such pair [m]
    benches: the pair with that separation
    agree: true if all engines found the same pairs
    """

    pairs: int
    separation: float | None
    benches: Pair | None
    agree: bool


class DragonsClearanceRow(Answer):
    """The smallest clearance between two dragons between the first and the last instant of the request.

    clearance: smallest separation of two benches of different dragons [m]
    time: time of that clearance [s]
    dragons: these two dragons
    benches: a bench of each
    """

    clearance: float
    time: float
    dragons: Pair
    benches: Pair


class TrajectoriesRow(Answer):
    """The two ends of each dragon at the last instant of the request, and the speeds at all instants.

    time: last instant [s]
    heads: the first handle of each dragon at the last instant, x and y [m]
    tails: the last handle of each dragon at the last instant, x and y [m]
    least_speed: lowest speed of any handle at any instant [m/s]
    greatest_speed: highest speed of any handle at any instant [m/s]
    """

    time: float
    heads: list[Point]
    tails: list[Point]
    least_speed: float
    greatest_speed: float


def clearance_row(request: clearance.ClearanceQuery | DanceClearance, terms: Terms) -> ClearanceRow:
    """The smallest clearance of a dance, at the instants or at a local minimum between them."""
    profile = clearance.profile_of(request, terms)
    k = int(profile.clearance.argmin())
    at = core.Graze(float(profile.time[k]), float(profile.clearance[k]), tuple(profile.benches[k].tolist()))
    return ClearanceRow.from_result(min([at, *profile.grazes], key=lambda graze: graze.clearance))


def dragons_clearance_row(request: clearance.ClearanceRequest, terms: Terms) -> DragonsClearanceRow:
    """The smallest clearance of two dragons, at the instants or at a local minimum between them."""
    between = clearance.between_dragons(request, terms)
    k = int(between.clearance.argmin())
    pair = (tuple(columns[k].tolist()) for columns in (between.dragons, between.benches))
    at = core.NearPass(float(between.time[k]), float(between.clearance[k]), *pair)
    return DragonsClearanceRow.from_result(min([at, *between.grazes], key=lambda graze: graze.clearance))


def trajectories_row(request: TrajectoryRequest, terms: Terms) -> TrajectoriesRow:
    """The ends of each dragon at the last instant, and the speeds. raises: InvalidValue without an instant"""
    performance = request.to_performance(terms.settings)
    times = _instants(request, performance, terms)
    results = core.trajectory(performance, times, budget=terms.budget)
    heads, tails = ([result.position[-1, k].tolist() for result in results] for k in (0, -1))
    return TrajectoriesRow(
        time=times[-1],
        heads=heads,
        tails=tails,
        least_speed=min(float(np.min(result.speed)) for result in results),
        greatest_speed=max(float(np.max(result.speed)) for result in results),
    )


def _instants(request: DanceTrajectory, dance: core.Dance | core.Performance, terms: Terms) -> Floats:
    times = request.times_of(dance, terms.settings.cells_max)
    if not times.size:
        raise InvalidValue("times", "must have at least one instant for a row", got="none")
    return times


def trajectory_row(request: DanceTrajectory, terms: Terms) -> TrajectoryRow:
    """The ends of the dragon at the last instant, and the speeds. raises: InvalidValue without an instant"""
    dance = request.to_dance(terms.settings.benches_max)
    times = _instants(request, dance, terms)
    trajectory = core.trajectory(dance, times, budget=terms.budget)
    head, tail = trajectory.position[-1, 0], trajectory.position[-1, -1]
    return TrajectoryRow(
        time=times[-1],
        head_x=head[0],
        head_y=head[1],
        tail_x=tail[0],
        tail_y=tail[1],
        tail_speed=trajectory.speed[-1, -1],
        least_speed=np.min(trajectory.speed),
        greatest_speed=np.max(trajectory.speed),
    )


def overlaps_row(request: overlaps.OverlapsRequest, terms: Terms) -> OverlapsRow:
    """The number of overlapping pairs, and the pair with the deepest overlap."""
    result = overlaps.overlaps(request, terms)
    deepest = min(result.overlaps, key=lambda pair: pair.separation, default=None)
    return OverlapsRow(
        pairs=len(result.overlaps),
        separation=deepest and deepest.separation,
        benches=deepest and deepest.benches,
        agree=result.cross_check.agree,
    )


def least_clearance(request: DanceQuery | DanceFields, terms: Terms) -> core.LeastClearance:
    """The least separation of two benches that share no handle, over the whole dance."""
    least = core.least_clearance(request.to_dance(terms.settings.checked_benches_max), budget=terms.budget)
    if least is None:
        raise InvalidValue("dragon.benches", "must be at least 3, so that two share no handle", got=request.benches)
    return least


def dragons_least_clearance(request: PerformanceFields, terms: Terms) -> DragonsClearance:
    """The least separation of two benches of different dragons, over the whole performance."""
    performance = request.to_performance(terms.settings)
    least = core.least_clearance(performance, budget=terms.budget)
    if least is None:
        raise InvalidValue("parts", "must be at least two, between which there is a clearance", got=1)
    return DragonsClearance.from_result(least)


# The forms of each question, the flat one first and the one about several dances last. The seconds are for the defaults
# on one core of a small machine.
_ALL = {
    "collision_time": _ways("collision_time", 1e-3, "time", *_words("certificate.")),
    "minimum_pitch": _ways("minimum_pitch", 2e-2, "pitch"),
    "turn": _ways("turn", 1e-4, "length"),
    "shortest_turn": _ways("shortest_turn", 0.5, "length"),
    "turn_time": _ways("turn_time", 2e-2, "time"),
    "quickest_turn": _ways("quickest_turn", 1.0, "time"),
    "maximum_head_speed": _ways("maximum_head_speed", 5e-2, "head_speed"),
    "least_clearance": _ways(
        "check", 2e-2, "distance", answer=least_clearance, model=core.LeastClearance, flat=DanceQuery, body=DanceFields
    )
    + _several(
        "check", 1.0, "distance", answer=dragons_least_clearance, model=DragonsClearance, body=PerformanceFields
    ),
    "check": _ways("check", 0.1, "least_clearance.distance", *_words("first_contact.certificate."), body=DanceCheck)
    + _several("check", 1.0, "least_clearance.distance", "reports", *_words("encounter.certificate.")),
    "tolerance": _ways("tolerance", 0.3, "stray", *_words("certificate."), body=DanceTolerance)
    + _several("tolerance", 2.0, "stray", *_words("certificate.")),
    "contact_probability": _ways("contact_probability", 3.0, "probability", *_words("")),
    "clearance": _ways("clearance", 0.2, "clearance", answer=clearance_row, model=ClearanceRow, body=DanceClearance)
    + _several("clearance", 0.5, "clearance", answer=dragons_clearance_row, model=DragonsClearanceRow),
    "trajectory": _ways(
        "trajectory", 2e-3, "greatest_speed", answer=trajectory_row, model=TrajectoryRow, body=DanceTrajectory
    )
    + _several("trajectory", 5e-3, "greatest_speed", answer=trajectories_row, model=TrajectoriesRow),
    "encounter": _ways("encounter", 0.1, "time", *_words("certificate.")),
    "safe_delay": _ways("safe_delay", 2.0, "first_safe"),
    "overlaps": _ways("overlaps", 1e-2, "separation", answer=overlaps_row, model=OverlapsRow),
}
QUESTIONS = _ALL | {name: ways[1:] for own, ways in _ALL.items() if (name := f"{own}_of") in CALLS}
# Questions of the service whose answers cannot be a row, with the reason.
PICTURE = "its answer is a picture: sweep the question behind its numbers"
NO_ROWS = {
    "pitch_scan": "it is a sweep itself: sweep collision_time over pitch",
    "tolerance_curve": "it is a sweep itself: sweep tolerance over pitch",
    "envelope": "its answer is polygons: sweep check with a venue",
    "course": "its answer is a drawn path: sweep check",
    "proposals": "its answers are dances: sweep check",
    "crew": "its answer is a list of people: sweep check",
    "cues": "its answer is a card for each bench: sweep check",
    "safety_sheet": "its answer is many numbers on one page: sweep check",
    "paper": "it takes no parameters",
    "contest_answer": "its answer is that of the contest alone: sweep the question that it names",
    "class_table": "its answer is about handed-in files",
    **{name: PICTURE for name, question in KNOWN.items() if question.model is None},
}


def question_of(name: str, parameters: Collection[str] = ()) -> SweepQuestion:
    """The question with that operation id, in the form that has most of these parameters; flat if both have all.

    raises: InvalidValue
    """
    if why := NO_ROWS.get(name.removesuffix("_of")):
        raise InvalidValue("question", "{name} cannot be swept, because {why}", name=name, why=why)
    if name not in QUESTIONS:
        raise InvalidValue("question", "must be one of {known}", got=Given(name), known=Listed(QUESTIONS))
    names = [parameter.partition(".")[0] for parameter in parameters]
    return max(QUESTIONS[name], key=lambda way: sum(one in way.request.model_fields for one in names))


def refusal(error: Exception) -> tuple[str, str]:
    """Code and message of the error that a design raised."""
    if isinstance(error, BenchDragonError):
        return error.code, error.message
    return "internal-error", f"{type(error).__name__}: {error}"

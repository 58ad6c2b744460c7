"""Change of the answers with one number of the problem."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import core
from app.contest.solved import ContestRequest, Solved
from core import BenchDragonError, Budget, Dance, TooMuchWork
from core.language import say
from core.values import Interval, Point

# Number of values on each curve.
VALUES = 25
# Ranges of the width [m], of the turning diameter [m], of the length of a body [m] and of the ratio of the arcs [1].
WIDTHS, DIAMETERS, LENGTHS, RATIOS = (0.26, 0.38), (7.0, 11.0), (1.8, 2.6), (0.5, 2.1)

Answer = Callable[[ContestRequest, Budget], float | None]


@dataclass(frozen=True)
class Panel:
    """varied, answer: labels of the two axes, with units; points: the curve; own: the value of this problem
    smooth: True if the answer has no jumps, so that samples may be joined

    A value for which the question has no answer has no point.
    """

    varied: str
    answer: str
    points: list[Point]
    own: Point
    smooth: bool


def panels(solved: Solved) -> list[Panel]:
    """Change of the answers to questions 2, 3 and 5.

    Minimum pitch against width, turning diameter and length of a body; first contact, if there is any, against width
    and length; head speed, if there is a turn, against the ratio of the arcs.
    """
    request, met = solved.request, solved.contact.time
    fastest = solved.turned.fastest.head_speed if solved.turned else None
    pitch, contact = say("minimum pitch [m]"), say("first contact [s]")
    speed = say("maximum head speed [m/s]")
    width, length = say("width of the benches [m]"), say("length of a body bench [m]")
    diameter, ratio = say("turning diameter [m]"), say("ratio of the arcs")
    wanted: list[tuple[str, str, str, Interval, Answer, float | None]] = [
        (width, pitch, "width", WIDTHS, _pitch, solved.pitch.pitch),
        (diameter, pitch, "turning_diameter", DIAMETERS, _pitch, solved.pitch.pitch),
        (length, pitch, "body_length", LENGTHS, _pitch, solved.pitch.pitch),
        (width, contact, "width", WIDTHS, _contact, met),
        (length, contact, "body_length", LENGTHS, _contact, met),
        (ratio, speed, "ratio", RATIOS, _speed, fastest),
    ]
    return [
        Panel(words, label, _curve(solved, name, limits, answer), (getattr(request, name), own), answer is _speed)
        for words, label, name, limits, answer, own in wanted
        if own is not None
    ]


def _curve(solved: Solved, name: str, limits: Interval, answer: Answer) -> list[Point]:
    points = []
    for value in np.linspace(*limits, VALUES).tolist():
        try:
            result = answer(solved.request.model_copy(update={name: value}), solved.budget)
        except BenchDragonError as error:
            if isinstance(error, TooMuchWork) and error.stopped:
                raise
            continue  # no answer: these benches do not fit on this spiral or turn
        if result is not None:
            points.append((value, result))
    return points


def _pitch(request: ContestRequest, budget: Budget) -> float:
    return request.least_pitch(request.to_dragon(request.benches), budget).pitch


def _contact(request: ContestRequest, budget: Budget) -> float | None:
    return core.first_contact(request.to_dance(request.benches), budget=budget).time


def _speed(request: ContestRequest, budget: Budget) -> float:
    dance = Dance(request.to_dragon(request.benches), request.to_turn())
    return core.maximum_head_speed(dance, request.speed_limit, budget=budget).head_speed

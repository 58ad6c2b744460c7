"""How the answers change when one number of the problem does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

import core
from app.contest.solved import ContestRequest, Solved
from app.contest.words import Say
from core import BenchDragonError, Dance, Turn

# Values on each curve.
VALUES = 13
# Ranges of the width [m], of the turning diameter [m], of the length of a body [m] and of the ratio of the arcs [1].
WIDTHS, DIAMETERS, LENGTHS, RATIOS = (0.26, 0.38), (7.0, 11.0), (1.8, 2.6), (0.5, 2.1)


@dataclass(frozen=True)
class Panel:
    """varied, answer: what the two axes show, with units; points: the curve; own: the value of this problem

    A value at which the question has no answer has no point.
    """

    varied: str
    answer: str
    points: list[tuple[float, float]]
    own: tuple[float, float]


def panels(solved: Solved, say: Say) -> list[Panel]:
    """Minimum pitch against width, turning diameter and length of a body; head speed against the ratio of the arcs."""
    asked, pitch = solved.asked, solved.pitch.pitch
    shown = say("minimum pitch [m]", "最小螺距 [m]")
    limits = (
        ("width", WIDTHS, say("width of the benches [m]", "板宽 [m]")),
        ("turning_diameter", DIAMETERS, say("turning diameter [m]", "调头圆直径 [m]")),
        ("body_length", LENGTHS, say("length of a body bench [m]", "龙身板长 [m]")),
    )
    found = [
        Panel(words, shown, _curve(asked, name, limit, _pitch), (getattr(asked, name), pitch))
        for name, limit, words in limits
    ]
    ratio, speed = say("ratio of the arcs", "圆弧半径之比"), say("maximum head speed [m/s]", "龙头最大速度 [m/s]")
    return [
        *found,
        Panel(ratio, speed, _curve(asked, "ratio", RATIOS, _speed), (asked.ratio, solved.fastest.head_speed)),
    ]


def _curve(
    asked: ContestRequest, name: str, limits: tuple[float, float], answer: Callable[[ContestRequest], float]
) -> list[tuple[float, float]]:
    found = []
    for value in np.linspace(*limits, VALUES).tolist():
        other: dict[str, Any] = {name: value}
        try:
            found.append((value, answer(asked.model_copy(update=other))))
        except BenchDragonError:
            continue  # these benches fit on no such spiral or turn
    return found


def _pitch(asked: ContestRequest) -> float:
    dragon = asked.to_dragon(asked.benches)
    return core.minimum_pitch(dragon, turning_radius=asked.turning_diameter / 2, start_turns=asked.start_turns).pitch


def _speed(asked: ContestRequest) -> float:
    turn = Turn(asked.turn_pitch, asked.turning_diameter / 2, asked.ratio, start_turns=asked.start_turns)
    return core.maximum_head_speed(Dance(asked.to_dragon(asked.benches), turn), asked.speed_limit).head_speed

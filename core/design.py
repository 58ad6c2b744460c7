"""How tight may the curve be: minimum_pitch()."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.dragon import Dragon


class LimitedBy(StrEnum):
    """What stops the pitch from being smaller."""

    GRAZE = "graze"
    CIRCLE = "circle"
    START = "start"


@dataclass(frozen=True, slots=True)
class MinimumPitch:
    """The smallest pitch such that every larger one is free of contact down to the turning circle.

    pitch: [m]; pitch_bracket: (infeasible, feasible) [m]
    limited_by: graze on the way, contact exactly on the circle, or the start radius
    benches: the pair that touches just below (None when the start radius limits without contact)
    head_radius: [m], where; other_feasible_intervals: [m], islands below pitch
    justified_by: 'bound' or 'scan': how it is known that every larger pitch is feasible
    evaluations: poses examined
    """

    pitch: float
    pitch_bracket: tuple[float, float]
    limited_by: LimitedBy
    benches: tuple[int, int] | None
    head_radius: float | None
    other_feasible_intervals: tuple[tuple[float, float], ...]
    justified_by: str
    evaluations: int


def minimum_pitch(
    dragon: Dragon, *, turning_radius: float = 4.5, start_turns: float = 16.0, margin: float = 0.0
) -> MinimumPitch:
    """The smallest pitch such that every larger one lets the head reach the turning circle."""
    raise NotImplementedError

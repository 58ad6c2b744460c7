"""The circle, the coils and the margin that all questions about turns share, checked once."""

from __future__ import annotations

import math
from typing import NamedTuple

from core.checks import checked_number
from core.contact.search import MARGIN_MAX
from core.paths.turn import RATIO_MAX, RATIO_MIN, Turn


class CheckedCircle(NamedTuple):
    """pitch, radius: of the circle [m]; ratio: of the arcs' radii, None: any; start_turns: of both coils; margin [m]"""

    pitch: float
    radius: float
    ratio: float | None
    start_turns: float
    margin: float

    @property
    def growth(self) -> float:
        """Radial advance of the coils [m/rad]."""
        return self.pitch / (2.0 * math.pi)

    def turn(self, entry: float | None = None, leaving: float | None = None, ratio: float | None = None) -> Turn:
        """The turn from an entry radius to an exit radius [m]; by default it enters on the circle and leaves opposite.

        ratio: by default that of the circle, or 1 if any is allowed
        raises: InvalidValue
        """
        chosen = ratio or self.ratio or 1.0
        return Turn(
            self.pitch, self.radius, chosen, start_turns=self.start_turns, entry_radius=entry, exit_radius=leaving
        )  # fmt: skip


def checked_circle(
    pitch: float,
    turning_radius: float,
    ratio: float | None,
    start_turns: float,
    margin: float = 0.0,
    *,
    any_ratio: bool = False,
) -> CheckedCircle:
    """The circle of a question. any_ratio: True allows the ratio None, which means any

    raises: InvalidValue for values that no turn can have
    """
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    free = any_ratio and ratio is None
    chosen = 1.0 if free else checked_number("ratio", ratio, "", RATIO_MIN, RATIO_MAX)
    whole = Turn(pitch, turning_radius, chosen, start_turns=start_turns)
    return CheckedCircle(whole.pitch, whole.turning_radius, None if free else chosen, whole.start_turns, margin)

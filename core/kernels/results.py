"""Results of a march, as values."""

from __future__ import annotations

from typing import NamedTuple

from core.kernels.constants import Ended


class Dip(NamedTuple):
    """A local minimum of the clearance [m], at a moment, of a pair.

    moment: travel of the head [m], or on a stage of several dragons the time [s]; pair: two benches, or two rows there
    """

    gap: float
    moment: float
    pair: tuple[int, int]


class Marched(NamedTuple):
    """Result of a march: how it ended, the bracket around what it met, and what it spent.

    Its unit u is that of the moments of the march: m of travel of the head on one path, m of its radius in a band, s on
    a stage of several dragons.
    proven: nothing comes within the margin up to here [u]
    touching: where a pair is within the margin for certain [u], None if nothing was found; pair: as in a Dip
    half: half the width of the bracket around the contact [u]
    steps: number taken; work: see core/kernels/constants.py
    gap_curvature: the largest bound on the second derivative of a gap that proved one [m/u^2]
    graze: the least local minimum of the clearance seen on the way
    """

    ended: Ended
    proven: float
    touching: float | None = None
    pair: tuple[int, int] = (0, 0)
    half: float = 0.0
    steps: int = 0
    work: float = 0.0
    gap_curvature: float = 0.0
    graze: Dip | None = None

    @property
    def hidden(self) -> bool:
        """True if rounding, or the end of the work, hides whether any pair is within the margin."""
        return self.ended is Ended.STUCK and self.touching is None

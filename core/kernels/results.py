"""Results of a march, as values."""

from __future__ import annotations

from typing import NamedTuple


class Dip(NamedTuple):
    """A local minimum of the clearance [m], at a moment, of a pair.

    moment: travel of the head [m], or on a stage of several dragons the time [s]; pair: two benches, or two rows there
    """

    gap: float
    moment: float
    pair: tuple[int, int]


class Marched(NamedTuple):
    """Result of a march.

    proven: nothing comes within the margin up to here [m], a travel of the head in a march, a radius of it in a band
    touching: travel or radius at which benches are within the margin [m], None if nothing was found; benches: that pair
    steps: number taken; gap_curvature: the largest bound on the second derivative of a gap that proved one [1/m]
    graze: the least local minimum of the clearance seen on the way
    """

    proven: float
    touching: float | None = None
    benches: tuple[int, int] = (0, 0)
    steps: int = 0
    gap_curvature: float = 0.0
    graze: Dip | None = None

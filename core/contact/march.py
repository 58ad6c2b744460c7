"""A march: how narrow its bracket is, how it ended, and what it found."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

# Half width of the bracket around a contact [m of head travel] at head speeds of 1 m/s and more, and the least that
# rounding of the travel allows at lower ones.
BRACKET = 1e-10
BRACKET_MIN = 2e-11
# Wider half widths [m of head travel], one after the other, for contacts within about 5e-5 m of a graze, where benches
# meet so slowly that rounding hides so small a gap. The first makes a bracket of 1e-9 s at 1 m/s, to which
# core/contact/near_graze.py narrows the wider ones. Below 1 m/s the same numbers in seconds come first.
BRACKETS_GRAZING = (4.9e-10, 5e-9, 5e-8, 5e-7, 5e-6, 5e-5)
# Largest error of a travel, relative to the way [1], u = 2^-53: on a spiral its length is good to 5 u, two differences
# from it and the polar angle there to 10 u (spiral_theta() ends within 7 u of the arc length left), and a travel made a
# time and a travel again to 2 u.
TRAVEL_ROUNDING = 2e-15


class Ended(StrEnum):
    """How a march ended, in the order of the kernels' states: see core/kernels/marching.py, strips.py for TURNED.

    No kernel ends with the last two: a bench folds on the way, or no bound holds for a band of pitches.
    """

    REACHED = "reached"
    TOUCHED = "touched"
    TOUCHED_AT_START = "touched_at_start"
    STUCK = "stuck"
    CAPACITY = "capacity"
    TURNED = "turned"
    FOLDED = "folded"
    UNBOUNDED = "unbounded"


ENDS = tuple(Ended)
TOUCHES = (Ended.TOUCHED, Ended.TOUCHED_AT_START)


class Dip(NamedTuple):
    """A local minimum of the clearance [m], at a travel of the head [m], of a pair."""

    gap: float
    travel: float
    benches: tuple[int, int]


class Marched(NamedTuple):
    """Result of a march.

    proven: nothing comes within the margin up to this travel [m]; touching: benches are within it at this one [m], None
        where nothing was found; benches: that pair
    steps: taken; bend: the largest bound on the second derivative of a gap that proved one of them [1/m]
    graze: the least local minimum of the clearance seen on the way
    """

    proven: float
    touching: float | None = None
    benches: tuple[int, int] = (0, 0)
    steps: int = 0
    bend: float = 0.0
    graze: Dip | None = None

    def followed_by(self, further: Marched) -> Marched:
        """The result of this march and of one that went on from where it was proven."""
        grazes = [march.graze for march in (self, further) if march.graze is not None]
        return further._replace(
            proven=max(self.proven, further.proven),
            steps=self.steps + further.steps,
            bend=max(self.bend, further.bend),
            graze=min(grazes, default=None),
        )

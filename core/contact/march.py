"""A march: the width of its bracket, the error of its travels, and how it ended."""

from __future__ import annotations

from enum import StrEnum

# Half width of the bracket around a contact [m of head travel] at head speeds of 1 m/s and more, and the least half
# width that rounding of the travel allows at lower speeds.
BRACKET = 1e-10
BRACKET_MIN = 2e-11
# Wider half widths [m of head travel] to try for contacts within about 5e-5 m of a graze, where benches meet so slowly
# that rounding hides the gap. The first gives a bracket of 1e-9 s at 1 m/s, to which core/contact/near_graze.py narrows
# the wider ones. Below 1 m/s the same numbers in seconds come first.
BRACKETS_GRAZING = (4.9e-10, 5e-9, 5e-8, 5e-7, 5e-6, 5e-5)
# Largest relative error of a travel [1], u = 2^-53: 5 u for the length of a spiral, 10 u for two differences from it
# and the polar angle there (spiral_theta() ends within 7 u of the remaining arc length), and 2 u for a travel that
# becomes a time and a travel again.
TRAVEL_ROUNDING = 2e-15


class Ended(StrEnum):
    """End of a march, in the order of the kernels' states: see core/kernels/marching.py, strips.py for TURNED.

    No kernel ends with the last two, a bench that folds on the way, and a band of pitches for which no bound holds.
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

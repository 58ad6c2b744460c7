"""What every picture of dances has alike: the colours of several dragons, and how much of a square is shown."""

from __future__ import annotations

import numpy as np

from core import Venue
from core.plots import BLUE, VERMILION
from core.values import Floats

# Colours of the dragons in turn (Okabe and Ito).
COLOURS = (BLUE, VERMILION, "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
# The whole square is drawn if it is at most this many times as large as the dance; else only the part around the dance.
SQUARE_MOST = 2.0


def colour_of(dragon: int) -> str:
    """Colour of one of several dragons, by its number."""
    return COLOURS[dragon % len(COLOURS)]


def with_square(venue: Venue | None, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Corners (2,) [m] of the drawn part: dance and square, or only the dance if the square is much larger."""
    if venue is None:
        return low, high
    square = np.array(venue.square.rings[0])
    least, most = np.minimum(low, square.min(axis=0)), np.maximum(high, square.max(axis=0))
    return (least, most) if (most - least <= SQUARE_MOST * (high - low)).all() else (low, high)

"""What every picture of dances has alike: the colours of several dragons, and how much of a square is shown."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from core import Performance, Venue
from core.plots import BLUE, VERMILION
from core.shapes.engines import without_streets
from core.values import Floats

# Colours of the dragons in turn (Okabe and Ito); as on the page, the first three are red, blue and green.
COLOURS = (VERMILION, BLUE, "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
# The whole square is drawn if it is at most this many times as large as the dance; else only the part around the dance.
SQUARE_MOST = 2.0
# Brightest shade on which words are white [1].
DARK = 0.55
# Length of a street that belongs to the square on a map [m].
STREET = 5.0


def colour_of(performance: Performance, dragon: int) -> str:
    """Colour of one of several dragons: its own, or one by its number."""
    return performance.parts[dragon].colour or COLOURS[dragon % len(COLOURS)]


def ink_on(colour: str) -> str:
    """Black or white, whichever can be read on a colour, #rrggbb."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5))
    return "#000000" if 0.30 * red + 0.59 * green + 0.11 * blue > DARK else "#ffffff"


@lru_cache(maxsize=4)
def square_alone(venue: Venue) -> tuple[Floats, Floats]:
    """Corners (2,) [m] of a venue's square with the first metres of its streets."""
    ring, (low, high) = np.array(venue.square.rings[0]), without_streets(venue.square.rings)
    return np.maximum(ring.min(axis=0), low - STREET), np.minimum(ring.max(axis=0), high + STREET)


def with_square(venue: Venue | None, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Corners (2,) [m] of the drawn part: dance and square, or only the dance if the square is much larger.

    Streets are drawn as far as the dance is in them, and their first metres.
    """
    if venue is None:
        return low, high
    least, most = square_alone(venue)
    least, most = np.minimum(low, least), np.maximum(high, most)
    return (least, most) if (most - least).max() <= SQUARE_MOST * (high - low).max() else (low, high)

"""Types of arrays, points, intervals, pairs and listeners."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]
# Beginning and end, or least and largest value.
Interval = tuple[float, float]
# Numbers of two benches, or of two dragons.
Pair = tuple[int, int]
# Called with the share of the work that is done, 0 to 1.
Progress = Callable[[float], None]


def unheard(news: object) -> None:
    """Listener that ignores what it is told, such as progress."""

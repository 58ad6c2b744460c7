"""Arrays and points, and the limits of the numbers that users give."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]

# Smallest and largest size [m]: sizes outside describe no dance, and lose digits in c^2 / b^2.
SIZE_MIN = 1e-3
SIZE_MAX = 1e4
# Largest coordinate [m]: larger ones lose the digits that the chords need.
COORDINATE_MAX = 1e5
# Largest angle [rad]: larger ones lose the digits that the joints need.
ANGLE_MAX = 1e6
# Longest name of a bench or an area [characters].
NAME_MAX = 200
# Unicode's categories of control characters, half characters, and ends of lines and paragraphs.
NOT_PLAIN = ("Cc", "Cs", "Zl", "Zp")

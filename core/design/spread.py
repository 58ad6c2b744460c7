"""Lower bound of the separation of benches of several dragons on a wide spiral, which holds for every larger growth."""

from __future__ import annotations

import math

import numpy as np

from core.design.straight import STRAIGHT_ROUNDING, curvature_most
from core.dragon import Dragon

# Several dragons wind into one spiral r = b theta, each turned by a = 2 pi / n against the one before. Let rho be the
# least radius of any handle. A point of a bench is within h = max(hypot(o, w), w + (c / 2) tan beta) of the arc between
# its handles, sin beta = k c / 2, with the curvature k and the lengths c, o, w of straight.py. So two benches of
# different dragons are apart by at least the distance of their arcs less 2 h.
#
# Let points of two arcs be at radii r and r + u, u >= 0. Their polar angles differ by u / b and a multiple of a that is
# no whole turn, so by at least a - u / b from every whole turn. While this is not negative,
#     distance^2 >= u^2 + 4 rho^2 sin^2((a - u / b) / 2).
# For u >= d the distance is at least d; for u < d it exceeds 2 rho sin((a - d / b) / 2), as a <= pi. So no two benches
# come within the margin if d = 2 h + margin is less than a b and than 2 rho sin((a - d / b) / 2). As b grows, k and d
# do not grow and a - d / b does not fall; so the bound holds for every larger growth, and for every larger radius.


class Spread:
    """The lengths of equal dragons in one spiral that this bound needs.

    total: stands for that of Straight, which helps only within one dragon
    """

    total = math.inf

    def __init__(self, dragon: Dragon, dragons: int) -> None:
        distinct = slice(None, dragon.uniform_from + 1)
        self.chord, self.half_width = float(dragon.chords[distinct].max()), 0.5 * float(dragon.widths[distinct].max())
        self.diagonal = float(np.hypot(dragon.overhangs[distinct], 0.5 * dragon.widths[distinct]).max())
        self.apart = math.tau / dragons

    def clears(self, growth: float, radius: float, margin: float) -> bool:
        """True if benches of two dragons are further apart than a margin [m] from a radius [m] outwards, on the spiral
        of this growth [m/rad] and on every wider one."""
        sine = 0.5 * curvature_most(growth, radius) * self.chord
        if sine >= math.sqrt(0.5):
            return False
        reach = 2.0 * max(self.diagonal, self.half_width + 0.5 * self.chord * math.tan(math.asin(sine)))
        apart = reach + margin
        apart += STRAIGHT_ROUNDING * (apart + radius)
        turned = self.apart * (1.0 - STRAIGHT_ROUNDING) - apart / growth
        return turned > 0.0 and 2.0 * radius * math.sin(0.5 * turned) > apart

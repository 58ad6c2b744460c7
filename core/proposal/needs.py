"""What a dragon needs on its way: room on both sides of its path, room between two parts of it, and length.

A bench with chord c and width w on a bend of radius R has its middle sqrt(R^2 - c^2 / 4) from the centre, so its inner
side is R - sqrt(R^2 - c^2 / 4) + w / 2 inside the path, and its outer corners, c / 2 + overhang along, are
hypot(sqrt(R^2 - c^2 / 4) + w / 2, c / 2 + overhang) - R outside. On a straight stretch both are w / 2. A point of a
bench whose holes stray moves by its gain times the stray at most (core/shapes/reach.py).

These numbers only select what is worth a check: a bench that enters or leaves a bend is between both cases.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.dragon import Dragon
from core.paths.following import tightest_bend
from core.shapes.reach import gains
from core.values import Floats

# Radius of the tightest bend that is proposed, in least radii that benches can follow; and of an easy one [1]. In the
# tightest one the bench stands 65 degrees across its path.
TIGHT, EASY = 1.1, 2.0
# Room between the head and the tail on a closed figure, besides what they need [m].
SPARE = 0.3


@dataclass(frozen=True)
class Needs:
    """Needs of a dragon whose people may stray, with a margin. stray, margin: [m]"""

    dragon: Dragon
    stray: float
    margin: float

    @cached_property
    def gain(self) -> float:
        """Largest way of a point of a bench per metre of stray [1]."""
        return float(self._kinds(gains(self.dragon)).max())

    def _kinds(self, column: Floats) -> Floats:
        return column[: self.dragon.uniform_from + 1]

    @cached_property
    def length(self) -> float:
        """From the first handle to the last one, in a straight line [m]."""
        return float(self.dragon.chords.sum())

    @cached_property
    def chord(self) -> float:
        """The longest chord [m]."""
        return float(self._kinds(self.dragon.chords).max())

    @cached_property
    def overhang(self) -> float:
        """The longest overhang [m]."""
        return float(self._kinds(self.dragon.overhangs).max())

    @cached_property
    def tight(self) -> float:
        """Radius of the tightest bend [m]."""
        return TIGHT * tightest_bend(self.dragon)[0]

    @property
    def radii(self) -> tuple[float, ...]:
        """Radii of bends to try, the easiest first [m]."""
        return (self.tight * EASY / TIGHT, self.tight * 0.5 * (1.0 + EASY / TIGHT), self.tight)

    @property
    def free(self) -> float:
        """Clearance that margin and stray take on each side [m]."""
        return self.margin + self.gain * self.stray

    @property
    def gap(self) -> float:
        """Length between the last handle and the first one on a closed figure [m]."""
        overhangs = self._kinds(self.dragon.overhangs)
        return float(overhangs[0] + overhangs[-1]) + self.margin + 2.0 * self.gain * self.stray + SPARE

    def sides(self, curvature: Floats) -> Floats:
        """Ground that benches take beside a path of these curvatures (N,) [1/m], without margin and stray (N,) [m]."""
        bend = np.minimum(np.abs(curvature), 1.0 / (0.5 * self.chord))
        radius = 1.0 / np.maximum(bend, 1e-9)
        most = np.zeros(len(curvature))
        columns = (self._kinds(column) for column in (self.dragon.chords, self.dragon.widths, self.dragon.overhangs))
        for chord, width, overhang in sorted(set(zip(*(column.tolist() for column in columns), strict=True)))[:64]:
            inner = np.sqrt(np.maximum(radius * radius - 0.25 * chord * chord, 0.0))
            inside = radius - inner + 0.5 * width
            outside = np.hypot(inner + 0.5 * width, 0.5 * chord + overhang) - radius
            most = np.maximum(most, np.maximum(inside, outside))
        return most

    @property
    def straight_side(self) -> float:
        """Ground that benches take beside a straight path [m]."""
        return 0.5 * float(self._kinds(self.dragon.widths).max())

    @property
    def least_width(self) -> float:
        """Width of free ground that no dance can do without [m]: that of the largest circle in a bench, with the margin
        and, because all people may stray to one side together, the stray on both sides."""
        sizes = np.minimum(self._kinds(self.dragon.widths), self._kinds(self.dragon.lengths))
        return float(sizes.max()) + 2.0 * (self.margin + self.stray)

    @property
    def takes(self) -> tuple[float, ...]:
        """What a single bench takes: chord, overhang, half width, margin with stray [m]."""
        return (self.chord, self.overhang, self.straight_side, self.free)

    @property
    def turning_width(self) -> float:
        """Diameter of the circle in which the longest bench turns on the tightest bend that is tried, margin and stray
        included [m]. A wish: a bend that is 1.1 times as tight can be danced."""
        return 2.0 * (self.outer(self.tight) + self.free)

    def outer(self, radius: float) -> float:
        """Radius of the circle in which the longest bench turns on a bend of a radius, without margin and stray [m]."""
        middle = math.sqrt(radius**2 - 0.25 * self.chord**2)
        return math.hypot(middle + self.straight_side, 0.5 * self.chord + self.overhang)

    def length_along(self, radius: float) -> float:
        """From the first handle to the last one along a circle of a radius that benches can follow [m]."""
        sines = np.minimum(self.dragon.chords / (2.0 * radius), 1.0)
        return float((2.0 * radius * np.arcsin(sines)).sum())

    @property
    def least_area(self) -> float:
        """Ground that the benches cover at least at any moment [m2]: every other one, because only neighbours, which
        share a handle, may overlap."""
        sizes = self.dragon.lengths * self.dragon.widths
        return float(max(sizes[::2].sum(), sizes[1::2].sum()))

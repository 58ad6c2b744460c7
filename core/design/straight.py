"""Lower bound of the separation of benches on a wide spiral, which holds for every larger growth."""

from __future__ import annotations

import math

import numpy as np

from core import kernels
from core.checks import SIZE_MAX
from core.dragon import Dragon
from core.errors import InvalidValue
from core.kernels.constants import FREE, NO_BOUND
from core.quantities import Parameter, Quantity, quantities
from core.values import Floats

# Rounding of the bound, in units of the lengths in its sums, u = 2^-53 [1]. The relative error of k is at most 8 u,
# that of angles 14 u, that of 1 - cos phi 12 u + 14 u phi sin phi; so every factor of a length is accurate to 60 u. The
# lengths of one sum are together at most 4 times those named in least(). If `across` is longer than these, it exceeds
# every margin that the gap exceeds. Angles at their limits need no more, because the bound is smooth there. The test
# whether a dragon is too short to reach half around has the same allowance.
STRAIGHT_ROUNDING = 3e-14
# S is chosen so that benches further apart along the path have at least the gap of a straight line between them, and at
# least this part of the distance that two benches can bridge [1].
SPARE = 0.05

# The curvature of the spiral r = b theta at a radius r is (r^2 + 2 b^2) / (r^2 + b^2)^(3/2). It falls with r, and, at a
# fixed r, with b from b = r / sqrt(2) on, where it is 2 / (1.5^(3/2) r) < 1.0887 / r, its largest for any b. So k, its
# value at the least radius rho and the least growth b (1.0887 / rho while b < rho / sqrt(2)), bounds the curvature from
# rho outwards for b and every larger growth. With chords at most c, overhangs o and half widths w, and k c / 2 < 1:
#
# A bench's arc, from handle to handle, turns by at most k l <= 2 beta, sin beta = k c / 2 (bounds.py), and the tangents
# along it lean by at most beta from the chord: the arc is within (c / 2) tan beta of the chord, and every point of a
# bench within h = max(hypot(o, w), w + (c / 2) tan beta) of its arc.
#
# Benches i and i + 2, beta_i that of bench i. Neighbours' directions differ by at most phi = beta_i + beta_(i+1). Along
# the direction of the bench between them a point of bench i lies behind its rear handle by at most
# o_i cos x + w_i sin x, x <= phi <= pi / 2 the angle between the two, which grows up to x = atan(w_i / o_i). So with
# d(phi) its value at phi or, if phi is more, at that angle, the benches are apart by at least
#     c_(i+1) - d_i(beta_i + beta_(i+1)) - d_(i+2)(beta_(i+1) + beta_(i+2)).
# On a straight line they are apart by c_(i+1) - o_i - o_(i+2); the least of these is g. On a wide spiral it is less:
# the inner corners lean towards each other by angles x and y, which costs w_i x + w_(i+2) y and gains only terms of
# second order. So if it is at most the margin on a straight line, they come within the margin on every wide enough
# spiral.
#
# Benches further apart. Let the arc between two points, at theta and theta + delta, be S or longer, S <= pi / k. Where
# delta <= pi they are apart by at least (2 / k) sin(k S / 2): that holds where the arc is S (Schur, bounds.py), and the
# distance grows with delta (spiral.py). Where delta >= pi they are apart by at least b delta >= pi b, and, with
# x = 2 pi - delta in [0, pi], also by at least
#     sqrt(b^2 delta^2 + 4 rho^2 sin^2(delta / 2)) >= sqrt(b^2 (2 pi - x)^2 + 4 rho^2 x^2 / pi^2)
#                                                 >= 2 pi b / sqrt(1 + (pi b / (2 rho))^2),
# both growing with b; a dragon whose arcs together are shorter than pi rho has no such points. So where the arc from
# the rear handle of i to the front handle of j is S or longer, the benches are apart by the lesser of the two less 2 h.
# S is at most the least sum of two consecutive chords between others. If that is too short, a longer S is used, and
# benches nearer than S along the path are compared along one direction as above, that in the middle of their tangents:
# these turn by at most k S + 4 beta from i to j, so with phi = k S / 2 + 2 beta <= pi / 2 they are apart by at least
#     (sum of the chords between) - o_i - o_j - S (1 - cos phi) - 2 w sin phi,
# and that sum is at least
#     c_(i+1) + c_(j-1) = (c_(i+1) - o_i - o_(i+2)) + (c_(j-1) - o_(j-2) - o_j) + o_i + o_(i+2) + o_(j-2) + o_j,
# at least 2 g + o_i + o_j. As b grows k falls to 0, and the bound exceeds the margin in the end wherever g does.


def curvature_most(growth: float, radius: float) -> float:
    """Largest curvature of a spiral of this growth [m/rad] or a larger one from this radius [m] outwards [1/m]."""
    if math.sqrt(2.0) * growth <= radius:
        return float(kernels.SPIRAL_CURVATURE_MOST) / radius
    square = radius * radius + growth * growth
    return (square + growth * growth) / (square * math.sqrt(square))


class Straight:
    """Lengths of a dragon that the bound needs.

    gap: least separation of benches `at` and `at` + 2 on a straight line [m]; between: least sum of two consecutive
        chords between others [m]; both FREE without such benches; chord, overhang, half_width: the largest ones [m];
        total: sum of all chords [m]
    """

    def __init__(self, dragon: Dragon) -> None:
        distinct = min(dragon.benches, dragon.uniform_from + 4)
        chords, overhangs = dragon.chords[:distinct], dragon.overhangs[:distinct]
        half_widths = 0.5 * dragon.widths[:distinct]
        self.chord, self.overhang = float(chords.max()), float(overhangs.max())
        self.half_width, self.total = float(half_widths.max()), float(dragon.chords.sum())
        self.gap, self.at, self.between = FREE, 0, FREE
        if distinct > 2:
            gaps = chords[1:-1] - overhangs[:-2] - overhangs[2:]
            self.at = int(gaps.argmin())
            self.gap = float(gaps[self.at])
        if distinct > 3:
            self.between = float((chords[1:-2] + chords[2:-1]).min())
        self._chords, self._overhangs, self._half_widths = chords, overhangs, half_widths
        self._diagonals = np.hypot(overhangs, half_widths)

    def clears(self, growth: float, radius: float, margin: float) -> bool:
        """True if the bound exceeds a margin [m]. See least()."""
        return self._further(growth, radius) > margin and self.least(growth, radius) > margin

    def least(self, growth: float, radius: float) -> float:
        """Lower bound of the separation of any two benches that share no handle [m], with the front handle of the inner
        one at the radius [m] or further out, on the spiral of this growth [m/rad] and on every wider one; NO_BOUND if
        there is no bound."""
        further = self._further(growth, radius)
        if further == NO_BOUND or self.gap >= FREE:
            return further
        rounding = STRAIGHT_ROUNDING * (abs(self.gap) + self.chord + self.overhang + 2.0 * self.half_width)
        return min(further, self._next_but_one(curvature_most(growth, radius))) - rounding

    def _further(self, growth: float, radius: float) -> float:
        """The bound for benches with at least two others between them, without rounding [m]; FREE if there are none."""
        width, diagonals = 2.0 * self.half_width, 2.0 * math.hypot(self.overhang, self.half_width)
        half_around = (1.0 - STRAIGHT_ROUNDING) * math.pi * radius
        if math.tau * growth <= diagonals and self.total >= half_around:  # neighbouring turns of the spiral may meet
            return NO_BOUND
        curvature = curvature_most(growth, radius)
        sine = 0.5 * curvature * self.chord
        if sine >= math.sqrt(0.5):  # 2 beta would pass pi / 2
            return NO_BOUND
        if self.between >= FREE:
            return FREE
        beta = math.asin(sine)
        bridged = max(diagonals, width + self.chord * math.tan(beta))
        least = self._along(curvature, beta, bridged)
        if 2.0 * beta * self.total >= half_around * curvature * self.chord:  # the dragon may reach half around
            across = 2.0 * math.pi * growth / math.hypot(1.0, 0.5 * math.pi * growth / radius)
            least = min(least, max(across, math.pi * growth) - bridged)
        return least

    def _next_but_one(self, curvature: float) -> float:
        """The bound for benches i and i + 2 [m]."""
        betas = np.arcsin(0.5 * curvature * self._chords)
        phi = betas[:-1] + betas[1:]
        sine, cosine = np.sin(phi), np.cos(phi)

        def reach(benches: slice, angles: slice) -> Floats:
            overhangs, half_widths = self._overhangs[benches], self._half_widths[benches]
            leaning = overhangs * cosine[angles] + half_widths * sine[angles]
            least = half_widths * cosine[angles] >= overhangs * sine[angles]
            return np.where(least, leaning, self._diagonals[benches])

        first, last = slice(None, -2), slice(2, None)
        gaps = self._chords[1:-1] - reach(first, slice(None, -1)) - reach(last, slice(1, None))
        return float(gaps.min())

    def _along(self, curvature: float, beta: float, bridged: float) -> float:
        """The bound for benches less than half a turn apart, with at least two others between them [m].

        bridged: 2 h [m]
        """
        half_turn = min(0.5 * curvature * self.between, 0.5 * math.pi)
        apart = 2.0 / curvature * math.sin(half_turn) - bridged
        spare = max(self.gap, SPARE * bridged)
        sine = 0.5 * curvature * (bridged + spare)
        if apart >= self.gap or sine >= 1.0:
            return apart
        half_turn = math.asin(sine)
        phi = half_turn + 2.0 * beta
        if phi > 0.5 * math.pi:
            return apart
        nearer = 2.0 * self.gap - 2.0 * half_turn / curvature * (1.0 - math.cos(phi))
        return max(apart, min(nearer - 2.0 * self.half_width * math.sin(phi), spare))


def too_near(dragon: Dragon, a: int, margin: float) -> InvalidValue:
    """The error for benches a and a + 2 within the margin on a straight line, or on the widest spiral."""
    b = a + 2
    chord, front, rear = (float(size) for size in (dragon.chords[a + 1], dragon.overhangs[a], dragon.overhangs[b]))
    gap = chord - front - rear
    hardly = gap > margin
    if hardly and margin:
        why = (
            "at a pitch of {pitch} benches {a} and {b} are nearer than that, and on a straight line they are "
            "{gap} apart"
        )
    elif hardly:
        why = "at a pitch of {pitch} benches {a} and {b} touch, and on a straight line they are {gap} apart"
    elif gap > 0.0:
        why = "on a straight line, and so on every wide enough spiral, benches {a} and {b} are {gap} apart"
    else:
        why = "on a straight line, and so on every wide enough spiral, benches {a} and {b} touch"
    why += ": the chord of bench {between} between them is {chord}, their overhangs {front} and {rear}"
    values = quantities("m", 9, front=front, rear=rear) | quantities("m", 6, pitch=SIZE_MAX)
    values |= quantities("m", 9, gap=gap, chord=chord) | {"a": a, "b": b, "between": a + 1}
    if gap > 0.0 and margin:
        rule = "must be smaller" if hardly else "must be less than {gap}"
        return InvalidValue("margin", f"{rule}: {why}", got=Quantity(margin, "m"), **values)
    if all((column[1:] == column[1]).all() for column in (dragon.lengths, dragon.widths)) and front == rear:
        body = float(dragon.lengths[a + 1])
        values |= quantities("m", 9, got=front, length=body, quarter=0.25 * body)
        rule = "must be smaller" if hardly else "must be less than a quarter of {body} ({length} / 4 = {quarter})"
        return InvalidValue("dragon.overhang", f"{rule}: {why}", body=Parameter("dragon.body_length"), **values)
    rule = "must be smaller" if hardly else "must be less than the chord of bench {between} ({chord})"
    got, values["other"] = f"{Quantity(front, 'm')} + {Quantity(rear, 'm')}", Parameter(f"dragon.overhangs.{b}")
    return InvalidValue(f"dragon.overhangs.{a}", f"+ {{other}} {rule}: {why}", got=got, **values)

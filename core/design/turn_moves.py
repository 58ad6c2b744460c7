"""Moves of a turn within a box: how far the curvatures and the points of its turns differ from a nominal one.

s = 0 stands at the tangent point M of both arcs, in each turn; the frame rotates with the entry.

Difference of curvatures over a stretch, an upper bound of 2 H: on the arcs |1 / r - 1 / r'|; beside the joint of an arc
and its coil, which is misplaced by the difference of the arc's lengths, at most the larger of both curvatures; on the
coils |dk / dr| <= 1.2 / r^2 (k growth = (2 + t^2) (1 + t^2)^(-3/2), and t^3 (t^2 + 4) (1 + t^2)^(-5/2) < 1.2 for all t)
times the difference of the radii at one s, at most that of the coil's end plus growth / r of that of the arc's length,
because dr / ds <= growth / r.

Points at one s. On the coil inwards, x behind the entry: with phi the angle from the entry, dx = sqrt(r^2 + growth^2)
dphi, r = a + growth phi; so at one x, phi changes by at most phi / sqrt(r^2 + growth^2) for each metre of a, and the
point by at most 1 + phi, phi <= x / a. On the first arc, x after the entry: the entry moves by the difference of a, the
direction there (theta + pi + atan theta, in a frame that rotates with theta) by that of atan theta, and the curvature
by that of 1 / r1; so the point moves by at most da + x dgamma + x^2 / 2 d(1 / r1). In both cases s = 0 at M instead of
x = 0 at the entry moves the point along its path by the difference of the first arc's lengths in addition. Beside the
entry, where one turn is on its coil and another on its arc, points move apart no faster than 1 for each metre.
From the exit it is the same, with b for a; and the exit, its coil and its direction rotate by the difference of v. On
the second arc, points may also be counted from M: it moves like any point of the first arc, and the direction there by
that at the entry and the difference of alpha1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.checks import SIZE_MIN
from core.design.turn_boxes import Turns, can_be_drawn, sizes_of
from core.dragon import Dragon
from core.paths.turn import Turn
from core.values import Floats

# Upper bound of |dk / dr| r^2 on a coil [1].
COIL_SLOPE = 1.2


@dataclass(frozen=True)
class Box:
    """Turns of a box beside its nominal one: the most by which each size differs from the nominal one, and bounds.

    nominal_point: its entry radius [m], angle to the exit [rad], log ratio
    entry, exit [m], turned [rad], arcs [m], angle [rad]: differences, the last one of the first arc's angle
    bends: of 1 / r of both arcs [1/m]; slants: of atan theta at entry and exit [rad]
    reach: least and greatest length of each arc [m]; least: least radii of entry and exit [m]
    sharpest: greatest curvatures of the arcs [1/m]
    All are Python's numbers, with which the many short sums below take a third of the time.
    """

    nominal: Turn
    nominal_point: Floats
    entry: float
    exit: float
    turned: float
    angle: float
    arcs: list[float]
    bends: list[float]
    slants: tuple[float, float]
    reach: list[list[float]]
    least: tuple[float, float]
    sharpest: list[float]

    @property
    def growth(self) -> float:
        return self.nominal.pitch / (2.0 * math.pi)


def box_of(pitch: float, turns: Turns, k: int, centre: Floats, half: Floats, least: float) -> Box | None:
    """Box k, with a nominal turn that benches can follow; None if neither its middle nor a corner is such a turn.

    centre, half: (3,) of the entry radius [m], the angle to the exit [rad], the log ratio; least: radius of a bend [m]
    """
    growth = pitch / (2.0 * math.pi)
    signs = np.array([[0.0] * 3, *([x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0))])
    points = centre + half * signs
    sizes = sizes_of(growth, *points.T)
    follows = (sizes[:2].min(axis=0) >= least) & (np.minimum(points[:, 0], sizes[5]) >= SIZE_MIN)
    fits = np.flatnonzero(follows & can_be_drawn(sizes))
    if not fits.size or not turns.whole[k]:
        return None
    best = int(fits[0])
    (a, _, logarithm), at = points[best], sizes[:, best]
    lows = np.array([[span.low[k], span.high[k]] for span in (*turns.radii, *turns.arcs)])
    radii, reach = lows[:2], lows[2:]
    arcs = np.array([at[0] * at[2], at[1] * at[3]])
    bends = np.abs(1.0 / np.maximum(radii, least) - (1.0 / at[:2])[:, None]).max(axis=1)
    inner = (float(centre[0] - half[0]), float(turns.exit.low[k]))
    span = np.abs(points - points[best]).max(axis=0)
    if min(*inner, reach.min()) <= 0.0 or not np.isfinite(lows).all():
        return None
    nominal = apart_from_circle(pitch, float(a), float(at[5]), math.exp(logarithm))
    return Box(
        nominal,
        points[best],
        float(span[0]),
        float(np.abs(points @ [1.0, growth, 0.0] - at[5]).max()),
        float(span[1]),
        float(max(turns.angles[0].high[k] - at[2], at[2] - turns.angles[0].low[k])),
        np.abs(reach - arcs[:, None]).max(axis=1).tolist(),
        bends.tolist(),
        (_slant(growth, points[:, 0], float(a)), _slant(growth, points @ [1.0, growth, 0.0], float(at[5]))),
        np.maximum(reach, 0.0).tolist(),
        inner,
        (1.0 / np.maximum(radii[:, 0], least)).tolist(),
    )


def apart_from_circle(pitch: float, entry: float, leaving: float, ratio: float) -> Turn:
    """A turn in a circle that is so large that it refuses none of its arcs. entry, leaving: radii [m]"""
    circle = 10.0 * (entry + leaving)
    return Turn(
        pitch, circle, ratio, start_turns=2.0 * circle / pitch + 20.0, entry_radius=entry, exit_radius=leaving
    )  # fmt: skip


def _slant(growth: float, radii: Floats, nominal: float) -> float:
    """Greatest difference of atan theta at one of the radii from that at the nominal one [rad]."""
    return float(np.abs(np.arctan(radii / growth) - math.atan(nominal / growth)).max())


def least_bend(dragon: Dragon) -> float:
    """Least radius of a bend that every bench can follow [m]."""
    return 0.5 * float(dragon.chords[: dragon.uniform_from + 1].max()) / kernels.ROUTE_SINE_LIMIT


def coil_bend(growth: float, radius: float) -> float:
    """Curvature of a coil at a radius [1/m]."""
    return float(kernels.spiral_curvature(radius / growth)) / growth


def bent(box: Box, low: float, high: float) -> float:
    """H of Lemma 1: half the greatest difference of the curvatures' integrals over the places low to high [rad]."""
    ((first_low, first_high), (second_low, second_high)), (inner, outer) = box.reach, box.least
    on_arcs = (_overlap(low, high, -first_high, 0.0), _overlap(low, high, 0.0, second_high))
    total = box.bends[0] * on_arcs[0] + box.bends[1] * on_arcs[1]
    growth = box.growth
    spread = (box.entry + box.arcs[0] * growth / inner, box.exit + box.arcs[1] * growth / outer)
    total += COIL_SLOPE / inner**2 * spread[0] * _overlap(low, high, -math.inf, -first_low)
    total += COIL_SLOPE / outer**2 * spread[1] * _overlap(low, high, second_low, math.inf)
    if low <= -first_low and high >= -first_high:
        total += max(box.sharpest[0], coil_bend(box.growth, inner)) * box.arcs[0]
    if low <= second_high and high >= second_low:
        total += max(box.sharpest[1], coil_bend(box.growth, outer)) * box.arcs[1]
    return 0.5 * float(total)


def displaced(box: Box, low: float, high: float) -> float:
    """Greatest distance of points at one place of the box's turns from the nominal ones, places low to high [m]."""
    ((first_low, first_high), (second_low, second_high)), (inner, outer) = box.reach, box.least
    furthest = 0.0
    if low < -first_low:  # on the coil inwards, or beside the entry
        furthest = box.entry * (1.0 + max(0.0, -first_low - low) / inner) + box.arcs[0]
        furthest += first_high - first_low if high > -first_high else 0.0
    if high > -first_high and low < 0.0:
        furthest = max(furthest, _on_first(box, min(0.0, high)))
    if high >= 0.0 and low < second_high:
        before, after = max(0.0, low), min(high, second_high)
        from_tangent = after * (box.slants[0] + box.angle) + 0.5 * after**2 * box.bends[1]
        way = second_high - before
        back = box.exit + (outer + 2.0 * box.exit) * box.turned + box.arcs[1]
        back += way * (box.turned + box.slants[1]) + 0.5 * way**2 * box.bends[1]
        furthest = max(furthest, min(_on_first(box, 0.0) + from_tangent, back))
    if high > second_low:  # on the coil outwards, or beside the exit
        way = high - second_low
        greatest = outer + 2.0 * box.exit + way
        far = box.exit * (1.0 + way / outer) + greatest * box.turned + box.arcs[1]
        furthest = max(furthest, far + (second_high - second_low if low < second_high else 0.0))
    return furthest


def _on_first(box: Box, place: float) -> float:
    """Greatest distance of points at one place of the first arc from the nominal ones [m]."""
    way = max(0.0, place + box.reach[0][1])
    return float(box.entry + way * box.slants[0] + 0.5 * way**2 * box.bends[0] + box.arcs[0])


def _overlap(low: float, high: float, begin: float, end: float) -> float:
    return max(0.0, min(high, end) - max(low, begin))

"""Turns in boxes of parameters: what closed forms say about all turns of a box at once.

The parameters are the entry radius a [m], the turn v from entry to exit [rad], which is the polar angle of the exit's
place on its coil less that of the entry's, and the logarithm of the ratio. So the exit radius is b = a + g v, g the
growth. A turn of a and b by one angle is nearly a rotation of the whole, so a and v are better directions of a box
than a and b.

In the frame that rotates with the entry (its direction is the x axis), with complex numbers for points:
    E = a,  n = (i - t) / sqrt(1 + t^2),  t = a / g;
    -X = b e^(iv),  n' = e^(iv) (i - t') / sqrt(1 + t'^2),  t' = b / g.
With D, A, B, r2 as in core/paths/turn.py; w = C2 - C1 = -(D + r1 n + r2 n') has the length r1 + r2. The first arc turns
clockwise from -n to w, the second one counter-clockwise from -w to n':
    alpha1 = arg(-n conj(w)),  alpha2 = arg(-n' conj(w)),  from 0 to 2 pi,  length L = r1 alpha1 + r2 alpha2.

The quadratic of core/paths/turn.py has one positive root, r2, and is negative below it. So r2 is l or more where it is
not positive at l, and r1 where it is not at l / ratio. With D = E - X and q the ratio, without a division,
    r2 >= l  <=>  q (c - 2 l D . n) <= 2 l D . n' + |D|^2,   c = 2 (1 - n . n') l^2,
    r1 >= l  <=>  c - 2 l D . n' <= q (2 l D . n + |D|^2).

Both angles are followed without jumps from their values at the middle of the box. A turn of the box whose angle so
followed is outside [0, 2 pi) has it 2 pi larger or smaller; `whole` says that none is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.checks import SIZE_MAX
from core.design.spans import Known, Span, angle_slopes, mean_value, parameters
from core.paths.pieces import LENGTH_MIN
from core.values import Floats

# Rounding of all closed forms here [m], [rad]: sizes are below 1e4 m and their errors some 1e-16 of them.
ROUNDING = 1e-11
# Largest room that a constraint has where it just holds [m].
JUST = 1e-6
# Least length of an arc [m], above that of a piece by more than rounding.
SHORTEST_ARC = 1.001 * LENGTH_MIN


@dataclass(frozen=True)
class Turns:
    """What is known about all turns of each box, (N,): the sizes at the middles, and intervals over the boxes.

    middle: (6, N) r1, r2 [m], alpha1, alpha2 [rad], length, exit radius [m] at the middles
    radii [m], angles [rad], arcs [m]: of the first and second arc, their lengths; length, exit [m]
    slopes: derivatives of r1, r2, the length, alpha1 and alpha2 by the three parameters
    whole: True where neither angle of a turn of the box leaves [0, 2 pi)
    """

    middle: Floats
    radii: tuple[Span, Span]
    angles: tuple[Span, Span]
    arcs: tuple[Span, Span]
    length: Span
    exit: Span
    slopes: tuple[tuple[Span, ...], ...]
    whole: NDArray[np.bool_]


def turns_of(turns: Turns, which: NDArray[np.intp]) -> Turns:
    """What is known about some of the boxes."""

    def taken(span: Span) -> Span:
        return Span(span.low[which], span.high[which])

    def both(pair: tuple[Span, Span]) -> tuple[Span, Span]:
        return taken(pair[0]), taken(pair[1])

    return Turns(
        turns.middle[:, which],
        both(turns.radii),
        both(turns.angles),
        both(turns.arcs),
        taken(turns.length),
        taken(turns.exit),
        tuple(tuple(map(taken, slopes)) for slopes in turns.slopes),
        turns.whole[which],
    )


def sizes_of(growth: float, entry: Floats, turned: Floats, log_ratio: Floats) -> Floats:
    """r1, r2 [m], alpha1, alpha2 [rad], length, exit radius [m] of turns, (6, N)."""
    ratio, leaving = np.exp(log_ratio), entry + growth * turned
    n, m, apart = _normals(growth, entry, leaving, turned)
    both = ratio * n + m
    level, squared = (apart * both.conj()).real, np.abs(apart) ** 2
    curved = 2.0 * ratio * (1.0 - (n * m.conj()).real)
    root = np.sqrt(level**2 + curved * squared)
    with np.errstate(divide="ignore", invalid="ignore"):
        least = np.where(level < 0.0, squared / (root - level), (root + level) / np.maximum(curved, 1e-30))
        towards = -(apart + least * both)
        angles = [np.angle(-normal * towards.conj()) % (2.0 * math.pi) for normal in (n, m)]
    return np.array([ratio * least, least, *angles, ratio * least * angles[0] + least * angles[1], leaving])


def _normals(growth: float, entry: Floats, leaving: Floats, turned: Floats) -> tuple[NDArray[np.complex128], ...]:
    """n and m at both ends of turns, and the way between these [m], (N,) each."""
    t, u, around = entry / growth, leaving / growth, np.exp(1j * turned)
    return (1j - t) / np.hypot(1.0, t), around * (1j - u) / np.hypot(1.0, u), entry + leaving * around


def can_be_drawn(sizes: Floats) -> NDArray[np.bool_]:
    """Which turns of these sizes (6, N), as sizes_of() has them, have arcs that a path may have."""
    arcs = (sizes[:2] * sizes[2:4]).min(axis=0)
    fits: NDArray[np.bool_] = (arcs >= SHORTEST_ARC) & (sizes[:2].max(axis=0) <= SIZE_MAX)
    return fits


@np.errstate(over="ignore", invalid="ignore")
def turns_in(growth: float, centres: Floats, halves: Floats) -> Turns:
    """What closed forms say about boxes. centres, halves: (3, N) of a [m], v [rad], log ratio [1].

    Where they say nothing, a number is infinite or NaN, and no comparison with it holds.
    """
    middle = sizes_of(growth, *centres)
    ends = _ends(growth, centres, halves)
    ratio, b, (nx, ny), (mx, my), (dx, dy), squared = ends
    level = ratio * (dx * nx + dy * ny) + dx * mx + dy * my
    curved = -((ratio * (nx * mx + ny * my).plus(-1.0)).scaled(2.0))
    root = (level.squared() + curved * squared).root()
    least = squared / (root - level)
    r2 = _on(middle[1], least, halves)
    r1 = _on(middle[0], ratio * r2, halves)
    wx, wy = -(dx + r1 * nx + r2 * mx), -(dy + r1 * ny + r2 * my)
    length = (r1 + r2).value.squared()
    angles = []
    for k, (px, py) in enumerate(((nx, ny), (mx, my))):
        x, y = -(px * wx + py * wy), -(py * wx - px * wy)  # of -n conj(w)
        slopes = angle_slopes(x, y, length)
        angles.append(Known(_allowed(mean_value(middle[2 + k], slopes, halves)), slopes))
    arcs = [r * angle for r, angle in zip((r1, r2), angles, strict=True)]
    total = arcs[0] + arcs[1]
    lows, highs = (np.array([getattr(angle.value, end) for angle in angles]) for end in ("low", "high"))
    return Turns(
        middle,
        (r1.value, r2.value),
        (angles[0].value, angles[1].value),
        (_on(middle[0] * middle[2], arcs[0], halves).value, _on(middle[1] * middle[3], arcs[1], halves).value),
        _on(middle[4], total, halves).value,
        b.value,
        (r1.slopes, r2.slopes, total.slopes, angles[0].slopes, angles[1].slopes),
        np.asarray((lows >= 0.0).all(axis=0) & (highs < 2.0 * math.pi).all(axis=0)),
    )


class _Ends(NamedTuple):
    """Ratio, exit radius b [m], normals n and n', D = E - X [m] and |D|^2 of all turns of each box."""

    ratio: Known
    b: Known
    n: tuple[Known, Known]
    m: tuple[Known, Known]
    apart: tuple[Known, Known]
    squared: Known


def _ends(growth: float, centres: Floats, halves: Floats) -> _Ends:
    a, v, logarithm = parameters(centres, halves)
    b = a + v.scaled(growth)
    t, u, sine, cosine = a.scaled(1.0 / growth), b.scaled(1.0 / growth), v.sine(), v.cosine()
    over, under = t.squared().plus(1.0).root().inverse(), u.squared().plus(1.0).root().inverse()
    squared = a.squared() + b.squared() + (a * b * cosine).scaled(2.0)
    m = (-(u * cosine + sine) * under, (cosine - u * sine) * under)
    return _Ends(logarithm.exponential(), b, (-t * over, over), m, (a + b * cosine, b * sine), squared)


def too_tight(growth: float, centres: Floats, halves: Floats, least: float) -> NDArray[np.bool_]:
    """True where an arc of all turns of a box is tighter than `least` [m], (N,)."""
    second, first = tighter(growth, centres, halves, least)
    return np.asarray(first | second)


@np.errstate(over="ignore", invalid="ignore")
def tighter(growth: float, centres: Floats, halves: Floats, least: float | Floats) -> list[NDArray[np.bool_]]:
    """True where the second arc of all turns of a box is tighter than `least` [m], and where the first one is, (N,)."""
    ratio, b, (nx, ny), (mx, my), (dx, dy), squared = _ends(growth, centres, halves)
    first, second = (dx * nx + dy * ny).scaled(2.0 * least), (dx * mx + dy * my).scaled(2.0 * least)
    curved = -(nx * mx + ny * my).plus(-1.0).scaled(2.0 * least**2)
    excess = ratio * (curved - first) - second - squared, curved - second - ratio * (first + squared)
    size = centres[0] + halves[0] + b.value.furthest + least
    spare = ROUNDING * (1.0 + ratio.value.high) * (1.0 + size**2)
    lows = [
        np.fmax(mean_value(at, known.slopes, halves).low, known.value.low)
        for at, known in zip(_excesses(growth, centres, least), excess, strict=True)
    ]
    return [np.asarray(low > spare) for low in lows]


def _excesses(growth: float, points: Floats, least: float | Floats) -> tuple[Floats, Floats]:
    """Left sides less right sides of the conditions for r2 and r1 at points (3, N), positive where too tight [m^2]."""
    entry, turned, log_ratio = points
    ratio, leaving = np.exp(log_ratio), entry + growth * turned
    n, m, apart = _normals(growth, entry, leaving, turned)
    first, second = (2.0 * least * (apart * one.conj()).real for one in (n, m))
    curved, squared = 2.0 * least**2 * (1.0 - (n * m.conj()).real), np.abs(apart) ** 2
    return ratio * (curved - first) - second - squared, curved - second - ratio * (first + squared)


def _on(at: Floats, known: Known, halves: Floats) -> Known:
    """The quantity with its value also from the mean value form, where that is narrower."""
    form = mean_value(at, known.slopes, halves)
    low, high = np.fmax(form.low, known.value.low), np.fmin(form.high, known.value.high)
    return Known(_allowed(Span(low, high)), known.slopes)


def _allowed(span: Span) -> Span:
    return Span(span.low - ROUNDING, span.high + ROUNDING)

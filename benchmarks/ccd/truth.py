"""The truth on a corner and an edge, certified in ball arithmetic: clear, or the first time at which they meet.

The corner is seen from the bench of the edge: `along` the edge from its middle, and `out` from it. Both are polynomials
with a proven error (series.py). That |along| stays below half the length of the edge is shown first, so the corner
meets the edge that is moved outwards by the margin where `out` falls to it. On a cell of travel out > margin is shown
by the mean value theorem, from its middle, or, if `out` does not turn there, from its lower end; else it is halved.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from flint import arb, arb_poly

from benchmarks.ccd.motion import CORNERS, Query, Stage
from benchmarks.ccd.pieces import ORDER, Piece, Unproven, Vector
from benchmarks.ccd.series import Expansion, at
from core.kernels.constants import HALF_LENGTH, HALF_WIDTH

# Half width of the intervals that one polynomial covers: first try, and least [m]. They overlap by OVERLAP of it [1].
HALF_MOST, HALF_LEAST = 0.06, 0.002
OVERLAP = 1e-9
# Largest number of cells for a claim [1].
CELLS_MOST = 1500
# Half widths of the bracket around a contact, tried in this order [m].
BRACKETS = tuple(10.0**k for k in range(-13, -6))
# Length before a bracket on which it is tried first [m].
LOOK_BACK = 1e-3


class Part(NamedTuple):
    """A stretch of travel [m]: where x = 0 is, its ends, how far out the corner is as a polynomial, and its rate."""

    middle: arb
    low: float
    high: float
    out: arb_poly
    rate: arb_poly


class Track:
    """A corner as seen from an edge that it is beside over the whole way. error: of all distances [m]"""

    def __init__(self, parts: list[Part], error: arb) -> None:
        self.parts, self.error = parts, error

    def out(self, travel: float) -> arb:
        """Distance of the corner out from the edge after a travel, less the error [m]."""
        part = next(part for part in self.parts if travel <= part.high)
        return part.out(arb(travel) - part.middle)

    def clear(self, margin: arb, start: float, stop: float) -> bool:
        """Whether the corner stays further out than the margin between two travels [m]."""
        least, left = margin + self.error, CELLS_MOST
        for part in self.parts:
            low, high = max(start, part.low), min(stop, part.high)
            cells = [(low, high)] if low < high else []
            while cells:
                a, b = cells.pop()
                left -= 1
                if not _above(part, least, arb(a) - part.middle, arb(b) - part.middle):
                    middle = (a + b) / 2
                    if left <= 0 or not a < middle < b:
                        return False
                    cells += [(middle, b), (a, middle)]
        return True

    def within(self, margin: arb, travel: float) -> bool:
        """Whether the corner is certainly nearer than the margin after a travel [m]."""
        return bool(self.out(travel) + self.error < margin)

    def contact(self, margin: arb, near: float) -> tuple[float, float] | None:
        """Travels next to a guess: clear up to the first, within the margin at the second [m]; None: not certified."""
        for half in BRACKETS:
            low, high = near - half, near + half
            if not 0.0 < low < high <= self.parts[-1].high or not self.within(margin, high):
                continue
            if self.clear(margin, max(0.0, low - LOOK_BACK), low):
                return (low, high) if self.clear(margin, 0.0, low) else None
        return None


def _above(part: Part, least: arb, first: arb, last: arb) -> bool:
    x = first.union(last)
    rate = part.rate(x)
    if rate > 0 or rate < 0:
        return bool(part.out(first if rate > 0 else last) > least)
    middle = (first + last) / 2
    return bool(part.out(middle) + rate * (x - middle) > least)


def covered(stage: Stage, pieces: list[Piece], place: float, span: float, last: int) -> list[tuple[float, Expansion]]:
    """Expansions that cover a way of the head, with the travel up to which each serves [m].

    raises: Unproven
    """
    half, start, expansions = min(HALF_MOST, span / 2), 0.0, []
    while start < span:
        try:
            middle = start + half
            expansion = Expansion(stage, pieces, place - middle, half * (1.0 + OVERLAP), last)
        except Unproven:
            half /= 2
            if half < HALF_LEAST:
                raise
            continue
        start = middle + half
        expansions.append((start, expansion))
        half = min(half, max((span - start) / 2, HALF_LEAST))
    return expansions


def track(expansions: list[tuple[float, Expansion]], query: Query, stage: Stage) -> Track:
    """A corner as seen from an edge, over the way that these expansions cover.

    raises: Unproven where the corner is not shown to be beside the edge all the way
    """
    parts: list[Part] = []
    worst, low = arb(0), 0.0
    for high, expansion in expansions:
        along, out, error = _seen(expansion, query, stage)
        worst = worst.max(error)
        parts.append(Part(arb(query.place) - expansion.middle, low, high, out, out.derivative()))
        half = arb(float(stage.sizes[query.edge_bench, (HALF_WIDTH, HALF_LENGTH)[query.edge % 2]]))
        if not abs(at(along, expansion.way)) + error < half:
            raise Unproven("the corner is not beside the edge")
        low = high
    return Track(parts, worst)


def _seen(expansion: Expansion, query: Query, stage: Stage) -> tuple[arb_poly, arb_poly, arb]:
    """The corner along the edge and out from it, as polynomials, and the error of both [m]."""
    centre, along, error = expansion.bench(query.corner_bench)
    base, axis, base_error = expansion.bench(query.edge_bench)
    own, other = (
        [arb(float(stage.sizes[bench, HALF_LENGTH])), arb(float(stage.sizes[bench, HALF_WIDTH]))]
        for bench in (query.corner_bench, query.edge_bench)
    )
    x, y = (sign * size for sign, size in zip(CORNERS[query.corner], own, strict=True))
    corner = Vector(centre.x + x * along.x - y * along.y, centre.y + x * along.y + y * along.x)
    to, axis = (Vector(*(arb_poly(part.coeffs()) for part in vector)) for vector in (corner - base, axis))
    (p, p_rest), (q, q_rest) = (_shortened(poly, expansion.half) for poly in (to.dot(axis), axis.cross(to)))
    # An error e of the handles turns a bench by 2 e / chord at most; twice all that covers what is of second order.
    far = abs(at(corner.x - base.x, expansion.way)) + abs(at(corner.y - base.y, expansion.way))
    turned = error / expansion.chords[query.corner_bench] * (own[0] + own[1])
    turned += base_error / expansion.chords[query.edge_bench] * far
    worst = (2 * (error + base_error + 2 * turned) + p_rest + q_rest).upper()
    seen = ((q, p - other[0]), (p, -q - other[1]), (q, -p - other[0]), (p, q - other[1]))
    return (*seen[query.edge], worst)


def _shortened(poly: Any, half: arb) -> tuple[arb_poly, arb]:
    """A polynomial without its powers above ORDER, and a bound on these."""
    coefficients = poly.coeffs()
    rest = sum((abs(value) * half ** (ORDER + 1 + k) for k, value in enumerate(coefficients[ORDER + 1 :])), arb(0))
    return arb_poly(coefficients[: ORDER + 1]), rest

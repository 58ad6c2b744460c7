"""The exact motion in ball arithmetic: every handle of a chain as a polynomial in the way, with a proven error.

The motion. A path is a table of pieces (core/kernels/constants.py), whose doubles are taken as exact numbers; a spiral
is r = pitch / (2 pi) theta. The head is at a place; handle k + 1 is behind handle k at the chord of bench k. Of all
points at that distance it is the one that the chain of doubles is next to: exactly one root lies around it. Nothing
else is taken from doubles.

The polynomials. Let x be the way of the head from the middle of an interval [-w, w] of its travel, and A(x) the point
of a handle, within e of a polynomial a(x). The next one stands at P(u(x)) on its piece, where G(x, u) =
|P(u) - A(x)|^2 - c^2 = 0. Newton's method for power series gives a polynomial p(x) of degree ORDER that solves this
with a(x) for A(x) to that order: R(x) = |P(p(x)) - a(x)|^2 - c^2 has only what rounding leaves of its coefficients up
to ORDER. Further ones are bounded by Cauchy: P is entire on every kind of piece, so R is, and |R_k| <= M / rho^k with M
a bound of |R| on the disc of radius rho = DISC w, by one evaluation on a complex ball. So
    |R(x)| <= sum of |R_k| w^k, k <= ORDER,   +   M DISC^-ORDER / (DISC - 1)     on [-w, w], and
    |G(x, p(x))| <= |R(x)| + 2 |P(p(x)) - a(x)| e + e^2 =: g.
If G_u is at least m > 0 in size for u within g / m of p(x), then exactly one root lies there, for every x: it is
continuous, and the one at x = 0 is next to the double. P(p(x)) is expanded and bounded in the same way, and moves by
no more than |P'| g / m. The head stands where the integral of d s / d u is the way: R' = (d s / d u)(p) p' - 1 takes
the place of R, on a disc where the square of d s / d u has a positive real part, and R(0) is the error of p(0).
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any, NamedTuple

from flint import acb, arb, arb_series

from benchmarks.ccd.motion import Stage
from benchmarks.ccd.pieces import GUESS_RADIUS, ORDER, Piece, Unproven, Vector
from core.kernels import constants as c
from core.paths.spiral import Spiral

# Radius of the disc on which functions are bounded, as a multiple of the half width of the interval [1].
DISC = 8


class Handle(NamedTuple):
    """A handle over an interval: its point as polynomials, and how far from them it may be [m]."""

    point: Vector
    error: arb


class Expansion:
    """Handles as polynomials while the head goes from a middle place up to a half width to either side [m].

    raises: Unproven
    """

    def __init__(self, stage: Stage, pieces: list[Piece], middle: float, half: float, last: int) -> None:
        self.stage, self.pieces, self.half, self.middle = stage, pieces, arb(half), arb(middle)
        self.spiral = isinstance(stage.dance.path, Spiral)
        self.rows = stage.lay(middle, last).copy()
        self.way, self.disc = arb(0, half), acb(arb(0, DISC * half), arb(0, DISC * half))
        dragon = stage.dance.dragon
        self.chords = [
            arb(length) - 2 * arb(overhang)
            for length, overhang in zip(dragon.lengths[:last], dragon.overhangs[:last], strict=True)
        ]
        self.handles = [self._head()]
        for k in range(last):
            self.handles.append(self._behind(k))

    def _piece(self, k: int) -> Piece:
        return self.pieces[0 if self.spiral else int(self.rows[k, c.PIECE])]

    def _head(self) -> Handle:
        piece = self._piece(0)
        start = piece.parameter(-self.middle)  # a spiral's coil is taken to begin at its centre
        u = arb_series([start.mid()])
        for _ in range(ORDER if piece.kind not in ("line", "arc") else 1):
            u = exact((1 / piece.speed(u)).integral() + start.mid())
        rest = piece.speed(u) * u.derivative() - 1
        missed = self._bounded_rate(piece, u, rest) * self.half + abs(start - start.mid()) * abs(piece.speed(start))
        slowest = abs(piece.speed(at(u, self.way) + arb(0, GUESS_RADIUS))).lower()
        return self._placed(piece, u, missed, slowest)

    def _behind(self, k: int) -> Handle:
        """Handle k + 1, from handle k."""
        piece, ahead, chord = self._piece(k + 1), self.handles[k], self.chords[k]
        start = _root(piece, Vector(ahead.point.x[0], ahead.point.y[0]), chord, self._guess(piece, k + 1))
        u = _solved(piece, ahead.point, chord, start)
        to = piece.point(u) - ahead.point
        wide = piece.point(at(u, self.disc)) - Vector(*(at(part, self.disc) for part in ahead.point))
        rest = self._bounded(to.dot(to) - chord**2, abs(wide.dot(wide)) + chord**2, ORDER)
        reach = (chord**2 + rest).sqrt()
        missed = rest + 2 * reach * ahead.error + ahead.error**2
        around = at(u, self.way) + arb(0, GUESS_RADIUS)
        to = piece.point(around) - Vector(*(at(part, self.way) for part in ahead.point))
        slope = abs(2 * to.dot(piece.slope(around))).lower() - 2 * ahead.error * abs(piece.speed(around))
        return self._placed(piece, u, missed, slope)

    def _placed(self, piece: Piece, u: arb_series, missed: arb, slope: arb) -> Handle:
        """The handle at a parameter, from a bound on what its equation is missed by, and on how steep that is."""
        if not (slope > 0 and missed / slope < GUESS_RADIUS):
            raise Unproven("the interval is too wide")
        around = at(u, self.way) + arb(0, GUESS_RADIUS)
        if not piece.holds(around):
            raise Unproven("a handle crosses a joint")
        point, wide = piece.point(u), piece.point(at(u, self.disc))
        tail = self._tail(abs(wide.x) + abs(wide.y), ORDER)
        rough = Vector(*map(exact, point))
        rounding = sum(
            abs(part[k] - kept[k]) for part, kept in zip(point, rough, strict=True) for k in range(ORDER + 1)
        )
        error = missed / slope * abs(piece.speed(around)) + tail + rounding
        return Handle(rough, error.upper())

    def _bounded(self, series: arb_series, most: arb, degree: int, disc: float = DISC) -> arb:
        """Upper bound of a function on the interval, from its coefficients and a bound on the disc."""
        total = self._tail(most, degree, disc)
        for k in range(degree + 1):
            total += abs(series[k]) * self.half**k
        return total.upper()

    def _bounded_rate(self, piece: Piece, u: arb_series, rest: arb_series) -> arb:
        """Upper bound of R' of the head: unlike P, its root is analytic only where the square has no zero."""
        for disc in (DISC, DISC / 2):
            with suppress(Unproven):
                wide = acb(arb(0, disc * self.half), arb(0, disc * self.half))
                most = abs(piece.speed(at(u, wide))) * abs(at(u.derivative(), wide)) + 1
                return self._bounded(rest, most, ORDER - 1, disc)
        raise Unproven("a speed is not shown to be analytic")

    @staticmethod
    def _tail(most: arb, degree: int, disc: float = DISC) -> arb:
        return most.upper() / (arb(disc) ** degree * (disc - 1))

    def _guess(self, piece: Piece, k: int) -> arb:
        if self.spiral:
            return arb(float(self.rows[k, c.THETA]))
        if piece.kind == "spiral":
            return arb(float(self.rows[k, c.PIECE_THETA]))
        way = -arb(float(self.rows[k, c.PLACE])) - piece.begin
        if piece.kind in ("cubic", "crest"):
            return way / (piece.row[c.S_END] - piece.begin) * piece.row[c.T_END]
        return way

    def bench(self, k: int) -> tuple[Vector, Vector, arb]:
        """Centre and direction of a bench as polynomials, and the error of its handles [m]."""
        front, rear = self.handles[k], self.handles[k + 1]
        along = (front.point - rear.point).scaled(1 / self.chords[k])
        return (front.point + rear.point).scaled(arb(1) / 2), along, front.error.max(rear.error)


def exact(series: arb_series) -> arb_series:
    """The polynomial whose coefficients are the middles of these balls."""
    return arb_series([series[k].mid() for k in range(ORDER + 1)])


def at(series: arb_series, x: Any) -> Any:
    """A polynomial at a ball."""
    total = x * 0
    for coefficient in reversed(series.coeffs()):
        total = total * x + coefficient
    return total


def _root(piece: Piece, front: Vector, chord: arb, guess: arb) -> arb:
    """The parameter of the handle behind one point, next to a guess."""
    u = guess.mid()
    for _ in range(12):
        to = piece.point(u) - front
        step = (to.dot(to) - chord**2) / (2 * to.dot(piece.slope(u)))
        u = (u - step).mid()
        if abs(float(step)) < GUESS_RADIUS**2:
            return u
    raise Unproven("no root is next to a double")


def _solved(piece: Piece, front: Vector, chord: arb, start: arb) -> arb_series:
    """The parameter of the handle behind a moving one, as a polynomial, from its first coefficient."""
    u, known = arb_series([start]), 1
    while known <= ORDER:
        to = piece.point(u) - front
        excess = to.dot(to) - chord**2
        rest = [arb(0)] * known + [excess[k] for k in range(known, ORDER + 1)]
        u = exact(u - arb_series(rest) / (2 * to.dot(piece.slope(u))))
        known *= 2
    return u

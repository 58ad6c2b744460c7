"""Pieces of a path in balls: points, slopes and arc lengths at a ball or a series, and vectors of either."""

from __future__ import annotations

from typing import Any, NamedTuple

from flint import acb, arb, ctx

from benchmarks.ccd.motion import Stage
from core.kernels import constants as c
from core.paths.spiral import Spiral

# Degree of the polynomials [1], and bits of the balls. Both are global to the process in flint.
ORDER = 20
PRECISION = 128
# A guess from doubles is within this of its root [m or rad].
GUESS_RADIUS = 1e-9


class Unproven(Exception):
    """The balls are too wide to decide, or a handle crosses from one piece of the path to another."""


class Vector(NamedTuple):
    """A point or a vector: two balls or two series."""

    x: Any
    y: Any

    def __sub__(self, other: Vector) -> Vector:
        return Vector(self.x - other.x, self.y - other.y)

    def __add__(self, other: Vector) -> Vector:  # type: ignore[override]
        return Vector(self.x + other.x, self.y + other.y)

    def scaled(self, factor: Any) -> Vector:
        return Vector(self.x * factor, self.y * factor)

    def dot(self, other: Vector) -> Any:
        return self.x * other.x + self.y * other.y

    def cross(self, other: Vector) -> Any:
        return self.x * other.y - self.y * other.x


class Piece:
    """A piece of a path: its point and the derivative of that by a parameter u, a ball or a series.

    low, high: u may be from one to the other [m, or rad on a coil]
    """

    def __init__(self, table: Any, p: int) -> None:
        row = [arb(value) for value in table[p].tolist()]
        self.kind = c.PIECE_KINDS[int(table[p, c.PIECE_KIND])]
        self.row, self.begin = row, row[c.S_START]
        self.low, self.high = arb(0), row[c.S_END] - row[c.S_START]
        if self.kind == "spiral":
            ends = [abs(row[c.COIL_ARC] + row[c.SIGN] * u) / row[c.COIL_GROWTH] for u in (self.low, self.high)]
            thetas = sorted(float(_theta(end)) for end in ends)
            self.low, self.high = arb(thetas[0]), arb(thetas[1])
        elif self.kind in ("cubic", "crest"):
            self.low, self.high = _same_cubic(table, p)

    def point(self, u: Any) -> Vector:
        row = self.row
        if self.kind == "line":
            return Vector(row[c.LINE_X] + u * row[c.LINE_DX], row[c.LINE_Y] + u * row[c.LINE_DY])
        if self.kind == "arc":
            sine, cosine = (row[c.ARC_ANGLE] + row[c.SIGN] * u / row[c.ARC_RADIUS]).sin_cos()
            radius = row[c.ARC_RADIUS]
            return Vector(row[c.CENTRE_X] + radius * cosine, row[c.CENTRE_Y] + radius * sine)
        if self.kind == "spiral":
            sine, cosine = (u + row[c.COIL_ROTATION]).sin_cos()
            radius = row[c.COIL_GROWTH] * u
            return Vector(row[c.CENTRE_X] + radius * cosine, row[c.CENTRE_Y] + radius * sine)
        return Vector(
            row[c.X0] + u * (row[c.X1] + u * (row[c.X2] + u * row[c.X3])),
            row[c.Y0] + u * (row[c.Y1] + u * (row[c.Y2] + u * row[c.Y3])),
        )

    def slope(self, u: Any) -> Vector:
        row = self.row
        if self.kind == "line":
            return Vector(row[c.LINE_DX] + 0 * u, row[c.LINE_DY] + 0 * u)
        if self.kind == "arc":
            sine, cosine = (row[c.ARC_ANGLE] + row[c.SIGN] * u / row[c.ARC_RADIUS]).sin_cos()
            return Vector(-row[c.SIGN] * sine, row[c.SIGN] * cosine)
        if self.kind == "spiral":
            sine, cosine = (u + row[c.COIL_ROTATION]).sin_cos()
            growth = row[c.COIL_GROWTH]
            return Vector(growth * (cosine - u * sine), growth * (sine + u * cosine))
        return Vector(
            row[c.X1] + u * (2 * row[c.X2] + 3 * u * row[c.X3]),
            row[c.Y1] + u * (2 * row[c.Y2] + 3 * u * row[c.Y3]),
        )

    def speed(self, u: Any) -> Any:
        """d s / d u, negative where s falls with u."""
        square = self.square(u)
        if isinstance(square, acb) and not square.real > 0:
            raise Unproven("a speed is not shown to be analytic")
        return square.sqrt() * (self.row[c.SIGN] * self.row[c.COIL_GROWTH] if self.kind == "spiral" else 1)

    def square(self, u: Any) -> Any:
        """Square of d s / d u, on a coil over that of the growth."""
        if self.kind == "spiral":
            return 1 + u * u
        slope = self.slope(u)
        return slope.dot(slope) if self.kind in ("cubic", "crest") else 1 + 0 * u

    def parameter(self, s: arb) -> arb:
        """The parameter at an exact arc length [m]."""
        way, row = s - self.begin, self.row
        if self.kind in ("line", "arc"):
            return way
        if self.kind == "spiral":
            return _theta((row[c.COIL_ARC] + row[c.SIGN] * way) / row[c.COIL_GROWTH])
        u = (way / (row[c.S_END] - self.begin) * row[c.T_END]).mid()
        for _ in range(12):
            step = (self._arc(u) - way) / self.speed(u)
            u = (u - step).mid()
            if abs(float(step)) < GUESS_RADIUS**2:
                break
        around = u + arb(0, GUESS_RADIUS)
        return _newton(u, around, self._arc(u) - way, self.speed(around))

    def _arc(self, u: arb) -> arb:
        """Arc length from 0 to u of a cubic, by rigorous quadrature [m]."""
        row = self.row
        x, y = ([3 * row[k + 3], 2 * row[k + 2], row[k + 1]] for k in (c.X0, c.Y0))

        def speed(z: acb, analytic: bool) -> acb:
            dx, dy = ((a * z + b) * z + d for a, b, d in (x, y))
            return (dx * dx + dy * dy).sqrt(analytic=analytic)

        return acb.integral(speed, 0, acb(u)).real

    def holds(self, u: arb) -> bool:
        """Whether a parameter is certainly on this piece."""
        return bool(self.low <= u and u <= self.high)


def _same_cubic(table: Any, p: int) -> tuple[arb, arb]:
    """Range over which the cubic of a row goes on through neighbours cut from the same one: they share c_3."""
    low, high, first, last = arb(0), arb(table[p, c.T_END]), p, p
    same = [c.X3, c.Y3]
    while first > 0 and (table[first - 1, same] == table[p, same]).all():
        first -= 1
        low -= arb(table[first, c.T_END])
    while last + 1 < len(table) and (table[last + 1, same] == table[p, same]).all():
        last += 1
        high += arb(table[last, c.T_END])
    return low, high


def _theta(arc: arb) -> arb:
    """theta of a spiral at an arc length from its centre, in units of growth."""
    theta = (2 * arc).sqrt().mid()
    for _ in range(20):
        step = ((theta * (1 + theta**2).sqrt() + theta.asinh()) / 2 - arc) / (1 + theta**2).sqrt()
        theta = (theta - step).mid()
        if abs(float(step)) < GUESS_RADIUS**2:
            break
    around = theta + arb(0, GUESS_RADIUS)
    value = (theta * (1 + theta**2).sqrt() + theta.asinh()) / 2 - arc
    return _newton(theta, around, value, (1 + around**2).sqrt())


def _newton(guess: arb, around: arb, value: arb, slope: arb) -> arb:
    """The only root in a ball around a guess."""
    root = guess - value / slope
    if not around.contains(root):
        raise Unproven("no root is shown to be where doubles see it")
    return root


def pieces_of(stage: Stage) -> list[Piece]:
    """The pieces of a path: of a spiral, one coil inwards that goes on outwards without end.

    Sets the precision of flint, which is global to the process.
    """
    ctx.prec, ctx.cap, path = PRECISION, ORDER + 1, stage.dance.path
    if not isinstance(path, Spiral):
        return [Piece(path.table, p) for p in range(len(path.table))]
    coil = Piece.__new__(Piece)
    coil.kind, coil.begin, coil.low, coil.high = "spiral", arb(0), arb(0), arb(10) ** 9
    coil.row = [arb(0)] * c.PIECE_COLUMNS
    coil.row[c.COIL_GROWTH], coil.row[c.SIGN] = arb(path.pitch) / (2 * arb.pi()), arb(-1)
    return [coil]

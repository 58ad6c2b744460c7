"""Chains and gaps to 50 digits: a second solution of the kernels' model, which shares with core only names of columns,
and the equations of a coil in core/proof.

The doubles of a dragon, a spiral's growth and the table of a route are taken as exact, all else is python-flint's ball
arithmetic at 200 bits, of which the rounding of this file itself takes a few. Next handles are found in doubles, then
by Newton's iteration.
"""

from bisect import bisect_left
from functools import partial
from itertools import product

import flint
import numpy as np
from flint import acb, arb

from core.kernels import constants as c
from core.proof.chain import coil_arc, coil_theta, slopes, squared_chord
from tests.support.slow_search import next_delta as nearly_delta

BITS = 200
# Newton's iteration doubles the digits, from 1e-15 beyond 50 in two steps; near a crest it begins with fewer digits.
NEWTON_STEPS = 6
# On a route it starts from the chord, which is up to half as long as the arc.
ROUTE_STEPS = 9
CORNERS = tuple(product((-1, 1), repeat=2))
# Abscissas and weights of the quadrature that says what arc length on a cubic is, as in core/kernels/route.py.
QUADRATURE = (
    (0.1813418916891810, (0.4082826787521751, 0.5917173212478249)),
    (0.1568533229389436, (0.2372337950418355, 0.7627662049581645)),
    (0.1111905172266872, (0.1016667612931866, 0.8983332387068134)),
    (0.0506142681451881, (0.0198550717512319, 0.9801449282487681)),
)


def middle(value):
    """The midpoint of a ball: digits without their error."""
    return type(value)(value.mid())


def direction(angle):
    """The direction at an angle."""
    return acb(angle.cos(), angle.sin())


# Arc length from the centre, in units of growth; negative angles have negative lengths.
spiral_place = partial(coil_arc, arb(1))


def next_delta(theta, reach):
    """The first root of delta^2 + 4 theta (theta + delta) sin^2(delta / 2) = reach^2."""
    root = arb(float(nearly_delta(np.array([float(theta)]), float(reach))[0]))
    for _ in range(NEWTON_STEPS):
        root = middle(root - (squared_chord(theta, root) - reach**2) / slopes(theta, root)[1])
    return root


def spiral_angle(arc):
    """The angle at an arc length from the centre."""
    return middle(coil_theta(arb(1), arc))


def angles_behind(head, growth, chords):
    """Angles of all handles behind the first one."""
    angles = [head]
    for chord in chords.tolist():
        angles.append(middle(angles[-1] + next_delta(angles[-1], arb(chord) / growth)))
    return angles


def spiral_handles(growth, theta, chords):
    """Handles of a dragon on a spiral in the frame in which the head stands at polar angle 0 [m]."""
    flint.ctx.prec = BITS
    return [arb(growth) * at * direction(at - theta) for at in angles_behind(arb(theta), arb(growth), chords)]


def coil_handles(pitch, begin, way, chords, rotation=0.0):
    """Handles of a dragon whose head has gone a way on a coil from `begin` turns [m].

    The coil runs inwards, or outwards if `begin` is negative: angles and arc lengths from its centre are negative then.
    """
    flint.ctx.prec = BITS
    growth = arb(pitch) / (2 * arb.pi())
    head = spiral_angle(spiral_place(2 * arb.pi() * begin) - way / growth)
    return [growth * abs(at) * direction(abs(at) + rotation) for at in angles_behind(head, growth, chords)]


def fresnel_way(first, slope, length):
    """Way on a curve that begins to the right with this curvature, which has this slope.

    k v + c v^2 / 2 is c (v + k / c)^2 / 2 less k^2 / (2 c).
    """
    unit = (arb.pi() / abs(slope)).sqrt()
    begin, end = ((v + first / slope) / unit for v in (arb(0), length))
    sines = (end.fresnel_s() - begin.fresnel_s()) * (1 if slope > 0 else -1)
    rotated = direction(-first * first / (2 * slope))
    return acb(end.fresnel_c() - begin.fresnel_c(), sines) * unit * rotated


class ExactRoute:
    """Points of a route by its table."""

    def __init__(self, table):
        flint.ctx.prec = BITS
        self.rows = table.tolist()
        self.ends = [row[c.S_END] for row in self.rows]

    def point(self, s):
        """Point [m] and unit tangent at arc length s."""
        row = self.rows[min(bisect_left(self.ends, float(s)), len(self.rows) - 1)]
        u = s - row[c.S_START] - row[c.S_START_LOW]
        kind = row[c.PIECE_KIND]
        sign = row[c.SIGN]
        centre = acb(row[c.CENTRE_X], row[c.CENTRE_Y])
        first = acb(row[c.LINE_X], row[c.LINE_Y])
        along = acb(row[c.LINE_DX], row[c.LINE_DY])
        if kind == c.LINE:
            return first + u * along, along
        if kind == c.CLOTHOID:
            k = arb(row[c.K_START])
            slope = arb(row[c.K_RATE])
            arc = (direction(k * u) - 1) / acb(0, k) if k != 0 else acb(u)
            way = fresnel_way(k, slope, u) if slope != 0 else arc
            return middle(first + along * way), middle(along * direction(k * u + slope * u * u / 2))
        if kind == c.ARC:
            out = direction(row[c.ARC_ANGLE] + sign * u / row[c.ARC_RADIUS])
            return centre + row[c.ARC_RADIUS] * out, acb(0, sign) * out
        if kind == c.SPIRAL:
            growth = arb(row[c.COIL_GROWTH]) + row[c.COIL_GROWTH_LOW]
            theta = spiral_angle((arb(row[c.COIL_ARC]) + row[c.COIL_ARC_LOW] + sign * u) / growth)
            out = direction(theta + row[c.COIL_ROTATION])
            return centre + growth * theta * out, sign * out * acb(1, theta) / (1 + theta * theta).sqrt()
        return self._cubic(row, u)

    @staticmethod
    def _cubic(row, u):
        start, *powers = (acb(*both) for both in zip(row[c.X0 : c.X3 + 1], row[c.Y0 : c.Y3 + 1], strict=True))

        def slope(t):
            return powers[0] + t * (2 * powers[1] + 3 * t * powers[2])

        t = arb(float(u) / (row[c.S_END] - row[c.S_START]) * row[c.T_END])
        for _ in range(ROUTE_STEPS - 2):
            arc = t * sum(weight * sum(abs(slope(knot * t)) for knot in knots) for weight, knots in QUADRATURE)
            t = middle(t - (arc - u) / abs(slope(t)))
        return start + t * (powers[0] + t * (powers[1] + t * powers[2])), slope(t) / abs(slope(t))

    def handles(self, s, chords):
        """Handles of a dragon with its head at s [m], each the first point behind its leader at the chord."""
        front, _ = self.point(s)
        handles = [front]
        for chord in chords.tolist():
            step = arb(chord)
            for _ in range(ROUTE_STEPS):
                rear, tangent = self.point(s - step)
                apart = abs(front - rear)
                step = middle(step + (chord - apart) * apart / ((front - rear) * tangent.conjugate()).real)
            s = middle(s - step)
            front, _ = self.point(s)
            handles.append(front)
        return handles


def separation(first, second, sizes):
    """Signed distance of two benches [m]. first, second: their front and rear handle; sizes: chord, half length, half
    width of each"""
    boxes = [_box(bench, size) for bench, size in zip((first, second), sizes, strict=True)]
    overlaps, distances = zip(_facing(*boxes), _facing(*boxes[::-1]), strict=True)
    return min(distances) if max(overlaps) > 0 else max(overlaps)


def _box(bench, size):
    """Middle, direction, half length and half width of a bench."""
    front, rear = bench
    chord, *halves = size.tolist()
    return (front + rear) / 2, (front - rear) / chord, *halves


def _facing(own, other):
    """Largest gap along the faces of the first bench, and the least distance of a corner of the other one from it."""
    (place, along, *halves), (middle_other, along_other, *sides) = own, other
    offsets = (acb(*(sign * side for sign, side in zip(signs, sides, strict=True))) for signs in CORNERS)
    seen = [(middle_other + along_other * offset - place) * along.conjugate() for offset in offsets]
    gaps = []
    beyond = []
    for half, *parts in zip(halves, *((corner.real, corner.imag) for corner in seen), strict=True):
        gaps.append(max(min(parts), -max(parts)) - half)
        beyond.append([max(abs(part) - half, arb(0)) for part in parts])
    return max(gaps), min(middle(x * x + y * y) for x, y in zip(*beyond, strict=True)).sqrt()


def clothoid_place(piece, v):
    """Place on a clothoid at a length from its beginning, by Fresnel integrals of its own numbers [m]."""
    flint.ctx.prec = BITS
    first = arb(piece.start_curvature)
    last = arb(piece.end_curvature)
    way = fresnel_way(first, (last - first) / arb(piece.length), arb(v))
    return acb(*piece.start) + way * direction(arb(piece.heading))

"""Chains and gaps to 50 digits: a second solution of the kernels' model, which shares only names of columns with core.

The doubles of a dragon, a spiral's growth and the table of a route are taken as exact, all else is python-flint's ball
arithmetic at 200 bits, of which the rounding of this file itself takes a few. Next handles are found in doubles, then
by Newton's iteration.
"""

import math
from bisect import bisect_left
from itertools import product

import flint
import numpy as np
from flint import acb, arb

from core.kernels import constants as c
from tests.support.slow_search import next_delta as nearly_delta

BITS = 200
# Newton's iteration doubles the digits, from 1e-15 beyond 50 in two steps; near a crest it begins with fewer digits.
NEWTON_STEPS = 6
# On a route it starts from the chord, which is up to half as long as the arc.
ROUTE_STEPS = 9
# Abscissas and weights of the quadrature that says what arc length on a cubic is, as in core/kernels/route.py.
QUADRATURE = (
    (0.1813418916891810, (0.4082826787521751, 0.5917173212478249)),
    (0.1568533229389436, (0.2372337950418355, 0.7627662049581645)),
    (0.1111905172266872, (0.1016667612931866, 0.8983332387068134)),
    (0.0506142681451881, (0.0198550717512319, 0.9801449282487681)),
)


def middle(value):
    """The midpoint of a ball: digits without their error."""
    return arb(value.mid())


def distance(a, b):
    x, y = a[0] - b[0], a[1] - b[1]
    return (x * x + y * y).sqrt()


def spiral_place(theta):
    """Arc length from the centre, in units of growth."""
    return (theta * (1 + theta * theta).sqrt() + theta.asinh()) / 2


def next_delta(theta, reach):
    """The first root of delta^2 + 4 theta (theta + delta) sin^2(delta / 2) = reach^2."""
    root = arb(float(nearly_delta(np.array([float(theta)]), float(reach))[0]))
    for _ in range(NEWTON_STEPS):
        sine, cosine = (root / 2).sin(), (root / 2).cos()
        value = root**2 + 4 * theta * (theta + root) * sine**2 - reach**2
        slope = 2 * root + 4 * theta * sine**2 + 4 * theta * (theta + root) * sine * cosine
        root = middle(root - value / slope)
    return root


def spiral_angle(arc):
    """The angle at an arc length from the centre; negative lengths have negative angles."""
    at = arb(math.copysign(math.sqrt(2.0 * abs(float(arc))), float(arc)))
    for _ in range(ROUTE_STEPS):
        at = middle(at - (spiral_place(at) - arc) / (1 + at * at).sqrt())
    return at


def angles_behind(head, growth, chords):
    """Angles of all handles behind the first one."""
    angles = [head]
    for chord in chords.tolist():
        angles.append(middle(angles[-1] + next_delta(angles[-1], arb(chord) / growth)))
    return angles


def on_spiral(growth, radius, angle):
    return growth * radius * angle.cos(), growth * radius * angle.sin()


def spiral_handles(growth, theta, chords):
    """Handles of a dragon on a spiral in the frame in which the head stands at polar angle 0 [m]."""
    flint.ctx.prec = BITS
    return [on_spiral(arb(growth), at, at - theta) for at in angles_behind(arb(theta), arb(growth), chords)]


def coil_handles(pitch, begin, way, chords, rotation=0.0):
    """Handles of a dragon whose head has gone a way on a coil from `begin` turns [m].

    The coil runs inwards, or outwards if `begin` is negative: angles and arc lengths from its centre are negative then.
    """
    flint.ctx.prec = BITS
    growth = arb(pitch) / (2 * arb.pi())
    head = spiral_angle(spiral_place(2 * arb.pi() * begin) - way / growth)
    return [on_spiral(growth, abs(at), abs(at) + rotation) for at in angles_behind(head, growth, chords)]


def fresnel_way(first, slope, length):
    """Way on a curve that begins to the right with this curvature, which has this slope.

    k v + c v^2 / 2 is c (v + k / c)^2 / 2 less k^2 / (2 c).
    """
    unit = (arb.pi() / abs(slope)).sqrt()
    begin, end = ((v + first / slope) / unit for v in (arb(0), length))
    sines = (end.fresnel_s() - begin.fresnel_s()) * (1 if slope > 0 else -1)
    rotated = (acb(0, -1) * first * first / (2 * slope)).exp()
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
        if row[c.PIECE_KIND] == c.LINE:
            dx, dy = arb(row[c.LINE_DX]), arb(row[c.LINE_DY])
            return (row[c.LINE_X] + u * dx, row[c.LINE_Y] + u * dy), (dx, dy)
        if row[c.PIECE_KIND] == c.CLOTHOID:
            return self._clothoid(row, u)
        sign = row[c.SIGN]
        if row[c.PIECE_KIND] == c.ARC:
            radius, angle = row[c.ARC_RADIUS], row[c.ARC_ANGLE] + sign * u / row[c.ARC_RADIUS]
            cos, sin = angle.cos(), angle.sin()
            return (row[c.CENTRE_X] + radius * cos, row[c.CENTRE_Y] + radius * sin), (-sign * sin, sign * cos)
        if row[c.PIECE_KIND] == c.SPIRAL:
            growth = arb(row[c.COIL_GROWTH]) + row[c.COIL_GROWTH_LOW]
            theta = spiral_angle((arb(row[c.COIL_ARC]) + row[c.COIL_ARC_LOW] + sign * u) / growth)
            angle = theta + row[c.COIL_ROTATION]
            cos, sin = angle.cos(), angle.sin()
            radius, scale = growth * theta, sign / (1 + theta * theta).sqrt()
            return (row[c.CENTRE_X] + radius * cos, row[c.CENTRE_Y] + radius * sin), (
                scale * (cos - theta * sin),
                scale * (sin + theta * cos),
            )
        return self._cubic(row, u)

    @staticmethod
    def _clothoid(row, u):
        k, slope = arb(row[c.K_START]), arb(row[c.K_RATE])
        first = acb(row[c.LINE_DX], row[c.LINE_DY])
        along = first * (acb(0, 1) * (k * u + slope * u * u / 2)).exp()
        if slope == 0:
            way = ((acb(0, 1) * k * u).exp() - 1) / (acb(0, 1) * k) if k != 0 else acb(u)
        else:
            way = fresnel_way(k, slope, u)
        point = acb(row[c.LINE_X], row[c.LINE_Y]) + first * way
        return (middle(point.real), middle(point.imag)), (middle(along.real), middle(along.imag))

    @staticmethod
    def _cubic(row, u):
        x, y, end = row[c.X0 : c.X3 + 1], row[c.Y0 : c.Y3 + 1], row[c.T_END]

        def slope(t):
            return x[1] + t * (2 * x[2] + 3 * t * x[3]), y[1] + t * (2 * y[2] + 3 * t * y[3])

        def speed(t):
            dx, dy = slope(t)
            return (dx * dx + dy * dy).sqrt()

        t = arb(float(u) / (row[c.S_END] - row[c.S_START]) * end)
        for _ in range(ROUTE_STEPS - 2):
            arc = t * sum(weight * sum(speed(knot * t) for knot in knots) for weight, knots in QUADRATURE)
            t = middle(t - (arc - u) / speed(t))
        dx, dy = slope(t)
        return (x[0] + t * (x[1] + t * (x[2] + t * x[3])), y[0] + t * (y[1] + t * (y[2] + t * y[3]))), (
            dx / speed(t),
            dy / speed(t),
        )

    def handles(self, s, chords):
        """Handles of a dragon with its head at s [m], each the first point behind its leader at the chord."""
        front, _ = self.point(s)
        handles = [front]
        for chord in chords.tolist():
            step = arb(chord)
            for _ in range(ROUTE_STEPS):
                rear, tangent = self.point(s - step)
                apart = distance(front, rear)
                cosine = ((front[0] - rear[0]) * tangent[0] + (front[1] - rear[1]) * tangent[1]) / apart
                step = middle(step + (chord - apart) / cosine)
            s = middle(s - step)
            front, _ = self.point(s)
            handles.append(front)
        return handles


def separation(first, second, sizes):
    """Signed distance of two benches [m]. first, second: their front and rear handle; sizes: chord, half length, half
    width of each"""
    boxes = [_box(bench, size) for bench, size in zip((first, second), sizes, strict=True)]
    faces = [_face(boxes[0], boxes[1]), _face(boxes[1], boxes[0])]
    largest = max(faces, key=float)
    if largest.mid() <= 0:
        return largest
    return min(_corners(boxes[0], boxes[1]), _corners(boxes[1], boxes[0]), key=float)


def _box(bench, size):
    """Middle, direction, half length and half width of a bench."""
    front, rear = (acb(*point) for point in bench)
    chord, half_length, half_width = size.tolist()
    return (front + rear) / 2, (front - rear) / chord, half_length, half_width


def _face(own, other):
    (middle_own, along, half_length, half_width), (middle_other, along_other, *halves) = own, other
    away, turn = (middle_other - middle_own) * along.conjugate(), along_other * along.conjugate()
    lengthwise = abs(away.real) - half_length - abs(turn.real) * halves[0] - abs(turn.imag) * halves[1]
    sideways = abs(away.imag) - half_width - abs(turn.imag) * halves[0] - abs(turn.real) * halves[1]
    return max(lengthwise, sideways, key=float)


def _corners(own, other):
    middle_other, along, *halves = other
    entries = []
    for signs in product((-1, 1), repeat=2):
        corner = middle_other + along * acb(*(sign * half for sign, half in zip(signs, halves, strict=True)))
        away = (corner - own[0]) * own[1].conjugate()
        beyond = [max(abs(away.real) - own[2], arb(0), key=float), max(abs(away.imag) - own[3], arb(0), key=float)]
        entries.append(middle(beyond[0] * beyond[0] + beyond[1] * beyond[1]).sqrt())
    return min(entries, key=float)


def clothoid_place(piece, v):
    """Place on a clothoid at a length from its beginning, by Fresnel integrals of its own numbers [m]."""
    flint.ctx.prec = BITS
    first, last = arb(piece.start_curvature), arb(piece.end_curvature)
    way = fresnel_way(first, (last - first) / arb(piece.length), arb(v))
    return acb(*piece.start) + way * (acb(0, 1) * arb(piece.heading)).exp()

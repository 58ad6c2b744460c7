"""A dragon on a route, computed a second time slowly and plainly: no code of core but the numbers of its pieces.

Points follow from the definitions of an arc and a coil, and on a clothoid from a quadrature of its direction; a line is
an arc without a bend. Every next handle is the root of a distance. Places and directions are complex numbers.
"""

from dataclasses import dataclass

import numpy as np

from core import Arc, Clothoid, Coil, Line
from tests.support.slow_search import SlowDance, arc_length, head_angle, in_plane, root, sizes_of

# Part of a chord to which a handle is found along a route of some hundred metres [1].
CLOSE = 1e-12
# Longest arc over its chord, where the chord can follow the route at all [1].
LONGEST = 0.5 * np.pi
# Nodes on which the direction of a clothoid is summed up over its length, and their weights [1].
NODES, WEIGHTS = np.polynomial.legendre.leggauss(64)


def clothoid_of(piece):
    """Beginning and its direction [rad], first and last curvature [1/m], and length [m] of a line, arc or clothoid."""
    if isinstance(piece, Line):
        way = complex(*piece.end) - complex(*piece.start)
        return complex(*piece.start), np.angle(way), 0.0, 0.0, abs(way)
    if isinstance(piece, Arc):
        sign = np.sign(piece.sweep)
        first = complex(*piece.centre) + piece.radius * np.exp(1j * piece.start_angle)
        bend = sign / piece.radius
        heading = piece.start_angle + 0.5 * np.pi * sign
        return first, heading, bend, bend, abs(piece.sweep) * piece.radius
    return complex(*piece.start), piece.heading, piece.start_curvature, piece.end_curvature, piece.length


def piece_length(piece):
    """Length of a piece [m]."""
    if not isinstance(piece, Coil):
        return clothoid_of(piece)[-1]
    ends = arc_length(2.0 * np.pi * np.array([piece.start_turns, piece.end_turns]))
    return float(abs(ends[1] - ends[0])) * piece.pitch / (2.0 * np.pi)


def bow(curvature, length):
    """Where an arc ends that begins in 0 to the right, as complex numbers."""
    half = 0.5 * curvature * length
    return length * np.sinc(half / np.pi) * np.exp(1j * half)


def piece_points(piece, u):
    """Points and unit tangents (N,) at lengths u (N,) from the beginning of a piece [m], also beyond its ends.

    A clothoid goes on as a circle.
    """
    if isinstance(piece, Coil):
        growth = piece.pitch / (2.0 * np.pi)
        sign = np.sign(piece.end_turns - piece.start_turns)
        theta = head_angle(arc_length(2.0 * np.pi * piece.start_turns) + sign * u / growth)
        out = np.exp(1j * (theta + piece.rotation))
        return complex(*piece.centre) + growth * theta * out, sign * out * (1.0 + 1j * theta) / np.hypot(1.0, theta)
    first, heading, bend, last, length = clothoid_of(piece)
    slope = (last - bend) / length
    on = np.clip(u, 0.0, length)

    def along(v):
        return np.exp(1j * (heading + bend * v + 0.5 * slope * v * v))

    way = along(0.0) * bow(bend, on) if not slope else 0.5 * on * (along(0.5 * np.outer(on, 1.0 + NODES)) @ WEIGHTS)
    ends = bend + slope * on
    beyond = u - on
    return first + way + along(on) * bow(ends, beyond), along(on) * np.exp(1j * ends * beyond)


def points_along(route, s):
    """Points and unit tangents (N,) of a route without waypoints at arc lengths s (N,)."""
    joints = np.cumsum([-route.start, *map(piece_length, route.pieces)])
    on = np.clip(np.searchsorted(joints, s) - 1, 0, len(route.pieces) - 1)
    points, tangents = np.empty((2, s.size), dtype=complex)
    for k in np.unique(on):
        there = on == k
        points[there], tangents[there] = piece_points(route.pieces[k], s[there] - joints[k])
    return points, tangents


@dataclass
class SlowRoute(SlowDance):
    """One dragon on any pieces without waypoints, at 1 m/s; s = 0 is `start` metres from their beginning."""

    pieces: tuple
    start: float

    @classmethod
    def of(cls, dragon, route):
        assert all(isinstance(piece, Line | Arc | Coil | Clothoid) for piece in route.pieces)
        return cls(*sizes_of(dragon), 0.0, 0.0, route.pieces, route.start)

    def end(self):
        return sum(map(piece_length, self.pieces)) - self.start

    def behind(self, s, leaders, chord):
        """Arc lengths and points of the handles a chord behind leaders at s."""

        def beyond(back):
            points, tangents = points_along(self, s - back)
            apart = leaders - points
            distance = np.abs(apart)
            return distance - chord, np.maximum((apart * tangents.conj()).real / distance, 1e-3)

        nearest = np.full_like(s, chord)
        at = s - root(beyond, nearest, nearest, LONGEST * nearest, CLOSE)
        return at, points_along(self, at)[0]

    def handles(self, times, benches=None):
        """(T, n + 1, 2) [m]"""
        s = np.asarray(times, dtype=float)
        rows = [points_along(self, s)[0]]
        for chord in self.chords[:benches]:
            s, points = self.behind(s, rows[-1], chord)
            rows.append(points)
        return in_plane(np.stack(rows, axis=1))


@dataclass
class SlowLines(SlowRoute):
    """The same on lines with corners between them, where each next handle is on a circle and on one of the lines."""

    def behind(self, s, leaders, chord):
        """Arc lengths and points of the handles a chord behind leaders at s: the first point of a line so far."""
        best = np.full(s.size, -np.inf)
        points = np.empty(s.size, complex)
        joints = np.cumsum([-self.start, *map(piece_length, self.pieces)])
        for k, piece in enumerate(self.pieces):
            first, heading, _, _, length = clothoid_of(piece)
            away = (leaders - first) * np.exp(-1j * heading)
            half = np.sqrt(np.maximum(chord**2 - away.imag**2, 0.0))
            for along in (away.real - half, away.real + half):
                place = joints[k] + along
                there = (np.abs(away.imag) <= chord) & (along <= length + CLOSE) & (place < s - 0.5 * chord)
                better = there & ((along >= -CLOSE) | (k == 0)) & (place > best)
                best = np.where(better, place, best)
                points = np.where(better, first + along * np.exp(1j * heading), points)
        return best, points

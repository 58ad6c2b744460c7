"""A dragon on a route, computed a second time slowly and plainly: no code of core but the numbers of its pieces.

Points follow from the definitions of a line, an arc and a coil, and on a clothoid from SciPy's Fresnel integrals; every
next handle is the root of a distance. Places and directions are complex numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import fresnel

from core import Arc, Clothoid, Coil, Line
from tests.support.slow_search import SlowDance, arc_length, head_angle, sizes_of

# Steps of Newton's towards a handle, then of a bisection if those do not suffice, and the distance that does [m].
NEWTON_STEPS, HALVINGS, CLOSE = 12, 60, 1e-11
# Longest arc over its chord, where the chord can follow the route at all [1].
LONGEST = 0.5 * np.pi
# Change of a clothoid's curvature over its length, times its length, below which its mean curvature serves [1]: the
# difference of its Fresnel integrals would have lost more digits.
ALMOST_AN_ARC = 1e-12


def piece_length(piece):
    """Length of a piece [m]."""
    if isinstance(piece, Line):
        return abs(complex(*piece.end) - complex(*piece.start))
    if isinstance(piece, Arc):
        return abs(piece.sweep) * piece.radius
    if isinstance(piece, Clothoid):
        return piece.length
    ends = arc_length(2.0 * np.pi * np.array([piece.start_turns, piece.end_turns]))
    return float(abs(ends[1] - ends[0])) * piece.pitch / (2.0 * np.pi)


def clothoid_points(piece, u):
    """Points and unit tangents (N,) on a clothoid; it goes on as a circle beyond its ends.

    The direction at u is turned by k u + c u^2 / 2 = c (u + k / c)^2 / 2 - k^2 / (2 c).
    """
    k, slope = piece.start_curvature, (piece.end_curvature - piece.start_curvature) / piece.length
    on = np.clip(u, 0.0, piece.length)
    if abs(slope) * piece.length**2 < ALMOST_AN_ARC:
        way = bow(k + 0.5 * slope * on, on)
    else:
        unit = np.sqrt(np.pi / abs(slope))
        sines, cosines = fresnel((on + k / slope) / unit) - np.array(fresnel(k / slope / unit))[:, None]
        way = (cosines + 1j * np.sign(slope) * sines) * unit * np.exp(-0.5j * k * k / slope)
    first = np.exp(1j * piece.heading)
    along, bend = first * np.exp(1j * (k * on + 0.5 * slope * on * on)), k + slope * on
    beyond = u - on
    return complex(*piece.start) + first * way + along * bow(bend, beyond), along * np.exp(1j * bend * beyond)


def bow(curvature, length):
    """Where an arc ends that begins in 0 to the right, as complex numbers."""
    half = 0.5 * curvature * length
    return length * np.sinc(half / np.pi) * np.exp(1j * half)


def piece_points(piece, u):
    """Points and unit tangents (N,) at lengths u (N,) from the beginning of a piece [m], also beyond its ends."""
    if isinstance(piece, Line):
        start = complex(*piece.start)
        along = np.full(u.size, (complex(*piece.end) - start) / piece_length(piece))
        return start + u * along, along
    if isinstance(piece, Clothoid):
        return clothoid_points(piece, u)
    centre = complex(*piece.centre)
    if isinstance(piece, Arc):
        sign = np.sign(piece.sweep)
        out = np.exp(1j * (piece.start_angle + sign * u / piece.radius))
        return centre + piece.radius * out, 1j * sign * out
    growth, sign = piece.pitch / (2.0 * np.pi), np.sign(piece.end_turns - piece.start_turns)
    theta = head_angle(arc_length(2.0 * np.pi * piece.start_turns) + sign * u / growth)
    out = np.exp(1j * (theta + piece.rotation))
    return centre + growth * theta * out, sign * out * (1.0 + 1j * theta) / np.hypot(1.0, theta)


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

    def points(self, s):
        """Points and unit tangents (N,) at arc lengths s (N,)."""
        joints = np.cumsum([-self.start, *map(piece_length, self.pieces)])
        on = np.clip(np.searchsorted(joints, s) - 1, 0, len(self.pieces) - 1)
        points, tangents = np.empty((2, s.size), dtype=complex)
        for k, piece in enumerate(self.pieces):
            there = on == k
            if there.any():
                points[there], tangents[there] = piece_points(piece, s[there] - joints[k])
        return points, tangents

    def behind(self, s, leaders, chord):
        """Arc lengths and points of the handles a chord behind leaders at s."""
        low, high = s - LONGEST * chord, s - chord
        at = s - chord
        for step in range(NEWTON_STEPS + HALVINGS):
            points, tangents = self.points(at)
            apart = leaders - points
            distance = np.abs(apart)
            if np.abs(distance - chord).max() < CLOSE:
                break
            near = distance < chord
            high, low = np.where(near, at, high), np.where(near, low, at)
            slope = np.maximum((apart * tangents.conj()).real / distance, 1e-3)
            moved = at + (distance - chord) / slope
            inside = (low < moved) & (moved < high) & (step < NEWTON_STEPS)
            at = np.where(inside, moved, 0.5 * (low + high))
        return at, points

    def handles(self, times, benches=None):
        """(T, n + 1, 2) [m]"""
        s = np.asarray(times, dtype=float)
        rows = [self.points(s)[0]]
        for chord in self.chords[:benches]:
            s, points = self.behind(s, rows[-1], chord)
            rows.append(points)
        places = np.stack(rows, axis=1)
        return np.stack([places.real, places.imag], axis=-1)

"""Spiral: point and tangent at arc length s, which grows in the direction of travel; the tail has the smaller s.

Spiral is the whole dance of the contest; Route joins pieces (Line, Arc, Coil, Waypoints) into one path.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from core import kernels
from core.checks import checked_angle, checked_number, checked_point, checked_size
from core.display import TABLE_DIGITS, Readable, display
from core.dragon import Dragon
from core.error_free import paired
from core.errors import InvalidValue
from core.paths.frame import WORLD, Frame
from core.paths.path import Columns, HeadState, PathSummary
from core.paths.pieces import Coil
from core.paths.route import Route
from core.quantities import Given
from core.sampling import bisect
from core.values import Floats, Interval, Point

START_TURNS_MAX = 1e5
# Number of points in each drawn turn of a spiral.
DRAWN_POINTS = 120
# Relative width to which gentle_lag() is bisected [1].
GENTLE_WIDTH = 1e-9
# Relative distance between the end of a run and its fold, so that every chord has a place there in spite of rounding
# [1]; 1e-14 was enough for 1,494 random dragons (measured 2026-11-21).
FOLD_ROUNDING = 1e-13


@dataclass(frozen=True, repr=False)
class Spiral(Readable):
    """Archimedean spiral r = growth * theta, danced inwards from start_turns turns.

    pitch: radial advance per full turn [m]
    start_turns: turns from the centre to the start, s = 0 [turns]
    centre: centre, x and y [m]
    rotation: rotation of the whole spiral about it, as in a Coil [rad]
    clockwise: the direction of the dance; False: its mirror image
    growth: radial advance per radian [m/rad]
    start_theta: polar angle of the start [rad]
    length: arc length from the start to the centre [m]

    Negative s is on the outward extension of the same spiral; the centre is at s = length.
    The place of the spiral changes only places, never times, distances or proofs, which are those of `standard`.

    Arc length from the centre: growth / 2 (theta sqrt(1 + theta^2) + asinh theta).

    >>> round(Spiral().length, 6)
    442.590256
    """

    pitch: float = 0.55
    start_turns: float = 16.0
    centre: Point = (0.0, 0.0)
    rotation: float = 0.0
    clockwise: bool = True
    growth: float = field(init=False, repr=False, compare=False)
    start_theta: float = field(init=False, repr=False, compare=False)
    length: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "pitch", checked_size("path.pitch", self.pitch))
        object.__setattr__(self, "centre", checked_point("path.centre", self.centre))
        object.__setattr__(self, "rotation", checked_angle("path.rotation", self.rotation))
        if not isinstance(self.clockwise, bool):
            raise InvalidValue("path.clockwise", "must be True or False", got=Given(self.clockwise))
        turns = checked_number("path.start_turns", self.start_turns, "turns", 0.0, START_TURNS_MAX, open_low=True)
        object.__setattr__(self, "start_turns", turns)
        object.__setattr__(self, "growth", self.pitch / (2.0 * math.pi))
        object.__setattr__(self, "start_theta", 2.0 * math.pi * turns)
        object.__setattr__(self, "length", self.growth * float(kernels.spiral_arc(self.start_theta)))

    @cached_property
    def _lows(self) -> tuple[float, float]:
        """What growth [m/rad] and length [m] have lost in rounding."""
        _, growth_low = kernels.growth_pair(self.pitch)
        high, low = kernels.coil_arc(self.pitch, self.start_turns)
        return growth_low, (high - self.length) + low

    def __repr__(self) -> str:
        arguments = f"pitch={self.pitch!r}, start_turns={self.start_turns!r}"
        if self.frame != WORLD:
            arguments += f", centre={self.centre!r}, rotation={self.rotation!r}, clockwise={self.clockwise!r}"
        return f"Spiral({arguments})"

    def _rows(self) -> list[tuple[str, str]]:
        return [*super()._rows(), ("length", display(self.length, "m", TABLE_DIGITS))]

    # The head enters at s = 0 and may go to the centre; the tail is on the outward extension, which has no end.
    begin = 0.0
    tail_begin = None
    slide = 0.0  # points are exact except for the rounding of s
    block = kernels.LANES_PER_BLOCK  # the kernels solve so many places together
    knots = np.empty(0)

    @property
    def end(self) -> float:
        """s of the centre [m]."""
        return self.length

    limit = place = end

    @property
    def spiral(self) -> Spiral:
        """The spiral itself."""
        return self

    @cached_property
    def frame(self) -> Frame:
        """The own frame of the spiral."""
        return Frame(self.centre, self.rotation, self.clockwise)

    @property
    def standard(self) -> Spiral:
        """The same spiral in its own frame: around the origin, clockwise."""
        return self if self.frame == WORLD else Spiral(self.pitch, self.start_turns)

    @property
    def curve(self) -> kernels.Curve:
        """The spiral in the form of the kernels."""
        return kernels.spiral_curve(self.growth, *self._lows)

    def theta(self, s: Floats | float) -> Floats:
        """Polar angle at arc length s in its own frame. s: (...) [m], at most length; returns (...) [rad]."""
        return self._turned(s)[0]

    def _turned(self, s: Floats | float) -> tuple[Floats, Floats]:
        """theta(), and what it has lost in rounding [rad]."""
        flat = np.asarray(s, dtype=np.float64)
        high, low = self._thetas(paired(flat.reshape(-1))).T.reshape(2, *flat.shape)
        return high, low

    def _thetas(self, s: Floats) -> Floats:
        """Polar angles [rad] at arc lengths [m]; both in double-double (S, 2)."""
        thetas = np.empty_like(s)
        growth_low, length_low = self._lows
        kernels.spiral_thetas(self.growth, growth_low, self.length, length_low, s, thetas)
        return thetas

    def _directions(self, s: Floats | float) -> tuple[Floats, Floats, Floats]:
        """theta() with its cosine and sine, each (...)."""
        theta, low = self._turned(s)
        cos, sin = np.cos(theta), np.sin(theta)
        return theta, cos - low * sin, sin + low * cos

    def travel_to(self, radius: float) -> float:
        """Arc length from the start to a radius [m]."""
        return self._s(radius / self.growth)

    def _s(self, theta: float) -> float:
        """Arc length from the start to a polar angle [m]."""
        return self.length - self.growth * float(kernels.spiral_arc(theta))

    def lags(self, s: Floats, last: float) -> Floats:
        """Polar angles at arc lengths s (T,) [rad], not inside `last` in spite of rounding."""
        return np.maximum(self.theta(s), last)

    def follow(self, lag: float, last: int, sizes: Floats, chain: Floats) -> None:
        """Fill in a chain up to handle `last`, with the head at a polar angle [rad]."""
        kernels.start_chain(lag, chain)
        kernels.extend_chain(self.growth, 0, last, kernels.FREE, sizes, chain)

    def along(self, lags: Floats) -> Floats:
        """Arc lengths of polar angles (...) [m]."""
        arcs: Floats = 0.5 * (lags * np.sqrt(1.0 + lags * lags) + np.arcsinh(lags))
        return self.length - self.growth * arcs

    def piece_at(self, row: Floats) -> int:
        """0, the only coil."""
        return 0

    def gentle_lag(self, curvature: float) -> float:
        """Polar angle beyond which the |curvature| stays below this [1/m]; rounded up [rad].

        Curvature growth is (2 + theta^2) / (1 + theta^2)^(3/2), which falls and is at most 2 / theta.
        """

        def is_gentle(theta: float) -> bool:
            return bool(kernels.spiral_curvature(theta) <= curvature * self.growth)

        return bisect(is_gentle, 0.0, 2.0 / (self.growth * curvature), relative=GENTLE_WIDTH)[1]

    def sharpest_before(self, s: float) -> float:
        """Upper bound of the |curvature| at arc length s and before it [1/m]."""
        return float(kernels.spiral_curvature(float(self.theta(min(s, self.length))))) / self.growth

    def tighter(self, radius: float) -> list[tuple[float, float, float]]:
        """No stretches, because a dance ends in a fold where the spiral is too tight."""
        return []

    def last_lag(self, chord: float) -> float:
        """Polar angle of the front handle just before a lone bench folds; 0 if it reaches the centre."""
        return float(kernels.fold_theta((chord / self.growth) ** 2)) * (1.0 + FOLD_ROUNDING)

    def rear_way(self, s: float, way: float, chord: float, last: float) -> float:
        """Upper bound of the way of a lone bench's rear handle, see Path [m]."""
        growth, chord2 = self.growth, (chord / self.growth) ** 2
        outer, inner = (max(float(self.theta(place)), last) for place in (s, s + way))
        least, most = (float(kernels.first_root(theta, chord2)) for theta in (outer, inner))
        if most == kernels.NO_ROOT:
            return kernels.FREE
        return growth * float(kernels.spiral_arc(outer + most) - kernels.spiral_arc(inner + least))

    def as_route(self, stop: float) -> Route:
        """The spiral as a coil up to s = stop, around the origin."""
        theta = float(self.theta(min(stop, self.length)))
        return Route([Coil(self.pitch, self.start_turns, theta / (2.0 * math.pi))])

    def curvature(self, s: Floats | float) -> Floats:
        """Curvature, counter-clockwise positive, so negative if clockwise. s: (...) [m]; returns (...) [1/m]."""
        theta = self.theta(s)
        # No powers: those of one number and of an array may differ in the last digit.
        grown = 1.0 + theta * theta
        curvature: Floats = (1.0 + grown) / (self.growth * (grown * np.sqrt(grown)))
        return -curvature if self.clockwise else curvature

    def position(self, s: Floats | float) -> Floats:
        """Points at arc length s. s: (...) [m]; returns (..., 2) x, y [m]."""
        theta, cos, sin = self._directions(s)
        direction: Floats = np.stack([cos, sin], axis=-1)
        return self.frame.points(direction * (self.growth * theta[..., None]))

    def head(self, s: float) -> HeadState:
        """The head at arc length s [m]."""
        growth_low, length_low = self._lows
        theta, low = kernels.coil_theta(self.growth, growth_low, self.length, length_low, -s, 0.0)
        cos, sin, radius = math.cos(theta), math.sin(theta), self.growth * theta
        x, y = radius * (cos - low * sin), radius * (sin + low * cos)
        return HeadState(theta, radius, *((x, y) if self.frame == WORLD else self.frame.point(x, y)))

    def handles(
        self, s: Floats, last: float, chords: Floats, head_speed: float, columns: Columns, budget: kernels.Budget
    ) -> int:
        """Fill in all handles, see Path; not inside the polar angle `last` in spite of rounding."""
        thetas = self._thetas(s)
        thetas[thetas[:, kernels.HIGH] < last] = last, 0.0
        return kernels.spiral_trajectory(self.growth, thetas, chords, head_speed, *columns, budget)

    def calm(self, curvature: float) -> float:
        """Polar angle from which outwards the |curvature| is at most this [1/m], as for gentle_lag() [rad]."""
        return self.gentle_lag(curvature)

    def summary(self) -> PathSummary:
        """The spiral by its pitch and its start."""
        return PathSummary("spiral", self.begin, self.end, self.pitch, self.start_turns)

    def drawn(self, reached: Floats) -> Floats:
        """Points (N, 2) [m] for a picture: from the centre to the start, or further out to the given points."""
        radius = max(float(np.hypot(*self.frame.back(reached).T).max()), self.growth * self.start_theta)
        theta = np.linspace(0.0, radius / self.growth, DRAWN_POINTS * int(radius / self.pitch + 2))
        line: Floats = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
        return self.frame.points(line * (self.growth * theta[:, None]))

    def _drawn_lines(self) -> list[Floats]:
        return [self.drawn(self.frame.points(np.zeros(2)))]

    def drawn_between(self, low: float, high: float) -> Interval:
        """From low, which may be on the outward extension, to high or the centre [m]."""
        return low, min(high, self.end)

    def drawn_begin(self, points: Floats) -> float:
        """s of the first of the points (N, 2) [m]."""
        return self.travel_to(float(np.hypot(*self.frame.back(points[:1])[0])))

    def tangent(self, s: Floats | float) -> Floats:
        """Unit tangents in the direction of travel. s: (...) [m]; returns (..., 2)."""
        theta, cos, sin = self._directions(s)
        along: Floats = np.stack([theta * sin - cos, -theta * cos - sin], axis=-1)
        return self.frame.vectors(along / np.sqrt(1.0 + theta * theta)[..., None])


def end_theta(dragon: Dragon, path: Spiral) -> tuple[float, int | None]:
    """The head angle [rad] at which the run ends, and the bench that folds (0 and None at the centre).

    Bench k folds when handle k reaches the fold of its chord; at that moment handle k - 1 is one chord further in. So
    limits are found from the tail forwards: the limit of handle k is the larger of its own fold and the place from
    which handle k + 1 reaches its limit. In a uniform tail its own fold is always the larger one.
    """
    chords = dragon.chords[: dragon.uniform_from + 1].tolist()
    chords2 = [(chord / path.growth) * (chord / path.growth) for chord in chords]
    fold = {chord2: float(kernels.fold_theta(chord2)) for chord2 in set(chords2)}
    limit, bench = 0.0, None
    for k in range(dragon.uniform_from, -1, -1):
        chord2 = chords2[k]
        inherited = kernels.previous_theta(limit, chord2) if limit > fold[chord2] else kernels.NO_ROOT
        if fold[chord2] >= inherited:
            limit, bench = fold[chord2], k
        else:
            limit = inherited
    return (limit * (1.0 + FOLD_ROUNDING), bench) if limit > 0.0 else (0.0, None)

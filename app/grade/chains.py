"""Chains of handles computed with known errors, to compare with a student's numbers.

The right dance comes from `core`. This module computes wrong ones: handles one arc apart instead of one chord,
angles rounded in between, and turns whose arcs do not meet the spiral tangentially, which `core` refuses as paths.
Handle by handle they take up to a second, and a class has the same instants: the latest ones are kept. State: these.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.grade.expected import Motion, motion
from app.grade.handles import Mask
from core import Dance, Dragon, Spiral, Turn
from core.values import Floats

# Most steps of Newton for the next angle, and of false position for the next place: both reach 1e-12 much earlier.
NEWTON_STEPS, FALSE_STEPS = 8, 40
# Step of the search for the nearest place one chord away, in chords: where a path turns back, that place is far [1].
WIDER = 0.05
# Number of motions that are kept, and their most instants, those of result1: 1.6 MB.
KEPT, KEPT_TIMES = 32, 301


def spiral_arc(radius: Floats | float, growth: float) -> Floats:
    """Arc length of a spiral from its centre to a radius, or to several [m]."""
    theta = np.asarray(radius) / growth
    return np.asarray(0.5 * growth * (theta * np.hypot(1.0, theta) + np.arcsinh(theta)))


def times_at(path: Spiral, radius: Floats) -> Floats:
    """Times at which a head that goes 1 m/s is at radii of a spiral [s]."""
    return np.asarray(path.length - spiral_arc(radius, path.growth))


def link_speeds(position: Floats, tangent: Floats) -> Floats:
    """Speeds (T, H) [m/s] of handles on rigid links, the first at 1 m/s; both ends of a link are equally fast along it.

    position, tangent: (T, H, 2); v[k + 1] (T[k + 1] . u) = v[k] (T[k] . u), u along the link
    """
    along = position[:, :-1] - position[:, 1:]
    before = np.abs((tangent[:, :-1] * along).sum(axis=-1))
    after = np.abs((tangent[:, 1:] * along).sum(axis=-1))
    ratio = before / np.where(after > 0.0, after, 1.0)
    return np.concatenate([np.ones((len(position), 1)), np.cumprod(ratio, axis=1)], axis=1)


def equal_arcs(dance: Dance) -> Motion:
    """Motion of handles one chord's length apart along the curve: all are equally fast."""
    back = np.concatenate([[0.0], np.cumsum(dance.dragon.chords)])

    def moved(times: Floats) -> Floats:
        s = times[:, None] * dance.head_speed - back
        return motion(dance.path.position(s), np.full(s.shape, dance.head_speed))

    return moved


def rounded_angles(dance: Dance, path: Spiral, decimals: int) -> Motion:
    """Motion with every polar angle rounded to some decimals before the next one is computed."""
    return _motion_by(_rounded, dance, path, decimals)


@lru_cache(KEPT)
def _kept(compute: Callable[..., Floats], *values: Hashable) -> Floats:
    return compute(*values)


def _motion_by(compute: Callable[..., Floats], *about: Hashable) -> Motion:
    """The motion that a function computes about some values; the latest ones are kept, but not long ones."""

    def moved(times: Floats) -> Floats:
        if times.size > KEPT_TIMES:
            return compute(*about, times)
        return _kept(compute, *about, tuple(times.tolist())).copy()

    return moved


def _rounded(dance: Dance, path: Spiral, decimals: int, times: Sequence[float] | Floats) -> Floats:
    thetas = [np.round(path.theta(np.array(times) * dance.head_speed), decimals)]
    for chord in dance.dragon.chords:
        thetas.append(np.round(thetas[-1] + _turned(thetas[-1], (chord / path.growth) ** 2), decimals))
    return _on_spiral(path, np.stack(thetas, axis=1))


def _turned(theta: Floats, chord2: float) -> Floats:
    """Angle to the next handle by Newton: delta^2 + 4 theta (theta + delta) sin^2(delta / 2) = chord2."""
    delta = np.sqrt(chord2) / np.maximum(theta, 1.0)
    for _ in range(NEWTON_STEPS):
        sine, cosine = np.sin(0.5 * delta), np.cos(0.5 * delta)
        value = delta**2 + 4.0 * theta * (theta + delta) * sine**2 - chord2
        slope = 2.0 * delta + 4.0 * theta * (sine**2 + (theta + delta) * sine * cosine)
        delta = delta - value / slope
    return np.asarray(delta)


def _on_spiral(path: Spiral, theta: Floats) -> Floats:
    """The motion of handles at these polar angles (T, H)."""
    radial = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    across = np.stack([radial[..., 1], -radial[..., 0]], axis=-1)
    position = radial * (path.growth * theta)[..., None]
    tangent = (theta[..., None] * across - radial) / np.sqrt(1.0 + theta**2)[..., None]
    return motion(position, link_speeds(position, tangent))


# Centre, radius, first angle, and angle turned.
Arc = tuple[complex, float, float, float]


@dataclass(frozen=True)
class Bent:
    """A turn of two arcs that may meet the spiral and each other at an angle.

    right: the turn whose coils lead in and out
    """

    right: Turn
    arcs: tuple[Arc, ...]

    @property
    def length(self) -> float:
        return sum(radius * abs(turned) for _, radius, _, turned in self.arcs)

    def points(self, s: Floats) -> Floats:
        """Points (..., 2) at places s [m], 0 at the entry."""
        xy = self.right.position(self._outside(s))
        for (centre, radius, _, _), here, spoke in self._spokes(s):
            xy = np.where(here[..., None], np.array([centre.real, centre.imag]) + radius * spoke, xy)
        return xy

    def tangents(self, s: Floats) -> Floats:
        """Directions of travel (..., 2) at places s [m]."""
        directions = self.right.tangent(self._outside(s))
        for (_, _, _, turned), here, spoke in self._spokes(s):
            ahead = math.copysign(1.0, turned) * np.stack([-spoke[..., 1], spoke[..., 0]], axis=-1)
            directions = np.where(here[..., None], ahead, directions)
        return directions

    def _outside(self, s: Floats) -> Floats:
        """Places on the right turn: those of the coils; where an arc is here, any."""
        return np.where(s < 0.0, s, self.right.length + np.maximum(s - self.length, 0.0))

    def _spokes(self, s: Floats) -> Iterator[tuple[Arc, Mask, Floats]]:
        """Each arc, the places that are on it, and the unit vectors (..., 2) from its centre."""
        begun = 0.0
        for arc in self.arcs:
            _, radius, start, turned = arc
            angle = start + math.copysign(1.0, turned) * (s - begun) / radius
            here = (s >= begun) & (s < begun + radius * abs(turned))
            yield arc, here, np.stack([np.cos(angle), np.sin(angle)], axis=-1)
            begun += radius * abs(turned)


def on_bent(dragon: Dragon, path: Bent) -> Motion:
    """Motion of a dragon along such a turn at 1 m/s: each handle is at the nearest place a chord behind its leader."""
    return _motion_by(_on_bent, dragon, path)


def _on_bent(dragon: Dragon, path: Bent, times: Sequence[float] | Floats) -> Floats:
    places = [np.array(times)]
    for chord in dragon.chords.tolist():
        places.append(_behind(path, places[-1], path.points(places[-1]), chord))
    s = np.stack(places, axis=1)
    position = path.points(s)
    return motion(position, link_speeds(position, path.tangents(s)))


def _behind(path: Bent, s: Floats, point: Floats, chord: float) -> Floats:
    """Places behind s with points one chord from `point`: bracketed, then by the Illinois method, all together.

    scipy.optimize.elementwise.find_root takes six times as long: 1.3 s for 223 benches at 201 instants instead of 0.2 s
    (measured 2026-11-24).
    """

    def excess(at: Floats) -> Floats:
        return np.asarray(np.linalg.norm(path.points(at) - point, axis=-1) - chord)

    near = far = s - 0.9 * chord
    f_near = f_far = excess(far)
    while (short := f_far < 0.0).any():
        near, f_near = np.where(short, far, near), np.where(short, f_far, f_near)
        far = np.where(short, far - WIDER * chord, far)
        f_far = excess(far)
    middle = near
    for _ in range(FALSE_STEPS):
        span = np.where(f_far != f_near, f_far - f_near, 1.0)
        middle = far - f_far * (far - near) / span
        value = excess(middle)
        if np.abs(value).max() < 1e-12:
            break
        crossed = np.sign(value) != np.sign(f_far)
        f_near = np.where(crossed, f_far, 0.5 * f_near)
        near = np.where(crossed, far, near)
        far, f_far = middle, value
    return middle

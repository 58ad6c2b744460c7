"""The ground that a bench may cover when the people who carry it stray: a region, and three hulls that hold it.

Motion by a stray. A bench with chord l is rigid; the two people at its holes stand at d0 (front) and d1 (rear) from
their nominal places, |d0|, |d1| <= delta, the stray. Let z be the complex coordinate of a point of the bench, from the
middle of the chord along it. A rigid motion is linear in the places of the two holes, so that point moves by exactly
    d0 (1/2 + z / l) + d1 (1/2 - z / l),
and the only condition besides the two discs is that the chord keeps its length. With phi the angle by which the bench
turns, q = l sin(phi / 2), t the unit vector along the half-turned chord and n the one across it,
    d0 = m + q n,   d1 = m - q n,
where m is the displacement of the middle: it may be anywhere in the lens of the two discs of radius delta about -q n
and q n, and |q| <= delta. The support of this lens in a direction at the angle theta to t is
    delta - |q sin theta|                      where |q| <= delta |sin theta|   (one of the discs alone), else
    |cos theta| sqrt(delta^2 - q^2)            (its tip).

Two benches. For a bound, benches that share no handle may be taken to stray independently: whatever the benches between
them allow, the strays of their four handles are among all those with |d| <= delta. Let U be the union of all places of
one bench, a fixed region in the frame of its nominal place. Then some place of one bench meets some place of another
exactly if their two regions meet. So the largest safe stray is a question of first contact, asked of regions instead of
benches: it needs no bound on the coupling of the two, and loses nothing. With a margin, the distance of the regions
must exceed it.

Three hulls. U is not convex: a person at a hole moves a side by delta there, and its overhanging end by more, so that U
has the shape of a bone. Cut the bench (not U) across at its two holes. The part between the holes moves sideways by
delta at most where it counts, and the ends are short, so the region of each part is convex up to terms of second order;
U lies within the union of the three convex hulls. The support of the hull of a part in each direction n_k, at the angle
theta_k, is
    H(k) = max over |q| <= delta, and over the part's corners c, of   lens(theta_k - phi / 2) + n_k . (c turned by phi),
and the polygon of these half planes, for DIRECTIONS evenly spaced directions, holds the hull.

The maximum. Let q = delta sin psi, kappa = delta / l. On each of the two ranges of the lens everything is smooth in
psi:
    |phi'| <= 2 kappa,   |phi''| <= 2 kappa',   kappa' = kappa / sqrt(1 - kappa^2),
    |lens''| <= delta (1 + 2 kappa + kappa^2 + kappa'),   |(n . c)''| <= |c| (4 kappa^2 + 2 kappa').
Value and slope agree where the ranges meet, and at psi = 0 the slope only falls. So between two samples that are h
apart, and on one side of psi = 0, no value exceeds the higher one by more than K h^2 / 8, K the sum of the two bounds.
This is added to the higher sample.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.dragon import Dragon
from core.errors import InvalidValue
from core.kernels.constants import DIRECTIONS
from core.quantities import Quantity
from core.values import Floats

# Number of samples of psi on either side of 0 [1]: the supports are then too large by at most 2e-4 of the stray.
SAMPLES = 64
# Largest part of the distance between two hulls by which their largest gap across a side of either falls short [1].
SHORT = 1.0 - math.cos(math.pi / DIRECTIONS)
# Part added to every support, for the rounding of fewer than 100 operations on lengths of the bench [1]; the corners of
# a polygon with DIRECTIONS sides magnify an error of its supports tenfold.
SUPPORT_ROUNDING = 1e-13
# Largest number of different sizes of benches in a dragon with strays [1]: each takes a millisecond.
SIZES_MAX = 1000


@dataclass(frozen=True, slots=True)
class Reach:
    """The benches of a dragon with all places to which they may stray.

    bounds: the same dragon, each bench as long and as wide as its hulls
    hulls: (kinds, 3, DIRECTIONS, 2) corners of the hulls of front end, middle and rear end, counter-clockwise, in
        the bench's own frame [m]: corner k lies between the half planes of directions k and k + 1
    kinds: (uniform_from + 1,) the kind of each bench
    corners, middle_half_width, within: their lengths for the ring bounds, see core/kernels/rings.py
    """

    bounds: Dragon
    hulls: Floats
    kinds: NDArray[np.int64]
    corners: Floats
    middle_half_width: float
    within: float


@cache
def directions() -> Floats:
    """The unit vectors (DIRECTIONS, 2) across the sides of every hull."""
    theta = 2.0 * math.pi / DIRECTIONS * np.arange(DIRECTIONS)
    return np.stack([np.cos(theta), np.sin(theta)], axis=-1)


@cache
def _sampled() -> tuple[Floats, Floats]:
    """Sines and cosines (2, 2 SAMPLES + 1) of psi, and the unit vectors (2, DIRECTIONS)."""
    psi = np.linspace(-0.5 * math.pi, 0.5 * math.pi, 2 * SAMPLES + 1)
    return np.stack([np.sin(psi), np.cos(psi)]), np.ascontiguousarray(directions().T)


def gain(chords: Floats, overhangs: Floats, half_widths: Floats) -> Floats:
    """Largest way of any point of each bench per metre that both of its holes stray [1]: the simple bound.

    |d0 (1/2 + z/l) + d1 (1/2 - z/l)| is at most (|l/2 + z| + |l/2 - z|) / l times the larger of |d0| and |d1|; this
    factor is convex in z, so it is largest in a corner.
    """
    near, far = np.hypot(overhangs, half_widths), np.hypot(chords + overhangs, half_widths)
    return (near + far) / chords


def gains(dragon: Dragon) -> Floats:
    """The gain (n,) of every bench."""
    return gain(dragon.chords, dragon.overhangs, 0.5 * dragon.widths)


@lru_cache(maxsize=4)  # a march that goes on needs it again
def simple_reach(dragon: Dragon, stray: float) -> Reach:
    """Upper bound of reach(): every bench widened on all sides by its gain times the stray."""
    return _reach(dragon, stray, _simple_supports)


@lru_cache(maxsize=4)  # one question needs it several times, and so does a user who drags the pitch
def reach(dragon: Dragon, stray: float) -> Reach:
    """The ground that the benches of a dragon may cover while every hole is within the stray of its place [m].

    raises: InvalidValue for a dragon with more than SIZES_MAX sizes of benches
    """
    return _reach(dragon, stray, supports)


def _reach(dragon: Dragon, stray: float, supports: Callable[..., Floats]) -> Reach:
    alike = dragon.uniform_from + 1
    columns = (column[:alike].tolist() for column in (dragon.chords, dragon.overhangs, 0.5 * dragon.widths))
    numbers: dict[tuple[float, float, float], int] = {}
    of = [numbers.setdefault(size, len(numbers)) for size in zip(*columns, strict=True)]
    if len(numbers) > SIZES_MAX:
        rule, most = "must have at most {most} different sizes of benches with a stray of {stray}", SIZES_MAX
        raise InvalidValue("dragon.lengths", rule, got=len(numbers), most=most, stray=Quantity(stray, "m"))
    kinds = np.array(of, dtype=np.int64)
    hulls = bench_hulls(np.stack([supports(*size, stray) for size in numbers], axis=1))
    half_lengths, half_widths = np.abs(hulls).max(axis=(1, 2)).T
    spread = np.full(dragon.benches, kinds[-1])
    spread[:alike] = kinds
    overhangs = half_lengths[spread] * (1.0 + SUPPORT_ROUNDING) - 0.5 * dragon.chords
    bounds = dragon.outlined(overhangs, 2.0 * half_widths[spread])
    return Reach(bounds, hulls, kinds, *ring_bounds(dragon.chords[:alike], hulls, kinds))


def ring_bounds(chords: Floats, hulls: Floats, kinds: NDArray[np.int64], outer: int = 2) -> tuple[Floats, float, float]:
    """Reach.corners, middle_half_width and within.

    Only the first quarter of the corners of front ends counts: no other corner is both further out and further aside.
    Benches from `outer` on, or the last, can be the outer one of a pair.
    """
    chord = np.empty((len(hulls), 1))
    chord[kinds, 0] = chords
    further, aside = np.moveaxis(hulls[:, 0, : DIRECTIONS // 4], -1, 0)
    further = np.maximum(further - 0.5 * chord, 0.0)
    corners = np.stack([0.5 * further * (further + chord), aside], axis=-1).reshape(-1, 2)
    outer = min(outer, len(kinds) - 1)
    outers = hulls[kinds[outer:]]
    within = 0.5 * float(chords[outer:].max()) - float(outers[:, 0, :, 0].min())
    return corners, float(outers[:, 1, :, 1].max()), within


def bench_hulls(supports: Floats) -> Floats:
    """Corners (..., 3, DIRECTIONS, 2) of the hulls of front end, middle and rear end [m] of benches with these supports
    (2, ..., DIRECTIONS) [m]."""
    front, middle = _polygon(supports)
    half = DIRECTIONS // 2
    rear = -np.roll(front, -half, axis=-2)  # the same polygons, half a turn about the middle of the bench
    return np.stack([front, middle, rear], axis=-3)


# A bench is the same mirrored left to right: half of the directions are computed.
_MIRRORED = np.minimum(np.arange(DIRECTIONS), DIRECTIONS - np.arange(DIRECTIONS))


def supports(chord: float, overhang: float, half_width: float, stray: float) -> Floats:
    """Upper bounds (2, DIRECTIONS) of the support of all places of a bench's front end, and of its middle [m].

    Each is good to K h^2 / 8, see the top of this file.
    """
    best = np.full((2, DIRECTIONS // 2 + 1), -math.inf)
    kernels.largest_supports(chord, overhang, half_width, stray, *_sampled(), best)
    kappa = stray / chord
    steep = kappa / math.sqrt(1.0 - kappa * kappa)
    for part, far in enumerate((0.5 * chord + overhang, 0.5 * chord)):
        furthest = math.hypot(far, half_width)
        second = stray * (1.0 + 2.0 * kappa + kappa * kappa + steep) + furthest * (4.0 * kappa * kappa + 2.0 * steep)
        best[part] += 0.125 * second * (0.5 * math.pi / SAMPLES) ** 2 + SUPPORT_ROUNDING * (furthest + stray)
    return best[:, _MIRRORED]


def _simple_supports(chord: float, overhang: float, half_width: float, stray: float) -> Floats:
    """supports() of a bench's front end and middle, widened on all sides by its gain times the stray [m]."""
    cosine, sine = directions().T
    far = np.array([[0.5 * chord, 0.5 * chord + overhang], [-0.5 * chord, 0.5 * chord]])
    grown = gain(*np.array([chord, overhang, half_width])) * stray
    support: Floats = (far[:, :, None] * cosine).max(axis=1) + half_width * np.abs(sine) + grown
    return support


def _polygon(support: Floats) -> Floats:
    """Corners (..., DIRECTIONS, 2) of the half planes with these supports (..., DIRECTIONS)."""
    step = 2.0 * math.pi / DIRECTIONS
    along = (np.roll(support, -1, axis=-1) - support * math.cos(step)) / math.sin(step)
    cosine, sine = directions().T
    return np.stack([support * cosine - along * sine, support * sine + along * cosine], axis=-1)

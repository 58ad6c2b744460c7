"""The ground that a bench may cover when the people who carry it stray: a region, and three hulls that hold it.

What a stray does. A bench with chord l is rigid; the two people at its holes stand at d0 (front) and d1 (rear) from
where they should, |d0|, |d1| <= delta, the stray. Let z be the complex coordinate of a point of the bench, from the
middle of the chord along it. As a rigid motion is linear in the places of the two holes, that point moves by exactly
    d0 (1/2 + z / l) + d1 (1/2 - z / l),
and the only condition besides the two discs is that the chord keeps its length. With phi the angle by which the bench
turns, q = l sin(phi / 2), t the unit vector along the half-turned chord and n the one across it,
    d0 = m + q n,   d1 = m - q n,
where m is how far the middle moves: it may be anywhere in the lens of the two discs of radius delta about -q n and q n,
and |q| <= delta. The support of that lens in a direction at the angle theta to t is
    delta - |q sin theta|                      where |q| <= delta |sin theta|   (one of the discs alone), else
    |cos theta| sqrt(delta^2 - q^2)            (its tip).

Two benches. Benches that share no handle stray independently of one another, as far as a bound is concerned: whatever
the benches between them allow, the strays of their four handles are among all those with |d| <= delta. Let U be the
union of all places of one bench, a fixed region in the frame of its nominal place. Then some place of one bench meets
some place of another exactly if their two regions meet. So the question of how far people may stray is the question
of first contact, asked of regions instead of benches: no bound on the coupling of the two is needed, and nothing is
lost. For a margin, their distance is to exceed it.

Three hulls. U is not convex: a person at a hole moves a side by delta there, and its overhanging end by more, so that U
is a bone. Cut the bench (not U) across at its two holes. The part between the holes moves sideways by delta at most
where it counts, and the ends are short, so the region of each part is convex but for terms of second order; U lies
within the union of the three convex hulls. The hull of a part is known by its support in each direction n_k, at the
angle theta_k,
    H(k) = max over |q| <= delta, and over the part's corners c, of   lens(theta_k - phi / 2) + n_k . (c turned by phi),
and the polygon of these half planes, for DIRECTIONS even directions, holds it.

The maximum. Let q = delta sin psi, kappa = delta / l. On each of the two ranges of the lens everything is smooth in psi
    |phi'| <= 2 kappa,   |phi''| <= 2 kappa',   kappa' = kappa / sqrt(1 - kappa^2),
    |lens''| <= delta (1 + 2 kappa + kappa^2 + kappa'),   |(n . c)''| <= |c| (4 kappa^2 + 2 kappa'),
value and slope agree where the ranges meet, and at psi = 0 the slope only falls. So between two samples that are h
apart, and on one side of psi = 0, no value exceeds the higher one by more than K h^2 / 8, K the sum of the two bounds:
this is added.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.dragon import Dragon
from core.errors import InvalidValue, said
from core.kernels.constants import DIRECTIONS
from core.values import Floats

# Samples of psi on either side of 0: the supports are then too large by 2e-4 of the stray at most [1].
SAMPLES = 64
# Added to every support, for the rounding of fewer than 100 operations on lengths of the bench [1]; the corners of a
# polygon with DIRECTIONS sides magnify an error of its supports tenfold.
SUPPORT_ROUNDING = 1e-13
# Most benches of different size in one dragon whose regions are laid out: a millisecond each [1].
SIZES_MAX = 1000


@dataclass(frozen=True, slots=True)
class Reach:
    """The benches of a dragon with all places to which they may stray.

    bounds: the same dragon, each bench as long and as wide as its hulls
    hulls: (kinds, 3, DIRECTIONS, 2) corners of the hulls of front end, middle and rear end, counter-clockwise, in
        the bench's own frame [m]: corner k lies between the half planes of directions k and k + 1
    kinds: (uniform_from + 1,) which of them is a bench's
    """

    bounds: Dragon
    hulls: Floats
    kinds: NDArray[np.int64]


def directions() -> Floats:
    """The unit vectors (DIRECTIONS, 2) across the sides of every hull."""
    theta = 2.0 * math.pi / DIRECTIONS * np.arange(DIRECTIONS)
    return np.stack([np.cos(theta), np.sin(theta)], axis=-1)


def reach(dragon: Dragon, stray: float) -> Reach:
    """What the benches of a dragon may cover while every hole is within the stray of its place [m].

    raises: InvalidValue for a dragon with more than SIZES_MAX sizes of benches
    """
    alike = dragon.uniform_from + 1
    sizes = np.stack([dragon.chords[:alike], dragon.overhangs[:alike], 0.5 * dragon.widths[:alike]], axis=1)
    distinct, kinds = np.unique(sizes, axis=0, return_inverse=True)
    if len(distinct) > SIZES_MAX:
        rule = f"must have at most {SIZES_MAX} different sizes of benches with a stray of {said(stray)} m"
        raise InvalidValue("dragon.lengths", f"dragon.lengths {rule}, got {len(distinct)}")
    kinds = kinds.reshape(-1).astype(np.int64)
    hulls = np.stack([bench_hulls(chord, overhang, half, stray) for chord, overhang, half in distinct.tolist()])
    half_lengths, half_widths = np.abs(hulls).max(axis=(1, 2)).T
    spread = np.concatenate([kinds, np.full(dragon.benches - len(kinds), kinds[-1], dtype=np.int64)])
    overhangs = half_lengths[spread] * (1.0 + SUPPORT_ROUNDING) - 0.5 * dragon.chords
    return Reach(dragon.outlined(overhangs, 2.0 * half_widths[spread]), hulls, kinds)


def bench_hulls(chord: float, overhang: float, half_width: float, stray: float) -> Floats:
    """Corners (3, DIRECTIONS, 2) of the hulls of one bench's front end, middle and rear end [m]."""
    inner, outer = 0.5 * chord, 0.5 * chord + overhang
    corners = np.array([[inner, half_width], [outer, half_width], [inner, -half_width], [outer, -half_width]])
    front = _polygon(supports(corners, chord, stray))
    middle = corners[[0, 2]]
    return np.stack([front, _polygon(supports(np.concatenate([middle, -middle]), chord, stray)), _turned(front)])


def supports(corners: Floats, chord: float, stray: float) -> Floats:
    """Upper bounds of the support (DIRECTIONS,) of all places of some points of a bench [m].

    corners: (n, 2) in the bench's own frame [m]; each bound is good to K h^2 / 8, see the top of this file
    """
    x, y = directions()[:, :, None].swapaxes(0, 1)
    sine = np.sin(np.linspace(-0.5 * math.pi, 0.5 * math.pi, 2 * SAMPLES + 1))
    kappa = stray / chord
    half_sine, half_cosine = kappa * sine, np.sqrt(1.0 - (kappa * sine) ** 2)
    across, along = np.abs(y * half_cosine - x * half_sine), np.abs(x * half_cosine + y * half_sine)
    q = np.abs(sine)
    lens = stray * np.where(q <= across, 1.0 - q * across, along * np.sqrt(1.0 - sine * sine))
    c, s = half_cosine * half_cosine - half_sine * half_sine, 2.0 * half_sine * half_cosine
    best = np.max([lens + (x * (c * px - s * py) + y * (s * px + c * py)) for px, py in corners.tolist()], axis=(0, 2))
    furthest = float(np.hypot(*corners.T).max())
    steep = kappa / math.sqrt(1.0 - kappa * kappa)
    bend = stray * (1.0 + 2.0 * kappa + kappa * kappa + steep) + furthest * (4.0 * kappa * kappa + 2.0 * steep)
    supported: Floats = best + 0.125 * bend * (0.5 * math.pi / SAMPLES) ** 2 + SUPPORT_ROUNDING * (furthest + stray)
    return supported


def _polygon(support: Floats) -> Floats:
    """Corners of the half planes with these supports."""
    step = 2.0 * math.pi / DIRECTIONS
    along = (np.roll(support, -1) - support * math.cos(step)) / math.sin(step)
    cosine, sine = directions().T
    return np.stack([support * cosine - along * sine, support * sine + along * cosine], axis=-1)


def _turned(polygon: Floats) -> Floats:
    """The same polygon half a turn about the middle of the bench."""
    return -np.roll(polygon, DIRECTIONS // 2, axis=0)

"""Benches next but one to each other: the bench between them holds them apart, and in which pose they touch.

To the march all benches stray independently (core/tolerance/reach.py). Of three benches that follow one another that
gives far too much away: the first and the last hang on the one between, and touch only if they fold.

In the frame of the bench between, with its chord c_1 from handle 2 to handle 1 along x, the shape of the three is given
by the headings a of the first and b of the last one, and
    d_02 = |c_0 e(a) + c_1|,   d_13 = |c_1 + c_2 e(b)|,   d_03 = |c_0 e(a) + c_1 + c_2 e(b)|,   e(a) = exp(i a),
are the distances of handles. Their sags are how far handle j of three i, j, k is from the point between i and k where
it is on a straight line. With L = c_0 + c_1 + c_2 that of
    0, 1, 2 is |u (e(a) - 1) - v (e(b) - 1)| with u = c_0 c_1 / (c_0 + c_1), v = 0,   and of 1, 2, 3 likewise,
    0, 1, 3 has u = c_0 (c_1 + c_2) / L, v = c_0 c_2 / L,   and 0, 2, 3 has u = c_0 c_2 / L, v = (c_0 + c_1) c_2 / L.
Strays within delta change no distance of two handles and no sag by more than 2 delta. So three benches whose shape in
their places has the distances D and the sags S can come into a shape (a, b) with d and s only if
    delta >= N(a, b) = max(D - d, s - S) / 2 over all of them:
they do not touch while delta is below the least N of all shapes in which they do. Distances tell of a fold; small bends
change them with their squares only, and sags in proportion.

The places. Let no curvature of the path exceed k, with k c / 2 <= 1 for every chord c. The next handle is
where the path first comes to the distance c; by Schur's comparison with a circle that is after a length L of at most
(2 / k) asin(k c / 2). The tangent turns by at most k L <= pi on it, so the chord, its mean, is turned against the
tangent at either end by half of that at most: with x = k s - k L / 2, turned by x' <= x and x' >= -k s - k L / 2 >=
-pi - x, sin x' <= sin x, and the integral of sin x over L is 0. Two chords in a row hence bend by at most
    A = asin(k c_0 / 2) + asin(k c_1 / 2),   B = asin(k c_1 / 2) + asin(k c_2 / 2),   both <= pi,
    D_02^2 >= c_0^2 + c_1^2 + 2 c_0 c_1 cos A,   D_13 likewise,   D_03 >= c_0 cos A + c_1 + c_2 cos B,
    S <= u |e(A) - 1| + v |e(B) - 1|.

The least N. Shapes are cut into cells of half width h. In one of them d_02 differs from that in its middle by
min(c_0, c_1) h at most, d_13 likewise, d_03 by (c_0 + c_2) h, a sag by (u + v) h, and the separation of the two benches
by (r_0 + r_2) h, with r the distance of a bench's furthest corner from the handle that it hangs on. So a cell whose
middle is further apart than that holds no touch, and of the others the least N less its change is a bound; they are cut
on while they may be below what is wanted, and below N of a middle that does touch. Mirrored shapes are alike: 0 <= a <=
pi is enough.

The pose. For a shape and a direction the least of the largest strays is the radius of the smallest circle around the
four handles' differences from their places, and that is the largest of the radii of three of them. Grids that narrow
around their best find a shape that touches, and its direction: what they might miss costs some of the bracket.
"""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from core.budget import Budget
from core.dance import Dance
from core.kernels import spiral_curvature
from core.kernels.constants import BENT
from core.paths.spiral import Spiral
from core.shapes.rectangles import frames, frames_separation
from core.values import Floats

# Cells of a turn, at first, and how often they are cut in four: to 2e-4 rad in the end [1].
CELLS, CUTS = 24, 9
# Most cells that are looked at together; beyond that what is known of them by then is the bound [1].
CELLS_MOST = 200_000
# Nothing is said of dragons with more different threes of benches than this: 0.1 s [1].
TRIPLES_MOST = 100
# Taken off the bound, for the rounding of fewer than 100 operations on lengths up to 1e3 m [m].
ROUNDING = 1e-9
# Shapes of a first grid over each turn, how many of those that touch are tried in how many directions, points of a
# further grid, how much narrower it is than the one before, and how many there are [1].
SHAPES, SHAPES_TRIED, GRID, NARROWER, ROUNDS = 120, 600, 9, 0.7, 45
# Depth of the overlap that is exhibited, far above the rounding of places up to 1e4 m [m].
DEPTH = 1e-7
# Work of a cell, as of a pair of benches [1].
CELL_WORK = 1.0


def held_apart(dance: Dance, until: float, most: float, budget: Budget) -> float:
    """The stray up to which no two benches with one between them touch, `most` or less, proven; 0 if none is [m].

    until: the head's travel up to which they are asked about [m]
    """
    dragon = dance.dragon
    alike = min(dragon.benches, dragon.uniform_from + 3)
    sizes = np.stack([dragon.chords, dragon.lengths, dragon.widths], axis=1)[:alike]
    triples = np.unique(np.stack([sizes[:-2], sizes[1:-1], sizes[2:]], axis=1), axis=0)
    bends = 0.5 * _sharpest(dance, until) * triples[..., 0]
    if len(triples) > TRIPLES_MOST or not (bends <= 1.0).all():
        return 0.0
    return max(0.0, _least_stray(triples, np.arcsin(bends), most + ROUNDING, budget) - ROUNDING)


def _sharpest(dance: Dance, until: float) -> float:
    """No curvature of the path is larger where a dragon stands whose head has gone so far [1/m]."""
    path = dance.path
    if isinstance(path, Spiral):
        innermost = float(path.theta(min(until, path.length)))
        return float(spiral_curvature(innermost)) / path.growth * (1.0 + ROUNDING)
    return float(path.sharpest[0] + np.abs(path.table[:, BENT]).max()) * (1.0 + ROUNDING)


def _least_stray(triples: Floats, leans: Floats, most: float, budget: Budget) -> float:
    """The least N of shapes in which the first and the last of three benches touch, or `most` if that is less [m].

    triples: (K, 3, 3) chord, length and width of three benches [m]; leans: (K, 3) asin(k c / 2)
    """
    chords = triples[..., 0]
    bends = leans[:, ::2] + leans[:, 1:2]
    places = _distances(chords, bends)
    places[:, 2] = chords[:, 1] + (chords[:, ::2] * np.cos(bends)).sum(axis=1)
    pulls = _pulls(chords)
    most_sag = (pulls * np.abs(np.exp(1j * bends) - 1.0)[:, None]).sum(axis=2)
    shorter, ends = np.minimum(chords[:, :2], chords[:, 1:]), chords[:, ::2].sum(axis=1, keepdims=True)
    slack = np.concatenate([shorter, ends, pulls.sum(axis=2)], axis=1)
    corner = np.hypot(0.5 * (triples[..., 1] + chords), 0.5 * triples[..., 2])
    half = 0.5 * math.pi / CELLS
    a, b = np.meshgrid(half * np.arange(1, 2 * CELLS, 2), half * np.arange(1 - 2 * CELLS, 2 * CELLS, 2), indexing="ij")
    middles = np.tile(np.stack([a.ravel(), b.ravel()], axis=1), (len(triples), 1))
    of = np.repeat(np.arange(len(triples)), a.size)
    for cut in range(CUTS + 1):
        budget.afford(CELL_WORK * len(of))
        gap = shape_gaps(triples[of], middles)
        fallen, risen = places[of] - _distances(chords[of], middles), _sags(pulls[of], middles) - most_sag[of]
        change = np.concatenate([fallen, risen], axis=1)
        needed, at_least = 0.5 * change.max(axis=1), 0.5 * (change - slack[of] * half).max(axis=1)
        most = min(most, float(needed[gap <= 0.0].min(initial=most)))
        going = (gap <= (corner[of, 0] + corner[of, 2]) * half) & (at_least < most)
        middles, of, at_least = middles[going], of[going], at_least[going]
        if cut == CUTS or 4 * len(of) > CELLS_MOST:
            break
        half *= 0.5
        middles = (middles[:, None] + half * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])).reshape(-1, 2)
        of = np.repeat(of, 4)
    return min(most, float(at_least.min(initial=most)))


def _distances(chords: Floats, bends: Floats) -> Floats:
    """Distances (N, 3) d_02, d_13, d_03 of three chords (N, 3) with headings a and b (N, 2) [m]."""
    first, last = chords[:, [0, 2]].T * np.exp(1j * bends.T)
    distances: Floats = np.abs(np.stack([first, last, first + last], axis=1) + chords[:, 1:2])
    return distances


def _pulls(chords: Floats) -> Floats:
    """u and v (N, 4, 2) of the sags of handles 0, 1, 2, of 1, 2, 3, of 0, 1, 3 and of 0, 2, 3 [m]."""
    first, middle, last = chords.T
    whole, none = chords.sum(axis=1), np.zeros(len(chords))
    pulls = [
        [first * middle / (first + middle), none],
        [none, middle * last / (middle + last)],
        [first * (middle + last) / whole, first * last / whole],
        [first * last / whole, (first + middle) * last / whole],
    ]
    return np.moveaxis(np.array(pulls), -1, 0)


def _sags(pulls: Floats, bends: Floats) -> Floats:
    """The four sags (N, 4) of shapes (N, 2) [m]."""
    turned = np.exp(1j * bends)[:, None] - 1.0
    sags: Floats = np.abs(pulls[..., 0] * turned[..., 0] - pulls[..., 1] * turned[..., 1])
    return sags


def shape_gaps(triples: Floats, headings: Floats) -> Floats:
    """Separation (N,) of the first and the last of three benches (N, 3, 3) with headings (N, 2) [m]."""
    chords = triples[..., 0]
    centres = 0.5 * (chords[:, 1:2] + chords[:, ::2] * np.exp(1j * headings)) * [1.0, -1.0]
    poses = np.stack([centres.real, centres.imag, headings], axis=-1)
    both = frames(poses, triples[:, ::2, 1:])
    separation: Floats = frames_separation(both[:, 0], both[:, 1]).separation
    return separation


def touching_pose(triple: Floats, places: Floats) -> Floats | None:
    """Handles (4, 2) of three benches, the first and the last of which overlap, with strays as small as is found [m].

    triple: (3, 3) chord, length and width; places: (4, 2) of the handles [m]; None: no shape overlaps by DEPTH
    """
    nominal = places @ [1.0, 1j]
    aim = float(np.angle(nominal[1] - nominal[2]))
    turns = np.linspace(-math.pi, math.pi, SHAPES, endpoint=False)
    a, b = (grid.ravel() for grid in np.meshgrid(turns, turns))
    known = np.abs(np.array([nominal[0] - nominal[2], nominal[1] - nominal[3], nominal[0] - nominal[3]]))
    headings = np.stack([a, b], axis=1)
    needed = (known - _distances(np.broadcast_to(triple[:, 0], (a.size, 3)), headings)).max(axis=1)
    order = np.flatnonzero(_overlapping(triple, headings))
    headings = headings[order[np.argsort(needed[order])[:SHAPES_TRIED]]]
    if not len(headings):
        return None
    spans = [turns[1] - turns[0], turns[1] - turns[0], math.pi]
    tried = np.concatenate([np.insert(headings, 2, turn, axis=1) for turn in turns])
    best, way, least = tried[0], aim, math.inf
    for _ in range(ROUNDS):
        tried = tried[_overlapping(triple, tried[:, :2])]
        radii, centres = _smallest_circles(nominal - _laid(triple[:, 0], tried, way))
        at = int(radii.argmin()) if len(radii) else -1
        if at >= 0 and radii[at] < least:
            best, least, centre = tried[at], float(radii[at]), centres[at]
        spans = [NARROWER * span for span in spans]
        grid = [np.linspace(x - span, x + span, GRID) for x, span in zip(best, spans, strict=True)]
        tried = np.stack([axis.ravel() for axis in np.meshgrid(*grid)], axis=1)
    moved = _laid(triple[:, 0], best[None], way)[0] + centre
    return np.stack([moved.real, moved.imag], axis=-1)


def _overlapping(triple: Floats, headings: Floats) -> NDArray[np.bool_]:
    return shape_gaps(np.broadcast_to(triple, (len(headings), 3, 3)), headings) <= -DEPTH


def _laid(chords: Floats, shapes: Floats, way: float) -> NDArray[np.complex128]:
    """Handles (N, 4) of three benches: headings of the first and the last in the frame of the one between, and how far
    that is turned from a direction [rad], its middle at 0."""
    a, b, turn = shapes.T
    half = np.full(len(shapes), 0.5 * chords[1])
    handles = np.stack([half + chords[0] * np.exp(1j * a), half, -half, -half - chords[2] * np.exp(1j * b)], axis=1)
    laid: NDArray[np.complex128] = np.exp(1j * (way + turn))[:, None] * handles
    return laid


def _smallest_circles(points: NDArray[np.complex128]) -> tuple[Floats, NDArray[np.complex128]]:
    """Radii (N,) and centres (N,) of the smallest circles around four points (N, 4)."""
    radii, centres = [], []
    for three in combinations(range(4), 3):
        p, q, r = points[:, list(three)].T
        u, v = q - p, r - p
        cross = (u.conj() * v).imag
        with np.errstate(divide="ignore", invalid="ignore"):
            around = p - 1j * (v * np.abs(u) ** 2 - u * np.abs(v) ** 2) / (2.0 * cross)
        sides = np.stack([np.abs(q - r), np.abs(v), np.abs(u)])
        longest = sides.argmax(axis=0)
        middle = np.choose(longest, [0.5 * (q + r), 0.5 * (p + r), 0.5 * (p + q)])
        wide = 2.0 * sides.max(axis=0) ** 2 >= (sides**2).sum(axis=0)
        centres.append(np.where(wide, middle, around))
        radii.append(np.where(wide, 0.5 * sides.max(axis=0), np.abs(around - p)))
    largest = np.argmax(radii, axis=0)
    rows = np.arange(len(points))
    return np.array(radii)[largest, rows], np.array(centres)[largest, rows]

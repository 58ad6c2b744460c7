"""Two benches with one bench between them: the stray up to which it holds them apart, and a pose in which they touch.

The march lets all benches stray independently (core/shapes/reach.py). For three consecutive benches its bound is far
too low: the first and the last one hang on the one between, and touch only if the three fold up.

The shape of the three is (a, b), the headings of the first and of the last one in the frame of the bench between. In
that frame the chord c_1 leads along x from handle 2 to handle 1. The distances between handles are
    d_02 = |c_0 e(a) + c_1|,   d_13 = |c_1 + c_2 e(b)|,   d_03 = |c_0 e(a) + c_1 + c_2 e(b)|,   e(a) = exp(i a).
Of three handles i, j, k, the sag of j is its distance from the point between i and k where it would be if the benches
stood in a straight line. Every sag is |u (e(a) - 1) - v (e(b) - 1)|, where with L = c_0 + c_1 + c_2
    0, 1, 2 has u = c_0 c_1 / (c_0 + c_1), v = 0,         1, 2, 3 has u = 0, v = c_1 c_2 / (c_1 + c_2),
    0, 1, 3 has u = c_0 (c_1 + c_2) / L, v = c_0 c_2 / L, 0, 2, 3 has u = c_0 c_2 / L, v = (c_0 + c_1) c_2 / L.
Strays of at most delta change every distance between two handles and every sag by at most 2 delta. So three benches
whose nominal shape has the distances D and the sags S can come into a shape (a, b) with d and s only if
    delta >= N(a, b) = max(D - d, s - S) / 2 over all of them.
They do not touch while delta is below the least N of all shapes in which they touch. Both are needed: distances show
that benches fold up, but change only by the square of a small angle; sags change in proportion to it.

The nominal places. Let no curvature of the path exceed k, with k c / 2 <= 1 for every chord c. The next handle is where
the path first comes to the distance c; by Schur's comparison with a circle, this is after a length L of at most
(2 / k) asin(k c / 2). Over this length the tangent turns by at most k L <= pi, and at either end its angle with the
chord is at most k L / 2. Proof: let x' be the direction of the tangent at the length s, measured so that x' = -k L / 2
at the start. Then x' <= x = k s - k L / 2 and x' >= -k s - k L / 2 >= -pi - x, so sin x' <= sin x. The integral of
sin x over L is 0, so that of sin x' is at most 0, and the chord is at most k L / 2 to the left of the tangent at the
start. The mirrored and the reversed path give the same to the right, and at the end. So two consecutive chords differ
in direction by at most
    A = asin(k c_0 / 2) + asin(k c_1 / 2),   B = asin(k c_1 / 2) + asin(k c_2 / 2),   both <= pi,
    D_02^2 >= c_0^2 + c_1^2 + 2 c_0 c_1 cos A,   D_13 likewise,   D_03 >= c_0 cos A + c_1 + c_2 cos B,
    S <= u |e(A) - 1| + v |e(B) - 1|.

The least N. The shapes are cut into cells of half width h. Within a cell d_02 differs from its value in the middle by
at most min(c_0, c_1) h, d_13 likewise, d_03 by (c_0 + c_2) h, a sag by (u + v) h, and the separation of the two benches
by (r_0 + r_2) h, with r the distance of a bench's furthest corner from the handle that it hangs on. So the two benches
touch nowhere in a cell whose middle has a larger separation than that. In each other cell N is at least N in the middle
less the largest change of N. The cell is cut further while this bound is below the largest stray of interest and below
each N of a middle in which benches touch. The mirror image of a shape has the same N, so 0 <= a <= pi is enough.

The pose. Three benches in a given shape and direction can still be shifted. Around the differences of the four handles
from their places there is a smallest circle: its radius is the largest stray after the best shift. It is the largest of
the smallest circles around three of the four. Grids that narrow around their best point find a shape and a direction in
which benches touch. If they miss a better one, the bracket is wider, but still true.
"""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from core.dance import Dance
from core.kernels import Budget
from core.shapes.rectangles import frames, frames_separation
from core.values import Floats

# Number of cells around a full circle at first, and number of times that each is cut in four, down to 2e-4 rad [1].
CELLS, CUTS = 24, 9
# Largest number of cells that are tried together [1]; if more are needed, the result is the bound reached so far.
CELLS_MOST = 200_000
# Largest number of different triples of benches in a dragon that are tried, which takes 0.1 s [1].
TRIPLES_MOST = 100
# Subtracted from the bound, for the rounding of fewer than 100 operations on lengths up to 1e3 m [m].
ROUNDING = 1e-9
# The first grid has SHAPES values of each angle. Of its shapes that touch, SHAPES_TRIED are tried in SHAPES directions.
# Of ROUNDS further grids each has GRID values of each angle, and NARROWER times the width of the one before [1].
SHAPES, SHAPES_TRIED, GRID, NARROWER, ROUNDS = 120, 600, 9, 0.7, 45
# Depth of the overlap in the pose shown, far above the rounding of places up to 1e4 m [m].
DEPTH = 1e-7
# Work of a cell, where that of a pair of benches is 1 [1].
CELL_WORK = 1.0


def held_apart(dance: Dance, until: float, most: float, budget: Budget) -> float:
    """Stray proven safe for all pairs of benches with one between them, up to `most`; 0 if none is proven [m].

    until: travel of the head up to which the claim holds [m]
    """
    dragon = dance.dragon
    alike = min(dragon.benches, dragon.uniform_from + 3)
    sizes = np.stack([dragon.chords, dragon.lengths, dragon.widths], axis=1)[:alike]
    triples = np.unique(np.stack([sizes[:-2], sizes[1:-1], sizes[2:]], axis=1), axis=0)
    sines = 0.5 * (dance.path.sharpest_before(until) * (1.0 + ROUNDING)) * triples[..., 0]
    if len(triples) > TRIPLES_MOST or not (sines <= 1.0).all():
        return 0.0
    return max(0.0, _least_stray(triples, np.arcsin(sines), most + ROUNDING, budget) - ROUNDING)


def holds_apart(dance: Dance, until: float, stray: float, budget: Budget) -> bool:
    """Whether no two benches with one between them are known to touch with a stray [m]. until: see held_apart()"""
    return held_apart(dance, until, stray * (1.0 + ROUNDING) + ROUNDING, budget) >= stray


def _least_stray(triples: Floats, leans: Floats, most: float, budget: Budget) -> float:
    """Lower bound of N over the shapes in which the first and the last of three benches touch, up to `most` [m].

    triples: (K, 3, 3) chord, length and width of three benches [m]; leans: (K, 3) asin(k c / 2)
    """
    chords, joint_angles = triples[..., 0], leans[:, ::2] + leans[:, 1:2]
    nominal = _distances(chords, joint_angles)
    nominal[:, 2] = chords[:, 1] + (chords[:, ::2] * np.cos(joint_angles)).sum(axis=1)
    pulls = sag_pulls(chords)
    most_sag = (pulls * np.abs(np.exp(1j * joint_angles) - 1.0)[:, None]).sum(axis=2)
    shorter, ends = np.minimum(chords[:, :2], chords[:, 1:]), chords[:, ::2].sum(axis=1, keepdims=True)
    slack = np.concatenate([shorter, ends, pulls.sum(axis=2)], axis=1)
    corner = np.hypot(0.5 * (triples[..., 1] + chords), 0.5 * triples[..., 2])
    half = 0.5 * math.pi / CELLS
    a, b = np.meshgrid(half * np.arange(1, 2 * CELLS, 2), half * np.arange(1 - 2 * CELLS, 2 * CELLS, 2), indexing="ij")
    middles = np.tile(np.stack([a.ravel(), b.ravel()], axis=1), (len(triples), 1))
    # Each cell has its middle (a, b), and the row of its triple of benches.
    row = np.repeat(np.arange(len(triples)), a.size)
    for cut in range(CUTS + 1):
        budget.afford(CELL_WORK * len(row))
        gap = shape_gaps(triples[row], middles)
        shortened = nominal[row] - _distances(chords[row], middles)
        sagged = sags_of(pulls[row], middles) - most_sag[row]
        change = np.concatenate([shortened, sagged], axis=1)
        needed, at_least = 0.5 * change.max(axis=1), 0.5 * (change - slack[row] * half).max(axis=1)
        most = min(most, float(needed[gap <= 0.0].min(initial=most)))
        undecided = (gap <= (corner[row, 0] + corner[row, 2]) * half) & (at_least < most)
        middles, row, at_least = middles[undecided], row[undecided], at_least[undecided]
        if cut == CUTS or 4 * len(row) > CELLS_MOST:
            break
        half *= 0.5
        middles = (middles[:, None] + half * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])).reshape(-1, 2)
        row = np.repeat(row, 4)
    return min(most, float(at_least.min(initial=most)))


def _distances(chords: Floats, joint_angles: Floats) -> Floats:
    """Distances (N, 3) d_02, d_13, d_03 of three chords (N, 3) with headings a and b (N, 2) [m]."""
    first, last = chords[:, [0, 2]].T * np.exp(1j * joint_angles.T)
    return np.abs(np.stack([first, last, first + last], axis=1) + chords[:, 1:2])


def sag_pulls(chords: Floats) -> Floats:
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


def sags_of(pulls: Floats, joint_angles: Floats) -> Floats:
    """The four sags (N, 4) of shapes (N, 2) [m]."""
    moved = np.exp(1j * joint_angles)[:, None] - 1.0
    sags: Floats = np.abs(pulls[..., 0] * moved[..., 0] - pulls[..., 1] * moved[..., 1])
    return sags


def shape_gaps(triples: Floats, headings: Floats) -> Floats:
    """Separation (N,) of the first and the last of three benches (N, 3, 3) with headings (N, 2) [m]."""
    chords = triples[..., 0]
    centres = 0.5 * (chords[:, 1:2] + chords[:, ::2] * np.exp(1j * headings)) * [1.0, -1.0]
    poses = np.stack([centres.real, centres.imag, headings], axis=-1)
    both = frames(poses, triples[:, ::2, 1:])
    return frames_separation(both[:, 0], both[:, 1]).separation


def touching_pose(triple: Floats, places: Floats) -> Floats | None:
    """Handles (4, 2) of three benches of which the first and the last overlap, with the smallest strays found [m].

    triple: (3, 3) chord, length and width; places: (4, 2) of the handles [m]; None if no shape overlaps by DEPTH
    """
    nominal = places @ [1.0, 1j]
    way = float(np.angle(nominal[1] - nominal[2]))
    angles = np.linspace(-math.pi, math.pi, SHAPES, endpoint=False)
    headings = _grid(angles, angles)
    known = np.abs(nominal[[0, 1, 0]] - nominal[[2, 3, 3]])
    needed = (known - _distances(np.broadcast_to(triple[:, 0], (len(headings), 3)), headings)).max(axis=1)
    order = np.flatnonzero(_overlapping(triple, headings))
    headings = headings[order[np.argsort(needed[order])[:SHAPES_TRIED]]]
    if not len(headings):
        return None
    spans = [angles[1] - angles[0], angles[1] - angles[0], math.pi]
    tried = np.concatenate([np.insert(headings, 2, angle, axis=1) for angle in angles])
    best, least = tried[0], math.inf
    for _ in range(ROUNDS):
        tried = tried[_overlapping(triple, tried[:, :2])]
        radii, centres = smallest_circles(nominal - _handles_of(triple[:, 0], tried, way))
        at = int(radii.argmin()) if len(radii) else -1
        if at >= 0 and radii[at] < least:
            best, least, centre = tried[at], float(radii[at]), centres[at]
        spans = [NARROWER * span for span in spans]
        tried = _grid(*(np.linspace(x - span, x + span, GRID) for x, span in zip(best, spans, strict=True)))
    moved = _handles_of(triple[:, 0], best[None], way)[0] + centre
    return np.stack([moved.real, moved.imag], axis=-1)


def _grid(*axes: Floats) -> Floats:
    return np.stack([grid.ravel() for grid in np.meshgrid(*axes)], axis=1)


def _overlapping(triple: Floats, headings: Floats) -> NDArray[np.bool_]:
    return shape_gaps(np.broadcast_to(triple, (len(headings), 3, 3)), headings) <= -DEPTH


def _handles_of(chords: Floats, shapes: Floats, way: float) -> NDArray[np.complex128]:
    """Handles (N, 4) of three benches, with the middle of the bench between at 0.

    shapes: (N, 3) headings of the first and of the last in the frame of the bench between, and the rotation of that
        bench from the direction `way` [rad]
    """
    a, b, rotation = shapes.T
    half = np.full(len(shapes), 0.5 * chords[1])
    handles = np.stack([half + chords[0] * np.exp(1j * a), half, -half, -half - chords[2] * np.exp(1j * b)], axis=1)
    handles_there: NDArray[np.complex128] = np.exp(1j * (way + rotation))[:, None] * handles
    return handles_there


def smallest_circles(points: NDArray[np.complex128]) -> tuple[Floats, NDArray[np.complex128]]:
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

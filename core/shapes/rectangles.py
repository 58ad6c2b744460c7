"""Rectangles: corners, separation, the pairs that may touch, and the paper's angle-sum rule.

The separation is exact and signed, with witness points and normal. Its derivation is in core/kernels/rectangles.py: the
separating axis theorem for rectangles that meet; for rectangles apart, the least distance from a corner of one to the
other. Pairs that may touch are all whose upright boxes come within the margin, so no touching pair is missed; a second
step keeps those within the margin by the exact separation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.display import WithArrays, display
from core.dragon import Dragon
from core.errors import InvalidValue, TooLarge
from core.kernels import Budget
from core.quantities import Quantity
from core.questions import question_about
from core.values import Floats

Pairs = NDArray[np.int64]

# Columns of a frame: its centre, its direction, and the same with x and y exchanged.
CENTRE, ALONG = slice(kernels.FRAME_X, kernels.FRAME_Y + 1), slice(kernels.FRAME_UX, kernels.FRAME_UY + 1)
ACROSS = slice(kernels.FRAME_UY, kernels.FRAME_UX - 1, -1)
# Sides of the centre on which the corners lie, in units of (half length, half width).
CORNER_SIDES = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])

# Largest number of overlapping pairs in one answer: 10 for each of 100,000 benches; the search takes 200 MB for them.
PAIRS_MAX = 1_000_000
# Largest number of pairs of upright boxes that meet: under a second of search. 100,000 benches on a spiral of pitch
# 0.55 m have 340,000 such pairs without neighbours.
CANDIDATES_MAX = 20_000_000
# The same for the other engines; FCL takes about 5 microseconds for each pair.
CROSS_CANDIDATES_MAX = 2_000_000
# Additional reach of the search, as a part of the coordinates and sizes [1]: each of its few operations rounds by
# 1.1e-16, and so does the separation that it must not miss.
ROUNDING = 4e-15

# Most pairs in one batch: 32 angles for each pair stay within 60 MB.
ANGLE_BATCH = 50_000

# Tolerance of a sum of four angles for a full turn [rad]: its rounding is below 1e-14. The sum at a point d outside the
# middle of an edge of length e is 8 d / e too small, so the tolerance is a distance of 4e-13 m for an edge of 3.41 m.
ANGLE_TOLERANCE = 1e-12

# Upper bound on the rounding of such a sum [rad].
SUM_ROUNDING = 1e-13

# Corners in the order of eq. 12: top right, bottom right, bottom left, top left, in units of (half length, half width),
# with the length to the right. Not CORNER_SIDES: the rule and the other engines share no corners.
PAPER_SIDES = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Separation(WithArrays):
    """Signed distance of two shapes, for one pair or for arrays of pairs (...).

    separation: signed distance; minus the penetration depth if they overlap [m]
    witness_a: point of a that realises the separation, x and y [m]
    witness_b: point of b that realises the separation, x and y [m]
    normal: unit vector from a to b

    Invariant: witness_b - witness_a == separation * normal, also in penetration.

    >>> from core import separation
    >>> apart = separation([0.0, 0.0, 0.0], [2.0, 1.0], [3.0, 0.0, 0.0], [2.0, 1.0])
    >>> float(apart.separation), apart.normal.tolist()
    (1.0, [1.0, 0.0])
    """

    separation: Floats
    witness_a: Floats
    witness_b: Floats
    normal: Floats

    def _line(self) -> str:
        if not self.separation.ndim:
            return display(self.separation.item(), "m")
        return display(self.separation, "m")


def frames_separation(a: Floats, b: Floats) -> Separation:
    """Signed separation of rectangles given as frames. a, b: (..., 6) as frames() returns, of equal shape."""
    shape = a.shape[:-1]
    out = np.empty((a.size // kernels.FRAME_COLUMNS, kernels.SEPARATION_COLUMNS))
    rows_a, rows_b = (np.require(frame, requirements=["C", "W"]).reshape(-1, kernels.FRAME_COLUMNS) for frame in (a, b))
    kernels.pair_separations(rows_a, rows_b, out)
    return Separation(
        separation=out[:, kernels.SEPARATION].reshape(shape),
        witness_a=out[:, kernels.WITNESS_AX : kernels.WITNESS_AY + 1].reshape(*shape, 2),
        witness_b=out[:, kernels.WITNESS_BX : kernels.WITNESS_BY + 1].reshape(*shape, 2),
        normal=out[:, kernels.NORMAL_X : kernels.NORMAL_Y + 1].reshape(*shape, 2),
    )


def frames(poses: Floats, sizes: Floats) -> Floats:
    """Rectangles in the form of the kernels: x, y, unit vector (x, y) along the length, half length, half width.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast
    returns: (..., 6), never a view
    """
    shape = np.broadcast_shapes(poses.shape[:-1], sizes.shape[:-1])
    out = np.empty((*shape, kernels.FRAME_COLUMNS))
    out[..., CENTRE] = poses[..., :2]
    out[..., kernels.FRAME_UX] = np.cos(poses[..., 2])
    out[..., kernels.FRAME_UY] = np.sin(poses[..., 2])
    out[..., kernels.FRAME_HALF_LENGTH :] = 0.5 * sizes
    return out


def edge_frames(edges: Floats) -> Floats:
    """Edges (E, 4), x, y, x, y [m], as rectangles without a width, in the form of the kernels (E, 6)."""
    a, b = edges[:, :2], edges[:, 2:]
    way = b - a
    lengths = np.hypot(*way.T)
    poses = np.column_stack([0.5 * (a + b), np.arctan2(way[:, 1], way[:, 0])])
    return frames(poses, np.column_stack([lengths, np.zeros(len(way))]))


def corners(poses: Floats, sizes: Floats) -> Floats:
    """Corners (..., 4, 2) [m]: front-left, front-right, rear-right, rear-left.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast

    >>> corners(np.array([1.0, 0.0, 0.0]), np.array([2.0, 1.0])).tolist()
    [[2.0, 0.5], [2.0, -0.5], [0.0, -0.5], [0.0, 0.5]]
    """
    frame = frames(np.asarray(poses, dtype=np.float64), np.asarray(sizes, dtype=np.float64))[..., None, :]
    along = CORNER_SIDES[:, :1] * frame[..., kernels.FRAME_HALF_LENGTH, None] * frame[..., ALONG]
    left = CORNER_SIDES[:, 1:] * frame[..., kernels.FRAME_HALF_WIDTH, None] * (frame[..., ACROSS] * [-1.0, 1.0])
    return frame[..., CENTRE] + along + left


def bench_poses(handles: Floats) -> Floats:
    """Pose of every bench from the handles at its two ends.

    handles: (..., n + 1, 2) [m], head first, world frame
    returns: (..., n, 3) x [m], y [m], heading [rad] in [-pi, pi], from rear to front handle
    source:  Yang et al., section 2.4.1, steps 1-2
    raises:  InvalidValue (handles)

    >>> bench_poses(np.array([[2.0, 0.0], [0.0, 0.0]]))
    array([[1., 0., 0.]])
    """
    handles = _checked_handles(handles)
    front, rear = handles[..., :-1, :], handles[..., 1:, :]
    middle = 0.5 * (front + rear)
    along = front - rear
    heading = np.arctan2(along[..., 1], along[..., 0])
    return np.concatenate([middle, heading[..., None]], axis=-1)


@question_about("dragon", Dragon)
def bench_outlines(dragon: Dragon, handles: Floats) -> Floats:
    """Corners of every bench: front-left, front-right, rear-right, rear-left.

    handles: (..., n + 1, 2) [m], head first
    returns: (..., n, 4, 2) [m]
    raises:  InvalidValue

    >>> bench_outlines(Dragon(1), np.array([[2.86, 0.0], [0.0, 0.0]])).round(3).tolist()
    [[[3.135, 0.15], [3.135, -0.15], [-0.275, -0.15], [-0.275, 0.15]]]
    """
    poses = bench_poses(handles)
    if poses.shape[-2] != dragon.benches:
        count = poses.shape[-2] + 1
        raise InvalidValue("handles", "must be {count}, one more than benches", got=count, count=dragon.benches + 1)
    return corners(poses, np.stack([dragon.lengths, dragon.widths], axis=-1))


def _checked_handles(handles: object) -> Floats:
    try:
        places = np.asarray(handles)
    except ValueError as error:
        raise InvalidValue("handles", "must be places of shape (..., n + 1, 2) in metres") from error
    if places.dtype.kind not in "iuf" or places.ndim < 2 or places.shape[-1] != 2:
        words = "must be places of shape (..., n + 1, 2) in metres"
        raise InvalidValue("handles", words, got=f"{places.dtype.name} of shape {places.shape}")
    if not np.isfinite(places).all():
        raise InvalidValue("handles", "must be finite")
    return places.astype(np.float64, copy=False)


def upright_boxes(frame: Floats, spare: Floats | float = 0.0) -> Floats:
    """Upright boxes (N, 4) around rectangles, x, y to x, y [m]; spare: added on every side. frame: rows of frames()"""
    half = np.abs(frame[:, ALONG]) * frame[:, kernels.FRAME_HALF_LENGTH, None]
    half += np.abs(frame[:, ACROSS]) * frame[:, kernels.FRAME_HALF_WIDTH, None]
    return np.hstack([frame[:, CENTRE] - (half + spare), frame[:, CENTRE] + (half + spare)])


# If two rectangles are within the margin, so are their upright boxes along x and along y; so these boxes meet when they
# are grown by half the margin on every side.
def meeting_pairs(frame: Floats, margin: float, chained: bool, *, exact: bool, budget: Budget | None = None) -> Pairs:
    """Pairs (P, 2), a < b, whose upright boxes meet; if exact, only those within the margin, rounded up.

    frame: rows of rectangles.frames()
    raises: TooLarge with the field benches for more than PAIRS_MAX pairs or CANDIDATES_MAX meeting boxes if exact, for
        more than CROSS_CANDIDATES_MAX otherwise
    """
    scale = np.abs(frame[:, CENTRE]).sum(axis=1) + frame[:, kernels.FRAME_HALF_LENGTH :].sum(axis=1) + margin
    boxes = upright_boxes(frame, 0.5 * margin + ROUNDING * scale[:, None])
    leaves = 1 << max(0, (-(-len(frame) // kernels.BOXES_PER_LEAF) - 1).bit_length())
    order = _tree_order(frame[:, CENTRE], leaves)
    frame, boxes, tree = frame[order], boxes[order], np.empty((2 * leaves, kernels.BOX_COLUMNS))
    kernels.grow_tree(boxes, tree)
    most = (PAIRS_MAX, CANDIDATES_MAX) if exact else (CROSS_CANDIDATES_MAX, CROSS_CANDIDATES_MAX)
    words = "within the margin" if exact else "close by", "close by"
    budget = budget or Budget()
    meetings = kernels.Meetings(frame, boxes, tree, order, budget)
    pairs = np.empty((2 * len(frame), 2), dtype=np.int64)
    while True:
        meetings.find(margin, exact, chained, *most, pairs)
        budget.afford(float(meetings.met))
        counts = (meetings.count, meetings.met)
        for count, limit, what in zip(counts, most, words, strict=True):
            if count > limit:
                rule, got = "must have at most {most} pairs {which}", f"more among {len(frame)}"
                raise TooLarge("benches", rule, got=got, most=limit, which=what)
        if meetings.count <= len(pairs):
            return pairs[: meetings.count]
        pairs = np.empty((meetings.count, 2), dtype=np.int64)


def _tree_order(centres: Floats, leaves: int) -> Pairs:
    """Order of the rows that puts near rows into groups of four: slices with equal counts along x, each sorted along y.

    Slices are made by rank, not by coordinate, so that one distant bench does not push all others into one slice.
    """
    per_slice = kernels.BOXES_PER_LEAF << (leaves.bit_length() // 2)
    slice_of = np.empty(len(centres), dtype=np.int64)
    slice_of[np.argsort(centres[:, 0], kind="stable")] = np.arange(len(centres)) // per_slice
    return np.lexsort((centres[:, 1], slice_of))


def pairs_within(poses: Floats, sizes: Floats, margin: float, chained: bool, budget: Budget) -> Iterator[Pairs]:
    """The pairs within the margin at each instant, by the separating axis. poses: (T, n, 3); sizes: (n, 2)"""
    reach = margin + ROUNDING * (margin + 2.0 * sizes.sum(axis=1).max(initial=0.0))
    for frame in frames(poses, sizes):
        pairs = meeting_pairs(frame, reach, chained, exact=True, budget=budget)
        yield pairs[frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]).separation <= margin]


def pair_within(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    """True at each instant at which a single pair is within the margin. poses: (T, 2, 3); sizes: (2, 2)"""
    pairs, gaps = frames(poses, sizes), np.empty(len(poses))
    first, second = (np.ascontiguousarray(pairs[:, bench]) for bench in (0, 1))
    kernels.pair_gaps(first, second, kernels.NO_LIMIT, gaps)
    return [gap <= margin for gap in gaps.tolist()]


# The paper's rule for overlapping benches: corners by its rotation matrix, collision by a sum of angles. It serves only
# as a cross-check: it sees only corners inside rectangles, and needs a tolerance.
def paper_corners(poses: Floats, sizes: Floats) -> Floats:
    """Corners (..., 4, 2) [m] by the paper's construction: centre, rotation matrix, half sizes.

    Eq. 12 as printed is not the product with the matrix of eq. 11: the sign of w/2 cos theta is wrong in the y of all
    four corners. Here it is right. The paper's theta points from the front handle to the rear one, and its arctan
    ignores the quadrant: so its heading may differ from ours by half a turn, which only renames corners.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]
    source: Yang et al., eqs. 8-12
    """
    return _turned(poses, sizes, last=1.0)


def literal_corners(poses: Floats, sizes: Floats) -> Floats:
    """Corners (..., 4, 2) [m] by eq. 12 as printed: a parallelogram whose shape changes with the heading.

    poses, sizes: as paper_corners()
    source: Yang et al., eq. 12: as if the last entry of the matrix of eq. 11 were -cos theta
    """
    return _turned(poses, sizes, last=-1.0)


def _turned(poses: Floats, sizes: Floats, last: float) -> Floats:
    half = 0.5 * PAPER_SIDES * sizes[..., None, :]
    heading, along, across = poses[..., 2, None], half[..., 0], half[..., 1]
    cos, sin = np.cos(heading), np.sin(heading)
    x = poses[..., 0, None] + (cos * along - sin * across)
    y = poses[..., 1, None] + (sin * along + last * cos * across)
    return np.stack([x, y], axis=-1)


def angle_sums(points: Floats, polygon: Floats) -> Floats:
    """Sum of the angles that the edges of a convex polygon subtend at each point [rad].

    It is a full turn inside and on an edge, corners included, and less outside.

    points: (..., P, 2) [m]; polygon: (..., C, 2) [m]; returns (..., P)
    source: Yang et al., eq. 13
    """
    to = polygon[..., None, :, :] - points[..., :, None, :]
    to_next = np.concatenate([to[..., 1:, :], to[..., :1, :]], axis=-2)
    cross = to[..., 0] * to_next[..., 1] - to[..., 1] * to_next[..., 0]
    sums = np.arctan2(np.abs(cross), (to * to_next).sum(axis=-1)).sum(axis=-1)
    return np.where((to == 0.0).all(axis=-1).any(axis=-1), 2.0 * np.pi, sums)


def angle_sum_overlap(corners_a: Floats, corners_b: Floats, *, tolerance: float = ANGLE_TOLERANCE) -> NDArray[np.bool_]:
    """True for each pair in which the rule sees a corner of one polygon in the other.

    It misses polygons that cross without a corner inside, and counts corners slightly outside as inside: see
    ANGLE_TOLERANCE.

    corners_a, corners_b: (..., C, 2) [m]; tolerance [rad]; returns (...)
    source: Yang et al., eqs. 13-16
    """
    return _holds_any(corners_a, corners_b, tolerance) | _holds_any(corners_b, corners_a, tolerance)


# Only corners in or near the upright box of the polygon are tested. The others cannot have a full sum: let a point lie
# d > 0 away from a convex polygon of diameter at most D (that of its box). Seen from the point, with the nearest point
# of the polygon straight ahead, the polygon lies beyond the perpendicular line at distance d and within D to either
# side, so it fills an angle of at most pi - 2 atan(d / D). From outside, each direction into the polygon meets two
# edges, so the sum is at most 2 pi - 4 atan(d / D), which is less than 2 pi - tolerance if d > D tan(tolerance / 4).
def _holds_any(points: Floats, polygon: Floats, tolerance: float) -> NDArray[np.bool_]:
    """True if any of the points is inside the polygon, by the rule. points: (..., P, 2), polygon: (..., C, 2) [m]"""
    # x and y first, then the points: numpy is slow along short last axes.
    place, edge = (np.ascontiguousarray(np.moveaxis(one, (-1, -2), (0, 1))) for one in (points, polygon))
    low, high = edge.min(axis=1), edge.max(axis=1)
    reach = np.hypot(*(high - low)) * np.tan(0.25 * min(tolerance + SUM_ROUNDING, 2.0 * np.pi))
    near = ((place >= (low - reach)[:, None]) & (place <= (high + reach)[:, None])).all(axis=0)
    point, *pair = np.nonzero(near)
    sums = angle_sums(points[*pair, point, None, :], polygon[tuple(pair)])[:, 0]
    near[near] = sums >= 2.0 * np.pi - tolerance
    return np.asarray(near.any(axis=0))


def angle_sum_pairs(poses: Floats, sizes: Floats, margin: float, chained: bool, budget: Budget) -> Iterator[Pairs]:
    """The pairs that overlap by the rule at each instant. poses: (T, n, 3); sizes: (n, 2)

    raises: InvalidValue for a margin that is not 0
    """
    if margin != 0.0:
        rule = "must be 0 m for the angle-sum rule, which knows only inside and outside"
        raise InvalidValue("margin", rule, got=Quantity(margin, "m"))
    for frame, corner in zip(frames(poses, sizes), paper_corners(poses, sizes), strict=True):
        pairs = meeting_pairs(frame, margin, chained, exact=False, budget=budget)
        batches = [pairs[k : k + ANGLE_BATCH] for k in range(0, len(pairs), ANGLE_BATCH)]
        seen = []
        for batch in batches:
            budget.look()
            seen.append(angle_sum_overlap(corner[batch[:, 0]], corner[batch[:, 1]]))
        yield pairs[np.concatenate(seen)] if seen else pairs


def angle_sum_judged(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    """True at each instant at which a single pair overlaps by the rule. poses: (T, 2, 3); sizes: (2, 2)"""
    corner = paper_corners(poses, sizes)
    sums = angle_sums(corner, corner[:, ::-1])  # each bench's corners in the other
    overlap: list[bool] = np.any(sums >= 2.0 * np.pi - ANGLE_TOLERANCE, axis=(1, 2)).tolist()
    return overlap

"""The paper's rule for overlapping benches: corners by its rotation matrix, collision by a sum of angles.

It serves only as a cross-check: the rule sees only corners inside rectangles, and needs a tolerance.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from core.budget import Budget
from core.errors import InvalidValue, said
from core.shapes.broad_phase import Pairs, meeting_pairs
from core.shapes.rectangles import frames
from core.values import Floats

# Most pairs in one batch: 32 angles for each pair stay within 60 MB.
ANGLE_BATCH = 50_000

# Tolerance of a sum of four angles for a full turn [rad]: its rounding is below 1e-14. The sum at a point d outside the
# middle of an edge of length e is 8 d / e too small, so the tolerance is a distance of 4e-13 m for an edge of 3.41 m.
ANGLE_TOLERANCE = 1e-12

# Upper bound on the rounding of such a sum [rad].
SUM_ROUNDING = 1e-13

# Corners in the order of eq. 12: top right, bottom right, bottom left, top left, in units of (half length, half width),
# with the length to the right.
PAPER_SIDES = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])


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
        raise InvalidValue(
            "margin",
            f"margin must be 0 m for the angle-sum rule, which knows only inside and outside, got {said(margin)} m",
        )
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

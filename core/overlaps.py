"""Which benches overlap at one instant, four ways, and whether the four agree.

The only file that knows FCL and shapely, and it imports them only when they are asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core import kernels
from core.angle_sum import ANGLE_TOLERANCE, angle_sum_overlap, angle_sums, paper_corners
from core.broad_phase import ROUNDING, Pairs, checked_benches, meeting_pairs
from core.dragon import Floats
from core.errors import InvalidValue
from core.rectangles import POSE, Separation, checked_array, checked_columns, corners, frames, frames_separation

# Pairs that the angle-sum rule judges at once, to keep its 32 angles a pair within 60 MB.
ANGLE_BATCH = 50_000


class Engine(StrEnum):
    """Four independent ways to find overlapping rectangles."""

    SEPARATING_AXIS = "separating_axis"
    FCL = "fcl"
    SHAPELY = "shapely"
    ANGLE_SUM = "angle_sum"


@dataclass(frozen=True, slots=True)
class Overlaps:
    """pairs (P, 2), a < b, sorted; contact: exact separation, witnesses and normal of each pair (P, ...)."""

    pairs: Pairs
    contact: Separation


@dataclass(frozen=True, slots=True)
class CrossCheck:
    """pairs: what each engine found; agree: all the same; only: pairs by engine that not all engines found;
    missing: pairs by engine that some other engine found and this one did not.
    left_out: engines that cannot judge this margin; they stand in none of the others.
    """

    agree: bool
    pairs: dict[Engine, Pairs]
    only: dict[Engine, Pairs]
    missing: dict[Engine, Pairs]
    left_out: tuple[Engine, ...]


@dataclass(frozen=True, slots=True)
class Verdict:
    """Does an engine find the pair overlapping just before and just after first contact?"""

    before: bool
    after: bool


def overlaps(
    poses: ArrayLike,
    lengths: ArrayLike,
    widths: ArrayLike,
    *,
    engine: Engine = Engine.SEPARATING_AXIS,
    margin: float = 0.0,
    chained: bool = True,
) -> Overlaps:
    """All pairs with separation <= margin (neighbours in the chain left out when chained).

    The engine finds the pairs; their separation is always the exact one of rectangles.py. The angle-sum rule
    misses rectangles that cross without a corner inside, and knows no margin; the other three miss none.

    poses: (n, 3) x [m], y [m], heading [rad]; lengths, widths: (n,) [m]
    raises: InvalidValue with the field benches.K.x, y, heading, length or width, margin or engine; TooLarge with the
        field benches when so many overlap that the pairs are beyond PAIRS_MAX or the work beyond CANDIDATES_MAX

    >>> overlaps([[0, 0, 0], [3, 0, 0], [1, 0, 1.57]], [2.2] * 3, [0.3] * 3).pairs
    array([[0, 2]])
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    if not isinstance(engine, str) or engine not in list(Engine):
        words = ", ".join(Engine)
        raise InvalidValue("engine", f"engine must be one of {words}, got {engine!r:.60}")
    pairs = _find(engine, pose, size, margin, chained)
    frame = frames(pose, size)
    return Overlaps(pairs, frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]))


def cross_check(
    poses: ArrayLike, lengths: ArrayLike, widths: ArrayLike, *, margin: float = 0.0, chained: bool = True
) -> CrossCheck:
    """The four engines side by side at one instant (three when the margin is not 0).

    poses, lengths, widths, raises: as overlaps(), with CROSS_CANDIDATES_MAX
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    found = {engine: _find(engine, pose, size, margin, chained) for engine in _able(margin)}
    codes = {engine: pairs[:, 0] * len(pose) + pairs[:, 1] for engine, pairs in found.items()}
    some = np.unique(np.concatenate(list(codes.values())))
    every = some[np.all([np.isin(some, code) for code in codes.values()], axis=0)]

    def decoded(code: Pairs) -> Pairs:
        return np.stack(np.divmod(code, max(len(pose), 1)), axis=-1)

    return CrossCheck(
        agree=some.size == every.size,
        pairs=found,
        only={engine: decoded(np.setdiff1d(code, every)) for engine, code in codes.items()},
        missing={engine: decoded(np.setdiff1d(some, code)) for engine, code in codes.items()},
        left_out=tuple(engine for engine in Engine if engine not in found),
    )


def verdicts(
    before: ArrayLike, after: ArrayLike, lengths: ArrayLike, widths: ArrayLike, *, margin: float = 0.0
) -> dict[Engine, Verdict]:
    """Each engine's word on one pair just before and just after contact (no angle sum if the margin is not 0).

    before, after: (2, 3) poses of the two benches; lengths, widths: (2,) [m]
    raises: InvalidValue as overlaps(), and with the field benches when they are not two

    >>> verdicts([[0, 0, 0], [0, 0.4, 0]], [[0, 0, 0], [0, 0.2, 0]], [2.2] * 2, [0.3] * 2)[Engine.FCL]
    Verdict(before=False, after=True)
    """
    pose_before, size, margin = checked_benches(before, lengths, widths, margin)
    pose_after = checked_array("benches", after, "(2, 3): x, y, heading", 3)
    for pose in (pose_before, pose_after):
        if pose.shape != (2, 3):
            raise InvalidValue("benches", f"benches must have shape (2, 3): x, y, heading, got {pose.shape}")
    checked_columns("benches", pose_after, POSE)
    poses = np.array([pose_before, pose_after])
    return {engine: Verdict(*JUDGES[engine](poses, size, margin)) for engine in _able(margin)}


def _able(margin: float) -> list[Engine]:
    return [engine for engine in Engine if margin == 0.0 or engine is not Engine.ANGLE_SUM]


def _find(engine: Engine, poses: Floats, sizes: Floats, margin: float, chained: bool) -> Pairs:
    pairs = FINDERS[engine](poses, sizes, margin, chained)
    if chained:
        pairs = pairs[pairs[:, 1] - pairs[:, 0] != 1]
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


# -- separating axis ------------------------------------------------------------------------------------------


def _separating_axis(poses: Floats, sizes: Floats, margin: float, chained: bool) -> Pairs:
    frame = frames(poses, sizes)
    reach = margin + ROUNDING * (margin + 2.0 * sizes.sum(axis=1).max(initial=0.0))
    pairs = meeting_pairs(frame, reach, chained, exact=True)
    return pairs[frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]).separation <= margin]


# -- FCL and shapely ------------------------------------------------------------------------------------------


# FCL's yes/no is exact for two boxes and for a sphere and a box; its distance is not. The points within the margin
# of a rectangle are the rectangle made longer by the margin at both ends, the same made wider, and four discs
# around the corners, so b comes within the margin of a just where its box meets one of two boxes and four spheres.
# The manager runs over boxes grown by half the margin on every side, which contain what is within half of it.
def _fcl(poses: Floats, sizes: Floats, margin: float, chained: bool) -> Pairs:
    import fcl

    meeting_pairs(frames(poses, sizes), margin, chained, exact=False)  # refuses hopeless work
    grown = [_fcl_box(pose, *(size + margin)) for pose, size in zip(poses, sizes, strict=True)]
    number = {id(box): k for k, (box, _) in enumerate(grown)}
    manager = fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([body for _, body in grown])
    manager.setup()
    contacts: list[fcl.Contact] = []

    # An exception in here would vanish, and the bodies handed in are fresh wrappers: only the geometries of a
    # contact can be told apart.
    def keep(first: object, second: object, _: object) -> bool:
        result = fcl.CollisionResult()
        if fcl.collide(first, second, fcl.CollisionRequest(), result):
            contacts.append(result.contacts[0])
        return False

    manager.collide(None, keep)
    pairs = np.array([(number[id(c.o1)], number[id(c.o2)]) for c in contacts], dtype=np.int64).reshape(-1, 2)
    pairs.sort(axis=1)
    if margin > 0.0:
        near = [_fcl_within(poses[pair], sizes[pair], margin) for pair in pairs]
        pairs = pairs[np.array(near, dtype=bool)]
    return pairs


def _fcl_body(shape: object, pose: Floats) -> object:
    import fcl

    x, y, heading = pose.tolist()
    cos, sin = math.cos(heading), math.sin(heading)
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return fcl.CollisionObject(shape, fcl.Transform(turn, np.array([x, y, 0.0])))


# Of two rectangles, neither penetrates deeper than half of (own width + other's length + other's width), so not
# deeper than half the sum of the two heights below.
def _fcl_box(pose: Floats, length: float, width: float) -> tuple[object, object]:
    import fcl

    box = fcl.Box(length, width, 0.5 * length + width)
    return box, _fcl_body(box, pose)


def _fcl_within(poses: Floats, sizes: Floats, margin: float) -> bool:
    import fcl

    (length, width), other = sizes[0].tolist(), _fcl_box(poses[1], *sizes[1].tolist())[1]
    bodies = [_fcl_box(poses[0], length + 2.0 * margin, width)[1]]
    if margin > 0.0:
        bodies.append(_fcl_box(poses[0], length, width + 2.0 * margin)[1])
        bodies += [_fcl_body(fcl.Sphere(margin), np.array([x, y, 0.0])) for x, y in corners(poses[0], sizes[0])]
    return any(fcl.collide(body, other, fcl.CollisionRequest(), fcl.CollisionResult()) for body in bodies)


def _shapely(poses: Floats, sizes: Floats, margin: float, chained: bool) -> Pairs:
    import shapely

    meeting_pairs(frames(poses, sizes), margin, chained, exact=False)  # refuses hopeless work
    polygons = shapely.polygons(corners(poses, sizes))
    tree = shapely.STRtree(polygons)
    if margin > 0.0:
        pairs = tree.query(polygons, predicate="dwithin", distance=margin).T
    else:
        pairs = tree.query(polygons, predicate="intersects").T
    return np.asarray(pairs[pairs[:, 0] < pairs[:, 1]], dtype=np.int64)


# -- shapely: polygons at rest --------------------------------------------------------------------------------


def polygon_fault(rings: Sequence[ArrayLike]) -> tuple[str, float, float] | None:
    """What is wrong with a polygon and where, (reason, x [m], y [m]); None if it is valid.

    rings: closed, (points, 2) [m]: the outer one, then the holes
    """
    import shapely

    reason = str(shapely.is_valid_reason(shapely.Polygon(rings[0], rings[1:])))
    if "[" not in reason:
        return None
    words, _, place = reason.removesuffix("]").partition("[")
    x, y = (float(number) for number in place.split())
    return words.lower(), x, y


def inside(rings: Sequence[ArrayLike], points: Floats) -> NDArray[np.bool_]:
    """Which points lie inside a valid polygon, not on its boundary. rings: as in polygon_fault(); points: (P, 2) [m]"""
    import shapely

    found: NDArray[np.bool_] = shapely.contains_xy(shapely.Polygon(rings[0], rings[1:]), points)
    return found


# -- the paper's angle-sum rule -------------------------------------------------------------------------------


def _angle_sum(poses: Floats, sizes: Floats, margin: float, chained: bool) -> Pairs:
    if margin != 0.0:
        raise InvalidValue(
            "margin",
            f"margin must be 0 m for the angle-sum rule, which knows only inside and outside, got {margin} m",
        )
    pairs = meeting_pairs(frames(poses, sizes), margin, chained, exact=False)
    corner = paper_corners(poses, sizes)
    batches = [pairs[k : k + ANGLE_BATCH] for k in range(0, len(pairs), ANGLE_BATCH)]
    seen = [angle_sum_overlap(corner[batch[:, 0]], corner[batch[:, 1]]) for batch in batches]
    return pairs[np.concatenate(seen)] if seen else pairs


FINDERS: dict[Engine, Callable[[Floats, Floats, float, bool], Pairs]] = {
    Engine.SEPARATING_AXIS: _separating_axis,
    Engine.FCL: _fcl,
    Engine.SHAPELY: _shapely,
    Engine.ANGLE_SUM: _angle_sum,
}


# -- one pair at several instants -----------------------------------------------------------------------------


# One pair needs no search. poses: (T, 2, 3); sizes: (2, 2); each judge says for each of the T instants whether the pair
# is within the margin, by the means of its engine above.
def _judged_by_separating_axis(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    return [kernels.pair_gap(*a, *b) <= margin for a, b in frames(poses, sizes).tolist()]


def _judged_by_fcl(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    return [_fcl_within(pair, sizes, margin) for pair in poses]


def _judged_by_shapely(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    import shapely

    a, b = shapely.polygons(corners(poses, sizes)).T
    within: list[bool] = (shapely.dwithin(a, b, margin) if margin > 0.0 else shapely.intersects(a, b)).tolist()
    return within


def _judged_by_angle_sum(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    corner = paper_corners(poses, sizes)
    sums = angle_sums(corner, corner[:, ::-1])  # each bench's corners in the other
    overlap: list[bool] = np.any(sums >= 2.0 * np.pi - ANGLE_TOLERANCE, axis=(1, 2)).tolist()
    return overlap


JUDGES: dict[Engine, Callable[[Floats, Floats, float], list[bool]]] = {
    Engine.SEPARATING_AXIS: _judged_by_separating_axis,
    Engine.FCL: _judged_by_fcl,
    Engine.SHAPELY: _judged_by_shapely,
    Engine.ANGLE_SUM: _judged_by_angle_sum,
}

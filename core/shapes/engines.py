"""Four independent ways to find overlapping benches; shapely's tests of polygons at rest, and their union.

Only this file uses FCL and shapely; it imports them on demand.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from enum import StrEnum
from itertools import chain
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.kernels import Budget
from core.shapes import rectangles
from core.shapes.rectangles import CROSS_CANDIDATES_MAX, ROUNDING, Pairs, corners, frames, meeting_pairs
from core.values import Floats

# Number of dragons whose FCL objects are kept, and their largest number of benches: 8 MB in all.
KEPT_DRAGONS = 8
KEPT_BENCHES = 2_000
# Number of chords for a quarter of a circle when polygons grow. GEOS rounds the number of chords of an arc, so a chord
# may span half as much more, and it ignores dents of up to a hundredth of the growth. So: the growth that GEOS gets,
# and the largest distance that a point can move, both as a multiple of the required growth [1].
ARC_CHORDS = 8
ARC_GROWTH = 1.0 / math.cos(1.5 * 0.25 * math.pi / ARC_CHORDS)
GROWTH_MOST = 1.01 * ARC_GROWTH
# Step of the grid for the points of a union, by which a side can move at most [m]; number of polygons that are united
# between two checks of the budget, and of polygons of a strip that are one ring [1].
GRID, UNITED, PIECE = 1e-5, 256, 64
# How near the radius of a circle is to that of the largest one in a polygon, as a share of the polygon's extent [1].
WIDEST = 0.01
# Half the width of a street, at most, in radii of the largest circle in the square [1].
STREET_MOST = 0.4

# Rings of each polygon, (points, 2) [m], closed: the outer one counter-clockwise, then the holes, clockwise.
Polygons = tuple[tuple[Floats, ...], ...]


class Engine(StrEnum):
    """Four independent ways to find overlapping rectangles.

    >>> [engine.value for engine in Engine]
    ['separating_axis', 'fcl', 'shapely', 'angle_sum']
    """

    SEPARATING_AXIS = "separating_axis"
    FCL = "fcl"
    SHAPELY = "shapely"
    ANGLE_SUM = "angle_sum"


def able(margin: float) -> list[Engine]:
    """The engines that can judge a margin [m]: the angle-sum rule distinguishes only inside and outside."""
    return [engine for engine in Engine if margin == 0.0 or engine is not Engine.ANGLE_SUM]


def engine_pairs(
    engine: Engine, poses: Floats, sizes: Floats, margin: float, *, chained: bool, budget: Budget | None = None
) -> list[Pairs]:
    """The pairs (P, 2) within the margin that an engine finds at each instant: a < b, sorted.

    poses: (T, n, 3); sizes: (n, 2); margin: [m]; chained: leave out neighbours
    raises: InvalidValue for the angle-sum rule with a margin; TooLarge as meeting_pairs()
    """
    pairs_at, budget = [], budget or Budget()
    for pairs in FINDERS[engine](poses, sizes, margin, chained, budget):
        budget.afford()
        kept = pairs[pairs[:, 1] - pairs[:, 0] != 1] if chained else pairs
        pairs_at.append(kept[np.lexsort((kept[:, 1], kept[:, 0]))])
    return pairs_at


def _refuse_hopeless(frame: Floats, margin: float, chained: bool, budget: Budget) -> None:
    """Refuse too many meeting boxes for FCL and shapely, which search for pairs themselves. raises: TooLarge"""
    if len(frame) ** 2 > 2 * CROSS_CANDIDATES_MAX:
        meeting_pairs(frame, margin, chained, exact=False, budget=budget)


# FCL's yes/no is exact for two boxes and for a sphere and a box; its distance is not. The points within the margin
# of a rectangle are the rectangle made longer by the margin at both ends, the same made wider, and four discs
# around the corners, so b is within the margin of a exactly if its box meets one of two boxes or four spheres. The
# manager searches boxes grown by half the margin on every side; they contain all points within half the margin.
def _fcl(poses: Floats, sizes: Floats, margin: float, chained: bool, budget: Budget) -> Iterator[Pairs]:
    frame = frames(poses, sizes)
    with _KEPT.boxes(sizes + margin) as boxes:
        for rows, pose in zip(frame, poses, strict=True):
            _refuse_hopeless(rows, margin, chained, budget)
            pairs = boxes.meeting(pose, budget)
            if margin > 0.0:
                if chained:  # All neighbours meet, and the test of a pair needs six more bodies.
                    pairs = pairs[pairs[:, 1] - pairs[:, 0] != 1]
                near = [_fcl_within(pose[pair], sizes[pair], margin, budget) for pair in pairs]
                pairs = pairs[np.array(near, dtype=bool)]
            yield pairs


class _FclBoxes:
    """FCL's boxes of benches, made once and moved from pose to pose, by one thread at a time.

    It takes longer to make them than to move them, and each leaks 44 bytes, because python-fcl 0.7 frees a body without
    its destructor. Every pose gets a new manager with its own tree: building one for 223 benches takes 0.05 ms, while
    the tree of another pose slows the search by up to 0.2 ms of 2.0 (measured 2026-11-21).
    """

    def __init__(self, sizes: Floats) -> None:
        import fcl

        self.boxes = [_fcl_box(length, width) for length, width in sizes.tolist()]
        self.bodies = [fcl.CollisionObject(box, fcl.Transform()) for box in self.boxes]

    # FCL's tree keeps the upright cube around the sphere around each box: of 223 benches 1,925 pairs of cubes meet, but
    # only 661 pairs of upright boxes. An exception in the callback would be lost. The callback gets new wrappers of
    # bodies, so only the geometries of a contact identify the benches. fcl.collide() makes its own result each time and
    # only appends the contact to ours, so one result can collect all contacts.
    def meeting(self, poses: Floats, budget: Budget) -> Pairs:
        """Pairs (P, 2), a < b, that overlap, neighbours included. poses: (n, 3) x [m], y [m], heading [rad]"""
        import fcl

        rotations, places = np.zeros((len(poses), 4)), np.zeros((len(poses), 3))
        rotations[:, 0], rotations[:, 3] = np.cos(0.5 * poses[:, 2]), np.sin(0.5 * poses[:, 2])
        places[:, :2] = poses[:, :2]
        for body, rotation, place in zip(self.bodies, rotations, places, strict=True):
            body.setQuatRotation(rotation)
            body.setTranslation(place)
        manager = fcl.DynamicAABBTreeCollisionManager()
        manager.registerObjects(self.bodies)
        manager.setup()
        request, result, collide = fcl.CollisionRequest(), fcl.CollisionResult(), fcl.collide

        def keep(first: object, second: object, _: object) -> bool:
            collide(first, second, request, result)
            return budget.stopped

        manager.collide(None, keep)
        budget.look()
        number = {id(box): k for k, box in enumerate(self.boxes)}
        pairs = np.array([(number[id(c.o1)], number[id(c.o2)]) for c in result.contacts], dtype=np.int64)
        return np.sort(pairs.reshape(-1, 2), axis=1)


class _Kept:
    """Boxes of the most recent dragons. Each thread has its own boxes: python-fcl never releases Python's lock,
    but Python may pass the lock on during a callback, and a body can only be in one place."""

    def __init__(self) -> None:
        self.lock = Lock()
        self.resting: deque[tuple[bytes, _FclBoxes]] = deque(maxlen=KEPT_DRAGONS)

    @contextmanager
    def boxes(self, sizes: Floats) -> Iterator[_FclBoxes]:
        """Boxes of these sizes (n, 2) length and width [m], lent for a with-statement."""
        key = sizes.tobytes()
        boxes = self._taken(key) or _FclBoxes(sizes)
        yield boxes
        if len(sizes) <= KEPT_BENCHES:  # but not after an exception
            with self.lock:
                self.resting.append((key, boxes))

    def _taken(self, key: bytes) -> _FclBoxes | None:
        with self.lock:
            for entry in self.resting:
                if entry[0] == key:
                    self.resting.remove(entry)
                    return entry[1]
        return None


_KEPT = _Kept()


# FCL separates two boxes by the separating axis theorem [boxBox2 of its narrow phase]. All boxes lie flat on one plane,
# so no axis separates them by their heights, and every height gives the same answer. A low one keeps the sphere around
# the box small.
def _fcl_box(length: float, width: float) -> object:
    import fcl

    return fcl.Box(length, width, width)


def _fcl_body(shape: object, x: float, y: float, heading: float) -> object:
    import fcl

    rotation = np.array([np.cos(0.5 * heading), 0.0, 0.0, np.sin(0.5 * heading)])
    return fcl.CollisionObject(shape, fcl.Transform(rotation, np.array([x, y, 0.0])))


def _fcl_within(poses: Floats, sizes: Floats, margin: float, budget: Budget) -> bool:
    import fcl

    budget.look()
    (length, width), other = sizes[0].tolist(), _fcl_body(_fcl_box(*sizes[1].tolist()), *poses[1].tolist())
    grown = [(length + 2.0 * margin, width), (length, width + 2.0 * margin)] if margin > 0.0 else [(length, width)]
    round_corners = corners(poses[0], sizes[0]).tolist() if margin > 0.0 else []
    bodies = chain(
        (_fcl_body(_fcl_box(*size), *poses[0].tolist()) for size in grown),
        (_fcl_body(fcl.Sphere(margin), x, y, 0.0) for x, y in round_corners),
    )
    return any(fcl.collide(body, other, fcl.CollisionRequest(), fcl.CollisionResult()) for body in bodies)


# Prepared geometries crash the process when threads share them; these live and die in this call.
def _shapely(poses: Floats, sizes: Floats, margin: float, chained: bool, budget: Budget) -> Iterator[Pairs]:
    import shapely

    frame = frames(poses, sizes)
    for rows, polygons in zip(frame, shapely.polygons(corners(poses, sizes)), strict=True):
        _refuse_hopeless(rows, margin, chained, budget)
        grown = polygons
        if margin > 0.0:
            reach = margin + ROUNDING * (margin + np.abs(rows).max(initial=0.0))
            grown = shapely.box(*(shapely.bounds(polygons) + reach * np.array([-1.0, -1.0, 1.0, 1.0])).T)
        first, second = shapely.STRtree(polygons).query(grown)
        apart = second > first + chained  # each pair once, without neighbours
        first, second = first[apart], second[apart]
        shapely.prepare(polygons)
        a, b = polygons[first], polygons[second]
        meet = shapely.dwithin(a, b, margin) if margin > 0.0 else shapely.intersects(a, b)
        yield np.stack([first[meet], second[meet]], axis=-1).astype(np.int64)


def unions_meet(a: Floats, b: Floats, margin: float) -> NDArray[np.bool_]:
    """True for each of n unions a and b of polygons, (n, parts, corners, 2), that shapely finds within a margin [m]."""
    import shapely

    meet = shapely.dwithin(shapely.polygons(a)[:, :, None], shapely.polygons(b)[:, None, :], margin)
    any_meet: NDArray[np.bool_] = np.any(meet, axis=(1, 2))
    return any_meet


def polygon_fault(rings: Sequence[ArrayLike]) -> tuple[str, float, float] | None:
    """The fault of a polygon and its place, (reason, x [m], y [m]); None if the polygon is valid.

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
    """True for points inside a valid polygon, not on its boundary. rings: as in polygon_fault(); points: (P, 2) [m]"""
    import shapely

    within: NDArray[np.bool_] = shapely.contains_xy(shapely.Polygon(rings[0], rings[1:]), points)
    return within


def widest_place(
    rings: Sequence[ArrayLike],
    others: Sequence[Sequence[ArrayLike]] = (),
    view: tuple[float, float, float, float] | None = None,
) -> tuple[float, float, float]:
    """Middle x, y and radius of the largest circle inside a valid polygon and outside others [m].

    No circle is wider by over twice WIDEST. Of circles that are as wide, it is the one around the centroid, if that is.

    rings: as in polygon_fault(); others: the rings of each; view: left, low, right and top of a box that holds
        the circle [m]; if others and view leave no ground, they do not count
    """
    import shapely

    whole = shapely.Polygon(rings[0], rings[1:])
    seen = whole if view is None else shapely.intersection(whole, shapely.box(*view))
    free = shapely.difference(seen, _united(others))
    ground = whole if free.area == 0.0 else free
    left, low, right, high = ground.bounds
    tolerance = WIDEST * max(right - left, high - low)
    radius, centroid = shapely.maximum_inscribed_circle(ground, tolerance=tolerance), shapely.centroid(ground)
    around = float(shapely.distance(centroid, shapely.boundary(ground)))
    if shapely.contains(ground, centroid) and around >= radius.length - tolerance:
        return float(centroid.x), float(centroid.y), around
    (x, y), _ = shapely.get_coordinates(radius).tolist()
    return x, y, float(radius.length)


def without_streets(rings: Sequence[ArrayLike]) -> tuple[Floats, Floats]:
    """Corners (2,) [m] of the box around a valid polygon without its streets: what is narrower than STREET_MOST times
    its widest circle. rings: as in polygon_fault()"""
    import shapely

    narrow = STREET_MOST * widest_place(rings)[2]
    inner = shapely.buffer(shapely.Polygon(rings[0], rings[1:]), -narrow, join_style="mitre")
    left, low, right, high = shapely.buffer(inner, narrow, join_style="mitre").bounds
    return np.array([left, low]), np.array([right, high])


def united(core: Sequence[Floats], rest: Sequence[Floats], grown: float, left_out: float, budget: Budget) -> Polygons:
    """The grown union of strips of convex polygons: it holds every point within `grown` of the union, and no point
    further away than GROWTH_MOST times that, both to within GRID [m].

    core, rest: strips, arrays (N, corners, 2) [m]: triangles (x, a, b) or quadrilaterals (a, c, d, b), where b and d
        are a and c of the next one, and the line (x, b) holds the next x; a piece of the rest counts only if it leaves
        the core by over `left_out`
    """
    import shapely

    ground, others = _union(_pieces(core, budget), budget), _pieces(rest, budget)
    roomy = shapely.buffer(ground, left_out / GROWTH_MOST)
    shapely.prepare(roomy)
    ground = _union(np.array([ground, *others[~shapely.covers(roomy, others)]]), budget)
    return _rings(shapely.set_precision(shapely.buffer(ground, ARC_GROWTH * grown, quad_segs=ARC_CHORDS), GRID))


# Neighbours in a strip pass their common edge in opposite directions, so the winding numbers of all of them add up to
# that of the ring around the strip: besides the common edge, two triangles leave only a way on one line and back. A
# convex polygon has the winding number 1 inside and 0 outside, or -1 if it runs the other way. So if all run the same
# way, and the ring does not meet itself, its inside is their union.
def _pieces(strips: Sequence[Floats], budget: Budget) -> NDArray[np.object_]:
    """Polygons with the same union as the strips: rings around PIECE polygons where these prove to be one."""
    import shapely

    pieces = []
    for strip in strips:
        first, last, back = (1, [2], 0) if strip.shape[1] == 3 else (0, [3, 2], 1)
        edges = np.roll(strip, -1, axis=1) - strip
        onwards = np.roll(edges, -1, axis=1)
        turns = edges[..., 0] * onwards[..., 1] - edges[..., 1] * onwards[..., 0]
        left, right = turns.min(axis=1) >= 0.0, turns.max(axis=1) <= 0.0
        for part in (slice(k, k + PIECE) for k in range(0, len(strip), PIECE)):
            budget.look()
            cells = strip[part]
            ring = shapely.polygons(np.concatenate([cells[:, first], cells[-1, last], cells[::-1, back]]))
            whole = (left[part].all() or right[part].all()) and shapely.is_valid(ring)
            pieces.append(np.array([ring]) if whole else shapely.convex_hull(shapely.polygons(cells)))
    return np.concatenate(pieces)


def _union(parts: NDArray[np.object_], budget: Budget) -> object:
    import shapely

    while parts.size > 1:
        merged = []
        for first in range(0, parts.size, UNITED):
            budget.look()
            merged.append(shapely.union_all(parts[first : first + UNITED]))
        parts = np.array(merged)
    return parts[0]


def _united(polygons: Iterable[Sequence[Any]]) -> Any:
    """The ground of polygons, each by its rings, in shapely's own form."""
    import shapely

    return shapely.union_all([shapely.Polygon(rings[0], rings[1:]) for rings in polygons])


def merged(grounds: Iterable[Polygons]) -> Polygons:
    """Polygons that hold the ground of several together; those of a single one as they are."""
    first, *others = grounds
    if not others:
        return first
    return _rings(_united(one for some in (first, *others) for one in some))


def widened(polygons: Polygons, by: float) -> Polygons:
    """Polygons that hold all points within `by` of the given ones, and none further than GROWTH_MOST times that [m]."""
    import shapely

    ground = _united(polygons)
    return _rings(shapely.buffer(ground, ARC_GROWTH * by, quad_segs=ARC_CHORDS))


def holds_all(polygons: Polygons, others: Polygons) -> bool:
    """True if polygons hold all of others."""
    import shapely

    return bool(shapely.covers(_united(polygons), _united(others)))


def thickened(line: Floats, radius: float) -> Polygons:
    """Polygons that hold every point within `radius` of a line through points (P, 2), and none further than GROWTH_MOST
    times that [m]."""
    import shapely

    return _rings(shapely.buffer(shapely.LineString(line), ARC_GROWTH * radius, quad_segs=ARC_CHORDS))


def lane_rings(middle: Floats, width: float) -> tuple[Floats, ...]:
    """Rings of a lane of a width around a line through points (P, 2), square at its ends [m]."""
    import shapely

    lane = shapely.buffer(shapely.LineString(middle), 0.5 * width, cap_style="flat", join_style="mitre")
    return _rings(lane)[0]


def strip_of(ring: Floats, share: float) -> tuple[Floats, float] | None:
    """Ends (2, 2) of the middle line, and width, of the narrowest rectangle around a ring (N, 2) [m]; None if the ring
    encloses less than a share of it."""
    import shapely

    area = shapely.Polygon(ring) if len(ring) > 3 else None
    around = None if area is None else shapely.oriented_envelope(area)
    if area is None or around is None or not around.area > 0.0 or area.area < share * around.area:
        return None
    corners = shapely.get_coordinates(around)[:4]
    sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    corners = corners if sides[0] <= sides[1] else np.roll(corners, -1, axis=0)
    ends: Floats = np.stack([0.5 * (corners[0] + corners[1]), 0.5 * (corners[2] + corners[3])])
    return ends, float(sides[:2].min())


def free_width(polygons: Polygons, middle: Floats, width: float) -> float:
    """Width of a lane around a line through points (P, 2) that polygons leave free all along [m]: of the widest strip
    around the line or along one of the lane's sides; 0 where they reach from side to side."""
    import shapely

    ground = _united(polygons)
    line, around, along = shapely.LineString(middle), 0.0, [0.0]
    lane = shapely.buffer(line, 0.5 * width, cap_style="flat", join_style="mitre")
    within = shapely.intersection(ground, lane)
    if within.is_empty:
        return width
    for side in (0.5 * width, -0.5 * width):
        beside = shapely.intersection(ground, shapely.buffer(line, side, single_sided=True, join_style="mitre"))
        around += 0.5 * width if beside.is_empty else float(shapely.distance(line, beside))
        along.append(float(shapely.distance(shapely.offset_curve(line, side, join_style="mitre"), within)))
    return max(*along, 0.0 if shapely.intersects(line, ground) else around)


def area_of(polygons: Polygons) -> float:
    """Area of polygons [m2]."""
    edges = ((ring[:-1], ring[1:]) for rings in polygons for ring in rings)
    return sum(0.5 * float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()) for a, b in edges)


def _rings(ground: object) -> Polygons:
    import shapely

    polygons = [shapely.geometry.polygon.orient(polygon) for polygon in shapely.get_parts(ground)]
    return tuple(tuple(map(shapely.get_coordinates, (some.exterior, *some.interiors))) for some in polygons)


def distance_from(polygons: Polygons, line: Floats) -> float:
    """Least distance between polygons and a line through points (P, 2), or a single one [m]."""
    import shapely

    ground = shapely.MultiPolygon([(rings[0], rings[1:]) for rings in polygons])
    return float(shapely.distance(ground, shapely.LineString(line) if len(line) > 1 else shapely.Point(line[0])))


FINDERS: dict[Engine, Callable[[Floats, Floats, float, bool, Budget], Iterator[Pairs]]] = {
    Engine.SEPARATING_AXIS: rectangles.pairs_within,
    Engine.FCL: _fcl,
    Engine.SHAPELY: _shapely,
    Engine.ANGLE_SUM: rectangles.angle_sum_pairs,
}


# One pair needs no search. poses: (T, 2, 3); sizes: (2, 2). Each function returns, for each of the T instants, True if
# the pair is within the margin by the method of its engine above.
def _judged_by_fcl(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    return [_fcl_within(pair, sizes, margin, Budget()) for pair in poses]


def _judged_by_shapely(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    import shapely

    a, b = shapely.polygons(corners(poses, sizes)).T
    within: list[bool] = (shapely.dwithin(a, b, margin) if margin > 0.0 else shapely.intersects(a, b)).tolist()
    return within


JUDGES: dict[Engine, Callable[[Floats, Floats, float], list[bool]]] = {
    Engine.SEPARATING_AXIS: rectangles.pair_within,
    Engine.FCL: _judged_by_fcl,
    Engine.SHAPELY: _judged_by_shapely,
    Engine.ANGLE_SUM: rectangles.angle_sum_judged,
}

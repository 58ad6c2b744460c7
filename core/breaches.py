"""Breaches: stretches of a path on which benches break a limit, at samples of the dance, for a drawing.

A sample decides nothing: check() does. Between two samples STEP apart a bench may come nearer for a moment. But nothing
is marked where check() passes: the ground that benches cover if people stray is the same here and there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.checks import checked_number
from core.contact.between import holds_apart
from core.contact.search import MARGIN_MAX
from core.dance import Dance
from core.display import Readable, WithArrays, format_range
from core.dragon import Dragon, Stray, checked_stray
from core.extremes.speed import checked_limit
from core.kernels import Budget
from core.language import say
from core.motion.places import handle_places
from core.motion.trajectory import trajectory
from core.questions import question_about
from core.shapes.engines import inside
from core.shapes.reach import Reach, directions, gains, reach
from core.shapes.rectangles import bench_poses, edge_frames, frames
from core.values import Floats, Interval
from core.venue import Venue

# Travel of the head between two samples [m], and most samples; fewer where benches and edges make more than PAIRS.
STEP, SAMPLES_MAX, PAIRS = 0.3, 600, 4e6
# Pairs of benches whose distances are compared at once [1]: few enough for the cache of a processor.
PAIRS_AT_ONCE = 20_000
SAMPLES_MIN = 30
# Rectangles that are measured first [1]: the nearest of their circles.
FIRST = 64
# A speed breaks a limit if it is above it by more than this share, which rounding can add [1].
SPEED_ROUNDING = 1e-6
# Distance between points of a stretch [m], and their largest number.
POINT_STEP, POINTS_MAX = 0.3, 200


class BreachKind(StrEnum):
    """The limit that a stretch breaks. SPEED: a handle is faster than the limit; MARGIN: a bench comes within the
    margin of another one or of an edge, or stands outside; STRAY: it does so only if people stray."""

    SPEED = "speed"
    MARGIN = "margin"
    STRAY = "stray"


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Breach(WithArrays):
    """A stretch of the path where benches or handles break a limit.

    kind: kind of limit. speed: a handle is faster than the limit; margin: a bench comes within the margin of another
        one or of the venue's edges, or stands outside; stray: it may, if people stray
    start: start of the stretch, along the path [m]
    end: end of the stretch, along the path [m]
    points: points along it, x and y [m]
    """

    kind: BreachKind
    start: float
    end: float
    points: Floats

    def _line(self) -> str:
        kind, span = say(self.kind.value), format_range((self.start, self.end), "m")
        return say("{kind} from s = {span}", kind=kind, span=span)


@dataclass(frozen=True, slots=True, repr=False)
class AreaGap(Readable):
    """How near benches come to the border of an area, everybody in place.

    name: of the area
    distance: least distance at the samples [m]; 0 where a bench overlaps the border, or stands on its wrong side
    enough: distance with which the margin is kept however people stray [m]
    """

    name: str
    distance: float
    enough: float


def _least_gap(boxes: Floats, edges: Floats) -> float:
    """The least gap between any rectangle and any edge [m]: those whose circles come nearest are measured first."""
    reach = np.hypot(boxes[:, kernels.FRAME_HALF_LENGTH], boxes[:, kernels.FRAME_HALF_WIDTH])
    away, disc = _from_disc(boxes, edges)
    # The one nearest to the middle is no further from an edge than the disc is wide.
    candidates = away - reach <= float(away.min()) + 2.0 * disc
    boxes, reach = boxes[candidates], reach[candidates]
    best = np.inf
    for edge in edges:
        low = _beside(boxes, edge) - reach
        close = np.flatnonzero(low < best)
        close = close[np.argsort(low[close])]
        for some in (close[:FIRST], close[FIRST:]):
            rows = some[low[some] < best]
            if len(rows):
                gap = np.empty(len(rows))
                both = np.ascontiguousarray(boxes[rows]), np.tile(edge, (len(rows), 1))
                kernels.pair_gaps(*both, np.inf, gap)
                best = min(best, float(gap.min()))
    return best


@question_about("dance", Dance)
def breaches_and_gaps(
    dance: Dance,
    venue: Venue | None = None,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    speed_limit: float | None = None,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> tuple[tuple[Breach, ...], tuple[AreaGap, ...] | None]:
    """The stretches of the path on which a sample of the whole dance breaks a limit, in order of kind and place, and
    the least distance of the benches from each area at the same samples; None without a venue.

    margin [m], stray, speed_limit [m/s], start, stop [s]: as for check()
    raises: InvalidValue; TooMuchWork

    >>> from core import Area, Dragon, Line, Route
    >>> lane = Route([Line((0, 0), (30, 0))])
    >>> tree = Area("tree", (((14, 0.1), (16, 0.1), (16, 2), (14, 0.1)),))
    >>> plain = Area("plain", (((-9, -9), (39, -9), (39, 9), (-9, 9), (-9, -9)),))
    >>> marked, gaps = breaches_and_gaps(Dance(Dragon(3), lane), Venue(plain, (tree,)))
    >>> marked
    (<Breach: margin from s = 11.048 to 18.974 m>,)
    >>> gaps[1]
    <AreaGap: name tree, distance 0, enough 0 m>
    """
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed = checked_stray(stray, dance.dragon)
    limit = None if speed_limit is None else checked_limit(speed_limit)
    budget = budget or Budget()
    edges = [] if venue is None else [edge_frames(area.edges) for area in venue.areas]
    begin, until = dance.span(start, stop)
    times = _times(dance, (begin, until), sum(map(len, edges)))
    budget.afford(float(len(times) * dance.dragon.benches))
    motion, s = trajectory(dance, times, budget=budget), handle_places(dance, times, budget=budget)
    marks = {kind: [np.empty((0, 2))] for kind in BreachKind}
    if limit is not None:
        fast = s[motion.speed > limit * (1.0 + SPEED_ROUNDING)]
        marks[BreachKind.SPEED].append(np.stack([fast - 0.5 * STEP, fast + 0.5 * STEP], axis=-1))
    spans = np.stack([s[:, 1:], s[:, :-1]], axis=-1)
    held = strayed > 0.0 and not margin and holds_apart(dance, dance.clock.travel(until), strayed, budget)
    poses = bench_poses(motion.position)
    boxes = frames(poses, np.stack([dance.dragon.lengths, dance.dragon.widths], axis=-1))
    wrong = [] if venue is None else _on_wrong_sides(venue, poses)
    near, if_strayed = _too_near(dance.dragon, boxes, edges, (margin, strayed), held)
    for one in wrong:
        near |= one
    marks[BreachKind.MARGIN].append(spans[near])
    marks[BreachKind.STRAY].append(spans[if_strayed & ~near])
    found = tuple(
        Breach(kind, start, end, _along(dance, start, end))
        for kind, every in marks.items()
        for start, end in _united(np.concatenate(every))
    )
    if venue is None:
        return found, None
    flat, enough = boxes.reshape(-1, boxes.shape[-1]), margin + float(gains(dance.dragon).max()) * strayed
    least = [0.0 if off.any() else max(_least_gap(flat, area), 0.0) for off, area in zip(wrong, edges, strict=True)]
    return found, tuple(AreaGap(area.name, gap, enough) for area, gap in zip(venue.areas, least, strict=True))


def _on_wrong_sides(venue: Venue, poses: Floats) -> list[NDArray[np.bool_]]:
    """For each area which benches (T, n) have their middle on its wrong side: outside the square, in an obstacle."""
    centres = poses[..., :2].reshape(-1, 2)
    within = [inside(area.rings, centres).reshape(poses.shape[:2]) for area in venue.areas]
    return [~one if area is venue.square else one for area, one in zip(venue.areas, within, strict=True)]


def _times(dance: Dance, span: Interval, edges: int) -> Floats:
    """Times of the samples (T,) [s], evenly spaced."""
    begin, until = span
    way = dance.clock.travel(until) - dance.clock.travel(begin)
    benches = dance.dragon.benches
    most = min(SAMPLES_MAX, max(SAMPLES_MIN, int(PAIRS / (benches * (0.5 * benches + edges)))))
    return np.linspace(begin, until, min(most, int(way / STEP) + 2))


def _too_near(
    dragon: Dragon, boxes: Floats, edges: list[Floats], room: tuple[float, float], held: bool
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """For all benches at all samples (T, n): within the margin; and if people stray.

    room: margin, stray [m]; held: whether two with one bench between them stay apart as people stray
    """
    margin, stray = room
    ground = reach(dragon, stray) if stray > 0.0 else None
    near = np.zeros(boxes.shape[:2], dtype=bool)
    if_strayed = near.copy()
    for a, b, who, need in _pairs(boxes, edges, margin, gains(dragon) * stray):
        gap = np.empty(len(a))
        kernels.pair_gaps(np.ascontiguousarray(a), np.ascontiguousarray(b), float(need.max(initial=margin)), gap)
        marks = [(near, np.flatnonzero(gap <= margin))]
        if ground is not None:
            close = np.flatnonzero((margin < gap) & (gap <= need))
            if held and len(who) == 2:
                close = close[who[1][close] - who[0][close] != 2]
            marks.append(
                (if_strayed, close[_within(ground, (a[close], b[close]), [rows[close] for rows in who], margin)])
            )
        for mark, within in marks:
            for rows in who:
                mark.reshape(-1)[rows[within]] = True
    return near, if_strayed


def _within(
    ground: Reach, pairs: tuple[Floats, Floats], who: list[NDArray[np.int64]], margin: float
) -> NDArray[np.bool_]:
    """Whether the ground of each pair comes within the margin (m,). pairs, who: see _pairs(); an edge has no number"""
    count, both = len(pairs[0]), np.concatenate(pairs)
    chain, sizes = np.zeros((2 * count, kernels.CHAIN_COLUMNS)), np.zeros((2 * count, kernels.SIZE_COLUMNS))
    chain[:, kernels.MX : kernels.UY + 1] = both[:, kernels.FRAME_X : kernels.FRAME_UY + 1]
    sizes[:, kernels.HALF_LENGTH] = both[:, kernels.FRAME_HALF_LENGTH]
    of = np.zeros(2 * count, dtype=np.int64)
    for part, rows in enumerate(who):
        benches = rows % ground.bounds.benches
        here = slice(part * count, (part + 1) * count)
        of[here] = ground.kinds[np.minimum(benches, len(ground.kinds) - 1)]
        sizes[here, kernels.HALF_LENGTH] = 0.5 * ground.bounds.lengths[benches]
        sizes[here, kernels.HALF_WIDTH] = 0.5 * ground.bounds.widths[benches]
    near = np.zeros(count, dtype=np.uint8)
    if count:
        kinds = kernels.Kinds()
        kinds.lay(ground.hulls.reshape(-1, 2), of, directions())
        kernels.hulls_near(kinds, len(who) == 1, margin, sizes, chain, near)
    return near.astype(bool)


def _pairs(
    boxes: Floats, edges: list[Floats], margin: float, strayed: Floats
) -> Iterator[tuple[Floats, Floats, list[NDArray[np.int64]], Floats]]:
    """Rectangles that may be too near: rows of both, numbers of the benches among all samples, and what each needs."""
    benches = boxes.shape[1]
    reach = np.hypot(boxes[0, :, kernels.FRAME_HALF_LENGTH], boxes[0, :, kernels.FRAME_HALF_WIDTH])
    i, j = np.triu_indices(benches, 2)
    need, far = margin + strayed[i] + strayed[j], reach[i] + reach[j]
    flat = boxes.reshape(-1, boxes.shape[-1])
    rows = max(PAIRS_AT_ONCE // max(len(i), 1), 1)
    for first in range(0, len(boxes), rows):
        x, y = boxes[first : first + rows, :, :2].transpose(2, 0, 1)
        t, close = np.nonzero((x[:, i] - x[:, j]) ** 2 + (y[:, i] - y[:, j]) ** 2 <= (far + need) ** 2)
        if len(close):
            a, b = ((first + t) * benches + end[close] for end in (i, j))
            yield flat[a], flat[b], [a, b], need[close]
    need, far = (np.tile(column, len(boxes)) for column in (margin + strayed, reach))
    for area in edges:
        beside = np.flatnonzero(_from_disc(flat, area)[0] <= far + need)
        for edge in area:
            close = beside[_beside(flat[beside], edge) <= (far + need)[beside]]
            if len(close):
                yield flat[close], np.tile(edge, (len(close), 1)), [close], need[close]


def _from_disc(boxes: Floats, edges: Floats) -> tuple[Floats, float]:
    """Distances (N,) of the centres of rectangles from a disc that holds edges, negative inside, and its radius [m]."""
    middle = 0.5 * (edges[:, :2].min(axis=0) + edges[:, :2].max(axis=0))
    radius = float((np.hypot(*(edges[:, :2] - middle).T) + edges[:, kernels.FRAME_HALF_LENGTH]).max())
    return np.hypot(*(boxes[:, :2] - middle).T) - radius, radius


def _beside(boxes: Floats, edge: Floats) -> Floats:
    """Distances (N,) of the centres of rectangles from an edge [m]."""
    way = boxes[:, :2] - edge[:2]
    along, beside = np.abs(way @ edge[2:4]), np.abs(way @ np.array([-edge[3], edge[2]]))
    distance: Floats = np.hypot(np.maximum(along - edge[kernels.FRAME_HALF_LENGTH], 0.0), beside)
    return distance


def _united(spans: Floats) -> Iterator[Interval]:
    """The union of intervals (N, 2) of s; those less than STEP apart are one."""
    start, end = None, 0.0
    for low, high in spans[np.argsort(spans[:, 0])].tolist():
        if start is None or low > end + STEP:
            if start is not None:
                yield start, end
            start, end = low, high
        end = max(end, high)
    if start is not None:
        yield start, end


def _along(dance: Dance, start: float, end: float) -> Floats:
    """Points of a stretch, as far as it is on the path."""
    path = dance.path
    low, high = path.drawn_between(start, end)
    low, high = min(max(start, low), high), max(min(end, high), low)
    return path.position(np.linspace(low, high, min(POINTS_MAX, int((high - low) / POINT_STEP) + 2)))

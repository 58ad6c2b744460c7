"""Meetings: the moments at which another bench comes abreast of a bench, or comes nearest to it without that.

Bench j is abreast of bench k when the middle of j is straight to the left or to the right of the middle of k, that is,
when
    a(s) = u_k . (m_j - m_k) = 0,
where m are the middles, u_k is the direction of bench k and s is the travel of the head. Neighbours share a handle and
are never abreast. It is a meeting if the other bench is more than EVEN ahead before it, and more than EVEN behind after
it, or the other way round. A bench that walks along in a row stays ahead or behind, so its a keeps its sign.

Input:  a dragon on a path, the benches to follow, a row of travels, the reach
Output: the zeros of a, with the gap of the two benches there, if the gap is within the reach and no third bench stands
        between the two middles

Each zero is bracketed by two rows with other signs, and narrowed by false position (the Illinois variant), all zeros of
a block of rows together. What is known: at the travel that comes back, |a| is at most ABREAST; the gap is the exact
separation of the two rectangles at that travel. What may be missed: a bench that comes abreast and falls back between
two rows, STEP of head travel apart.

A bench that turns away before it is abreast is met where it is nearest. The two middles are nearest in a row that is
nearer than both rows beside it; within AROUND rows of it the gap of the two benches is narrowed by a golden section,
and the least gap of all that are tried counts. It is no meeting if the gap is not RISE larger at both ends, if the pair
is abreast within APART of it, or if the gap is not at least NEARER less than it is when the dragon is straight: so a
bench does not meet those before and behind it, or those at its side.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.dance import Dance
from core.kernels import Budget
from core.motion.trajectory import trajectory
from core.questions import question_about
from core.shapes.rectangles import bench_poses, frames, frames_separation
from core.values import Floats, Pair

# Travel of the head between two rows [m], and most rows; on a longer way rows are further apart.
STEP, ROWS_MAX = 0.25, 20_000
# Largest distance of the other bench's middle from the line straight to the side, at a meeting [m].
ABREAST = 1e-9
# Least way that the other bench must be ahead before a meeting and behind after it, or the other way round [m].
EVEN = 0.05
# Most rounds of false position; eight are usual.
ROUNDS = 60
# Handles laid out at once [1]: 40 MB of positions and velocities; and rows at once: over a short way few benches come
# near another one.
HANDLES_AT_ONCE, ROWS_AT_ONCE = 1_000_000, 40
# Spare of the boxes that hold a bench's middle between two rows [m]: a middle leaves the box of its rows by no more
# than the bulge of its way over one STEP, a few millimetres, and by at most the way itself.
SPARE = 0.5
# Rows on each side of the least distance of two middles between which the gap is least [1]: 2 m of head travel.
AROUND = 8
# Travel between two meetings of one pair [m], or time of several dragons [s].
APART = 10.0
# By how much a bench must be nearer than in a straight dragon to be met without being abreast [m].
NEARER = 2.0
# By how much the gap must be larger AROUND rows before and after [m]: else two walk side by side.
RISE = 0.1
# Rounds of the golden section, after which the moment is known to a thousandth of its first width, and its share [1].
SECTIONS, SECTION = 15, 0.5 * (np.sqrt(5.0) - 1.0)
# Way along a chain between two dragons [m]: so far that nobody is in a row with a bench of another one.
ELSEWHERE = 1e9

Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class HandleChain:
    """All handles of a dragon, or of several one after the other, and the benches between them.

    place: handles (R, N + 1, 2) at R travels of the head, or for several dragons at R times; sizes: lengths and widths
    of the benches (N, 2) [m]; gaps: numbers of those that are no benches, between two dragons
    """

    place: Callable[[Floats, Budget], Floats]
    sizes: Floats
    gaps: Indices

    @property
    def at_once(self) -> int:
        """Number of instants whose handles are laid out at once."""
        return max(1, HANDLES_AT_ONCE // (len(self.sizes) + 1))


def chain_of(dance: Dance) -> HandleChain:
    """The chain of one dragon. dance: at 1 m/s without passages"""

    def place(travels: Floats, budget: Budget) -> Floats:
        return trajectory(dance, travels, budget=budget).position

    return HandleChain(place, np.stack([dance.dragon.lengths, dance.dragon.widths], axis=-1), _NO_BENCHES)


class MeetingColumns(NamedTuple):
    """Meetings in columns (M,): own and other bench, travel of the head [m], signed distance of the middles to the left
    [m], gap of the benches [m], the cosine of the angle between their directions, and how far the other middle is ahead
    [m]: 0 where it is abreast."""

    own: Indices
    other: Indices
    travel: Floats
    left: Floats
    gap: Floats
    cosine: Floats
    ahead: Floats


class _Crossings(NamedTuple):
    """Changes of sign in columns: own and other bench, the two travels [m], and a there [m]."""

    own: Indices
    other: Indices
    low: Floats
    high: Floats
    at_low: Floats
    at_high: Floats


_NO_BENCHES, _NO_NUMBERS = np.empty(0, dtype=np.intp), np.empty(0)
_NONE = _Crossings(_NO_BENCHES, _NO_BENCHES, _NO_NUMBERS, _NO_NUMBERS, _NO_NUMBERS, _NO_NUMBERS)


def travels_between(first: float, last: float) -> Floats:
    """Travels of the head from first to last, STEP apart or, on a long way, in ROWS_MAX rows [m]."""
    return np.linspace(first, last, min(ROWS_MAX, int((last - first) / STEP) + 2))


def travels_within(steady: Dance, first: float, last: float) -> Floats:
    """travels_between() of two travels that the clock of a dance rounds, and so may put just outside its run [m]."""
    return travels_between(max(first, steady.earliest), min(last, steady.end.time))


def steady_dance(dance: Dance) -> Dance:
    """The same dance at 1 m/s without passages: its times are travels of the head."""
    return Dance(dance.dragon, dance.path, 1.0)


def instants_at_once(dance: Dance) -> int:
    """Number of instants whose handles are laid out at once."""
    return max(1, HANDLES_AT_ONCE // (dance.dragon.benches + 1))


@question_about("dance", Dance, "the meetings were not found")
def meetings_between(
    dance: Dance, benches: Sequence[int], travels: Floats, reach: float, budget: Budget
) -> MeetingColumns:
    """All meetings of some benches with others, between rows of travels of the head.

    dance: at 1 m/s without passages; travels: rising, (R,) [m]; reach: largest gap of a meeting [m]
    returns: in the order of the own benches, then of travels
    raises: TooMuchWork
    """
    return meetings_in(chain_of(dance), benches, travels, reach, budget)


def meetings_in(
    chain: HandleChain, benches: Sequence[int], travels: Floats, reach: float, budget: Budget
) -> MeetingColumns:
    """meetings_between() of the benches of a chain; travels: of the head, or for several dragons times"""
    parts = [MeetingColumns(*_NONE, _NO_NUMBERS)]
    at_once, far = chain.at_once, _far(chain, reach)
    rows, before = max(2, min(ROWS_AT_ONCE, at_once)), dict[int, _Before]()
    last, nearest, abreast = (
        np.empty((0, len(chain.sizes), 3)),
        list[_Nearest](),
        list[tuple[Indices, Indices, Floats]](),
    )
    for first in range(0, len(travels), rows):
        some = travels[first : first + rows]
        poses = np.concatenate([last, bench_poses(chain.place(some, budget))])
        crossings, rows_nearest = _crossings(poses, (some, first), benches, (far, chain.gaps), before, budget)
        nearest += rows_nearest
        last = poses[-2:].copy()
        for part in _parts(crossings, at_once):
            zeros = _zeros(chain, part, budget)
            abreast.append(zeros)
            parts.append(_met(chain, zeros, reach, budget))
    parts.append(_approaches(chain, travels, nearest, abreast, reach, budget))
    columns = [np.concatenate(column) for column in zip(*parts, strict=True)]
    order = np.lexsort((columns[2], columns[0]))
    return MeetingColumns(*(column[order] for column in columns))


class _Nearest(NamedTuple):
    """Rows in which two middles are nearest, in columns: own and other bench, row, and distance of the middles [m]."""

    own: Indices
    other: Indices
    row: Indices
    away: Floats


def _nearest(away: Floats, k: int, near: Indices, first: int, far: float) -> _Nearest:
    """Those of bench k. away: from its middle to those of the benches near it, in rows from `first` on [m]"""
    square = np.einsum("ijk,ijk->ij", away, away)
    middle = square[1:-1]
    row, column = np.nonzero((middle <= square[:-2]) & (middle < square[2:]) & (middle <= far * far))
    return _Nearest(np.full(row.size, k, dtype=np.intp), near[column], row + first + 1, np.sqrt(middle[row, column]))


def _in_row(chain: HandleChain, travel: float, budget: Budget) -> Callable[[Indices, Indices], Floats]:
    """The gap of two benches of one dragon that is straight [m]."""
    (handles,) = chain.place(np.array([travel]), budget)
    chords = np.hypot(*np.diff(handles, axis=0).T)
    chords[chain.gaps] = ELSEWHERE
    middles, (lengths, _) = np.cumsum(chords) - 0.5 * chords, chain.sizes.T

    def gap(own: Indices, other: Indices) -> Floats:
        straight: Floats = np.abs(middles[own] - middles[other]) - 0.5 * (lengths[own] + lengths[other])
        return straight

    return gap


# A pair that comes no nearer than it is in a row cannot count: benches are apart by at least the distance of their
# middles less half their diagonals.
def _approaches(
    chain: HandleChain,
    travels: Floats,
    nearest: list[_Nearest],
    abreast: list[tuple[Indices, Indices, Floats]],
    reach: float,
    budget: Budget,
) -> MeetingColumns:
    """The meetings of benches that are not abreast. abreast: own and other bench, and travels at which they are"""
    none, in_row = MeetingColumns(*_NONE, _NO_NUMBERS), _in_row(chain, float(travels[0]), budget)
    own, other, row, away = (np.concatenate(column) for column in zip(*nearest, strict=True))
    half = 0.5 * np.hypot(*chain.sizes.T)
    kept = np.flatnonzero(away - half[own] - half[other] < in_row(own, other) - NEARER)
    times = dict[Pair, list[float]]()
    for columns in abreast:
        for a, b, at in zip(*(column.tolist() for column in columns), strict=True):
            times.setdefault((a, b), []).append(at)

    def is_new(a: int, b: int, travel: float) -> bool:
        return all(abs(travel - one) > APART for one in times.get((a, b), ()))

    ends = zip(own[kept].tolist(), other[kept].tolist(), travels[row[kept]].tolist(), strict=True)
    kept, parts = kept[[is_new(*one) for one in ends]] if kept.size else kept, [none]
    for first in range(0, kept.size, chain.at_once):
        some = kept[first : first + chain.at_once]
        low, high = np.maximum(row[some] - AROUND, 0), np.minimum(row[some] + AROUND, len(travels) - 1)
        pair = own[some], other[some]
        travel, rise = _least_gaps(chain, pair, travels[row[some]], (travels[low], travels[high]), budget)
        rising = np.flatnonzero(rise >= RISE)
        met = _met(chain, (pair[0][rising], pair[1][rising], travel[rising]), reach, budget)
        counts = (met.gap < in_row(met.own, met.other) - NEARER) & (met.ahead != 0.0)
        parts.append(_chosen(met, np.flatnonzero(counts)))
    met = MeetingColumns(*(np.concatenate(column) for column in zip(*parts, strict=True)))
    chosen = list[int]()
    for k in np.argsort(met.gap, kind="stable").tolist():  # The nearest of several moments of a pair counts.
        a, b, travel_of = int(met.own[k]), int(met.other[k]), float(met.travel[k])
        if is_new(a, b, travel_of):
            times.setdefault((a, b), []).append(travel_of)
            chosen.append(k)
    return _chosen(met, np.array(chosen, dtype=np.intp))


def _chosen(met: MeetingColumns, some: Indices) -> MeetingColumns:
    """Some meetings, by their numbers."""
    columns: list[Any] = [column[some] for column in met]
    return MeetingColumns(*columns)


def _least_gaps(
    chain: HandleChain, pair: tuple[Indices, Indices], travel: Floats, ends: tuple[Floats, Floats], budget: Budget
) -> tuple[Floats, Floats]:
    """Travels between two ends at which the gap of each pair is the least of all that are tried, (E,) [m], and by how
    much it is larger at both ends, (E,) [m]."""
    rows, sizes = np.arange(travel.size), chain.sizes
    best, travel = np.full(travel.size, np.inf), travel.copy()

    def gaps(at: Floats) -> Floats:
        poses = bench_poses(chain.place(at, budget))
        sides = (frames(poses[rows, bench], sizes[bench]) for bench in pair)
        gap: Floats = frames_separation(*sides).separation
        better = gap < best
        best[better], travel[better] = gap[better], at[better]
        return gap

    gaps(travel.copy())
    low, high = ends
    at_ends = np.minimum(gaps(low), gaps(high))
    inner, outer = high - SECTION * (high - low), low + SECTION * (high - low)
    at_inner, at_outer = gaps(inner), gaps(outer)
    for _ in range(SECTIONS):
        falls = at_inner >= at_outer
        low, high = np.where(falls, inner, low), np.where(falls, high, outer)
        tried = np.where(falls, low + SECTION * (high - low), high - SECTION * (high - low))
        gap = gaps(tried)
        inner, outer = np.where(falls, outer, tried), np.where(falls, tried, inner)
        at_inner, at_outer = np.where(falls, at_outer, gap), np.where(falls, gap, at_inner)
    return travel, at_ends - best


def _far(chain: HandleChain, reach: float) -> float:
    """Distance of two middles beyond which the benches are further apart than the reach [m]."""
    return reach + float(np.hypot(*chain.sizes.T).max())


def _parts(crossings: _Crossings, most: int) -> Iterator[_Crossings]:
    for first in range(0, len(crossings.own), most):
        some = slice(first, first + most)
        own, other, low, high, at_low, at_high = crossings
        yield _Crossings(own[some], other[some], low[some], high[some], at_low[some], at_high[some])


class _Before(NamedTuple):
    """For each bench near one bench, in rising order: a and the travel in the last row that counted; NaN without."""

    near: Indices
    along: Floats
    travel: Floats


# Two benches that walk side by side do not meet each time that one of them is a little ahead; so a row counts only if
# |a| is more than EVEN, and a change of sign is one between two rows that count, with none that counts between them.
# `before` carries the last row that counted from one block of rows to the next.
def _crossings(
    poses: Floats,
    block: tuple[Floats, int],
    benches: Sequence[int],
    limits: tuple[float, Indices],
    before: dict[int, _Before],
    budget: Budget,
) -> tuple[_Crossings, list[_Nearest]]:
    """The changes of sign of a in a block of rows, or since the one before it; and the rows with nearest middles.

    poses: (R, n, 3), with up to two rows before the block; block: its travels [m], and the number of its first row
    limits: distance beyond which no bench is met [m], and the gaps of a chain
    """
    (far, gaps), (travels, first) = limits, block
    earlier_rows, nearest = len(poses) - len(travels), list[_Nearest]()
    middles, heading = poses[..., :2], poses[earlier_rows:, :, 2]
    low, high = middles.min(axis=0) - SPARE, middles.max(axis=0) + SPARE
    rows, columns = np.arange(len(travels) + 1)[:, None], [_NONE]
    for k in benches:
        budget.afford(float(len(travels)))
        near = np.flatnonzero(((low <= high[k] + far) & (high >= low[k] - far)).all(axis=1))
        near = near[(np.abs(near - k) > 1) & ~np.isin(near, gaps)]
        away = middles[:, near] - middles[:, k, None]
        nearest.append(_nearest(away, k, near, first - earlier_rows, far))
        away = away[earlier_rows:]
        known, when = _recalled(before.get(k), near)
        along = away[..., 0] * np.cos(heading[:, k, None]) + away[..., 1] * np.sin(heading[:, k, None])
        along, moments = np.vstack([known, along]), np.broadcast_to(travels[:, None], along.shape)
        moments = np.vstack([when, moments])
        counts = np.abs(along) > EVEN
        last = np.maximum.accumulate(np.where(counts, rows, 0), axis=0)
        earlier = np.take_along_axis(along, last, axis=0)
        row, column = np.nonzero(counts[1:] & (np.abs(earlier[:-1]) > EVEN) & (along[1:] * earlier[:-1] < 0.0))
        close = np.abs(away[row, column]).max(axis=1) <= far + SPARE
        row, column = row[close], column[close]
        start = last[row, column]
        ends = moments[start, column], travels[row], along[start, column], along[row + 1, column]
        columns.append(_Crossings(np.full(row.size, k, dtype=np.intp), near[column], *ends))
        # A view of the last row would keep the block.
        before[k] = _Before(near, earlier[-1].copy(), np.take_along_axis(moments, last[-1:], axis=0)[0])
    return _Crossings(*(np.concatenate(column) for column in zip(*columns, strict=True))), nearest


def _recalled(before: _Before | None, near: Indices) -> tuple[Floats, Floats]:
    """a and the travel in the last row that counted, for each of these benches; NaN for none."""
    known, when = np.full(near.size, np.nan), np.full(near.size, np.nan)
    if before is not None and before.near.size:
        place = np.minimum(np.searchsorted(before.near, near), before.near.size - 1)
        same = before.near[place] == near
        known[same], when[same] = before.along[place[same]], before.travel[place[same]]
    return known, when


def _abreast(chain: HandleChain, own: Indices, other: Indices, travels: Floats, budget: Budget) -> Floats:
    """a of each pair at its own travel (E,) [m]."""
    position, rows = chain.place(travels, budget), np.arange(own.size)
    front, rear = position[rows, own], position[rows, own + 1]
    away = 0.5 * (position[rows, other] + position[rows, other + 1] - front - rear)
    along = front - rear
    a: Floats = (away * along).sum(axis=-1) / np.hypot(*along.T)
    return a


# False position of Illinois: the end that stays twice has its value halved, so that the other end comes near, too.
def _zeros(chain: HandleChain, crossings: _Crossings, budget: Budget) -> tuple[Indices, Indices, Floats]:
    """Own and other bench and the travel of each zero, |a| at most ABREAST there."""
    own, other = crossings.own, crossings.other
    low, high, at_low, at_high = (column.copy() for column in crossings[2:])
    travel = np.where(np.abs(at_low) <= np.abs(at_high), low, high)
    open_, stayed = np.flatnonzero(np.minimum(np.abs(at_low), np.abs(at_high)) > ABREAST), np.zeros(own.size)
    for _ in range(ROUNDS):
        if not open_.size:
            break
        share = at_low[open_] / (at_low[open_] - at_high[open_])
        middle = low[open_] + share * (high[open_] - low[open_])
        value = _abreast(chain, own[open_], other[open_], middle, budget)
        travel[open_] = middle
        same = (value > 0.0) == (at_low[open_] > 0.0)
        lower, upper = open_[same], open_[~same]
        at_high[lower] *= np.where(stayed[lower] > 0.0, 0.5, 1.0)
        at_low[upper] *= np.where(stayed[upper] < 0.0, 0.5, 1.0)
        low[lower], at_low[lower], stayed[lower] = middle[same], value[same], 1.0
        high[upper], at_high[upper], stayed[upper] = middle[~same], value[~same], -1.0
        open_ = open_[np.abs(value) > ABREAST]
    return own, other, travel


def _met(chain: HandleChain, zeros: tuple[Indices, Indices, Floats], reach: float, budget: Budget) -> MeetingColumns:
    """The moments that are meetings: within the reach, and with no third bench between the two middles."""
    own, other, travel = zeros
    rows = np.arange(own.size)
    poses, sizes = bench_poses(chain.place(travel, budget)), chain.sizes
    mine, theirs = poses[rows, own], poses[rows, other]
    gap = frames_separation(frames(mine, sizes[own]), frames(theirs, sizes[other])).separation
    away = theirs[:, :2] - mine[:, :2]
    left = away[:, 1] * np.cos(mine[:, 2]) - away[:, 0] * np.sin(mine[:, 2])
    ahead = away[:, 0] * np.cos(mine[:, 2]) + away[:, 1] * np.sin(mine[:, 2])
    kept = np.flatnonzero(gap <= reach)
    hidden = _hidden(poses[kept], chain, own[kept], other[kept])
    kept = kept[~hidden]
    cosine = np.cos(theirs[kept, 2] - mine[kept, 2])
    ahead = np.where(np.abs(ahead) > EVEN, ahead, 0.0)[kept]
    return MeetingColumns(own[kept], other[kept], travel[kept], left[kept], gap[kept], cosine, ahead)


# The segment p + t q, t in [0, 1], meets a rectangle if the intervals of t in which it is between the two long sides
# and between the two short sides have a common part. p and q are taken in the frame of the rectangle.
def _hidden(poses: Floats, chain: HandleChain, own: Indices, other: Indices) -> NDArray[np.bool_]:
    """True where a third bench meets the segment between the two middles. poses: (E, n, 3); returns (E,)"""
    rows, sizes = np.arange(own.size), chain.sizes
    mine, way = poses[rows, own, :2], poses[rows, other, :2] - poses[rows, own, :2]
    reach = np.hypot(*way.T) + 0.5 * float(np.hypot(*sizes.T).max())
    away = poses[..., :2] - mine[:, None]
    near = np.einsum("ijk,ijk->ij", away, away) <= (reach * reach)[:, None]
    near[rows, own] = near[rows, other] = False
    near[:, chain.gaps] = False
    event, third = np.nonzero(near)
    heading, half = poses[event, third, 2], 0.5 * sizes[third]
    cos, sin = np.cos(heading), np.sin(heading)
    p, q = -away[event, third], way[event]
    first, last = np.zeros(event.size), np.ones(event.size)
    for side, (x, y) in enumerate(((cos, sin), (-sin, cos))):
        begin, along = p[:, 0] * x + p[:, 1] * y, q[:, 0] * x + q[:, 1] * y
        flat = along == 0.0
        steps = np.where(flat, 1.0, along)
        ends = np.stack([(-half[:, side] - begin) / steps, (half[:, side] - begin) / steps])
        inside = np.abs(begin) <= half[:, side]
        first = np.maximum(first, np.where(flat, np.where(inside, 0.0, 2.0), ends.min(axis=0)))
        last = np.minimum(last, np.where(flat, 1.0, ends.max(axis=0)))
    return np.bincount(event[first <= last], minlength=own.size) > 0

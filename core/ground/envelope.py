"""The ground that benches sweep: polygons that hold every pose of every bench, and hardly more.

All benches of one size together sweep the ground that a lone bench of that size sweeps over all their places
(tracks.py).

Take a cell [s_a, s_b] of places of the front handle, h wide. A point of the bench is fixed in it, so its place p(s) has
|p''| <= K, the bound for a corner (CORNER_PULL of core/kernels/bounds.py), and for s = (1 - t) s_a + t s_b
    |p(s) - (1 - t) p(s_a) - t p(s_b)| <= K h^2 / 8 =: bow.
So up to the bow the bench sweeps the ground of the quadrilateral R_t with the corners (1 - t) a_i + t b_i. This is R_0
and the ground that each of its four edges sweeps, because a point enters R_t only through an edge. Let an edge go from
p to q, e = q - p, and let the lines of its first and its last place cross at X = p_a + m_a e_a = p_b + m_b e_b. The
edge sweeps
    m_a, m_b < 0 or both > 1:   the convex quadrilateral of its two ends.
    |e_b - e_a| / 4 small:      the convex hull of its two ends up to this distance: the hull holds points like
                                (1 - t) p_a + t q_b besides those of the edge from (1 - t) p_a + t p_b to
                                (1 - t) q_a + t q_b.
    else:                       the triangles (X, p_a, p_b) and (X, q_a, q_b), up to
        slip = |m_b - m_a| |e_b - e_a| / 4.
    For the point Z at (1 - t) m_a + t m_b of the edge's line is X + t (1 - t) (m_b - m_a) (e_a - e_b). The edge is the
    broken line p, Z, q, or part of one half of it, and no point of it is further from the triangles than Z is from X.
        m_a, m_b in [0, 1]: Z is on the edge, and all of the triangles is within slip of the swept ground.
        one outside, |m_b - m_a| <= 1/2: X is on the other of the edge's two places. The rest of the triangles is
            within |m_b - m_a| |e_b - e_a| = 4 slip of that place, after 2 slip for Z: 6 slip in all.
Both bow and slip are of the second order in h.

Towards the fold of a spiral K grows without bound. There delta(theta) bounds the motion itself: while the front handle
goes from theta_a in to theta_b, the rear one stays between theta_b + delta(theta_a) and theta_a + delta(theta_b). Every
point of the bench moves with its handles, by 1/2 + z / chord and 1/2 - z / chord of each (core/shapes/reach.py), so
by at most (1/2 + radius / chord) times the sum of both arcs. Where this is small, the bench stays near its first place.

The union of all these polygons, grown by at least the largest bow and the largest slip of any cell, holds every pose;
the largest of all cells counts because a point may have entered R_t in an earlier cell. Polygons that lie within a
small distance of the union of the others are left out, and the union is grown by this distance too. No point of it is
further from ground that a bench covers than this growth plus bow + slip; at the ends of a stretch the motion of the
bench over the spare places there is added.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core import kernels
from core.checks import checked_list, checked_number, checked_point
from core.claims.certificate import WithClaim
from core.claims.claim import ClaimKind, GroundClaim
from core.dance import Dance
from core.display import Readable, WithArrays
from core.dragon import Dragon
from core.error_free import paired
from core.errors import InvalidValue
from core.ground.tracks import Track, tracks
from core.kernels import Budget
from core.kernels.constants import CHORD, CORNER_PULL, FREE, HALF_LENGTH, HALF_WIDTH, LAG, PLACE_SPARE, RADIUS
from core.language import counted, say
from core.performance import Performance
from core.questions import or_about, question_about
from core.shapes.engines import GRID, GROWTH_MOST, Polygons, area_of, distance_from, united
from core.shapes.rectangles import bench_outlines
from core.values import Floats

# Least and largest excess that a question may ask for [m].
EXCESS_MIN, EXCESS_MAX = 5e-4, 1.0
# Parts of the excess [1]: the largest bow plus the largest slip, the largest bow alone, and the largest distance
# outside the union of a polygon that is left out of it. The union is grown by the first and the last of these; with bow
# and slip themselves that is 0.93 of the excess, and the rest is for the grid of the union and for ends of stretches.
BOW_AND_SLIP, BOW, LEFT_OUT = 0.4, 0.125, 0.12
# Largest excess of the convex hull of an edge's places over its swept ground, relative to the whole excess [1].
FLAT = 0.02
# Excess of the two triangles over the swept ground where one crossing is outside the edge, in slips; and the largest
# distance of the two crossings along the edge in that case [1].
BESIDES, MIXED = 6.0, 0.5
# Rounding of points and of the union [m]; places within 1 km are good to 1e-9 m.
ROUNDING = 1e-8
# Largest number of cells that share one bound on the motion [1].
CELLS = 16
# Work of one cell, 0.03 to 0.06 ms and 1.5 kB with its share of the union, and the budget of one question, half a
# million cells [1].
CELL_WORK, ENVELOPE_WORK = 200.0, 1e8


@dataclass(frozen=True, slots=True, repr=False)
class SweepProof(WithClaim):
    """Proven bounds of an envelope.

    claim: the claim as a kind and values
    cells: number of stretches of the path, each with a bound on the motion

    >>> from core import Spiral
    >>> envelope(Dance(Dragon(3), Spiral()), stop=10.0).certificate.cells > 0
    True
    """

    claim: GroundClaim
    cells: int


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Envelope(WithArrays):
    """The ground that benches sweep.

    polygons: for each its outer ring, counter-clockwise, then its holes, clockwise; rings are closed, (points, 2) [m]
    excess: no point of it is further than this from ground that a bench covers, which is proven [m]
    area: area of all polygons [m2]
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    certificate: proven bounds of the envelope

    >>> from core import Spiral
    >>> ground = envelope(Dance(Dragon(3), Spiral()), stop=10.0)
    >>> round(ground.area, 2), round(ground.distance([[0.0, 0.0], [1.0, 0.0]]), 2)
    (7.24, 7.53)
    """

    polygons: Polygons
    excess: float
    area: float
    start: float
    stop: float
    certificate: SweepProof

    def _line(self) -> str:
        return say(
            "{area:.6g} m2 from {start:.6g} to {stop:.6g} s, at most {excess:.3g} m beyond the benches",
            area=self.area, start=self.start, stop=self.stop, excess=self.excess,
        )  # fmt: skip

    def _rows(self) -> list[tuple[str, str]]:
        points = sum(len(ring) for rings in self.polygons for ring in rings)
        polygons = counted(len(self.polygons), "{count} polygon", "{count} polygons")
        size = say("{polygons}, {count} points", polygons=polygons, count=points)
        return [("polygons", size), *((name, text) for name, text in Readable._rows(self) if name != "polygons")]

    def distance(self, line: object) -> float:
        """Least distance of a line through points, or of a single point, from the envelope; 0 where they meet [m].

        line: [(x, y), ...] [m]. No bench comes nearer to it than this, and one comes within this plus the excess.
        raises: InvalidValue (line)
        """
        points = [
            checked_point(f"line.{k}", point)
            for k, point in enumerate(checked_list("line", line, "must be a list of points"))
        ]
        if not points:
            raise InvalidValue("line", "must have at least one point")
        return distance_from(self.polygons, np.array(points))


@question_about("performance", Performance, "the ground that benches sweep was not found")
def _envelopes(
    performance: Performance, *, start: float | None = None, stop: float | None = None, **how: Any
) -> tuple[Envelope, ...]:
    span = performance.span(start, stop)
    return tuple(
        envelope(part.dance, start=first, stop=last, **how)
        for part in performance.parts
        for first, last in [part.own_span(*span)]
    )


@or_about(Performance, _envelopes)
@question_about("dance", (Dance, Performance), "the ground that benches sweep was not found")
def envelope(
    dance: Dance,
    *,
    start: float | None = None,
    stop: float | None = None,
    excess: float = 1e-3,
    budget: Budget | None = None,
) -> Envelope:
    """The ground that benches sweep, as polygons that hold every pose of every bench; of a Performance an Envelope for
    each dragon, on the clock of its own dance.

    start, stop: [s]; defaults: dance.begin and the end of the run, or those of the performance. The ground of a dragon
        that stands is that of the first or the last STANDING of its dance
    excess: largest distance of any point of the polygons from ground that a bench covers [m]; a larger excess costs
        less time. A run to its fold may exceed it; see Envelope.excess
    A contact does not end the dance: to end it there, give its time as the stop.
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Spiral
    >>> answer = envelope(Dance(Dragon(3), Spiral()), stop=10.0)
    >>> len(answer.polygons), round(answer.area, 1)
    (1, 7.2)
    """
    excess = checked_number("excess", excess, "m", EXCESS_MIN, EXCESS_MAX)
    begin, until = dance.whole_span(start, stop)
    budget = (budget or Budget()).within(ENVELOPE_WORK)
    swept = tracks(dance, dance.clock.travel(begin), dance.clock.travel(until))
    budget.look()
    parts = [part for track in swept for part in _Lone(dance, track, excess, budget).sweep()]
    core = [polygons for part in parts for polygons in part.core]
    rest = [polygons for part in parts for polygons in part.rest]
    added = (BOW_AND_SLIP + LEFT_OUT) * excess + GRID + ROUNDING
    polygons = united(core, rest, added, LEFT_OUT * excess, budget)
    most = GROWTH_MOST * added + GRID + BOW_AND_SLIP * excess + max(part.over for part in parts) + ROUNDING
    cells = sum(part.cells for part in parts)
    length = sum(track.length for track in swept)
    claim = GroundClaim(ClaimKind.SWEPT_GROUND, begin, until, most, len(swept), length, cells)
    proof = SweepProof(claim, cells)
    area = area_of(polygons)
    frame, onwards = dance.path.frame, slice(None, None, 1 if dance.path.frame.clockwise else -1)
    # in the world frame, each ring still in its direction
    polygons = tuple(tuple(frame.points(ring)[onwards] for ring in rings) for rings in polygons)
    return Envelope(polygons, most, area, begin, until, proof)


@dataclass(frozen=True, slots=True)
class _Part:
    """Ground that a lone bench sweeps over one stretch, up to `BOW_AND_SLIP` of the excess.

    core: arrays of convex polygons (N, corners, 2) that hold nearly all of it; rest: the other polygons
    over: largest motion of the bench over the spare places at the ends of the stretch [m]
    """

    core: list[Floats]
    rest: list[Floats]
    cells: int
    over: float


# Input:  a path, the size of a bench, and the stretches of places of its front handle.
# State:  `interval`, a stretch of the path with bounds on the motion; for each stretch `nodes`, the places between
#         cells, and `pulls`, K of each cell, or 0 where the bench stays near its first place.
# Output: a part for each stretch.


class _Lone:
    """A lone bench on the path, as a function of the place of its front handle."""

    def __init__(self, dance: Dance, track: Track, excess: float, budget: Budget) -> None:
        dragon, path, bench = dance.dragon, dance.path, slice(track.bench, track.bench + 1)
        self.dragon = Dragon.of(dragon.lengths[bench], dragon.widths[bench], dragon.overhangs[bench])
        self.turns = np.empty(0) if path.spiral is not None else path.as_route(path.end).corners
        self.path, self.stretches, self.excess, self.budget = path, track.stretches, excess, budget
        columns = self.dragon.lengths, self.dragon.widths, self.dragon.chords
        length, width, self.chord = (column.item() for column in columns)
        self.last = path.last_lag(self.chord)
        self.radius = 0.5 * math.hypot(length, width)
        sizes, self.motion = np.zeros((2, kernels.SIZE_COLUMNS)), np.zeros((2, kernels.MOTION_COLUMNS))
        sizes[0, [CHORD, HALF_LENGTH, HALF_WIDTH, RADIUS]] = self.chord, 0.5 * length, 0.5 * width, self.radius
        scene = kernels.Scene(path.curve, path.place, kernels.Rings(), sizes, 1, 0)
        self.before, after = np.zeros((2, 2, kernels.CHAIN_COLUMNS))
        self.interval = kernels.Interval(scene, self.before, after, self.motion)

    def sweep(self) -> Iterator[_Part]:
        """The ground that it sweeps, stretch by stretch."""
        for low, high, spare in self.stretches:
            nodes, pulls = self.laid_out(low, high, spare)
            while True:
                corners, bows = self.corners(nodes), 0.125 * pulls * np.diff(nodes) ** 2
                core, rest, slips = _swept(corners, pulls > 0.0, FLAT * self.excess)
                wide = np.flatnonzero(slips > (BOW_AND_SLIP - BOW) * self.excess)
                if not wide.size:
                    break
                self.budget.afford(CELL_WORK * wide.size)
                pulls[wide] *= 2.0 if self.turns.size else 1.0  # jumps count as 2 V / h (core/kernels/corners.py)
                nodes = np.insert(nodes, wide + 1, 0.5 * (nodes[wide] + nodes[wide + 1]))
                pulls = np.insert(pulls, wide, pulls[wide])
            ends = np.linalg.norm(corners[[0, -1]] - corners[[1, -2]], axis=-1).max(axis=1)
            yield _Part(core, rest, pulls.size, float((ends + bows[[0, -1]]).max()))

    def laid_out(self, low: float, high: float, spare: float) -> tuple[Floats, Floats]:
        """Nodes and pulls of a stretch; its spare places at both ends are cells of their own."""
        nodes, pulls, s, h = [low], [], low, spare
        while s < high:
            h = min(h, high - spare - s) if s < high - 1.5 * spare else high - s
            pull, count = self.pull(s, h), CELLS + 1
            if pull < FREE:
                count = max(1, math.ceil(min(h * math.sqrt(0.125 * pull / (BOW * self.excess)), count)))
            if count > 1 and self.over_corner(s + h):  # K holds only over all of h
                count = CELLS + 1
            if count > CELLS and self.moved(s, h) <= (BOW_AND_SLIP - BOW) * self.excess:
                count, pull = 1, 0.0
            if count > CELLS:
                h *= 0.5
                assert s + h > s, "the motion of a bench has a bound over short ways"
                continue
            self.budget.afford(CELL_WORK * count)
            nodes += (s + h / count * np.arange(1, count + 1)).tolist()
            pulls += [pull] * count
            h = max(2.0 * h, self.chord if s == low else 0.0)
            s = nodes[-1]
        return np.array(nodes), np.array(pulls)

    def pull(self, s: float, h: float) -> float:
        """K over [s, s + h] [1/m]; FREE where none is known."""
        known = self.interval.lay_out(self.path.place - s, h, 1)
        return float(self.motion[0, CORNER_PULL]) if known else FREE

    def over_corner(self, s: float) -> bool:
        """Whether a corner is between its rear handle in the last interval and a place of its front one [m]."""
        rear = -float(self.before[1, LAG])
        return bool(((rear - PLACE_SPARE < self.turns) & (self.turns < s + PLACE_SPARE)).any())

    def moved(self, s: float, h: float) -> float:
        """Upper bound of the distance of any point from its place at s, up to s + h [m]; FREE where none is known."""
        rear = self.path.rear_way(s, h, self.chord, self.last)
        return (h + rear) * (0.5 + self.radius / self.chord) if rear < FREE else FREE

    def corners(self, s: Floats) -> Floats:
        """Corners (N, 4, 2) at places (N,) [m]."""
        shape = (s.size, 2)
        position, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
        self.path.handles(paired(s), self.last, self.dragon.chords, 1.0, (position, velocity, speed), self.budget)
        self.budget.look()
        return bench_outlines(self.dragon, position)[:, 0]


def _swept(corners: Floats, moves: NDArray[np.bool_], flat: float) -> tuple[list[Floats], list[Floats], Floats]:
    """Ground of a bench between rows of corners (N, 4, 2): polygons that hold nearly all of it, other polygons, slips.

    moves: (N - 1,) cells in which it does not stay near its first place; flat: largest quarter of an edge's change for
    which the convex hull of its ends serves [m]
    The front edge, and the triangles of the sides that the ends of this edge leave behind, hold nearly all of it.
    """
    still = corners[:-1][~moves]
    core, rest, slips = [corners[:1], *still[:, None]], [corners[-1:]], np.zeros(len(corners) - 1)
    for i in range(4):
        p, q = corners[:, i], corners[:, (i + 1) % 4]
        (e_a, e_b), (p_a, p_b), (q_a, q_b) = ((row[:-1], row[1:]) for row in (q - p, p, q))
        twist, cross = 0.25 * np.linalg.norm(e_b - e_a, axis=1), _cross(e_a, e_b)
        straight = (twist <= flat) | (cross == 0.0)
        cross = np.where(straight, 1.0, cross)
        m_a, m_b = _cross(p_b - p_a, e_b) / cross, _cross(p_b - p_a, e_a) / cross
        convex = (np.maximum(m_a, m_b) < 0.0) | (np.minimum(m_a, m_b) > 1.0)
        inside = (np.minimum(m_a, m_b) >= 0.0) & (np.maximum(m_a, m_b) <= 1.0)
        apart = np.abs(m_b - m_a)
        slip = apart * twist * np.where(inside, 1.0, np.where(apart <= MIXED, BESIDES, np.inf))
        slip = np.where(straight, twist, np.where(convex, 0.0, slip))
        slips = np.maximum(slips, np.where(moves, slip, 0.0))
        whole, crossed = moves & (straight | convex), moves & ~(straight | convex)
        (rest if i else core).extend(_strips(np.stack([p_a, q_a, q_b, p_b], axis=1), whole))
        x = p_a + m_a[:, None] * e_a
        for front, a, b in ((i <= 1, p_a, p_b), (i == 3, q_a, q_b)):
            triangles, left = np.stack([x, a, b], axis=1), front & (_cross(e_a, b - a) > 0.0)
            core.extend(_strips(triangles, crossed & left))
            rest.extend(_strips(triangles, crossed & ~left))
    return core, rest, slips


def _strips(polygons: Floats, chosen: NDArray[np.bool_]) -> list[Floats]:
    """The chosen ones of polygons in order, split where one between them is not chosen."""
    kept = np.flatnonzero(chosen)
    return [polygons[run] for run in np.split(kept, np.flatnonzero(np.diff(kept) > 1) + 1) if run.size]


def _cross(a: Floats, b: Floats) -> Floats:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

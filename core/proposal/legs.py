"""Legs: ways of bounded curvature through the free ground, from a gate to a figure and from there to a gate.

A leg is the shortest of Dubins' six paths that stays on free ground, with the easiest bends first. Where obstacles
block all of them, a shortest way on the grid goes around: its corners are cut as far as one sees and rounded, and the
leg is a chain of such paths between the ends of its bends. It need not be the shortest leg there is. A walk from gate
to gate may also go straight on for a while at both ends, with one of Dubins' paths between: so it turns where there is
room, before or behind a channel that is too narrow for the grid. A channel beside the line of both gates is taken along
its middle, with such a walk before and behind it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property, partial
from itertools import product

import numpy as np
from numpy.typing import NDArray

from core.kernels import Budget
from core.paths.pieces import LENGTH_MIN
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.walks import Pose, Step, dubins, length_of, long_enough, moved, way_through
from core.values import Floats

# Distance of the points of a leg at which its room is measured [m].
STEP = 0.35
# Longest direct leg, in straight distances between its ends and with this added [1], [m]: a longer one goes astray.
DETOUR, DETOUR_MORE = 2.5, 25.0
# Parts of the distance of two gates for straight stretches of a walk, and of that of a gate and a channel [1].
STRETCHES, CHANNEL_STRETCHES = 12, 6
# Sine of the largest angle between the walls of a channel [1], by how much it may be wider than a bend needs [m], edges
# among which channels are looked for, and channels that are tried, those of the shortest way first [1].
PARALLEL, WIDER, CHANNEL_EDGES, CHANNELS_MOST = math.sin(math.radians(2.0)), 1.0, 400, 3
# Work of one leg that is measured [1], see core/kernels/constants.py.
LEG_WORK = 300.0


class LegFinder:
    """Legs of one dragon on one free ground. heedless: they may lead across edges"""

    def __init__(self, ground: FreeGround, needs: Needs, budget: Budget, *, heedless: bool = False) -> None:
        self.ground, self.needs, self.budget, self.heedless = ground, needs, budget, heedless
        self.sides = {radius: float(needs.sides(np.array([1.0 / radius]))[0]) for radius in needs.radii}
        self._legs: dict[tuple[Pose, Pose], list[Step] | None] = {}
        self._trees: dict[tuple[int, float], NDArray[np.int32]] = {}

    def leg(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A direct leg on free ground; None if all six paths leave it, for every radius."""
        if (begin, end) not in self._legs:
            self._legs[begin, end] = self._leg(begin, end)
        return self._legs[begin, end]

    def _leg(self, begin: Pose, end: Pose) -> list[Step] | None:
        longest = DETOUR * math.dist(begin[:2], end[:2]) + DETOUR_MORE
        for radius in self.needs.radii:
            for steps in dubins(begin, end, radius):
                if sum(length for length, _ in steps) > longest:
                    break
                if long_enough(steps) and self.free(begin, steps, radius):
                    return list(steps)
        return None

    def free(self, begin: Pose, steps: Sequence[Step], radius: float, *, eased: bool = False) -> bool:
        """True if benches on these steps have room everywhere, with margin and stray: that of a bend on it and for a
        chord before and after it, else that of a straight way.

        eased: before and after a bend only what a bench takes there whose other end is still on it, see _beside()
        """
        if self.heedless:
            return True
        self.budget.afford(LEG_WORK)
        points, travel = points_along(begin, steps)
        straight = self.needs.straight_side + self.needs.free
        least, ends = np.full(len(points), straight), np.cumsum([0.0, *(length for length, _ in steps)])
        for (length, curvature), start in zip(steps, ends[:-1].tolist(), strict=True):
            if curvature != 0.0 and length > 0.0:
                away = np.maximum(start - travel, travel - start - length)
                near = away <= (0.0 if eased else self.needs.chord)
                least[near] = self.sides[radius] + self.needs.free
                if eased:
                    least = np.maximum(least, straight + self._beside(away, radius))
        lack = least - self.ground.nearest_node(points[:, 0], points[:, 1])
        if lack.max() > self.ground.node_error:
            return False
        near = lack > -self.ground.node_error
        return bool(not near.any() or (self.ground.clearance(points[near]) >= least[near]).all())

    def _beside(self, away: Floats, radius: float) -> Floats:
        """Ground that a bench takes beside a straight way at these distances before or after a bend, besides that of a
        straight bench, nearly (N,) [m].

        With its front handle f after the end of the bend, a bench of chord c has its rear handle (c - f)^2 / 2 R beside
        the straight line; p after the end the bench is (f - p) / c of that beside it, most for f = p + (c - p) / 3, and
        its end, an overhang o before the handle, o / c of it to the other side.
        """
        chord, overhang = self.needs.chord, self.needs.overhang
        left = np.clip(chord - away, 0.0, chord)
        beside: Floats = (2.0 / 27.0 * left + 0.5 * overhang) * left**2 / (radius * chord)
        return beside

    def around(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A leg around obstacles; None if the grid has no way, or benches cannot follow it."""
        if (steps := self.leg(begin, end)) is not None:
            return steps
        reach = self.needs.radii[-1]
        ahead, before = moved(begin, (reach, 0.0))[:2], moved(end, (-reach, 0.0))[:2]
        # Ways on which benches can turn anywhere, then those that have room for straight benches.
        for room in (self.sides[self.needs.radii[-1]], self.needs.straight_side):
            line = self._line(ahead, before, room + self.needs.free)
            if line is None:
                continue
            for radius in self.needs.radii:
                chain = self._chain([begin, *_bends(line, radius), end])
                if chain is not None:
                    return chain
        return None

    def walk(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A leg that is straight for a while at both ends, the easiest bends first; None if none stays on free ground.

        The stretches are those to the crossing of both straight lines, rounded by one bend, or parts of the distance.
        """
        for radius in self.needs.radii:
            if (steps := self._walk(begin, end, radius, STRETCHES)) is not None:
                return steps
        return self._through(begin, end)

    def _walk(self, begin: Pose, end: Pose, radius: float, stretches: int, *, eased: bool = False) -> list[Step] | None:
        """A walk with bends of a radius [m], whose straight stretches are parts of the distance; None without one.

        eased: see free()
        """
        part = math.dist(begin[:2], end[:2]) / stretches
        counts = sorted(product(range(stretches), repeat=2), key=sum)
        parts = [(part * a, part * b) for a, b in counts if a + b < stretches]
        for before, after in [*_to_corner(begin, end, radius), *parts]:
            first, last = moved(begin, (before, 0.0)), moved(end, (-after, 0.0))
            for path in dubins(first, last, radius):
                steps = [(before, 0.0), *path, (after, 0.0)]
                if length_of(steps) > DETOUR * part * stretches:
                    break
                if long_enough(steps) and self.free(begin, steps, radius, eased=eased):
                    return steps
        return None

    def _through(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A walk through the middle of a channel, with bends before and behind it; None without one.

        The bends end a chord before the channel, or half of one, or where it begins.
        """
        if self.heedless:
            return None

        ahead = np.array(end[:2]) - begin[:2]
        along = [one for one in self.channels if ahead @ (math.cos(one[0][2]), math.sin(one[0][2])) >= 0.0]
        channels = sorted(along, key=partial(way_through, begin, end))[:CHANNELS_MOST]
        leads = (self.needs.chord, 0.5 * self.needs.chord, 0.0)
        for eased, radius, (entry, length), lead in product((False, True), self.needs.radii, channels, leads):
            first = self._walk(begin, moved(entry, (-lead, 0.0)), radius, CHANNEL_STRETCHES, eased=eased)
            if first is None:
                continue
            last = self._walk(moved(entry, (length + lead, 0.0)), end, radius, CHANNEL_STRETCHES, eased=eased)
            if last is None:
                continue
            steps = [*first, (length + 2.0 * lead, 0.0), *last]
            if long_enough(steps) and self.free(begin, steps, radius, eased=eased):
                return steps
        return None

    @cached_property
    def channels(self) -> list[tuple[Pose, float]]:
        """Straight channels between two edges that face each other, in both directions: the pose at the beginning of
        the middle line, and its length [m]."""
        edges = self.ground.edges
        way = edges[:, 2:] - edges[:, :2]
        lengths = np.hypot(*way.T)
        if len(edges) > CHANNEL_EDGES:
            return []
        self.budget.afford(float(len(edges) ** 2))
        ahead = way / lengths[:, None]
        least = 2.0 * (self.needs.straight_side + self.needs.free)
        most = 2.0 * (max(self.sides.values()) + self.needs.free) + WIDER
        found: list[tuple[Pose, float]] = []
        for k, (u, start) in enumerate(zip(ahead, edges[:, :2], strict=True)):
            side = np.array([-u[1], u[0]])
            gaps = (0.5 * (edges[:, :2] + edges[:, 2:]) - start) @ side
            ends = np.sort(np.stack([(edges[:, :2] - start) @ u, (edges[:, 2:] - start) @ u]), axis=0)
            low, high = np.maximum(ends[0], 0.0), np.minimum(ends[1], lengths[k])
            facing = (np.abs(ahead @ side) < PARALLEL) & (least <= np.abs(gaps)) & (np.abs(gaps) <= most) & (low < high)
            for j in np.flatnonzero(facing[k + 1 :]) + k + 1:
                found += self._middle(start + 0.5 * gaps[j] * side, u, float(low[j]), float(high[j]))
        return found

    def _middle(self, start: Floats, ahead: Floats, low: float, high: float) -> list[tuple[Pose, float]]:
        """The line from `low` to `high` ahead of a point, from each end, if straight benches have room on it."""
        count = max(2, math.ceil((high - low) / STEP) + 1)
        line = start + np.linspace(low, high, count)[:, None] * ahead
        self.budget.afford(LEG_WORK)
        if self.ground.clearance(line).min() < self.needs.straight_side + self.needs.free:
            return []
        heading = math.atan2(ahead[1], ahead[0])
        ends = ((line[0], heading), (line[-1], heading + math.pi))
        return [((float(x), float(y), math.remainder(one, math.tau)), high - low) for (x, y), one in ends]

    def _chain(self, poses: Sequence[Pose]) -> list[Step] | None:
        """Direct legs from pose to pose; None if one is blocked."""
        steps: list[Step] = []
        pose = poses[0]
        for target in poses[1:]:
            one = self.leg(pose, target)
            if one is None:
                return None
            steps += one
            for step in one:
                pose = moved(pose, step)
        return steps

    def _node(self, point: tuple[float, float], room: float) -> int:
        """The node of the grid with room that is next to a point; -1 without one nearby."""
        nodes, ground = self.ground.node_points(), self.ground
        distance = np.hypot(*(nodes - point).T)
        distance[ground.field.reshape(-1) < room] = math.inf
        k = int(distance.argmin())
        return k if distance[k] < 4.0 * ground.spacing + self.needs.chord else -1

    def _line(self, begin: tuple[float, float], end: tuple[float, float], room: float) -> Floats | None:
        """Corners (N, 2) of a way on the grid between two points, with this clearance [m]; None if there is none."""
        first, last = self._node(begin, room), self._node(end, room)
        if min(first, last) < 0:
            return None
        before = self._tree(first, room)
        way = [last]
        while way[-1] != first:
            way.append(int(before[way[-1]]))
            if way[-1] < 0:
                return None
        points = np.concatenate([[begin], self.ground.node_points()[way[::-1]], [end]])
        kept, k = [points[0]], 0
        while k < len(points) - 1:
            seen = next(
                j for j in range(len(points) - 1, k, -1) if j == k + 1 or self._visible(points[k], points[j], room)
            )
            kept.append(points[seen])
            k = seen
        return np.array(kept)

    def _visible(self, a: Floats, b: Floats, room: float) -> bool:
        way = np.linspace(0.0, 1.0, int(np.hypot(*(b - a)) / (0.5 * self.ground.spacing)) + 2)[:, None]
        return bool(self.ground.roughly(a + way * (b - a)).min() >= room)

    def _tree(self, first: int, room: float) -> NDArray[np.int32]:
        """Node before each node on the shortest ways from the first one, -9999 for nodes out of reach."""
        if (first, room) not in self._trees:
            from scipy.sparse import coo_matrix  # type: ignore[import-untyped]
            from scipy.sparse.csgraph import dijkstra  # type: ignore[import-untyped]

            free = self.ground.field >= room
            numbers = np.arange(free.size).reshape(free.shape)
            rows, columns, ways = [], [], []
            for di, dj in ((1, 0), (0, 1), (1, 1), (1, -1)):
                a = (slice(0, free.shape[0] - di), slice(max(0, -dj), free.shape[1] - max(0, dj)))
                b = (slice(di, None), slice(max(0, dj), free.shape[1] - max(0, -dj)))
                both = free[a] & free[b]
                rows.append(numbers[a][both])
                columns.append(numbers[b][both])
                ways.append(np.full(int(both.sum()), math.hypot(di, dj)))
            edges = (np.concatenate(ways), (np.concatenate(rows), np.concatenate(columns)))
            graph = coo_matrix(edges, shape=(free.size, free.size)).tocsr()
            self.budget.afford(float(free.size))
            _, self._trees[first, room] = dijkstra(graph, directed=False, indices=first, return_predecessors=True)
        return self._trees[first, room]


def _to_corner(begin: Pose, end: Pose, radius: float) -> list[tuple[float, float]]:
    """Lengths of the straight stretches before and after one bend of a radius that leads from pose to pose [m]; empty
    without one."""
    turn = math.remainder(end[2] - begin[2], math.tau)
    if abs(math.sin(turn)) < LENGTH_MIN:
        return []
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    cut = radius * abs(math.tan(0.5 * turn))
    before = (dx * math.sin(end[2]) - dy * math.cos(end[2])) / math.sin(turn) - cut
    after = (dy * math.cos(begin[2]) - dx * math.sin(begin[2])) / math.sin(turn) - cut
    return [(before, after)] if min(before, after) >= 0.0 else []


def _bends(line: Floats, radius: float) -> list[Pose]:
    """The poses before and after each corner of a line (N, 2) that an arc of a radius rounds [m]; the middle of a
    corner whose stretches are too short for the arc."""
    poses: list[Pose] = []
    for a, b, c in zip(line[:-2], line[1:-1], line[2:], strict=True):
        before, after = (math.atan2(*(q - p)[::-1]) for p, q in ((a, b), (b, c)))
        turn = math.remainder(after - before, math.tau)
        cut = radius * abs(math.tan(0.5 * turn))
        if cut > 0.49 * min(float(np.hypot(*(b - a))), float(np.hypot(*(c - b)))):
            poses.append((float(b[0]), float(b[1]), before + 0.5 * turn))
            continue
        for way, heading in ((-cut, before), (cut, after)):
            poses.append(moved((float(b[0]), float(b[1]), heading), (way, 0.0)))
    return poses


def points_along(pose: Pose, steps: Sequence[Step], step: float = STEP) -> tuple[Floats, Floats]:
    """Points (N, 2) along steps from a pose, at most `step` apart, and their ways from it (N,) [m]."""
    parts, travels, travel = [], [], 0.0
    for length, curvature in steps:
        s = np.linspace(0.0, length, max(2, math.ceil(length / step) + 1))
        x, y, heading = pose
        if curvature == 0.0:
            part = np.stack([x + s * math.cos(heading), y + s * math.sin(heading)], axis=-1)
        else:
            turned, radius = heading + s * curvature, 1.0 / curvature
            part = np.stack(
                [
                    x + radius * (np.sin(turned) - math.sin(heading)),
                    y - radius * (np.cos(turned) - math.cos(heading)),
                ],
                axis=-1,
            )
        parts.append(part)
        travels.append(travel + s)
        pose, travel = moved(pose, (length, curvature)), travel + length
    return np.concatenate(parts), np.concatenate(travels)

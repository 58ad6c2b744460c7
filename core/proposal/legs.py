"""Legs: ways of bounded curvature through the free ground, from a gate to a figure and from there to a gate.

A leg is the shortest of Dubins' six paths that stays on free ground, with the easiest bends first. Where obstacles
block all of them, a shortest way on the grid goes around: its corners are cut as far as one sees and rounded, and the
leg is a chain of such paths between the ends of its bends. It need not be the shortest leg there is. A walk from gate
to gate may also go straight on for a while at both ends, with one of Dubins' paths between: so it turns where there is
room, before or behind a channel that is too narrow for the grid.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from core.kernels import Budget
from core.paths.pieces import LENGTH_MIN
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.walks import Pose, Step, dubins, length_of, long_enough, moved
from core.values import Floats

# Distance of the points of a leg at which its room is measured [m].
STEP = 0.35
# Longest direct leg, in straight distances between its ends and with this added [1], [m]: a longer one goes astray.
DETOUR, DETOUR_MORE = 2.5, 25.0
# Parts into which the distance of two gates is divided for straight stretches of a walk [1].
STRETCHES = 12
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

    def free(self, begin: Pose, steps: Sequence[Step], radius: float) -> bool:
        """True if benches on these steps have room everywhere, with margin and stray: that of a bend on it and for a
        chord before and after it, else that of a straight way."""
        if self.heedless:
            return True
        self.budget.afford(LEG_WORK)
        points, travel = points_along(begin, steps)
        straight = self.needs.straight_side + self.needs.free
        least, ends = np.full(len(points), straight), np.cumsum([0.0, *(length for length, _ in steps)])
        for (length, curvature), start in zip(steps, ends[:-1].tolist(), strict=True):
            if curvature != 0.0 and length > 0.0:
                near = np.maximum(start - travel, travel - start - length) <= self.needs.chord
                least[near] = self.sides[radius] + self.needs.free
        lack = least - self.ground.nearest_node(points[:, 0], points[:, 1])
        if lack.max() > self.ground.node_error:
            return False
        near = lack > -self.ground.node_error
        return bool(not near.any() or (self.ground.clearance(points[near]) >= least[near]).all())

    def around(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A leg around obstacles; None if the grid has no way, or benches cannot follow it."""
        if (steps := self.leg(begin, end)) is not None:
            return steps
        reach = self.needs.radii[-1]
        ahead = (begin[0] + reach * math.cos(begin[2]), begin[1] + reach * math.sin(begin[2]))
        before = (end[0] - reach * math.cos(end[2]), end[1] - reach * math.sin(end[2]))
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
        part = math.dist(begin[:2], end[:2]) / STRETCHES
        counts = sorted(product(range(STRETCHES), repeat=2), key=sum)
        parts = [(part * a, part * b) for a, b in counts if a + b < STRETCHES]
        for radius in self.needs.radii:
            for before, after in [*_to_corner(begin, end, radius), *parts]:
                first, last = moved(begin, (before, 0.0)), moved(end, (-after, 0.0))
                for path in dubins(first, last, radius):
                    steps = [(before, 0.0), *path, (after, 0.0)]
                    if length_of(steps) > DETOUR * part * STRETCHES:
                        break
                    if long_enough(steps) and self.free(begin, steps, radius):
                        return steps
        return None

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
            poses.append((float(b[0]) + way * math.cos(heading), float(b[1]) + way * math.sin(heading), heading))
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

"""Legs that turn in the open and are straight in channels: from gate to gate, or from a gate to a figure.

A stretch is a straight way with room for straight benches: ahead of a gate, back from the other, or along the middle of
a channel. It is left, and entered, where one side of it opens, or a part of a chord before or behind that place. From
stretch to stretch leads one of Dubins' paths, and the shortest chain of them is the leg. Room is measured bench by
bench, as a bend beside the wall of a channel needs little on its outer side.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from heapq import heappop, heappush

import numpy as np

from core.proposal.bent_ways import backwards, bent_ways
from core.proposal.footprint import DENSE, SPAN, room_beside, standing
from core.proposal.legs import DETOUR, LEG_WORK, STEP, LegFinder, points_along
from core.proposal.walks import Pose, Step, dubins, length_of, long_enough, moved, way_through
from core.values import Floats, Point

# Distance of benches that are measured [m].
BENCH_STEP = 0.3
# Room that a leg has besides, for what is between the benches that are measured [m].
SPARE = 0.003
# Bends begin this far behind the place where a side opens, in chords, the most convenient first; and at parts of a
# stretch [1].
LEADS, PARTS = (1.0, 0.5, 1.5, 0.0), 6
# Radius of a gentle bend, in easy ones [1]: benches need less room outside it, so it fits beside the wall of a channel.
GENTLE = 1.7
# Places at which a stretch is left or entered, channels, and chains of channels that are looked at for one leg [1].
PLACES_MOST, CHANNELS_NEAR, CHAINS_MOST = 10, 8, 24
# Most corners of a way on the grid that becomes a bent way; work of measuring one, besides 1 for each bench and edge,
# and of all that are measured for one leg [1], see core/kernels/constants.py: 4 s.
CORNERS_MOST, MEASURED_WORK, BENT_WORK = 6, 7e3, 2e7
# Work of one leg that is measured bench by bench, for each edge [1], see core/kernels/constants.py.
BENCH_WORK = 60.0


@dataclass(frozen=True)
class StraightWay:
    """A straight way. first, last: poses at its ends; into, out: ways before its first pose at which it is entered, and
    behind its last one at which it is left, each with a rank, the most convenient one 0 [m]"""

    first: Pose
    last: Pose
    into: tuple[tuple[int, float], ...] = ((0, 0.0),)
    out: tuple[tuple[int, float], ...] = ((0, 0.0),)

    @property
    def length(self) -> float:
        """From the first pose to the last one [m]."""
        return math.dist(self.first[:2], self.last[:2])


class ChannelLegFinder(LegFinder):
    """Legs that are straight in channels, where there is no other one."""

    def free(self, begin: Pose, steps: Sequence[Step], radius: float, *, eased: bool = False) -> bool:
        """True if benches on these steps, and on a straight way before and behind, have room with margin and stray."""
        points, _ = points_along(begin, steps)
        self.budget.afford(LEG_WORK)
        least = self.needs.straight_side + self.needs.free
        if (self.ground.nearest_node(*points.T) < least - self.ground.node_error).any():
            return False
        if self.ground.clearance(points).min() < least:
            return False
        return bool(self.rooms(begin, steps).min() >= self.needs.free + SPARE)

    def rooms(self, begin: Pose, steps: Sequence[Step]) -> Floats:
        """Room of benches on these steps, and on a straight way before and behind (N,) [m]."""
        reach = SPAN * self.needs.chord
        points, s = points_along(moved(begin, (-reach, 0.0)), [(reach, 0.0), *steps, (self.needs.chord, 0.0)], DENSE)
        self.budget.afford(BENCH_WORK * len(self.ground.edges))
        fronts = np.linspace(reach, s[-1], max(2, math.ceil((s[-1] - reach) / BENCH_STEP)))
        return room_beside(self.ground, self.needs, *standing(s, points, fronts, self.needs.chord))

    def around(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A leg around obstacles, or straight through channels and with bends between."""
        if (begin, end) not in self._ways:
            self._ways[begin, end] = super().around(begin, end) or self._chained(begin, end)
        return self._ways[begin, end]

    def walk(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A leg around obstacles, or straight through channels and with bends between, or a bent way."""
        return self.around(begin, end) or self._bent_way(begin, end)

    def _bent_way(self, begin: Pose, end: Pose) -> list[Step] | None:
        """A bent way from gate to gate, looked for once for both directions; None if none has room."""
        there, back = (begin[:2], end[:2]), (end[:2], begin[:2])
        if there not in self.bent:
            line = self._line(*there, self.needs.straight_side + self.needs.free)
            found = None
            if line is not None and len(line) <= CORNERS_MOST + 2:
                length = float(np.hypot(*(line[1:] - line[:-1]).T).sum())
                work = MEASURED_WORK + len(self.ground.edges) * length / BENCH_STEP

                def rooms(pose: Pose, steps: Sequence[Step]) -> Floats:
                    self.budget.afford(work)
                    return self.rooms(pose, steps)

                ways = bent_ways((begin, end), line, self._outwards(line), self.needs, rooms, int(BENT_WORK / work))
                found = next((steps for steps in ways if self.free(begin, steps, self.needs.tight)), None)
            self.bent[there] = found
            self.bent[back] = None if found is None else backwards(found)
        return self.bent[there]

    def _outwards(self, line: Floats) -> Floats:
        """From each inner corner of a line to the edge outside its bend (N, 2), a chord at most [m]."""
        ways = []
        for a, b, c in zip(line[:-2], line[1:-1], line[2:], strict=True):
            before, after = b - a, c - b
            out = before / np.hypot(*before) - after / np.hypot(*after)
            heading = math.atan2(out[1], out[0])
            far = min(float(self._room_to(b[None], heading)[0]), self.needs.chord)
            ways.append((far * math.cos(heading), far * math.sin(heading)))
        return np.array(ways).reshape(-1, 2)

    @cached_property
    def _ways(self) -> dict[tuple[Pose, Pose], list[Step] | None]:
        return {}

    @cached_property
    def bent(self) -> dict[tuple[Point, Point], list[Step] | None]:
        """The bent ways that were looked for, by the places of their ends."""
        return {}

    @cached_property
    def _outs(self) -> dict[Pose, tuple[tuple[int, float], ...]]:
        return {}

    def _chained(self, begin: Pose, end: Pose) -> list[Step] | None:
        """The shortest chain of stretches and legs between them; None if none was found.

        A chain is looked at in the order of a lower bound of its length, that of straight ways to the next stretch, and
        comes back with its own length once the leg to this stretch is found.
        """
        stretches = [StraightWay(begin, begin, out=self._left(begin)), *self._between(begin, end)]
        stretches.append(StraightWay(end, end, into=self._left(_back(end))))
        goal, reached, looked = len(stretches) - 1, {0: 0.0}, 0
        queue: list[tuple[float, int, int, int, list[Step]]] = []
        count = 0

        def look_from(k: int, length: float, steps: list[Step]) -> None:
            nonlocal count
            for j, other in enumerate(stretches[1:], start=1):
                if j not in reached:
                    count += 1
                    bound = length + math.dist(stretches[k].last[:2], other.first[:2]) + other.length
                    heappush(queue, (round(bound, 6), count, k, j, steps))

        legs: dict[tuple[int, int], list[Step] | None] = {}
        look_from(0, 0.0, [])
        while queue and looked < CHAINS_MOST:
            _, order, k, j, steps = heappop(queue)
            if k < 0:
                if j not in reached:
                    reached[j] = length_of(steps)
                    if j == goal:
                        return steps if long_enough(steps) else None
                    look_from(j, reached[j], steps)
                continue
            if j in reached or (k, j) in legs:
                continue
            looked += 1
            legs[k, j] = leg = self._to_next(stretches[k], stretches[j])
            if leg is not None:
                whole = [*steps, *leg, (stretches[j].length, 0.0)]
                heappush(queue, (round(length_of(whole), 6), order, -1, j, whole))
        return None

    def _to_next(self, one: StraightWay, other: StraightWay) -> list[Step] | None:
        """The leg from the end of a stretch to the beginning of the next one, the easiest bends first and a gentle one,
        which takes the most ground, last."""
        pairs = sorted((a + b, out + into, out, into) for a, out in one.out for b, into in other.into)
        for radius in (*self.needs.radii, GENTLE * self.needs.radii[0]):
            for _, _, out, into in pairs:
                first, last = moved(one.last, (out, 0.0)), moved(other.first, (-into, 0.0))
                longest = DETOUR * (math.dist(first[:2], last[:2]) + radius)
                for path in dubins(first, last, radius):
                    if length_of(path) > longest:
                        break
                    steps = [(out, 0.0), *path, (into, 0.0)]
                    if long_enough(steps) and self.free(first, path, radius):
                        return steps
        return None

    def _between(self, begin: Pose, end: Pose) -> list[StraightWay]:
        """The channels that are nearest to the way between two poses."""

        stretches = []
        for entry, length in sorted(self.channels, key=partial(way_through, begin, end))[:CHANNELS_NEAR]:
            last = moved(entry, (length, 0.0))
            stretches.append(StraightWay(entry, last, self._left(_back(entry)), self._left(last)))
        return stretches

    def _left(self, pose: Pose) -> tuple[tuple[int, float], ...]:
        """Ways straight ahead of a pose after which benches may turn, with their ranks [m]: behind places where the
        ground beside is at least a chord wide, and at parts of the way."""
        if pose not in self._outs:
            self._outs[pose] = self._places(pose)
        return self._outs[pose]

    def _places(self, pose: Pose) -> tuple[tuple[int, float], ...]:
        extent = math.hypot(*(self.ground.high - self.ground.low))
        points, t = points_along(pose, [(extent, 0.0)])
        self.budget.afford(LEG_WORK + BENCH_WORK * len(self.ground.edges))
        narrow = np.flatnonzero(self.ground.clearance(points) < self.needs.straight_side + self.needs.free)
        count = int(narrow[0]) if len(narrow) else len(t)
        if count < 2:
            return ((0, 0.0),)
        most, places = float(t[count - 1]), []
        for side in (0.5 * math.pi, -0.5 * math.pi):
            wide = self._room_to(points[:count], pose[2] + side) >= self.needs.chord
            opens = t[:count][wide & ~np.concatenate([[False], wide[:-1]])]
            places += [(rank, float(at) + lead * self.needs.chord) for at in opens for rank, lead in enumerate(LEADS)]
        places += [(len(LEADS), most * part / PARTS) for part in range(PARTS)]
        kept: dict[float, int] = {}
        for rank, place in sorted(places):
            if place <= most and all(abs(place - other) > STEP for other in kept):
                kept[place] = rank
        return tuple((rank, place) for place, rank in list(kept.items())[:PLACES_MOST])

    def _room_to(self, points: Floats, heading: float) -> Floats:
        """Way from points (N, 2) to the nearest edge in a direction (N,) [m]; infinite without one."""
        u = np.array([math.cos(heading), math.sin(heading)])
        side = np.array([-u[1], u[0]])
        a, b = self.ground.edges[:, :2], self.ground.edges[:, 2:]
        p, q = (a - points[:, None]) @ side, (b - points[:, None]) @ side
        crosses = (p > 0.0) != (q > 0.0)
        part = p / np.where(crosses, p - q, 1.0)
        way = (a - points[:, None]) @ u + part * ((b - a) @ u)
        nearest: Floats = np.where(crosses & (way >= 0.0), way, math.inf).min(axis=1)
        return nearest


def _back(pose: Pose) -> Pose:
    """The pose turned around."""
    return (pose[0], pose[1], pose[2] + math.pi)

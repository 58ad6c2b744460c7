"""The free ground of a venue: how far a point is from every edge, exactly, and on a grid for many points at once.

The distance from the nearest edge, positive on free ground and negative elsewhere, changes by at most the way that a
point moves. So one value bounds it all around, which gives a proven bound for the widest free circle. The obstacles
that shapely.maximum_inscribed_circle() does not know, and that bound, are the reasons for computing it here.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from core.values import Floats
from core.venue import Venue

# Pairs of a point and an edge that are computed at once, which bounds the memory [1].
PAIRS_AT_ONCE = 200_000
# Nodes along the longer side of the grid, and pairs of a node and an edge in all [1].
NODES, NODE_PAIRS = 96, 4_000_000
# Cells into which the grid is divided at most [1].
CELLS_MAX = 16_000_000
# Accuracy of the bound of the widest circle's radius, and size of a cell from which on it is divided no more [m].
WIDEST, SMALLEST = 0.005, 0.002


class FreeGround:
    """The square of a venue without its obstacles.

    edges: (E, 4) x, y, x, y [m]; low, high: corners of the box around the square's own edges [m], or of a given box
    spacing: of the grid [m]; field: clearance at its nodes (nx, ny) [m]
    """

    def __init__(self, venue: Venue, box: tuple[Floats, Floats] | None = None) -> None:
        areas = [area.edges for area in venue.areas]
        self.edges = np.concatenate(areas)
        self._firsts = np.cumsum([0, *map(len, areas[:-1])])
        ends = areas[0].reshape(-1, 2)
        self.low: Floats = ends.min(axis=0) if box is None else box[0]
        self.high: Floats = ends.max(axis=0) if box is None else box[1]
        width, height = (self.high - self.low).tolist()
        count = max(12.0, min(float(NODES), math.sqrt(NODE_PAIRS / len(self.edges))))
        self.spacing = max(width, height) / count
        self.nodes = tuple(math.ceil(side / self.spacing) + 1 for side in (width, height))
        self.field = self.clearance(self.node_points()).reshape(self.nodes)

    def node_points(self) -> Floats:
        """Places of the nodes of the grid, (nx ny, 2) [m]."""
        axes = [low + self.spacing * np.arange(n) for low, n in zip(self.low.tolist(), self.nodes, strict=True)]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)

    @property
    def area(self) -> float:
        """Area of the square without its holes [m2], which obstacles may cover in part."""
        x1, y1, x2, y2 = self.edges[: self._firsts[1] if len(self._firsts) > 1 else None].T
        rings = np.flatnonzero((x1[1:] != x2[:-1]) | (y1[1:] != y2[:-1])) + 1
        parts = [abs(float(part.sum())) for part in np.split(0.5 * (x1 * y2 - x2 * y1), rings)]
        return float(parts[0] - sum(parts[1:]))

    def clearance(self, points: Floats) -> Floats:
        """Distance of points (N, 2) from the nearest edge (N,) [m]: negative outside the square and in an obstacle."""
        points = np.asarray(points, dtype=np.float64)
        step = max(1, PAIRS_AT_ONCE // len(self.edges))
        parts = [self._clearance(points[k : k + step]) for k in range(0, len(points), step)]
        return np.concatenate(parts) if parts else np.empty(0)

    def _clearance(self, points: Floats) -> Floats:
        x1, y1, x2, y2 = self.edges.T
        x, y = points[:, :1], points[:, 1:]
        dx, dy = x2 - x1, y2 - y1
        along = np.clip(((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
        distance = np.sqrt(((x - x1 - along * dx) ** 2 + (y - y1 - along * dy) ** 2).min(axis=1))
        # A ray to the right crosses the edges of an area an odd number of times from a point inside it.
        spans = (y1 > y) != (y2 > y)
        level = np.where(dy == 0.0, 1.0, dy)
        crossed: NDArray[np.bool_] = spans & (x < x1 + (y - y1) * dx / level)
        within = np.add.reduceat(crossed, self._firsts, axis=1, dtype=np.int64) % 2 == 1
        free = within[:, 0] & ~within[:, 1:].any(axis=1)
        signed: Floats = np.where(free, distance, -distance)
        return signed

    def roughly(self, points: Floats) -> Floats:
        """Clearance of points (..., 2) from the grid (...) [m], too large or too small by half a spacing at most."""
        place = (points - self.low) / self.spacing
        most = np.array(self.nodes) - 1.000001
        held = np.clip(place, 0.0, most)
        beyond = np.abs(place - held).max(axis=-1) * self.spacing
        i, j = held[..., 0].astype(np.int64), held[..., 1].astype(np.int64)
        u, v = held[..., 0] - i, held[..., 1] - j
        field = self.field
        low = field[i, j] * (1.0 - u) + field[i + 1, j] * u
        high = field[i, j + 1] * (1.0 - u) + field[i + 1, j + 1] * u
        value: Floats = low * (1.0 - v) + high * v - beyond
        return value

    def nearest_node(self, x: Floats, y: Floats) -> Floats:
        """Clearance of the nodes next to points (...) [m]: no further from that of the points than `node_error`."""
        spacing, (nx, ny) = self.spacing, self.nodes
        i = np.clip(((x - self.low[0]) / spacing + 1.5).astype(np.int32), 0, nx + 1)
        j = np.clip(((y - self.low[1]) / spacing + 1.5).astype(np.int32), 0, ny + 1)
        clearance: Floats = self._framed.take(i * (ny + 2) + j)
        return clearance

    @cached_property
    def _framed(self) -> Floats:
        """The field with one more node on all sides, all outside the square."""
        framed: Floats = np.pad(self.field, 1, constant_values=-float((self.high - self.low).max())).reshape(-1)
        return framed

    @property
    def node_error(self) -> float:
        """Largest distance of a point from the node next to it [m]."""
        return float(self.spacing * math.sqrt(0.5))

    def is_parted(self, begins: Floats, ends: Floats, room: float) -> bool:
        """True if it is proven that no way leads from one box to another with this clearance everywhere [m]; False if
        there is one, or if neither is proven. begins, ends: points (N, 2) around each of which the box is the least [m]

        No clearance in a square cell exceeds that of its middle by more than half its diagonal h, nor falls short of it
        by more. So a way runs through cells whose middle has at least `room` - h, from each to one of its eight
        neighbours; and if cells whose middle has at least `room` + h lead from one end to the other, a way does. Cells
        between are divided by four.
        """
        from scipy.ndimage import label  # type: ignore[import-untyped]

        spacing, corner, middle = self.spacing, self.low, self.field
        possible, certain = np.ones_like(middle, bool), np.zeros_like(middle, bool)

        def joined(cells: NDArray[np.bool_]) -> bool:
            parts = label(cells, structure=np.ones((3, 3)))[0]
            most = np.array(parts.shape) - 1
            reached = []
            for points in (begins, ends):
                places = np.clip(np.rint((points - corner) / spacing).astype(np.int64), 0, most)
                (i, j), (m, n) = places.min(axis=0), places.max(axis=0)
                reached.append(set(parts[i : m + 1, j : n + 1].flat) - {0})
            return not reached[0].isdisjoint(reached[1])

        while True:
            half = spacing * math.sqrt(0.5)
            possible &= certain | (middle >= room - half)
            certain |= possible & (middle >= room + half)
            if not joined(possible):
                return True
            if spacing < SMALLEST or joined(certain):
                return False
            divided = np.repeat(np.repeat(possible & ~certain, 2, axis=0), 2, axis=1)
            cells = np.argwhere(divided)
            if len(cells) * len(self.edges) > NODE_PAIRS or divided.size > CELLS_MAX:
                return False
            possible, certain = (np.repeat(np.repeat(part, 2, axis=0), 2, axis=1) for part in (possible, certain))
            corner, spacing = corner - 0.25 * spacing, 0.5 * spacing
            middle = np.zeros(divided.shape)
            middle[divided] = self.clearance(corner + spacing * cells)

    @cached_property
    def widest_circle(self) -> tuple[float, float, float, float]:
        """The widest free circle: centre x, y, radius, and a proven upper bound of the radius [m].

        Branch and bound: in a square cell with half diagonal h no clearance exceeds that of its middle by more than h.
        """
        half = 0.5 * self.spacing
        cells, values = self.node_points(), self.field.reshape(-1)
        best = int(values.argmax())
        place, radius = cells[best], float(values[best])
        while True:
            reach = half * math.sqrt(2.0)
            kept = values + reach > radius + WIDEST
            if not kept.any() or reach < WIDEST:
                return float(place[0]), float(place[1]), radius, float(max(radius + WIDEST, 0.0))
            half *= 0.5
            cells = quartered(cells[kept], half)
            values = self.clearance(cells)
            if values.max() > radius:
                best = int(values.argmax())
                place, radius = cells[best], float(values[best])


def quartered(middles: Floats, half: float) -> Floats:
    """The middles (4 N, 2) of the quarters of square cells (N, 2). half: the side of a quarter, halved [m]"""
    corners = half * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])
    return (middles[:, None] + corners).reshape(-1, 2)

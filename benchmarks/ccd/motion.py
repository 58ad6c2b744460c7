"""The motion for every engine: places of benches, in doubles, and a proven bound on their acceleration.

Time runs from 0 to 1 over a query, and the head travels `span` metres at a constant speed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from benchmarks.ccd.dances import Record, dance_of
from core import kernels
from core.contact.search import ContactSearch, SearchInput
from core.kernels.constants import (
    CENTRE_PULL,
    ERROR,
    HALF_LENGTH,
    HALF_WIDTH,
    MX,
    MY,
    OMEGA_PULL,
    RADIUS,
    UX,
    UY,
)
from core.values import Floats

# Signs along and to the left of the corners of a bench, FRONT_LEFT to REAR_LEFT of core/kernels/constants.py.
CORNERS = ((1, 1), (1, -1), (-1, -1), (-1, 1))
# The corners at the ends of each edge: front, right, rear, left.
EDGE_ENDS = ((0, 1), (1, 2), (2, 3), (3, 0))
# The directions outwards of the edges, in the frame of their bench.
OUTWARDS = ((1, 0), (0, -1), (-1, 0), (0, 1))
Point = tuple[float, float]


class Query(NamedTuple):
    """A question: does a corner of one bench meet an edge of another during a travel of the head, and when first?

    The edge is moved outwards by the margin, as if its bench were wider there; over the whole way the corner is beside
    it, never beyond one of its ends.

    place: the kernels' place of the head at the beginning [m]: arc length to the centre of a spiral, -s on a route
    span: the way of the head [m]; corner, edge: numbers as in CORNERS and EDGE_ENDS; margin: [m]
    """

    place: float
    span: float
    corner_bench: int
    corner: int
    edge_bench: int
    edge: int
    margin: float


class Stage:
    """A dance, and room for its chains; used for many queries."""

    def __init__(self, record: Record) -> None:
        self.dance = dance_of(record)
        self.search = ContactSearch(SearchInput(self.dance.dragon, self.dance.path, 0.0))
        self.sizes, self.chain = self.search.sizes, self.search.opening

    def lay(self, place: float, last: int) -> Floats:
        """Rows of the handles up to the last with the head at a place."""
        kernels.place_chain(self.search.curve, place, last, self.sizes, self.chain)
        return self.chain


def local_corner(stage: Stage, bench: int, corner: int) -> tuple[float, float]:
    """A corner in the frame of its bench [m]."""
    along, left = CORNERS[corner]
    return along * float(stage.sizes[bench, HALF_LENGTH]), left * float(stage.sizes[bench, HALF_WIDTH])


def moved_edge(stage: Stage, query: Query, by: float) -> tuple[Point, Point]:
    """Both ends of the edge in the frame of its bench, moved outwards [m]."""
    dx, dy = (by * part for part in OUTWARDS[query.edge])
    (x, y), (x2, y2) = (local_corner(stage, query.edge_bench, corner) for corner in EDGE_ENDS[query.edge])
    return (x + dx, y + dy), (x2 + dx, y2 + dy)


class Motion:
    """The motion of one query. evaluations: how many chains were laid out for it so far."""

    def __init__(self, stage: Stage, query: Query) -> None:
        self.stage, self.query = stage, query
        self.last = max(query.corner_bench, query.edge_bench) + 1
        self.evaluations = 0
        self._laid = math.nan
        self._bounded = (math.nan, math.nan)

    def rows(self, t: float) -> Floats:
        """Rows of the handles at a time in [0, 1]."""
        if t != self._laid:
            self.evaluations += 1
            self._laid = t
            self.stage.lay(self.query.place - t * self.query.span, self.last)
        return self.stage.chain

    def point(self, t: float, bench: int, local: Point) -> Point:
        """A point fixed in a bench, in the world [m]."""
        x, y, ux, uy = self.pose(t, bench)
        return x + local[0] * ux - local[1] * uy, y + local[0] * uy + local[1] * ux

    def pose(self, t: float, bench: int) -> tuple[float, float, float, float]:
        """Centre [m] and direction of a bench."""
        x, y, ux, uy = self.rows(t)[bench, MX : UY + 1].tolist()
        return x, y, ux, uy

    def bow(self, start: float, stop: float, bench: int, reach: float) -> float:
        """Largest distance of a point of a bench from the uniform straight motion between two times [m].

        reach: of the point from the centre [m]
        |X''| <= K = CENTRE_PULL + OMEGA_PULL reach over the interval (core/kernels/bounds.py): no more than K h^2 / 8.
        """
        h, search = (stop - start) * self.query.span, self.stage.search
        if self._bounded != (start, stop):  # all points of both benches share these bounds
            self.evaluations += 2
            self._bounded = (start, stop)
            if not search.probe.lay_out(self.query.place - start * self.query.span, h, self.last):
                self._bounded = (math.nan, math.nan)
                return math.inf
        rounding = float(max(search.probed[bench, ERROR], search.probed_later[bench, ERROR]))
        pull = float(search.motion[bench, CENTRE_PULL] + search.motion[bench, OMEGA_PULL] * reach)
        return pull * h * h / 8.0 + 4.0 * rounding

    def even_steps(self, bow: float) -> int:
        """Number of equal steps in which neither bench bows out by more than this, from the first and the last [m]."""
        query, sizes = self.query, self.stage.sizes
        reaches = {
            bench: float(sizes[bench, RADIUS]) + query.margin for bench in (query.corner_bench, query.edge_bench)
        }
        steps = 1
        while True:
            ends = ((0.0, 1.0 / steps), (1.0 - 1.0 / steps, 1.0))
            worst = max(self.bow(*ends[side], bench, reach) for side in (0, 1) for bench, reach in reaches.items())
            if worst <= bow:
                return steps
            steps = math.ceil(steps * 1.05 * math.sqrt(worst / bow)) if math.isfinite(worst) else 2 * steps


def beside(rows: Floats, sizes: Floats, corner_bench: int, edge_bench: int) -> tuple[Floats, Floats]:
    """Place of every corner of one bench by every edge of another: along it from its middle, and out from it [m].

    rows: (..., handles, CHAIN_COLUMNS); returns: (..., 4, 4) each, by corner and edge
    """
    signs = np.array(CORNERS, dtype=np.float64)
    own, other = rows[..., corner_bench, :], rows[..., edge_bench, :]
    along = signs[:, 0] * sizes[corner_bench, HALF_LENGTH]
    left = signs[:, 1] * sizes[corner_bench, HALF_WIDTH]
    x = own[..., MX, None] + along * own[..., UX, None] - left * own[..., UY, None] - other[..., MX, None]
    y = own[..., MY, None] + along * own[..., UY, None] + left * own[..., UX, None] - other[..., MY, None]
    p = x * other[..., UX, None] + y * other[..., UY, None]
    q = y * other[..., UX, None] - x * other[..., UY, None]
    half_length, half_width = sizes[edge_bench, HALF_LENGTH], sizes[edge_bench, HALF_WIDTH]
    out = np.stack([p - half_length, -q - half_width, -p - half_length, q - half_width], axis=-1)
    return np.stack([q, p, q, p], axis=-1), out

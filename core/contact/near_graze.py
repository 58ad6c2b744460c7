"""Two benches to 30 digits, for contacts so near a graze that the rounding of doubles hides their beginning.

The model is that of the kernels. It takes their doubles (chords, the table of a route) as exact, and solves the chain
again in decimal arithmetic from the kernels' result. Curves through waypoints are not covered, because their arc length
is itself a quadrature.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from decimal import Decimal, localcontext
from itertools import product
from threading import Lock

from core import kernels
from core.contact.decimal_shapes import (
    CORNERS,
    DIGITS,
    GAP_ROUNDING,
    Bench,
    Vector,
    beyond,
    clothoid_way,
    coil_theta,
    cos_sin,
    crosses,
    distance,
    exact_gap,
    exact_separation,
)
from core.contact.search import ContactSearch
from core.kernels import Budget
from core.kernels.constants import (
    ARC,
    ARC_ANGLE,
    ARC_RADIUS,
    CENTRE_X,
    CENTRE_Y,
    CHORD,
    CLOTHOID,
    COIL_ARC,
    COIL_GROWTH,
    COIL_ROTATION,
    CORNERED,
    CREST,
    CUBIC,
    HALF_WIDTH,
    K_RATE,
    K_START,
    LAG,
    LINE,
    LINE_DX,
    LINE_DY,
    LINE_X,
    LINE_Y,
    PIECE_KIND,
    S_START,
    SIGN,
    TX,
    UX,
)
from core.kernels.results import Marched
from core.sampling import fall_to_zero
from core.values import Pair

# Allowed error of a chord [m], and most steps towards it, of which three are enough except near a fold.
NEGLIGIBLE = Decimal("1e-34")
LINK_STEPS = 40
# Shortest interval of a proof [m].
SHORTEST = 1e-13
# Largest relative error of a travel that is divided by the head speed, in doubles, and multiplied again [1].
CLEAR_ROUNDING = 4.0 * kernels.ULP
# Last bench of a pair in decimals, because each handle takes a third of a millisecond for each instant [1]; and most
# intervals before a proof is given up: about a second in all.
LAST_BENCH = 60
# Largest relative error of a bound on a second derivative, and of its product with h^2 [1].
CURVATURE_ROUNDING = 1e-12
INTERVALS_MAX = 60
# Columns of what a column of a piece has lost in rounding.
LOWS = {S_START: kernels.S_START_LOW, COIL_ARC: kernels.COIL_ARC_LOW, COIL_GROWTH: kernels.COIL_GROWTH_LOW}
# Groups of columns in a chain row of the kernels.
TANGENT, LINK = slice(TX, TX + 2), slice(UX, UX + 2)


class Unsolved(ArithmeticError):
    """A link whose chord is not met within NEGLIGIBLE after LINK_STEPS."""


# Decimals hold Python's lock: several threads would not be faster together, and would make all others wait.
_LOCK = Lock()
# Time between two checks of the budget while another thread computes [s].
LOOK_SECONDS = 0.01


@contextmanager
def _one_at_a_time(budget: Budget) -> Iterator[None]:
    """A context for one thread at a time. raises: Halted"""
    while not _LOCK.acquire(timeout=LOOK_SECONDS):
        budget.look()
    try:
        yield
    finally:
        _LOCK.release()


class ExactPair:
    """Two benches of a search, or a bench and an edge at rest: their places and their separation.

    can_follow: True if the path has no corner and no curve through waypoints, and the pair is not further back than
        LAST_BENCH
    """

    def __init__(self, search: ContactSearch, pair: Pair) -> None:
        self.search, self.pair = search, pair
        self.edge = pair[1] - search.room - 1 if len(search.edges) else -1  # -1: the second one is a bench
        self.last = pair[0] if self.edge >= 0 else pair[1]
        path = search.path
        self.pieces = [[Decimal(number) for number in row] for row in path.as_route(path.end).table.tolist()]
        with localcontext() as context:
            context.prec = DIGITS
            for row, column in product(self.pieces, LOWS):
                row[column] += row[LOWS[column]]
        kinds = {int(row[PIECE_KIND]) for row in self.pieces}
        cornered = self.pieces[0][CORNERED] > 0  # which side of a corner a handle is on, doubles may hide
        self.can_follow = self.last <= LAST_BENCH and not cornered and not kinds & {CUBIC, CREST}

    def benches(self, travel: Decimal) -> tuple[Bench, Bench]:
        """The two benches with the head at a travel [m]. raises: Unsolved"""
        search = self.search
        search.place_leaders(float(travel), self.last + 1)
        rows, path = search.placed, search.path
        s, points = travel, [self._point(path.piece_at(rows[0]), travel)]
        for k in range(self.last + 1):
            chord, piece = Decimal(float(search.sizes[k, CHORD])), path.piece_at(rows[k + 1])
            s = Decimal(float(path.along(rows[k + 1, LAG])))
            slope = Decimal(float(rows[k + 1, TANGENT] @ rows[k, LINK]))
            for _ in range(LINK_STEPS):
                point = self._point(piece, s)
                excess = distance(points[-1], point) - chord
                if abs(excess) < NEGLIGIBLE:
                    break
                s += excess / slope
            else:
                raise Unsolved(f"link {k}")
            points.append(point)
        first = self._bench(self.pair[0], *points[self.pair[0] : self.pair[0] + 2])
        return first, self._edge() if self.edge >= 0 else self._bench(self.last, *points[self.last : self.last + 2])

    def _edge(self) -> Bench:
        """The edge at rest, as a bench without width."""
        x, y, x_end, y_end = (Decimal(number) for number in self.search.edges[self.edge].tolist())
        length = distance((x, y), (x_end, y_end))
        along = ((x_end - x) / length, (y_end - y) / length)
        return Bench(((x + x_end) / 2, (y + y_end) / 2), along, length / 2, Decimal(0))

    def gap(self, travel: Decimal) -> Decimal:
        """Separation of the two less the margin [m]. raises: Unsolved"""
        self.search.budget.look()
        return exact_separation(*self.benches(travel))[0] - Decimal(self.search.margin)

    def stays_apart(self, start: float, stop: float) -> bool:
        """True if the two are proven to be further apart than the margin from one travel to another [m].

        raises: Unsolved
        """
        search, margin = self.search, Decimal(self.search.margin)
        a, b = self.pair
        tried = 0
        while start < stop:
            here = self.benches(Decimal(start))
            h = stop - start
            while True:
                self.search.budget.look()
                slack = search.travel_rounding(start, stop)
                place = search.place - start + slack
                curvatures = kernels.pair_curvatures(search.scene, search.probe, place, h + 2.0 * slack, a, b)
                if max(curvatures) >= kernels.FREE:
                    return False
                there = self.benches(Decimal(start + h))
                axis = exact_separation(*there)[1]
                least = min(exact_gap(*here, axis), exact_gap(*there, axis)) - margin
                if least > GAP_ROUNDING + Decimal((1.0 + CURVATURE_ROUNDING) * curvatures[axis.owner] * h * h / 8.0):
                    break
                h *= 0.5
                tried += 1
                if h < SHORTEST or tried > INTERVALS_MAX:
                    return False
            start = start + h if start + h < stop else stop
        return True

    def stays_within(self, start: float, stop: float) -> bool:
        """True if a corner of one is proven to stay within the margin of the other between two near travels [m].

        Its coordinates in the other's frame are gaps along axes, so none leaves the chord between its values at both
        ends by more than K h^2 / 8 (core/kernels/pairs.py). An edge has no inside, but two corners may be on its two
        sides.
        raises: Unsolved
        """
        search, slack = self.search, self.search.travel_rounding(start, stop)
        h = stop - start + 2.0 * slack
        curvatures = kernels.pair_curvatures(search.scene, search.probe, search.place - start + slack, h, *self.pair)
        if max(curvatures) >= kernels.FREE:
            return False
        bend = Decimal((1.0 + CURVATURE_ROUNDING) * max(curvatures) * h * h / 8.0)
        ends = [self.benches(Decimal(travel)) for travel in (start, stop)]
        most = Decimal(search.margin) - GAP_ROUNDING
        if self.edge >= 0 and crosses([(edge, bench) for bench, edge in ends], bend + GAP_ROUNDING):
            return True
        return any(
            beyond([(pair[owner], pair[1 - owner]) for pair in ends], corner, bend) <= most
            for owner in (0, 1)
            for corner in CORNERS
        )

    def _bench(self, k: int, front: Vector, rear: Vector) -> Bench:
        chord, half_length, half_width = (
            Decimal(number) for number in self.search.sizes[k, CHORD : HALF_WIDTH + 1].tolist()
        )
        centre = ((front[0] + rear[0]) / 2, (front[1] + rear[1]) / 2)
        return Bench(centre, ((front[0] - rear[0]) / chord, (front[1] - rear[1]) / chord), half_length, half_width)

    def _point(self, piece: int, s: Decimal) -> Vector:
        """Point at arc length s of a row of the table, see core/kernels/constants.py."""
        row = self.pieces[piece]
        kind, u = row[PIECE_KIND], s - row[S_START]
        if kind == LINE:
            return row[LINE_X] + u * row[LINE_DX], row[LINE_Y] + u * row[LINE_DY]
        if kind == CLOTHOID:
            along, left = clothoid_way(row[K_START] * u, row[K_RATE] * u * u)
            dx, dy = u * row[LINE_DX], u * row[LINE_DY]
            return row[LINE_X] + along * dx - left * dy, row[LINE_Y] + along * dy + left * dx
        if kind == ARC:
            radius, angle = row[ARC_RADIUS], row[ARC_ANGLE] + row[SIGN] * u / row[ARC_RADIUS]
        else:
            theta = coil_theta((row[COIL_ARC] + row[SIGN] * u) / row[COIL_GROWTH])
            radius, angle = row[COIL_GROWTH] * theta, theta + row[COIL_ROTATION]
        cos, sin = cos_sin(angle)
        return row[CENTRE_X] + radius * cos, row[CENTRE_Y] + radius * sin


# From `proven` on the gap of the pair falls until the two touch. False position finds the first instant t within the
# margin, between an instant at which they are apart and one at which they are within it. The interval before t is
# proven clear as in the kernels, in as many steps as necessary: along an axis fixed in one of the benches, with its
# sign, the gap is below its chord by at most K x (h - x) / 2, with the kernels' K. A march in doubles covers all other
# pairs over the same interval.
#
# The claims are about times, which are travels divided by the head speed in doubles: the pair is within the margin at
# the true travel of the later time, and apart until a little beyond that of the earlier one. With passages the true
# travels are not known exactly, only within travel_rounding() of the computed ones.
def narrow_bracket(
    search: ContactSearch, march: Marched, half: float, head_speed: float | None = 1.0
) -> Marched | None:
    """A march with the bracket of its contact narrowed to half width `half` [m]; None if that is not proven.

    march: result of ContactSearch.march() with `proven`, `touching` and the pair
    returns: the same with a narrower bracket; the contact is at `touching` - `half`
    head_speed: speed that turns travels into times [m/s]; None with passages, where several do
    """
    pair = ExactPair(search, march.pair)
    if march.touching is None or not pair.can_follow:
        return None
    if not search.others_clear(pair.pair, march.proven, march.touching):
        return None
    search.budget.take_time()
    with _one_at_a_time(search.budget), localcontext() as context, suppress(Unsolved):
        context.prec = DIGITS
        low, high = Decimal(march.proven), Decimal(march.touching)
        above, below = pair.gap(low), pair.gap(high)
        if not above > GAP_ROUNDING or not below < -GAP_ROUNDING:
            return None
        contact = float(fall_to_zero(pair.gap, low, high, above, below, Decimal(half) / 1000))
        clear, touching = contact - half, contact + half
        if head_speed is None:
            slack = search.travel_rounding(clear, touching)
            sure = pair.stays_within(touching - slack, touching + slack)
            apart = sure and pair.stays_apart(march.proven, clear + slack)
            return march._replace(proven=clear, touching=touching, half=half) if apart else None
        later = Decimal(touching / head_speed) * Decimal(head_speed)
        beyond = clear + abs(clear) * CLEAR_ROUNDING
        if pair.gap(later) <= -GAP_ROUNDING and pair.stays_apart(march.proven, beyond):
            return march._replace(proven=clear, touching=touching, half=half)
    return None

"""The search for dances that fit: designs of a figure, rated, moved a little to a better rating, and checked.

Nothing is random. Few dances are checked: a check takes as long as ten ratings, and its answer decides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, islice, product
from typing import Any

import numpy as np

from core.contact.clearance import LeastClearance, least_clearance
from core.contact.walls import venue_clearance
from core.dance import Dance
from core.dragon import Dragon
from core.extremes.speed import maximum_head_speed
from core.ground.envelope import envelope
from core.judgement import Report, check, quick_check
from core.kernels import Budget
from core.paths.route import Route
from core.proposal.answer import Near, Objective, Proposal
from core.proposal.channels import ChannelLegFinder
from core.proposal.designs import Design, laid_out, stand_length, street_length, with_gates
from core.proposal.figures import Figure, Shape, shapes, tight_rings
from core.proposal.free_ground import FreeGround
from core.proposal.gates import Gate, ways_through, with_streets
from core.proposal.legs import LegFinder
from core.proposal.needs import Needs
from core.proposal.places import placements, sampled
from core.proposal.rating import PathRating, rated, strands
from core.proposal.walks import Pose, moved
from core.tolerance.tolerance import tolerance
from core.values import Progress, unheard
from core.venue import Venue

# Head speed of a dance that is wished neither faster nor slower [m/s].
HEAD_SPEED = 1.0
# Room on each side of a street, beside the benches, and where the border of the square is too narrow for it [m].
STREET_ROOM, STREET_LEAST = 1.0, 0.02
# Placed shapes of a figure that are laid out, without and with gates, pairs of gates, and dances that are checked for
# one proposal [1].
PLACED, PLACED_GATED, GATE_PAIRS, CHECKED = 8, 4, 2, 4
# A rating is too low by this at most, in most dances [m]: dances below it are not checked.
RATED_LOW = 0.08
# Ratings and rooms that differ by less are equal [m], so that rounding on another processor chooses no other dance.
SAME = 1e-6
# A dance whose rating lacks more than this is not moved to a better one [m].
HOPELESS = 0.6
# Ratings of a local search, without and with gates [1]; its first steps: places [m], rotation [rad], sizes [1]; and how
# often they are halved.
MOVES, MOVES_GATED, FIRST_STEPS, HALVINGS = 60, 20, (0.8, 0.12, 0.06), 3
# A venue of more edges gets fewer ratings, because each takes longer [1].
EDGES = 250
# Work of one rating, and of an edge in it [1]; and largest excess of the ground that a proposal states [m].
RATING_WORK, EDGE_WORK, GROUND = 1_000.0, 50.0, 0.1
# Largest number of times around a closed figure [1], and way that rounding may add to that of a dance [m].
LAPS_MOST, ROUNDED = 100, 1e-6


@dataclass(frozen=True)
class Rated:
    """A design that was laid out, with its route and its rating."""

    design: Design
    route: Route
    rating: PathRating


@dataclass(frozen=True)
class Wish:
    """What a proposal must keep.

    stray, margin: [m]; speed_limit: of every handle [m/s], None for none
    laps: times around a closed figure, None for the usual ones
    duration_limit: of a dance, in which closed figures are danced as often as they can [s], None for none
    head_speed: of a dance that the speed limit does not slow down [m/s]
    """

    stray: float
    margin: float
    speed_limit: float | None
    objective: Objective
    laps: int | None = None
    duration_limit: float | None = None
    head_speed: float = HEAD_SPEED

    @property
    def limits(self) -> dict[str, Any]:
        """The limits of a check."""
        return {"margin": self.margin, "stray": self.stray, "speed_limit": self.speed_limit}


@dataclass
class Spent:
    """What all searches of one question spent: numbers of dances that were rated, and judged by a check."""

    tried: int = 0
    checked: int = 0


@dataclass
class Failed:
    """What a search left out.

    nearest: the best-rated dance that failed its check, with its report
    too_long: rated dances of which even the fewest times around take too long
    """

    nearest: tuple[Rated, Report] | None = None
    too_long: list[Rated] = field(default_factory=list)

    def note(self, one: Rated, report: Report) -> None:
        """Keep a dance that failed its check, if it is the best-rated so far."""
        if self.nearest is None or one.rating.stray > self.nearest[0].rating.stray:
            self.nearest = (one, report)


@dataclass(frozen=True)
class Search:
    """The search for one dragon in one venue, see search_in(): what it looks for, and the ground on which it does.

    venue: with a street of this width beyond each gate [m]
    ways: what lays out the legs of designs; closely: they lead through channels and are measured bench by bench
    """

    venue: Venue
    dragon: Dragon
    gates: tuple[Gate, ...]
    wish: Wish
    budget: Budget
    needs: Needs
    street_width: float
    ground: FreeGround
    ways: LegFinder
    spent: Spent
    failed: Failed = field(default_factory=Failed)
    closely: bool = False

    def close_look(self) -> Search | None:
        """The same search with designs that lead through channels, measured bench by bench; None if there is none."""
        if self.closely or not self.gates:
            return None
        wide = self.ways.sides[self.needs.radii[0]] + self.needs.free
        leads = (0.0, self.needs.chord)
        entered = [moved((*gate.point, gate.heading), (lead, 0.0))[:2] for gate in self.gates for lead in leads]
        if self.ground.clearance(np.array(entered)).min() >= wide and not self.ways.channels:
            return None
        return replace(self, closely=True, ways=ChannelLegFinder(self.ground, self.needs, self.budget))

    def of(self, venue: Venue, dragon: Dragon, wish: Wish) -> Search:
        """A search for another dragon or wish between the same gates, as close as this one. venue: without streets"""
        other = search_in(venue, dragon, self.gates, wish, self.budget, self.spent)
        other = (other.close_look() or other) if self.closely else other
        ways, others = self.ways, other.ways
        alike = self.needs.takes == other.needs.takes
        if alike and isinstance(ways, ChannelLegFinder) and isinstance(others, ChannelLegFinder):
            others.bent = ways.bent
        return other

    def value(self, rating: PathRating) -> float:
        """Value of a rating for the objective; a dance without room for the stray is worth less than any with it."""
        if rating.stray < self.wish.stray:
            return rating.stray - 1e6
        if self.wish.objective is Objective.TURNS:
            return rating.turns
        return rating.length if self.wish.objective is Objective.DURATION else rating.stray

    def ranked(self, figure: Figure) -> list[Rated]:
        """Dances of a figure that are worth a closer look, the best-rated first."""
        laid = [one for design in self.designs(figure) if (one := self.rate(design)) is not None]
        every = list[Rated]()
        for one in laid:
            (self.failed.too_long if self.further(one, self.wish.head_speed) is None else every).append(one)
        return sorted(every, key=lambda one: -round(self.value(one.rating), 6))

    def designs(self, figure: Figure) -> Iterator[Design]:
        """Designs of a figure: the shapes at their roomiest places, each with its best ways from and to the gates."""
        pairs = ways_through(self.gates)[:GATE_PAIRS]
        if figure is Figure.PARADE:
            yield from (Design(figure, None, (0.0, 0.0, 0.0), pair) for pair in pairs if pair[0] is not pair[1])
            return
        spots = self.spots(figure)
        if not self.gates:
            yield from (Design(figure, shape, pose) for _, shape, pose in spots[:PLACED])
            return
        for (_, shape, pose), pair in product(spots[:PLACED_GATED], pairs):
            yield from with_gates(Design(figure, shape, pose), pair, self.needs, self.ways)

    def spots(self, figure: Figure) -> list[tuple[float, Shape, Pose]]:
        """Room, shape and pose of a figure's shapes at their roomiest places, the roomiest first."""
        widest = float(max(self.ground.high - self.ground.low))
        spots = self._spots(shapes(figure, self.needs, widest, gated=bool(self.gates)))
        if figure is Figure.RING and all(room < self.needs.free for room, _, _ in spots):
            least = float(min(self.ground.high - self.ground.low))
            tight = [one for one in tight_rings(self.needs, widest) if 2.0 * one.sizes[1] <= least]
            spots += self._spots(tight) + self._middles(one for one in tight if one.round)
        if self.wish.objective in (Objective.TURNS, Objective.DURATION):
            return sorted(spots, key=lambda spot: -round(sum(spot[1].sizes), 6))
        return sorted(spots, key=lambda spot: -round(spot[0], 6))

    def _spots(self, every: Iterable[Shape]) -> list[tuple[float, Shape, Pose]]:
        spots = []
        for shape in every:
            self.budget.afford(RATING_WORK)
            places = placements(self.ground, self.needs, shape, 2)
            own = self.own_room(shape) if places else 0.0
            spots += [(min(room, own), shape, pose) for room, pose in places]
        return spots

    def _middles(self, circles: Iterable[Shape]) -> list[tuple[float, Shape, Pose]]:
        """Spots of circles in the middle of the widest free circle, in which benches take less room than beside a path:
        only what they take outside."""
        x, y, radius, _ = self.ground.widest_circle
        rooms = [(radius - self.needs.outer(circle.sizes[0]), circle) for circle in circles]
        return [(min(room, self.own_room(circle)), circle, (x, y, 0.0)) for room, circle in rooms if room > 0.0]

    def own_room(self, shape: Shape) -> float:
        """Room on each side of the benches on a shape that its own strands leave [m]."""
        route = laid_out(Design(shape.figure, shape, (0.0, 0.0, 0.0)), self.needs, self.ways)
        pieces = shape.pieces or ()
        path = route or (Route(pieces) if self.gates else None)
        return 0.5 * strands(sampled(path, self.needs), self.needs) if path else -math.inf

    def rate(self, design: Design) -> Rated | None:
        """A design laid out and rated; None if it cannot be laid out."""
        self.budget.afford(RATING_WORK + EDGE_WORK * len(self.ground.edges))
        self.spent.tried += 1
        route = laid_out(design, self.needs, self.ways)
        if route is None:
            return None
        ends = stand_length(self.needs) if design.gates else 0.0
        rating = rated(self.ground, self.needs, route, (ends, ends), closely=self.closely)
        shape = design.shape
        if rating.venue < self.wish.stray and shape is not None and shape.round and not design.gates:
            # Within a circle without obstacles benches take only the room outside their path.
            clear = float(self.ground.clearance(np.array([design.pose[:2]]))[0])
            room = clear - self.needs.outer(shape.sizes[0]) - self.wish.margin
            rating = replace(rating, venue=max(rating.venue, room / self.needs.gain))
        return Rated(design, route, rating)

    def improved(self, start: Rated) -> Rated:
        """The dance with place, rotation and sizes moved to a better rating, by steps that are halved."""
        best, edges = start, len(self.ground.edges)
        left = math.ceil((MOVES_GATED if start.design.gates else MOVES) * min(1.0, EDGES / edges))
        shape = start.design.shape
        if shape is None:
            return best
        fixed = 1 if shape.figure is Figure.SERPENTINE else 0
        for halving in range(HALVINGS):
            steps = [step * 0.5**halving for step in FIRST_STEPS]
            moves: list[Callable[[Design], Design]] = [
                _move(axis, sign * step)
                for axis, step in ((0, steps[0]), (1, steps[0]), (2, steps[1]))
                for sign in (1.0, -1.0)
            ]
            moves += [_resize(k, 1.0 + sign * steps[2]) for k in range(fixed, len(shape.sizes)) for sign in (1.0, -1.0)]
            better = True
            while better:
                better = False
                for move in moves:
                    if left == 0:
                        return best
                    left -= 1
                    one = self.rate(move(best.design))
                    if one is None or self.further(one, self.wish.head_speed) is None:
                        continue
                    if self.value(one.rating) > self.value(best.rating) + SAME:
                        best, better = one, True
        return best

    def dance_on(self, route: Route) -> Dance:
        """The dance on a route, as fast as the speed limit allows, at most with the speed that is wished."""
        wished = self.wish.head_speed
        dance = Dance(self.dragon, route, wished)
        limit = self.wish.speed_limit
        if limit is None:
            return dance
        most = maximum_head_speed(dance, limit, start=0.0, budget=self.budget).head_speed_bracket[0]
        # Down to the next cm/s, or by a thousandth where that would stop a very slow dance.
        speed = wished if most is None else min(wished, math.floor(most * 100.0) / 100.0 or 0.999 * most)
        return dance if speed == wished else Dance(self.dragon, route, speed)

    def further(self, one: Rated, speed: float) -> int | None:
        """Times around its figure by which a dance is to be longer; None if the fewest already take too long.

        speed: of the head [m/s]
        """
        shape, wish, laps = one.design.shape, self.wish, round(one.design.laps)
        most = math.inf if wish.duration_limit is None else wish.duration_limit * speed - ROUNDED
        further = 0
        if shape is not None and shape.closed:
            if wish.laps is not None:
                further = wish.laps - laps
            elif most < math.inf:
                further = min(max(math.floor((most - one.route.end) / shape.around), 1 - laps), LAPS_MOST - laps)
        return further if way_of(one, further) <= most else None

    def shortest(self) -> tuple[float, Figure] | None:
        """The time of the shortest dance that was found to pass among those that take too long [s], and its figure."""
        times = []
        for figure in {one.design.figure for one in self.failed.too_long}:
            ways = [(fewest(one), one) for one in self.failed.too_long if one.design.figure is figure]
            for way, one in sorted(ways, key=lambda each: each[0])[:CHECKED]:
                dance = self.passing(one) if one.rating.stray >= self.wish.stray - RATED_LOW else None
                if dance is not None:
                    times.append((way / dance.head_speed, figure))
                    break
        return min(times, default=None)

    def timed(self, one: Rated, dance: Dance) -> tuple[Rated, Dance] | None:
        """A dance as often around its figure as is wished; None if it takes too long."""
        further, shape = self.further(one, dance.head_speed), one.design.shape
        if further is None or not further or shape is None:
            return None if further is None else (one, dance)
        design = replace(one.design, further=further)
        route = laid_out(design, self.needs, self.ways)
        if route is None:
            return None
        turns = one.rating.turns + further * shape.turns
        rating = replace(one.rating, length=route.end - route.begin, turns=turns)
        return Rated(design, route, rating), Dance(self.dragon, route, dance.head_speed)

    def passing(self, one: Rated) -> Dance | None:
        """The dance of a design if it passes the quick check; None if not."""
        self.spent.checked += 1
        dance = self.dance_on(one.route)
        report = quick_check(dance, venue=self.venue, start=0.0, budget=self.budget, **self.wish.limits)
        if report.passed:
            return dance
        self.failed.note(one, report)
        return None

    def check_nearest(self, figures: Sequence[Figure]) -> tuple[Search, Rated, Dance] | None:
        """The best-rated dance of some figures if it passes; if none can be laid out, one that heeds no edge; with the
        search that laid it out."""
        search, every = self, [one for figure in figures for one in self.ranked(figure)]
        if not every:
            search = replace(self, ways=LegFinder(self.ground, self.needs, self.budget, heedless=True))
            designs = (design for figure in figures for design in search._heedless(figure))
            every = [one for design in designs if (one := search.rate(design)) is not None]
        if not every:
            return None
        best = max(every, key=lambda one: round(one.rating.stray, 6))
        dance = search.passing(best)
        return None if dance is None else (search, best, dance)

    def _heedless(self, figure: Figure) -> Iterator[Design]:
        """Designs of the smallest shape of a figure in the middle of the widest free circle."""
        if figure is Figure.PARADE:
            yield from self.designs(figure)
            return
        every = shapes(figure, self.needs, math.inf, gated=bool(self.gates))
        if figure is Figure.RING:
            every = chain(tight_rings(self.needs, math.inf), every)
        x, y, _, _ = self.ground.widest_circle
        for shape in islice(every, 1):
            design = Design(figure, shape, (x, y, 0.0))
            if self.gates:
                yield from with_gates(design, ways_through(self.gates)[0], self.needs, self.ways)
            else:
                yield design

    def first(self, candidates: Sequence[Rated], *, briefly: bool = False) -> tuple[Rated, Dance, int] | None:
        """The first of some rated dances that passes, moved to a better rating if it passes then too; and its number.

        briefly: as it is, without moves
        """
        for k, one in enumerate(candidates[:CHECKED]):
            if one.rating.stray < self.wish.stray - HOPELESS:
                continue
            better = one if briefly else self.improved(one)
            for each in (better, one) if better is not one else (one,):
                if each.rating.stray < self.wish.stray - RATED_LOW:
                    continue
                dance = self.passing(each)
                if dance is not None:
                    return each, dance, k
        return None

    def proposals(self, figures: Sequence[Figure], count: int, progress: Progress = unheard) -> Iterator[Proposal]:
        """Certified dances: the first that passes of each figure, then others of the same figures, up to the count.

        progress: called with the share of the figures that were tried, 0 to 1
        """
        left = {}
        for k, figure in enumerate(figures, start=1):
            left[figure] = self.ranked(figure)
            progress((k - 0.5) / len(figures))
            yield from self._next(left, figure)
            progress(k / len(figures))
        further = 0
        while any(left.values()) and further < count:
            for figure in figures:
                for proposal in self._next(left, figure):
                    further += 1
                    yield proposal

    def _next(self, left: dict[Figure, list[Rated]], figure: Figure) -> Iterator[Proposal]:
        """The next proposal of a figure, if there is one; what is near it leaves the list."""
        passing = self.first(left[figure])
        if passing is None:
            left[figure] = []
            return
        one, dance, k = passing
        left[figure] = [other for other in left[figure][k + 1 :] if _apart(one.design, other.design, self.needs.chord)]
        proposal = self.certified(one, dance)
        if proposal is not None:
            yield proposal

    def certified(self, one: Rated, dance: Dance) -> Proposal | None:
        """The proposal of a dance, as often around as is wished; None if the whole check does not pass."""
        timed = self.timed(one, dance)
        if timed is None:
            return None
        one, dance = timed
        report = check(dance, venue=self.venue, start=0.0, budget=self.budget, **self.wish.limits)
        if not report.passed or report.venue is None:
            return None
        nearest = [(area.nearest, area.name) for area in report.venue.areas if area.nearest is not None]
        least, name = min(nearest, key=lambda each: each[0].distance)
        swept = envelope(dance, start=0.0, excess=GROUND, budget=self.budget)
        safe = tolerance(dance, self.venue, start=0.0, budget=self.budget)
        gates = tuple(self.gates.index(gate) for gate in one.design.gates or ())
        turns, apart, alone = one.rating.turns, report.least_clearance, least.distance
        if self.wish.stray:
            apart, alone = self._in_place(dance, report, name)
        near, in_place = Near(name, least.distance, least.time, alone), None if apart is None else apart.distance
        return Proposal(
            one.design.figure, dance, self.venue, report, safe.stray, swept.area, turns, near, gates, in_place
        )

    def _in_place(self, dance: Dance, report: Report, name: str) -> tuple[LeastClearance | None, float]:
        """The least clearance of two benches, and the distance from an area by name [m], for people who do not stray.

        report: for those who do, which passes
        """
        span: dict[str, Any] = {"start": report.start, "stop": report.stop, "budget": self.budget}
        areas = venue_clearance(dance, self.venue, **span).areas
        nearest = next(area.nearest for area in areas if area.name == name)
        assert nearest is not None
        return least_clearance(dance, **span), nearest.distance


def search_in(
    venue: Venue, dragon: Dragon, gates: Sequence[Gate], wish: Wish, budget: Budget, spent: Spent | None = None
) -> Search:
    """A search in a venue without streets. spent: so far; raises: InvalidValue for a street that is too short"""
    needs = Needs(dragon, wish.stray, wish.margin)
    least = 2.0 * (needs.straight_side + needs.free + STREET_LEAST)
    width = least + 2.0 * (STREET_ROOM - STREET_LEAST)
    square = venue.square.edges.reshape(-1, 2)
    if gates:
        venue = with_streets(venue, gates, (width, least), street_length(needs))
    ground = FreeGround(venue, (square.min(axis=0), square.max(axis=0)))
    ways = LegFinder(ground, needs, budget)
    return Search(venue, dragon, tuple(gates), wish, budget, needs, width, ground, ways, spent or Spent())


def way_of(one: Rated, further: int = 0) -> float:
    """Way of the head in a dance, this often further around its figure [m]."""
    shape = one.design.shape
    return one.route.end + (further * shape.around if further and shape is not None else 0.0)


def fewest(one: Rated) -> float:
    """The same with the fewest times around [m]."""
    shape = one.design.shape
    return way_of(one, 1 - round(one.design.laps) if shape is not None and shape.closed else 0)


def _apart(design: Design, other: Design, way: float) -> bool:
    """True if people would call two designs of a figure different: another place, size or gate."""
    if design.gates != other.gates:
        return True
    if design.shape is None or other.shape is None or math.dist(design.pose[:2], other.pose[:2]) > way:
        return design.shape is not None
    sizes = zip(design.shape.sizes, other.shape.sizes, strict=True)
    return any(abs(math.log(one / two)) > 0.2 for one, two in sizes)


def _move(axis: int, step: float) -> Callable[[Design], Design]:
    def shifted(design: Design) -> Design:
        x, y, turn = (value + step * (k == axis) for k, value in enumerate(design.pose))
        return replace(design, pose=(x, y, turn))

    return shifted


def _resize(k: int, factor: float) -> Callable[[Design], Design]:
    def resized(design: Design) -> Design:
        assert design.shape is not None
        sizes = tuple(size * factor if j == k else size for j, size in enumerate(design.shape.sizes))
        return replace(design, shape=Shape(design.shape.figure, sizes, design.shape.mirror))

    return resized

"""One dragon on one path, in the form that the march of the kernels needs.

The march is written, with its proof, above its loops: core/kernels/marching.py, bounds.py, gap_curvature.py, pairs.py
and rings.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.contact.brackets import BRACKET, BRACKET_MIN, BRACKETS_GRAZING, FOLD_SLIVER, FOLD_WAYS, TRAVEL_ROUNDING
from core.contact.coils import clear_places
from core.dance import RunEnd
from core.dragon import Dragon
from core.kernels import Budget, Ended
from core.kernels.results import Marched
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.shapes.reach import Reach, directions, reach, ring_bounds
from core.values import Floats, Interval, Pair

MARGIN_MAX = 1e4  # [m]
# Work after which a search gives up as undecided [1], see core/kernels/constants.py: 2 to 8 s for a first contact, and
# about the same for a least distance, whose steps end near a bench or an edge and cost more. The default case takes
# about 5,000.
WORK_BUDGET = 2e7
NEAR_WORK_BUDGET = 5e6


@dataclass(frozen=True, slots=True, eq=False)
class SearchInput:
    """What a search looks for: benches of a dragon on a path that come within a margin [m], of each other or of edges.

    edges: (E, 4) x, y, x, y of edges at rest [m] in the own frame of the path. With edges, every pair is a bench and an
        edge: edge e has the bench number room + 1 + e
    copies: dragons in one spiral, each turned by a part of a turn; with several, every pair is a bench of the first and
        one of another: bench b of dragon k has the bench number k * (room + 1) + b
    between: fewest benches between the two of a pair, 1 or more [1]
    stray: largest distance of every hole from its place [m]; covered: the ground of the benches then
    timing: largest distance of the head from its place at a rounded time, in addition to the rounding of its travel [m]
    whole: make room for all benches at once, for questions about each of them
    """

    dragon: Dragon
    path: Spiral | Route
    margin: float
    edges: Floats | None = None
    copies: int = 1
    between: int = 1
    stray: float = 0.0
    timing: float = 0.0
    covered: Callable[[Dragon, float], Reach] = reach
    whole: bool = False


class ContactSearch:
    """The kernels' arrays for a SearchInput, and its functions; use() takes them to another path and margin.

    copies, between, stray, timing: as in the input, as are dragon and edges, but
    dragon: in the search: with a stray each bench is as large as the ground that it may cover; nominal: as given
    leaders: number of benches that lead the pairs of a march: those up to the first of equal ones
    kinds: the hulls of that ground, none without a stray
    rings: lengths of the benches for the kernels, with bounds for the current path and margin
    sizes: (rows, SIZE_COLUMNS) of the leading benches; own_sizes: the same without the stray
    scene: the same benches on the current path; probe: an interval of it to examine single pairs
    placed: chain (rows, CHAIN_COLUMNS) that clearance() and place_leaders() fill; tried, probed: chains that single
        calls fill. A march writes over them, and over two more of its own: chains holds all five
    clear_radius: on a spiral no pair whose inner bench leads at this radius [m], or further out, is within the margin
    rings.clear_place, rings.end_place: see clear_places(); if they are known, there is room only for the leading
        benches, as on a spiral
    work: remaining work of its marches, see WORK_BUDGET, within the budget of the whole question. After a stop of that
        budget, every function that examines benches raises Halted
    place: origin of the kernels' places, at time 0: arc length from the centre of a spiral, minus s on a route [m]
    """

    margin: float
    clear_radius: float

    def __init__(self, sought: SearchInput, *, work: float = WORK_BUDGET, budget: Budget | None = None) -> None:
        dragon, path, stray, edges = sought.dragon, sought.path, sought.stray, sought.edges
        self.work, self.budget, self.nominal, self.stray = work, budget or Budget(), dragon, stray
        self.timing, self.between, self.copies = sought.timing, sought.between, sought.copies
        self.kinds = kernels.Kinds()
        self.apart, outer = (0.0, 2) if self.copies == 1 else (math.tau / self.copies, 0)
        self.ground = ground = sought.covered(dragon, stray) if stray > 0.0 else None
        if ground is not None:
            self.kinds.lay(ground.hulls.reshape(-1, 2), ground.kinds, directions())
            dragon = ground.bounds
        self.dragon, self.leaders = dragon, min(dragon.uniform_from + 1, dragon.benches)
        self.edges = np.empty((0, 4)) if edges is None else edges
        self.rings = rings = kernels.Rings()
        rings.measure(dragon.chords, dragon.overhangs, dragon.widths, dragon.lengths, dragon.uniform_from, outer)
        rings.all_radius = math.hypot(0.5 * rings.all_length, rings.all_half_width)
        if ground is not None:
            rings.lay(ground.corners, ground.middle_half_width, ground.within)
            if self.copies > 1:
                rings.lay(*ring_bounds(dragon.chords[: len(ground.kinds)], ground.hulls, ground.kinds, outer))
        self.room = 0
        self.use(path, sought.margin)
        # no benches are known to be out of reach
        everyone = len(self.edges) > 0 or self.copies > 1 or (path.spiral is None and rings.clear_place >= kernels.FREE)
        self.resize(dragon.benches if everyone or sought.whole else min(dragon.benches, 255))

    @property
    def pairs(self) -> bool:
        """True if any two can touch: three benches or more, or a bench and an edge."""
        return self.dragon.benches >= 3 or len(self.edges) > 0 or self.copies > 1

    def use(self, path: Spiral | Route, margin: float, work: float | None = None) -> None:
        """Go on with another path and margin. work: of the marches there, by default what is left"""
        self.path, self.margin = path, margin
        self.work = self.work if work is None else work
        self.growth, self.place, self.curve = path.growth, path.place, path.curve
        if path.spiral is None:
            route, self.clear_radius, radius = path.as_route(path.end), kernels.FREE, kernels.FREE
            if route.tail_begin is None and not len(self.edges) and self.dragon.benches >= 3:
                radius = float(kernels.clear_radius(float(route.table[0, kernels.COIL_GROWTH]), margin, self.rings))
            places = clear_places(route, self.dragon, margin, radius, self.travel_rounding)
            self.rings.clear_place, self.rings.end_place = places
        elif len(self.edges):  # no radius is clear of edges
            self.clear_radius = kernels.FREE
        else:
            self.clear_radius = float(kernels.clear_radius(path.growth, margin, self.rings, self.apart))
        self.rings.clear_radius = self.clear_radius
        if self.room:
            self._set_scene()

    def _set_scene(self) -> None:
        self.scene.curve, self.scene.place, self.scene.margin = self.curve, self.place, self.margin
        self.scene.budget, self.scene.kinds, self.scene.between = self.budget, self.kinds, self.between

    def clear_beyond(self, radius: float) -> None:
        """Set clear_radius to the radius from which another bound exceeds the margin on this spiral [m]."""
        self.clear_radius = self.rings.clear_radius = radius * (1.0 + kernels.CLEAR_SPARE)

    def travel_rounding(self, *travels: float) -> float:
        """Largest error of travels up to these, in the kernels and as times [m]."""
        furthest = self.place
        for travel in travels:
            furthest = max(furthest, self.place - travel, abs(travel))
        return self.path.slide + self.timing + TRAVEL_ROUNDING * furthest

    def resize(self, benches: int) -> None:
        """Make room for a number of leading benches, and for the edges at rest after the row of the last handle."""
        edges = self.edges
        self.sizes = self._sizes(self.dragon, benches)
        self.own_sizes = self._sizes(self.nominal, benches) if self.kinds.some else self.sizes
        # A chain writes every entry before its first use, except the speed of handle 1, which march() reads first.
        chains = self.chains = np.empty((5, len(self.sizes), kernels.CHAIN_COLUMNS))
        chains[:, :2] = 0.0
        self.motion = np.zeros((len(self.sizes), kernels.MOTION_COLUMNS))
        self.room = benches
        self.scene = kernels.Scene(self.curve, self.place, self.rings, self.sizes, self.dragon.benches, len(edges))
        if len(edges):
            along, walls = edges[:, 2:4] - edges[:, 0:2], np.zeros((len(edges), kernels.FRAME_COLUMNS))
            half = 0.5 * np.hypot(along[:, 0], along[:, 1])
            walls[:, kernels.FRAME_X : kernels.FRAME_Y + 1] = 0.5 * (edges[:, 0:2] + edges[:, 2:4])
            walls[:, kernels.FRAME_UX : kernels.FRAME_UY + 1] = along / (2.0 * half)[:, None]
            self.sizes[benches + 1 :, kernels.HALF_LENGTH] = self.sizes[benches + 1 :, kernels.RADIUS] = half
            chains[:, benches + 1 :] = 0.0
            chains[:, benches + 1 :, kernels.MX : kernels.UY + 1] = walls[:, kernels.FRAME_X : kernels.FRAME_UY + 1]
            self.scene.lay_walls(walls)
        self.copy(self.scene)
        if self.ground is not None and self.copies > 1:
            known = np.minimum(np.arange(benches + 1), len(self.ground.kinds) - 1)
            of = np.tile(self.ground.kinds[known], self.copies)
            self.kinds.lay(self.ground.hulls.reshape(-1, 2), of, directions())
        self._set_scene()
        self.placed, self.tried, self.probed, self.probed_later, self.opening = chains
        self.interval = kernels.Interval(self.scene, self.placed, self.tried, self.motion)
        self.probe = kernels.Interval(self.scene, self.probed, self.probed_later, self.motion)
        self._march = kernels.March(self.interval, self.probe, self.opening)

    def copy(self, scene: kernels.Scene) -> None:
        """Let the benches of a scene meet those of the other dragons, if there are any."""
        if self.copies > 1:
            turns = math.tau * (np.arange(self.copies) / self.copies)
            scene.lay_copies(np.stack([np.cos(turns), np.sin(turns)], axis=-1))

    def _sizes(self, dragon: Dragon, benches: int) -> Floats:
        """Rows for a number of leading benches of every dragon, and empty ones for the edges at rest."""
        lengths, widths = dragon.lengths[:benches], dragon.widths[:benches]
        sizes = np.zeros((benches + 1 + len(self.edges), kernels.SIZE_COLUMNS))
        sizes[:benches, kernels.CHORD] = dragon.chords[:benches]
        sizes[:benches, kernels.HALF_LENGTH], sizes[:benches, kernels.HALF_WIDTH] = 0.5 * lengths, 0.5 * widths
        sizes[:benches, kernels.RADIUS] = 0.5 * np.hypot(lengths, widths)
        return np.tile(sizes, (self.copies, 1))

    def spend(self, work: float) -> None:
        """Subtract work done from the work left [1]."""
        self.work -= work
        self.budget.spend(work)

    def travel_at(self, theta: float) -> float:
        """Head travel from the start of a spiral to theta [m]."""
        return self.place - self.growth * float(kernels.spiral_arc(theta))

    def theta_at(self, travel: float) -> float:
        """Head angle on a spiral after a travel [rad]."""
        return float(kernels.head_theta(self.curve, self.place - travel))

    def march(
        self, stop: float, half_bracket: float, *, start: float = 0.0, opening: bool = True, dips: bool = False
    ) -> Marched:
        """March from start, or from the end of the ring bound, to stop [m of travel].

        half_bracket: half the width of the bracket around a contact [m]; NO_BRACKET: any instant of the contact is
            enough; dips: True finds grazes then too
        opening: True if nothing before the start is proven clear, so all pairs are followed until the body repeats
        The march begins earlier and ends later by the rounding of travels, so that its claims on computed travels and
        times hold for the true ones.
        """
        rounding, span = self.travel_rounding(start, stop), (start, stop)
        start -= rounding
        stop = min(stop + rounding, max(stop, self.path.limit))
        clear_until = self.travel_at(self.clear_radius / self.growth) if self.clear_radius < kernels.FREE else start
        if clear_until > start:
            opening = False
            start = max(start, clear_until - rounding)
        if not self.pairs or (start >= stop and not opening):
            return Marched(Ended.REACHED, span[1], half=half_bracket)
        grazes = dips or half_bracket != kernels.NO_BRACKET
        while True:
            most_work = max(min(self.work, self.budget.left), 1.0)
            result = self._march.run(start, stop, self.leaders, opening, half_bracket, grazes, rounding, most_work)
            self.spend(result.work)
            self.budget.look()
            if result.ended is not Ended.CAPACITY:
                break
            self.resize(min(4 * self.room, self.dragon.benches))
        proven = span[1] if result.ended is Ended.REACHED else max(result.proven - rounding, span[0])
        touching = span[0] if result.ended is Ended.TOUCHED_AT_START else result.touching
        return result._replace(proven=proven, touching=touching, half=half_bracket)

    def approach(self, begin: float, until: float, head_speed: float, *, opening: bool = True) -> Marched:
        """march() between two travels [m], with the narrowest bracket that rounding allows around its contact."""
        half_bracket = max(BRACKET * min(1.0, head_speed), BRACKET_MIN, 2.0 * self.travel_rounding(begin, until))
        result = self.march(until, half_bracket, start=begin, opening=opening)
        if result.ended is not Ended.STUCK or result.touching is None:
            return result
        for wider in sorted({*BRACKETS_GRAZING, *(wider * min(1.0, head_speed) for wider in BRACKETS_GRAZING)}):
            if result.ended is not Ended.STUCK or result.touching is None:
                break
            if wider > half_bracket:
                if self.kinds.some:  # one step of hulls costs more than laying out all benches anew
                    result = joined(result, self.march(until, wider, start=result.proven))
                else:
                    proven = result.proven
                    result = self.march(until, wider, start=begin, opening=opening)
                    result = result._replace(proven=max(proven, result.proven))
        return result

    def others_clear(self, pair: Pair, start: float, stop: float) -> bool:
        """True if all pairs except one are proven clear between two travels [m]."""
        self.scene.left_out, self.scene.left_out_too = pair
        result = self.march(stop, kernels.NO_BRACKET, start=start)
        self.scene.left_out = self.scene.left_out_too = kernels.NO_BENCH
        return result.ended is Ended.REACHED

    def narrow_half(self, result: Marched, head_speed: float) -> float | None:
        """Half width to which core/contact/near_graze.py may narrow a wide bracket [m]; None if it is narrow enough, or
        rounding of travels does not allow it."""
        narrow = BRACKETS_GRAZING[0] * min(1.0, head_speed)
        if self.stray or result.ended is not Ended.TOUCHED:
            return None
        return narrow if result.half > narrow >= 2.0 * self.travel_rounding(result.touching or 0.0) else None

    def fold_stops(self, begin: float, until: float, end: RunEnd) -> list[Interval]:
        """Travels before a fold, at `until`, at which a march may end, and their distances from it [m].

        The last one is so near to the fold that its distance does not matter.
        """
        assert end.theta is not None
        assert end.bench is not None
        stops, last = [], before_fold(until)
        for part in FOLD_WAYS:
            way = part * float(self.dragon.chords[end.bench])
            early = min(last, self.travel_at(end.theta) - way)
            if begin < early - way:
                stops.append((early, way))
                begin = early - way
        return [*stops, (last, 0.0)]

    def surely_within(self, travel: float, pair: Pair) -> bool:
        """True if two benches are certainly within the margin after a travel [m], in spite of rounding."""
        slack = self.travel_rounding(travel)
        place = self.place - travel + slack
        return float(kernels.pair_most(self.scene, self.probe, place, 2.0 * slack, *pair)) <= self.margin

    def place_leaders(self, travel: float, leaders: int) -> None:
        """Fill `placed` with a number of leading benches after a travel [m], without pairs."""
        self._clearance(travel, leaders, 0)

    def clearance(self, travel: float, leaders: int | None = None) -> tuple[float, Pair]:
        """Clearance after a travel [m], and its pair; only among pairs led by the first `leaders` benches."""
        benches = self.room
        if leaders is None:
            leaders = benches
        elif self.path.spiral is not None:
            benches = min(benches, leaders + self._followed(travel, leaders))
        return self._clearance(travel, benches, leaders)

    def _clearance(self, travel: float, benches: int, leaders: int) -> tuple[float, Pair]:
        gap, a, b = kernels.clearance_at(self.scene, self.place - travel, benches, leaders, self.placed, self.motion)
        self.budget.look()
        return float(gap), (a, b)

    def _followed(self, travel: float, leaders: int) -> int:
        """Number of benches behind the leaders of a spiral that can be as near to them as the leaders' own sizes."""
        start, growth = self.theta_at(travel), self.growth
        rear = growth * start + leaders * self.rings.all_chord
        reach = kernels.leaders_reach(growth, growth * start, rear, self.rings) + self.rings.all_length
        beyond = kernels.radius_beyond(growth, reach, self.rings) / growth
        arc = growth * (kernels.spiral_arc(max(beyond, start)) - kernels.spiral_arc(start))
        return 2 + int(arc / self.rings.all_shortest)

    def rates(self, travel: float) -> Floats:
        """Speed of every handle along the path over the head's after a travel [1]; negative for one that moves back."""
        self.clearance(travel)
        return self.placed[: self.room + 1, kernels.RATE].copy()

    def gap_rate(self, travel: float, pair: Pair) -> float:
        """Rate at which a pair parts after a travel, per metre of head travel [1]."""
        self.budget.look()
        return float(kernels.gap_rate_at(self.scene, self.place - travel, *pair, self.tried))

    def bottom(self, low: float, high: float, pair: Pair, width: float) -> float:
        """Travel in [low, high] at which a pair stops approaching [m]."""
        travel = float(kernels.bottom_between(self.scene, low, high, *pair, width, self.tried))
        self.budget.look()
        return travel


def before_fold(until: float) -> float:
    """Last travel of a march to a fold at a travel [m]."""
    return until - (FOLD_SLIVER + 5e2 * TRAVEL_ROUNDING * until)


def joined(passed: Marched, further: Marched) -> Marched:
    """The joint result of a march and of its continuation."""
    return further._replace(
        proven=max(passed.proven, further.proven),
        steps=passed.steps + further.steps,
        work=passed.work + further.work,
        gap_curvature=max(passed.gap_curvature, further.gap_curvature),
        graze=min((dip for dip in (passed.graze, further.graze) if dip is not None), default=None),
    )

"""Stage: a performance in the form that the kernels need, with all its benches in one scene."""

from __future__ import annotations

import math
from itertools import combinations, pairwise

import numpy as np

from core import kernels
from core.contact.brackets import FOLD_SLIVER, TRAVEL_ROUNDING
from core.contact.gaps import PROFILE_STEP, sample_count
from core.contact.search import NEAR_WORK_BUDGET, ContactSearch, SearchInput
from core.dance import NEAR_FOLD
from core.dragon import Dragon
from core.kernels import Budget
from core.kernels.constants import (
    BOX_COLUMNS,
    CHAIN_COLUMNS,
    CLEAR_SPARE,
    FREE,
    MOTION_COLUMNS,
    SIZE_COLUMNS,
    ULP,
)
from core.kernels.results import Dip
from core.paths.frame import Frame
from core.performance import Part, Performance
from core.sampling import bisect, crossing
from core.shapes.reach import directions, reach
from core.values import Interval, Pair

# The instants of an ensemble at which its benches are laid out: both ends of a step, and another one.
BEFORE, AFTER, PROBED = range(3)
# Width of the bottom of a graze [s].
DIP_WIDTH = 1e-10
# Part by which the length of a step, and the way of a head in it, are widened for the rounding of both [1].
WIDTH_ROUNDING = 1e-12
# Largest relative error of a place [1]: a product, a sum and a difference, and as much to spare.
PLACE_ROUNDING = 6.0 * ULP
# Largest relative error of the time of a part's own dance, and of a time at which its speed changes [1]: a sum each.
OWN_TIME_ROUNDING = 2.0 * ULP
# Relative width to which a radius outside which all benches of two dragons keep apart is bisect [1]; and the largest
# such radius [m].
RINGS_WIDTH, RINGS_MOST = 1e-3, 1e6


class Player:
    """A part on the stage: its search, its rows, and the speed of its head.

    search: its benches and path; first: row of its head; slip: largest distance of its head from a computed place [m]
    begin, end: times of the performance between which it moves [s]

    A time at which the speed changes is rounded. So let the speed change at the rounded time instead: that moves the
    head by less than half of slip at every instant, and the other half is for the places at both ends of a step.
    """

    def __init__(self, part: Part, search: ContactSearch, first: int, span: Interval) -> None:
        self.part, self.search, self.first, self.clock = part, search, first, part.dance.clock
        self.begin, self.end, self.benches = part.begin, part.end, part.dance.dragon.benches
        local = [time - part.delay for time in span]
        until = max(map(abs, local))
        fastest = max(self.clock.speeds)
        timing = self.clock.rounding(until) + fastest * OWN_TIME_ROUNDING * (
            until + abs(part.delay) + max(map(abs, span))
        )
        travels = [self.clock.travel(part.own_time(time)) for time in span]
        furthest = max(search.place, *(max(abs(travel), search.place - travel) for travel in travels))
        self.slip = 2.0 * (search.path.slide + timing + PLACE_ROUNDING * furthest)

    @property
    def sliver(self) -> float:
        """Time before its fold that only the bound on the remaining motion covers [s]."""
        way = FOLD_SLIVER + 5e2 * TRAVEL_ROUNDING * abs(self.travel(self.end)) + 4.0 * self.slip
        return way / self.clock.slowest + 4.0 * float(np.spacing(abs(self.end)))

    def travel(self, time: float) -> float:
        """Travel of the head at a time of the performance [m]."""
        return self.clock.travel(self.part.own_time(time))

    def place(self, time: float) -> float:
        """Place of the head, as the kernels need it [m]."""
        return self.search.place - self.travel(time)

    def speed(self, begin: float, until: float) -> float:
        """Speed of the head between two times between which it does not change [m/s]."""
        middle = begin + 0.5 * (until - begin)
        if not self.begin < middle < self.end:
            return 0.0
        return float(self.clock.speed(np.array(middle - self.part.delay)))

    def changes(self) -> list[float]:
        """Times of the performance at which the speed of the head changes [s]."""
        nodes = self.clock.times if self.clock.passages else []
        return [self.begin, *(time + self.part.delay for time in nodes), self.end]


class Stage:
    """The benches of all dragons of a performance, in one scene of the kernels.

    players: one for each part; ensemble: the kernels' loops over all; owner: (rows,) the part of each row
    own_sizes: (rows, SIZE_COLUMNS) of the benches themselves; with a stray the scene has the ground that they may cover
    work: what is left of its own work [1], within the budget of the whole question
    chains: rows at both ends of a step and at another instant; motion: bounds over a step, in time
    rings: {(i, j): radius outside which the benches of two dragons in one spiral keep apart} [m]
    """

    def __init__(
        self,
        performance: Performance,
        span: Interval,
        margin: float,
        *,
        stray: float = 0.0,
        work: float = NEAR_WORK_BUDGET,
        budget: Budget | None = None,
    ) -> None:
        self.performance, self.span, self.margin, self.stray = performance, span, margin, stray
        self.budget, self.work = budget or Budget(), work
        self.players: list[Player] = []
        first = 0
        for part in performance.parts:
            sought = SearchInput(part.dance.dragon, part.dance.path, margin, stray=stray, whole=True)
            search = ContactSearch(sought, budget=self.budget)
            self.players.append(Player(part, search, first, span))
            first += part.dance.dragon.benches + 1
        self.turning = _winding_together(performance)
        self.rings = self._rings()
        self._lay_out(first)

    def _lay_out(self, rows: int) -> None:
        """Make the arrays for a number of rows."""
        players = self.players
        sizes, self.own_sizes = np.zeros((rows + 1, SIZE_COLUMNS)), np.zeros((rows + 1, SIZE_COLUMNS))
        self.owner = np.repeat(np.arange(len(players)), [player.benches + 1 for player in players])
        blocks: list[tuple[int, int, int]] = []
        for k, player in enumerate(players):
            own = slice(player.first, player.first + player.benches)
            sizes[own], self.own_sizes[own] = (
                player.search.sizes[: player.benches],
                player.search.own_sizes[: player.benches],
            )
            edges = [*range(own.start, own.stop, kernels.BENCHES_PER_BLOCK), own.stop]
            blocks += [(begin, end, k) for begin, end in pairwise(edges)]
        following = np.searchsorted([k for _, _, k in blocks], [k + 1 for _, _, k in blocks])
        growth = max((players[k].search.growth for k in self.turning), default=1.0)
        scene = kernels.Scene(kernels.spiral_curve(growth), 0.0, players[0].search.rings, sizes, rows, 0)
        scene.margin, scene.budget, scene.kinds = self.margin, self.budget, self._kinds(rows)
        self.scene, self.sizes = scene, sizes
        self.chains = np.zeros((3, rows + 1, CHAIN_COLUMNS))
        before, after, probed = self.chains
        self.motion = np.zeros((rows + 1, MOTION_COLUMNS))
        interval = kernels.Interval(scene, before, after, self.motion)
        members = [
            kernels.Member(
                player.search.interval, player.search.probed, player.first, player.benches,
                _placed(player.part.dance.path.frame), k in self.turning,
            )
            for k, player in enumerate(players)
        ]  # fmt: skip
        clear = np.full((len(players), len(players)), FREE)
        for (i, j), radius in self.rings.items():
            clear[i, j] = clear[j, i] = radius
        table = np.column_stack([np.array(blocks, dtype=np.int64), following.astype(np.int64)])
        scratch = np.empty((len(blocks), BOX_COLUMNS + 1)), np.empty((rows + 1, BOX_COLUMNS))
        self.ensemble = kernels.Ensemble(interval, probed, members, np.ascontiguousarray(table), scratch, clear)

    def _kinds(self, rows: int) -> kernels.Kinds:
        """The hulls of the ground that all benches may cover; none without a stray."""
        kinds = kernels.Kinds()
        if self.stray > 0.0:
            hulls, of, count = [], np.zeros(rows + 1, dtype=np.int64), 0
            for player in self.players:
                ground = reach(player.part.dance.dragon, self.stray)
                known = np.minimum(np.arange(player.benches + 1), len(ground.kinds) - 1)
                of[player.first : player.first + player.benches + 1] = ground.kinds[known] + count
                hulls.append(ground.hulls.reshape(-1, 2))
                count += len(ground.hulls)
            kinds.lay(np.concatenate(hulls), of, directions())
        return kinds

    def _rings(self) -> dict[Pair, float]:
        """Radii outside which the benches of two dragons on spirals of one growth, centre and sense keep apart [m]."""
        clear: dict[Pair, float] = {}
        for i, j in combinations(sorted(self.turning), 2):
            one, two = self.players[i], self.players[j]
            if one.search.growth != two.search.growth or self.stray > 0.0:
                continue
            turned, rotation = (player.part.dance.path.frame.rotation for player in (one, two))
            angle = abs(math.remainder(turned - rotation, math.tau))
            radius = clear_of_each_other(one.search.growth, angle, (one.search.dragon, two.search.dragon), self.margin)
            if radius is not None:
                clear[i, j] = radius
        return clear

    def clear_until(self) -> float:
        """Time until which all pairs of dragons wind outside the radius from which they keep apart [s]; the start if
        any two do not."""
        begin, until = self.span
        for pair in combinations(range(len(self.players)), 2):
            radius = self.rings.get(pair)
            if radius is None:
                return begin
            for player in (self.players[k] for k in pair):
                travel = player.search.travel_at(radius / player.search.growth) - player.slip
                if travel <= player.travel(begin):
                    return begin
                until = min(until, player.clock.time(travel) + player.part.delay)
        # a time that is turned into a travel and back is off by a few roundings
        return max(begin, until - WIDTH_ROUNDING * (abs(until) + abs(begin)))

    def breaks(self, begin: float, until: float) -> list[float]:
        """Times from begin to until between which no speed of a head changes [s]."""
        changes = {time for player in self.players for time in player.changes() if begin < time < until}
        return [begin, *sorted(changes), until]

    def enter(self, begin: float, until: float) -> list[float]:
        """Speeds of all heads between two breaks [m/s]; lays out everyone at the first one and lets those stand still
        that do."""
        speeds = [player.speed(begin, until) for player in self.players]
        for k, speed in enumerate(speeds):
            self.stand(k, BEFORE, begin, speed)
            if speed == 0.0:
                self.ensemble.rest(k)
        return speeds

    def stand(self, k: int, which: int, time: float, speed: float, last: int | None = None) -> bool:
        """Lay out a dragon at a time [s], up to a handle; False if a bench folds."""
        player = self.players[k]
        last = player.benches if last is None else last
        self.spend(float(last))
        return bool(self.ensemble.stand(k, which, player.place(time), player.slip, speed, last))

    def step(self, begin: float, until: float, speeds: list[float]) -> bool:
        """Lay out everyone at the end of a step, and bound all gaps over it; False where no bound is known."""
        h = (until - begin) * (1.0 + WIDTH_ROUNDING)
        for k, speed in enumerate(speeds):
            if speed > 0.0:
                if not self.stand(k, AFTER, until, speed):
                    return False
                if not self.ensemble.move(k, h * speed * (1.0 + WIDTH_ROUNDING) + 2.0 * self.players[k].slip, speed):
                    return False
        self.ensemble.bound(h)
        self.spend(kernels.STEP_WORK + self.ensemble.tried)
        self.budget.look()
        return True

    def pair(self, a: int, b: int) -> tuple[Pair, Pair]:
        """Dragons and benches of two rows."""
        i, j = int(self.owner[a]), int(self.owner[b])
        return (i, j), (a - self.players[i].first, b - self.players[j].first)

    def rows(self, dragons: Pair, benches: Pair) -> Pair:
        """Rows of a bench of each of two dragons."""
        (i, j), (a, b) = dragons, benches
        return self.players[i].first + a, self.players[j].first + b

    def probe(self, time: float, rows: Pair) -> None:
        """Lay out two benches at a time [s]."""
        for row in rows:
            k = int(self.owner[row])
            player = self.players[k]
            self.stand(k, PROBED, time, player.speed(time, time), row - player.first + 1)

    def gap(self, time: float, rows: Pair) -> float:
        """Separation of two rows at a time [m]."""
        self.probe(time, rows)
        return float(self.ensemble.separation(PROBED, *rows))

    def gap_most(self, time: float, rows: Pair) -> float:
        """Upper bound of that separation, in spite of rounding [m]."""
        self.probe(time, rows)
        return float(self.ensemble.separation(PROBED, *rows) + self.ensemble.rounding(PROBED, *rows))

    def gap_rate(self, time: float, rows: Pair) -> float:
        """Rate at which two rows part at a time [m/s]."""
        self.probe(time, rows)
        return float(self.ensemble.rate(PROBED, *rows))

    def nearest(self, known: Pair = (0, 0)) -> tuple[float, Pair]:
        """The least gap at the start of the step, and its two rows; known: a pair to begin with."""
        self.ensemble.nearest(BEFORE, *known)
        self.budget.look()
        return float(self.ensemble.gap), (self.ensemble.first, self.ensemble.second)

    def look(self, time: float, known: Pair = (0, 0)) -> Dip:
        """The least gap at a time [s]; known: rows to begin with, which stay if no others are nearer.

        Where a bench folds at that time, its dragon stands as it does just before (Player.sliver).
        """
        self.budget.afford(len(self.owner))
        for k, player in enumerate(self.players):
            if not self.stand(k, BEFORE, time, 0.0):
                self.stand(k, BEFORE, time - player.sliver, 0.0)
        gap, rows = self.nearest(known)
        return Dip(gap, time, rows)

    sample = look

    def bottom(self, low: float, high: float, rows: Pair) -> float:
        """Time between two at which a pair stops approaching [s]."""
        return crossing(lambda time: -self.gap_rate(time, rows), low, high, DIP_WIDTH)

    @property
    def count(self) -> int:
        """Number of samples over the span."""
        begin, until = self.span
        shortest = min(float(player.part.dance.dragon.chords.min()) for player in self.players)
        step = PROFILE_STEP * shortest / max(max(player.clock.speeds) for player in self.players)
        return sample_count((until - begin) / step, min(self.work, self.budget.left), len(self.owner))

    @property
    def spacing(self) -> float:
        """Time between two samples [s]."""
        return (self.span[1] - self.span[0]) / (self.count - 1)

    def spend(self, work: float) -> None:
        """Subtract work done from the work left [1]."""
        self.work -= work
        self.budget.spend(work)

    @property
    def spent(self) -> bool:
        """True if no work is left."""
        return self.work <= 0.0 or self.budget.left <= 0.0

    def folding(self, until: float) -> list[int]:
        """The parts that fold at a time [s] or within NEAR_FOLD after it."""
        return [
            k
            for k, player in enumerate(self.players)
            if player.part.folds and player.end <= until + NEAR_FOLD / player.clock.slowest
        ]


def _placed(frame: Frame) -> tuple[float, float, float, float, float]:
    """Origin of a path, direction of its x axis, and its side, for the kernels."""
    cos, sin = (1.0, 0.0) if frame.rotation == 0.0 else (math.cos(frame.rotation), math.sin(frame.rotation))
    return (*frame.centre, cos, sin, 1.0 if frame.clockwise else -1.0)


def _winding_together(performance: Performance) -> set[int]:
    """The parts of the largest group on spirals with one centre and sense."""
    groups: dict[tuple[object, bool], set[int]] = {}
    for k, part in enumerate(performance.parts):
        if part.dance.path.spiral is not None:
            frame = part.dance.path.frame
            groups.setdefault((frame.centre, frame.clockwise), set()).add(k)
    together = max(groups.values(), key=len, default=set())
    return together if len(together) > 1 else set()


def clear_of_each_other(growth: float, angle: float, dragons: tuple[Dragon, Dragon], margin: float) -> float | None:
    """Radius outside which benches of two dragons keep apart by more than the margin [m]; None if there is none.

    Both wind into spirals of one growth [m/rad], centre and sense, one turned against the other by an angle [rad].
    """
    rings = kernels.Rings()
    chords, overhangs, widths, lengths = (
        np.concatenate([getattr(dragon, name)[: dragon.uniform_from + 1] for dragon in dragons])
        for name in ("chords", "overhangs", "widths", "lengths")
    )
    rings.measure(chords, overhangs, widths, lengths, len(chords) - 1, 0)

    def clears(radius: float) -> bool:
        rounding = float(kernels.ring_rounding(growth, radius, rings))
        return float(kernels.spirals_least(growth, angle, radius, rings)) - rounding > margin

    if not clears(RINGS_MOST):
        return None
    return bisect(clears, 0.0, RINGS_MOST, relative=RINGS_WIDTH)[1] * (1.0 + CLEAR_SPARE)

"""March: proven steps in time to the first moment at which benches of two dragons come within the margin.

Input.  A stage, two times, and half the width of the bracket around an encounter.
State.  `time`; `length`, the step to try; `aim`, the time of a crossing at which this step stops short.
Output. The record Marched.

Invariant, whenever a step begins: no benches of two dragons come within the margin from the start up to `time`. A step
is taken only if Ensemble.bound() proves more than the margin, after rounding, for every pair of benches of two dragons
at every instant of it (core/kernels/ensemble.py). That proof does not depend on the length of the step: between its
ends a gap along an axis falls below its chord by K x (h - x) / 2 at most. So a graze cannot be stepped over. Steps end
where the speed of a head changes, so that within a step each head has one speed, and share their ends to the last bit,
so that they tile the time without a gap. All heads are computed at the same exact time; how far each truly is from its
computed place is in the error of every row.

The end. As in core/kernels/marching.py: the pair with the least bound, if it is within the margin at the end of a
refused step, has a crossing in the step. The next step ends half a bracket before it. If that is proven for all pairs,
and the pair is within the margin half a bracket after it for certain, in spite of rounding, the first encounter lies
between these two times.

Before a fold, where speeds grow without bound, the march ends early: what every bench still moves until the fold is
bounded (core/contact/fold.py), and the gaps there exceed the margin by more than the sum for both benches.
"""

from __future__ import annotations

import numpy as np

from core.contact.brackets import FOLD_WAYS
from core.contact.fold import THETA_ROUNDING, moved_until
from core.contact.stage import AFTER, BEFORE, PROBED, WIDTH_ROUNDING, Stage
from core.kernels import Ended
from core.kernels.constants import CORNER_SPEED, FREE, NO_BOUND
from core.kernels.results import Dip, Marched
from core.sampling import crossing
from core.values import Pair

# Half widths of the bracket around an encounter [s]: the first one as a rule, the others where benches meet so slowly
# that rounding hides the gap.
HALF_BRACKETS = (1e-10, 4.9e-10, 1e-9, 2e-9, 5e-9, 1e-8, 2e-8, 5e-8, 5e-7, 5e-6, 5e-5)
# A half width is at least this many units of the last digit of the times [1], and lets two benches approach by this
# many times the rounding of their gap [1].
HALF_DIGITS, HALF_ROUNDINGS = 8.0, 1.5
# Shortest useful step, as a part of half the bracket [1]; first step to try [s].
LEAST_STEP, FIRST_STEP = 0.05, 1.0
# Part of the width at which the same bounds would just have proven a step [1].
TRUSTED = 0.95
# Least speed at which two benches that meet are taken to close [m/s].
LEAST_CLOSING = 1e-12
# Distance in time ahead at which an encounter is looked for whose beginning rounding hides [s].
PEEK = 1e-4
# Width of a crossing, relative to half the bracket [1].
CROSSING_WIDTH = 1e-3
# Times ahead at which a search that gave up looks for a certain encounter [s].
BEYOND = (1e-3, 1e-1)


class EncounterMarch:
    """The steps of one march on a stage, see the top of this file.

    dips: True looks for the least graze on the way
    """

    def __init__(self, stage: Stage, *, dips: bool = True) -> None:
        self.stage, self.dips = stage, dips
        self.steps, self.curvature, self.graze = 0, 0.0, None
        self.time = self.length = 0.0
        self.work = stage.work
        self.halves = list(HALF_BRACKETS)
        self.half: float = HALF_BRACKETS[0]
        self.aim: float | None = None
        self.rows: Pair = (0, 0)
        self.touching: float | None = None
        self._seen: list[tuple[float, float, Pair, float]] = []

    graze: Dip | None

    def run(self, begin: float, until: float) -> Marched:
        """The first encounter between two times [s]; wider brackets are tried where narrow ones fail."""
        least = HALF_DIGITS * float(np.spacing(max(abs(begin), abs(until))))
        self.halves = [half for half in HALF_BRACKETS if half > least] or [least]
        met = self._run(begin, until)
        while met.ended is Ended.STUCK and met.touching is not None and self.halves[1:] and not self.stage.spent:
            self.halves = [half for half in self.halves if half > self.half] or self.halves[-1:]
            stuck, met = met.proven, self._run(met.proven, until)
            met = met._replace(proven=max(met.proven, stuck))
            if len(self.halves) == 1:
                break
        return met

    def try_once(self, begin: float, until: float, half: float) -> Marched:
        """A march between two times [s] that looks for no narrower bracket than this, and so for no shorter steps."""
        self.halves = [half]
        return self._run(begin, until)

    def _run(self, begin: float, until: float) -> Marched:
        self.time, self.half, self.aim, self.touching, self._seen = begin, self.halves[0], None, None, []
        self.length = FIRST_STEP
        stage = self.stage
        stage.enter(begin, until)
        gap, rows = stage.nearest()
        if gap <= stage.margin:
            self.rows = rows
            certain = stage.gap_most(begin, rows) <= stage.margin
            return self._met(Ended.TOUCHED_AT_START if certain else Ended.STUCK, begin if certain else None)
        breaks = stage.breaks(begin, until)
        for k in range(len(breaks) - 1):
            self.time = breaks[k]
            speeds = stage.enter(breaks[k], breaks[k + 1])
            if not any(speeds):
                continue
            ended = self._march(breaks[k + 1], until, speeds)
            if ended is not Ended.REACHED:
                return self._met(ended, self.touching)
        self.time = until
        return self._met(Ended.REACHED, None)

    def _met(self, ended: Ended, touching: float | None) -> Marched:
        spent = self.steps, self.work - self.stage.work, self.curvature
        return Marched(ended, self.time, touching, self.rows, self.half, *spent, self.graze)

    def _march(self, stop: float, until: float, speeds: list[float]) -> Ended:
        """Take steps up to `stop`, within which no speed changes; until: end of the whole march [s]."""
        stage, ensemble = self.stage, self.stage.ensemble
        while self.time < stop:
            shortest = max(LEAST_STEP * self.half, 2.0 * float(np.spacing(abs(self.time))))
            if stage.spent or self.length < shortest:
                return Ended.STUCK
            end = stop if self.time + self.length >= stop else self.time + self.length
            self.steps += 1
            # A step that ends at a break says nothing of the next one, however short it is.
            tried = self.length if end == stop else end - self.time
            self.length = end - self.time
            if not stage.step(self.time, end, speeds) or ensemble.least == NO_BOUND:
                self.length, self.aim = 0.5 * self.length, None
                continue
            if ensemble.least <= stage.margin:
                if self._narrow(end, until):
                    return Ended.TOUCHED
                continue
            self.curvature = max(self.curvature, float(ensemble.curvature))
            width = float(ensemble.width)
            self.time = end
            ensemble.advance()
            self._stand_still(speeds)
            if self.aim is not None and self._certain(self.aim + self.half):
                return Ended.TOUCHED
            self.aim = None
            self._note()
            self.length = min(TRUSTED * width, 2.0 * tried)
        return Ended.REACHED

    def _stand_still(self, speeds: list[float]) -> None:
        """Copy the rows of those who stand to the other end, because both ends changed places."""
        for k, speed in enumerate(speeds):
            if speed == 0.0:
                self.stage.ensemble.rest(k)

    def _certain(self, time: float) -> bool:
        """True if the pair of the crossing is within the margin at a time, in spite of rounding; keeps it then."""
        if self.stage.gap_most(time, self.rows) > self.stage.margin:
            return False
        self.touching = time
        return True

    def _narrow(self, end: float, until: float) -> bool:
        """After a step whose bound does not exceed the margin: look for a crossing in it, or shorten it.

        returns: True if the encounter is found
        """
        stage, ensemble = self.stage, self.stage.ensemble
        rows, width = (ensemble.first, ensemble.second), TRUSTED * ensemble.width
        if ensemble.separation(AFTER, *rows) > stage.margin:
            self.aim = None
            self.length = width if 0.5 * self.length <= width < self.length else 0.5 * self.length
            if self.length >= self.half:
                return False
            ahead = self._peek(rows, until)
            if ahead is None:
                return False
            end = ahead
        self.rows = rows
        self.aim = self.touching = crossing(
            lambda time: stage.gap(time, rows) - stage.margin, self.time, end, CROSSING_WIDTH * self.half
        )
        closing = -stage.gap_rate(self.aim, rows)
        enough = HALF_ROUNDINGS * float(ensemble.rounding(PROBED, *rows)) / max(closing, LEAST_CLOSING)
        self.half = next((half for half in self.halves if half >= enough), self.halves[-1])
        way = self.aim - self.half - self.time
        if 0.0 < way < self.length:
            self.length = way
            return False
        if way <= 0.0 and self._certain(self.aim + self.half):
            return True
        self.length, self.aim = 0.5 * self.length, None
        return False

    def _peek(self, rows: Pair, until: float) -> float | None:
        """A time a little ahead at which a pair is within the margin; None if there is none before the end."""
        width = 2.0 * self.half
        while width <= PEEK:
            ahead = self.time + width
            if ahead > until:
                return None
            if self.stage.gap(ahead, rows) <= self.stage.margin:
                return ahead
            width *= 4.0
        return None

    def _note(self) -> None:
        """Note a local minimum of the clearance at the last three times."""
        if not self.dips:
            return
        known = self._seen[-1][2] if self._seen else (0, 0)
        least = self.stage.ensemble.least
        gap, rows = self.stage.nearest(known)
        self._seen = [*self._seen[-2:], (self.time, gap, rows, least)]
        if len(self._seen) < 3:
            return
        (older, first, _, _), (_, gap, rows, floor), (newer, last, _, _) = self._seen
        lowest = FREE if self.graze is None else self.graze.gap
        if first > gap <= last and min(floor, least) < lowest and gap < FREE:
            stage = self.stage
            time = stage.bottom(older, newer, rows)
            bottom = stage.gap(time, rows)
            if bottom < lowest:
                self.graze = Dip(bottom, time, rows)


def to_fold(stage: Stage, march: EncounterMarch, begin: float, until: float, folding: list[int]) -> Marched:
    """March from a time to the first fold [s]; REACHED: clear up to it.

    folding: the parts that fold then or just after, whose motion is bounded at the end instead of followed
    """
    last = until - max(stage.players[k].sliver for k in folding)
    met = Marched(Ended.REACHED, begin)
    begins = begin
    for part in (*FOLD_WAYS, 0.0):
        early = last
        for k in folding:
            player = stage.players[k]
            bench = player.part.dance.end.bench or 0
            way = part * float(player.search.dragon.chords[bench]) / player.clock.slowest
            early = min(early, until - way)
        if early <= begins:
            continue
        met = march.run(begins, early)
        begins = met.proven
        if met.ended is not Ended.REACHED:
            return met
        if least_after(stage, early, until, folding) > stage.margin:
            return met._replace(proven=until)
    if begins < last or least_after(stage, max(begin, last), until, folding) <= stage.margin:
        return met._replace(ended=Ended.STUCK, touching=None)
    return met._replace(proven=until)


# From `time` to the fold a bench of a part that folds moves by no more than moved_until() bounds, from a head a little
# further back, so that its true place is included. A bench of another part moves by its corner's speed at most.
def least_after(stage: Stage, time: float, until: float, folding: list[int]) -> float:
    """Lower bound of the gaps of all pairs from a time to a fold [m]; NO_BOUND if none is known."""
    moved = np.zeros(len(stage.sizes))
    for k, player in enumerate(stage.players):
        own = slice(player.first, player.first + player.benches)
        if k not in folding:
            way = _way_of(stage, k, time, until)
            if way is None:
                return NO_BOUND
            moved[own] = way * player.search.motion[: player.benches, CORNER_SPEED]
            continue
        travel = player.travel(time) - 4.0 * player.slip
        player.search.place_leaders(travel, player.benches)
        theta = player.part.dance.end.theta
        assert theta is not None
        _, ways = moved_until(player.search, theta * (1.0 - THETA_ROUNDING))
        moved[own] = ways
    for k in range(len(stage.players)):
        if not stage.stand(k, BEFORE, time, 0.0):
            return NO_BOUND
    return float(stage.ensemble.left(moved))


def _way_of(stage: Stage, k: int, time: float, until: float) -> float | None:
    """Way of the head of a part that does not fold, from a time to the fold of another one [m], if its search has the
    bounds on the motion of its benches for it; None if there are none."""
    player = stage.players[k]
    if not stage.stand(k, BEFORE, time, 0.0) or not stage.stand(k, AFTER, until, 0.0):
        return None
    way = (player.travel(until) - player.travel(time)) * (1.0 + WIDTH_ROUNDING) + 2.0 * player.slip
    return way * (1.0 + WIDTH_ROUNDING) if stage.ensemble.move(k, way, 1.0) else None


def beyond(stage: Stage, met: Marched, until: float) -> Marched | None:
    """A certain encounter after a time at which a march gave up, perhaps not the first; None if none is known."""
    for ahead in BEYOND:
        begin = met.proven + ahead
        if begin >= until or stage.spent:
            return None
        later = EncounterMarch(stage, dips=False).run(begin, until)
        if later.touching is not None and later.ended in (Ended.TOUCHED, Ended.TOUCHED_AT_START):
            return later
        if later.ended is Ended.REACHED:
            return None
    return None

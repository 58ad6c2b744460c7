"""The shortest turn: two tangent arcs with any entry and exit inside the circle, as a proven bracket of the length.

The turns are those of core/paths/turn.py: the entry at a radius a, the exit at a radius b, both at most that of the
circle, and a ratio of the arcs' radii, known or free. A turn counts if both radii are at least half the longest chord
over ROUTE_SINE_LIMIT (core/kernels/constants.py), so that every bench can follow, and if no two benches come within the
margin on all of its coils and arcs. Turns with a tighter arc that every bench is proven to follow
(core/paths/following.py) do not count, though some are shorter: see core/design/followed_turn.py.

Above: a turn that was danced, and proven free of contact by first_contact() (core/design/deepest_turn.py: contact_in).
Below: branch and bound. Boxes of (a, v, log ratio) cover all turns (v: core/design/turn_boxes.py). A box is excluded
    - if one arc of all its turns is too tight, or an end is outside the circle, or on a coil too tight to follow;
    - if all its turns are longer than the shortest known turn less the width of the bracket;
    - if one pose is exhibited that overlaps in all its turns (core/design/turn_overlap.py);
and divided otherwise. When no box is left, no shorter turn exists. If the ratio is free or 1, and the benches of poses
are equal, only one of a turn and the same danced backwards is in a box: the other is as long and has the same arcs, and
an overlapping pose of one, its handles in reverse order, is a pose of the other. That arcs stay inside the circle is
required of the turn above, and not used below: arcs of short turns do, and without it the bound is lower at most.
The search is over all turns of the family; it assumes the arithmetic of doubles, with allowances for its rounding.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.contact.answer import Outcome
from core.design.deepest_turn import TurnLimit, contact_in, refusal, refuse_bend
from core.design.turn_bounds import (
    Boxes,
    Multipliers,
    divided,
    first_boxes,
    joined,
    least_entry,
    lower_lengths,
    multipliers_at,
    one_of_mirrored,
)
from core.design.turn_boxes import Turns, sizes_of, too_tight, turns_in
from core.design.turn_circle import CheckedCircle, checked_circle
from core.design.turn_moves import apart_from_circle, box_of, coil_bend, least_bend
from core.design.turn_overlap import OverlapSearch, most_benches
from core.design.turn_places import locally_shortest, starts
from core.display import TABLE_DIGITS, Readable, display
from core.dragon import Dragon, Stray, checked_stray, chord_values
from core.errors import InvalidValue
from core.kernels import Budget, Halted
from core.language import say
from core.paths.following import bends_widely
from core.paths.turn import RATIO_MAX, RATIO_MIN, Turn
from core.quantities import Quantity
from core.questions import question_about, too_much
from core.values import Floats

# Width of the bracket of the length [m].
LENGTH_WIDTH = 1e-6
# Largest work [1], see core/kernels/constants.py: 10 to 25 s. The contest's turn takes 2e6, one with equal arcs 1e8.
SHORTEST_WORK = 1.5e8
# The same over all ratios, of which the contest's dragon takes 5e8 and a minute.
RATIOS_WORK = 1.5e9
# Work by the time that it takes [1]: of the closed forms of a box, of the preparation of a box for its poses, and of a
# bench of a pose.
BOX_WORK, PREPARED_WORK, POSE_WORK = 200.0, 1e4, 8.0
# Half widths from which on an overlap is looked for, in chords, [rad] and [1]: larger boxes move benches too far.
OVERLAP_HALF = (0.025, 0.05, 0.06)
# Number of divisions after which an overlap is looked for again where there was none, and of those that make a box half
# as large; most dances of a round.
PATIENCE, DIRECTIONS = 3, 2
DANCES = 4
# Most places from which a locally shortest turn is looked for, and the work of one [1].
POLISHED, POLISH_WORK = 100, 2e5
# Most by which a locally shortest turn is longer than the best one if its multipliers are used too [m].
NEARLY = 0.1
# The same of a place on the grid from which a locally shortest one is looked for [m]; distance of places that count as
# one [m], [rad].
COARSE = 0.5
# Most multipliers that are used: each costs a tenth of a box [1].
MULTIPLIERS = 4
SAME = 1e-4
# Radius beyond the least one that still counts as limited by it [m].
AT_LIMIT = 1e-6
# Boxes whose closed forms are computed together: more would leave the processor's cache.
TOGETHER = 4096


@dataclass(frozen=True, slots=True, repr=False)
class ShortestTurn(Readable):
    """The shortest two-arc turn that the dragon can dance inside the circle, whatever its entry and exit.

    Of one ratio or any, and of bends of half a chord over 0.999 or more (shortest_turn()) or any (followed_turn()).
    turn: the turn, danced with proof
    length_bracket: proven: no turn of two arcs inside the circle is shorter; the length of this one [m]
    entry_bracket: entry radii between which those of every turn as short as that lie [m]
    exit_bracket: exit radii, as entry_bracket [m]
    limited_by: FOLLOWING (followed_turn() alone), or LEAST_RADIUS, CENTRE, CIRCLE or CONTACT, the first that applies to
        it: an arc, or the coil at an end, of the least radius; an end at the deepest radius that is tried; an end on
        the circle; else benches within the margin in turns beside it
    boxes: number of excluded boxes
    overlaps: number of those that an exhibited overlap excludes
    evaluations: number of turns danced

    >>> shortest = shortest_turn(Dragon(), 1.7)
    >>> round(shortest.turn.length, 6), shortest.limited_by.value
    (11.799152, 'least_radius')
    """

    turn: Turn
    length_bracket: tuple[float, float]
    entry_bracket: tuple[float, float]
    exit_bracket: tuple[float, float]
    limited_by: TurnLimit
    boxes: int
    overlaps: int
    evaluations: int

    def _line(self) -> str:
        low, high = self.length_bracket
        return say(
            "length {length} ({excess} or less above the shortest), entry {entry}, exit {exit}, ratio {ratio}, "
            "limited by {limit}",
            length=display(self.turn.length, "m"), excess=display(high - low, "m"), ratio=display(self.turn.ratio),
            entry=display(self.turn.entry_radius, "m"), exit=display(self.turn.exit_radius, "m"),
            limit=self.limited_by.words,
        )  # fmt: skip

    def _rows(self) -> list[tuple[str, str]]:
        return [("length", display(self.turn.length, "m", TABLE_DIGITS)), *Readable._rows(self)]


@question_about("dragon", Dragon)
def shortest_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float | None = 2.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    budget: Budget | None = None,
) -> ShortestTurn:
    """The shortest turn of two arcs inside the circle over all entries and exits, with a proven bracket of its length.

    pitch, turning_radius, margin [m]; ratio: radius of the first arc over that of the second, None: any from RATIO_MIN
    to RATIO_MAX; start_turns: of the coils; stray: largest distance of every hole from its place [m]
    The bracket is LENGTH_WIDTH wide; wider if the budget is spent, or for strays, because overlaps are exhibited
    without them
    budget: default: SHORTEST_WORK, with a free ratio RATIOS_WORK
    raises: TooMuchWork if it is stopped, or spent before a turn was danced; InvalidValue (turning_radius) if neither a
        locally shortest turn by the closed forms nor the one that begins and ends on the circle can be danced

    >>> answer = shortest_turn(Dragon(), 1.7)
    >>> round(answer.turn.length, 4), round(answer.turn.entry_radius, 4), answer.turn.exit_radius
    (11.7992, 4.2904, 4.5)
    """
    circle = checked_circle(pitch, turning_radius, ratio, start_turns, margin, any_ratio=True)
    stray = checked_stray(stray, dragon)
    work = (budget or Budget()).within(RATIOS_WORK if ratio is None else SHORTEST_WORK)
    return TurnSearch(dragon, circle, stray, work).answer()


class TurnSearch:
    """Branch and bound over boxes.

    mirrored: whether each turn also stands for the same turn danced backwards; best, shortest: the shortest turn that
        was danced with proof, and its length; longer: boxes excluded by their length; tried: places of locally shortest
        turns; multipliers: of those turns that are nearly as short as the best one; width: of the bracket [m];
        at_once: most boxes of a round, those of the shortest turns first
    """

    width = LENGTH_WIDTH
    at_once = sys.maxsize

    def __init__(
        self,
        dragon: Dragon,
        circle: CheckedCircle,
        stray: float,
        budget: Budget,
    ) -> None:
        self.dragon, self.circle, self.stray, self.budget = dragon, circle, stray, budget
        self.pitch, self.radius, self.ratio, _, self.margin = circle
        self.growth = circle.growth
        self.least = least_bend(dragon)
        self.inner = least_entry(self.growth, self.radius, self.least)
        self.overlap = OverlapSearch(dragon, self.margin, most_benches(dragon, self.radius))
        self.mirrored = self.overlap.equal and self.ratio in (None, 1.0)
        self.best: Turn | None = None
        self.shortest = math.inf
        self.boxes = self.overlaps = self.evaluations = 0
        self.longer: list[Boxes] = []
        self.multipliers: list[Multipliers] = []
        self.tried: list[Floats] = []
        self.polished = 0

    def answer(self) -> ShortestTurn:
        """The answer. raises: InvalidValue, TooMuchWork"""
        try:
            return self.searched()
        except Halted as halted:
            rule = (
                "must be smaller, or benches fewer or more alike: no turn was decided to be the shortest {then}; "
                "the {benches} chords are {shortest} to {longest} long"
            )
            values, radius = chord_values(self.dragon), Quantity(self.radius, "m")
            raise too_much(self.budget, "turning_radius", rule, radius, **values) from halted

    @property
    def tightest(self) -> float:
        """Least radius of an arc in the boxes [m]."""
        return self.least

    def searched(self) -> ShortestTurn:
        """The answer. raises: InvalidValue, Halted"""
        for start in starts(self.growth, self.inner, self.radius, self.ratio, self.least):
            self.budget.look()
            entry, turned, logarithm = start
            turn = apart_from_circle(self.pitch, entry, entry + self.growth * turned, math.exp(logarithm))
            if self.overlap.deepest(turn) <= 0.0 and (self._is_near(start, COARSE) or self.best is None):
                self._improve(start)
        if self.best is None:
            self.best = self._from_circle()
            self.shortest = self.best.length
        boxes = first_boxes(self.growth, self.inner, self.radius, self.ratio)
        if self.mirrored:
            boxes = one_of_mirrored(boxes, self.ratio)
        while boxes.lows.size and self.budget.left > 0.0:
            self.budget.look()
            now, later = boxes.taken(slice(self.at_once)), boxes.taken(slice(self.at_once, None))
            parts = [self._part(now.taken(slice(k, k + TOGETHER))) for k in range(0, now.lows.size, TOGETHER)]
            boxes = joined([*parts, later])
            boxes = boxes.taken(np.argsort(boxes.lows, kind="stable"))
        return self._result(boxes)

    def _from_circle(self) -> Turn:
        """The turn that begins and ends on the circle, danced with proof.

        raises: InvalidValue with the reason if it cannot be danced
        """
        danced = self.circle.turn()
        refuse_bend(self.dragon, danced)
        self.evaluations += 1
        touch = contact_in(self.budget, self.dragon, danced, self.margin, self.stray)
        if touch.outcome is Outcome.UNDECIDED and self.budget.left <= 0.0:
            raise Halted(self.budget)
        if touch.outcome is not Outcome.CLEAR:
            raise refusal(self.radius, touch, self.margin, self.stray)
        return danced

    def _improve(self, place: Floats) -> bool:
        """Dance the locally shortest turn near a place, and use its multipliers if it is nearly the best one.

        returns: False if POLISHED searches were made already
        """
        if self.polished >= POLISHED:
            return False
        self.polished += 1
        self.budget.spend(POLISH_WORK)
        near = locally_shortest(self.growth, place, self.inner, self.radius, self.ratio, self.least)
        if near is None or any(np.allclose(near, other, atol=SAME) for other in self.tried):
            return True
        self.tried.append(near)
        if self.best is None or self._is_near(near, NEARLY):
            self._dance(near)
            known = multipliers_at(self.growth, near, self.least, self.radius, self.ratio is None)
            self.multipliers = [known, *self.multipliers][:MULTIPLIERS]
        return True

    def _is_near(self, place: Floats, most: float) -> bool:
        """Whether the turn at a place is shorter than the best one, or longer by at most this [m]."""
        return bool(sizes_of(self.growth, *place[:, None])[4, 0] < self.shortest + most < math.inf)

    def _part(self, boxes: Boxes) -> Boxes:
        """Exclude boxes and divide the others."""
        self.budget.spend(BOX_WORK * boxes.lows.size)
        count = boxes.lows.size
        boxes = boxes.taken(np.flatnonzero(~too_tight(self.growth, boxes.centres, boxes.halves, self.least)))
        turns = turns_in(self.growth, boxes.centres, boxes.halves)
        bounds = [known.lower(turns, boxes.centres, boxes.halves) for known in self.multipliers]
        lows = np.maximum.reduce([boxes.lows, lower_lengths(turns, self.least), *bounds])
        boxes = boxes._replace(lows=lows, waits=boxes.waits.copy())
        target = self.shortest - self.width
        out = (turns.exit.low > self.radius) | (turns.exit.high < self.inner)
        out |= (turns.radii[0].high < self.least) | (turns.radii[1].high < self.least)
        longer = ~out & (lows >= target)
        self.longer.append(boxes.taken(np.flatnonzero(longer)))
        left = np.flatnonzero(~(out | longer))
        left = left[np.argsort(lows[left], kind="stable")]
        left = np.setdiff1d(left, self._overlapping(turns, boxes, left))
        self.boxes += count - left.size
        slope = np.array([slope.furthest for slope in turns.slopes[2]])
        return divided(boxes.taken(left), slope[:, left])

    def _overlapping(self, turns: Turns, boxes: Boxes, left: NDArray[np.intp]) -> NDArray[np.intp]:
        """The boxes of `left` in all of whose turns benches overlap; turns that seem clear are danced.

        It sets the waits of the others.
        """
        chord, waits = float(self.overlap.chords.max()), boxes.waits
        small = np.asarray((boxes.halves <= (np.array(OVERLAP_HALF) * [chord, 1.0, 1.0])[:, None]).all(axis=0))
        shared: list[int] = []
        dances = 0
        for k in left.tolist():
            if waits[k] or not small[k] or self.budget.left <= 0.0:
                waits[k] = max(0, waits[k] - 1)
                continue
            box = box_of(self.pitch, turns, k, boxes.centres[:, k], boxes.halves[:, k], self.tightest)
            if box is None:
                waits[k] = 1
                continue
            self.budget.look()
            exhibit = self.overlap.exhibited(box)
            self.budget.spend(PREPARED_WORK + POSE_WORK * self.overlap.count * exhibit.poses)
            if exhibit.shared:
                shared.append(k)
                continue
            waits[k] = 1
            if exhibit.depth <= 0.0:
                waits[k] = PATIENCE
                if dances < DANCES:
                    self._dance(box.nominal_point)
                    dances += self._improve(box.nominal_point)
            elif math.isfinite(exhibit.excess):  # until boxes are smaller by what benches move too far
                waits[k] = min(PATIENCE, math.floor(DIRECTIONS * math.log2(exhibit.excess)))
        self.overlaps += len(shared)
        return np.array(shared, dtype=np.intp)

    def _dance(self, point: Floats | None) -> bool:
        """Whether the turn at a point is shorter than the best one and allowed; it is the best one then."""
        if point is None:
            return False
        entry, leaving = float(point[0]), min(float(point[0] + self.growth * point[1]), self.radius)
        if min(entry, leaving) < self.inner:
            return False
        ratio = self.ratio or min(max(math.exp(point[2]), RATIO_MIN), RATIO_MAX)
        try:
            danced = self.circle.turn(min(entry, self.radius), leaving, ratio)
        except InvalidValue:
            return False
        if danced.length >= self.shortest or not self._allows(danced):
            return False
        self.best, self.shortest = danced, danced.length
        return True

    def _allows(self, danced: Turn) -> bool:
        """Whether a turn can be danced, with a proof."""
        if not bends_widely(self.dragon, danced):
            return False
        self.evaluations += 1
        touch = contact_in(self.budget, self.dragon, danced, self.margin, self.stray)
        return touch.outcome is Outcome.CLEAR

    def _is_coil_least(self) -> bool:
        """Whether the coil has the least radius at the deepest end that is tried."""
        return coil_bend(self.growth, self.inner) * (self.least + AT_LIMIT) >= 1.0

    def _result(self, left: Boxes) -> ShortestTurn:
        """The answer. left: the boxes that were not excluded when the work was spent, none otherwise"""
        assert self.best is not None
        best = self.best
        lowest = min(float(left.lows.min(initial=math.inf)), best.length - self.width)
        near = [boxes.taken(np.flatnonzero(boxes.lows <= best.length)) for boxes in (*self.longer, left)]
        middles, sizes = (np.hstack([getattr(boxes, name) for boxes in near]) for name in ("centres", "halves"))
        leaving, spread = middles[0] + self.growth * middles[1], sizes[0] + self.growth * sizes[1]
        spans = [(middles[0], sizes[0]), (leaving, spread)]
        if self.mirrored:
            both = np.hstack([middles[0], leaving]), np.hstack([sizes[0], spread])
            spans = [both, both]
        brackets = []
        for (at, half), own in zip(spans, (best.entry_radius, best.exit_radius), strict=True):
            low, high = (at - half).min(initial=own), (at + half).max(initial=own)
            brackets.append((max(float(low), self.inner), min(float(high), self.radius)))
        return ShortestTurn(
            best, (lowest, best.length), brackets[0], brackets[1], self._limit(best), self.boxes, self.overlaps,
            self.evaluations,
        )  # fmt: skip

    def _limit(self, best: Turn) -> TurnLimit:
        """What keeps the best turn from being shorter."""
        ends = best.entry_radius, best.exit_radius
        is_deepest = min(ends) < self.inner + SAME
        if min(best.radii) < self.least + AT_LIMIT or (is_deepest and self._is_coil_least()):
            return TurnLimit.LEAST_RADIUS
        if is_deepest:
            return TurnLimit.CENTRE
        return TurnLimit.CIRCLE if max(ends) > self.radius - AT_LIMIT else TurnLimit.CONTACT

"""The shortest turn of all that benches are proven to follow, however tight its arcs are.

It is the search of core/design/shortest_turn.py, with the exact condition (core/paths/following.py) in place of a least
radius. Above: a turn that every bench is proven to follow, danced without a contact with proof; turns of a grid that no
proof refuses are tried first. Below: a box of turns is excluded
    - by its length, or an end outside the circle;
    - if an arc of half a circle is too tight in all its turns, or in each a bench cannot follow or the path meets
      itself (core/design/turn_refusal.py);
    - if one pose is exhibited that overlaps in all its turns (core/design/turn_overlap.py).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from core.checks import SIZE_MIN
from core.contact.answer import Outcome
from core.design.deepest_turn import TurnLimit, contact_in
from core.design.shortest_turn import BOX_WORK, DANCES, ShortestTurn, TurnSearch
from core.design.turn_bounds import Boxes, halved, lower_lengths
from core.design.turn_boxes import Turns, can_be_drawn, sizes_of, turns_in, turns_of
from core.design.turn_circle import CheckedCircle, checked_circle
from core.design.turn_refusal import TurnRefusal
from core.dragon import Dragon, Stray, checked_stray
from core.kernels import Budget
from core.kernels.constants import PROOF_COLUMNS, PROOF_KIND
from core.paths.following import follows
from core.paths.turn import Turn
from core.questions import question_about
from core.values import Floats

# Width of the bracket of the length [m].
FOLLOWED_WIDTH = 1e-3
# Largest work [1]: a minute. The contest's turn takes 4e8.
FOLLOWED_WORK = 6e8
# Most boxes of a round, of which those of the shortest turns are looked at first.
ROUND = 4096
# Work of a place of the proofs, by the time that it takes [1].
PLACE_WORK = 0.5
# Moves of which nothing is known count as this [m/m].
MOVES_MOST = 1e3
# Steps of the grid of turns that are danced first [m], [rad], and most of them.
SAMPLED, SAMPLES = (0.05, 0.05), 60
# Half width of boxes whose middle is danced [m], [rad]; steps by which a turn is made shorter: first, last, and the
# tries without one after which they become smaller.
DANCED = 2e-3
STEP, STEP_LEAST, TRIES = 0.02, 1e-8, 24


@question_about("dragon", Dragon)
def followed_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    budget: Budget | None = None,
) -> ShortestTurn:
    """The shortest turn of two arcs inside the circle that every bench can follow without a contact, with its bracket.

    As core/design/shortest_turn.py: shortest_turn(), of one ratio, whose arcs may be tighter than half a chord, as long
    as each bench is proven to follow forwards (core/paths/following.py). limited_by is FOLLOWING.
    The bracket is proven, and FOLLOWED_WIDTH = 1 mm wide; wider if the budget is spent before, and with little of it
    the turn may be longer than the shortest: the default is FOLLOWED_WORK = 6e8, about a minute
    raises: as shortest_turn()

    >>> from core import Budget
    >>> answer = followed_turn(Dragon(), 1.7, budget=Budget(1e7))
    >>> round(answer.turn.length, 4), answer.limited_by.value
    (11.7992, 'following')
    """
    circle = checked_circle(pitch, turning_radius, ratio, start_turns, margin)
    work = (budget or Budget()).within(FOLLOWED_WORK)
    return FollowedSearch(dragon, circle, checked_stray(stray, dragon), work).answer()


class FollowedSearch(TurnSearch):
    """Branch and bound over boxes of turns that may be tighter than half a chord."""

    width = FOLLOWED_WIDTH
    at_once = ROUND

    def __init__(self, dragon: Dragon, circle: CheckedCircle, stray: float, budget: Budget) -> None:
        super().__init__(dragon, circle, stray, budget)
        self.refusal = TurnRefusal(dragon, self.growth)
        self.mirrored = False
        self.random = np.random.default_rng(0)
        self.entry_least, self.exit_least = self.refusal.least_ends(self.radius)
        self.inner = min(self.entry_least, self.exit_least)

    @property
    def tightest(self) -> float:
        return SIZE_MIN

    def _improve(self, place: Floats) -> bool:
        """Only before boxes are looked at: locally shortest turns are those by closed forms of a least radius."""
        return super()._improve(place) if not self.boxes else True

    def _part(self, boxes: Boxes) -> Boxes:
        if not self.boxes:
            self._sample()
        self.budget.spend(BOX_WORK * boxes.lows.size)
        count = boxes.lows.size
        turns = turns_in(self.growth, boxes.centres, boxes.halves)
        lows = np.maximum(boxes.lows, lower_lengths(turns))
        boxes = boxes._replace(lows=lows, waits=boxes.waits.copy())
        out = (turns.exit.low > self.radius) | (turns.exit.high < self.exit_least)
        out |= boxes.centres[0] + boxes.halves[0] < self.entry_least
        longer = ~out & (lows >= self.shortest - self.width)
        self.longer.append(boxes.taken(np.flatnonzero(longer)))
        out |= longer | self.refusal.hairpins(boxes.centres, boxes.halves)
        left = np.flatnonzero(~out)
        boxes, turns = boxes.taken(left), turns_of(turns, left)
        refused = self._refused(turns, boxes.centres, boxes.halves, boxes.proofs)
        self._dance_some(turns, boxes, ~refused)
        hopeless = np.flatnonzero(~refused & (boxes.proofs[:, PROOF_KIND] == 0.0))
        refused[self._overlapping(turns, boxes, hopeless)] = True
        left = np.flatnonzero(~refused)
        self.boxes += count - left.size
        return halved(boxes.taken(left), self._moves(turns)[:, left])

    def _sample(self) -> None:
        """Dance the shortest turns of a grid that no proof refuses, and make them shorter."""
        assert self.best is not None
        logarithm = math.log(self.best.ratio)
        turned = (self.best.exit_radius - self.best.entry_radius) / self.growth
        self._shorten(np.array([self.best.entry_radius, turned, logarithm]))
        entries = np.arange(self.entry_least, self.radius, SAMPLED[0])
        sweep = (self.radius - self.inner) / self.growth
        grid = np.meshgrid(entries, np.arange(-sweep, sweep, SAMPLED[1]), [logarithm], indexing="ij")
        points = np.array(grid).reshape(3, -1)
        sizes = sizes_of(self.growth, *points)
        exits = (self.exit_least <= sizes[5]) & (sizes[5] <= self.radius)
        points = points[:, exits & can_be_drawn(sizes) & (sizes[4] < self.shortest - self.width)]
        self.budget.spend(BOX_WORK * points.shape[1])
        alone, proofs = np.zeros_like(points), np.zeros((points.shape[1], PROOF_COLUMNS))
        refused = self.refusal.hairpins(points, alone)
        refused |= self._refused(turns_in(self.growth, points, alone), points, alone, proofs)
        points = points[:, ~refused]
        for k in sizes_of(self.growth, *points)[4].argsort()[:SAMPLES].tolist():
            if self._dance(points[:, k]):
                self._shorten(points[:, k])

    def _moves(self, turns: Turns) -> Floats:
        """About how far points of the turns move by each parameter, (3, N) [m/m], [m/rad], [m/1]."""
        chord = float(self.refusal.chords[0])
        moves = np.array([slope.furthest for slope in turns.slopes[2]])
        for k in range(2):
            bent, turned = (np.array([slope.furthest for slope in turns.slopes[at]]) for at in (k, 3 + k))
            moves += 2.0 * bent + (turns.middle[k] + chord) * turned
        return np.asarray(np.nan_to_num(moves, nan=MOVES_MOST, posinf=MOVES_MOST))

    def _refused(self, turns: Turns, centres: Floats, halves: Floats, proofs: Floats) -> NDArray[np.bool_]:
        """The boxes none of whose turns can be danced. It sets their proofs."""
        before = self.refusal.box.work
        refused = self.refusal.refused(turns, centres, halves, proofs, self.shortest)
        self.budget.spend(PLACE_WORK * (self.refusal.box.work - before))
        return refused

    def _dance_some(self, turns: Turns, boxes: Boxes, left: NDArray[np.bool_]) -> None:
        """Dance turns of small boxes, and make them shorter."""
        shorter = turns.middle[4] < self.shortest - self.width
        small = left & shorter & (boxes.halves.max(axis=0) <= DANCED)
        for k in np.flatnonzero(small)[:DANCES].tolist():
            if self._dance(boxes.centres[:, k]):
                self._shorten(boxes.centres[:, k])

    def _shorten(self, point: Floats) -> None:
        """Make a danced turn shorter by random steps, as long as they can be danced."""
        step, failed = STEP, 0
        while step > STEP_LEAST and self.budget.left > 0.0:
            self.budget.look()
            near = point + step * np.append(self.random.standard_normal(2), 0.0)
            near[0] = min(near[0], self.radius)
            near[1] = min(near[1], (self.radius - near[0]) / self.growth)
            if self._dance(near):
                point, step, failed = near, 1.5 * step, 0
            elif (failed := failed + 1) == TRIES:
                step, failed = 0.5 * step, 0

    def _allows(self, danced: Turn) -> bool:
        self.evaluations += 1
        if not follows(self.dragon, danced):
            return False
        return contact_in(self.budget, self.dragon, danced, self.margin, self.stray).outcome is Outcome.CLEAR

    def _limit(self, best: Turn) -> TurnLimit:
        return TurnLimit.FOLLOWING

"""The quickest turn: how long the head takes through a turn if no handle may exceed a speed.

The head goes at one speed, as fast as the limit allows: the limit over the highest rate, the speed of the fastest
handle over that of the head (core/extremes/speed.py). So a turn of length L takes the time L rate / limit. A short turn
bends tightly, and where the curvature jumps from one arc to the other, handles behind the head are the fastest: so the
shortest turn is not the quickest.

Scanned, not proven: the time is computed on a grid of entries and exits by samples of the rate, and then lowered from
the best places of the grid by steps that halve. Turns with an overlap in a sampled pose are left out of both. For the
answer the rate is proven, and that nothing touches.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np

from core.contact.answer import Outcome
from core.dance import Dance
from core.design.deepest_turn import contact_in, refuse_bend
from core.design.turn_boxes import sizes_of
from core.design.turn_circle import CheckedCircle, checked_circle
from core.design.turn_moves import least_bend
from core.design.turn_overlap import OverlapSearch, most_benches
from core.display import Readable, display
from core.dragon import Dragon, chord_values
from core.errors import InvalidValue
from core.extremes.speed import checked_limit, maximum_head_speed
from core.kernels import Budget, Halted
from core.language import say
from core.motion.trajectory import trajectory
from core.paths.clothoid_turn import ClothoidTurn
from core.paths.following import bends_widely
from core.paths.turn import Turn
from core.quantities import Quantity, quantities
from core.questions import question_about, too_much

# Step of the grid of entry and exit radii, as a part of the circle's radius [1].
GRID = 0.02
# Step of the samples of a rate [m of head travel]; handles after the first ones do not go faster on a turn.
SAMPLE, LEADING = 0.1, 16
# Most places of the grid from which the time is lowered, and the width to which [m].
PLACES, WIDTH = 8, 1e-4
# Steps to the eight neighbours of a place.
BESIDE_IT = tuple((x, y) for x, y in product((-1, 0, 1), repeat=2) if x or y)
# Travel of the head before and after the turn in which the highest rate is looked for [m].
BESIDE = 100.0


@dataclass(frozen=True, slots=True, repr=False)
class TurnTime(Readable):
    """How long a turn takes.

    turn: the turn
    length: its length [m]
    head_speed: largest constant speed of the head at which no handle exceeds the limit [m/s]
    time: time of the head from the entry to the exit at that speed: the length over the speed [s]
    handles: handles that reach the limit, all at once

    >>> turn_time(Dragon(), Turn(1.7)).handles
    (3, 4, 5, 6, 7)
    """

    turn: Turn | ClothoidTurn
    length: float
    head_speed: float
    time: float
    handles: tuple[int, ...]

    def _line(self) -> str:
        return say(
            "{time} for {length}, head at most at {speed}, entry {entry}, exit {exit}",
            time=display(self.time, "s"), length=display(self.length, "m"), speed=display(self.head_speed, "m/s"),
            entry=display(self.turn.entry_radius, "m"), exit=display(self.turn.exit_radius, "m"),
        )  # fmt: skip


@question_about("dragon", Dragon)
def turn_time(
    dragon: Dragon, path: Turn | ClothoidTurn, speed_limit: float = 2.0, *, budget: Budget | None = None
) -> TurnTime:
    """How long the head takes through a turn if no handle may exceed a speed.

    path: the turn; speed_limit: [m/s]
    raises: InvalidValue for a bend that a bench cannot follow; TooMuchWork

    >>> answer = turn_time(Dragon(), Turn(1.7))
    >>> round(answer.length, 4), round(answer.head_speed, 4), round(answer.time, 3)
    (13.6212, 1.2463, 10.93)
    """
    limit = checked_limit(speed_limit)
    dance = Dance(dragon, path)
    start, stop = max(-BESIDE, dance.begin), min(path.length + BESIDE, path.end)
    fastest = maximum_head_speed(dance, limit, start=start, stop=stop, budget=budget)
    return TurnTime(path, path.length, fastest.head_speed, path.length / fastest.head_speed, fastest.handles)


@question_about("dragon", Dragon)
def quickest_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    speed_limit: float = 2.0,
    start_turns: float = 16.0,
    margin: float = 0.0,
    budget: Budget | None = None,
) -> TurnTime:
    """The quickest turn of two arcs inside the circle that was found on a grid of entries and exits, then refined.

    pitch, turning_radius, margin [m]; speed_limit: of every handle [m/s]; ratio: radius of the first arc over that of
    the second; start_turns: of the coils
    It is proven that nothing touches in it, and that no handle exceeds the limit; not that no turn is quicker.
    raises: TooMuchWork; InvalidValue (turning_radius) if none of the tried turns can be danced

    >>> round(quickest_turn(Dragon(5), 1.7).time, 1)
    10.8
    """
    circle, limit = checked_circle(pitch, turning_radius, ratio, start_turns, margin), checked_limit(speed_limit)
    search = _Times(dragon, circle, budget or Budget())
    try:
        turn = search.quickest()
    except Halted as halted:
        rule = (
            "must be smaller, or benches fewer: no turn was timed {then}; the {benches} chords are {shortest} to "
            "{longest} long"
        )
        values = chord_values(dragon)
        raise too_much(search.budget, "turning_radius", rule, Quantity(circle.radius, "m"), **values) from halted
    if turn is None:
        refuse_bend(dragon, circle.turn())
        why = "in every turn that was tried inside it benches come within {margin}"
        values = quantities("m", got=circle.radius, margin=circle.margin)
        raise InvalidValue("turning_radius", f"must be larger, or the pitch: {why}", **values)
    return turn_time(dragon, turn, limit, budget=budget)


class _Times:
    """Search for the quickest turn: times are computed for a speed limit of 1 m/s."""

    def __init__(self, dragon: Dragon, circle: CheckedCircle, budget: Budget) -> None:
        self.dragon, self.circle, self.budget = dragon, circle, budget
        self.radius = circle.radius
        self.front = dragon.leading(min(dragon.benches, LEADING))
        self.overlap = OverlapSearch(dragon, circle.margin, most_benches(dragon, self.radius))
        self.known: dict[tuple[float, float], float] = {}

    def quickest(self) -> Turn | None:
        """The quickest turn that can be danced; None if none of the tried ones can."""
        best: tuple[float, Turn] | None = None
        for time, place in self._dips()[:PLACES]:
            if best is not None and time >= best[0] * (1.0 + GRID):
                break
            lowered, at = self._lowered(time, place)
            turn = self._turn(at)
            if turn is None or (best is not None and lowered >= best[0]):
                continue
            outcome = contact_in(self.budget, self.dragon, turn, self.circle.margin, 0.0).outcome
            if outcome is Outcome.CLEAR:
                best = lowered, turn
            elif outcome is Outcome.UNDECIDED and best is None and self.budget.left <= 0.0:
                raise Halted(self.budget)  # that nothing was decided says nothing about the circle
        return None if best is None else best[1]

    def _dips(self) -> list[tuple[float, tuple[float, float]]]:
        """Times and places of the grid that are not slower than their neighbours on it, the quickest first."""
        growth, radii = self.circle.growth, self.radius * np.arange(1.0, 0.2, -GRID)
        entry, leaving = np.meshgrid(radii, radii, indexing="ij")
        sizes = sizes_of(
            growth,
            entry.ravel(),
            (leaving - entry).ravel() / growth,
            np.full(entry.size, math.log(self.circle.ratio or 1.0)),
        )
        fits = (sizes[:2].min(axis=0) >= least_bend(self.dragon)).reshape(entry.shape)
        times = np.full(np.add(entry.shape, 2), np.inf)
        for i, j in np.argwhere(fits).tolist():
            times[i + 1, j + 1] = self.time((float(radii[i]), float(radii[j])))
        inside = times[1:-1, 1:-1]
        around = [times[1 + i : 1 + i + len(radii), 1 + j : 1 + j + len(radii)] for i, j in BESIDE_IT]
        dips = np.argwhere(np.isfinite(inside) & (inside <= np.minimum.reduce(around))).tolist()
        return sorted((float(inside[i, j]), (float(radii[i]), float(radii[j]))) for i, j in dips)

    def time(self, place: tuple[float, float]) -> float:
        """Length of the turn at a place times the highest sampled rate [m].

        It is infinite if a bench cannot follow the turn, or benches of a sampled pose overlap.
        """
        if place not in self.known:
            self.budget.look()
            turn = self._turn(place)
            danced = turn is not None and self.overlap.deepest(turn) <= 0.0
            self.known[place] = turn.length * self._rate(turn) if turn is not None and danced else math.inf
        return self.known[place]

    def _rate(self, turn: Turn) -> float:
        times = np.arange(0.0, turn.length + float(self.front.chords.sum()), SAMPLE)
        return float(trajectory(Dance(self.front, turn), times, budget=self.budget).speed.max())

    def _turn(self, place: tuple[float, float]) -> Turn | None:
        """The turn at a place; None if it is refused or a bench cannot follow it."""
        entry, leaving = (min(radius, self.radius) for radius in place)
        try:
            turn = self.circle.turn(entry, leaving)
        except InvalidValue:
            return None
        return turn if bends_widely(self.dragon, turn) else None

    def _lowered(self, time: float, place: tuple[float, float]) -> tuple[float, tuple[float, float]]:
        """The time lowered by steps along both radii and both diagonals, which halve down to WIDTH."""
        step = 0.5 * GRID * self.radius
        while step > WIDTH:
            around = [(place[0] + step * x, place[1] + step * y) for x, y in BESIDE_IT]
            around = [(min(x, self.radius), min(y, self.radius)) for x, y in around if min(x, y) > 0.0]
            lower, at = min((self.time(one), one) for one in around)
            if lower < time:
                time, place = lower, at
            else:
                step *= 0.5
        return time, place

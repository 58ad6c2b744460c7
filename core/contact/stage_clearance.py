"""Clearance between different dragons: at given times with its local minima, and the least over an interval."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.contact.answer import Outcome
from core.contact.encounter import first_encounter, marched
from core.contact.encounter_answer import FirstEncounter, NearPass
from core.contact.gaps import grazes, least_over, sampled
from core.contact.search import WORK_BUDGET
from core.contact.stage import Stage
from core.contact.stage_march import least_after
from core.dance import checked_instants
from core.display import Readable, display
from core.dragon import Stray
from core.errors import InvalidValue, OutsideRun
from core.kernels import Budget, Ended
from core.kernels.results import Dip, Marched
from core.language import counted, say
from core.motion.trajectory import instants
from core.performance import Performance
from core.quantities import Quantity, bound
from core.questions import question_about
from core.tables import Column, Table
from core.values import Floats, Pair


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class PerformanceClearance(Table):
    """Columns, (T,) for a list of instants and empty for one, and the local minima between them.

    time: instants [s]
    clearance: smallest separation of two benches of different dragons [m]
    dragons: the two dragons with that separation, in the order of the dances, from 0
    benches: their benches, one of each
    grazes: local minima between the first and the last instant, refined

    >>> from core import Dance, Dragon, Line, Part, Route, clearance_profile
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> clearance_profile(crossing, [20.0, 30.0]).clearance.round(3).tolist()
    [27.683, 13.541]
    """

    time: Floats
    clearance: Floats
    dragons: NDArray[np.int64]
    benches: NDArray[np.int64]
    grazes: tuple[NearPass, ...]

    def _line(self) -> str:
        if not self.time.size:
            return say("no instants")
        least = int(self.clearance.argmin())
        (i, j), (a, b) = self.dragons.reshape(-1, 2)[least], self.benches.reshape(-1, 2)[least]
        return say(
            "{instants}; least {gap} between bench {a} of dragon {i} and bench {b} of dragon {j} at {time}; {grazes}",
            instants=instants(self.time), gap=display(self.clearance.item(least), "m"), a=a, b=b, i=i, j=j,
            time=display(self.time.item(least), "s"),
            grazes=counted(len(self.grazes), "{count} graze", "{count} grazes"),
        )  # fmt: skip

    def columns(self) -> dict[str, Column]:
        """One row for each time: time [s], clearance [m], dragon_a, bench_a, dragon_b, bench_b."""
        (i, j), (a, b) = self.dragons.reshape(-1, 2).T, self.benches.reshape(-1, 2).T
        pair = {"dragon_a": i, "bench_a": a, "dragon_b": j, "bench_b": b}
        return {"time": self.time.ravel(), "clearance": self.clearance.ravel(), **pair}


@dataclass(frozen=True, slots=True, repr=False)
class PerformanceLeastClearance(Readable):
    """The least clearance between two dragons over the performance.

    dragons: the dragons, in the order of the dances
    benches: a bench of each
    distance: smallest distance found; 0 at the first touch, or at a later one if it is undecided which is the first; if
        two dragons overlap at the start, minus the depth [m]
    at_least: proven lower bound; None: the search gave up before proving one, or the distance is below zero [m]
    time: time of the smallest distance [s]

    After a first touch nothing is said. The lower bound is PROOF_WIDTHS[0] below the distance or, if that needs too
    many steps, PROOF_WIDTHS[1], or more where a bench folds; there is none if the first touch is not decided.

    >>> from core import Dance, Dragon, Line, Part, Route, least_clearance
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((0.0, 1.0), (40.0, 1.0))]
    >>> least = least_clearance(Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes]))
    >>> round(least.distance, 3), least.dragons
    (0.7, (0, 1))
    """

    distance: float
    at_least: float | None
    time: float
    dragons: Pair
    benches: Pair


@question_about("performance", Performance, "the clearance over time was not found")
def clearance_between(
    performance: Performance, times: ArrayLike, *, budget: Budget | None = None
) -> PerformanceClearance:
    """Exact clearance between dragons and its pair at every time, and its local minima refined.

    times: (T,) or one [s]; before and after its dance a dragon stands
    grazes: searched between the first and the last time in steps of PROFILE_STEP of the shortest chord at the highest
        speed of a head (longer ones for thousands of benches over a long time), then refined to rounding. The dip of a
        pair that is nearest for less than a step may be missed here, but never by first_encounter()
    raises: OutsideRun after a fold; InvalidValue for one dragon; TooMuchWork
    """
    if len(performance.parts) < 2:
        raise InvalidValue("parts", "must be at least two, between which there is a clearance", got=1)
    time = checked_instants(times)
    end = performance.end
    late = np.flatnonzero(time > end.time) if end.dragon is not None else np.empty(0, dtype=np.int64)
    if late.size:
        name = f"times.{late[0]}" if time.ndim else "times"
        got, last = Quantity(float(time.flat[late[0]]), "s"), bound(end.time, 9, "s")
        raise OutsideRun(name, "must be at most {end}, when {why}", got=got, end=last, why=performance.ending)
    looks, found = list[Dip](), tuple[NearPass, ...]()
    if time.size:
        stage = Stage(performance, (float(time.min()), float(time.max())), 0.0, work=WORK_BUDGET, budget=budget)
        looks = [stage.look(instant) for instant in time.ravel().tolist()]
        lowest = grazes(stage, sampled(stage)) if time.size > 1 else ()
        found = tuple(NearPass(dip.moment, dip.gap, *stage.pair(*dip.pair)) for dip in lowest)
    clearance = np.array([look.gap for look in looks]).reshape(time.shape)
    pairs = np.array([stage.pair(*look.pair) for look in looks], dtype=np.int64).reshape(*time.shape, 2, 2)
    return PerformanceClearance(time, clearance, pairs[..., 0, :], pairs[..., 1, :], found)


@question_about("performance", Performance, "the least clearance was not found")
def least_clearance_between(
    performance: Performance,
    *,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> PerformanceLeastClearance | None:
    """The least clearance between different dragons from start to stop [s]; None for one dragon.

    stray: largest distance of every hole from its place [m]: the result is then the least possible clearance, proven
        for the hulls of the ground that benches may cover (core/shapes/reach.py)
    start, stop: None for the beginning and the end of the performance
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dance, Dragon, Line, Part, Performance, Route
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((40.0, 9.0), (-40.0, 9.0))]
    >>> passing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> least = least_clearance_between(passing)
    >>> round(least.distance, 6), 0.0 < least.distance - least.at_least < 2e-5
    (8.7, True)
    """
    strayed = performance.checked_stray(stray)
    if len(performance.parts) == 1:
        performance.span(start, stop)
        return None
    return least_between(performance, strayed, (start, stop), budget or Budget(), None)


def least_between(
    performance: Performance,
    stray: float,
    interval: tuple[float | None, float | None],
    budget: Budget,
    met: FirstEncounter | None,
) -> PerformanceLeastClearance:
    """least_clearance_between() of two dragons or more; met: the first encounter of that interval with a margin of
    0, if it is known."""
    begin, until = span = performance.span(*interval)
    stage = last = Stage(performance, span, 0.0, stray=stray, work=WORK_BUDGET, budget=budget)

    def march(margin: float, proven_to: float) -> tuple[Stage, Marched, float | None]:
        nonlocal last
        last = Stage(performance, (proven_to, until), margin, stray=stray, work=last.work, budget=budget)
        result = marched(last)
        budget.afford()
        left = margin if result.ended is Ended.REACHED else _left_to_fold(last, result.proven)
        return last, result, left

    def first_touch(_: float, touching: Dip) -> tuple[Dip, float | None]:
        first = met or first_encounter(performance, stray=stray, start=begin, stop=interval[1], budget=budget)
        return _touch(stage, first, touching)

    (distance, time, rows), at_least = least_over(stage, march, first_touch)
    return PerformanceLeastClearance(distance, at_least, time, *stage.pair(*rows))


def _left_to_fold(stage: Stage, proven: float) -> float:
    """What is proven of the least clearance by a march that gave up at a time [s]: the least that the bound on the
    remaining motion leaves, if that was right before a fold; else 0 [m]."""
    folding = stage.folding(stage.span[1])
    if not folding or proven < stage.span[1] - max(stage.players[k].sliver for k in folding):
        return 0.0
    return min(stage.margin, max(0.0, least_after(stage, proven, stage.span[1], folding)))


def _touch(stage: Stage, met: FirstEncounter, touching: Dip) -> tuple[Dip, float | None]:
    """The first touch; if that is not decided, a certain or else a computed one."""
    if met.dragons is None or met.benches is None or met.time is None:
        if met.overlapping is not None and met.time_bracket is not None:
            return Dip(0.0, met.time_bracket[1], stage.rows(*met.overlapping)), None
        return touching._replace(gap=0.0), None if met.outcome is Outcome.UNDECIDED else 0.0
    if met.outcome is Outcome.CONTACT_AT_START and (overlap := stage.look(met.time)).gap < 0.0:
        return overlap, None
    return Dip(0.0, met.time, stage.rows(met.dragons, met.benches)), 0.0

"""Clearance between different dragons: at given times with its local minima, and the least over an interval.

As for one dragon (core/contact/clearance.py), the least is sampled, then proven by marches whose margin is a little
less than the least gap known. Each march either reaches the end, which proves that no two dragons come nearer than its
margin, or meets a smaller gap. The way before that is clear by the larger margin, and so by the smaller one of the next
march.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.contact.answer import Outcome
from core.contact.clearance import DIPS_REFINED, PROFILE_STEP, PROOF_WIDTHS, ROUNDS
from core.contact.search import SAMPLED_SHARE, SAMPLES, WORK_BUDGET
from core.dance import checked_instants
from core.display import Readable, display, format_count
from core.dragon import Stray
from core.errors import InvalidValue, OutsideRun, Quantity, bound, question_about
from core.kernels import Budget, Ended
from core.motion.trajectory import instants
from core.performance.answer import FirstEncounter, NearPass
from core.performance.encounter import first_encounter, marched
from core.performance.march import DIP_WIDTH, EncounterDip, crossing, least_after, sliver
from core.performance.performance import Performance
from core.performance.stage import BEFORE, Stage
from core.sampling import dips
from core.tables import Column, Table
from core.values import Floats


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class PerformanceClearance(Table):
    """Columns, (T,) for a list of instants and empty for one, and the local minima between them.

    time: instants [s]
    clearance: smallest separation of two benches of different dragons [m]
    dragons: the two dragons with that separation, in the order of the dances, from 0
    benches: their benches, one of each
    grazes: local minima between the first and the last instant, refined
    """

    time: Floats
    clearance: Floats
    dragons: NDArray[np.int64]
    benches: NDArray[np.int64]
    grazes: tuple[NearPass, ...]

    def _line(self) -> str:
        if not self.time.size:
            return "no instants"
        least = int(self.clearance.argmin())
        (i, j), (a, b) = self.dragons.reshape(-1, 2)[least], self.benches.reshape(-1, 2)[least]
        nearest = (
            f"{display(self.clearance.item(least), 'm')} between bench {a} of dragon {i} and bench {b} of dragon {j}"
        )
        grazes = format_count(len(self.grazes), "graze")
        return f"{instants(self.time)}; least {nearest} at {display(self.time.item(least), 's')}; {grazes}"

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
    """

    distance: float
    at_least: float | None
    time: float
    dragons: tuple[int, int]
    benches: tuple[int, int]


@question_about("performance", Performance, "the clearance over time was not found")
def performance_clearance(
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
    clearance, pairs = np.empty(time.size), np.empty((time.size, 4), dtype=np.int64)
    grazes: tuple[NearPass, ...] = ()
    if time.size:
        stage = Stage(performance, (float(time.min()), float(time.max())), 0.0, work=WORK_BUDGET, budget=budget)
        for k, instant in enumerate(time.flat):
            gap, _, rows = _looked(stage, float(instant))
            clearance[k], pairs[k] = gap, np.ravel(stage.pair(*rows))
        grazes = _grazes(stage) if time.size > 1 else ()
    dragons, benches = (pairs[:, columns].reshape(*time.shape, 2) for columns in (slice(0, 2), slice(2, 4)))
    return PerformanceClearance(time, clearance.reshape(time.shape), dragons, benches, grazes)


def _looked(stage: Stage, time: float, known: tuple[int, int] = (0, 0)) -> EncounterDip:
    """clearance_at(), whose work counts in the budget of the whole question."""
    stage.budget.afford(len(stage.owner))
    return clearance_at(stage, time, known)


def clearance_at(stage: Stage, time: float, known: tuple[int, int] = (0, 0)) -> EncounterDip:
    """The least gap at a time [s], and its rows; known: rows to begin with, which stay if no others are nearer.

    Where a bench folds at that time, its dragon stands as it does just before (march.sliver()).
    """
    for k in range(len(stage.players)):
        if not stage.stand(k, BEFORE, time, 0.0):
            stage.stand(k, BEFORE, time - sliver(stage, k), 0.0)
    gap, a, b = stage.nearest(*known)
    return EncounterDip(gap, time, (a, b))


def _samples(stage: Stage) -> int:
    """Number of samples over the span in steps of PROFILE_STEP, or fewer if the remaining work requires it."""
    begin, until = stage.span
    shortest = min(float(player.part.dance.dragon.chords.min()) for player in stage.players)
    step = PROFILE_STEP * shortest / max(max(player.clock.speeds) for player in stage.players)
    affordable = min(float(SAMPLES), SAMPLED_SHARE * min(stage.work, stage.budget.left) / len(stage.owner))
    return max(3, int(min(3.0 + (until - begin) / step, affordable)))


def looks(stage: Stage) -> list[EncounterDip]:
    """The least gaps at times over the span, in even steps."""
    return [_looked(stage, time) for time in np.linspace(*stage.span, _samples(stage)).tolist()]


# As for one dragon, each local minimum is one of a single pair, which is nearest at one end of a step.
def _grazes(stage: Stage) -> tuple[NearPass, ...]:
    grazes = []
    for before, after in pairwise(looks(stage)):
        for rows in sorted({before.rows, after.rows}):
            if not stage.gap_rate(before.time, *rows) < 0.0 < stage.gap_rate(after.time, *rows):
                continue
            lowest = _looked(stage, _bottom(stage, before.time, after.time, rows), rows)
            if lowest.rows == rows:
                grazes.append(NearPass(lowest.time, lowest.gap, *stage.pair(*rows)))
    return tuple(grazes)


def _bottom(stage: Stage, low: float, high: float, rows: tuple[int, int]) -> float:
    """Time between two at which a pair stops approaching [s]."""
    return crossing(lambda time: -stage.gap_rate(time, *rows), low, high, DIP_WIDTH)


@question_about("performance", Performance, "the least clearance was not found")
def performance_least_clearance(
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
    >>> least = performance_least_clearance(passing)
    >>> round(least.distance, 6), 0.0 < least.distance - least.at_least < 2e-5
    (8.7, True)
    """
    strayed = performance.checked_stray(stray)
    if len(performance.parts) == 1:
        performance.span(start, stop)
        return None
    return least_over(performance, strayed, (start, stop), budget or Budget(), None)


def least_over(
    performance: Performance,
    stray: float,
    interval: tuple[float | None, float | None],
    budget: Budget,
    met: FirstEncounter | None,
) -> PerformanceLeastClearance:
    """performance_least_clearance() of two dragons or more; met: the first encounter of that interval with a margin of
    0, if it is known."""
    begin, until = span = performance.span(*interval)
    stage = Stage(performance, span, 0.0, stray=stray, work=WORK_BUDGET, budget=budget)
    best = sampled_least(stage, looks(stage))
    proven_to, proven, work = begin, None, stage.work
    for width in PROOF_WIDTHS:
        for _ in range(ROUNDS):
            if best.gap <= 0.0:
                met = met or first_encounter(performance, stray=stray, start=begin, stop=interval[1], budget=budget)
                return _touch(stage, met, best)
            stage = Stage(
                performance, (proven_to, until), max(best.gap - width, 0.0), stray=stray, work=work, budget=budget
            )
            march = marched(stage)
            budget.afford()
            work = stage.work
            if march.graze is not None:
                best = min(best, march.graze)
            if march.ended is Ended.REACHED:
                return _least(stage, best, stage.margin)
            if march.ended is Ended.STUCK:
                proven = max(proven or 0.0, _left_to_fold(stage, march.proven)) or None
                break
            proven_to = max(proven_to, march.proven)
            assert march.touching is not None
            best = min(best, refined(stage, march.touching))
    return _least(stage, best, proven)


def _left_to_fold(stage: Stage, proven: float) -> float:
    """What is proven of the least clearance by a march that gave up at a time [s]: the least that the bound on the
    remaining motion leaves, if that was right before a fold; else 0 [m]."""
    folding = stage.folding(stage.span[1])
    if not folding or proven < stage.span[1] - max(sliver(stage, k) for k in folding):
        return 0.0
    return min(stage.margin, max(0.0, least_after(stage, proven, stage.span[1], folding)))


def _least(stage: Stage, dip: EncounterDip, at_least: float | None) -> PerformanceLeastClearance:
    return PerformanceLeastClearance(dip.gap, at_least, dip.time, *stage.pair(*dip.rows))


def _touch(stage: Stage, met: FirstEncounter, touching: EncounterDip) -> PerformanceLeastClearance:
    """The first touch; if that is not decided, a certain or else a computed one."""
    if met.dragons is None or met.benches is None or met.time is None:
        if met.overlapping is not None and met.time_bracket is not None:
            return PerformanceLeastClearance(0.0, None, met.time_bracket[1], *met.overlapping)
        return _least(stage, touching._replace(gap=0.0), None if met.outcome is Outcome.UNDECIDED else 0.0)
    if met.outcome is Outcome.CONTACT_AT_START:
        gap, time, rows = clearance_at(stage, met.time)
        if gap < 0.0:
            return PerformanceLeastClearance(gap, None, time, *stage.pair(*rows))
    return PerformanceLeastClearance(0.0, 0.0, met.time, met.dragons, met.benches)


def resampled(stage: Stage, known: Sequence[EncounterDip], within: float) -> list[EncounterDip]:
    """The samples, looked at again on this stage where the known gap is at most `within` [m]."""
    return [_looked(stage, one.time, one.rows) if one.gap <= within else one for one in known]


def sampled_least(stage: Stage, samples: Sequence[EncounterDip]) -> EncounterDip:
    """The least clearance at the ends and in the dips of samples in order of time."""
    lowest = dips(np.array([sample.gap for sample in samples]), DIPS_REFINED).tolist()
    return min(
        samples[0], samples[-1], *(_in_dip(stage, *(one.time for one in samples[k - 1 : k + 2])) for k in lowest)
    )


def refined(stage: Stage, time: float) -> EncounterDip:
    """The bottom of the dip around a time [s]."""
    begin, until = stage.span
    step = (until - begin) / (_samples(stage) - 1)
    return _in_dip(stage, max(begin, time - step), time, min(until, time + step))


def _in_dip(stage: Stage, low: float, middle: float, high: float) -> EncounterDip:
    """The bottom of the dip around the middle time [s]; searched again if another pair is nearer there."""
    best = clearance_at(stage, middle)
    for _ in range(2):
        best = min(best, clearance_at(stage, _bottom(stage, low, high, best.rows), best.rows))
    return best

"""Tolerance of a performance: the stray with which neither a dragon by itself, nor two dragons, nor the venue touch.

Each dragon has the tolerance of its own dance (core/tolerance). Between dragons the stray is found in the same way
(core/tolerance/safe.py): samples give an upper bound, then marches with slightly smaller strays show that the grounds
which benches of two dragons may cover do not meet, or at which stray they graze. The last march is the proof of a first
encounter that is clear with that stray.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from core.claims.claim import ClaimKind
from core.contact.between import DEPTH
from core.contact.search import WORK_BUDGET
from core.dance import EndReason
from core.display import Readable, WithArrays, display
from core.dragon import Dragon
from core.errors import question_about
from core.kernels import Budget, Ended
from core.motion.trajectory import trajectory
from core.performance.answer import EncounterEvidence
from core.performance.clearance import looks, refined, resampled, sampled_least
from core.performance.encounter import encounter_claim, first_encounter, marched
from core.performance.march import EncounterDip, Met
from core.performance.performance import Performance
from core.performance.stage import Stage
from core.shapes.reach import gains
from core.shapes.rectangles import frames, frames_separation
from core.tolerance.exhibit import TRIED_STEPS, TRIED_TO, Body, Exhibit, body, extended, nearest_rotated
from core.tolerance.safe import BELOW, GRAZE_STEPS, GRAZE_WITHIN, ROUNDS, SAMPLED_BEYOND, STRAY_MIN
from core.tolerance.tolerance import Limit, Tolerance, tolerance
from core.values import Floats


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class PerformanceExhibit(WithArrays):
    """Poses of one or two whole dragons in which two benches overlap, every chord as long as it should be to rounding.

    time: time of the poses [s]
    dragons: the dragon with both benches, or the two with one each
    handles: places of the handles of each of these dragons, x and y, head first [m]
    benches: the pair, the second None for an edge of the venue
    depth: depth of the overlap [m]
    stray: largest distance of a handle from its place [m]
    """

    time: float
    dragons: tuple[int, ...]
    handles: tuple[Floats, ...]
    benches: tuple[int, int | None]
    depth: float
    stray: float

    def _line(self) -> str:
        depth, stray = display(self.depth, "m"), display(self.stray, "m")
        return f"an overlap of {depth} of benches {display(self.benches)} with strays up to {stray}"


@dataclass(frozen=True, slots=True, repr=False)
class PerformanceTolerance(Readable):
    """Tolerance of a performance to strays of people.

    stray: proven safe: while no hole is further from its place, nothing touches, neither benches of one dragon nor of
        two nor the venue; 0: no stray is known to be safe, for instance because two dragons touch without any [m]
    stray_bracket: proven safe; shown to touch, None where no such poses were found [m]
    limited_by: effect of a larger stray. benches: two benches touch; venue: a bench and an edge of the venue; chord: no
        contact up to half of the shortest chord
    dragons: the dragon whose benches limit the stray, or the two with one each, in the order of the dances; empty if
        nothing limits it
    time: time at which these are nearest to touching; None if nothing limits the stray [s]
    benches: the pair, the second None for an edge of the venue; None if nothing limits the stray
    area: name of the square or of the obstacle; None if none limits the stray
    exhibit: poses in which they overlap, with strays up to the second end of the bracket; None where none were found
    own: the tolerance of each dragon by itself in the venue, on the clock of its own dance; one that stands has that of
        the first or the last STANDING of its dance
    certificate: proof that no two dragons touch with the stray; None for one dragon, or without a safe stray
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    performance: the performance of the question
    """

    stray: float
    stray_bracket: tuple[float, float | None]
    limited_by: Limit
    dragons: tuple[int, ...]
    time: float | None
    benches: tuple[int, int | None] | None
    area: str | None
    exhibit: PerformanceExhibit | None
    own: tuple[Tolerance, ...]
    certificate: EncounterEvidence | None
    start: float
    stop: float
    performance: Performance = field(repr=False, compare=False)

    def _line(self) -> str:
        safe = f"strays up to {display(self.stray, 'm')} are safe" if self.stray else "no stray is known to be safe"
        touching = self.stray_bracket[1]
        if touching is None or self.benches is None:
            return safe
        names = [self.performance.name_of(k) for k in self.dragons]
        other = self.area if self.benches[1] is None else f"bench {self.benches[1]} of {names[-1]}"
        touch = f"bench {self.benches[0]} of {names[0]} and {other} touch at {display(self.time, 's')}"
        return f"{safe}; with {display(touching, 'm')} {touch}"


@question_about("performance", Performance, "how far people may stray was not found")
def performance_tolerance(
    performance: Performance,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> PerformanceTolerance:
    """The largest stray found with which nothing of a performance can touch, and one with which two benches can.

    A stray is that of tolerance(), the same for all dragons. What counts: benches of two dragons, those of one dragon
    that share no hole, and the edges of the performance's venue.
    start, stop: [s], None for the beginning and the end
    returns: see PerformanceTolerance; the tolerance of a single dragon is that of tolerance() to the last bit
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dance, Dragon, Line, Part, Performance, Route
    >>> lanes = [Line((-40.0, 0.0), (40.0, 0.0)), Line((40.0, 0.5), (-40.0, 0.5))]
    >>> answer = performance_tolerance(Performance([Part(Dance(Dragon(5), Route([lane]))) for lane in lanes]))
    >>> round(answer.stray, 3), answer.dragons
    (0.075, (0, 1))
    """
    budget = budget or Budget()
    begin, until = span = performance.span(start, stop)
    own = tuple(
        tolerance(part.dance, performance.venue, start=first, stop=last, budget=budget)
        for part in performance.parts
        for first, last in [part.own_span(*span)]
    )
    k = min(range(len(own)), key=lambda k: own[k].stray)
    between = _safe_between(performance, own[k].stray, span, budget)
    rest = (own, between.evidence, begin, until, performance)
    if between.dip is not None:
        dragons, benches = between.pair
        exhibit = _exhibit(performance, between, between.dip.time, budget)
        bracket = (between.stray, None if exhibit is None else exhibit.stray)
        return PerformanceTolerance(
            between.stray, bracket, Limit.BENCHES, dragons, between.dip.time, benches, None, exhibit, *rest
        )
    alone, delay = own[k], performance.parts[k].delay
    limits = () if alone.benches is None else (k,)
    time = None if alone.time is None else alone.time + delay
    pose = None if alone.exhibit is None else _alone(alone.exhibit, k, delay)
    return PerformanceTolerance(
        alone.stray, alone.stray_bracket, alone.limited_by, limits, time, alone.benches, alone.area, pose, *rest
    )


def _alone(pose: Exhibit, k: int, delay: float) -> PerformanceExhibit:
    return PerformanceExhibit(pose.time + delay, (k,), (pose.handles,), pose.benches, pose.depth, pose.stray)


@dataclass(frozen=True, slots=True)
class _Between:
    """A stray that is safe between dragons [m], the dip that limits it and its pair (dragons, benches), evidence."""

    stray: float
    dip: EncounterDip | None = None
    pair: tuple[tuple[int, int], tuple[int, int]] = ((0, 0), (0, 0))
    evidence: EncounterEvidence | None = None


# Input:  the largest stray to be tried.
# State:  `stray` and `limiting`, the least stray known at which grounds graze, and where; `proven_to`, up to which all
#         is clear with a larger one.
# Output: a stray slightly below, proven to the end.
def _safe_between(performance: Performance, most: float, span: tuple[float, float], budget: Budget) -> _Between:
    """The largest stray up to `most` that is safe between dragons, slightly less than samples and marches show."""
    begin, until = span
    if len(performance.parts) == 1 or most < STRAY_MIN:
        return _Between(most)
    stage = Stage(performance, span, 0.0, work=WORK_BUDGET, budget=budget)
    in_place = looks(stage)
    nominal = sampled_least(stage, in_place)
    if nominal.gap <= 0.0:
        return _touching(stage, nominal, budget)
    grounds = _Grounds(performance, span, in_place, budget)
    stray, limiting = min(most, 0.5 * nominal.gap), None
    dip = grounds.sampled(stray)
    if dip.gap <= 0.0:
        stray, limiting = grounds.grazing(stray, dip)
    elif stray < most:
        limiting = nominal
    proven_to = begin
    for below in BELOW:
        for _ in range(ROUNDS):
            tried = stray if limiting is None else stray * (1.0 - below)
            if tried < STRAY_MIN:
                return _Between(0.0, limiting or nominal, stage.pair(*(limiting or nominal).rows))
            strayed = Stage(performance, (proven_to, until), 0.0, stray=tried, work=WORK_BUDGET, budget=budget)
            met = marched(strayed, dips=False)
            budget.afford()
            if met.ended is Ended.REACHED:
                pair = ((0, 0), (0, 0)) if limiting is None else stage.pair(*limiting.rows)
                return _Between(tried, limiting, pair, _evidence(strayed, met, span))
            if met.touching is None:
                break
            proven_to = max(proven_to, met.proven)
            grazing, limiting = grounds.grazing(tried, refined(strayed, met.touching))
            stray = min(grazing, tried)
    dip = limiting or nominal  # no stray was proven to be safe
    return _Between(0.0, dip, stage.pair(*dip.rows))


def _touching(stage: Stage, nominal: EncounterDip, budget: Budget) -> _Between:
    """No stray at all, at the first touch, or at a sampled one if that is not decided."""
    (begin, until), performance = stage.span, stage.performance
    stop = None if until >= performance.end.time else until
    met = first_encounter(performance, start=begin, stop=stop, budget=budget)
    if met.time is None or met.dragons is None or met.benches is None:
        return _Between(0.0, nominal, stage.pair(*nominal.rows))
    return _Between(0.0, nominal._replace(time=met.time), (met.dragons, met.benches))


def _evidence(stage: Stage, met: Met, span: tuple[float, float]) -> EncounterEvidence:
    end = stage.performance.end
    reason = end.reason if span[1] >= end.time else EndReason.STOP
    claim = encounter_claim(stage, ClaimKind.CLEAR, start=span[0], clear_until=span[1], end=reason)
    return EncounterEvidence(claim, met.steps, span[1], met.curvature, None)


class _Grounds:
    """The grounds of all dragons over a span. in_place: samples of the benches in their nominal places"""

    def __init__(
        self, performance: Performance, span: tuple[float, float], in_place: Sequence[EncounterDip], budget: Budget
    ) -> None:
        self.performance, self.span, self.in_place, self.budget = performance, span, in_place, budget
        self.gain = 2.0 * max(float(gains(part.dance.dragon).max()) for part in performance.parts)

    def stage(self, stray: float) -> Stage:
        """The benches with the ground that they may cover."""
        return Stage(self.performance, self.span, 0.0, stray=stray, work=WORK_BUDGET, budget=self.budget)

    def sampled(self, stray: float) -> EncounterDip:
        """The least clearance of the samples at which two grounds can reach each other."""
        stage = self.stage(stray)
        return sampled_least(stage, resampled(stage, self.in_place, SAMPLED_BEYOND * self.gain * stray))

    def grazing(self, stray: float, dip: EncounterDip) -> tuple[float, EncounterDip]:
        """The stray near this one at which the grounds in a dip only graze [m], and the dip then; method: as in
        core/tolerance/safe.py."""
        slope = 2.0
        for _ in range(GRAZE_STEPS):
            if abs(dip.gap) <= slope * GRAZE_WITHIN * stray:
                break
            last, stray = (stray, dip.gap), max(stray + dip.gap / slope, 0.0)
            dip = refined(self.stage(stray), dip.time)
            if stray != last[0]:
                slope = max(slope, (dip.gap - last[1]) / (last[0] - stray))
        return stray, dip


class _Placed(NamedTuple):
    """One of two benches: its dragon, the places (n + 1, 2) of the handles [m], and its number."""

    dragon: Dragon
    handles: Floats
    bench: int

    @property
    def body(self) -> Body:
        """The bench alone."""
        return body(self.dragon, self.handles, self.bench)

    def moved(self, bearing: float, rotation: float, stray: float) -> _Placed:
        """The bench turned, and as far as possible in a direction [rad]; its dragon follows."""
        strays = {self.bench: self.body.strays(bearing, rotation, stray)}
        handles = extended(self.dragon.chords, self.handles, strays)
        assert handles is not None  # only two benches of one dragon may leave no place to those between them
        return self._replace(handles=handles)


def _exhibit(performance: Performance, between: _Between, time: float, budget: Budget) -> PerformanceExhibit | None:
    """Poses of two whole dragons in which the pair overlaps, with strays little above the safe ones; None if not found.

    Method: as in core/tolerance/exhibit.py. Each dragon follows its own bench.
    """
    dragons, benches = between.pair
    parts = [performance.parts[k] for k in dragons]
    handles = [trajectory(part.dance, part.own_time(time), budget=budget).position for part in parts]
    a, b = (_Placed(part.dance.dragon, own, bench) for part, own, bench in zip(parts, handles, benches, strict=True))
    normal = _separation(a, b)[1]
    bearing, safe = math.atan2(normal[1], normal[0]), between.stray
    high = min(TRIED_TO * safe + 2.0 * DEPTH, 0.5 * min(a.body.chord, b.body.chord))
    stray = safe + max(0.0, nearest_rotated(a.body, b.body, bearing, safe)[0] + DEPTH) / 2.0
    least, most = (step * safe + DEPTH for step in TRIED_STEPS)
    while stray <= high:
        _, rotation_a, rotation_b, way = nearest_rotated(a.body, b.body, bearing, stray)
        one, two = a.moved(way, rotation_a, stray), b.moved(way + math.pi, rotation_b, stray)
        depth = -_separation(one, two)[0]
        if depth > 0.0:
            ways = [
                float(np.hypot(*(moved.handles - own).T).max()) for moved, own in zip((one, two), handles, strict=True)
            ]
            return PerformanceExhibit(time, dragons, (one.handles, two.handles), benches, depth, max(ways))
        stray += min(max(least, -depth / 2.0), most)
    return None


def _separation(a: _Placed, b: _Placed) -> tuple[float, Floats]:
    """Separation of two benches [m] and its normal."""
    bodies = a.body, b.body
    poses = np.array([[one.x, one.y, one.heading] for one in bodies])
    sizes = np.array([[2.0 * one.half_length, 2.0 * one.half_width] for one in bodies])
    one, two = frames(poses, sizes)
    apart = frames_separation(one[None], two[None])
    return float(apart.separation[0]), apart.normal[0]

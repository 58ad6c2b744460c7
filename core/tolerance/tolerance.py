"""Tolerance: the largest stray proven to be safe, and a slightly larger one that is shown to allow a contact.

core/tolerance/safe.py finds the stray that is safe among the benches, and the one between them and each area of a
venue. The tolerance is the least of these, and a pose shows that the two that limit it overlap with a slightly larger
stray.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from core.checks import checked_type
from core.claims.certificate import WithClaim
from core.claims.claim import BenchBetween, ClaimKind, DanceSummary, StrayClaim
from core.contact.encounter_answer import EncounterEvidence
from core.contact.search import NEAR_WORK_BUDGET, before_fold
from core.contact.walls import own_edges
from core.dance import Dance
from core.display import Readable, display
from core.kernels import Budget
from core.language import say
from core.motion.trajectory import trajectory
from core.paths.frame import Frame
from core.performance import Performance
from core.questions import or_about, question_about
from core.tolerance.between_dragons import Between, PerformanceExhibit
from core.tolerance.exhibit import Body, Exhibit, exhibit
from core.tolerance.safe import Field, SafeStray, held_stray
from core.values import Interval
from core.venue import Venue


class Limit(StrEnum):
    """Contact that a larger stray would allow: two benches, or a bench and the venue; or none up to half the shortest
    chord, the largest stray that is tried.

    >>> from core import Dragon, Spiral
    >>> tolerance(Dance(Dragon(40), Spiral()), stop=300.0).limited_by
    <Limit.BENCHES: 'benches'>
    """

    BENCHES = "benches"
    VENUE = "venue"
    CHORD = "chord"


@dataclass(frozen=True, slots=True, repr=False)
class StrayProof(WithClaim):
    """Evidence of the safe stray.

    claim: the claim as a kind and values
    steps: number of steps taken

    >>> from core import Dragon, Spiral
    >>> tolerance(Dance(Dragon(40), Spiral()), stop=300.0).certificate.steps > 0
    True
    """

    claim: StrayClaim
    steps: int


@dataclass(frozen=True, slots=True, repr=False)
class Tolerance(Readable):
    """Tolerance of a dance to strays of people.

    stray: proven safe: while no hole is further from its place, nothing touches; 0: no stray is known to be safe, for
        instance because benches touch without any [m]
    independent: stray proven safe without the help of benches that hold their neighbours apart; equal to stray unless
        such a bench helps [m]
    simple: answer of the simple bound: each point of a bench moves at most its own factor times the stray; from
        samples, and safe because it is not above the stray [m]
    stray_bracket: proven safe; shown to touch, None where no such pose was found [m]
    limited_by: effect of a larger stray. benches: two benches touch; venue: a bench and an edge of the venue; chord: no
        contact up to half of the shortest chord
    time: time at which these are nearest to touching; None if nothing limits the stray [s]
    benches: the pair, the second None for an edge of the venue; None if nothing limits the stray
    area: name of the square or of the obstacle; None if none limits the stray
    exhibit: a pose in which they overlap, with strays up to the second end of the bracket; None where none was found
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    certificate: proof of the safe stray

    >>> from core import Dragon, Spiral
    >>> answer = tolerance(Dance(Dragon(40), Spiral()), stop=300.0)
    >>> round(answer.stray, 4), answer.limited_by.value, answer.benches
    (0.0529, 'benches', (0, 21))
    """

    stray: float
    independent: float
    simple: float
    stray_bracket: tuple[float, float | None]
    limited_by: Limit
    time: float | None
    benches: tuple[int, int | None] | None
    area: str | None
    exhibit: Exhibit | None
    start: float
    stop: float
    certificate: StrayProof

    def _line(self) -> str:
        return _stray_line(self, lambda k, bench: say("bench {bench}", bench=bench))


def _stray_line(found: Tolerance | PerformanceTolerance, bench_words: Callable[[int, int | None], str]) -> str:
    """Which strays are safe, and who touches whom with a larger one. bench_words: of the first or second, 0 or 1"""
    safe, touching = say("no stray is known to be safe"), found.stray_bracket[1]
    if found.stray:
        safe = say("strays up to {stray} are safe", stray=display(found.stray, "m"))
    if touching is None or found.benches is None:
        return safe
    one, other = (bench_words(k, bench) for k, bench in enumerate(found.benches))
    values = {"safe": safe, "stray": display(touching, "m"), "time": display(found.time, "s")}
    second = found.area if found.benches[1] is None else other
    return say("{safe}; with {stray} {one} and {other} touch at {time}", one=one, other=second, **values)


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

    >>> from core import Dragon, Line, Part, Route
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((0.0, 1.0), (40.0, 1.0))]
    >>> answer = tolerance(Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes]))
    >>> round(answer.stray, 3), answer.dragons
    (0.27, (0, 1))
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
        def words(k: int, bench: int | None) -> str:
            return say("bench {bench} of {dragon}", bench=bench, dragon=self.performance.name_of(self.dragons[-k]))

        return _stray_line(self, words)


@question_about("performance", Performance, "how far people may stray was not found")
def _tolerance_together(
    performance: Performance,
    venue: Venue | None = None,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> PerformanceTolerance:
    budget = budget or Budget()
    if venue is not None:
        performance = replace(performance, venue=venue)
    begin, until = span = performance.span(start, stop)
    own = tuple(
        tolerance(part.dance, performance.venue, start=first, stop=last, budget=budget)
        for part in performance.parts
        for first, last in [part.own_span(*span)]
    )
    k = min(range(len(own)), key=lambda k: own[k].stray)
    between = Between(performance, span, budget)
    safe = between.safe(own[k].stray)
    rest = (own, between.evidence(safe), begin, until, performance)
    if (dip := safe.dip) is not None:
        both = between.exhibit(safe, dip)
        bracket = (safe.stray, None if both is None else both.stray)
        dragons, benches = between.stage.pair(*dip.pair)
        limit = (Limit.BENCHES, dragons, dip.moment, benches, None)
        return PerformanceTolerance(safe.stray, bracket, *limit, both, *rest)
    alone, delay = own[k], performance.parts[k].delay
    limits = () if alone.benches is None else (k,)
    time = None if alone.time is None else alone.time + delay
    shown, pose = None, alone.exhibit
    if pose is not None:
        shown = PerformanceExhibit(pose.time + delay, (k,), (pose.handles,), pose.benches, pose.depth, pose.stray)
    return PerformanceTolerance(
        alone.stray, alone.stray_bracket, alone.limited_by, limits, time, alone.benches, alone.area, shown, *rest
    )


@or_about(Performance, _tolerance_together)
@question_about("dance", (Dance, Performance), "how far people may stray was not found")
def tolerance(
    dance: Dance,
    venue: Venue | None = None,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> Tolerance:
    """The largest stray found with which nothing can touch, whatever the motion, and one with which two benches can.

    A stray is the distance of a hole from its place at the same instant, by people and by the play of its pin. Every
    motion that keeps every chord is allowed; speeds do not matter. Neighbours, which share a hole, are never a pair.
    venue: its edges count too, or those of the performance; start, stop: [s]; defaults: dance.begin and the end of the
        run, or those of the performance
    returns: see Tolerance; of a Performance a PerformanceTolerance: the stray is the same for all dragons, and benches
        of two dragons count too. The stray is 0 if benches touch, or are in the edges of the venue, without any; it is
        also 0, without a second end, if the search gave up before it proved a stray
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> answer = tolerance(Dance(Dragon(), Spiral()), stop=300.0)
    >>> round(answer.stray, 4), answer.benches
    (0.0529, (0, 21))
    """
    if venue is not None:
        checked_type("venue", venue, Venue)
    budget = budget or Budget()
    begin, until = dance.whole_span(start, stop)
    most = 0.5 * float(dance.dragon.chords.min())
    least, limit = SafeStray(most, None, 0), None
    steps, independent, simple = 0, most, most
    for ground in _fields(dance, venue, (begin, until), budget):
        safe = held_stray(ground, least.stray)
        steps, independent, simple = steps + safe.steps, min(independent, safe.independent), min(simple, safe.simple)
        if safe.dip is not None:
            least, limit = safe, ground
    known = (least.stray, min(independent, least.stray), min(simple, least.stray))
    proof = StrayProof(_claim(dance, least, known[1], (begin, until), venue), steps)
    if least.dip is None or limit is None:
        return Tolerance(*known, (most, None), Limit.CHORD, None, None, None, None, begin, until, proof)
    _, travel, (a, b) = least.dip
    time = min(max(dance.clock.time(travel), begin), until)
    pose = _exhibit(limit, least, time, dance.path.frame)
    benches = (a, b if limit.edges is None else None) if pose is None else pose.benches
    bracket = (least.stray, None if pose is None else pose.stray)
    by = Limit.BENCHES if limit.edges is None else Limit.VENUE
    return Tolerance(*known, bracket, by, time, benches, limit.area, pose, begin, until, proof)


def _fields(dance: Dance, venue: Venue | None, span: Interval, budget: Budget) -> list[Field]:
    fields, first, last, fold = [], dance.clock.travel(span[0]), dance.clock.travel(span[1]), None
    if dance.nears_fold(span[1]):
        last, fold = before_fold(last), dance.end.theta
    if dance.dragon.benches > 2:
        fields.append(Field(dance, None, None, (first, last), fold, NEAR_WORK_BUDGET, budget))
    if venue is not None:
        share = NEAR_WORK_BUDGET / len(venue.areas)
        placed = [(area.name, own_edges(area, dance.path.frame)) for area in venue.areas]
        fields += [Field(dance, edges, name, (first, last), fold, share, budget) for name, edges in placed]
    return fields


def _exhibit(field: Field, safe: SafeStray, time: float, frame: Frame) -> Exhibit | None:
    """A pose of the whole dragon in which the pair of a dip overlaps; None if not found. frame: of the search"""
    assert safe.dip is not None
    dragon, (a, b) = field.dance.dragon, safe.dip.pair
    at = field.dance.clock.steady(np.array(time))
    handles = trajectory(field.dance.steady, at, budget=field.budget).position
    pair, edge = (a, b if field.edges is None else None), None
    if field.edges is not None:
        x1, y1, x2, y2 = field.edges[b - dragon.benches - 1].tolist()
        heading = math.atan2(y2 - y1, x2 - x1)
        edge = Body(0.5 * (x1 + x2), 0.5 * (y1 + y2), heading, 0.0, 0.5 * math.hypot(x2 - x1, y2 - y1), 0.0)
    overlapping = exhibit(dragon, handles, pair, edge, safe.stray, time)
    return None if overlapping is None else replace(overlapping, handles=frame.points(overlapping.handles))


def _claim(dance: Dance, safe: SafeStray, independent: float, span: Interval, venue: Venue | None) -> StrayClaim:
    between = None
    if independent < safe.stray:
        between = BenchBetween.HELD
    elif safe.dip is not None and safe.dip.pair[1] == safe.dip.pair[0] + 2:
        between = BenchBetween.UNUSED
    kind = ClaimKind.SAFE_STRAY if safe.stray > 0.0 else ClaimKind.NO_SAFE_STRAY
    touches, placed = safe.stray <= 0.0 and safe.touches, venue is not None
    return StrayClaim(kind, DanceSummary.of(dance), placed, *span, max(safe.stray, 0.0), touches, between)

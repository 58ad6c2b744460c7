"""Answer of a search for the first encounter of two dragons, and the evidence for it."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field

import numpy as np

from core.claims.certificate import WithClaim
from core.claims.claim import EncounterClaim
from core.contact.answer import Feature, Outcome, near_words, undecided_words
from core.dance import EndReason
from core.display import Readable, display
from core.language import say
from core.motion.trajectory import trajectory
from core.paths.path import HeadState
from core.performance import Performance, PerformanceEnd
from core.shapes.rectangles import bench_outlines
from core.values import Floats, Interval, Pair, Point


@dataclass(frozen=True, slots=True, repr=False)
class NearPass(Readable):
    """A local minimum of the clearance between dragons over time.

    time: time of the minimum [s]
    clearance: clearance at that time [m]
    dragons: the two dragons
    benches: the bench of each

    >>> from core import Dance, Dragon, Line, Part, Route, least_clearance
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((40.0, 1.0), (0.0, 1.0))]
    >>> passing = Performance([Part(Dance(Dragon(5), Route([lane]))) for lane in lanes])
    >>> least = least_clearance(passing)
    >>> least.dragons, round(least.distance, 3)
    ((0, 1), 0.7)
    """

    time: float
    clearance: float
    dragons: Pair
    benches: Pair


@dataclass(frozen=True, slots=True, repr=False)
class EncounterEvidence(WithClaim):
    """Evidence for the answer.

    claim: the claim as a kind and values
    steps: number of proven steps
    clear_until: time until which no benches of two dragons come within the margin, or touch if it is 0; None if no time
        is proven clear [s]
    bound: largest bound on the second derivative of a gap in time that a step used [m/s^2]
    least_clearance: narrowest pass of two dragons seen before the encounter; None if none was

    >>> from core import Dance, Dragon, Line, Part, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> round(first_contact(crossing).certificate.clear_until, 6)
    39.575
    """

    claim: EncounterClaim
    steps: int
    clear_until: float | None
    bound: float
    least_clearance: NearPass | None


@dataclass(frozen=True, slots=True, repr=False)
class FirstEncounter(Readable):
    """First time at which benches of two different dragons come within the margin, or touch if it is 0.

    outcome: end of the search; contact: benches of two dragons come within the margin, or touch if it is 0
    time: first time within the margin, or touching if it is 0; None when clear or undecided [s]
    time_bracket: two times: proven clear up to the first; within the margin at the second. If undecided, the second is
        the end of the search, unless overlapping names two benches; None if clear or at the start [s]
    dragons: the two dragons, in the order of the dances, from 0
    benches: their benches that meet, or come nearer than the margin, one of each
    corner: corner that touches or is nearest, with the number of its bench in its own dragon
    edge: edge that this corner touches or is nearest to
    feature_dragons: the dragons of corner and edge
    point: position of that corner, x and y [m]
    heads: the heads of both at that time, theta in the own frame of each spiral, x and y in the world
    overlapping: if undecided: the benches that are certainly within the margin, or overlap, at the second of these
        times, perhaps not for the first time; None if none are, or not undecided
    end: end of the performance, when clear
    certificate: evidence for the answer
    gap: gap between the two benches at that time, each in its place: the margin, or less if they are nearer from the
        start, or more with a stray [m]
    margin: required clearance; 0: only a touch counts [m]
    stray: largest distance of a hole from its place, by people and by play [m]
    performance: the performance of the question

    >>> from core import Dance, Dragon, Line, Part, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> first_contact(Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets]))
    <FirstEncounter: bench 0 of dragon 0 and bench 0 of dragon 1 touch at 39.575 s>
    """

    outcome: Outcome
    _: KW_ONLY
    time: float | None = None
    time_bracket: Interval | None = None
    dragons: Pair | None = None
    benches: Pair | None = None
    corner: Feature | None = None
    edge: Feature | None = None
    feature_dragons: tuple[int | None, int | None] = (None, None)
    point: Point | None = None
    heads: tuple[HeadState, HeadState] | None = None
    overlapping: tuple[Pair, Pair] | None = None
    end: PerformanceEnd | None = None
    certificate: EncounterEvidence
    gap: float | None = None
    margin: float
    stray: float = 0.0
    performance: Performance = field(repr=False, compare=False)

    def _line(self) -> str:
        near = near_words(self.margin, self.stray)
        if self.outcome is Outcome.UNDECIDED and self.time_bracket is not None:
            pair = self._pair(*self.overlapping) if self.overlapping else None
            return undecided_words(self.time_bracket, pair, near)
        if self.dragons is not None and self.benches is not None:
            pair = self._pair(self.dragons, self.benches)
            return say("{pair} {near} at {time}", pair=pair, near=near, time=display(self.time, "s"))
        assert self.end is not None
        end = display(self.end.time, "s")
        if self.end.reason is EndReason.STOP:
            return say("no benches of two dragons {near} until {end}", near=near, end=end)
        why = self.performance.ending
        return say("no benches of two dragons {near} until {end}, where {why}", near=near, end=end, why=why)

    def _benches(self) -> tuple[Floats | None, list[int]]:
        if self.time is None or self.dragons is None or self.benches is None:
            return None, []
        parts, placed = self.performance.parts, trajectory(self.performance, self.time)
        outlines = [bench_outlines(part.dance.dragon, one.position) for part, one in zip(parts, placed, strict=True)]
        firsts = np.cumsum([0, *map(len, outlines)])
        pairs = zip(self.dragons, self.benches, strict=True)
        return np.concatenate(outlines), [int(firsts[dragon]) + bench for dragon, bench in pairs]

    def _pair(self, dragons: Pair, benches: Pair) -> str:
        one, two = (
            say("bench {bench} of {dragon}", bench=bench, dragon=self.performance.name_of(k))
            for k, bench in zip(dragons, benches, strict=True)
        )
        return say("{one} and {two}", one=one, two=two)

"""Answer of a search for the first encounter of two dragons, and the evidence for it."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field

from core.claims.certificate import WithClaim
from core.claims.claim import EncounterClaim
from core.contact.answer import Feature, Outcome
from core.dance import EndReason
from core.display import Readable, display
from core.language import say
from core.paths.path import HeadState
from core.performance.performance import Performance, PerformanceEnd
from core.values import Point


@dataclass(frozen=True, slots=True, repr=False)
class NearPass(Readable):
    """A local minimum of the clearance between dragons: time [s], clearance [m], the dragons and their benches."""

    time: float
    clearance: float
    dragons: tuple[int, int]
    benches: tuple[int, int]


@dataclass(frozen=True, slots=True, repr=False)
class EncounterEvidence(WithClaim):
    """Evidence for the answer.

    claim: what is known, as a kind and values; method: the claim and its proof in sentences (core/claims)
    steps: number of proven steps
    clear_until: time until which no benches of two dragons come within the margin [s]; None if no time is proven clear
    bound: the largest bound on the second derivative of a gap in time that a step used [m/s^2]
    least_clearance: the narrowest pass of two dragons seen before the encounter, None if none was
    """

    claim: EncounterClaim
    steps: int
    clear_until: float | None
    bound: float
    least_clearance: NearPass | None
    _units = {"bound": "m/s^2"}  # noqa: RUF012 - a field of a dataclass may not be annotated here


@dataclass(frozen=True, slots=True, repr=False)
class FirstEncounter(Readable):
    """First time at which benches of two different dragons come within the margin.

    outcome: what the search found; certificate: how that is known
    time: [s], None if clear or undecided; the start for contact_at_start
    time_bracket: (proven clear up to, within the margin at) [s], see first_encounter(); if undecided of any width, or
        up to the end of the search if no encounter is certain; None if clear or at the start
    dragons: (i, j), i < j; benches: (a, b), bench a of dragon i and bench b of dragon j; corner, edge: the features
        that meet, each with the number of its bench in its own dragon; feature_dragons: the dragons of corner and edge
    point: (x, y) [m] where they meet; heads: states of the heads of both dragons at that time, theta in the own frame
        of each spiral, x and y in the world
    overlapping: if undecided, (dragons, benches) that are certainly within the margin at the end of the bracket
    gap: separation of the two benches in their nominal places at that time [m]: the margin, or another value at the
        start or with a stray
    end: see PerformanceEnd, if clear; margin, stray: [m]; performance: of the question
    """

    outcome: Outcome
    _: KW_ONLY
    time: float | None = None
    time_bracket: tuple[float, float] | None = None
    dragons: tuple[int, int] | None = None
    benches: tuple[int, int] | None = None
    corner: Feature | None = None
    edge: Feature | None = None
    feature_dragons: tuple[int | None, int | None] = (None, None)
    point: Point | None = None
    heads: tuple[HeadState, HeadState] | None = None
    overlapping: tuple[tuple[int, int], tuple[int, int]] | None = None
    end: PerformanceEnd | None = None
    certificate: EncounterEvidence
    gap: float | None = None
    margin: float
    stray: float = 0.0
    performance: Performance = field(repr=False, compare=False)

    def _line(self) -> str:
        near = say("come within {margin}", margin=display(self.margin, "m")) if self.margin else say("touch")
        if self.stray:
            near = say("may {near} with strays up to {stray}", near=near, stray=display(self.stray, "m"))
        if self.outcome is Outcome.UNDECIDED and self.time_bracket is not None:
            begin, end = (display(time, "s") for time in self.time_bracket)
            if self.overlapping is None:
                return say("undecided from {begin} on", begin=begin)
            pair = self._pair(*self.overlapping)
            return say("undecided from {begin} on; {pair} {near} at {end}", begin=begin, pair=pair, near=near, end=end)
        if self.dragons is not None and self.benches is not None:
            pair = self._pair(self.dragons, self.benches)
            return say("{pair} {near} at {time}", pair=pair, near=near, time=display(self.time, "s"))
        assert self.end is not None
        end = display(self.end.time, "s")
        if self.end.reason is EndReason.STOP:
            return say("no benches of two dragons {near} until {end}", near=near, end=end)
        why = self.performance.ending
        return say("no benches of two dragons {near} until {end}, where {why}", near=near, end=end, why=why)

    def _pair(self, dragons: tuple[int, int], benches: tuple[int, int]) -> str:
        one, two = (
            say("bench {bench} of {dragon}", bench=bench, dragon=self.performance.name_of(k))
            for k, bench in zip(dragons, benches, strict=True)
        )
        return say("{one} and {two}", one=one, two=two)

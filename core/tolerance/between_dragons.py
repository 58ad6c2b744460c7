"""Strays between dragons: the ground that benches of two dragons may cover, and poses in which they overlap.

The stray is found as for one dragon (core/tolerance/safe.py). The last march is the proof of a first encounter that is
clear with that stray.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.claims.claim import ClaimKind, EncounterClaim
from core.contact.encounter import first_encounter, marched, summary
from core.contact.encounter_answer import EncounterEvidence
from core.contact.gaps import sampled, sampled_least
from core.contact.search import WORK_BUDGET
from core.contact.stage import Stage
from core.dance import EndReason
from core.display import WithArrays, display
from core.kernels import Budget
from core.kernels.results import Dip, Marched
from core.language import say
from core.motion.trajectory import trajectory
from core.performance import Performance
from core.shapes.reach import gains
from core.tolerance.exhibit import body, extended, first_overlap, separation_of
from core.tolerance.safe import STRAY_MIN, SafeStray, safe_stray
from core.values import Floats, Interval


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class PerformanceExhibit(WithArrays):
    """Poses of one or two whole dragons in which two benches overlap, every chord as long as it should be to rounding.

    time: time of the poses [s]
    dragons: the dragon with both benches, or the two with one each
    handles: places of the handles of each of these dragons, x and y, head first [m]
    benches: the pair, the second None for an edge of the venue
    depth: depth of the overlap [m]
    stray: largest distance of a handle from its place [m]

    >>> from core import Dance, Dragon, Line, Part, Route, tolerance
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((0.0, 1.0), (40.0, 1.0))]
    >>> abreast = Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes])
    >>> shown = tolerance(abreast).exhibit
    >>> shown.dragons, shown.depth > 0.0
    ((0, 1), True)
    """

    time: float
    dragons: tuple[int, ...]
    handles: tuple[Floats, ...]
    benches: tuple[int, int | None]
    depth: float
    stray: float

    def _line(self) -> str:
        depth, stray = display(self.depth, "m"), display(self.stray, "m")
        benches = display(self.benches)
        return say(
            "an overlap of {depth} of benches {benches} with strays up to {stray}",
            depth=depth, benches=benches, stray=stray,
        )  # fmt: skip


@dataclass(frozen=True)
class Between:
    """The ground that benches of two dragons may cover: a StrayGround of core/tolerance/safe.py."""

    performance: Performance
    span: Interval
    budget: Budget
    straying = 2.0

    @cached_property
    def gain(self) -> float:
        return 2.0 * max(float(gains(part.dance.dragon).max()) for part in self.performance.parts)

    @cached_property
    def stage(self) -> Stage:
        """The benches in their nominal places."""
        return self.gaps(0.0)

    @cached_property
    def in_place(self) -> list[Dip]:
        return sampled(self.stage)

    def gaps(self, stray: float, begin: float | None = None) -> Stage:
        span = (self.span[0] if begin is None else begin, self.span[1])
        return Stage(self.performance, span, 0.0, stray=stray, work=WORK_BUDGET, budget=self.budget)

    def march(self, stray: float, begin: float) -> tuple[Stage, Marched]:
        stage = self.gaps(stray, begin)
        met = marched(stage, dips=False)
        self.budget.afford()
        return stage, met

    def safe(self, most: float) -> SafeStray:
        """The largest stray up to `most` that is safe between dragons; 0 at the first touch, or at a sampled one if
        that is not decided."""
        if len(self.performance.parts) == 1 or most < STRAY_MIN:
            return SafeStray(most, None, 0)
        nominal = sampled_least(self.stage, self.in_place)
        if nominal.gap > 0.0:
            return safe_stray(self, most, nominal)
        begin, until = self.span
        stop = None if until >= self.performance.end.time else until
        met = first_encounter(self.performance, start=begin, stop=stop, budget=self.budget)
        if met.time is not None and met.dragons is not None and met.benches is not None:
            nominal = nominal._replace(moment=met.time, pair=self.stage.rows(met.dragons, met.benches))
        return SafeStray(0.0, nominal, 0, touches=True)

    def evidence(self, safe: SafeStray) -> EncounterEvidence | None:
        """Evidence that no two dragons touch with a stray; None for one dragon, or without a safe stray."""
        if safe.proof is None:
            return None
        (begin, until), end = self.span, self.performance.end
        reason = end.reason if until >= end.time else EndReason.STOP
        values = {"margin": 0.0, "stray": safe.stray, "start": begin, "clear_until": until, "end": reason}
        claim = EncounterClaim(ClaimKind.CLEAR, **summary(self.performance), **values)  # type: ignore[arg-type]
        return EncounterEvidence(claim, safe.proof.steps, until, safe.proof.gap_curvature, None)

    # Method: as in core/tolerance/exhibit.py. Each dragon follows its own bench.
    def exhibit(self, safe: SafeStray, dip: Dip) -> PerformanceExhibit | None:
        """Poses of two whole dragons in which the pair of a dip overlaps, with strays little above the safe ones; None
        if not found."""
        dragons, benches = self.stage.pair(*dip.pair)
        parts = [self.performance.parts[k] for k in dragons]
        handles = [trajectory(one.dance, one.own_time(dip.moment), budget=self.budget).position for one in parts]
        placed = list(zip([part.dance.dragon for part in parts], handles, benches, strict=True))
        a, b = (body(*one) for one in placed)

        def posed(way: float, rotations: tuple[float, float], stray: float) -> PerformanceExhibit:
            moved = []
            for (dragon, own, bench), bearing, rotation in zip(placed, (way, way + math.pi), rotations, strict=True):
                strays = {bench: body(dragon, own, bench).strays(bearing, rotation, stray)}
                extension = extended(dragon.chords, own, strays)
                assert extension is not None  # only two benches of one dragon may leave no place to those between them
                moved.append(extension)
            one, two = (body(dragon, at, bench) for (dragon, _, bench), at in zip(placed, moved, strict=True))
            most = max(float(np.hypot(*(at - own).T).max()) for at, own in zip(moved, handles, strict=True))
            return PerformanceExhibit(dip.moment, dragons, tuple(moved), benches, -separation_of(one, two)[0], most)

        return first_overlap(a, b, separation_of(a, b)[1], safe.stray, 0.5 * min(a.chord, b.chord), posed)

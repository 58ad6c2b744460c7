"""The largest stray that is safe among the benches, or between them and the edges of one area.

The least stray at which two benches can meet, over the dance, is found as the least clearance is
(core/contact/clearance.py): an upper bound first, from samples; then a march of the ground that benches may cover
(core/tolerance/reach.py) with a stray a little smaller. It either reaches the end, which proves that no dance within
that stray touches; or two grounds meet. Then the stray at which these two just graze is found, and the march goes on
from there with it: what it has passed is clear with the larger stray, and so with the smaller one.

All of that takes benches to stray independently. Where two with one bench between them limit the stray so, that bench
may be shown to hold all such pairs apart with more (core/tolerance/between.py): then the others are asked once more.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from core.budget import Budget
from core.contact.clearance import (
    PROFILE_STEP,
    Dip,
    Samples,
    refined_dip,
    sampled_least,
    samples_between,
    samples_where,
)
from core.contact.fold import clear_to_fold
from core.contact.march import TOUCHES, Ended
from core.contact.search import Search
from core.dance import Dance, RunEnd
from core.dragon import Dragon
from core.tolerance.between import held_apart
from core.tolerance.reach import Reach, gains, reach, simple_reach
from core.values import Floats

# How far below the least stray at which benches can meet the proof is tried [1 of that stray]; the second one where the
# first takes too many steps.
BELOW = (2e-4, 2e-3)
# Largest number of times that a march may find a smaller stray.
ROUNDS = 100
# The stray at which two benches graze is found to this part of it [1], in at most so many steps.
GRAZE_WITHIN, GRAZE_STEPS = 2e-5, 20
# No ground reaches further than the gain of its bench times the stray, its hulls no further than so much more [1].
SAMPLED_BEYOND = 1.01
# Strays below this are taken for none [m]: rounding hides what they do.
STRAY_MIN = 1e-9


@dataclass(frozen=True)
class Field:
    """What may be met: the dance's other benches, or the edges of one area.

    dance: on the path as it is searched; work: of all its searches together; span: of head travel [m]
    between: pairs of benches with fewer between them are not asked for [1]
    """

    dance: Dance
    edges: Floats | None
    area: str | None
    span: tuple[float, float]
    fold: RunEnd | None
    work: float
    budget: Budget
    between: int = 1

    def search(self, stray: float, covered: Callable[[Dragon, float], Reach] = reach) -> Search:
        """The ground that benches may cover."""
        where = (self.dance.dragon, self.dance.path, 0.0, self.edges)
        found = Search(*where, work=self.work, budget=self.budget, stray=stray, covered=covered)
        found.between = found.scene.between = self.between
        return found

    @cached_property
    def gain(self) -> float:
        """With so much of the stray between them no two grounds meet [1]."""
        return (1 if self.edges is not None else 2) * float(gains(self.dance.dragon).max())

    @cached_property
    def in_place(self) -> Samples:
        """Clearances of the benches in their places."""
        return samples_between(self.search(0.0), *self.span)

    def sampled(self, stray: float, covered: Callable[[Dragon, float], Reach] = reach) -> Dip:
        """The least clearance that samples show; only those count where some ground can reach another."""
        search = self.search(stray, covered)
        return sampled_least(search, samples_where(search, self.in_place, SAMPLED_BEYOND * self.gain * stray))


@dataclass(frozen=True, slots=True)
class Found:
    """A stray that is safe in one field, and the dip that limits it.

    touches: is there a contact without any stray? independent, simple: see Tolerance
    """

    stray: float
    dip: Dip | None
    steps: int
    touches: bool = False
    independent: float = math.inf
    simple: float = math.inf


def held_stray(field: Field, most: float) -> Found:
    """_safe_stray(), or more where the bench between two others is known to hold them apart with more."""
    safe = _safe_stray(field, most)
    simple, independent = _simple(field, safe), safe.stray
    found = replace(safe, independent=independent, simple=simple)
    if safe.touches or field.edges is not None or safe.dip is None or safe.dip[2][1] != safe.dip[2][0] + 2:
        return found
    held = held_apart(field.dance, field.span[1], most, field.budget)
    if held <= safe.stray:
        return found
    others = Found(held, None, 0)
    if field.dance.dragon.benches > 3:
        others = _safe_stray(replace(field, between=2), held)
    if others.stray <= safe.stray:
        return found
    dip = safe.dip if others.dip is None and held < most else others.dip
    return Found(others.stray, dip, safe.steps + others.steps, False, independent, simple)


def _simple(field: Field, safe: Found) -> float:
    """The simple bound [m], or the safe stray if that is less."""
    stray = field.sampled(0.0)[0] / field.gain
    for _ in range(GRAZE_STEPS):
        if stray < STRAY_MIN:
            return 0.0
        grazing = _grazing(field, stray, field.sampled(stray, simple_reach), simple_reach)[0]
        if abs(grazing - stray) <= GRAZE_WITHIN * stray:
            break
        stray = grazing
    return min(stray, safe.stray)


def _safe_stray(field: Field, most: float) -> Found:
    """The largest stray up to `most` that is safe in a field, a little less than what its samples and marches show."""
    begin, until = field.span
    nominal = field.sampled(0.0)
    if nominal[0] <= 0.0:
        state, touch, _ = field.search(0.0).approach(begin, until, field.dance.clock.slowest)
        at_first = (0.0, touch.touching, touch.benches) if touch.touching is not None and state in TOUCHES else nominal
        return Found(0.0, at_first, touch.steps, touches=True)
    # Two benches that approach each other by the stray each, in parallel, meet where it is half their clearance.
    first = min(most, nominal[0] * (1.0 if field.edges is not None else 0.5))
    dip = field.sampled(first)
    stray, limiting = (first, None) if dip[0] > 0.0 else _grazing(field, first, dip)
    steps, proven_to = 0, begin
    for below in BELOW:
        for _ in range(ROUNDS):
            tried = stray * (1.0 - below) if limiting is not None else stray
            if tried < STRAY_MIN:
                return Found(0.0, limiting, steps)
            search = field.search(tried)
            state, met = search.march(until, 0.0, start=proven_to)
            search.budget.afford()
            steps += met.steps
            if state is Ended.REACHED or (state is Ended.STUCK and met.touching is None):
                if field.fold is not None and not clear_to_fold(search, min(met.proven, until), field.fold):
                    break
                if state is Ended.REACHED or field.fold is not None:
                    return Found(tried, limiting, steps)
                break
            if met.touching is None:
                break
            proven_to = max(proven_to, met.proven)
            step = PROFILE_STEP * search.extremes[1]
            around = (max(begin, met.touching - step), met.touching, min(until, met.touching + step))
            found, limiting = _grazing(field, tried, refined_dip(search, *around))
            stray = min(found, tried)
    return Found(0.0, limiting or nominal, steps)  # nothing was proven of any stray


def _grazing(
    field: Field, stray: float, dip: Dip, covered: Callable[[Dragon, float], Reach] = reach
) -> tuple[float, Dip]:
    """The stray near this one at which the grounds that meet in a dip only graze, to GRAZE_WITHIN of it [m]; that dip.

    Where the stray is larger by x, the ground of each bench reaches at least x further in every direction: so the gap
    falls at least by that much for each bench, and as evenly as the slope of the last two strays says.
    """
    slope = 1.0 if field.edges is not None else 2.0
    for _ in range(GRAZE_STEPS):
        if abs(dip[0]) <= slope * GRAZE_WITHIN * stray:
            break
        last, stray = (stray, dip[0]), max(stray + dip[0] / slope, 0.0)
        search = field.search(stray, covered)
        around, travel = PROFILE_STEP * search.extremes[1], dip[1]
        dip = refined_dip(search, max(field.span[0], travel - around), travel, min(field.span[1], travel + around))
        if stray != last[0]:
            slope = max(slope, (dip[0] - last[1]) / (last[0] - stray))
    return stray, dip

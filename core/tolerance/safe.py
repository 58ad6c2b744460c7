"""The largest stray that is safe among the benches, or between them and the edges of one area.

The least stray at which two benches can meet during the dance is found in the same way as the least clearance
(core/contact/clearance.py). Samples give an upper bound; then the ground that benches may cover
(core/shapes/reach.py) marches with a slightly smaller stray. If the march reaches the end, no dance within that
stray touches, which is proven.
If two grounds meet, the stray at which these two just graze is found, and the march continues from there with it: the
way already passed is clear with the larger stray, and so with the smaller one.

All of that takes benches to stray independently. If two benches with one between them limit the stray, it may be proven
that the bench between holds all such pairs apart with a larger one (core/contact/between.py); then only the other
pairs are searched again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from core.contact import clearance
from core.contact.between import held_apart
from core.contact.clearance import PROFILE_STEP, refined_dip
from core.contact.fold import clear_to_fold
from core.contact.march import TOUCHES
from core.contact.search import ContactSearch
from core.dance import Dance
from core.dragon import Dragon
from core.kernels import NO_BRACKET, Budget, Ended
from core.kernels.results import Dip
from core.shapes.reach import Reach, gains, reach, simple_reach
from core.values import Floats

# Part by which the stray of the proof is below the least stray at which benches can meet [1]; the second value is for
# dances where the first one takes too many steps.
BELOW = (2e-4, 2e-3)
# Largest number of times that a march may find a smaller stray.
ROUNDS = 100
# Relative width to which the stray is found at which two benches graze [1], and the largest number of steps for it.
GRAZE_WITHIN, GRAZE_STEPS = 2e-5, 20
# Reach of the hulls of a ground relative to its bench's gain times the stray, at most [1]; the ground itself reaches 1.
SAMPLED_BEYOND = 1.01
# Strays below this count as none [m]: rounding hides their effect.
STRAY_MIN = 1e-9


@dataclass(frozen=True)
class Field:
    """Obstacles of one kind: the other benches of the dance, or the edges of one area.

    dance: on the path as it is searched; work: of all its searches together; span: of head travel [m]
    between: least number of benches between the two of a pair that counts [1]
    """

    dance: Dance
    edges: Floats | None
    area: str | None
    span: tuple[float, float]
    fold: float | None
    work: float
    budget: Budget
    between: int = 1

    def search(self, stray: float, covered: Callable[[Dragon, float], Reach] = reach) -> ContactSearch:
        """A search for contacts of the ground that benches may cover."""
        where = (self.dance.dragon, self.dance.path, 0.0, self.edges)
        search = ContactSearch(*where, work=self.work, budget=self.budget, stray=stray, covered=covered)
        search.leave_out(self.between)
        return search

    @cached_property
    def gain(self) -> float:
        """Gap, relative to the stray, from which on no two grounds meet [1]."""
        return (1 if self.edges is not None else 2) * float(gains(self.dance.dragon).max())

    @cached_property
    def in_place(self) -> clearance.ClearanceSamples:
        """Clearances of the benches in their nominal places."""
        return clearance.samples_between(self.search(0.0), *self.span)

    def sampled(self, stray: float, covered: Callable[[Dragon, float], Reach] = reach) -> Dip:
        """The least clearance of the samples at which some ground can reach another."""
        search, near = self.search(stray, covered), SAMPLED_BEYOND * self.gain * stray
        return clearance.sampled_least(search, clearance.samples_where(search, self.in_place, near))


@dataclass(frozen=True, slots=True)
class SafeStray:
    """A stray that is safe in one field, and the dip that limits it.

    touches: whether there is a contact without any stray; independent, simple: see Tolerance
    """

    stray: float
    dip: Dip | None
    steps: int
    touches: bool = False
    independent: float = math.inf
    simple: float = math.inf


def held_stray(field: Field, most: float) -> SafeStray:
    """_safe_stray(), or a larger stray if the bench between two others is known to hold them apart with it."""
    safe = _safe_stray(field, most)
    simple, independent = _simple(field, safe), safe.stray
    alone = replace(safe, independent=independent, simple=simple)
    if safe.touches or field.edges is not None or safe.dip is None or safe.dip.benches[1] != safe.dip.benches[0] + 2:
        return alone
    held = held_apart(field.dance, field.span[1], most, field.budget)
    others = SafeStray(held, None, 0)
    if field.dance.dragon.benches > 3 and held > safe.stray:
        others = _safe_stray(replace(field, between=2), held)
    if others.stray <= safe.stray:
        return alone
    dip = safe.dip if others.dip is None and held < most else others.dip
    return SafeStray(others.stray, dip, safe.steps + others.steps, False, independent, simple)


def _simple(field: Field, safe: SafeStray) -> float:
    """The simple bound [m], or the safe stray if that is less."""
    stray = field.sampled(0.0).gap / field.gain
    for _ in range(GRAZE_STEPS):
        if stray < STRAY_MIN:
            return 0.0
        grazing = _grazing(field, stray, field.sampled(stray, simple_reach), simple_reach)[0]
        if abs(grazing - stray) <= GRAZE_WITHIN * stray:
            break
        stray = grazing
    return min(stray, safe.stray)


def _safe_stray(field: Field, most: float) -> SafeStray:
    """The largest stray up to `most` that is safe in a field, slightly less than its samples and marches show."""
    begin, until = field.span
    nominal = field.sampled(0.0)
    if nominal.gap <= 0.0:
        state, touch, _ = field.search(0.0).approach(begin, until, field.dance.clock.slowest)
        at_first = (
            Dip(0.0, touch.touching, touch.benches) if touch.touching is not None and state in TOUCHES else nominal
        )
        return SafeStray(0.0, at_first, touch.steps, touches=True)
    # Two parallel benches that both stray towards each other meet if the stray is half their clearance.
    first = min(most, nominal.gap * (1.0 if field.edges is not None else 0.5))
    dip = field.sampled(first)
    stray, limiting = (first, None) if dip.gap > 0.0 else _grazing(field, first, dip)
    steps, proven_to = 0, begin
    for below in BELOW:
        for _ in range(ROUNDS):
            tried = stray * (1.0 - below) if limiting is not None else stray
            if tried < STRAY_MIN:
                return SafeStray(0.0, limiting, steps)
            search = field.search(tried)
            state, result = search.march(until, NO_BRACKET, start=proven_to)
            search.budget.afford()
            steps += result.steps
            if state is Ended.REACHED or (state is Ended.STUCK and result.touching is None):
                if field.fold is not None and not clear_to_fold(search, min(result.proven, until), field.fold):
                    break
                if state is Ended.REACHED or field.fold is not None:
                    return SafeStray(tried, limiting, steps)
                break
            if result.touching is None:
                break
            proven_to = max(proven_to, result.proven)
            step = PROFILE_STEP * search.rings.all_shortest
            around = (max(begin, result.touching - step), result.touching, min(until, result.touching + step))
            grazing, limiting = _grazing(field, tried, refined_dip(search, *around))
            stray = min(grazing, tried)
    return SafeStray(0.0, limiting or nominal, steps)  # no stray was proven to be safe


def _grazing(
    field: Field, stray: float, dip: Dip, covered: Callable[[Dragon, float], Reach] = reach
) -> tuple[float, Dip]:
    """The stray near this one at which the grounds in a dip only graze, to GRAZE_WITHIN of it [m], and the dip then.

    If the stray is larger by x, the ground of each bench reaches at least x further in every direction. So the gap
    falls by at least x for each bench, with the slope of the last two strays.
    """
    slope = 1.0 if field.edges is not None else 2.0
    for _ in range(GRAZE_STEPS):
        if abs(dip.gap) <= slope * GRAZE_WITHIN * stray:
            break
        last, stray = (stray, dip.gap), max(stray + dip.gap / slope, 0.0)
        search = field.search(stray, covered)
        around, travel = PROFILE_STEP * search.rings.all_shortest, dip.travel
        dip = refined_dip(search, max(field.span[0], travel - around), travel, min(field.span[1], travel + around))
        if stray != last[0]:
            slope = max(slope, (dip.gap - last[1]) / (last[0] - stray))
    return stray, dip

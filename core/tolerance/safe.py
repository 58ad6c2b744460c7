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
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Protocol, TypeVar

from core.contact.between import held_apart
from core.contact.brackets import TOUCHES
from core.contact.fold import ended_at_fold
from core.contact.gaps import Gaps, refined, sampled, sampled_again, sampled_least
from core.contact.search import ContactSearch, SearchInput
from core.contact.stretch import Stretch
from core.dance import Dance
from core.dragon import Dragon
from core.kernels import NO_BRACKET, Budget, Ended
from core.kernels.results import Dip, Marched
from core.shapes.reach import Reach, gains, reach, simple_reach
from core.values import Floats, Interval

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

G_co = TypeVar("G_co", bound=Gaps, covariant=True)


@dataclass(frozen=True)
class Field:
    """Obstacles of one kind: the other benches of the dance, or the edges of one area.

    dance: on the path as it is searched; work: of all its searches together; span: of head travel [m]
    between: least number of benches between the two of a pair that counts [1]
    """

    dance: Dance
    edges: Floats | None
    area: str | None
    span: Interval
    fold: float | None
    work: float
    budget: Budget
    between: int = 1

    def gaps(self, stray: float, covered: Callable[[Dragon, float], Reach] = reach) -> Stretch:
        """The gaps of the ground that benches may cover."""
        where = (self.dance.dragon, self.dance.path, 0.0, self.edges)
        sought = SearchInput(*where, between=self.between, stray=stray, covered=covered)
        search = ContactSearch(sought, work=self.work, budget=self.budget)
        return Stretch(search, self.span, self.dance.clock.slowest, self.fold)

    def march(self, stray: float, begin: float) -> tuple[Stretch, Marched]:
        gaps, until = self.gaps(stray), self.span[1]
        result = gaps.search.march(until, NO_BRACKET, start=begin)
        self.budget.afford()
        if self.fold is not None:
            result = ended_at_fold(gaps.search, result, until, self.fold)
        return gaps, result

    @property
    def straying(self) -> float:
        return 2.0 if self.edges is None else 1.0

    @cached_property
    def gain(self) -> float:
        return self.straying * float(gains(self.dance.dragon).max())

    @cached_property
    def in_place(self) -> list[Dip]:
        return sampled(self.gaps(0.0))


@dataclass(frozen=True, slots=True)
class SafeStray:
    """A stray that is safe in one field, and the dip that limits it.

    touches: whether there is a contact without any stray; independent, simple: see Tolerance; proof: the last march
    """

    stray: float
    dip: Dip | None
    steps: int
    touches: bool = False
    independent: float = math.inf
    simple: float = math.inf
    proof: Marched | None = None


def held_stray(field: Field, most: float) -> SafeStray:
    """_safe_stray(), or a larger stray if the bench between two others is known to hold them apart with it."""
    safe = _safe_stray(field, most)
    simple, independent = _simple(field, safe), safe.stray
    alone = replace(safe, independent=independent, simple=simple)
    if safe.touches or field.edges is not None or safe.dip is None or safe.dip.pair[1] != safe.dip.pair[0] + 2:
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
    simple = partial(field.gaps, covered=simple_reach)
    stray = sampled_ground(field, 0.0).gap / field.gain
    for _ in range(GRAZE_STEPS):
        if stray < STRAY_MIN:
            return 0.0
        grazing = _grazing(simple, field.straying, stray, sampled_ground(field, stray, simple))[0]
        if abs(grazing - stray) <= GRAZE_WITHIN * stray:
            break
        stray = grazing
    return min(stray, safe.stray)


def _safe_stray(field: Field, most: float) -> SafeStray:
    """The largest stray up to `most` that is safe in a field."""
    nominal = sampled_ground(field, 0.0)
    if nominal.gap > 0.0:
        return safe_stray(field, most, nominal)
    touch = field.gaps(0.0).search.approach(*field.span, field.dance.clock.slowest)
    if touch.touching is not None and touch.ended in TOUCHES:
        nominal = Dip(0.0, touch.touching, touch.pair)
    return SafeStray(0.0, nominal, touch.steps, touches=True)


class StrayGround(Protocol[G_co]):
    """The ground that benches may cover if they stray, over a span of moments (core/contact/gaps.py).

    straying: number of two that meet which stray [1]; gain: gap, relative to the stray, from which on no two grounds
    meet [1]; in_place: samples of the benches in their nominal places
    """

    @property
    def span(self) -> Interval: ...
    @property
    def straying(self) -> float: ...
    @property
    def gain(self) -> float: ...
    @property
    def in_place(self) -> Sequence[Dip]: ...
    def gaps(self, stray: float, /) -> G_co:
        """The gaps of the grounds with a stray [m]."""

    def march(self, stray: float, begin: float, /) -> tuple[G_co, Marched]:
        """The gaps with a stray, and a march from a moment on; REACHED: no grounds meet, which is proven."""


def sampled_ground(ground: StrayGround[Gaps], stray: float, gaps_of: Callable[[float], Gaps] | None = None) -> Dip:
    """The least gap of the samples at which some ground can reach another. gaps_of: default: ground.gaps"""
    gaps = (gaps_of or ground.gaps)(stray)
    return sampled_least(gaps, sampled_again(gaps, ground.in_place, SAMPLED_BEYOND * ground.gain * stray))


# Input:  the largest stray to be tried, and the least gap of the samples in place.
# State:  `stray` and `limiting`, the least stray known at which grounds graze, and where; `proven_to`, up to which all
#         is clear with a larger one.
# Output: a stray slightly below, proven to the end.
def safe_stray(ground: StrayGround[Gaps], most: float, nominal: Dip) -> SafeStray:
    """The largest stray up to `most` that is safe on a ground, slightly less than its samples and marches show."""
    # Two parallel benches that both stray towards each other meet if the stray is half their clearance.
    first = min(most, nominal.gap / ground.straying)
    dip = sampled_ground(ground, first)
    stray, limiting = (first, nominal if first < most else None)
    if dip.gap <= 0.0:
        stray, limiting = _grazing(ground.gaps, ground.straying, first, dip)
    steps, proven_to = 0, ground.span[0]
    for below in BELOW:
        for _ in range(ROUNDS):
            tried = stray * (1.0 - below) if limiting is not None else stray
            if tried < STRAY_MIN:
                return SafeStray(0.0, limiting, steps)
            gaps, marched = ground.march(tried, proven_to)
            steps += marched.steps
            if marched.ended is Ended.REACHED:
                return SafeStray(tried, limiting, steps, proof=marched)
            if marched.touching is None:
                break
            proven_to = max(proven_to, marched.proven)
            grazing, limiting = _grazing(ground.gaps, ground.straying, tried, refined(gaps, marched.touching))
            stray = min(grazing, tried)
    return SafeStray(0.0, limiting or nominal, steps)  # no stray was proven to be safe


def _grazing(gaps_of: Callable[[float], Gaps], straying: float, stray: float, dip: Dip) -> tuple[float, Dip]:
    """The stray near this one at which the grounds in a dip only graze, to GRAZE_WITHIN of it [m], and the dip then.

    If the stray is larger by x, the ground of each bench reaches at least x further in every direction. So the gap
    falls by at least x for each bench that strays, with the slope of the last two strays.
    """
    slope = straying
    for _ in range(GRAZE_STEPS):
        if abs(dip.gap) <= slope * GRAZE_WITHIN * stray:
            break
        last, stray = (stray, dip.gap), max(stray + dip.gap / slope, 0.0)
        dip = refined(gaps_of(stray), dip.moment)
        if stray != last[0]:
            slope = max(slope, (dip.gap - last[1]) / (last[0] - stray))
    return stray, dip

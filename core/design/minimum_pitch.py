"""Minimum pitch: the tightest spiral that leads to the turning circle, for one dragon or several."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core.checks import SIZE_MAX, checked_number, checked_size
from core.contact.search import MARGIN_MAX
from core.design.pitch_search import JustifiedBy, LimitedBy, PitchSearch, dragon_too_near
from core.design.straight import Straight
from core.design.ways import Ways
from core.display import Readable, display
from core.dragon import Dragon, Stray, checked_stray
from core.errors import InvalidValue
from core.kernels import Budget, Halted
from core.language import say
from core.paths.spiral import START_TURNS_MAX, Spiral, end_theta
from core.quantities import Given, Quantity, quantities
from core.questions import question_about
from core.values import Interval, Pair

# Largest number of dragons in one spiral, and of the benches of all together [1].
DRAGONS_MAX = 100
BENCHES_MAX = 50_000

Intervals = tuple[Interval, ...]


@dataclass(frozen=True, slots=True, repr=False)
class MinimumPitch(Readable):
    """The smallest pitch such that every larger one is free of contact down to the turning circle.

    pitch: the minimum pitch [m]
    pitch_bracket: infeasible pitch; feasible pitch; equal if any smaller pitch would begin inside the circle. Those in
        between are undecided: more than 1e-9 m on wide spirals, or where a fold disappears on the way [m]
    limited_by: effect of a slightly smaller pitch. graze: contact on the way; circle: contact when the head is on the
        circle; start: contact at the start or, if benches is None, a start inside the circle; fold: a bench cannot
        follow the head as far as the circle. Contact: within the margin, or a touch if it is 0
    benches: the pair in contact at a slightly smaller pitch; None for a fold or if there is none
    bench: the bench that folds at a slightly smaller pitch; None if none does
    head_radius: distance of the head from the centre at that moment [m]
    other_feasible_intervals: intervals of smaller pitches that are feasible too, found on a grid of 400 pitches [m]
    justified_by: evidence that larger pitches are feasible. bound: proven for all; scan: below proven_from only single
        pitches are proven, at most scan_step apart, so a narrower infeasible range there is not excluded
    proven_from: every pitch from this one up is proven feasible; equals pitch without a scan [m]
    proven_up_to: upper end of the proven pitches; None: no upper end [m]
    scan_step: largest distance between two pitches of the scan; None: no scan [m]
    evaluations: number of runs to the circle computed, for single pitches or for whole bands of pitches
    dragons: the dragons of the two benches, the first bench that of dragon 0; None if both are of one dragon

    >>> answer = minimum_pitch(Dragon(), turning_radius=4.5)
    >>> round(answer.pitch, 9), answer.benches, answer.proven_up_to
    (0.450337393, (0, 19), None)
    """

    pitch: float
    pitch_bracket: Interval
    limited_by: LimitedBy
    benches: Pair | None
    bench: int | None
    head_radius: float | None
    other_feasible_intervals: tuple[tuple[float, float], ...]
    justified_by: JustifiedBy
    proven_from: float
    proven_up_to: float | None
    scan_step: float | None
    evaluations: int
    dragons: Pair | None = None

    def _line(self) -> str:
        limit = say(self.limited_by.value)
        if self.bench is not None:
            limit = say("{limit} of bench {bench}", limit=limit, bench=self.bench)
        elif self.benches:
            a, b = self.benches
            limit = say("{limit} of benches {a} and {b}", limit=limit, a=a, b=b)
            if self.dragons:
                values = {"limit": say(self.limited_by.value), "other": self.dragons[1]}
                limit = say("{limit} of bench {a} of dragon 0 and bench {b} of dragon {other}", a=a, b=b, **values)
        proven = say("proven for every larger pitch")
        if self.proven_up_to is not None:
            proven = say("proven up to {most}", most=display(self.proven_up_to, "m"))
        if self.scan_step:
            step, least = display(self.scan_step, "m"), display(self.proven_from, "m")
            proven = say("scanned every {step} up to {least}, then {proven}", step=step, least=least, proven=proven)
        pitch = display(self.pitch, "m")
        return say("{pitch}, limited by {limit}; {proven}", pitch=pitch, limit=limit, proven=proven)


@question_about("dragon", Dragon)
def minimum_pitch(
    dragon: Dragon,
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    dragons: int = 1,
    budget: Budget | None = None,
) -> MinimumPitch:
    """The smallest pitch such that every larger one lets the head reach the turning circle without contact.

    turning_radius: [m]; start_turns: turns from the centre to the start; margin: [m], clearance required
    stray: largest distance of every hole from its place [m]; at the answer no benches can touch with such strays
    dragons: number of equal dragons in the one spiral: dragon k is turned by k / dragons of a turn, all start at once;
        the pitch then keeps apart also the benches of any two of them
    budget: default: PITCH_WORK
    Every pitch above a certain one is feasible, because the dragon is nearly straight on such a wide spiral
    (`core/design/straight.py`). Below it bands of pitches are proven clear, each for all its pitches at once
    (`core/design/pitch_bands.py`), down to a graze of two benches, so no infeasible pitch is missed. A scan, stated in
    the answer, replaces the bands if they have no bound: if benches are so long that handles move backwards on the way,
    or if the start lies inside the region where benches can touch while ways from further out do touch.
    raises: InvalidValue, also if benches touch on a straight line, or dragons on the circle, so that no pitch is large
        enough; TooMuchWork
    source: the model of Yang et al., section 2.5; their bisection of the contact radius cannot converge, because that
        radius jumps over the circle

    >>> round(minimum_pitch(Dragon()).pitch, 9)
    0.450337393
    >>> round(minimum_pitch(Dragon(), dragons=2).pitch, 6)
    0.896168
    """
    radius = checked_size("turning_radius", turning_radius)
    turns = checked_number("start_turns", start_turns, "turns", 0.0, START_TURNS_MAX, open_low=True)
    if radius > SIZE_MAX * turns:
        rule = "must be at least {least} to start outside the circle at a pitch of {pitch}"
        limits = quantities("turns", 6, least=radius / SIZE_MAX) | quantities("m", 6, pitch=SIZE_MAX)
        raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), **limits)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed, count = checked_stray(stray, dragon), checked_dragons(dragons, dragon)
    ways = Ways(dragon, radius, turns, margin, strayed, budget)
    straight = Straight(ways.search.dragon)
    if straight.gap <= margin:
        raise dragon_too_near(ways.search, straight.at, margin)
    try:
        alone = _result(dragon, PitchSearch(ways))
        if count == 1:
            return alone
        ways = Ways(dragon, radius, turns, margin, strayed, ways.search.budget, count)
        return _result_of_several(alone, PitchSearch(ways))
    except Halted as halted:
        raise ways.too_much() from halted


def checked_dragons(dragons: object, dragon: Dragon) -> int:
    """The number of equal dragons in one spiral. raises: InvalidValue"""
    if isinstance(dragons, bool) or not isinstance(dragons, (int, np.integer)):
        raise InvalidValue("dragons", "must be a whole number", got=Given(dragons))
    if not 1 <= dragons <= DRAGONS_MAX:
        raise InvalidValue("dragons", "must be from 1 to {most}", got=int(dragons), most=DRAGONS_MAX)
    if dragons > 1 and dragons * dragon.benches > BENCHES_MAX:
        rule = "must be fewer, of {benches} benches each: at most {most} benches in all"
        raise InvalidValue("dragons", rule, got=int(dragons), benches=dragon.benches, most=BENCHES_MAX)
    return int(dragons)


def _result(dragon: Dragon, search: PitchSearch) -> MinimumPitch:
    """The result of a search."""
    top, proven_up_to = search.top()
    infeasible, feasible, justified_by = search.lowest, search.lowest, JustifiedBy.BOUND
    if top > search.lowest:
        infeasible, feasible, justified_by = search.descend(top)
    is_limited = feasible > search.lowest
    limited_by, pair, head_radius = search.limit(infeasible) if is_limited else (LimitedBy.START, None, None)
    return MinimumPitch(
        pitch=feasible,
        pitch_bracket=(infeasible, feasible),
        limited_by=limited_by,
        benches=pair,
        bench=end_theta(dragon, Spiral(infeasible, search.start_turns))[1] if limited_by is LimitedBy.FOLD else None,
        head_radius=head_radius,
        other_feasible_intervals=search.islands(infeasible) if is_limited and not search.alone else (),
        justified_by=justified_by,
        proven_from=search.scanned_from or feasible,
        proven_up_to=proven_up_to,
        scan_step=search.scan_step,
        evaluations=search.ways.marched + search.bands.marches,
    )


# Several dragons. A pitch suits them if every dragon alone reaches the circle and no benches of two dragons touch. The
# pitches above that of a lone dragon are searched once more, as before, with the pairs of benches of two dragons.
# All dragons are equal and turned by multiples of one angle, with their heads at one radius. So the pairs of the first
# dragon with each other one stand for all. The separation of its bench i from bench j of another one is a function of
# the place of handle i and of j - i, the same for all i that are alike: the family lemma (core/kernels/repeats.py), and
# with it the proofs of ways and bands, hold for these pairs as for those of one dragon.
def _result_of_several(alone: MinimumPitch, search: PitchSearch) -> MinimumPitch:
    """The result of a search with the pairs of two dragons, down to the minimum pitch of a lone one."""
    above = PitchSearch(search.ways, alone.pitch)
    top, up_to = above.top()
    infeasible, feasible = above.descend(top)[:2] if top > alone.pitch else (alone.pitch, alone.pitch)
    ends = [end for end in (alone.proven_up_to, up_to) if end is not None]
    scans = [(above.scanned_from, above.scan_step), (alone.proven_from, alone.scan_step)]
    known = [(start, step) for start, step in scans if start is not None and step is not None and start > feasible]
    shared = replace(
        alone,
        justified_by=JustifiedBy.SCAN if known else JustifiedBy.BOUND,
        proven_from=max([start for start, _ in known], default=feasible),
        proven_up_to=min(ends, default=None),
        scan_step=max([step for _, step in known], default=None),
        evaluations=alone.evaluations + search.ways.marched + search.bands.marches,
    )
    if feasible <= alone.pitch:
        return shared
    (limited_by, pair, head_radius), dragons = above.limit(infeasible), None
    islands = _both(search.islands(infeasible), (*alone.other_feasible_intervals, (alone.pitch, feasible)))
    if pair is not None:
        k, bench = divmod(pair[1], search.search.scene.stride)
        pair, dragons = (pair[0], bench), (0, k)
    return replace(
        shared,
        pitch=feasible,
        pitch_bracket=(infeasible, feasible),
        limited_by=limited_by,
        benches=pair,
        bench=None,
        head_radius=head_radius,
        other_feasible_intervals=islands,
        dragons=dragons,
    )


def _both(one: Intervals, two: Intervals) -> Intervals:
    """The intervals that both lists share."""
    shared = [(max(a, c), min(b, d)) for a, b in one for c, d in two]
    return tuple(sorted((low, high) for low, high in shared if low < high))

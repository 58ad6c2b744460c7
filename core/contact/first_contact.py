"""First contact, the "time of impact" of two benches, with a certificate.

The method is conservative advancement, see core/kernels/marching.py; its proof is written above the loops there and in
bounds.py, gap_curvature.py, pairs.py, rings.py and repeats.py. In short: the head advances from L to R only if, for
every pair that can be near, one axis fixed in one of the two benches separates them by more than the margin over all of
[L, R]: the gap along that axis is known at both ends, and its second derivative is bounded in between. Benches further
out than a radius in closed form cannot touch. In a dragon with equal body benches, pair (i, j) repeats, in the same
place, the meeting of pair (m, m + j - i) when handle m was where handle i is now (m: the first of the equal benches).
So once every bench has passed the start of the one before it, only the pairs of the first m + 1 benches need a search.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from core import kernels
from core.checks import checked_number
from core.claims.claim import BenchBetween, ClaimKind, ContactClaim, DanceSummary
from core.contact.answer import OUTCOMES, Evidence, Feature, FirstContact, Graze, Outcome, features
from core.contact.between import holds_apart
from core.contact.encounter import first_encounter
from core.contact.search import MARGIN_MAX, ContactSearch, SearchInput
from core.contact.stretch import first_met
from core.dance import Clock, Dance, EndReason, RunEnd
from core.dragon import Stray, checked_stray
from core.kernels import Budget, Ended
from core.kernels.results import Marched
from core.paths.frame import WORLD
from core.performance import Performance
from core.questions import or_about, question_about
from core.values import Interval, Pair


@or_about(Performance, first_encounter)
@question_about("dance", (Dance, Performance), "the first contact was not decided")
def first_contact(
    dance: Dance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> FirstContact:
    """First time at which two benches that share no handle come within the margin, proven to miss no earlier one.

    Of a Performance it is first_encounter(): the first time at which benches of two dragons do.
    margin: required clearance [m]; contact means separation <= margin
    stray: largest distance of every hole from its place [m], see core/shapes/reach.py: the answer is then the first
        time at which two benches may come within the margin, because the grounds that they may cover do. Without a
        margin, two benches with one between them do not count if it is proven to hold them apart
    start, stop: interval of the search [s]; None for dance.default_start and for the end of the run
    returns: see FirstContact. Times are good to 1e-10 s at 1 m/s. The bracket [proven clear up to, overlapping at] is
        at most 1e-9 s wide. It is wider where arc lengths or times are less exact (beyond 1e5 m, below 1e-3 m/s, on
        pieces of about 1e-6 m); by a pause of the head within it; within about 5e-5 m of a graze along waypoints,
        behind bench 60, or if a second pair meets at once; and where benches that stray nearly graze (1e-7 s). Both
        ends hold in spite of rounding (core/kernels/rounding.py, pairs.py). The answer is undecided if rounding hides
        it: for benches whose clearance equals the margin to about 1e-12 m at the start or in a graze, or to 1e-10 m for
        a while. `overlapping` then names a pair that is certainly within the margin at the end of the bracket, if any
    raises: InvalidValue; OutsideRun for a stop after the end of the run; TooMuchWork
    source: the model of Yang et al., sections 2.4 and 2.5, whose times differ: see app/questions/paper.py

    >>> from core import Dragon, Spiral
    >>> contact = first_contact(Dance(Dragon(), Spiral()))
    >>> contact.outcome.value, round(contact.time, 6), contact.benches
    ('contact', 412.473838, (0, 8))
    """
    budget = budget or Budget()
    answer = contact_within(budget, dance, margin=margin, stray=stray, start=start, stop=stop)
    if answer.outcome is Outcome.UNDECIDED:
        budget.afford()  # it may be undecided because the work is spent
    return answer


def contact_within(
    budget: Budget,
    dance: Dance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
) -> FirstContact:
    """first_contact() as a part of a larger question; it is also undecided if the budget of that question is spent."""
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    none = type(stray) is float and stray == 0.0  # False and None are refused
    strayed = 0.0 if none else checked_stray(stray, dance.dragon)
    begin, until = dance.span(start, stop)
    timing = dance.clock.rounding(until)
    sought = SearchInput(dance.dragon, dance.path, margin, stray=strayed, timing=timing)
    answer = _searched(dance, ContactSearch(sought, budget=budget), (begin, until), stop)
    a, b = answer.benches or answer.overlapping or (0, 0)
    if strayed and not margin and b - a == 2 and holds_apart(dance, dance.clock.travel(until), strayed, budget):
        search = ContactSearch(replace(sought, between=2), budget=budget)
        answer = _searched(dance, search, (begin, until), stop)
    return answer


def _searched(dance: Dance, search: ContactSearch, span: Interval, stop: float | None) -> FirstContact:
    """The answer of a search. span: begin and end [s]; stop: the end that was wanted, None for that of the run"""
    march, certain = first_met(search, dance, span)
    if march.ended is Ended.STUCK:
        return _undecided(dance, search, march, certain, span)
    end = dance.end
    if stop is not None and march.ended is Ended.REACHED:
        end = RunEnd(EndReason.STOP, span[1], None, None)
    return _result(dance, search, march, end, span)


def _undecided(
    dance: Dance, search: ContactSearch, march: Marched, certain: Marched | None, span: Interval
) -> FirstContact:
    """The answer of a search that gave up. certain: overlap_beyond(); span: of the search [s]"""
    clock, (begin, until) = dance.clock, span
    proven, overlapping, overlap_time = max(clock.time(march.proven), begin), None, None
    if certain is not None and certain.touching is not None:
        until = overlap_time = clock.time(certain.touching)
        overlapping = certain.pair
    clear_until = proven if proven > begin else None
    claim = ContactClaim(
        ClaimKind.UNDECIDED, DanceSummary.of(dance), search.margin, search.stray, begin, clear_until,
        benches=overlapping, time=overlap_time, between=_between(search),
    )  # fmt: skip
    graze = _graze(march, clock, begin)
    evidence = Evidence(claim, march.steps, clear_until, march.gap_curvature, graze)
    return FirstContact(
        Outcome.UNDECIDED,
        time_bracket=(proven, until),
        overlapping=overlapping,
        certificate=evidence,
        margin=search.margin,
        stray=search.stray,
        dance=dance,
    )


def _graze(march: Marched, clock: Clock, begin: float) -> Graze | None:
    """The narrowest graze of a march that begins at a time [s]."""
    graze = march.graze
    return None if graze is None else Graze(max(clock.time(graze.moment), begin), graze.gap, graze.pair)


def _result(dance: Dance, search: ContactSearch, march: Marched, end: RunEnd, span: Interval) -> FirstContact:
    clock, outcome = dance.clock, OUTCOMES[march.ended]
    at_start = outcome is Outcome.CONTACT_AT_START
    proven = end.time if march.ended is Ended.REACHED else max(clock.time(march.proven), span[0])
    clear_until = proven if proven > span[0] and not at_start else None
    claim = _claim(dance, search, outcome, march, end, (span[0], proven))
    certificate = Evidence(claim, march.steps, clear_until, march.gap_curvature, _graze(march, clock, span[0]))
    answer = partial(
        FirstContact, outcome, certificate=certificate, margin=search.margin, stray=search.stray, dance=dance
    )
    if outcome is Outcome.CLEAR:
        return answer(end=end)
    assert march.touching is not None
    travel = march.touching if at_start else march.touching - march.half
    corner, edge, point, gap = _touching_features(search, travel, march.pair)
    return answer(
        time=span[0] if at_start else max(clock.time(travel), span[0]),
        time_bracket=None if at_start else (proven, clock.time(march.touching)),
        head=search.path.head(travel),
        benches=march.pair,
        corner=corner,
        edge=edge,
        point=point,
        gap=gap if at_start or search.stray else search.margin,
    )


def _claim(
    dance: Dance, search: ContactSearch, outcome: Outcome, march: Marched, end: RunEnd, span: Interval
) -> ContactClaim:
    """What a decided search claims. span: of the search, up to the time until which it is proven to be clear [s]"""
    begin, proven = span
    about = (DanceSummary.of(dance), search.margin, search.stray, begin)
    between = _between(search)
    if outcome is Outcome.CLEAR:
        return ContactClaim(ClaimKind.CLEAR, *about, proven, end=end.reason, between=between)
    if outcome is Outcome.CONTACT_AT_START:
        return ContactClaim(ClaimKind.CONTACT_AT_START, *about, benches=march.pair, time=begin, between=between)
    assert march.touching is not None
    kind, clear_until = (ClaimKind.CONTACT, proven) if proven > begin else (ClaimKind.CONTACT_AT_START, None)
    time = dance.clock.time(march.touching)
    return ContactClaim(kind, *about, clear_until, benches=march.pair, time=time, between=between)


def _between(search: ContactSearch) -> BenchBetween | None:
    return BenchBetween.HELD if search.between > 1 else None


def _touching_features(
    search: ContactSearch, travel: float, pair: Pair
) -> tuple[Feature | None, Feature | None, tuple[float, float], float]:
    """The corner and the edge that meet, the corner's place in the world frame [m], and the separation [m]."""
    search.place_leaders(travel, pair[1] + 1)
    met = kernels.bench_separation(*pair, search.own_sizes, search.placed)
    corner, edge, (x, y) = features(met, pair, search.placed[list(pair)], 2 * [(0.0, 0.0)])
    turned = search.path.head(travel).theta or 0.0
    cos, sin = math.cos(turned), math.sin(turned)
    point, frame = (float(x * cos - y * sin), float(x * sin + y * cos)), search.path.frame
    point = point if frame == WORLD else frame.point(*point)
    return corner and corner[1], edge and edge[1], point, float(met.separation)

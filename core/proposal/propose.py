"""Dances that fit into a square: propose, from the venue, the dragon and the gates to certified dances."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, TypedDict, Unpack

import numpy as np

from core.checks import checked_count, checked_list, checked_member, checked_number, checked_type
from core.contact.search import MARGIN_MAX
from core.dance import Dance, checked_head_speed
from core.dragon import Dragon, Stray, checked_stray
from core.errors import InvalidValue, TooMuchWork
from core.extremes.speed import checked_limit
from core.judgement import quick_check
from core.kernels import Budget, Halted
from core.language import Listed
from core.proposal.answer import Objective, Proposal, Proposals, Reason, ReasonKind
from core.proposal.figures import CLOSED, Figure
from core.proposal.free_ground import FreeGround
from core.proposal.gates import Gate, checked_gates, ways_through
from core.proposal.search import HEAD_SPEED, LAPS_MOST, Rated, Search, Wish, search_in
from core.questions import question_about
from core.sampling import bisect
from core.values import Floats, Progress, unheard
from core.venue import Venue

# Figures in the order in which they are tried: those that are soonest laid out first.
ORDER = (Figure.RING, Figure.SPIRAL, Figure.EIGHT, Figure.SERPENTINE, Figure.PARADE)
# Largest numbers of benches of a dragon, and of proposals [1].
BENCHES_MOST, COUNT_MOST = 2_000, 12
# Shortest and longest time that a dance may be limited to [s].
DURATIONS = (1.0, 86_400.0)
# Width to which the largest stray with which a dance passes its check is bisected, as a part of the one wished [1].
STRAY_WIDTH = 2.0**-10
# Default work of a question, about a minute [1].
PROPOSE_WORK = 3e8
# Accuracy of half the width of a way between gates [m], and work of one answer whether it is as wide as that [1].
WAY_WIDTH, WAY_WORK = 0.002, 1e5
# Part of the area of a square by which it is enlarged for the rounding of sums [1].
AREA_SPARE = 1e-9


class Wishes(TypedDict, total=False):
    """The figures to try; what a dance must keep, as for check(): stray, margin [m], speed_limit [m/s]; the best; how
    often around, how long [s] and how fast [m/s]: laps, duration_limit, head_speed."""

    figures: Sequence[str] | None
    stray: float | Stray
    margin: float
    speed_limit: float | None
    objective: str
    laps: int | None
    duration_limit: float | None
    head_speed: float


@question_about("venue", Venue, "no dance was found")
def propose(
    venue: Venue,
    dragon: Dragon,
    *,
    gates: Sequence[Gate] | None = None,
    count: int = 3,
    budget: Budget | None = None,
    on_proposal: Callable[[Proposal], None] = unheard,
    progress: Progress | None = None,
    **wishes: Unpack[Wishes],
) -> Proposals:
    """Dances of a dragon that fit into a square, the best one first, each certified by check().

    gates: on the border of the square, ways in, ways out or both; beyond each is a straight street, in which the dance
        begins or ends. Without gates the whole dragon stands in the square
    figures: those to try, all that are possible by default, see Figure; a parade needs two gates
    stray: free for people, 0.05 m by default; margin: 0 [m]; speed_limit: of every handle, none by default [m/s]
    objective: see Objective, "tolerance" by default; for `benches` the dragon's last bench is left out or repeated
    laps: times around a ring or an eight, once the whole dragon stands on it or has entered by its gate; no other
        figures are tried then. By default twice around a ring and once around an eight, with gates once
    duration_limit: longest time of a dance [s], none by default; rings and eights go around as often as it lasts
    head_speed: 1 m/s by default, or less where the speed limit asks for it
    count: of proposals
    on_proposal: called with every proposal as soon as it is certified, in the order of the search
    progress: called with the share of the figures that were tried, 0 to 1; a search for further dances of them, or for
        the reason that there is none, may follow
    returns: see Proposals; with a reason instead of a proposal where none of the dances that were tried passes
    raises: InvalidValue; TooMuchWork if no dance was found within the budget, by default PROPOSE_WORK

    >>> from core import Area
    >>> hall = Venue(Area("hall", (((0, 0), (24, 0), (24, 20), (0, 20), (0, 0)),)))
    >>> best = propose(hall, Dragon(12), figures=["ring"], count=1).proposals[0]
    >>> best.report.passed, best.tolerance > 0.05
    (True, True)
    """
    checked_type("dragon", dragon, Dragon)
    wish = _wish(dragon, wishes)
    doors = checked_gates(gates, venue)
    kinds = _figures(wishes.get("figures"), doors, closed=wish.laps is not None)
    count = checked_count("count", count, 1, COUNT_MOST)
    if dragon.benches > BENCHES_MOST:
        raise InvalidValue("dragon.benches", "must be at most {most}", got=dragon.benches, most=BENCHES_MOST)
    work = (budget or Budget()).within(PROPOSE_WORK)
    work.afford()
    search = search_in(venue, dragon, doors, wish, work)
    most = None if doors else _area_bound(search, dragon)
    if wish.objective is Objective.BENCHES:
        return _most_benches(search, venue, kinds, count, most, on_proposal, progress or unheard)
    if most is not None and search.needs.least_area > search.ground.area:
        lack = Reason(ReasonKind.AREA, 0, search.ground.area, search.needs.least_area)
        return Proposals((), 0, 0, lack, most)
    best, reason = _collected(search, kinds, count, on_proposal, progress or unheard), None
    if not best:
        best, reason = _otherwise(search, venue, kinds, count, on_proposal)
    return Proposals(best, search.spent.tried, search.spent.checked, reason, most)


def _wish(dragon: Dragon, wishes: Wishes) -> Wish:
    """The checked wishes. raises: InvalidValue"""
    unknown = [name for name in wishes if name not in Wishes.__annotations__]
    if unknown:
        raise TypeError(f"propose() got an unexpected keyword argument {unknown[0]!r}")
    stray = checked_stray(wishes.get("stray", 0.05), dragon)
    margin = checked_number("margin", wishes.get("margin", 0.0), "m", 0.0, MARGIN_MAX)
    speed = wishes.get("speed_limit")
    objective = checked_member("objective", wishes.get("objective", Objective.TOLERANCE), Objective)
    laps, limit = wishes.get("laps"), wishes.get("duration_limit")
    if laps is not None:
        laps = checked_count("laps", laps, 1, LAPS_MOST)
    if limit is not None:
        limit = checked_number("duration_limit", limit, "s", *DURATIONS)
    head_speed = checked_head_speed(wishes.get("head_speed", HEAD_SPEED))
    return Wish(stray, margin, None if speed is None else checked_limit(speed), objective, laps, limit, head_speed)


def _figures(figures: Sequence[str] | None, gates: Sequence[Gate], *, closed: bool) -> list[Figure]:
    """The figures to try, in ORDER. closed: only those that lead around. raises: InvalidValue"""
    leads = any(into is not out for into, out in ways_through(gates))
    if figures is None:
        possible = set(ORDER) - (set() if leads else {Figure.PARADE})
        return [figure for figure in ORDER if figure in (CLOSED if closed else possible)]
    chosen = [
        checked_member(f"figures.{k}", figure, Figure)
        for k, figure in enumerate(checked_list("figures", figures, "must be a list of figures"))
    ]
    if not chosen:
        raise InvalidValue("figures", "must name at least one figure")
    if Figure.PARADE in chosen and not leads:
        rule = "must have two gates for a parade, which leads from one to the other"
        raise InvalidValue("figures", rule, got=len(gates))
    if closed and not CLOSED.issuperset(chosen):
        raise InvalidValue("laps", "must be left out, or the figures only be {names}", names=Listed(sorted(CLOSED)))
    return [figure for figure in ORDER if figure in chosen]


def _collected(
    search: Search,
    figures: Sequence[Figure],
    count: int,
    on_proposal: Callable[[Proposal], None],
    progress: Progress,
) -> tuple[Proposal, ...]:
    """The best proposals, each figure once before any twice. raises: TooMuchWork if none was found in time"""
    proposals: list[Proposal] = []
    try:
        for proposal in search.proposals(figures, count, progress):
            proposals.append(proposal)
            on_proposal(proposal)
            if len(proposals) >= max(count, len(figures)):
                break
    except (Halted, TooMuchWork):
        if search.budget.stopped or not proposals:
            raise
    value = _VALUES[search.wish.objective]
    firsts = {proposal.figure: proposal for proposal in reversed(proposals)}.values()
    others = [proposal for proposal in proposals if all(proposal is not first for first in firsts)]
    ranked = [*sorted(firsts, key=value, reverse=True), *sorted(others, key=value, reverse=True)][:count]
    return tuple(sorted(ranked, key=value, reverse=True))


_VALUES: dict[Objective, Callable[[Proposal], Any]] = {
    Objective.TOLERANCE: lambda one: (one.tolerance, one.near.distance),
    Objective.BENCHES: lambda one: (one.dance.dragon.benches, one.tolerance),
    Objective.TURNS: lambda one: (one.turns, one.tolerance),
    Objective.DURATION: lambda one: (one.duration, one.tolerance),
}


def _otherwise(
    search: Search, venue: Venue, figures: Sequence[Figure], count: int, on_proposal: Callable[[Proposal], None]
) -> tuple[tuple[Proposal, ...], Reason | None]:
    """Proposals of a second search, or why no dance was found, by the first cause that holds."""
    narrow = _too_narrow(search, venue, figures)
    if narrow is not None:
        return (), narrow
    if search.failed.too_long and (shortest := search.shortest()) is not None:
        return (), Reason(ReasonKind.DURATION, search.spent.tried, search.wish.duration_limit, *shortest)
    search = search.close_look() or search
    if search.closely and (best := _collected(search, figures, count, on_proposal, unheard)):
        return best, None
    if search.wish.stray > 0.0:
        best, reason = _without_stray(search, venue, figures)
        for proposal in best:
            on_proposal(proposal)
        if best or reason is not None:
            return best, reason
    shorter = _fewer_benches(search, venue, figures)
    if shorter is not None:
        return (), shorter
    best, reason = _failing(search, venue, figures)
    for proposal in best:
        on_proposal(proposal)
    if reason is not None and search.gates and Figure.PARADE not in figures:
        # A street has room beyond its gate that the square itself has not.
        reason = _no_turn(search, _circle(search, venue)) or reason
    return best, reason


def _too_narrow(search: Search, venue: Venue, figures: Sequence[Figure]) -> Reason | None:
    """The reason that every way between two gates, or the whole square, is too narrow."""
    needs, tried = search.needs, search.spent.tried
    if Figure.PARADE in figures:
        ways = {(min(k, j), max(k, j)) for k, j in _numbers(search.gates)}
        widths = [(_widest_way(search, search.gates[a], search.gates[b]), (a, b)) for a, b in sorted(ways)]
        widest, pair = max(widths)
        narrow = widest < needs.least_width
        return Reason(ReasonKind.WAY, tried, widest, needs.least_width, who=pair) if narrow else None
    if 2.0 * search.ground.widest_circle[3] < needs.turning_width:
        return _no_turn(search, _circle(search, venue))
    return None


def _numbers(gates: Sequence[Gate]) -> list[tuple[int, int]]:
    """Numbers of the gates by which a dance may enter and leave."""
    return [(gates.index(into), gates.index(out)) for into, out in ways_through(gates)]


def _circle(search: Search, venue: Venue) -> float:
    """A proven upper bound of the diameter of the widest free circle in a square without the streets beyond its gates
    [m]."""
    ground = FreeGround(venue) if search.gates else search.ground
    return 2.0 * ground.widest_circle[3]


def _no_turn(search: Search, widest: float) -> Reason | None:
    """The reason that no free circle is as wide as a turn takes; None if one may be. widest: a bound of it [m]"""
    needs = search.needs
    if widest >= needs.turning_width:
        return None
    bench = int(np.argmax(needs.dragon.chords[: needs.dragon.uniform_from + 1]))
    return Reason(ReasonKind.WIDTH, search.spent.tried, widest, needs.turning_width, who=(bench,))


def _widest_way(search: Search, begin: Gate, end: Gate) -> float:
    """A proven upper bound of the width of the free ground between two gates where it is narrowest, on its widest way
    [m]; the width that benches need if it is not proven to be less."""
    need = 0.5 * search.needs.least_width

    def opening(gate: Gate) -> Floats:
        across = 0.5 * search.street_width * np.array([-gate.ahead[1], gate.ahead[0]])
        return np.array([gate.point - across, gate.point + across])

    def parted(room: float) -> bool:
        search.budget.afford(WAY_WORK)
        return search.ground.is_parted(opening(begin), opening(end), room)

    return 2.0 * (bisect(parted, 0.0, need, width=WAY_WIDTH)[1] if parted(need) else need)


def _without_stray(
    search: Search, venue: Venue, figures: Sequence[Figure]
) -> tuple[tuple[Proposal, ...], Reason | None]:
    """Dances designed as if nobody strayed: those that allow the stray all the same, or the largest stray of any.

    These dances do not depend on the stray, so a search with a smaller one than the largest finds that dance again.
    """
    wish, most = search.wish, (0.0, figures[0])
    steady = replace(wish, stray=0.0, objective=Objective.TOLERANCE)
    second = search.of(venue, search.dragon, steady)
    best = []
    for figure in figures:
        passing = second.first(second.ranked(figure))
        if passing is None:
            continue
        one, dance, _ = passing
        stray = _allowed(second, dance, wish.stray)
        most = max(most, (stray, figure), key=lambda each: each[0])
        if stray == wish.stray:
            proposal = replace(second, wish=wish).certified(one, dance)
            best += [] if proposal is None else [proposal]
    if search.failed.nearest is None and second.failed.nearest is not None:
        search.failed.note(*second.failed.nearest)
    if best or not 0.0 < most[0] < wish.stray:
        return tuple(sorted(best, key=_VALUES[wish.objective], reverse=True)), None
    return (), Reason(ReasonKind.STRAY, search.spent.tried, most[0], wish.stray, most[1])


def _allowed(search: Search, dance: Dance, stray: float) -> float:
    """The largest stray up to a given one with which a dance was found to pass its check [m]."""

    def passes(stray: float) -> bool:
        limits = {**search.wish.limits, "stray": stray}
        return quick_check(dance, venue=search.venue, start=0.0, budget=search.budget, **limits).passed

    if passes(stray):
        return stray
    return bisect(lambda tried: not passes(tried), 0.0, stray, width=stray * STRAY_WIDTH)[0]


def _fewer_benches(search: Search, venue: Venue, figures: Sequence[Figure]) -> Reason | None:
    """The reason that only a shorter dragon fits, with the most benches that were found to."""
    benches = search.dragon.benches
    longest = _longest(venue, search, figures, (benches // 2, benches - 1))
    if longest is None:
        return None
    fitting, (one, *_) = longest
    most = float(fitting.dragon.benches)
    return Reason(ReasonKind.BENCHES, search.spent.tried, most, float(benches), one.design.figure)


def _longest(
    venue: Venue, like: Search, figures: Sequence[Figure], span: tuple[int, int]
) -> tuple[Search, tuple[Rated, Dance, int]] | None:
    """The search for the longest dragon that was found to fit, by doubling and by bisection, with a dance that passes.

    like: a search for the same dragon and gates
    span: number of benches to begin with, and the largest one
    returns: None if not even one bench fits
    """
    count, limit = span
    low, high, best = 0, limit + 1, None
    while high - low > 1:
        count = min(max(count, low + 1), high - 1)
        passing = None
        try:
            search = like.of(venue, with_benches(like.dragon, count), like.wish)
        except InvalidValue:  # a street of its own is too short for as many
            pass
        else:
            every = (search.first(search.ranked(figure), briefly=True) for figure in figures)
            passing = next((one for one in every if one is not None), None)
        if passing is None:
            high = count
        else:
            low, best = count, (search, passing)
        count = 2 * count if high > limit else (low + high) // 2
    return best


def _failing(search: Search, venue: Venue, figures: Sequence[Figure]) -> tuple[tuple[Proposal, ...], Reason | None]:
    """The first failure of the dance that came nearest, of one bench if none of the whole dragon was worth a check; or
    this dance, if it passes."""
    benches, last = search.dragon.benches, search
    if search.failed.nearest is None:
        last = search.of(venue, with_benches(search.dragon, 1), search.wish)
        passing = last.check_nearest(figures)
        if passing is not None:
            last, one, dance = passing
            if benches > 1:
                return (), Reason(ReasonKind.BENCHES, search.spent.tried, 1.0, float(benches), one.design.figure)
            if (proposal := last.certified(one, dance)) is not None:
                return (proposal,), None
    most = float(last.dragon.benches)
    if last.failed.nearest is None:
        return (), Reason(ReasonKind.FAILS, search.spent.tried, most, float(benches))
    one, report = last.failed.nearest
    figure, failure = one.design.figure, report.failures[0]
    return (), Reason(ReasonKind.FAILS, search.spent.tried, most, float(benches), figure, failure=failure)


def with_benches(dragon: Dragon, count: int) -> Dragon:
    """The dragon with this number of benches: the last ones left out, or the last one repeated."""
    if count <= dragon.benches:
        return dragon.leading(count).named(())
    more = count - dragon.benches
    columns = (dragon.lengths, dragon.widths, dragon.overhangs)
    return Dragon.of(*(np.concatenate([column, np.full(more, column[-1])]) for column in columns))


def _area_bound(search: Search, dragon: Dragon) -> int:
    """Number of benches that no dragon of this kind in the square exceeds: the areas of every other one, which cannot
    overlap, are together not larger than the square."""
    room, sizes = search.ground.area * (1.0 + AREA_SPARE), dragon.lengths * dragon.widths
    parity = np.arange(dragon.benches) % 2
    covered = [np.where(parity == k, sizes, 0.0).cumsum() for k in (0, 1)]
    fitting = int((np.maximum(*covered) <= room).sum())
    if fitting < dragon.benches:
        return fitting
    # Further benches are like the last one; of each parity, the first of them for which there is no room.
    last, count = float(sizes[-1]), dragon.benches
    return min(count + (count + k) % 2 + 2 * int((room - float(covered[k][-1])) / last) for k in (0, 1))


def _most_benches(
    search: Search,
    venue: Venue,
    figures: Sequence[Figure],
    count: int,
    most: int | None,
    on_proposal: Callable[[Proposal], None],
    progress: Progress,
) -> Proposals:
    """Proposals with as many benches as were found to fit, one of each figure."""
    limit = BENCHES_MOST if most is None else min(BENCHES_MOST, max(most, 1))
    every = []
    for k, figure in enumerate(figures, start=1):
        longest = _longest(venue, search, [figure], (min(search.dragon.benches, limit), limit))
        if longest is not None and (one := longest[0].certified(*longest[1][:2])) is not None:
            every.append(one)
            on_proposal(one)
        progress(k / len(figures))
    best, reason = tuple(sorted(every, key=_VALUES[Objective.BENCHES], reverse=True)[:count]), None
    if not best:
        best, reason = _otherwise(search, venue, figures, count, on_proposal)
    return Proposals(best, search.spent.tried, search.spent.checked, reason, most)

"""A stretch of a path: the pairs of a search between two travels of the head, and their least gap."""

from __future__ import annotations

from dataclasses import dataclass

from core.contact.brackets import TOUCHES
from core.contact.fold import approach_fold, least_to_fold
from core.contact.gaps import PROFILE_STEP, least_over, moments_of, sample_count
from core.contact.near_graze import narrow_bracket
from core.contact.search import ContactSearch
from core.dance import Dance
from core.kernels import EDGES_PER_WORK, NO_BRACKET, Ended
from core.kernels.results import Dip, Marched
from core.values import Interval, Pair

# Width to which a dip is refined [m of head travel], in a profile [s].
GRAZE_WIDTH = 1e-11
# Distances beyond the place where a search gave up at which it looks for a certain contact [m of head travel].
BEYOND = (1e-3, 1e-1)


@dataclass(frozen=True, slots=True)
class Stretch:
    """The gaps of core/contact/gaps.py between two travels of the head [m].

    head_speed: the lowest on it [m/s]; width: to which a dip is refined [m]
    fold: theta of the head at a fold right after the end [rad]; None without one
    """

    search: ContactSearch
    span: Interval
    head_speed: float
    fold: float | None = None
    width: float = GRAZE_WIDTH

    @property
    def spacing(self) -> float:
        return PROFILE_STEP * self.search.rings.all_shortest

    @property
    def count(self) -> int:
        search, (begin, until) = self.search, self.span
        work_each = search.room * (1.0 + len(search.edges) / EDGES_PER_WORK)
        return sample_count((until - begin) / self.spacing, min(search.work, search.budget.left), work_each)

    def look(self, travel: float, _: Pair = (0, 0)) -> Dip:
        """The least gap of all pairs after a travel."""
        self.search.budget.afford(self.search.room)
        gap, pair = self.search.clearance(travel)
        return Dip(gap, travel, pair)

    def sample(self, travel: float, _: Pair = (0, 0)) -> Dip:
        """The least gap of the pairs that a march follows."""
        search = self.search
        search.budget.afford(search.room)
        gap, pair = search.clearance(travel, search.leaders)
        return Dip(gap, travel, pair)

    def gap_rate(self, travel: float, pair: Pair) -> float:
        return self.search.gap_rate(travel, pair)

    def bottom(self, low: float, high: float, pair: Pair) -> float:
        return self.search.bottom(low, high, pair, self.width)


def least_on(stretch: Stretch) -> tuple[Dip, float | None]:
    """The least gap on a stretch, and its proven lower bound [m].

    A gap of 0 stands for the first touch. The call changes the search's margin. Before a fold steps shrink to nothing,
    because speeds grow without bound, so a bound on the remaining motion replaces the last ones: least_to_fold()
    """
    search, (_, until), fold = stretch.search, stretch.span, stretch.fold

    def march(margin: float, begin: float) -> tuple[Stretch, Marched, float | None]:
        search.use(search.path, margin)
        result = search.march(until, NO_BRACKET, start=begin, dips=True)
        search.budget.afford()
        left = margin if result.ended is Ended.REACHED else None
        if fold is not None and result.ended in (Ended.REACHED, Ended.STUCK):
            left = least_to_fold(search, min(result.proven, until), fold)
        return stretch, result, left

    def first_touch(begin: float, touching: Dip) -> tuple[Dip, float | None]:
        """The first touch, before which nothing touches; if that is not decided, a certain or else a computed touch."""
        search.use(search.path, 0.0)
        result = search.approach(begin, until, stretch.head_speed)
        if result.ended not in TOUCHES or result.touching is None:
            beyond = Stretch(search, (result.proven, until), stretch.head_speed)
            certain = overlap_beyond(beyond) if result.ended is Ended.STUCK else None
            if certain is not None and certain.touching is not None:
                touching = Dip(0.0, certain.touching, certain.pair)
            return touching._replace(gap=0.0), None
        travel = result.touching - (result.half if result.ended is Ended.TOUCHED else 0.0)
        return Dip(0.0, travel, result.pair), 0.0

    return least_over(stretch, march, first_touch)


def first_met(search: ContactSearch, dance: Dance, span: Interval) -> tuple[Marched, Marched | None]:
    """The first contact of a search between two times [s], also before a fold, in the narrowest bracket; and what
    overlap_beyond() finds where the search gives up."""
    clock, end = dance.clock, dance.end
    first, last = clock.travel(span[0]), clock.travel(span[1])
    to_fold = dance.nears_fold(span[1])
    stops = search.fold_stops(first, last, end) if to_fold else [(last, 0.0)]
    march = search.approach(first, stops[0][0], clock.slowest)
    if to_fold and march.ended not in TOUCHES:
        march = approach_fold(search, first, stops, clock.slowest, end, march)
    narrow = search.narrow_half(march, clock.slowest)
    if narrow is not None:
        march = narrow_bracket(search, march, narrow, None if dance.passages else clock.slowest) or march
    if march.ended is not Ended.STUCK:
        return march, None
    return march, overlap_beyond(Stretch(search, (march.proven, stops[-1][0]), clock.slowest))


# A search gives up where rounding hides whether two benches touch. A little further on they may be apart again, or
# certainly overlap, so a march from there may meet a certain contact. Where they stay at the margin for long, samples
# look for one.
def overlap_beyond(stretch: Stretch) -> Marched | None:
    """A certain contact on a stretch at whose beginning a search gave up, perhaps not the first; None if none is
    known."""
    search, (proven, until) = stretch.search, stretch.span
    for beyond in BEYOND:
        result = search.approach(min(proven + beyond, until), until, stretch.head_speed)
        if result.ended in TOUCHES and result.touching is not None:
            return result
        if result.ended is Ended.REACHED:
            return None
    for travel in moments_of(stretch):
        if min(search.work, search.budget.left) <= search.room:
            return None
        search.spend(float(search.room))
        gap, pair = search.clearance(travel)
        if gap <= search.margin and search.surely_within(travel, pair):
            return Marched(Ended.TOUCHED, proven, travel, pair)
    return None

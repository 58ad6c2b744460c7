"""Clearance at given times with its local minima, and the least over an interval: sampled, then proven by a march."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core import plots
from core.contact.fold import least_to_fold
from core.contact.march import TOUCHES
from core.contact.search import NEAR_WORK_BUDGET, ContactSearch, before_fold
from core.dance import Clock, Dance
from core.display import Readable, display, format_count
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue, question_about
from core.kernels import NO_BRACKET, Budget, Ended
from core.kernels.results import Dip, Marched
from core.motion.trajectory import instants
from core.sampling import dips
from core.tables import Column, Table, data_set
from core.values import Floats

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

# Step of the samples of a clearance, as a part of the shortest chord [1], longer if that is too much work
# (ContactSearch.samples()); and width to which a dip is refined [m of head travel], in a profile [s].
PROFILE_STEP = 0.2
GRAZE_WIDTH = 1e-11
# Width to which the least distance is proven [m]; the second one is used if the first needs too many steps.
PROOF_WIDTHS = (1e-5, 1e-3)
# Distances beyond the place where a search gave up at which it looks for a certain contact [m of head travel].
BEYOND = (1e-3, 1e-1)
# Number of lowest samples to refine before the proof begins.
DIPS_REFINED = 5
# Most smaller distances that a proof may find; each one is smaller by PROOF_WIDTHS[0] or more.
ROUNDS = 100

Pair = tuple[int, int]


@dataclass(frozen=True, slots=True, repr=False)
class Graze(Readable):
    """A local minimum of the clearance over time.

    time: time of the minimum [s]
    clearance: clearance at that time [m]
    benches: the pair
    """

    time: float
    clearance: float
    benches: tuple[int, int]


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class ClearanceProfile(Table):
    """Columns, (T,) for a list of instants and empty for one, and the local minima between them.

    time: instants [s]
    clearance: smallest separation of two benches that are not neighbours [m]
    benches: the pair with that separation, (T, 2)
    grazes: local minima between the first and the last instant, refined
    """

    time: Floats
    clearance: Floats
    benches: NDArray[np.int64]
    grazes: tuple[Graze, ...]

    def _line(self) -> str:
        if not self.time.size:
            return "no instants"
        least = int(self.clearance.argmin())
        a, b = self.benches.reshape(-1, 2)[least]
        nearest = f"{display(self.clearance.item(least), 'm')} between benches {a} and {b}"
        grazes = format_count(len(self.grazes), "graze")
        return f"{instants(self.time)}; least {nearest} at {display(self.time.item(least), 's')}; {grazes}"

    def columns(self) -> dict[str, Column]:
        """One row for each time: time [s], clearance [m], bench_a, bench_b."""
        a, b = self.benches.reshape(-1, 2).T
        return {"time": self.time.ravel(), "clearance": self.clearance.ravel(), "bench_a": a, "bench_b": b}

    def to_xarray(self) -> xarray.Dataset:
        """clearance (time) [m] and benches (time, pair), without the axis `time` for a single time.

        raises: ImportError without xarray, naming the extra
        """
        axis = ("time",) * self.time.ndim
        variables = {"clearance": (axis, self.clearance), "benches": ((*axis, "pair"), self.benches)}
        coordinates = {"time": (axis, self.time), "pair": ["a", "b"]}
        return data_set("ClearanceProfile.to_xarray()", variables, coordinates, self.units())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Plot the clearance against time, with its local minima as dots.

        returns: the given axes, or those of a new figure, in seconds and metres
        raises: ImportError without matplotlib, naming the extra
        """
        axes = plots.wanted_axes(ax, "ClearanceProfile.plot()")
        grazes = [(graze.time, graze.clearance) for graze in self.grazes]
        plots.draw_clearance(axes, self.time.ravel(), self.clearance.ravel(), grazes)
        return axes


@dataclass(frozen=True, slots=True, repr=False)
class LeastClearance(Readable):
    """The least clearance over the dance.

    distance: smallest distance found; 0 at the first touch, or at a later one if it is undecided which is the first; if
        benches overlap at the start, minus the depth [m]
    at_least: proven lower bound; None: the search gave up before proving one, or the distance is below zero [m]
    time: time of the smallest distance [s]
    benches: the pair at that distance

    After a first touch nothing is said. The lower bound is PROOF_WIDTHS[0] below the distance or, if that needs too
    many steps, PROOF_WIDTHS[1]; there is none if the first touch is not decided.
    """

    distance: float
    at_least: float | None
    time: float
    benches: Pair


@question_about("dance", Dance, "the clearance over time was not found")
def clearance_profile(dance: Dance, times: ArrayLike, *, budget: Budget | None = None) -> ClearanceProfile:
    """Exact clearance and its pair at every time, and its local minima refined.

    times: (T,) or one [s]
    grazes: searched between the first and the last time in steps of PROFILE_STEP of the shortest chord (longer ones for
        thousands of benches on a long way), then refined to rounding. The dip of a pair that is nearest for less than a
        step may be missed here, but never by first_contact()
    raises: OutsideRun after the end of the run; InvalidValue for fewer than three benches; TooMuchWork
    """
    dragon, clock = dance.dragon, dance.clock
    if dragon.benches < 3:
        raise InvalidValue("dragon.benches", "must be at least 3, so that two share no handle", got=dragon.benches)
    time = dance.times(times)
    search = ContactSearch(dragon, dance.path, 0.0, budget=budget)
    search.resize(dragon.benches)
    clearance, benches = _at(search, time, clock)
    return ClearanceProfile(time, clearance, benches, _grazes(search, time, clock))


def _at(search: ContactSearch, time: Floats, clock: Clock) -> tuple[Floats, NDArray[np.int64]]:
    clearance, benches = np.empty(time.size), np.empty((time.size, 2), dtype=np.int64)
    for k, instant in enumerate(time.flat):
        clearance[k], benches[k] = _affordable(search, clock.travel(float(instant)))
    return clearance.reshape(time.shape), benches.reshape(*time.shape, 2)


def _grid(search: ContactSearch, begin: float, until: float) -> list[float]:
    """Travels between two at which clearances are sampled [m]."""
    count = search.samples(until - begin, PROFILE_STEP * search.rings.all_shortest)
    grid: list[float] = np.linspace(begin, until, count).tolist()
    return grid


def _affordable(search: ContactSearch, travel: float, leaders: int | None = None) -> tuple[float, Pair]:
    """ContactSearch.clearance(), whose work counts in the budget of the whole question."""
    search.budget.afford(search.room)
    return search.clearance(travel, leaders)


# Where the nearest pair changes, the clearance has a kink that points up. So each local minimum is one of a single
# pair: the nearest pair at one end of a step, if it approaches at the beginning of the step and parts at its end.
def _grazes(search: ContactSearch, time: Floats, clock: Clock) -> tuple[Graze, ...]:
    if time.size < 2:
        return ()
    first, last = clock.travel(float(time.min())), clock.travel(float(time.max()))
    grid = _grid(search, first, last)
    pairs = [_affordable(search, travel)[1] for travel in grid]
    grazes = []
    for ends, nearest in zip(pairwise(grid), pairwise(pairs), strict=True):
        for pair in sorted(set(nearest)):
            if not search.gap_rate(ends[0], pair) < 0.0 < search.gap_rate(ends[1], pair):
                continue
            travel = search.bottom(*ends, pair, GRAZE_WIDTH * clock.slowest)
            gap, there = search.clearance(travel)
            if there == pair:
                grazes.append(Graze(max(clock.time(travel), float(time.min())), gap, pair))
    return tuple(sorted(grazes, key=lambda graze: graze.time))


@question_about("dance", Dance, "the least clearance was not found")
def least_clearance(
    dance: Dance,
    *,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> LeastClearance | None:
    """The least clearance between start and stop [s], see Dance.span(); None with fewer than three benches.

    stray: largest distance of every hole from its place [m]: the result is then the least possible clearance, proven
        for the hulls of the ground that benches may cover (core/shapes/reach.py)
    raises: InvalidValue; OutsideRun for a stop after the end of the run; TooMuchWork
    """
    begin, until = dance.span(start, stop)
    clock, end = dance.clock, dance.end
    if dance.dragon.benches < 3:
        return None
    to_fold = dance.nears_fold(until)
    strayed = checked_stray(stray, dance.dragon)
    search = ContactSearch(dance.dragon, dance.path, 0.0, work=NEAR_WORK_BUDGET, budget=budget, stray=strayed)
    last = before_fold(clock.travel(until)) if to_fold else clock.travel(until)
    fold = end.theta if to_fold else None
    (distance, travel, pair), at_least = least_over(search, clock.travel(begin), last, clock.slowest, fold)
    if distance == 0.0:
        gap, overlapping = search.clearance(clock.travel(begin))
        if gap < 0.0:
            return LeastClearance(gap, None, begin, overlapping)
    return LeastClearance(distance, at_least, max(clock.time(travel), begin), pair)


# The least gap of the samples is an upper bound of the least gap of all. The margin of the march is this gap less a
# width. Either the march reaches the end, which proves that nothing comes nearer than the margin, or it meets a smaller
# gap. Then this gap is refined, and the march goes on from there with a smaller margin; the way that it has passed is
# clear by the larger margin, and so by the smaller one too. Where the bottom of a dip is between the margin and the
# gap, steps are far shorter than the dip is wide, so the march refines it.
def least_over(
    search: ContactSearch, begin: float, until: float, head_speed: float, fold: float | None = None
) -> tuple[Dip, float | None]:
    """The least gap of the search's pairs between two travels of the head, and its proven lower bound [m].

    A gap of 0 stands for the first touch. The call changes the search's margin.
    fold: theta of the head at a fold right after `until` [rad]. Steps shrink to nothing before it, because speeds grow
        without bound, so a bound on the remaining motion replaces the last ones: least_to_fold()
    """
    best = sampled_least(search, samples_between(search, begin, until))
    proven_to, proven = begin, None
    for width in PROOF_WIDTHS:
        for _ in range(ROUNDS):
            if best.gap <= 0.0:
                return _first_touch(search, proven_to, until, head_speed, best)
            search.use(search.path, max(best.gap - width, 0.0))
            margin = search.margin
            state, result = search.march(until, NO_BRACKET, start=proven_to, dips=True)
            search.budget.afford()
            if result.graze is not None and result.graze.gap < best.gap:
                best = result.graze
            if state in (Ended.REACHED, Ended.STUCK):
                left = margin if state is Ended.REACHED else None
                if fold is not None:
                    left = least_to_fold(search, min(result.proven, until), fold)
                if left is not None and left >= margin:
                    return best, margin
                proven = max(proven or 0.0, left or 0.0) or None
                break
            proven_to = max(proven_to, result.proven)
            reach = PROFILE_STEP * search.rings.all_shortest
            touching = result.touching
            assert touching is not None
            best = min(best, refined_dip(search, max(begin, touching - reach), touching, min(until, touching + reach)))
    return best, proven


# A search gives up where rounding hides whether two benches touch. A little further on they may be apart again, or
# certainly overlap, so a march from there may meet a certain contact. Where they stay at the margin for long, samples
# look for one.
def overlap_beyond(search: ContactSearch, proven: float, until: float, head_speed: float) -> Marched | None:
    """A certain contact after a travel at which a search gave up [m], perhaps not the first; None if none is known."""
    for beyond in BEYOND:
        state, result, _ = search.approach(min(proven + beyond, until), until, head_speed)
        if state in TOUCHES and result.touching is not None:
            return result
        if state is Ended.REACHED:
            return None
    for travel in _grid(search, proven, until):
        if min(search.work, search.budget.left) <= search.room:
            return None
        search.spend(float(search.room))
        gap, pair = search.clearance(travel)
        if gap <= search.margin and search.surely_within(travel, pair):
            return Marched(proven, travel, pair)
    return None


def _first_touch(
    search: ContactSearch, begin: float, until: float, head_speed: float, touching: Dip
) -> tuple[Dip, float | None]:
    """The first touch, before which nothing touches; if that is not decided, a certain or else a computed touch."""
    search.use(search.path, 0.0)
    state, result, half_bracket = search.approach(begin, until, head_speed)
    if state not in TOUCHES or result.touching is None:
        certain = overlap_beyond(search, result.proven, until, head_speed) if state is Ended.STUCK else None
        if certain is not None and certain.touching is not None:
            touching = Dip(0.0, certain.touching, certain.benches)
        return touching._replace(gap=0.0), None
    travel = result.touching - (half_bracket if state is Ended.TOUCHED else 0.0)
    return Dip(0.0, travel, result.benches), 0.0


class ClearanceSamples(NamedTuple):
    """Clearances at some travels [m]."""

    travels: list[float]
    gaps: Floats


def samples_between(search: ContactSearch, begin: float, until: float) -> ClearanceSamples:
    """The clearance in even steps between two travels."""
    grid = _grid(search, begin, until)
    return ClearanceSamples(grid, np.array([_sampled(search, travel) for travel in grid]))


def samples_where(search: ContactSearch, known: ClearanceSamples, within: float) -> ClearanceSamples:
    """The samples, computed again by this search where the known gap is at most `within` [m]."""
    again = [_sampled(search, travel) if gap <= within else gap for travel, gap in zip(*known, strict=True)]
    return ClearanceSamples(known.travels, np.array(again))


def _sampled(search: ContactSearch, travel: float) -> float:
    return _affordable(search, travel, min(search.dragon.uniform_from + 1, search.dragon.benches))[0]


def sampled_least(search: ContactSearch, samples: ClearanceSamples) -> Dip:
    """The least clearance at the ends and in the dips of the samples."""
    grid = samples.travels
    ends = [Dip(gap, travel, pair) for travel in (grid[0], grid[-1]) for gap, pair in (search.clearance(travel),)]
    return min(ends + [refined_dip(search, *grid[k - 1 : k + 2]) for k in dips(samples.gaps, DIPS_REFINED).tolist()])


def refined_dip(search: ContactSearch, low: float, middle: float, high: float) -> Dip:
    """The bottom of the dip around the middle travel; searched again if another pair is nearer there."""
    gap, pair = search.clearance(middle)
    best = Dip(gap, middle, pair)
    for _ in range(2):
        travel = search.bottom(low, high, best.benches, GRAZE_WIDTH)
        gap, pair = search.clearance(travel)
        best = min(best, Dip(gap, travel, pair))
    return best

"""Clearance at given times with its local minima, and the least over an interval: sampled, then proven by a march."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core import plots
from core.contact.answer import Graze
from core.contact.gaps import grazes, moments_of
from core.contact.search import NEAR_WORK_BUDGET, ContactSearch, SearchInput, before_fold
from core.contact.stage_clearance import clearance_between, least_clearance_between
from core.contact.stretch import GRAZE_WIDTH, Stretch, least_on
from core.dance import Dance
from core.display import Readable, display
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue
from core.kernels import Budget
from core.language import counted, say
from core.motion.trajectory import instants
from core.performance import Performance
from core.questions import or_about, question_about
from core.tables import Column, Table
from core.values import Floats, Pair

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class ClearanceProfile(Table):
    """Columns, (T,) for a list of instants and empty for one, and the local minima between them.

    time: instants [s]
    clearance: smallest separation of two benches that are not neighbours [m]
    benches: the pair with that separation, (T, 2)
    grazes: local minima between the first and the last instant, refined

    >>> from core import Dragon, Spiral
    >>> profile = clearance_profile(Dance(Dragon(), Spiral()), [300.0, 400.0])
    >>> profile.clearance.round(4).tolist(), profile.benches.tolist()
    ([0.1207, 0.0255], [[0, 21], [0, 10]])
    """

    time: Floats
    clearance: Floats
    benches: NDArray[np.int64]
    grazes: tuple[Graze, ...]

    def _line(self) -> str:
        if not self.time.size:
            return say("no instants")
        least = int(self.clearance.argmin())
        a, b = self.benches.reshape(-1, 2)[least]
        return say(
            "{instants}; least {gap} between benches {a} and {b} at {time}; {grazes}",
            instants=instants(self.time), gap=display(self.clearance.item(least), "m"), a=a, b=b,
            time=display(self.time.item(least), "s"),
            grazes=counted(len(self.grazes), "{count} graze", "{count} grazes"),
        )  # fmt: skip

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
        return self._data_set(variables, coordinates)

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

    >>> from core import Dragon, Spiral
    >>> least = least_clearance(Dance(Dragon(), Spiral()), stop=400.0)
    >>> round(least.distance, 4), least.benches
    (0.0209, (0, 10))
    """

    distance: float
    at_least: float | None
    time: float
    benches: Pair


@or_about(Performance, clearance_between)
@question_about("dance", (Dance, Performance), "the clearance over time was not found")
def clearance_profile(dance: Dance, times: ArrayLike, *, budget: Budget | None = None) -> ClearanceProfile:
    """Exact clearance and its pair at every time, and its local minima refined; of a Performance a
    PerformanceClearance between its dragons.

    times: (T,) or one [s]
    grazes: searched between the first and the last time in steps of PROFILE_STEP of the shortest chord (longer ones for
        thousands of benches on a long way), then refined to rounding. The dip of a pair that is nearest for less than a
        step may be missed here, but never by first_contact()
    raises: OutsideRun after the end of the run; InvalidValue for fewer than three benches; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> clearance_profile(Dance(Dragon(), Spiral()), [300.0, 400.0]).clearance.round(4).tolist()
    [0.1207, 0.0255]
    """
    dragon, clock = dance.dragon, dance.clock
    if dragon.benches < 3:
        raise InvalidValue("dragon.benches", "must be at least 3, so that two share no handle", got=dragon.benches)
    time = dance.times(times)
    search = ContactSearch(SearchInput(dragon, dance.path, 0.0, whole=True), budget=budget)
    times_of = time if time.size else np.zeros(1)
    first, last = float(times_of.min()), float(times_of.max())
    span = clock.travel(first), clock.travel(last)
    stretch = Stretch(search, span, clock.slowest, width=GRAZE_WIDTH * clock.slowest)
    looks = [stretch.look(clock.travel(instant)) for instant in time.ravel().tolist()]
    clearance = np.array([look.gap for look in looks]).reshape(time.shape)
    benches = np.array([look.pair for look in looks], dtype=np.int64).reshape(*time.shape, 2)
    lowest = grazes(stretch, [stretch.look(travel) for travel in moments_of(stretch)]) if time.size > 1 else ()
    found = [Graze(max(clock.time(dip.moment), first), dip.gap, dip.pair) for dip in lowest]
    return ClearanceProfile(time, clearance, benches, tuple(sorted(found, key=lambda graze: graze.time)))


@or_about(Performance, least_clearance_between)
@question_about("dance", (Dance, Performance), "the least clearance was not found")
def least_clearance(
    dance: Dance,
    *,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> LeastClearance | None:
    """The least clearance between start and stop [s], see Dance.span(); None with fewer than three benches. Of a
    Performance a PerformanceLeastClearance between its dragons; None for one dragon.

    stray: largest distance of every hole from its place [m]: the result is then the least possible clearance, proven
        for the hulls of the ground that benches may cover (core/shapes/reach.py)
    raises: InvalidValue; OutsideRun for a stop after the end of the run; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> least = least_clearance(Dance(Dragon(), Spiral()), stop=400.0)
    >>> round(least.distance, 4), round(least.time, 3)
    (0.0209, 399.118)
    """
    begin, until = dance.span(start, stop)
    clock, end = dance.clock, dance.end
    if dance.dragon.benches < 3:
        return None
    to_fold = dance.nears_fold(until)
    strayed = checked_stray(stray, dance.dragon)
    sought = SearchInput(dance.dragon, dance.path, 0.0, stray=strayed)
    search = ContactSearch(sought, work=NEAR_WORK_BUDGET, budget=budget)
    last = before_fold(clock.travel(until)) if to_fold else clock.travel(until)
    fold = end.theta if to_fold else None
    stretch = Stretch(search, (clock.travel(begin), last), clock.slowest, fold)
    (distance, travel, pair), at_least = least_on(stretch)
    if distance == 0.0 and (at_start := stretch.look(clock.travel(begin))).gap < 0.0:
        return LeastClearance(at_start.gap, None, begin, at_start.pair)
    return LeastClearance(distance, at_least, max(clock.time(travel), begin), pair)

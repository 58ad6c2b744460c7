"""First contact, with a certificate.

The proof is written above its loops: `core/kernels/bounds.py`, `bends.py`, `pairs.py`, `rings.py`, `repeats.py` and
`marching.py`. In short: the head advances from L to R only if, for every pair that can be near, one axis fixed in one
of the two benches separates them by more than the margin over all of [L, R]: the gap along that axis is known at both
ends, and its second derivative is bounded in between. Benches further out than a radius in closed form cannot touch. In
a dragon with equal body benches, pair (i, j) repeats, in the same place, the meeting of pair (m, m + j - i) when handle
m was where handle i is now (m: the first of the equal benches). So once every bench has passed the start of the one
before it, only the pairs of the first m + 1 benches need a search.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any

from core import kernels, plots
from core.budget import Budget, bounded
from core.clock import Clock
from core.contact.claim import ENDS, UNDECIDED_THEN, claim, claim_at_start, claim_undecided, contact_then
from core.contact.clearance import Graze
from core.contact.fold import approach_fold
from core.contact.march import BRACKETS_GRAZING, TOUCHES, Ended
from core.contact.near_graze import narrowed
from core.contact.search import MARGIN_MAX, Search
from core.dance import Dance, EndReason, RunEnd
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue, said
from core.kernels.constants import FRONT, MX, UY
from core.kernels.results import Marched
from core.motion.trajectory import bench_outlines, trajectory
from core.paths.path import HeadState
from core.paths.spiral import Spiral
from core.shown import Shown, worded
from core.values import asked_of, checked_number

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Time before the end at which a run without contact is drawn [s], because the chain still exists there.
BEFORE_END = 1e-6
# Distance ahead at which a search that gave up first tests for a certain overlap [m of head travel].
BEYOND = 1e-3


class Outcome(StrEnum):
    """Outcome of a search for first contact."""

    CONTACT = "contact"
    CONTACT_AT_START = "contact_at_start"
    CLEAR = "clear"
    UNDECIDED = "undecided"


OUTCOMES = {
    Ended.REACHED: Outcome.CLEAR,
    Ended.STUCK: Outcome.UNDECIDED,
    Ended.TOUCHED: Outcome.CONTACT,
    Ended.TOUCHED_AT_START: Outcome.CONTACT_AT_START,
}


@dataclass(frozen=True, slots=True)
class Feature(Shown):
    """A corner or an edge of one bench. Corners: front-outer, front-inner, rear-outer, rear-inner;
    edges: front, rear, outer, inner. front is towards the lower handle, outer away from the centre."""

    bench: int
    name: str


@dataclass(frozen=True, slots=True, repr=False)
class Evidence(Shown):
    """Evidence for the answer.

    method: the claim and its proof, in sentences (core/contact/claim.py)
    steps: number of proven steps
    clear_until: time until which nothing touches [s]; None if no time is proven clear, because benches touch at the
        start or the search is undecided from the start
    bound: the largest bound on the second derivative of a gap along the head's way that a step used [1/m]
    least_clearance: the narrowest graze met before the contact (or over the whole run), None if none
    """

    method: str
    steps: int
    clear_until: float | None
    bound: float
    least_clearance: Graze | None


@dataclass(frozen=True, slots=True, repr=False)
class FirstContact(Shown):
    """First time at which two benches that share no handle come within the margin.

    time: [s], None if clear or undecided; 0 for contact_at_start
    time_bracket: (proven clear up to, overlapping at) [s], at most 1e-9 s wide, see first_contact(); if undecided the
        same, or up to the end of the run if no overlap is certain; None if clear or at the start
    head: state of the head at that time; benches: the pair (a, b), a < b; corner, edge: the features that meet
    point: (x, y) [m] of the corner; end: end of the run if clear
    gap: separation of the pair in its nominal places at that time [m]: the margin, or another value at the start or
        with a stray; None without a pair
    margin, stray: [m]; dance: the dance of the question
    """

    outcome: Outcome
    time: float | None
    time_bracket: tuple[float, float] | None
    head: HeadState | None
    benches: tuple[int, int] | None
    corner: Feature | None
    edge: Feature | None
    point: tuple[float, float] | None
    end: RunEnd | None
    certificate: Evidence
    gap: float | None = None
    margin: float = field(kw_only=True)
    stray: float = field(kw_only=True, default=0.0)
    dance: Dance = field(kw_only=True, repr=False, compare=False)

    def _line(self) -> str:
        if self.time_bracket is not None and self.outcome is Outcome.UNDECIDED:
            return f"undecided from {worded(self.time_bracket[0], 's')} on"
        near = "touch" if not self.margin else f"come within {worded(self.margin, 'm')}"
        near = f"may {near} with strays up to {worded(self.stray, 'm')}" if self.stray else near
        if self.benches is None or self.time is None:
            assert self.end is not None
            why = "" if self.end.reason is EndReason.STOP else f", where {self.end.why}"
            return f"no two benches {near} until {worded(self.end.time, 's')}{why}"
        a, b = self.benches
        return f"benches {a} and {b} {near} at {worded(self.time, 's')}"

    def plot(self, ax: Axes | None = None, *, enlarged: bool = False) -> Axes:
        """Plot the dance at first contact, the two benches filled; without a contact, just before the end of the run.

        enlarged: True shows only the surroundings of the contact, with the corner and the edge that meet
        returns: the given axes, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra; InvalidValue (enlarged) if nothing meets
        """
        axes = plots.wanted_axes(ax, "FirstContact.plot()")
        dance, benches = self.dance, self.benches
        handles = trajectory(dance, self._shown_time()).position
        outlines = bench_outlines(dance.dragon, handles)
        if enlarged:
            if benches is None or self.point is None:
                raise InvalidValue("enlarged", "enlarged must be False where no two benches meet, got True")
            width = float(dance.dragon.widths[list(benches)].max())
            centre = dance.path.frame.centre
            half = max(plots.ENLARGED_WIDTHS * width, plots.ENLARGED_MARGINS * self.margin)
            plots.draw_enlarged(axes, outlines, benches, self.point, half, self.corner, self.edge, centre)
        else:
            plots.draw_dance(axes, dance.path, handles, outlines)
            if benches is not None:
                plots.mark_pair(axes, outlines, benches)
        if benches is not None:
            axes.legend(loc="upper right", fontsize=9, framealpha=0.95)
        axes.set_title(self._title(enlarged), fontsize=11)
        return axes

    def _title(self, enlarged: bool) -> str:
        margin = self.margin
        if enlarged and self.point is not None:
            place = f"({self.point[0]:.6f} m, {self.point[1]:.6f} m)"
            near = f"Nearer than {said(margin)} m: a gap of {self.gap:.6f} m at {place}"
            return near if margin else f"They meet at {place}"
        what = f"First nearer than {said(margin)} m" if margin else "First contact"
        if self.outcome is Outcome.CONTACT and self.head is not None:
            return f"{what}: {self.time:.6f} s, head at radius {self.head.radius:.6f} m"
        if self.outcome is Outcome.CONTACT_AT_START:
            return f"Nearer than {said(margin)} m from the start on" if margin else f"{what}: already at the start"
        if self.outcome is Outcome.CLEAR and self.end is not None:
            none = f"Never nearer than {said(margin)} m" if margin else "No contact"
            if self.end.reason is EndReason.FOLD:
                return f"{none}, but bench {self.end.bench} folds at {self.end.time:.6f} s"
            return f"{none}: the run ends clear at the {self.end.reason.value}, {self.end.time:.6f} s"
        return f"Undecided: clear up to {self.time_bracket[0]:.6f} s" if self.time_bracket else "Undecided"

    def _shown_time(self) -> float:
        if self.time is not None:
            return self.time
        if self.time_bracket is not None:
            return self.time_bracket[0]
        return (self.end or self.dance.end).time - BEFORE_END


# Names in the order of the kernels' features, FRONT_LEFT to REAR_LEFT and FRONT to LEFT. The first row is for benches
# with the centre on their right, the second for those with the centre on their left.
CORNERS = (
    ("front-outer", "front-inner", "rear-inner", "rear-outer"),
    ("front-inner", "front-outer", "rear-outer", "rear-inner"),
)
EDGES = (("front", "inner", "rear", "outer"), ("front", "outer", "rear", "inner"))


@asked_of("dance", Dance)
@bounded("the first contact was not decided")
def first_contact(
    dance: Dance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float = 0.0,
    stop: float | None = None,
    budget: Budget | None = None,
) -> FirstContact:
    """First time at which two benches that share no handle come within the margin, proven to miss no earlier one.

    margin: required clearance [m]; contact means separation <= margin
    stray: largest distance of every hole from its place [m], see core/tolerance/reach.py: the answer is then the first
        time at which two benches may come within the margin, because the grounds that they may cover do
    start, stop: interval of the search [s]; None for the end of the run
    returns: see FirstContact. Times are good to 1e-10 s at 1 m/s. The bracket [proven clear up to, overlapping at] is
        at most 1e-9 s wide. It is wider where arc lengths or times are less exact (beyond 1e5 m, below 1e-3 m/s);
        within about 5e-5 m of a graze along waypoints, behind bench 60, or if a second pair meets at once; and where
        benches that stray nearly graze (1e-7 s). Both ends hold in spite of rounding (core/kernels/rounding.py,
        pairs.py). The answer is undecided if rounding hides it: for benches whose clearance at the start equals the
        margin to about 1e-12 m
    raises: InvalidValue; OutsideRun for a stop after the end of the run; TooMuchWork
    source: the model of Yang et al., sections 2.4 and 2.5, whose times differ: see app/questions/paper.py

    >>> from core import Dragon
    >>> contact = first_contact(Dance(Dragon(), Spiral()))
    >>> contact.outcome.value, round(contact.time, 6), contact.benches
    ('contact', 412.473838, (0, 8))
    """
    budget = budget or Budget()
    found = contact_within(budget, dance, margin=margin, stray=stray, start=start, stop=stop)
    if found.outcome is Outcome.UNDECIDED:
        budget.afford()  # it may be undecided because the work is spent
    return found


def contact_within(
    budget: Budget,
    dance: Dance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float = 0.0,
    stop: float | None = None,
) -> FirstContact:
    """first_contact() as a part of a larger question; it is also undecided if the budget of that question is spent."""
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed = checked_stray(stray, dance.dragon)
    begin, until = dance.span(start, stop)
    clock, head_speed, end = dance.clock, dance.clock.slowest, dance.end
    search = Search(dance.dragon, dance.path, margin, budget=budget, stray=strayed)
    search.timing = clock.rounding(until)
    first, last = clock.place(begin), clock.place(until)
    to_fold = dance.nears_fold(until)
    stops = search.fold_stops(first, last, end) if to_fold else [(last, 0.0)]
    state, found, tolerance = search.approach(first, stops[0][0], head_speed)
    if to_fold and state not in TOUCHES:
        state, found, tolerance = approach_fold(search, first, stops, head_speed, end, (state, found, tolerance))
    narrow = BRACKETS_GRAZING[0] * min(1.0, head_speed)
    if (
        not (strayed or dance.passages)
        and state is Ended.TOUCHED
        and tolerance > narrow >= 2.0 * search.travel_rounding(found.touching or 0.0)
    ):
        narrower = narrowed(search, found, narrow, head_speed)
        if narrower is not None:
            found, tolerance = narrower, narrow
    if state is Ended.STUCK:
        until = _known_overlap(search, found.proven, stops[-1][0], clock, until)
    if stop is not None and state is Ended.REACHED:
        end = RunEnd(EndReason.STOP, until, None, None)
    return _result(dance, search, state, found, end, (begin, until), tolerance)


def _known_overlap(search: Search, proven: float, last: float, clock: Clock, until: float) -> float:
    """Time after the end of a failed search at which benches are certainly within the margin [s]; else `until`."""
    state, found, _ = search.approach(min(proven + BEYOND, last), last, clock.slowest)
    return until if state is Ended.STUCK or found.touching is None else clock.time(found.touching)


def _result(
    dance: Dance,
    search: Search,
    state: Ended,
    found: Marched,
    end: RunEnd,
    span: tuple[float, float],
    tolerance: float,
) -> FirstContact:
    graze, clock = None, dance.clock
    if found.graze is not None:
        graze = Graze(max(clock.time(found.graze.travel), span[0]), found.graze.gap, found.graze.benches)
    proven = end.time if state is Ended.REACHED else max(clock.time(found.proven), span[0])
    outcome = OUTCOMES[state]
    method = _method(dance, search, outcome, found, end, (span[0], proven))
    clear_until = proven if proven > span[0] and outcome is not Outcome.CONTACT_AT_START else None
    certificate = Evidence(method, found.steps, clear_until, found.bend, graze)
    asked: dict[str, Any] = {"margin": search.margin, "stray": search.stray, "dance": dance}
    if outcome is Outcome.CLEAR:
        return FirstContact(outcome, None, None, None, None, None, None, None, end, certificate, **asked)
    if outcome is Outcome.UNDECIDED:
        bracket = (proven, span[1])
        return FirstContact(outcome, None, bracket, None, None, None, None, None, None, certificate, **asked)
    at_start = outcome is Outcome.CONTACT_AT_START
    assert found.touching is not None
    travel = found.touching if at_start else found.touching - tolerance
    pair = found.benches
    corner, edge, point, gap = _touching_features(search, travel, pair)
    time = span[0] if at_start else clock.time(travel)
    meeting = None if at_start else (proven, clock.time(found.touching))
    gap = gap if at_start or search.stray else search.margin
    head = search.path.head(travel)
    return FirstContact(outcome, time, meeting, head, pair, corner, edge, point, None, certificate, gap, **asked)


def _method(
    dance: Dance, search: Search, outcome: Outcome, found: Marched, end: RunEnd, span: tuple[float, float]
) -> str:
    margin = search.margin
    asked = (dance, margin, search.stray)
    if outcome is Outcome.CLEAR:
        return claim(*asked, span, ENDS[end.reason])
    if outcome is Outcome.UNDECIDED:
        return claim(*asked, span, UNDECIDED_THEN) if span[1] > span[0] else claim_undecided(*asked, span[0])
    pair = found.benches
    if outcome is Outcome.CONTACT_AT_START:
        return claim_at_start(*asked, span[0], pair)
    assert found.touching is not None
    touching = dance.clock.time(found.touching)
    if not span[1] > span[0]:
        return claim_at_start(*asked, touching, pair)
    return claim(*asked, span, contact_then(pair, margin, search.stray, touching))


def _touching_features(
    search: Search, travel: float, pair: tuple[int, int]
) -> tuple[Feature | None, Feature | None, tuple[float, float], float]:
    """The corner and the edge that meet, the corner's place in the world frame [m], and the separation [m]."""
    search.place_leaders(travel, pair[1] + 1)
    met = kernels.bench_separation(*pair, search.own_sizes, search.rows[0])
    corner, edge = None, None
    for bench, feature in zip(pair, (met.feature_a, met.feature_b), strict=True):
        x, y, ux, uy = search.rows[0, bench, MX : UY + 1].tolist()
        centre_on_left = int(y * ux < x * uy)
        if feature >= FRONT:
            edge = Feature(bench, EDGES[centre_on_left][feature - FRONT])
        elif corner is None:
            corner = Feature(bench, CORNERS[centre_on_left][feature])
    x, y = (met.bx, met.by) if corner and corner.bench == pair[1] else (met.ax, met.ay)
    turned = search.theta_at(travel) if isinstance(search.path, Spiral) else 0.0
    cos, sin = math.cos(turned), math.sin(turned)
    point = search.path.frame.point(float(x * cos - y * sin), float(x * sin + y * cos))
    return corner, edge, point, float(met.separation)

"""Answer of a search for first contact: its outcome, the evidence for it, and its drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

from core import plots
from core.claims.certificate import WithClaim
from core.claims.claim import ContactClaim
from core.dance import Dance, EndReason, RunEnd
from core.display import Readable, display
from core.errors import InvalidValue
from core.kernels import Ended, Witnesses
from core.kernels.constants import FRONT, MX, UY
from core.language import phrase, say
from core.motion.trajectory import trajectory
from core.paths.path import HeadState
from core.quantities import format_number
from core.shapes.rectangles import bench_outlines
from core.values import Floats, Interval, Pair, Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Time before the end at which a run without contact is drawn [s], because the chain still exists there.
BEFORE_END = 1e-6


class Outcome(StrEnum):
    """Outcome of a search for first contact.

    >>> from core import Dragon, Spiral, first_contact
    >>> first_contact(Dance(Dragon(), Spiral(1.7)), stop=100.0).outcome
    <Outcome.CLEAR: 'clear'>
    """

    CONTACT = "contact"
    CONTACT_AT_START = "contact_at_start"
    CLEAR = "clear"
    UNDECIDED = "undecided"


OUTCOMES = {
    Ended.REACHED: Outcome.CLEAR,
    Ended.TOUCHED: Outcome.CONTACT,
    Ended.TOUCHED_AT_START: Outcome.CONTACT_AT_START,
}

# Names in the order of the kernels' features, FRONT_LEFT to REAR_LEFT and FRONT to LEFT. The first row is for benches
# with the centre on their right, the second for those with the centre on their left.
CORNERS = (
    ("front-outer", "front-inner", "rear-inner", "rear-outer"),
    ("front-inner", "front-outer", "rear-outer", "rear-inner"),
)
EDGES = (("front", "inner", "rear", "outer"), ("front", "outer", "rear", "inner"))


@dataclass(frozen=True, slots=True)
class Feature(Readable):
    """A corner or an edge of one bench. The front is towards the lower handle, the outer side away from the centre.

    bench: number of the bench; 0 is the head
    name: front or rear (towards the lower or higher handle), outer or inner (seen from the centre), or both for a
        corner

    >>> from core import Dragon, Spiral, first_contact
    >>> contact = first_contact(Dance(Dragon(), Spiral()))
    >>> contact.corner, contact.edge
    (Feature(bench=0, name='front-outer'), Feature(bench=8, name='inner'))
    """

    bench: int
    name: str

    def __str__(self) -> str:
        return plots.feature_words(self)


def features(
    met: Witnesses, benches: Pair, placed: Floats, centres: Sequence[Point]
) -> tuple[tuple[int, Feature] | None, tuple[int, Feature] | None, Point]:
    """The corner and the edge of two benches that meet, each with its side of the pair, 0 or 1; and where they do [m].

    met: of kernels.bench_separation(); placed: (2, CHAIN_COLUMNS) both benches; centres: of their paths [m]
    """
    corner, edge, point = None, None, (float(met.ax), float(met.ay))
    for side, feature in enumerate((met.feature_a, met.feature_b)):
        (x, y, ux, uy), (cx, cy) = placed[side, MX : UY + 1].tolist(), centres[side]
        centre_on_left = int(ux * (cy - y) - uy * (cx - x) > 0.0)
        if feature >= FRONT:
            edge = side, Feature(benches[side], EDGES[centre_on_left][feature - FRONT])
        elif corner is None:
            corner = side, Feature(benches[side], CORNERS[centre_on_left][feature])
            point = (float(met.bx), float(met.by)) if side else point
    return corner, edge, point


@dataclass(frozen=True, slots=True, repr=False)
class Graze(Readable):
    """A local minimum of the clearance over time.

    time: time of the minimum [s]
    clearance: clearance at that time [m]
    benches: the pair

    >>> import numpy as np
    >>> from core import Dragon, Spiral, clearance_profile
    >>> graze = clearance_profile(Dance(Dragon(), Spiral()), np.arange(405.0, 412.0)).grazes[0]
    >>> round(graze.time, 2), round(graze.clearance, 6), graze.benches
    (406.85, 0.002957, (0, 9))
    """

    time: float
    clearance: float
    benches: Pair


@dataclass(frozen=True, slots=True, repr=False)
class Evidence(WithClaim):
    """Evidence for the answer; a certificate that others can check comes from `core.proof`.

    claim: the claim as a kind and values
    steps: number of proven steps
    clear_until: time until which no two benches come within the margin, or touch if it is 0; None if no time is proven
        clear: benches touch or are nearer at the start, or nothing is decided from the start [s]
    bound: largest bound on the second derivative of a gap along the head's way that a step used [1/m]
    least_clearance: narrowest graze before the contact, or over the whole run if there is none; None without a graze

    >>> from core import Dragon, Spiral, first_contact
    >>> evidence = first_contact(Dance(Dragon(), Spiral())).certificate
    >>> round(evidence.clear_until, 6), evidence.bound > 0.0
    (412.473838, True)
    """

    claim: ContactClaim
    steps: int
    clear_until: float | None
    bound: float
    least_clearance: Graze | None


# How the title of a plot ends, by the end of the run.
ENDS = {
    EndReason.FOLD: phrase("{none}, but bench {bench} folds at {time:.6f} s"),
    EndReason.CENTRE: phrase("{none}: the run ends clear at the centre, {time:.6f} s"),
    EndReason.END: phrase("{none}: the run ends clear at the end, {time:.6f} s"),
    EndReason.STOP: phrase("{none}: the run ends clear at the stop, {time:.6f} s"),
}


@dataclass(frozen=True, slots=True, repr=False)
class FirstContact(Readable):
    """First time at which two benches that share no handle come within the margin, or touch if it is 0.

    outcome: end of the search; contact: two benches come within the margin, or touch if it is 0
    time: first time within the margin, or touching if it is 0; None when clear or undecided [s]
    time_bracket: two times, at most 1e-9 s apart: no contact is proven up to the first, and a contact is certain at the
        second. If undecided they may be further apart, and the second is the end of the search, unless a pair is
        certainly within the margin then (overlapping). None if clear or at the start [s]
    overlapping: if undecided: the pair that is certainly within the margin, or overlaps, at the second of these times,
        perhaps not for the first time; None if no contact is certain, or not undecided
    head: the head at that time
    benches: the pair in contact, the smaller number first
    corner: corner that touches or is nearest
    edge: edge that this corner touches or is nearest to
    point: position of that corner, x and y [m]
    end: end of the run, when clear
    certificate: evidence for the answer
    gap: gap between the two at that time, each in its place: the margin, or less if they are nearer from the start, or
        more with a stray [m]
    margin: required clearance; 0: only a touch counts as a contact [m]
    stray: largest distance of a hole from its place, by people and by play [m]
    dance: the dance of the question

    >>> from core import Dragon, Spiral, first_contact
    >>> contact = first_contact(Dance(Dragon(), Spiral()))
    >>> contact
    <FirstContact: benches 0 and 8 touch at 412.473838 s>
    >>> round(contact.head.radius, 6), contact.time_bracket[0] <= contact.time <= contact.time_bracket[1]
    (2.288743, True)
    """

    outcome: Outcome
    _: KW_ONLY
    time: float | None = None
    time_bracket: Interval | None = None
    overlapping: Pair | None = None
    head: HeadState | None = None
    benches: Pair | None = None
    corner: Feature | None = None
    edge: Feature | None = None
    point: Point | None = None
    end: RunEnd | None = None
    certificate: Evidence
    gap: float | None = None
    margin: float
    stray: float = 0.0
    dance: Dance = field(repr=False, compare=False)

    def _line(self) -> str:
        pair, near = self.benches or self.overlapping, near_words(self.margin, self.stray)
        words = pair and say("benches {a} and {b}", a=pair[0], b=pair[1])
        if self.outcome is Outcome.UNDECIDED and self.time_bracket is not None:
            return undecided_words(self.time_bracket, words, near)
        if words and self.time is not None:
            return say("{pair} {near} at {time}", pair=words, near=near, time=display(self.time, "s"))
        assert self.end is not None
        end = display(self.end.time, "s")
        if self.end.reason is EndReason.STOP:
            return say("no two benches {near} until {end}", near=near, end=end)
        return say("no two benches {near} until {end}, where {why}", near=near, end=end, why=self.end.why)

    def _benches(self) -> tuple[Floats, tuple[int, ...]]:
        handles = trajectory(self.dance, self._plot_time()).position
        return bench_outlines(self.dance.dragon, handles), self.benches or ()

    def plot(self, ax: Axes | None = None, *, enlarged: bool = False) -> Axes:
        """Plot the dance at first contact, the two benches filled; without a contact, just before the end of the run.

        enlarged: True shows only the surroundings of the contact, with the corner and the edge that meet
        returns: the given axes, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra; InvalidValue (enlarged) if nothing meets
        """
        axes = plots.wanted_axes(ax, "FirstContact.plot()")
        dance, benches = self.dance, self.benches
        handles = trajectory(dance, self._plot_time()).position
        outlines = bench_outlines(dance.dragon, handles)
        if enlarged:
            if benches is None or self.point is None:
                raise InvalidValue("enlarged", "must be False where no two benches meet", got="True")
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
        margin = format_number(self.margin) if self.margin else ""
        if enlarged and self.point is not None:
            place = f"({self.point[0]:.6f} m, {self.point[1]:.6f} m)"
            if margin:
                return say(
                    "Within {margin} m: a gap of {gap:.6f} m at {place}", margin=margin, gap=self.gap, place=place
                )
            return say("They meet at {place}", place=place)
        if self.outcome is Outcome.CONTACT and self.head is not None:
            values = {"time": self.time, "radius": self.head.radius}
            if margin:
                return say(
                    "First within {margin} m: {time:.6f} s, head at radius {radius:.6f} m", margin=margin, **values
                )
            return say("First contact: {time:.6f} s, head at radius {radius:.6f} m", **values)
        if self.outcome is Outcome.CONTACT_AT_START:
            near = say("Within {margin} m from the start on", margin=margin)
            return near if margin else say("First contact: already at the start")
        if self.outcome is Outcome.CLEAR and self.end is not None:
            none = say("Never within {margin} m", margin=margin) if margin else say("No contact")
            return say(ENDS[self.end.reason], none=none, bench=self.end.bench, time=self.end.time)
        if self.time_bracket:
            return say("Undecided: clear up to {time:.6f} s", time=self.time_bracket[0])
        return say("Undecided")

    def _plot_time(self) -> float:
        if self.time is not None:
            return self.time
        if self.time_bracket is not None:
            return self.time_bracket[0]
        return (self.end or self.dance.end).time - BEFORE_END


def near_words(margin: float, stray: float) -> str:
    """What benches do that come within a margin [m], with strays [m]."""
    near = say("come within {margin}", margin=display(margin, "m")) if margin else say("touch")
    return say("may {near} with strays up to {stray}", near=near, stray=display(stray, "m")) if stray else near


def undecided_words(bracket: Interval, pair: str | None, near: str) -> str:
    """From when on a search is undecided, and which pair is near at the end of its bracket [s]."""
    begin, end = (display(time, "s") for time in bracket)
    if not pair:
        return say("undecided from {begin} on", begin=begin)
    return say("undecided from {begin} on; {pair} {near} at {end}", begin=begin, pair=pair, near=near, end=end)

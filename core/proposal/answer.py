"""Proposals: the dances that fit with what is good and what is tight about each, and the reason where there is none."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.dance import Dance
from core.display import Readable, display
from core.failures import Failure
from core.judgement import Report
from core.language import Phrases, counted, joined, phrase, say
from core.proposal.figures import Figure
from core.quantities import format_number
from core.venue import Venue


class Objective(StrEnum):
    """What makes one proposal better than another. TOLERANCE: the stray of people that is proven safe; BENCHES: how
    many benches can dance; TURNS: how often the head turns around; DURATION: how long the dance takes.

    >>> [objective.value for objective in Objective]
    ['tolerance', 'benches', 'turns', 'duration']
    """

    TOLERANCE = "tolerance"
    BENCHES = "benches"
    TURNS = "turns"
    DURATION = "duration"


class ReasonKind(StrEnum):
    """Why no dance is proposed. AREA: the benches cover more than the square has; WIDTH: nowhere is room for a turn as
    tight as those that are tried; WAY: no way between two gates is wide enough; STRAY: the best dance allows a smaller
    stray than wanted; DURATION: the dances that were found last longer than wanted; BENCHES: a dragon of fewer benches
    fits; FAILS: none of the dances that were tried passes its check.

    >>> [kind.value for kind in ReasonKind]
    ['area', 'width', 'way', 'stray', 'duration', 'benches', 'fails']
    """

    AREA = "area"
    WIDTH = "width"
    WAY = "way"
    STRAY = "stray"
    DURATION = "duration"
    BENCHES = "benches"
    FAILS = "fails"


# Decimals of the numbers of a reason, and the most that tell two of them apart [1].
DIGITS = {ReasonKind.AREA: 1, ReasonKind.WIDTH: 2, ReasonKind.WAY: 2, ReasonKind.STRAY: 3}
DECIMALS_MOST = 12


@dataclass(frozen=True, slots=True, repr=False)
class Reason(Readable):
    """Why no dance is proposed: what there is and what it takes, in the unit of the kind.

    kind: kind of the reason
    tried: number of dances that were laid out and measured
    have: what there is; for fails the benches of the dance that comes nearest, which is one if no dance of the whole
        dragon was worth a check
    need: what it takes; for fails the benches of the dragon
    figure: the figure that comes nearest; None for area, width and way
    who: for width the bench that needs it, for way the numbers of both gates
    failure: for fails the first failure of the dance that comes nearest; else None

    The unit is m2 for AREA, m for WIDTH, WAY and STRAY, s for DURATION, benches for BENCHES and FAILS. AREA and WAY are
    proven, and so is the width that there is; the others are about the dances that were tried.

    >>> from core import Area, Dragon, propose
    >>> closet = Venue(Area("closet", (((0, 0), (4, 0), (4, 4), (0, 4), (0, 0)),)))
    >>> propose(closet, Dragon(60)).reason.kind
    <ReasonKind.AREA: 'area'>
    """

    kind: ReasonKind
    tried: int
    have: float | None = None
    need: float | None = None
    figure: Figure | None = None
    who: tuple[int, ...] = ()
    failure: Failure | None = None

    @property
    def message(self) -> str:
        """The reason in one sentence."""
        have, need, figure = self.have or 0.0, self.need or 0.0, say(NAMES[self.figure or Figure.RING])
        less, more = told_apart(have, need, DIGITS.get(self.kind, 0))
        if self.kind is ReasonKind.AREA:
            covered = phrase("The benches cover at least {more} m2 at any moment; the square has {less} m2.")
            return say(covered, more=more, less=less)
        if self.kind is ReasonKind.WIDTH:
            bench = say("the head bench") if self.who == (0,) else say("bench {k}", k=self.who[0])
            return say(
                "No dance was found: the widest free circle is at most {less} m across, and the tightest turn of "
                "{bench} that is tried takes {more} m.",
                less=less, more=more, bench=bench,
            )  # fmt: skip
        if self.kind is ReasonKind.WAY:
            return say(
                "The free ground between gate {a} and gate {b} is at most {less} m wide at its narrowest; the benches "
                "need at least {more} m.",
                a=self.who[0], b=self.who[1], less=less, more=more,
            )  # fmt: skip
        if self.kind is ReasonKind.STRAY:
            return say(
                "People shall be free to stray {need} m; the best of {tried} tried, {figure}, allows {less} m.",
                need=format_number(need), tried=self.tried, figure=figure, less=less,
            )  # fmt: skip
        if self.kind is ReasonKind.DURATION:
            return say(
                "No dance of at most {less} s was found; the shortest one that was found, {figure}, takes {more} s.",
                less=format_number(have), figure=figure, more=told_apart(have, need, 0)[1],
            )  # fmt: skip
        if self.kind is ReasonKind.BENCHES:
            return say(
                "The dragon has {benches}; the longest dragon that was found to fit, in {figure}, has {have:.0f}.",
                benches=benches_of(int(need)), figure=figure, have=have,
            )  # fmt: skip
        none = say("None of {tried} tried passes its check", tried=self.tried)
        if have < need:
            none = say("No dance was found, not even with one bench")
        if self.failure is None:
            return say("{none}.", none=none)
        return say("{none}; the nearest, {figure}: {failure}", none=none, figure=figure, failure=self.failure.message)

    def _line(self) -> str:
        return self.message


def told_apart(less: float, more: float, decimals: int) -> tuple[str, str]:
    """Two numbers with this number of decimals, or with as many more as tell them apart.

    >>> told_apart(0.438, 0.44, 2)
    ('0.438', '0.440')
    """
    for count in range(decimals, DECIMALS_MOST):
        texts = f"{less:.{count}f}", f"{more:.{count}f}"
        if texts[0] != texts[1]:
            return texts
    return f"{less!r}", f"{more!r}"


NAMES: Phrases = {
    Figure.SPIRAL: "a spiral",
    Figure.EIGHT: "a figure eight",
    Figure.SERPENTINE: "a serpentine",
    Figure.RING: "a ring",
    Figure.PARADE: "a parade",
}


def benches_of(count: int) -> str:
    """A number of benches in words."""
    return counted(count, "{count} bench", "{count} benches")


@dataclass(frozen=True, slots=True, repr=False)
class Near(Readable):
    """What the benches come nearest to.

    name: name of the square or of the obstacle
    distance: smallest distance found of all ground that benches may cover with the stray of the request [m]
    time: time at which it is reached [s]
    in_place: the same with everybody in place [m]

    >>> from core import Area, Dragon, propose
    >>> hall = Venue(Area("hall", (((0, 0), (24, 0), (24, 20), (0, 20), (0, 0)),)))
    >>> propose(hall, Dragon(12), figures=["ring"], count=1).proposals[0].near.name
    'hall'
    """

    name: str
    distance: float
    time: float
    in_place: float


@dataclass(frozen=True, slots=True, repr=False)
class Proposal(Readable):
    """A dance that fits, certified by its report.

    figure: figure of the dance
    dance: the dance; at time 0 the whole dragon is on its path
    venue: the venue, with the streets in which it stands
    report: verdict of check(), which passes; margin, stray and speed limit are those that were asked for
    tolerance: largest stray of people that is proven safe, without the margin [m]
    area: area of the ground that benches sweep, which reaches at most GROUND beyond them [m2]
    turns: turns of the head, all bends added up
    near: what the benches come nearest to
    gates: numbers of the gates by which it enters and leaves; none without gates
    clearance_in_place: least distance of two benches with everybody in place; None for fewer than three [m]

    >>> from core import Area, Dragon, propose
    >>> hall = Venue(Area("hall", (((0, 0), (24, 0), (24, 20), (0, 20), (0, 0)),)))
    >>> best = propose(hall, Dragon(12), figures=["ring"], count=1).proposals[0]
    >>> best.figure.value, best.report.passed
    ('ring', True)
    """

    figure: Figure
    dance: Dance
    venue: Venue
    report: Report
    tolerance: float
    area: float
    turns: float
    near: Near
    gates: tuple[int, ...]
    clearance_in_place: float | None

    @property
    def duration(self) -> float:
        """Time from the beginning, with the whole dragon on its path, to the end of the path [s]."""
        return self.report.stop - self.report.start

    @property
    def length(self) -> float:
        """Way of the head in this time [m]."""
        clock = self.dance.clock
        return clock.travel(self.report.stop) - clock.travel(self.report.start)

    @property
    def clearance(self) -> float | None:
        """Least distance of what two benches may cover with the stray asked for [m]; None for fewer than three."""
        least = self.report.least_clearance
        return None if least is None else least.distance

    @property
    def sharpest_bend(self) -> float | None:
        """Largest angle between two consecutive benches [rad]; None for a single bench."""
        bend = self.report.sharpest_bend
        return None if bend is None else bend.angle

    @property
    def message(self) -> str:
        """The dance in one sentence."""
        line = self._line()
        return say("{line}.", line=f"{line[0].upper()}{line[1:]}")

    def _line(self) -> str:
        near = say("{distance} from {name}", distance=display(self.near.in_place, "m", 3), name=repr(self.near.name))
        if self.near.distance != self.near.in_place:
            least = display(self.near.distance, "m", 3)
            near = say("{near}, at least {least} with the stray asked for", near=near, least=least)
        return say(
            "{figure} of {benches}{way}, {duration:.0f} s, {length:.0f} m; strays up to {stray} are safe; {near}",
            figure=say(NAMES[self.figure]), benches=benches_of(self.dance.dragon.benches), way=self._way(),
            duration=self.duration, length=self.length, stray=display(self.tolerance, "m", 3), near=near,
        )  # fmt: skip

    def _way(self) -> str:
        """Between which gates it leads; empty without gates."""
        if not self.gates:
            return ""
        first, last = self.gates
        if first == last:
            return say(" by gate {a}", a=first)
        return say(" from gate {a} to gate {b}", a=first, b=last)


@dataclass(frozen=True, slots=True, repr=False)
class Proposals(Readable):
    """Dances that fit, the best one first; not all that there are, and none is proven to be the best.

    proposals: the dances
    tried: number of dances that were laid out and measured
    checked: number of these that a check judged
    reason: why there is none; None if there is a proposal
    most_benches: no dragon of more benches of this kind fits, by the area of the square; None with gates, beyond which
        it may stand

    >>> from core import Area, Dragon, propose
    >>> hall = Venue(Area("hall", (((0, 0), (24, 0), (24, 20), (0, 20), (0, 0)),)))
    >>> len(propose(hall, Dragon(12), figures=["ring"], count=1).proposals)
    1
    """

    proposals: tuple[Proposal, ...]
    tried: int
    checked: int
    reason: Reason | None
    most_benches: int | None

    @property
    def message(self) -> str:
        """What was found in one sentence."""
        if self.reason is not None:
            return self.reason.message
        return say(
            "The best {count} of {tried} tried, {checked} of them checked.",
            count=len(self.proposals), tried=self.tried, checked=self.checked,
        )  # fmt: skip

    def _line(self) -> str:
        return joined([self.message, *(say("First: {line}.", line=one._line()) for one in self.proposals[:1])])

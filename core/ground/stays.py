"""Times at which benches are in an area, such as a lane that is kept for ambulances.

A march in time. No point of a bench is faster than
    (1/2 + radius / chord) times the speeds of both of its handles together,
where the radius is half of its diagonal (core/shapes/reach.py), so it needs the gap to the area divided by this to get
there: until then the area is clear, and so it was for as long before. While a bench is in the area, the march goes on
by the depth at which the centre of one is inside, divided by its speed, then back from the first clear instant by the
same bound. So every instant outside a stay is proven to be clear; inside, a clear moment shorter than these steps may
be missed, which makes a stay too long, never too short.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core import kernels
from core.checks import checked_number, checked_type
from core.contact.search import MARGIN_MAX
from core.dance import Dance
from core.display import Readable, display
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue
from core.extremes.speed import highest_speed
from core.kernels import Budget
from core.language import counted, say
from core.motion.trajectory import trajectory
from core.performance import Performance
from core.questions import or_about, question_about
from core.shapes.engines import inside
from core.shapes.reach import gains
from core.shapes.rectangles import bench_poses, edge_frames, frames
from core.values import Interval
from core.venue import Area

# A bench nearer than this counts as in the area [m], and shortest step while one is [s].
NEAR, STEP = 1e-3, 1e-2
# Work of the gap of a bench and an edge, and of one question [1].
PAIR_WORK, STAYS_WORK = 0.2, 2e7


@dataclass(frozen=True, slots=True, repr=False)
class Stay(Readable):
    """A time during which benches are in an area.

    begin: the area is proven to be clear before it [s]
    end: the area is proven to be clear after it [s]
    first: the bench that comes first
    last: the bench that leaves last

    >>> from core import Dragon, Line, Route
    >>> lane = Area("lane", (((20, -9), (23, -9), (23, 9), (20, 9), (20, -9)),))
    >>> stay = stays(Dance(Dragon(3), Route([Line((0, 0), (60, 0))])), lane).stays[0]
    >>> stay.first, stay.last
    (0, 2)
    """

    begin: float
    end: float
    first: int
    last: int

    @property
    def duration(self) -> float:
        """Its length [s]."""
        return self.end - self.begin


@dataclass(frozen=True, slots=True, repr=False)
class Stays(Readable):
    """The times at which a bench is in an area, or within the margin of it.

    name: name of the area
    stays: these times in order, apart; proven: at all other times from start to stop it is clear
    start: start of the time asked about [s]
    stop: end of the time asked about [s]

    >>> from core import Dragon, Line, Route
    >>> lane = Area("lane", (((20, -9), (23, -9), (23, 9), (20, 9), (20, -9)),))
    >>> len(stays(Dance(Dragon(3), Route([Line((0, 0), (60, 0))])), lane).stays)
    1
    """

    name: str
    stays: tuple[Stay, ...]
    start: float
    stop: float

    @property
    def total(self) -> float:
        """All stays together [s], at most a little too long."""
        return sum(one.duration for one in self.stays)

    def _line(self) -> str:
        count = counted(len(self.stays), "{count} stay", "{count} stays")
        values = {"total": display(self.total, "s"), "whole": display(self.stop - self.start, "s")}
        return say("{name} {count}, {total} of {whole}", name=repr(self.name), count=count, **values)


@question_about("performance", Performance, "the times in the area were not found")
def _of_each(
    performance: Performance, area: Area, *, start: float | None = None, stop: float | None = None, **how: Any
) -> tuple[Stays, ...]:
    begin, until = performance.span(start, stop)
    found = list[Stays]()
    for part in performance.parts:
        first, last = part.own_span(begin, until)
        own = stays(part.dance, area, start=first, stop=last, **how)
        # A dragon that is in the area when its dance begins or ends stands there before or afterwards.
        moved = (
            replace(
                one,
                begin=begin if one.begin <= first else one.begin + part.delay,
                end=until if one.end >= last else one.end + part.delay,
            )
            for one in own.stays
        )
        found.append(replace(own, stays=tuple(moved), start=begin, stop=until))
    return tuple(found)


@or_about(Performance, _of_each)
@question_about("dance", (Dance, Performance), "the times in the area were not found")
def stays(
    dance: Dance,
    area: Area,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> Stays:
    """The times at which a bench is in an area, or within the margin of it; of a Performance the Stays of each dragon,
    on the clock of the performance, also those in which it stands before its dance or after it.

    margin: [m]; stray: largest distance of every hole from its place [m]: then the ground that benches may cover counts
    start, stop: [s]; defaults: dance.begin and the end of the run
    raises: InvalidValue, also for a spiral up to its fold, where speeds grow without bound; OutsideRun; TooMuchWork

    >>> from core import Dragon, Line, Route
    >>> lane = Area("lane", (((20, -9), (23, -9), (23, 9), (20, 9), (20, -9)),))
    >>> street = Route([Line((0, 0), (60, 0))])
    >>> [(round(one.begin, 2), round(one.end, 2)) for one in stays(Dance(Dragon(3), street), lane).stays]
    [(19.72, 29.44)]
    """
    checked_type("area", area, Area)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed = checked_stray(stray, dance.dragon)
    begin, until = dance.whole_span(start, stop)
    budget = (budget or Budget()).within(STAYS_WORK)
    march = _March(dance, area, margin, strayed, (begin, until), budget)
    return Stays(area.name, tuple(march.stays()), begin, until)


@dataclass(frozen=True, slots=True)
class _Look:
    """Benches and area at an instant: the least gap less the margin, 0 within it [m], and its bench; the largest depth
    of a centre in the area, 0 without one [m]."""

    gap: float
    bench: int
    depth: float

    @property
    def is_in(self) -> bool:
        return self.gap <= NEAR


class _March:
    """Input: a dance and an area. Output: the stays. State: none but the budget."""

    def __init__(self, dance: Dance, area: Area, margin: float, stray: float, span: Interval, budget: Budget) -> None:
        dragon = dance.dragon
        self.dance, self.area, self.span, self.budget = dance, area, span, budget
        self.sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
        self.edges = edge_frames(area.edges)
        self.need = margin + gains(dragon) * stray
        fastest = highest_speed(dance, start=span[0], stop=span[1], budget=budget).speed_bracket[1]
        if fastest is None:
            words = "how fast benches are could not be proven: ask about a shorter time"
            raise InvalidValue.in_words("stop", words)
        radius = 0.5 * np.hypot(dragon.lengths, dragon.widths)
        self.fastest = float(((1.0 + 2.0 * radius / dragon.chords) * fastest).max())

    def look(self, time: float) -> _Look:
        self.budget.afford(PAIR_WORK * len(self.sizes) * len(self.edges))
        poses = bench_poses(trajectory(self.dance, [time], budget=self.budget).position[0])
        a = np.repeat(frames(poses, self.sizes), len(self.edges), axis=0)
        b = np.tile(self.edges, (len(self.sizes), 1))
        gaps, centred = np.empty(len(a)), np.empty(len(a))
        kernels.pair_gaps(a, b, kernels.FREE, gaps)
        gap = gaps.reshape(len(self.sizes), -1).min(axis=1)
        within = inside(self.area.rings, poses[:, :2])
        gap = np.where(within, 0.0, np.maximum(gap - self.need, 0.0))
        bench, depth = int(gap.argmin()), 0.0
        if within.any():
            a[:, kernels.FRAME_HALF_LENGTH :] = 0.0
            kernels.pair_gaps(a, b, kernels.FREE, centred)
            depth = float(centred.reshape(len(self.sizes), -1).min(axis=1)[within].max())
        return _Look(float(gap[bench]), bench, depth)

    def stays(self) -> list[Stay]:
        """All stays, in order."""
        found, (time, until) = list[Stay](), self.span
        while time < until:
            now = self.look(time)
            if not now.is_in:
                time += now.gap / self.fastest
                continue
            last, clear = self.leaving(time)
            end, bench = (until, self.look(until).bench) if clear > until else self.back(last, clear)
            found.append(Stay(time, end, now.bench, bench))
            time = clear
        return found

    def leaving(self, time: float) -> tuple[float, float]:
        """The last step at which a bench is in the area, and the next one, at which none is; infinite if one stays to
        the end."""
        last, until = time, self.span[1]
        while True:
            now = self.look(time)
            if not now.is_in:
                return last, time
            if time >= until:
                return last, np.inf
            last, time = time, min(until, time + max(STEP, now.depth / self.fastest))

    def back(self, last: float, clear: float) -> tuple[float, int]:
        """When the area is clear for certain, between an instant and a later one at which it is; and the bench that
        leaves then."""
        while clear > last:
            now = self.look(clear)
            if now.is_in:
                return clear, now.bench
            clear -= now.gap / self.fastest
        return last, self.look(last).bench

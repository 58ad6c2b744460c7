"""Cues: what happens to the carriers of each bench, and when.

The cues of a bench say where its front handle stands at the start, when and in which direction it begins to walk, which
benches come abreast of it, where it is fastest, when the dragon pauses, and when and where it is done.

How each number is known: places, directions and speeds are those of trajectory() at that moment, good to 1e-11 m and
1e-11 m/s; begin, pauses and end are those of the dance's clock; for meetings see core/people/meetings.py, for turns
core/people/turns.py: the front handle begins and ends one at times between rows of places, PLACED apart; for fastest
moments core/people/fastest.py.

In a performance places, directions, speeds, pauses and ends are those of the dance of each dragon, on the clock of the
performance. Meetings are searched in rows of times so close that no head walks further than STEP between two of them,
for a chain of the handles of all dragons one after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise

import numpy as np

from core.checks import checked_count, checked_number, checked_type
from core.dance import Clock, Dance
from core.display import Readable, display
from core.errors import InvalidValue
from core.kernels import Budget
from core.language import counted, say
from core.motion.places import handle_places
from core.motion.trajectory import trajectory
from core.passages import TIME_MAX
from core.people.fastest import FastestMoment, fastest_moments
from core.people.meetings import (
    ROWS_MAX,
    STEP,
    HandleChain,
    Indices,
    MeetingColumns,
    chain_of,
    instants_at_once,
    meetings_between,
    meetings_in,
    steady_dance,
    travels_within,
)
from core.people.turns import bends_between
from core.performance import STANDING, Performance
from core.quantities import Quantity, Value, bound
from core.questions import or_about, question_about
from core.shapes.rectangles import bench_poses
from core.values import Floats, Interval, Point

# Largest gap at which a bench that comes abreast is met: by default, and at most [m].
REACH, REACH_MAX = 8.0, 1_000.0
# Largest number of benches in one question.
FOLLOWED_MAX = 1_000
# Rows of travels from one to the next in which places are found [1]: 1 m of head travel.
PLACED = 4


class Side(StrEnum):
    """Side of a bench, seen by its carriers, who look along it to its front handle.

    >>> [side.value for side in Side]
    ['left', 'right']
    """

    LEFT = "left"
    RIGHT = "right"


@dataclass(frozen=True, slots=True, repr=False)
class Stand(Readable):
    """A bench at one moment.

    time: the moment [s]
    x: x of its front handle [m]
    y: y of its front handle [m]
    s: arc length of that handle along the path [m]
    heading: direction from its rear to its front handle [rad]

    >>> from core import Dragon, Spiral
    >>> begin = bench_cues(Dance(Dragon(12), Spiral()), [5], stop=60.0)[0].begin
    >>> begin.time, round(begin.x, 3)
    (0.0, 4.256)
    """

    time: float
    x: float
    y: float
    s: float
    heading: float


@dataclass(frozen=True, slots=True, repr=False)
class Meeting(Readable):
    """Another bench comes abreast, its middle straight to the left or to the right of the middle of this bench, or
    comes nearest without that.

    time: when the other middle is abreast, to within 1e-9 m along the own bench; or when the benches are nearest [s]
    bench: the other bench; 0 is the head
    side: side on which it is, seen in the direction of the front handle
    gap: gap of the two benches then, edge to edge; at another moment it may be less; below zero: minus the depth of the
        overlap [m]
    oncoming: true if it points the other way than the own bench; false if the same way
    x: x of the own middle then [m]
    y: y of the own middle then [m]
    dragon: dragon of the other bench, in a performance; None in a single dance
    ahead: how far the other middle is ahead then, along the own bench; below zero: behind; 0: abreast [m]

    >>> from core import Dragon, Spiral
    >>> met = bench_cues(Dance(Dragon(60), Spiral()), [5], stop=60.0)[0].meetings[0]
    >>> met.bench, met.side.value, round(met.gap, 2)
    (39, 'left', 0.25)
    """

    time: float
    bench: int
    side: Side
    gap: float
    oncoming: bool
    x: float
    y: float
    dragon: int | None = None
    ahead: float = 0.0


@dataclass(frozen=True, slots=True, repr=False)
class Pause(Readable):
    """A time in which nobody walks.

    begin: its begin [s]
    end: its end [s]
    x: x of the bench's front handle [m]
    y: y of the bench's front handle [m]

    >>> from core import Dragon, Passage, Spiral
    >>> resting = Dance(Dragon(12), Spiral(), 1.0, [Passage(1.0, until_s=20.0), Passage(0.0, until_time=30.0)])
    >>> pause = bench_cues(resting, [5], stop=60.0)[0].pauses[0]
    >>> pause.begin, pause.end
    (20.0, 30.0)
    """

    begin: float
    end: float
    x: float
    y: float


@dataclass(frozen=True, slots=True, repr=False)
class Turning(Readable):
    """The front handle turns to one side.

    begin: when it begins to turn [s]
    end: when it ends [s]
    s: place where it begins, along the path [m]
    angle: angle by which it turns, to the left above zero [rad]
    heading: direction behind the turn, from the x axis [rad]
    way: places of the handle in the turn [m]

    >>> from core import Dragon, Legs
    >>> way = Legs([(0, 0), (40, 0), (40, 40)], [0, 1], radius=3.0)
    >>> turn = bench_cues(Dance(Dragon(5), way), [2])[0].turns[0]
    >>> round(turn.angle, 4)
    1.5708
    """

    begin: float
    end: float
    s: float
    angle: float
    heading: float
    way: tuple[Point, ...]


@dataclass(frozen=True, slots=True, repr=False)
class BenchCues(Readable):
    """What the carriers of a bench have to know.

    bench: number of the bench; 0 is the head
    start: where it stands when the dance starts
    begin: when and from where it begins to walk
    direction: direction in which its front handle begins to walk, from the x axis [rad]
    head_speed: speed with which the head begins to walk [m/s]
    ahead: the bench before it; None for the head
    behind: the bench behind it; None for the tail
    meetings: all meetings within the reach, in order of time
    fastest: when it is fastest
    pauses: its pauses, in order of time
    done: when and where it stops for good
    turns: its turns, in order of time

    >>> from core import Dragon, Spiral
    >>> bench_cues(Dance(Dragon(12), Spiral()), [5], stop=60.0)[0].ahead
    4
    """

    bench: int
    start: Stand
    begin: Stand
    direction: float
    head_speed: float
    ahead: int | None
    behind: int | None
    meetings: tuple[Meeting, ...]
    fastest: FastestMoment
    pauses: tuple[Pause, ...]
    done: Stand
    turns: tuple[Turning, ...] = ()

    def _line(self) -> str:
        return say(
            "bench {bench} walks from {begin} to {done}, {met}, {paused}, at most {speed}",
            bench=self.bench, begin=display(self.begin.time, "s"), done=display(self.done.time, "s"),
            met=counted(len(self.meetings), "{count} meeting", "{count} meetings"),
            paused=counted(len(self.pauses), "{count} pause", "{count} pauses"),
            speed=display(self.fastest.speed, "m/s"),
        )  # fmt: skip


@question_about("performance", Performance, "the cues were not found")
def _cues_together(
    performance: Performance,
    benches: Sequence[int] | None = None,
    *,
    dragon: int = 0,
    reach: float = REACH,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> tuple[BenchCues, ...]:
    budget = budget or Budget()
    number = checked_count("dragon", dragon, 0, len(performance.parts) - 1)
    reach = checked_number("reach", reach, "m", 0.0, REACH_MAX)
    begin, until = _performance_span(performance, start, stop)
    part = performance.parts[number]
    _refuse_one_that_stands(performance, number, begin, until)
    first, last = part.own_span(begin, until)
    own = bench_cues(part.dance, benches, reach=reach, start=first, stop=last, budget=budget)
    chain, firsts = _chain_of(performance)
    followed = [int(firsts[number]) + one.bench for one in own]
    met = meetings_in(chain, followed, _times(performance, begin, until), reach, budget)
    meetings = _meetings(chain, met, budget, firsts=firsts)
    return tuple(
        replace(_later(one, part.delay, begin), meetings=tuple(meetings.get(k, ())))
        for k, one in zip(followed, own, strict=True)
    )


@or_about(Performance, _cues_together)
@question_about("dance", (Dance, Performance), "the cues were not found")
def bench_cues(
    dance: Dance,
    benches: Sequence[int] | None = None,
    *,
    dragon: int = 0,
    reach: float = REACH,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> tuple[BenchCues, ...]:
    """The cues of some benches, in the order of the list.

    benches: at most FOLLOWED_MAX numbers, 0 for the head; None: all benches; reach: largest gap of a meeting [m]
    dragon: its number in a Performance, whose meetings have the number of the other dragon; benches that stand before
        or after their dance are met too
    start, stop: of the dance, see Dance.span(), or of the performance [s], on whose clock all times then are
    raises: InvalidValue, also for a dance up to a fold, where speeds grow without bound, and for one in which the head
        never walks; OutsideRun; TooMuchWork

    >>> from core import Arc, Dragon, Line, Route
    >>> there = Line((0.0, 0.0), (40.0, 0.0))
    >>> turn = Arc((40.0, 2.0), 2.0, -1.5707963267948966, 3.141592653589793)
    >>> dance = Dance(Dragon(12), Route([there, turn, Line((40.0, 4.0), (0.0, 4.0))], start=30.0))
    >>> cues = bench_cues(dance, [5])[0]
    >>> met = cues.meetings[0]
    >>> met.bench, met.side.value, round(met.time, 2), round(met.gap, 3), met.oncoming
    (0, 'left', 19.09, 3.699, True)
    """
    checked_count("dragon", dragon, 0, 0)
    followed = _checked_benches(dance, benches)
    reach = checked_number("reach", reach, "m", 0.0, REACH_MAX)
    begin, until = _span(dance, start, stop)
    walks = [one for one in dance.clock.periods(begin, until) if one.speed > 0.0]
    if not walks:
        values = {"got": Quantity(until, "s"), "begin": Quantity(begin, "s", 9)}
        raise InvalidValue("stop", "must be after the head begins to walk: it stands still from {begin} on", **values)
    budget, steady = budget or Budget(), steady_dance(dance)
    travels = travels_within(steady, walks[0].first, walks[-1].last)
    met = meetings_between(steady, followed, travels, reach, budget)
    fastest = fastest_moments(steady, followed, walks, budget)
    rests = [(a.end, b.begin) for a, b in pairwise(walks) if b.begin > a.end]
    # In the order in which the loop below takes them: start, begin, done, and each pause.
    moments = [begin, walks[0].begin, walks[-1].end, *(end for end, _ in rests)]
    stands = _stands(dance, followed, moments, budget)
    meetings = _meetings(chain_of(steady), met, budget, dance.clock.time)
    directions = _directions(steady, followed, float(travels[0]), budget)
    ways = {bench: (at[1], at[2]) for bench, at in zip(followed, stands, strict=True)}
    turns = _turns(steady, dance.clock, ways, travels, budget)
    cues = []
    for k, bench in enumerate(followed):
        at_start, at_begin, at_end, *at_rests = stands[k]
        pauses = tuple(Pause(*rest, at.x, at.y) for rest, at in zip(rests, at_rests, strict=True))
        neighbours = bench - 1 if bench else None, bench + 1 if bench + 1 < dance.dragon.benches else None
        first = (at_start, at_begin, directions[k], walks[0].speed)
        own = tuple(meetings.get(bench, ()))
        cues.append(BenchCues(bench, *first, *neighbours, own, fastest[k], pauses, at_end, turns[bench]))
    return tuple(cues)


def _checked_benches(dance: Dance, benches: Sequence[int] | None) -> list[int]:
    """The benches to follow. raises: InvalidValue"""
    count = dance.dragon.benches
    if benches is not None:
        checked_type("benches", benches, (list, tuple, range))
    followed = list(range(count)) if benches is None else [*benches]
    if not 1 <= len(followed) <= FOLLOWED_MAX:
        rule = "must name from 1 to {most} benches"
        raise InvalidValue("benches", rule, got=len(followed), most=FOLLOWED_MAX)
    return [checked_count(f"benches.{k}", bench, 0, count - 1) for k, bench in enumerate(followed)]


def _span(dance: Dance, start: float | None, stop: float | None) -> Interval:
    """Start and stop of the dance [s]. raises: InvalidValue, OutsideRun"""
    stop = None if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
    if dance.ends_by(dance.end.time if stop is None else stop):
        values = {"end": bound(dance.end.time, 9, "s"), **dance.end.values}
        if stop is None:
            rule = "must be given: it must be before {end}, when bench {bench} folds and speeds grow without bound"
            raise InvalidValue("stop", rule, **values)
        rule = "must be before {end}, when bench {bench} folds and speeds grow without bound"
        raise InvalidValue("stop", rule, got=Quantity(stop, "s"), **values)
    return dance.span(start, stop)


def _stands(dance: Dance, benches: list[int], times: list[float], budget: Budget) -> list[list[Stand]]:
    """For each of the benches, where it stands at each of the times [s]."""
    position = trajectory(dance, times, budget=budget).position
    places, headings = handle_places(dance, times, budget=budget), bench_poses(position)[..., 2]
    return [
        [
            Stand(
                time,
                float(position[row, k, 0]),
                float(position[row, k, 1]),
                float(places[row, k]),
                float(headings[row, k]),
            )
            for row, time in enumerate(times)
        ]
        for k in benches
    ]


def _directions(steady: Dance, benches: list[int], travel: float, budget: Budget) -> list[float]:
    """Directions in which the front handles walk at a travel of the head [rad]."""
    velocity = trajectory(steady, [travel], budget=budget).velocity[0, benches]
    directions: list[float] = np.arctan2(velocity[:, 1], velocity[:, 0]).tolist()
    return directions


def _turns(
    steady: Dance, clock: Clock, ways: dict[int, tuple[Stand, Stand]], travels: Floats, budget: Budget
) -> dict[int, tuple[Turning, ...]]:
    """The turns of each bench on the way of its front handle, which begins and ends somewhere."""
    path, benches = steady.path, list(ways)
    bends = bends_between(path, min(a.s for a, _ in ways.values()), max(b.s for _, b in ways.values()))
    turns, at_once = dict[int, tuple[Turning, ...]](), instants_at_once(steady)
    if not bends:
        return dict.fromkeys(benches, ())
    rows = np.append(travels[:-1:PLACED], travels[-1])
    blocks = (rows[first : first + at_once] for first in range(0, len(rows), at_once))
    places = np.concatenate([handle_places(steady, some, budget=budget)[:, benches] for some in blocks])
    for k, (bench, (a, b)) in enumerate(ways.items()):
        budget.look()
        own = list[Turning]()
        for bend in bends:
            first, last = max(bend.first, a.s), min(bend.last, b.s)
            if first >= last:
                continue
            whole = (first, last) == (bend.first, bend.last)
            for one in [bend] if whole else bends_between(path, first, last):
                ends = [clock.time(float(np.interp(s, places[:, k], rows))) for s in (one.first, one.last)]
                own.append(Turning(ends[0], ends[1], one.first, one.angle, one.heading, one.way))
        turns[bench] = tuple(own)
    return turns


def _performance_span(performance: Performance, start: float | None, stop: float | None) -> Interval:
    """Start and stop [s]. raises: InvalidValue, OutsideRun"""
    begin, until = performance.span(start, stop)
    folds = performance.end.dragon
    if folds is not None and performance.parts[folds].dance.ends_by(until - performance.parts[folds].delay):
        values: dict[str, Value] = {"end": bound(performance.end.time, 9, "s"), "why": performance.ending}
        if stop is None:
            rule = "must be given: it must be before {end}, when {why} and speeds grow without bound"
            raise InvalidValue("stop", rule, **values)
        rule = "must be before {end}, when {why} and speeds grow without bound"
        raise InvalidValue("stop", rule, got=Quantity(until, "s"), **values)
    return begin, until


def _refuse_one_that_stands(performance: Performance, dragon: int, begin: float, until: float) -> None:
    """raises: InvalidValue for a dragon that never walks between two times of the performance [s]"""
    part = performance.parts[dragon]
    first, last = part.own_time(begin), part.own_time(until)
    walks = (one.end - one.begin for one in part.dance.clock.periods(first, last) if one.speed > 0.0)
    if last - first < STANDING or not any(walks):
        rule = "must be after dragon {dragon} begins to walk: it stands still from {begin} on"
        raise InvalidValue("stop", rule, got=Quantity(until, "s"), dragon=dragon, begin=Quantity(begin, "s", 9))


def _times(performance: Performance, begin: float, until: float) -> Floats:
    """Times so close that no head walks further than STEP between two of them [s]."""
    speeds = [part.dance.head_speed for part in performance.parts]
    speeds += [one.speed for part in performance.parts for one in part.dance.passages]
    return np.linspace(begin, until, min(ROWS_MAX, int((until - begin) * max(speeds) / STEP) + 2))


def _chain_of(performance: Performance) -> tuple[HandleChain, Indices]:
    """The chain of all dragons, and the number of the first bench of each in it."""
    dragons = [part.dance.dragon for part in performance.parts]
    ends = np.cumsum([dragon.benches + 1 for dragon in dragons])
    sizes = [
        np.concatenate([np.stack([dragon.lengths, dragon.widths], axis=-1), np.zeros((1, 2))]) for dragon in dragons
    ]

    def place(times: Floats, budget: Budget) -> Floats:
        results = trajectory(performance, times, budget=budget)
        return np.concatenate([one.position for one in results], axis=1)

    gaps: Indices = (ends[:-1] - 1).astype(np.intp)
    return HandleChain(place, np.concatenate(sizes)[:-1], gaps), np.concatenate([[0], ends[:-1]]).astype(np.intp)


def _meetings(
    chain: HandleChain,
    met: MeetingColumns,
    budget: Budget,
    time_of: Callable[[float], float] = float,
    firsts: Indices | None = None,
) -> dict[int, list[Meeting]]:
    """The meetings of each bench, by its number in the chain.

    time_of: time of a travel; firsts: number of the first bench of each dragon in a chain of several
    """
    meetings = dict[int, list[Meeting]]()
    for block in range(0, met.own.size, chain.at_once):
        some = slice(block, block + chain.at_once)
        position = chain.place(met.travel[some], budget)
        rows, own, other = np.arange(len(position)), met.own[some], met.other[some]
        middles = 0.5 * (position[rows, own] + position[rows, own + 1])
        dragons: list[int] | list[None] = [None] * len(rows)
        if firsts is not None:
            numbers = np.searchsorted(firsts, other, side="right") - 1
            dragons, other = numbers.tolist(), other - firsts[numbers]
        columns = own, met.travel[some], other, met.left[some], met.gap[some], met.cosine[some], met.ahead[some]
        for (k, moment, bench, left, gap, cosine, ahead), (x, y), dragon in zip(
            zip(*(column.tolist() for column in columns), strict=True), middles.tolist(), dragons, strict=True
        ):
            side = Side.LEFT if left > 0.0 else Side.RIGHT
            meeting = Meeting(time_of(moment), bench, side, gap, cosine < 0.0, x, y, dragon, ahead)
            meetings.setdefault(k, []).append(meeting)
    return meetings


def _later(cues: BenchCues, delay: float, begin: float) -> BenchCues:
    """The cues on the clock of the performance, which begins at a time [s]: a dragon stands from then on."""

    def later(at: Stand) -> Stand:
        return replace(at, time=at.time + delay)

    pauses = tuple(replace(one, begin=one.begin + delay, end=one.end + delay) for one in cues.pauses)
    turns = tuple(replace(one, begin=one.begin + delay, end=one.end + delay) for one in cues.turns)
    fastest = replace(cues.fastest, time=cues.fastest.time + delay)
    start = replace(cues.start, time=begin)
    begins, done = later(cues.begin), later(cues.done)
    return replace(cues, start=start, begin=begins, done=done, fastest=fastest, pauses=pauses, turns=turns)

"""Cues of a performance: those of each dance, and the benches of all dragons that come abreast.

Places, directions, speeds, pauses and ends are those of the dance of each dragon (cues.py), on the clock of the
performance. Meetings are searched as for one dragon (meetings.py), in rows of times so close that no head walks further
than STEP between two of them, for a chain of the handles of all dragons one after the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.errors import InvalidValue, Quantity, Value, bound, checked_count, checked_number, question_about
from core.kernels import Budget
from core.people.cues import REACH, REACH_MAX, BenchCues, Meeting, Side, Stand, bench_cues
from core.people.meetings import ROWS_MAX, STEP, Chain, Indices, MeetingColumns, meetings_in
from core.performance.performance import STANDING, Performance
from core.performance.verdict import performance_trajectory
from core.values import Floats


@question_about("performance", Performance, "the cues were not found")
def performance_cues(
    performance: Performance,
    dragon: int,
    benches: Sequence[int] | None = None,
    *,
    reach: float = REACH,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> tuple[BenchCues, ...]:
    """The cues of some benches of one dragon, in the order of the list; all times are those of the performance.

    dragon: its number; benches, reach: as for bench_cues(); start, stop: [s], None for the beginning and the end
    A meeting has the number of the other dragon. A bench that stands before its dance, or after it, is met too.
    raises: InvalidValue, also up to a fold, where speeds grow without bound, and for a dragon that never walks;
        OutsideRun; TooMuchWork

    >>> from core import Dance, Dragon, Line, Part, Route
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((40.0, 3.0), (0.0, 3.0))]
    >>> passing = Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes])
    >>> met = performance_cues(passing, 0, [0])[0].meetings[0]
    >>> met.dragon, met.bench, met.side.value, round(met.gap, 2), met.oncoming
    (1, 0, 'left', 2.7, True)
    """
    budget = budget or Budget()
    number = checked_count("dragon", dragon, 0, len(performance.parts) - 1)
    reach = checked_number("reach", reach, "m", 0.0, REACH_MAX)
    begin, until = _span(performance, start, stop)
    part = performance.parts[number]
    _refuse_one_that_stands(performance, number, begin, until)
    first, last = part.own_span(begin, until)
    own = bench_cues(part.dance, benches, reach=reach, start=first, stop=last, budget=budget)
    chain, firsts = _chain_of(performance)
    followed = [int(firsts[number]) + one.bench for one in own]
    met = meetings_in(chain, followed, _times(performance, begin, until), reach, budget)
    meetings = _meetings(chain, firsts, met, budget)
    return tuple(
        replace(_later(one, part.delay, begin), meetings=tuple(meetings.get(k, ())))
        for k, one in zip(followed, own, strict=True)
    )


def _span(performance: Performance, start: float | None, stop: float | None) -> tuple[float, float]:
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


def _chain_of(performance: Performance) -> tuple[Chain, Indices]:
    """The chain of all dragons, and the number of the first bench of each in it."""
    dragons = [part.dance.dragon for part in performance.parts]
    ends = np.cumsum([dragon.benches + 1 for dragon in dragons])
    sizes = [
        np.concatenate([np.stack([dragon.lengths, dragon.widths], axis=-1), np.zeros((1, 2))]) for dragon in dragons
    ]

    def place(times: Floats, budget: Budget) -> Floats:
        results = performance_trajectory(performance, times, budget=budget)
        return np.concatenate([one.position for one in results], axis=1)

    gaps: Indices = (ends[:-1] - 1).astype(np.intp)
    return Chain(place, np.concatenate(sizes)[:-1], gaps), np.concatenate([[0], ends[:-1]]).astype(np.intp)


def _meetings(chain: Chain, firsts: Indices, met: MeetingColumns, budget: Budget) -> dict[int, list[Meeting]]:
    """The meetings of each bench, by its number in the chain."""
    meetings = dict[int, list[Meeting]]()
    for block in range(0, met.own.size, chain.at_once):
        some = slice(block, block + chain.at_once)
        position = chain.place(met.travel[some], budget)
        rows, own, other = np.arange(len(position)), met.own[some], met.other[some]
        x, y = (0.5 * (position[rows, own] + position[rows, own + 1])).T
        dragons = np.searchsorted(firsts, other, side="right") - 1
        columns = (
            own,
            met.travel[some],
            other - firsts[dragons],
            met.left[some],
            met.gap[some],
            met.cosine[some],
            x,
            y,
            dragons,
            met.ahead[some],
        )
        for k, time, bench, left, gap, cosine, *rest in zip(*(column.tolist() for column in columns), strict=True):
            side = Side.LEFT if left > 0.0 else Side.RIGHT
            meetings.setdefault(k, []).append(Meeting(time, bench, side, gap, cosine < 0.0, *rest))
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

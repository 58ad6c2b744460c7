"""The sentences of a safety sheet, for laymen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

import core
from app.plan.safety_answer import Lane, SafetySheet
from app.plan.timing import TimeFormat
from app.wire.readings import bench_words
from core.language import Listed, counted, joined, phrase, say, sense
from core.quantities import format_bound, format_number
from core.values import Interval

# Most times in a lane that a sheet names.
STAYS_NAMED = 4
# Heading and sentences of a part of a sheet.
Part = tuple[str, list[str]]


def benches_words(benches: Sequence[int], dragons: Sequence[int], performance: core.Performance) -> list[str]:
    """Benches as people call them, with the name of the dragon where there are several."""
    words = [bench_words(bench, performance.parts[k].dance.dragon) for bench, k in zip(benches, dragons, strict=True)]
    if len(performance.parts) == 1:
        return words
    return [
        say("{bench} of {name}", bench=one, name=performance.name_of(k)) for one, k in zip(words, dragons, strict=True)
    ]


def carrier_words(handle: int, dragon: core.Dragon) -> str:
    """Where whoever carries a handle walks."""
    if handle == 0:
        return say("at the front of the head")
    if handle == dragon.benches:
        return say("at the rear end of the dragon")
    a, b = (bench_words(bench, dragon) for bench in (handle - 1, handle))
    return say("between {a} and {b}", a=a, b=b)


def parts_on_ground(
    answer: SafetySheet, performance: core.Performance, clock: TimeFormat, spectators: float
) -> list[Part]:
    """Heading and sentences of the parts about ground, lanes and gates. spectators: distance of people [m]"""
    parts = [(say("Ground"), _ground_words(answer, spectators))]
    lanes = [lane_words(one, clock) for one in answer.lanes] or [say("The organiser has named no lane.")]
    parts.append((say("Lanes to keep free"), lanes))
    return [*parts, (say("Gates and leaving"), _gate_words(answer, performance, clock))]


def part_on_stopping(answer: SafetySheet, performance: core.Performance, clock: TimeFormat, stopper: str) -> Part:
    """Heading and sentences of the part about the fastest carriers, and about who stops the dance."""
    lines = list[str]()
    if answer.fastest is not None and answer.stopping is not None:
        fastest, (x, y) = answer.fastest, (one + 0.0 for one in np.round(answer.fastest.point, 1))
        where = carrier_words(fastest.handles[0], performance.parts[fastest.dragon].dance.dragon)
        if len(performance.parts) > 1:
            where = say("{bench} of {name}", bench=where, name=performance.name_of(fastest.dragon))
        lines = [
            say("Fastest: {where}, with {speed:.2f} m/s ({hourly:.1f} km/h) at {time}, at x {x:.1f} m, y {y:.1f} m.",
                where=where, speed=fastest.speed, hourly=3.6 * fastest.speed, time=clock.words(fastest.time), x=x, y=y),
            say("After the call to stop everybody stands within {reaction} s, and nobody goes further than {way} m.",
                reaction=format_number(answer.stopping.reaction),
                way=format_bound(answer.stopping.distance, 1, up=True)),
        ]  # fmt: skip
    else:
        lines = [say("Near the fold speeds grow without bound: nothing says how far people go on after “stop”.")]
    signal = say("Everybody knows this signal to stop: {line}", line="_" * 24)
    return say("Speed and stop"), [*lines, say("Who stops the dance: {name}", name=stopper or "_" * 24), signal]


def cautions(answer: SafetySheet, *, nobody_strays: bool) -> list[str]:
    """What a reader of the verdict must not overlook, in a sentence; nothing where there is nothing.

    nobody_strays: True if it rests on people who never leave their places, which is only assumed
    """
    used = [one for one in answer.lanes if one.stays]
    notes = [
        *([say("nobody leaves their place, which is only assumed")] if nobody_strays else []),
        *(say("benches are in “{name}” for {seconds:.0f} s", name=one.name, seconds=one.total) for one in used),
        *([say("people can be hit if the last benches are let go")] if answer.loose_tail.beyond_spectators else []),
    ]
    return [say("Not to be overlooked: {list}.", list=say("; ").join(notes))] if notes else []


def _ground_words(answer: SafetySheet, spectators: float) -> list[str]:
    tail, away = answer.loose_tail, format_number(spectators)
    return [
        say("Benches sweep {area:.0f} m2; people, and barriers, stand outside the dashed line of the map, {away} m and "
            "more from that ground.", area=answer.swept.area, away=away),
        counted(tail.benches, "The last bench, let go, comes at most {reach} m from its front handle.",
                "The last {count} benches, let go, come at most {reach} m from the front handle of the first of them.",
                reach=format_bound(tail.reach, 1, up=True)),
        *([say("That is beyond the line behind which people stand: whoever stands within the dotted line of the map "
               "can be hit if they let go, and nobody behind it.")] if tail.beyond_spectators else []),
        say("Nothing is counted on to stop them, neither walls nor other benches."),
    ]  # fmt: skip


def _gate_words(answer: SafetySheet, performance: core.Performance, clock: TimeFormat) -> list[str]:
    several, lines = len(performance.parts) > 1, list[str]()
    counts, passed = Counter((one.dragon, one.name) for one in answer.gates), Counter[tuple[int, str]]()
    for one in answer.gates:
        at = one.dragon, one.name
        count, earlier = counts[at], passed[at]
        passed[at] += 1
        if 0 < earlier < count - 1:
            continue
        words = say(
            "{name}: head {head}, tail {tail}", name=one.name, head=clock.words(one.head), tail=clock.words(one.tail)
        )
        if one.lasts is not None:
            words += say(", {seconds:.0f} s to pass", seconds=one.lasts)
        if count > 2:
            nth = phrase(" (first of {count} times)") if earlier == 0 else phrase(" (last of {count} times)")
            words += say(nth, count=count)
        lines.append(say("{name}: {text}", name=performance.name_of(one.dragon), text=words) if several else words)
    for k, part in enumerate(performance.parts):
        length, speed = float(part.dance.dragon.chords.sum()), part.dance.head_speed
        words = say(
            "From head to tail it is {length:.1f} m long: at {speed} m/s it needs about {seconds:.0f} s to pass a "
            "place, or to leave by a gate.",
            length=length, speed=format_number(speed), seconds=length / speed,
        )  # fmt: skip
        lines.append(say("{name}: {text}", name=performance.name_of(k), text=words) if several else words)
    return lines


def lane_words(lane: Lane, clock: TimeFormat) -> str:
    """What is known of a lane, in sentences."""
    loose = [say("The last benches, let go, can reach it.")] if lane.in_loose_reach else []
    return joined([_stays_words(lane, clock), *loose])


def _stays_words(lane: Lane, clock: TimeFormat) -> str:
    name, width = lane.name, format_number(lane.width)
    if not lane.stays:
        return say("{name}, {width} m wide: no bench is ever in it.", name=name, width=width)
    times = together([(one.begin, one.end) for one in lane.stays])
    stays = Listed(
        say("from {start} to {stop}", start=clock.words(begin), stop=clock.words(end))
        for begin, end in times[:STAYS_NAMED]
    )
    more = say(" and later") if len(times) > STAYS_NAMED else ""
    words = say(
        "{name}, {width} m wide: benches are in it {stays}{more}, {seconds:.0f} s in all.",
        name=name, width=width, stays=stays, more=more, seconds=lane.total,
    )  # fmt: skip
    free = format_bound(lane.free_width, 1)
    if float(free):
        return joined([words, say("At least {free} m of its width stay free.", free=free)])
    return joined([words, say("Then no part of its width is sure to be free.")])


def together(times: Sequence[Interval]) -> list[Interval]:
    """Intervals in order, those that overlap as one.

    >>> together([(4.0, 6.0), (0.0, 1.0), (5.0, 7.0)])
    [(0.0, 1.0), (4.0, 7.0)]
    """
    whole = list[Interval]()
    for begin, end in sorted(times):
        if whole and begin <= whole[-1][1]:
            begin, last = whole.pop()
            end = max(end, last)
        whole.append((begin, end))
    return whole


def passed_words(margin: float, speed_limit: float | None, stray: float, venue: bool) -> str:
    """That the dance passes, for a layman. margin, stray: [m]; speed_limit: [m/s]"""
    least, parts = format_number(margin), list[str]()
    match bool(margin), venue:
        case False, False:
            parts = [say("no bench touches another")]
        case False, True:
            parts = [say("no bench touches another, an edge or an obstacle of the square")]
        case True, False:
            parts = [say("no bench comes within {margin} m of another", margin=least)]
        case True, True:
            parts = [
                say("no bench comes within {margin} m of another, an edge or an obstacle of the square", margin=least)
            ]
    if speed_limit is not None:
        parts.append(say("nobody is faster than {limit} m/s", limit=format_number(speed_limit)))
    if stray:
        parts.append(say("as long as everybody is within {stray} m of their place", stray=format_number(stray)))
    return say("It can be danced: {facts}.", facts=sense("clauses", ", ").join(parts))


def known_words() -> str:
    """How a verdict that passes is known, for a layman."""
    return say(
        "This is proven by computation for every instant, for benches, path and speeds as they stand below; "
        "whoever dances otherwise is not covered by it."
    )

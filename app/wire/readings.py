"""What answers say to people, each in some sentences of the language that is spoken."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import core
from core.contact.answer import Outcome
from core.dance import EndReason
from core.design.deepest_turn import TurnLimit
from core.design.pitch_search import JustifiedBy, LimitedBy
from core.failures import FailureKind, approach_words, area_approach_words, contact_failures, encounter_failures
from core.language import Language, Listed, Phrases, counted, phrase, say, spoken
from core.paths.clothoid_turn import ClothoidTurn
from core.paths.turn import Turn
from core.quantities import format_bound, format_number
from core.tolerance.tolerance import Limit

# What a smaller pitch leads to.
PITCH_LIMITS: Phrases = {
    LimitedBy.GRAZE: "At a smaller pitch {pair} {meet} on the way, the head {radius:.2f} m from the centre.",
    LimitedBy.CIRCLE: "At a smaller pitch {pair} {meet} just as the head reaches the circle.",
    LimitedBy.START: "At a smaller pitch the dance would begin inside the circle, or benches {meet} at its start.",
    LimitedBy.FOLD: "At a smaller pitch {bench} cannot follow the spiral until the head is on the circle.",
}
# What keeps a turn from being shorter.
TURN_LIMITS: Phrases = {
    TurnLimit.LEAST_RADIUS: (
        "Limited by the least radius of a bend that is taken here: half of the longest distance of two handles and 0.1 "
        "% more, at which every bench can follow."
    ),
    TurnLimit.FOLLOWING: (
        "Limited by what benches can follow, or by contact: in each turn of this ratio that is excluded, a bench would "
        "jump, go backwards or stand across the path, or benches {meet}."
    ),
    TurnLimit.CIRCLE: "Limited by the circle, where it begins or ends.",
    TurnLimit.CONTACT: "Limited by contact: in turns beside it benches {meet}.",
    TurnLimit.UNDECIDED: "Rounding hides whether benches {meet} in a shorter turn.",
    TurnLimit.CENTRE: "There is no limit down to the deepest tried entry.",
}
# What limits the stray of people.
STRAY_LIMITS: Phrases = {
    Limit.BENCHES: "Limited by {a} and {b}, which are nearest to a contact at {time:.2f} s.",
    Limit.VENUE: "Limited by {a} and {area}, which are nearest to a contact at {time:.2f} s.",
    Limit.CHORD: "There is no limit up to half of the shortest chord.",
}
# A part of a path before the head that is worth a word [m].
STANDS = 0.05
# A time that is not shown as 0 [s].
INSTANT = 0.005


def bench_words(bench: int, dragon: core.Dragon) -> str:
    """A bench as people call it."""
    words = say("the head") if bench == 0 else say("the tail") if bench == dragon.benches - 1 else ""
    words = words or say("body {k}", k=bench)
    name = dragon.names[bench] if dragon.names else ""
    return say("{words} ({name})", words=words, name=name) if name else words


def _sentence(template: str, **values: object) -> str:
    words = say(template, **values)
    return words if spoken() is Language.CHINESE else words[:1].upper() + words[1:]


def contact_words(result: core.FirstContact) -> list[str]:
    """Where two benches first meet, or until when none do."""
    dragon, end = result.dance.dragon, result.end
    meet = approach_words(result.margin, result.stray)
    if result.outcome is Outcome.UNDECIDED:
        return [failure.message for failure in contact_failures(result, result.margin)]
    if result.benches is not None and result.point is not None and result.head is not None:
        gap, (a, b), (x, y) = result.gap or 0.0, (bench_words(k, dragon) for k in result.benches), result.point
        met = phrase("{a} and {b} meet at ({x:.2f}, {y:.2f}) m.")
        if result.stray:
            met = phrase(
                "{a} and {b} {meet} from then on, near ({x:.2f}, {y:.2f}) m; between their places there is a gap of "
                "{gap:.3f} mm."
            )
        elif gap < 0.0:
            met = phrase("{a} and {b} overlap by {depth:.3f} mm at ({x:.2f}, {y:.2f}) m.")
        elif result.margin:
            met = phrase("{a} and {b} {meet} at ({x:.2f}, {y:.2f}) m, with a gap of {gap:.3f} mm.")
        millimetres = {"gap": 1000.0 * gap, "depth": -1000.0 * gap}
        words = [_sentence(met, a=a, b=b, meet=meet, x=x, y=y, **millimetres)]
        if result.head.theta is not None:
            words.append(say("The head is {radius:.2f} m from the centre.", radius=result.head.radius))
        return words
    if end is None or end.reason is EndReason.STOP:
        return [say("No two benches {meet} in this part of the dance.", meet=meet)]
    none = say("No two benches {meet} before the run ends at {time:.2f} s.", meet=meet, time=end.time)
    if end.reason is not EndReason.FOLD or end.bench is None:
        return [none]
    bench = bench_words(end.bench, dragon)
    return [none, say("The dance fails there, where {bench} can no longer follow the path.", bench=bench)]


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits that a dance has to keep: margin, stray [m]; speed [m/s]; square: name of the area around it"""

    margin: float
    stray: float
    speed: float | None
    square: str | None


def encounter_words(failure: core.PerformanceFailure, performance: core.Performance, limits: Limits) -> str:
    """Which benches of two dragons come too near, without the time."""
    if len(failure.dragons) < 2:
        return failure.message
    a, b = (
        say(
            "{bench} of {name}",
            bench=bench_words(bench, performance.parts[k].dance.dragon),
            name=performance.name_of(k),
        )
        for k, bench in zip(failure.dragons, failure.benches, strict=True)
    )
    meet = approach_words(limits.margin, limits.stray)
    return _sentence(phrase("{a} and {b} {meet}."), a=a, b=b, meet=meet)


def met_words(result: core.FirstEncounter) -> list[str]:
    """Which benches of two dragons first come too near, or that none do."""
    limits = Limits(result.margin, result.stray, None, None)
    if failures := encounter_failures(result):
        return [encounter_words(failure, result.performance, limits) for failure in failures]
    return [say("No two dragons {meet}.", meet=approach_words(result.margin, result.stray))]


def dragons_failure_words(failure: core.PerformanceFailure, performance: core.Performance, limits: Limits) -> str:
    """What fails, without its time, with the names of the dragons."""
    if failure.failure is None:
        return encounter_words(failure, performance, limits)
    k = failure.dragons[0]
    text = failure_words(failure.failure, performance.parts[k].dance.dragon, limits)
    return say("{name}: {text}", name=performance.name_of(k), text=text)


def failure_words(failure: core.Failure, dragon: core.Dragon, limits: Limits) -> str:
    """What fails, without its time."""
    near, area = (limits.margin, limits.stray), failure.area or ""
    names = [bench_words(min(bench, dragon.benches - 1), dragon) for bench in failure.benches]
    peak = failure.peak_speed
    values = {"area": area, "peak": peak, "limit": limits.speed, "meet": ""}
    match failure.kind:
        case FailureKind.CONTACT if not limits.margin or failure.time_bracket:
            template, values["meet"] = phrase("{a} and {b} {meet}."), approach_words(*near)
        case FailureKind.VENUE:
            template, values["meet"] = phrase("{a} {meet}."), area_approach_words(*near, area)
        case FailureKind.OUTSIDE if failure.area == limits.square:
            template = phrase("{a} starts outside {area}.")
        case FailureKind.OUTSIDE:
            template = phrase("{a} starts inside {area}.")
        case FailureKind.SPEED if names and peak is None:
            template = phrase("Too fast: {a} exceeds {limit:g} m/s.")
        case FailureKind.SPEED if names:
            template = phrase("Too fast: {a} exceeds {limit:g} m/s; the highest speed is {peak:.2f} m/s.")
        case FailureKind.FOLDS:
            template = phrase("{a} cannot follow any more: the dragon folds.")
        case _:
            return failure.message
    return _sentence(template, **dict(zip("ab", names, strict=False)), **values)


def has_drawn_path(dance: core.Dance) -> bool:
    """True for a path that is neither a spiral nor a turn, so that somebody chose where it begins and ends."""
    return dance.path.spiral is None and not isinstance(dance.path, Turn | ClothoidTurn)


def way_words(dance: core.Dance, start: float, stop: float, begins: str | None) -> list[str]:
    """How far the head walks on a drawn path from start to stop [s], and where the dragon stands before.

    begins: time of day at start; None if it is not known
    """
    if not has_drawn_path(dance):
        return []
    path, (first, last) = dance.path, map(dance.clock.travel, (start, stop))
    time, length = f"{stop - start:.1f}", f"{path.end - path.begin:.1f}"
    if float(time) == 0.0:
        return [say("The path is {length} m long.", length=length)]
    way = phrase("The head walks {way} m in {time} s.")
    if begins is None and abs(start) >= INSTANT:
        way = phrase("The head walks {way} m in {time} s, from {from} s to {to} s on the time line.")
    values = {"way": f"{last - first:.1f}", "time": time, "from": f"{start:.2f}", "to": f"{stop:.2f}"}
    words, stands = [say(way, **values)], first - path.begin
    if stands >= STANDS:
        before = phrase("At the start the dragon stands on the first {stands} m of its path of {length} m.")
        words.append(say(before, stands=f"{stands:.1f}", length=length))
    return words


def day_words(begins: str | None, ends: str | None) -> list[str]:
    """At which times of day a dance starts and ends; none without a clock."""
    return [say("It starts at {start} and ends at {end}.", start=begins, end=ends)] if begins else []


def pitch_words(
    result: core.MinimumPitch, dragon: core.Dragon, diameter: float, margin: float, stray: float
) -> list[str]:
    """What the minimum pitch is good for, and what limits it. diameter: of the circle; margin, stray: [m]"""
    meet = approach_words(margin, stray)
    reaches = phrase("At every larger pitch the head reaches the circle of {diameter} m, and no two benches {meet}.")
    if result.justified_by is JustifiedBy.SCAN:
        reaches = phrase(
            "At every larger pitch that was tried the head reaches the circle of {diameter} m, and no two benches "
            "{meet}."
        )
    pair = ""
    if result.benches is not None:
        a, b = (bench_words(bench, dragon) for bench in result.benches)
        pair = say("{a} and {b}", a=a, b=b)
        if result.dragons is not None:
            pair = say("{a} of dragon 0 and {b} of dragon {k}", a=a, b=b, k=result.dragons[1])
    bench = "" if result.bench is None else bench_words(result.bench, dragon)
    limit = say(PITCH_LIMITS[result.limited_by], pair=pair, meet=meet, radius=result.head_radius or 0.0, bench=bench)
    words = [say(reaches, diameter=format_number(diameter), meet=meet), limit]
    if result.other_feasible_intervals:
        ranges = Listed(f"{low:.6f}–{high:.6f} m" for low, high in result.other_feasible_intervals)
        words.append(say("Smaller pitches that also work: {list}", list=ranges))
    return words


def turn_words(turn: core.Turn | core.ClothoidTurn) -> str:
    """Where a turn enters and leaves."""
    template = phrase("It enters {entry:.6f} m from the centre and leaves {exit:.6f} m from it.")
    return say(template, entry=turn.entry_radius, exit=turn.exit_radius)


def limit_words(limit: TurnLimit, margin: float, stray: float) -> str:
    """What keeps a turn from being shorter. margin, stray: [m]"""
    return say(TURN_LIMITS[limit], meet=approach_words(margin, stray))


def time_words(result: core.TurnTime, limit: float) -> str:
    """How far and how fast the head goes through a turn. limit: of the speed of every handle [m/s]"""
    template = phrase(
        "{length:.6f} m, with the head at {speed:.6f} m/s, the most at which no handle exceeds {limit} m/s."
    )
    return say(template, length=result.length, speed=result.head_speed, limit=format_number(limit))


def handles_words(handles: Sequence[int]) -> str:
    return counted(len(handles), "handle {list}", "handles {list}", list=Listed(handles))


def head_words(result: core.MaximumHeadSpeed, limit: float) -> list[str]:
    """What the highest speed of the head means. limit: [m/s]"""
    template = phrase(
        "At this speed of the head no handle exceeds {limit} m/s; it is reached at {time:.6f} s by {handles}."
    )
    handles = handles_words(result.handles)
    return [say(template, limit=format_number(limit), time=result.time, handles=handles)]


def speed_words(result: core.HighestSpeed) -> str:
    """Whose the highest speed is, and when."""
    if 0 in result.handles:
        return say("No handle is ever faster than the head.")
    return say("Reached at {time:.6f} s by {handles}.", time=result.time, handles=handles_words(result.handles))


def stray_words(result: core.Tolerance, dragon: core.Dragon, diameter: float | None) -> list[str]:
    """How far people may stray, and what limits it. diameter: of the circle to which the question goes [m]"""
    a, b = (None if one is None else bench_words(one, dragon) for one in result.benches or (None, None))
    values = {"a": a, "b": b, "area": result.area, "time": result.time or 0.0}
    if result.stray > 0.0:
        safe = phrase(
            "In this part of the dance everybody may be {stray} cm from their place at any time, the play in the "
            "joints included, and nothing touches."
        )
        if diameter is not None:
            safe = phrase(
                "Until the head is on the circle of {diameter} m, everybody may be {stray} cm from their place at any "
                "time, the play in the joints included, and nothing touches."
            )
        stray = format_bound(100.0 * result.stray, 2)
        first = say(safe, stray=stray, diameter=diameter and format_number(diameter))
        return [first, say(STRAY_LIMITS[result.limited_by], **values)]
    if result.stray_bracket[1] is None:
        return [say("No stray is proven to be safe.")]
    touch = phrase("{a} and {b} touch, or nearly touch, at {time:.2f} s even with everybody in their place.")
    if result.limited_by is Limit.VENUE:
        touch = phrase("{a} and {area} touch, or nearly touch, at {time:.2f} s even with everybody in their place.")
    return [_sentence(touch, **values)]

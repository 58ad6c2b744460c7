"""Failures of a dance, each in one sentence of the language that is spoken."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.contact.answer import FirstContact, Outcome
from core.contact.clearance import LeastClearance
from core.contact.encounter_answer import FirstEncounter
from core.contact.walls import AreaClearance, VenueClearance
from core.dance import RunEnd
from core.display import Readable
from core.dragon import Dragon
from core.extremes.speed import SPEED_PROVEN, SPEED_ROUNDING, FirstExcess, HighestSpeed
from core.language import phrase, say, sense
from core.paths.path import HeadState
from core.performance import Performance
from core.quantities import format_bound, format_number
from core.values import Interval, Pair

# Widest bracket of a first excess over a speed limit [s]; of a wider one the message says "at the latest".
EXCESS_KNOWN = 1e-6


class FailureKind(StrEnum):
    """Kind of a failure: two benches, or a bench and an edge of the venue, come within the margin; a bench starts
    outside the square or in an obstacle; a handle is faster than the limit; a bench cannot follow the path any further.
    UNDECIDED: a search gave up before it could prove any of these, and nothing fails for certain after that.

    >>> from core import Dance, Spiral, check
    >>> check(Dance(Dragon(20), Spiral())).failures[0].kind
    <FailureKind.CONTACT: 'contact'>
    """

    CONTACT = "contact"
    VENUE = "venue"
    OUTSIDE = "outside"
    SPEED = "speed"
    FOLDS = "folds"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True, repr=False)
class Failure(Readable):
    """One failed or undecided condition.

    kind: kind of failure
    time: first time of the failure, or the first at which it is certain; for an undecided condition, the time until
        which it is proven to hold; for a speed, the first instant above the limit [s]
    benches: benches at fault; for a speed, the handles
    area: area of the venue; None if the venue is not involved
    message: the failure in one sentence, in the language that was spoken
    time_bracket: two times: proven not to fail up to the first; failing at the second. None for a fold, or at the start
        [s]
    head: the head at that time
    peak_speed: for a speed: the highest over the dance; None if it grows without bound towards a fold [m/s]
    peak_time: for a speed: the time of the highest, or of the fold [s]

    >>> from core import Dance, Spiral, check
    >>> check(Dance(Dragon(20), Spiral())).failures[0].message
    'Benches 0 and 8 touch at 412.473838 s.'
    """

    kind: FailureKind
    time: float
    benches: tuple[int, ...]
    area: str | None
    message: str
    time_bracket: Interval | None = None
    head: HeadState | None = None
    peak_speed: float | None = None
    peak_time: float | None = None

    def _line(self) -> str:
        return self.message


@dataclass(frozen=True, slots=True, repr=False)
class PerformanceFailure(Readable):
    """One failed or undecided condition of a dragon, or of two together; times are those of the performance.

    kind: kind of failure
    time: first time of the failure, as in a Failure [s]
    dragons: the dragon at fault, or the two that come within the margin, in the order of the dances; empty if it is
        undecided which
    benches: benches at fault, of two dragons one of each; for a speed, the handles
    message: the failure in one sentence, which names the dragon
    time_bracket: two times: proven not to fail up to the first; failing at the second. None for a fold, or at the start
        [s]
    failure: that of a dragon by itself, on the clock of its own dance; None for two dragons

    >>> from core import Dance, Line, Part, Route, check
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> failure = check(Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])).failures[0]
    >>> failure.kind.value, failure.dragons, failure.benches
    ('contact', (0, 1), (0, 0))
    """

    kind: FailureKind
    time: float
    dragons: tuple[int, ...]
    benches: tuple[int, ...]
    message: str
    time_bracket: Interval | None = None
    failure: Failure | None = None

    def _line(self) -> str:
        return self.message


def touch_failures(contact: FirstContact, least: LeastClearance | None, margin: float) -> list[Failure]:
    """The touch of two benches after they came within a positive margin; the dance stops there."""
    failed = margin == 0.0 or (contact.gap is not None and contact.gap <= 0.0)
    if failed or least is None or least.distance > 0.0:
        return []
    a, b = map(contact.dance.dragon.called, least.benches)
    gone = phrase("Benches {a} and {b} have no gap left at {time:.6f} s, where the dance stops.")
    if contact.stray:
        gone = phrase("Benches {a} and {b} may have no gap left at {time:.6f} s, where the dance stops.")
    message = say(gone, a=a, b=b, time=least.time)
    return [Failure(FailureKind.CONTACT, least.time, least.benches, None, message)]


def contact_failures(contact: FirstContact, margin: float) -> list[Failure]:
    """The first approach of two benches within the margin [m], or that it is undecided; none if there is none."""
    meet = approach_words(margin, contact.stray)
    if contact.outcome is Outcome.UNDECIDED:
        assert contact.time_bracket is not None
        time, late = contact.time_bracket
        if contact.overlapping is not None:
            a, b = map(contact.dance.dragon.called, contact.overlapping)
            message = say(
                "Benches {a} and {b} {meet} at {late:.6f} s at the latest; up to {clear} s none do.",
                a=a, b=b, meet=meet, late=late, clear=format_bound(time, 6),
            )  # fmt: skip
            return [Failure(FailureKind.CONTACT, late, contact.overlapping, None, message, contact.time_bracket)]
        message = say("Whether benches {meet} is not decided from {time:.6f} s on.", meet=meet, time=time)
        return [Failure(FailureKind.UNDECIDED, time, (), None, message)]
    if contact.time is None or contact.benches is None:
        return []
    a, b = map(contact.dance.dragon.called, contact.benches)
    gap = _gap(contact.gap, margin, phrase(", and overlap by {gap:.6f} m"))
    message = say("Benches {a} and {b} {meet} at {time:.6f} s{gap}.", a=a, b=b, meet=meet, time=contact.time, gap=gap)
    return [Failure(FailureKind.CONTACT, contact.time, contact.benches, None, message, contact.time_bracket)]


def approach_words(margin: float, stray: float) -> str:
    """The predicate of two benches that come within the margin [m]."""
    values = {"margin": format_number(margin), "stray": format_number(stray)}
    if margin > 0.0 and stray:
        return say("may come within {margin} m with strays up to {stray} m", **values)
    if margin > 0.0:
        return say("come within {margin} m", **values)
    return say("may touch with strays up to {stray} m", **values) if stray else sense("predicate", "touch")


def area_approach_words(margin: float, stray: float, area: str) -> str:
    """The predicate of a bench that comes within the margin of an area [m]. area: as it is called"""
    values = {"margin": format_number(margin), "stray": format_number(stray), "area": area}
    if margin > 0.0 and stray:
        return say("may come within {margin} m of {area} with strays up to {stray} m", **values)
    if margin > 0.0:
        return say("comes within {margin} m of {area}", **values)
    if stray:
        return say("may touch {area} with strays up to {stray} m", **values)
    return say("touches {area}", **values)


def _gap(gap: float | None, margin: float, overlap: str) -> str:
    """Words for the remaining gap, if there is a margin. overlap: the template for a negative one"""
    if gap is None or margin == 0.0:
        return ""
    return say(", with a gap of {gap:.6f} m", gap=gap) if gap > 0.0 else say(overlap, gap=-gap)


def venue_failures(
    dragon: Dragon, venue: VenueClearance | None, begin: float, margin: float, stray: float
) -> list[Failure]:
    """What breaks the rules of the venue in a dance that begins at a time [s]. margin, stray: [m]"""
    if venue is None:
        return []
    failures = [failure for area in venue.areas for failure in _area_failures(dragon, area, margin, stray)]
    if misplaced := venue.misplaced:
        starts = phrase("Bench {bench} starts inside {area}, at ({x:g}, {y:g}) m.")
        if misplaced.name == venue.areas[0].name:
            starts = phrase("Bench {bench} starts outside {area}, at ({x:g}, {y:g}) m.")
        x, y = misplaced.point
        message = say(starts, bench=dragon.called(misplaced.bench), area=repr(misplaced.name), x=x, y=y)
        failures.insert(0, Failure(FailureKind.OUTSIDE, begin, (misplaced.bench,), misplaced.name, message))
    return failures


def _area_failures(dragon: Dragon, area: AreaClearance, margin: float, stray: float) -> list[Failure]:
    meets = area_approach_words(margin, stray, repr(area.name))
    if area.outcome is Outcome.UNDECIDED:
        assert area.time_bracket is not None
        time, late = area.time_bracket
        if area.overlapping is not None:
            message = say(
                "Bench {bench} {meets} at {late:.6f} s at the latest; up to {clear} s none do.",
                bench=dragon.called(area.overlapping), meets=meets, late=late, clear=format_bound(time, 6),
            )  # fmt: skip
            return [Failure(FailureKind.VENUE, late, (area.overlapping,), area.name, message, area.time_bracket)]
        message = say("Whether a bench {meets} is not decided from {time:.6f} s on.", meets=meets, time=time)
        return [Failure(FailureKind.UNDECIDED, time, (), area.name, message)]
    if area.time is None or area.bench is None:
        return []
    gap = _gap(area.gap, margin, phrase(", and overlaps it by {gap:.6f} m"))
    bench = dragon.called(area.bench)
    message = say("Bench {bench} {meets} at {time:.6f} s{gap}.", bench=bench, meets=meets, time=area.time, gap=gap)
    return [Failure(FailureKind.VENUE, area.time, (area.bench,), area.name, message, area.time_bracket)]


def keeps_limit(speed: HighestSpeed, limit: float) -> bool:
    """True if the limit is proven to be kept, to within SPEED_PROVEN."""
    highest = speed.speed_bracket[1]
    kept = speed.speed <= limit * (1.0 + SPEED_ROUNDING)
    return kept and highest is not None and highest <= limit * (1.0 + SPEED_PROVEN)


def speed_failure(excess: FirstExcess, speed: HighestSpeed | None, limit: float, end: RunEnd) -> Failure:
    """Failure of the first excess, with the highest speed. speed: None towards a fold"""
    proven, latest = excess.time_bracket
    time, handle = excess.time, excess.handle
    if time is None and speed is not None and speed.speed > limit * (1.0 + SPEED_ROUNDING):
        time, handle = speed.time, speed.handles[0]
    most = format_number(limit)
    kept = say("{limit} m/s is proven to be kept up to {until} s", limit=most, until=format_bound(proven, 6))
    if time is None and speed is not None:
        message = say(
            "Whether a handle exceeds {limit} m/s is not decided; {kept}, and no higher speed was found.",
            limit=most,
            kept=kept,
        )
        return Failure(FailureKind.UNDECIDED, proven, (), None, message, (proven, latest))
    peak = say(
        "towards {time:.6f} s, when bench {bench} folds, speeds grow without bound", time=end.time, bench=end.bench
    )
    if speed is not None:
        peak = say(
            "the highest speed is {speed:.6f} m/s, of handle {handle} at {time:.6f} s",
            speed=speed.speed, handle=speed.handles[0], time=speed.time,
        )  # fmt: skip
    highest = (speed.speed, speed.time) if speed is not None else (None, end.time)
    handles = () if time is None or handle is None else (handle,)
    values = {"limit": most, "kept": kept, "peak": peak, "handle": handle, "time": time}
    if time is None or handle is None:
        time, message = end.time, say("A handle exceeds {limit} m/s: {peak}; {kept}.", **values)
    elif time - proven > EXCESS_KNOWN:
        message = say("Handle {handle} exceeds {limit} m/s at {time:.6f} s at the latest ({kept}); {peak}.", **values)
    else:
        message = say("Handle {handle} first exceeds {limit} m/s at {time:.6f} s; {peak}.", **values)
    return Failure(FailureKind.SPEED, time, handles, None, message, (proven, time), None, *highest)


def fold_failure(dragon: Dragon, end: RunEnd, head: HeadState) -> Failure:
    """The fold of a bench at the end of the run, with the head there."""
    assert end.bench is not None
    message = say(
        "Bench {bench} folds at {time:.6f} s, the head at ({x:.6f}, {y:.6f}) m, theta = {theta:.6f} rad: it cannot "
        "follow the spiral any further.",
        bench=dragon.called(end.bench), time=end.time, x=head.x, y=head.y, theta=head.theta,
    )  # fmt: skip
    return Failure(FailureKind.FOLDS, end.time, (end.bench,), None, message)


def failure_of_dragon(performance: Performance, k: int, failure: Failure) -> PerformanceFailure:
    """The failure of a dragon by itself, on the clock of the performance."""
    delay, bracket = performance.parts[k].delay, failure.time_bracket
    shifted = None if bracket is None else (bracket[0] + delay, bracket[1] + delay)
    own = say(" (at {time:.6f} s of the performance)", time=failure.time + delay) if delay else ""
    name, message = performance.name_of(k), failure.message
    if len(performance.parts) > 1:
        if performance.parts[k].name is None:
            name = f"{name[0].upper()}{name[1:]}"
        message = say("{name}: {text}", name=f"{name}{own}", text=message)
    return PerformanceFailure(failure.kind, failure.time + delay, (k,), failure.benches, message, shifted, failure)


def encounter_failures(met: FirstEncounter) -> list[PerformanceFailure]:
    """The first encounter of two dragons as a failure, or that it is undecided; none if there is none."""
    meet = approach_words(met.margin, met.stray)
    bracket = met.time_bracket
    if met.outcome is Outcome.UNDECIDED and bracket is not None:
        if met.overlapping is None:
            message = say(
                "Whether benches of two dragons {meet} is not decided from {time:.6f} s on.", meet=meet, time=bracket[0]
            )
            return [PerformanceFailure(FailureKind.UNDECIDED, bracket[0], (), (), message, None)]
        dragons, benches = met.overlapping
        pair = _dragons_pair(met, dragons, benches)
        message = say("{pair} {meet} at {time:.6f} s at the latest.", pair=pair, meet=meet, time=bracket[1])
        return [PerformanceFailure(FailureKind.CONTACT, bracket[1], dragons, benches, message, bracket)]
    if met.time is None or met.dragons is None or met.benches is None:
        return []
    message = say(
        "{pair} {meet} at {time:.6f} s.", pair=_dragons_pair(met, met.dragons, met.benches), meet=meet, time=met.time
    )
    return [PerformanceFailure(FailureKind.CONTACT, met.time, met.dragons, met.benches, message, bracket)]


def _dragons_pair(met: FirstEncounter, dragons: Pair, benches: Pair) -> str:
    """Two benches at the beginning of a sentence, with their households and dragons."""
    a, b = (met.performance.parts[k].dance.dragon.called(bench) for k, bench in zip(dragons, benches, strict=True))
    one, two = map(met.performance.name_of, dragons)
    return say("Bench {a} of {one} and bench {b} of {two}", a=a, one=one, b=b, two=two)

"""Failures of a dance, each in one sentence."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.contact.answer import FirstContact, Outcome
from core.contact.clearance import LeastClearance
from core.contact.walls import AreaClearance, VenueClearance
from core.dance import RunEnd
from core.display import Readable
from core.dragon import Dragon
from core.errors import format_bound, format_number
from core.extremes.speed import SPEED_PROVEN, SPEED_ROUNDING, FirstExcess, HighestSpeed
from core.paths.path import HeadState

# Widest bracket of a first excess over a speed limit [s]; of a wider one the message says "at the latest".
EXCESS_KNOWN = 1e-6


class FailureKind(StrEnum):
    """Kind of a failure: two benches, or a bench and an edge of the venue, come within the margin; a bench starts
    outside the square or in an obstacle; a handle is faster than the limit; a bench cannot follow the path any further.
    UNDECIDED: a search gave up before it could prove any of these, and nothing fails for certain after that."""

    CONTACT = "contact"
    VENUE = "venue"
    OUTSIDE = "outside"
    SPEED = "speed"
    FOLDS = "folds"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True, repr=False)
class Failure(Readable):
    """One failed or undecided condition.

    time: first time of the failure [s]; for a search that gave up, the time until which it is proven not to fail, or
        one at which it certainly fails
    benches: those at fault (for a speed: the handle); area: the venue's polygon, None if no area is involved
    message: one sentence
    time_bracket: (proven not to fail up to, failing at) [s]; None without a search
    head: state of the head at that time
    peak_speed, peak_time: for a speed, the highest one [m/s] and its time [s]. In a run to a fold, where speeds grow
        without bound: None and the time of the fold; None for all other failures
    """

    kind: FailureKind
    time: float
    benches: tuple[int, ...]
    area: str | None
    message: str
    time_bracket: tuple[float, float] | None = None
    head: HeadState | None = None
    peak_speed: float | None = None
    peak_time: float | None = None

    def _line(self) -> str:
        return self.message


def touch_failures(contact: FirstContact, least: LeastClearance | None, margin: float) -> list[Failure]:
    """The touch of two benches after they came within a positive margin; the dance stops there."""
    failed = margin == 0.0 or (contact.gap is not None and contact.gap <= 0.0)
    if failed or least is None or least.distance > 0.0:
        return []
    a, b = map(contact.dance.dragon.called, least.benches)
    have = "may have" if contact.stray else "have"
    message = f"Benches {a} and {b} {have} no gap left at {least.time:.6f} s, where the dance stops."
    return [Failure(FailureKind.CONTACT, least.time, least.benches, None, message)]


def contact_failures(contact: FirstContact, margin: float) -> list[Failure]:
    """The first approach of two benches within the margin [m], or that it is undecided; none if there is none."""
    meet = approach_words(margin, contact.stray)
    if contact.outcome is Outcome.UNDECIDED:
        assert contact.time_bracket is not None
        time = contact.time_bracket[0]
        if contact.overlapping is not None:
            a, b = map(contact.dance.dragon.called, contact.overlapping)
            message = _at_the_latest(f"Benches {a} and {b} {meet}", contact.time_bracket)
            late, pair = contact.time_bracket[1], contact.overlapping
            return [Failure(FailureKind.CONTACT, late, pair, None, message, contact.time_bracket)]
        message = f"Whether benches {meet} is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), None, message)]
    if contact.time is None or contact.benches is None:
        return []
    a, b = map(contact.dance.dragon.called, contact.benches)
    message = f"Benches {a} and {b} {meet} at {contact.time:.6f} s{_gap(contact.gap, margin, 'overlap')}."
    return [Failure(FailureKind.CONTACT, contact.time, contact.benches, None, message, contact.time_bracket)]


def approach_words(margin: float, stray: float) -> str:
    """The predicate of two benches that come within the margin [m]."""
    return _meeting(margin, "come", "", stray)


def _at_the_latest(meet: str, bracket: tuple[float, float]) -> str:
    """The sentence of a contact that is certain at the end of a bracket [s], but may be earlier."""
    return f"{meet} at {bracket[1]:.6f} s at the latest; up to {format_bound(bracket[0], 6)} s none do."


def _meeting(margin: float, come: str, near: str, stray: float = 0.0) -> str:
    """Words for an approach within the margin. come: the verb; near: the other object, if not another bench"""
    if stray:
        return f"may {_meeting(margin, 'come', near)} with strays up to {format_number(stray)} m"
    if margin > 0.0:
        return f"{come} within {format_number(margin)} m{near and ' of '}{near}"
    return f"{'touches' if come == 'comes' else 'touch'}{near and ' '}{near}"


def _gap(gap: float | None, margin: float, overlap: str) -> str:
    """Words for the remaining gap, if there is a margin. overlap: the verb for a negative one"""
    if gap is None or margin == 0.0:
        return ""
    return f", with a gap of {gap:.6f} m" if gap > 0.0 else f", and {overlap} by {-gap:.6f} m"


def venue_failures(
    dragon: Dragon, venue: VenueClearance | None, begin: float, margin: float, stray: float
) -> list[Failure]:
    """What breaks the rules of the venue in a dance that begins at a time [s]. margin, stray: [m]"""
    if venue is None:
        return []
    failures = [failure for area in venue.areas for failure in _area_failures(dragon, area, margin, stray)]
    if misplaced := venue.misplaced:
        where = "outside" if misplaced.name == venue.areas[0].name else "inside"
        at = f"({misplaced.point[0]:g}, {misplaced.point[1]:g})"
        message = f"Bench {dragon.called(misplaced.bench)} starts {where} {misplaced.name!r}, at {at} m."
        failures.insert(0, Failure(FailureKind.OUTSIDE, begin, (misplaced.bench,), misplaced.name, message))
    return failures


def _area_failures(dragon: Dragon, area: AreaClearance, margin: float, stray: float) -> list[Failure]:
    words = _meeting(margin, "comes", repr(area.name), stray)
    if area.outcome is Outcome.UNDECIDED:
        assert area.time_bracket is not None
        time = area.time_bracket[0]
        if area.overlapping is not None:
            message = _at_the_latest(f"Bench {dragon.called(area.overlapping)} {words}", area.time_bracket)
            late, bench = area.time_bracket[1], area.overlapping
            return [Failure(FailureKind.VENUE, late, (bench,), area.name, message, area.time_bracket)]
        message = f"Whether a bench {words} is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), area.name, message)]
    if area.time is None or area.bench is None:
        return []
    message = f"Bench {dragon.called(area.bench)} {words} at {area.time:.6f} s{_gap(area.gap, margin, 'overlaps it')}."
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
    kept = f"{format_number(limit)} m/s is proven to be kept up to {format_bound(proven, 6)} s"
    if time is None and speed is not None:
        undecided = f"Whether a handle exceeds {format_number(limit)} m/s is not decided"
        message = f"{undecided}; {kept}, and no higher speed was found."
        return Failure(FailureKind.UNDECIDED, proven, (), None, message, (proven, latest))
    peak = f"towards {end.time:.6f} s, when bench {end.bench} folds, speeds grow without bound"
    if speed is not None:
        peak = f"the highest speed is {speed.speed:.6f} m/s, of handle {speed.handles[0]} at {speed.time:.6f} s"
    highest = (speed.speed, speed.time) if speed is not None else (None, end.time)
    handles = () if time is None or handle is None else (handle,)
    if time is None or handle is None:
        time, message = end.time, f"A handle exceeds {format_number(limit)} m/s: {peak}; {kept}."
    elif time - proven > EXCESS_KNOWN:
        message = f"Handle {handle} exceeds {format_number(limit)} m/s at {time:.6f} s at the latest ({kept}); {peak}."
    else:
        message = f"Handle {handle} first exceeds {format_number(limit)} m/s at {time:.6f} s; {peak}."
    return Failure(FailureKind.SPEED, time, handles, None, message, (proven, time), None, *highest)


def fold_failure(dragon: Dragon, end: RunEnd, head: HeadState) -> Failure:
    """The fold of a bench at the end of the run, with the head there."""
    assert end.bench is not None
    where = f"the head at ({head.x:.6f}, {head.y:.6f}) m, theta = {head.theta:.6f} rad"
    folds = f"Bench {dragon.called(end.bench)} folds at {end.time:.6f} s"
    message = f"{folds}, {where}: it cannot follow the spiral any further."
    return Failure(FailureKind.FOLDS, end.time, (end.bench,), None, message)

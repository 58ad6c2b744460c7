"""One verdict on a dance: its events, its failures, and their times."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

from core.budget import Budget
from core.clock import TIME_MAX
from core.contact.clearance import LeastClearance, least_clearance
from core.contact.first_contact import FirstContact, Outcome, first_contact
from core.dance import Dance, EndReason, RunEnd
from core.dragon import Dragon
from core.errors import said, said_bound
from core.motion.joints import SharpestBend, sharpest_bend
from core.motion.speed import (
    SPEED_PROVEN,
    SPEED_ROUNDING,
    FirstExcess,
    HighestSpeed,
    checked_limit,
    first_excess,
    highest_speed,
)
from core.paths.path import HeadState
from core.shown import Shown, worded
from core.tolerance.stray import Stray, checked_stray
from core.values import asked_of, checked_number, checked_type
from core.venue import AreaClearance, Venue, VenueClearance, is_clear_beyond, venue_clearance, venue_end

# A first excess over a speed limit in a wider bracket than this is reported as the latest possible one [s].
EXCESS_KNOWN = 1e-6
# A dance whose benches touch at its start is judged for this long [s].
MOMENT = 1e-3


class FailureKind(StrEnum):
    """Kind of a failure: two benches, or a bench and an edge of the venue, come within the margin; a bench starts
    outside the square or in an obstacle; a handle is faster than the limit; a bench cannot follow the path any further.
    UNDECIDED: a search gave up before it could prove any of these."""

    CONTACT = "contact"
    VENUE = "venue"
    OUTSIDE = "outside"
    SPEED = "speed"
    FOLDS = "folds"
    UNDECIDED = "undecided"


class Judgement(StrEnum):
    """The verdict of a report: nothing fails, something fails for certain, or neither is known."""

    PASSES = "passes"
    FAILS = "fails"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True, repr=False)
class Failure(Shown):
    """One failed or undecided condition.

    time: first time of the failure [s]; for a search that gave up, the time until which it is proven not to fail
    benches: those at fault (for a speed: the handle); area: the venue's polygon, None if no area is involved
    message: one sentence
    time_bracket: (proven not to fail up to, failing at) [s]; None where there is no search
    head: the head at that time
    peak_speed, peak_time: for a speed, the highest one [m/s] and its time [s]; in a run to a fold, where speeds grow
        without bound, None and the time of the fold; None for all other failures
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


@dataclass(frozen=True, slots=True, repr=False)
class Report(Shown):
    """The verdict on a dance, and the answers behind it.

    start, stop: the stretch that is judged [s], which ends where benches touch
    verdict: see Judgement; passed: is it PASSES?
    failures: in order of time, none after the stop; among them what is undecided
    first_contact: within the margin; least_clearance: of any two benches, None with fewer than three
    venue: None without one; sharpest_bend: None for a single bench
    highest_speed: None in a run to a fold, where speeds grow without bound; all three are None where a quick check did
        not need them
    """

    start: float
    stop: float
    verdict: Judgement
    passed: bool
    failures: tuple[Failure, ...]
    first_contact: FirstContact
    least_clearance: LeastClearance | None
    venue: VenueClearance | None
    highest_speed: HighestSpeed | None
    sharpest_bend: SharpestBend | None

    def _line(self) -> str:
        span = f"{self.verdict.value} from {worded(self.start)} to {worded(self.stop, 's')}"
        more = f" And {len(self.failures) - 1} more." if len(self.failures) > 1 else ""
        return f"{span}: {self.failures[0].message}{more}" if self.failures else span


@asked_of("dance", Dance)
def check(
    dance: Dance,
    *,
    venue: Venue | None = None,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    speed_limit: float | None = None,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> Report:
    """Can the dragon dance this path: first contact, least clearance, venue, highest speed, sharpest bend.

    margin: required between benches and to the venue [m]; stray: how far every hole may be from its place [m], what
        benches can meet then fails too; speed_limit: of every handle [m/s]
    start, stop: [s]; by default from 0 (on a route: from when the whole dragon is on it) to the end of the run
    A dance fails if it folds before its stop, or before the end of its path if no stop is given. A dance that ends
    earlier, because benches touch, is not followed to its fold.
    raises: InvalidValue; OutsideRun for times outside the run, but not for a stop after a fold; TooMuchWork
    """
    return _judged(dance, venue, (margin, stray), speed_limit, (start, stop), budget, details=True)


@asked_of("dance", Dance)
def quick_check(
    dance: Dance,
    *,
    venue: Venue | None = None,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    speed_limit: float | None = None,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> Report:
    """The verdict and the failures of check() in a tenth of its time, for a dance that somebody is drawing.

    Whatever no failure needs is None: least clearance, how near the benches come to the venue, highest speed, sharpest
    bend. Arguments and errors are those of check().
    """
    return _judged(dance, venue, (margin, stray), speed_limit, (start, stop), budget, details=False)


def _judged(
    dance: Dance,
    venue: Venue | None,
    kept: tuple[float, float | Stray],
    speed_limit: float | None,
    asked: tuple[float | None, float | None],
    budget: Budget | None,
    *,
    details: bool,
) -> Report:
    """The report. kept: margin and stray [m]; asked: start and stop [s]"""
    (margin, stray), (start, stop) = kept, asked
    limit = None if speed_limit is None else checked_limit(speed_limit)
    strayed = checked_stray(stray, dance.dragon)
    if venue is not None:
        checked_type("venue", venue, Venue)
    end = dance.end
    if stop is not None and end.reason is EndReason.FOLD:
        stop = checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
        stop = None if stop >= end.time else stop
    begin, until = dance.span(dance.begin if start is None else start, stop)
    contact = first_contact(dance, margin=margin, stray=strayed, start=begin, stop=stop, budget=budget)
    least, touch = None, contact.time
    if details or (margin > 0.0 and touch is not None):
        least = least_clearance(dance, stray=strayed, start=begin, stop=until, budget=budget)
        touch = least.time if least is not None and least.distance <= 0.0 else None
    if touch is not None:
        until = min(until, max(touch, begin + MOMENT))
    bend = sharpest_bend(dance, start=begin, stop=until, budget=budget) if details else None
    square, seen = _in_venue(dance, venue, (margin, strayed), (begin, until), budget, details)
    folds = dance.ends_by(until)
    speed, excess = None, None
    if details and not folds:
        speed = highest_speed(dance, start=begin, stop=until, budget=budget)
    if limit is not None and not (speed and _keeps(speed, limit)):
        excess = first_excess(dance, limit, start=begin, stop=until, budget=budget)
    if excess and not folds and speed is None:
        speed = highest_speed(dance, start=begin, stop=until, budget=budget)
    failures = _contact_failures(contact, margin) + _venue_failures(dance.dragon, square, begin, (margin, strayed))
    if limit is not None and excess:
        failures.append(_speed_failure(excess, speed, limit, end))
    failures += _touch_failures(contact, least, margin)
    if folds:
        failures.append(_fold_failure(dance.dragon, end, dance.path.head(dance.clock.place(end.time))))
    if (
        venue
        and seen < until
        and not is_clear_beyond(dance, venue, margin=margin, stray=strayed, start=begin, seen=seen)
    ):
        message = f"From {seen:.6f} s on the spiral is too tight to follow the benches against the venue."
        failures.append(Failure(FailureKind.UNDECIDED, seen, (), None, message))
    failures.sort(key=lambda failure: failure.time)
    told = tuple(replace(failure, head=dance.path.head(dance.clock.place(failure.time))) for failure in failures)
    verdict = _judgement(told)
    passed = verdict is Judgement.PASSES
    return Report(begin, until, verdict, passed, told, contact, least, square, speed, bend)


def _in_venue(
    dance: Dance,
    venue: Venue | None,
    kept: tuple[float, float],
    span: tuple[float, float],
    budget: Budget | None,
    nearest: bool,
) -> tuple[VenueClearance | None, float]:
    """Clearance of the benches in the venue, as far as they can be followed there, and the time of that end [s].

    kept: margin and stray [m]
    """
    begin, until = span
    if venue is None:
        return None, until
    followed = venue_end(dance)
    seen = min(until, followed) if followed >= begin + MOMENT else begin
    if seen <= begin:
        return None, seen
    margin, stray = kept
    found = venue_clearance(
        dance, venue, margin=margin, stray=stray, start=begin, stop=seen, nearest=nearest, budget=budget
    )
    return found, seen


def _judgement(failures: tuple[Failure, ...]) -> Judgement:
    if not failures:
        return Judgement.PASSES
    undecided = all(failure.kind is FailureKind.UNDECIDED for failure in failures)
    return Judgement.UNDECIDED if undecided else Judgement.FAILS


def _touch_failures(contact: FirstContact, least: LeastClearance | None, margin: float) -> list[Failure]:
    """The touch of two benches that came within a positive margin before: the dance stops there."""
    told = margin == 0.0 or (contact.gap is not None and contact.gap <= 0.0)
    if told or least is None or least.distance > 0.0:
        return []
    a, b = map(contact.dance.dragon.called, least.benches)
    have = "may have" if contact.stray else "have"
    message = f"Benches {a} and {b} {have} no gap left at {least.time:.6f} s, where the dance stops."
    return [Failure(FailureKind.CONTACT, least.time, least.benches, None, message)]


def _contact_failures(contact: FirstContact, margin: float) -> list[Failure]:
    if contact.outcome is Outcome.UNDECIDED:
        assert contact.time_bracket is not None
        time = contact.time_bracket[0]
        message = f"Whether benches {_meeting(margin, 'come', '', contact.stray)} is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), None, message)]
    if contact.time is None or contact.benches is None:
        return []
    a, b = map(contact.dance.dragon.called, contact.benches)
    meet = _meeting(margin, "come", "", contact.stray)
    message = f"Benches {a} and {b} {meet} at {contact.time:.6f} s{_gap(contact.gap, margin)}."
    return [Failure(FailureKind.CONTACT, contact.time, contact.benches, None, message, contact.time_bracket)]


def _meeting(margin: float, come: str, near: str, stray: float = 0.0) -> str:
    """Words for coming nearer than the margin. come: the verb; near: to what, if not to one another."""
    if stray:
        return f"may {_meeting(margin, 'come', near)} with strays up to {said(stray)} m"
    if margin > 0.0:
        return f"{come} nearer than {said(margin)} m{near and ' to '}{near}"
    return f"{'touches' if come == 'comes' else 'touch'}{near and ' '}{near}"


def _gap(gap: float | None, margin: float) -> str:
    """Words for the gap that is left, if a margin was asked."""
    if gap is None or margin == 0.0:
        return ""
    return f", with a gap of {gap:.6f} m" if gap > 0.0 else f", and overlap by {-gap:.6f} m"


def _venue_failures(
    dragon: Dragon, venue: VenueClearance | None, begin: float, kept: tuple[float, float]
) -> list[Failure]:
    """Failures of a dance that begins at a time [s]. kept: margin and stray [m]"""
    if venue is None:
        return []
    failures = [failure for area in venue.areas for failure in _area_failures(dragon, area, *kept)]
    if misplaced := venue.misplaced:
        where = "outside" if misplaced.name == venue.areas[0].name else "inside"
        at = f"({misplaced.point[0]:g}, {misplaced.point[1]:g})"
        message = f"Bench {dragon.called(misplaced.bench)} starts {where} {misplaced.name!r}, at {at} m."
        failures.insert(0, Failure(FailureKind.OUTSIDE, begin, (misplaced.bench,), misplaced.name, message))
    return failures


def _area_failures(dragon: Dragon, area: AreaClearance, margin: float, stray: float) -> list[Failure]:
    if area.outcome is Outcome.UNDECIDED:
        assert area.time_bracket is not None
        time = area.time_bracket[0]
        words = _meeting(margin, "comes", repr(area.name), stray)
        message = f"Whether a bench {words} is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), area.name, message)]
    if area.time is None or area.bench is None:
        return []
    words = _meeting(margin, "comes", repr(area.name), stray)
    message = f"Bench {dragon.called(area.bench)} {words} at {area.time:.6f} s{_gap(area.gap, margin)}."
    return [Failure(FailureKind.VENUE, area.time, (area.bench,), area.name, message, area.time_bracket)]


def _keeps(speed: HighestSpeed, limit: float) -> bool:
    """Is the limit proven to be kept, to within SPEED_PROVEN?"""
    highest = speed.speed_bracket[1]
    kept = speed.speed <= limit * (1.0 + SPEED_ROUNDING)
    return kept and highest is not None and highest <= limit * (1.0 + SPEED_PROVEN)


def _speed_failure(excess: FirstExcess, speed: HighestSpeed | None, limit: float, end: RunEnd) -> Failure:
    """The first excess, and the peak; speed: None towards a fold"""
    proven, latest = excess.time_bracket
    time, handle = excess.time, excess.handle
    handles: tuple[int, ...] = ()
    if time is None and speed is not None and speed.speed > limit * (1.0 + SPEED_ROUNDING):
        time, handle = speed.time, speed.handles[0]
    kept = f"{said(limit)} m/s is proven to be kept up to {said_bound(proven, 6, -1)} s"
    if time is None and speed is not None:
        message = f"Whether a handle exceeds {said(limit)} m/s is not decided; {kept}, and no higher speed was found."
        return Failure(FailureKind.UNDECIDED, proven, (), None, message, (proven, latest))
    if speed is None:
        peak = f"towards {end.time:.6f} s, when bench {end.bench} folds, speeds grow without bound"
        speed_then, then = None, end.time
    else:
        peak = f"the highest speed is {speed.speed:.6f} m/s, of handle {speed.handles[0]} at {speed.time:.6f} s"
        speed_then, then = speed.speed, speed.time
    if time is None or handle is None:
        time, message = end.time, f"A handle exceeds {said(limit)} m/s: {peak}; {kept}."
    elif time - proven > EXCESS_KNOWN:
        handles = (handle,)
        message = f"Handle {handle} exceeds {said(limit)} m/s at {time:.6f} s at the latest ({kept}); {peak}."
    else:
        handles = (handle,)
        message = f"Handle {handle} first exceeds {said(limit)} m/s at {time:.6f} s; {peak}."
    bracket = (proven, time)
    return Failure(FailureKind.SPEED, time, handles, None, message, bracket, None, speed_then, then)


def _fold_failure(dragon: Dragon, end: RunEnd, head: HeadState) -> Failure:
    assert end.bench is not None
    where = f"the head at ({head.x:.6f}, {head.y:.6f}) m, theta = {head.theta:.6f} rad"
    message = (
        f"Bench {dragon.called(end.bench)} folds at {end.time:.6f} s, {where}: it can follow the spiral no further."
    )
    return Failure(FailureKind.FOLDS, end.time, (end.bench,), None, message)

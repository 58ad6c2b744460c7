"""One verdict on a dance: what happens, what fails, and when."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from core.bend import SharpestBend, sharpest_bend
from core.contact import FirstContact, Outcome, first_contact
from core.dragon import Dragon, checked_number
from core.errors import InvalidValue
from core.kinematics import (
    HEAD_SPEED_MAX,
    HEAD_SPEED_MIN,
    EndReason,
    RunEnd,
    checked_head_speed,
    checked_span,
    earliest_time,
    run_end,
)
from core.least import LeastClearance, least_clearance
from core.paths import Spiral
from core.route import Route
from core.speed import HighestSpeed, highest_speed
from core.venue import AreaClearance, Venue, VenueClearance, is_clear_beyond, venue_clearance, venue_end

# Speeds are good to this, so that the maximum head speed itself is allowed [1].
SPEED_ROUNDING = 1e-12
# A limit counts as kept if it is proven to within this [1].
SPEED_PROVEN = 1e-6
# A dance whose benches touch at its start is looked at for this long [s].
MOMENT = 1e-3


class FailureKind(StrEnum):
    """What fails: two benches come within the margin, or a bench and an edge of the venue; a bench starts outside the
    square or in an obstacle; a handle is faster than the limit; a search gave up first."""

    CONTACT = "contact"
    VENUE = "venue"
    OUTSIDE = "outside"
    SPEED = "speed"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class Failure:
    """One thing that fails: time [s]; of a speed, when it is highest; of a search that gave up, proven good until then.

    benches: those at fault (of a speed: the handles); area: the venue's polygon, None where it has no part
    message: one sentence
    """

    kind: FailureKind
    time: float
    benches: tuple[int, ...]
    area: str | None
    message: str


@dataclass(frozen=True, slots=True)
class Report:
    """start, stop: of the stretch looked at [s]: where benches touch, the dance and everything else here stops

    failures: in order of time; passed: there is none
    first_contact: within the margin; least_clearance: of any two benches, None with fewer than three
    venue: None without one; sharpest_bend: None for a single bench
    highest_speed: None in a run to a fold, where speeds grow without bound
    """

    start: float
    stop: float
    passed: bool
    failures: tuple[Failure, ...]
    first_contact: FirstContact
    least_clearance: LeastClearance | None
    venue: VenueClearance | None
    highest_speed: HighestSpeed | None
    sharpest_bend: SharpestBend | None


def check(
    dragon: Dragon,
    path: Spiral | Route,
    *,
    venue: Venue | None = None,
    margin: float = 0.0,
    speed_limit: float | None = None,
    head_speed: float = 1.0,
    start: float | None = None,
    stop: float | None = None,
) -> Report:
    """Can the dragon dance this path: first contact, least clearance, venue, highest speed, sharpest bend.

    margin: required between benches and to the venue [m]; speed_limit: of every handle [m/s]; head_speed: [m/s]
    start, stop: [s]; by default from 0 (on a route: from when all are on it) to the end of the run
    raises: InvalidValue for what is no dance at all; OutsideRun for times that the run does not have
    """
    head_speed = checked_head_speed(head_speed)
    limit = None if speed_limit is None else _checked_limit(speed_limit)
    end = run_end(dragon, path, head_speed=head_speed)
    if start is None:
        first = path.begin / head_speed if isinstance(path, Route) else 0.0
        start = max(first, earliest_time(dragon, path, head_speed))
    begin, until = checked_span(dragon, path, start, stop, end, head_speed)
    contact = first_contact(dragon, path, head_speed=head_speed, margin=margin, start=begin, stop=stop)
    least = least_clearance(dragon, path, head_speed=head_speed, start=begin, stop=until)
    if least is not None and least.distance == 0.0:
        until = min(until, max(least.time, begin + MOMENT))
    bend = sharpest_bend(dragon, path, head_speed=head_speed, start=begin, stop=until)
    square, seen = None, until
    if venue is not None:
        seen = min(until, max(venue_end(dragon, path, head_speed=head_speed), begin + MOMENT))
        square = venue_clearance(dragon, path, venue, head_speed=head_speed, margin=margin, start=begin, stop=seen)
    speed = None
    if until < end.time or end.reason is not EndReason.FOLD:
        speed = highest_speed(dragon, path, head_speed=head_speed, start=begin, stop=until)
    failures = _contact_failures(contact, margin) + _venue_failures(square, begin, margin)
    failures += _speed_failures(speed, limit, end)
    if venue is not None and isinstance(path, Spiral) and seen < until:
        span = {"start": begin, "seen": seen}
        if not is_clear_beyond(dragon, path, venue, head_speed=head_speed, margin=margin, **span):
            message = f"From {seen:.6f} s on the spiral is too tight to follow the benches against the venue."
            failures.append(Failure(FailureKind.UNDECIDED, seen, (), None, message))
    failures.sort(key=lambda failure: failure.time)
    return Report(begin, until, not failures, tuple(failures), contact, least, square, speed, bend)


def _checked_limit(speed_limit: object) -> float:
    if isinstance(speed_limit, (int, float)) and speed_limit <= 0:
        raise InvalidValue("speed_limit", f"speed_limit must be positive, got {speed_limit} m/s")
    return checked_number("speed_limit", speed_limit, "m/s", HEAD_SPEED_MIN, HEAD_SPEED_MAX)


def _contact_failures(contact: FirstContact, margin: float) -> list[Failure]:
    if contact.outcome is Outcome.UNDECIDED:
        assert contact.time_bracket is not None
        time = contact.time_bracket[0]
        message = f"Whether benches come within {margin:g} m is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), None, message)]
    if contact.time is None or contact.benches is None:
        return []
    a, b = contact.benches
    words = f"come within {margin:g} m" if margin > 0.0 else "touch"
    message = f"Benches {a} and {b} {words} at {contact.time:.6f} s."
    return [Failure(FailureKind.CONTACT, contact.time, contact.benches, None, message)]


def _venue_failures(venue: VenueClearance | None, begin: float, margin: float) -> list[Failure]:
    if venue is None:
        return []
    failures = [failure for area in venue.areas for failure in _area_failures(area, margin)]
    if stray := venue.stray:
        where = "outside" if stray.name == venue.areas[0].name else "inside"
        message = f"Bench {stray.bench} starts {where} {stray.name!r}, at ({stray.point[0]:g}, {stray.point[1]:g}) m."
        failures.insert(0, Failure(FailureKind.OUTSIDE, begin, (stray.bench,), stray.name, message))
    return failures


def _area_failures(area: AreaClearance, margin: float) -> list[Failure]:
    if area.outcome is Outcome.UNDECIDED:
        assert area.time_bracket is not None
        time = area.time_bracket[0]
        message = f"Whether a bench comes within {margin:g} m of {area.name!r} is not decided from {time:.6f} s on."
        return [Failure(FailureKind.UNDECIDED, time, (), area.name, message)]
    if area.time is None or area.bench is None:
        return []
    words = f"comes within {margin:g} m of" if margin > 0.0 else "touches"
    message = f"Bench {area.bench} {words} {area.name!r} at {area.time:.6f} s."
    return [Failure(FailureKind.VENUE, area.time, (area.bench,), area.name, message)]


def _speed_failures(speed: HighestSpeed | None, limit: float | None, end: RunEnd) -> list[Failure]:
    if limit is None:
        return []
    if speed is None:
        message = f"Speeds grow without bound towards {end.time:.6f} s, when bench {end.bench} folds."
        return [Failure(FailureKind.SPEED, end.time, (), None, message)]
    if speed.speed <= limit * (1.0 + SPEED_ROUNDING):
        highest = speed.speed_bracket[1]
        if highest is not None and highest <= limit * (1.0 + SPEED_PROVEN):
            return []
        message = (
            f"Whether a handle exceeds {limit:g} m/s is not decided; the highest speed found is {speed.speed:.6f} m/s."
        )
        return [Failure(FailureKind.UNDECIDED, speed.time, (), None, message)]
    message = f"Handle {speed.handles[0]} reaches {speed.speed:.6f} m/s at {speed.time:.6f} s, above {limit:g} m/s."
    return [Failure(FailureKind.SPEED, speed.time, speed.handles, None, message)]

"""One verdict on a dance: its events, its failures, and their times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import partial
from typing import Any

from core.checks import checked_number, checked_type
from core.contact.answer import FirstContact
from core.contact.clearance import LeastClearance, least_clearance
from core.contact.encounter import first_encounter
from core.contact.encounter_answer import FirstEncounter
from core.contact.first_contact import first_contact
from core.contact.stage_clearance import PerformanceLeastClearance, least_between
from core.contact.walls import VenueClearance, venue_clearance
from core.dance import Dance, EndReason
from core.display import Readable, display
from core.dragon import Stray, checked_stray
from core.extremes.joints import SharpestBend, sharpest_bend
from core.extremes.speed import HighestSpeed, checked_limit, first_excess, highest_speed
from core.failures import (
    Failure,
    FailureKind,
    PerformanceFailure,
    contact_failures,
    encounter_failures,
    failure_of_dragon,
    fold_failure,
    keeps_limit,
    speed_failure,
    touch_failures,
    venue_failures,
)
from core.kernels import Budget
from core.language import Phrases, say
from core.passages import TIME_MAX
from core.performance import Performance
from core.questions import or_about, question_about
from core.values import Floats
from core.venue import Venue

# Length of the judged interval if benches already touch at the start [s].
MOMENT = 1e-3


class Judgement(StrEnum):
    """The verdict of a report: nothing fails, something fails for certain, or neither is known.

    >>> from core import Dragon, Line, Route
    >>> check(Dance(Dragon(5), Route([Line((0.0, 0.0), (30.0, 0.0))]))).verdict
    <Judgement.PASSES: 'passes'>
    """

    PASSES = "passes"
    FAILS = "fails"
    UNDECIDED = "undecided"


VERDICTS: Phrases = {"passes": "passes", "fails": "fails", "undecided": "undecided"}


def summary(verdict: Judgement, start: float, stop: float, failures: Sequence[str]) -> str:
    """A report in one line. start, stop: the judged interval [s]; failures: their messages"""
    ends = {"start": display(start), "stop": display(stop, "s")}
    words = say("{verdict}, judged from {start} to {stop}", verdict=say(VERDICTS[verdict]), **ends)
    if failures:
        words = say("{span}: {first}", span=words, first=failures[0])
    return say("{words} And {count} more.", words=words, count=len(failures) - 1) if len(failures) > 1 else words


@dataclass(frozen=True, slots=True, repr=False)
class Report(Readable):
    """Verdict on the dance, which stops at a contact or a fold.

    start: start of the time checked [s]
    stop: end of the time checked [s]
    verdict: passes: nothing fails; fails: at least one condition certainly fails; undecided: neither is proven
    passed: true if the verdict is passes
    failures: failed and undecided conditions, in order of time, until the dance stops
    first_contact: first time two benches come within the margin, or touch if it is 0
    least_clearance: least clearance of any two benches; None with fewer than three, without details, or if people may
        stray so far that two benches are apart only because the one between them holds them
    venue: distances between the benches and the venue, up to the end of the time checked; None without a venue
    highest_speed: highest speed of any handle; None in a run to a fold, where speed has no bound, or without details
    sharpest_bend: sharpest bend between two consecutive benches; None for a single bench, or without details

    Without details, venue, sharpest_bend and highest_speed are None if the verdict does not need them.

    >>> from core import Dragon, Spiral
    >>> report = check(Dance(Dragon(20), Spiral()))
    >>> report.verdict.value, report.failures[0].benches
    ('fails', (0, 8))
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
        return summary(self.verdict, self.start, self.stop, [failure.message for failure in self.failures])

    def _benches(self) -> tuple[Floats | None, Sequence[int]]:
        return self.first_contact._benches()


@dataclass(frozen=True, slots=True, repr=False)
class PerformanceReport(Readable):
    """Verdict on several dances on one clock.

    start: start of the time checked [s]
    stop: end of the time checked [s]
    verdict: passes: nothing fails; fails: at least one condition certainly fails; undecided: neither is proven
    passed: true if the verdict is passes
    failures: failed and undecided conditions of each dragon by itself, and the first encounter of two, in order of
        time. A dragon by itself is judged to the stop, or to a touch of two of its own benches, also after an encounter
    encounter: first time that benches of two dragons come within the margin, or touch if it is 0
    least_clearance: least clearance between two dragons; None for a single one, or without details
    reports: verdict on each dragon by itself in the venue, on the clock of its own dance, which is 0 at its delay; None
        for one that stands during the whole time checked
    performance: the performance of the question

    >>> from core import Dragon, Line, Part, Route
    >>> lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((0.0, 1.0), (40.0, 1.0))]
    >>> report = check(Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes]))
    >>> report.passed, round(report.least_clearance.distance, 3)
    (True, 0.7)
    """

    start: float
    stop: float
    verdict: Judgement
    passed: bool
    failures: tuple[PerformanceFailure, ...]
    encounter: FirstEncounter
    least_clearance: PerformanceLeastClearance | None
    reports: tuple[Report | None, ...]
    performance: Performance = field(repr=False, compare=False)

    def _line(self) -> str:
        return summary(self.verdict, self.start, self.stop, [failure.message for failure in self.failures])


@question_about("performance", Performance)
def _judged_together(
    performance: Performance,
    *,
    details: bool,
    venue: Venue | None = None,
    speed_limit: float | None = None,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
    **near: Any,
) -> PerformanceReport:
    """The report of a performance. near: margin and stray"""
    budget = budget or Budget()
    if venue is not None:
        performance = replace(performance, venue=venue)
    begin, until = performance.span(start, stop)
    met = first_encounter(performance, start=begin, stop=stop, budget=budget, **near)
    failures, reports = encounter_failures(met), list[Report | None]()
    judge, least = check if details else quick_check, None
    if details and len(performance.parts) > 1:
        least = least_between(performance, met.stray, (begin, stop), budget, None if met.margin else met)
    for k, part in enumerate(performance.parts):
        first = None if start is None and begin <= part.begin else part.own_time(begin)
        last = None if part.end <= until else part.own_time(until)
        if max(begin, part.begin) >= min(until, part.end):
            reports.append(None)
            continue
        report = judge(
            part.dance, venue=performance.venue, speed_limit=speed_limit, start=first, stop=last, budget=budget, **near
        )
        reports.append(report)
        failures += [failure_of_dragon(performance, k, failure) for failure in report.failures]
    failures.sort(key=lambda failure: failure.time)
    verdict = _verdict([failure.kind for failure in failures])
    return PerformanceReport(
        begin, until, verdict, not failures, tuple(failures), met, least, tuple(reports), performance
    )


@or_about(Performance, partial(_judged_together, details=True))
@question_about("dance", (Dance, Performance))
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
    """Verdict on a dance from its first contact, least clearance, venue, highest speed and sharpest bend; on a
    Performance from that of every dragon in the venue, the first encounter of two, and their least clearance.

    venue: None for none, or for that of the performance
    margin: required between benches, dragons and to the venue [m]; speed_limit: of every handle [m/s]
    stray: largest distance of every hole from its place [m], a contact that it makes possible is a failure
    start, stop: [s]; defaults: dance.begin and the end of the run
    A dance fails if it folds before its stop, or before the end of its path without a stop. A dance that ends earlier,
    because benches touch, is not followed to its fold.
    In a performance the report of a single dragon is that of its dance to the last bit. A dragon that stands, before
    its dance or after it, is judged only together with the others.
    raises: InvalidValue; OutsideRun for times outside the run, but not for a stop after a fold; TooMuchWork

    >>> from core import Dragon, Line, Part, Route
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> check(crossing).failures[0].message
    'Bench 0 of dragon 0 and bench 0 of dragon 1 touch at 39.575000 s.'
    """
    return _judged(dance, venue, margin, stray, speed_limit, (start, stop), budget, details=True)


@or_about(Performance, partial(_judged_together, details=False))
@question_about("dance", (Dance, Performance))
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
    """The verdict and the failures of check() in a tenth of its time, to use while a path is being drawn.

    Answers that no failure needs are None: least clearance, clearance to the venue, highest speed, sharpest bend.
    Arguments and errors are those of check().

    >>> from core import Dragon, Spiral
    >>> quick_check(Dance(Dragon(20), Spiral())).failures[0].message
    'Benches 0 and 8 touch at 412.473838 s.'
    """
    return _judged(dance, venue, margin, stray, speed_limit, (start, stop), budget, details=False)


# Every question, and every area of the venue, lays out a ContactSearch of its own, because margins and obstacles
# differ. One takes 0.02 ms, all 8 of the village square 0.7 of 78 ms (measured 2026-11-23), so sharing them would save
# nothing.
def _judged(
    dance: Dance,
    venue: Venue | None,
    margin: float,
    stray: float | Stray,
    speed_limit: float | None,
    span: tuple[float | None, float | None],
    budget: Budget | None,
    *,
    details: bool,
) -> Report:
    """The report. span: start and stop [s]"""
    start, stop = span
    limit = None if speed_limit is None else checked_limit(speed_limit)
    strayed = checked_stray(stray, dance.dragon)
    if venue is not None:
        checked_type("venue", venue, Venue)
    end = dance.end
    if stop is not None and end.reason is EndReason.FOLD:
        stop = checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
        stop = None if stop >= end.time else stop
    begin, until = dance.whole_span(start, stop)
    contact = first_contact(dance, margin=margin, stray=strayed, start=begin, stop=stop, budget=budget)
    least, touch = None, contact.time
    if contact.overlapping is not None and contact.time_bracket is not None:
        touch = contact.time_bracket[1]  # which contact is the first is not decided
    held = contact.certificate.claim.between is not None
    if not held and (details or (margin > 0.0 and touch is not None)):
        least = least_clearance(dance, stray=strayed, start=begin, stop=until, budget=budget)
        if margin > 0.0 or contact.overlapping is None:
            touch = least.time if least is not None and least.distance <= 0.0 else None
    if touch is not None:
        until = min(until, max(touch, begin + MOMENT))
    bend = sharpest_bend(dance, start=begin, stop=until, budget=budget) if details else None
    square = None
    if venue is not None:
        square = venue_clearance(
            dance, venue, margin=margin, stray=strayed, start=begin, stop=until, nearest=details, budget=budget
        )
    folds = dance.ends_by(until)
    speed = highest_speed(dance, start=begin, stop=until, budget=budget) if details and not folds else None
    excess = None
    if limit is not None and not (speed and keeps_limit(speed, limit)):
        excess = first_excess(dance, limit, start=begin, stop=until, budget=budget)
    if excess and not folds and speed is None:
        speed = highest_speed(dance, start=begin, stop=until, budget=budget)
    failures = contact_failures(contact, margin) + venue_failures(dance.dragon, square, begin, margin, strayed)
    if limit is not None and excess:
        failures.append(speed_failure(excess, speed, limit, end))
    failures += touch_failures(contact, least, margin)
    if folds:
        failures.append(fold_failure(dance.dragon, end, dance.path.head(dance.clock.travel(end.time))))
    failures.sort(key=lambda failure: failure.time)
    dated = tuple(replace(failure, head=dance.path.head(dance.clock.travel(failure.time))) for failure in failures)
    verdict = _verdict([failure.kind for failure in dated])
    return Report(begin, until, verdict, not dated, dated, contact, least, square, speed, bend)


def _verdict(kinds: list[FailureKind]) -> Judgement:
    """The verdict if conditions of these kinds failed or are undecided."""
    undecided = all(kind is FailureKind.UNDECIDED for kind in kinds)
    return Judgement.PASSES if not kinds else Judgement.UNDECIDED if undecided else Judgement.FAILS

"""One verdict on a performance: each dragon by itself, with the venue, and any two together."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from core.contact.answer import Outcome
from core.dance import checked_instants
from core.display import Readable
from core.dragon import Stray
from core.errors import question_about
from core.failures import Failure, FailureKind, approach_words
from core.ground.envelope import Envelope, envelope
from core.judgement import Judgement, Report, check, quick_check, summary
from core.kernels import Budget
from core.language import say
from core.motion.trajectory import Trajectory, trajectory
from core.performance.answer import FirstEncounter
from core.performance.clearance import PerformanceLeastClearance, least_over
from core.performance.encounter import first_encounter
from core.performance.performance import Part, Performance


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
    """

    kind: FailureKind
    time: float
    dragons: tuple[int, ...]
    benches: tuple[int, ...]
    message: str
    time_bracket: tuple[float, float] | None = None
    failure: Failure | None = None

    def _line(self) -> str:
        return self.message


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
def performance_check(
    performance: Performance,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    speed_limit: float | None = None,
    start: float | None = None,
    stop: float | None = None,
    details: bool = True,
    budget: Budget | None = None,
) -> PerformanceReport:
    """Verdict on a performance: check() of every dragon in the venue, the first encounter of two, their least
    clearance.

    margin: required between benches, dragons and to the venue [m]; stray: largest distance of every hole from its place
        [m]; speed_limit: of every handle [m/s]; start, stop: [s], None for the beginning and the end
    details: False leaves out what no failure needs, as quick_check() does, and the least clearance
    The report of a single dragon is that of check() to the last bit. A dragon that stands, before its dance or after
    it, is judged only together with the others.
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dance, Dragon, Line, Part, Performance, Route
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> performance_check(crossing).failures[0].message
    'Bench 0 of dragon 0 and bench 0 of dragon 1 touch at 39.575000 s.'
    """
    budget = budget or Budget()
    begin, until = performance.span(start, stop)
    met = first_encounter(performance, margin=margin, stray=stray, start=begin, stop=stop, budget=budget)
    failures, reports = _encounter_failures(met), list[Report | None]()
    judge, least = check if details else quick_check, None
    if details and len(performance.parts) > 1:
        least = least_over(performance, met.stray, (begin, stop), budget, None if margin else met)
    for k, part in enumerate(performance.parts):
        first = None if start is None and begin <= part.begin else part.own_time(begin)
        last = None if part.end <= until else part.own_time(until)
        if max(begin, part.begin) >= min(until, part.end):
            reports.append(None)
            continue
        report = judge(
            part.dance, venue=performance.venue, margin=margin, stray=stray, speed_limit=speed_limit, start=first,
            stop=last, budget=budget,
        )  # fmt: skip
        reports.append(report)
        failures += [_of_dragon(performance, k, failure) for failure in report.failures]
    failures.sort(key=lambda failure: failure.time)
    undecided = all(failure.kind is FailureKind.UNDECIDED for failure in failures)
    verdict = Judgement.PASSES if not failures else Judgement.UNDECIDED if undecided else Judgement.FAILS
    return PerformanceReport(
        begin, until, verdict, not failures, tuple(failures), met, least, tuple(reports), performance
    )


def _of_dragon(performance: Performance, k: int, failure: Failure) -> PerformanceFailure:
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


def _encounter_failures(met: FirstEncounter) -> list[PerformanceFailure]:
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
        pair = _pair(met, dragons, benches)
        message = say("{pair} {meet} at {time:.6f} s at the latest.", pair=pair, meet=meet, time=bracket[1])
        return [PerformanceFailure(FailureKind.CONTACT, bracket[1], dragons, benches, message, bracket)]
    if met.time is None or met.dragons is None or met.benches is None:
        return []
    message = say("{pair} {meet} at {time:.6f} s.", pair=_pair(met, met.dragons, met.benches), meet=meet, time=met.time)
    return [PerformanceFailure(FailureKind.CONTACT, met.time, met.dragons, met.benches, message, bracket)]


def _pair(met: FirstEncounter, dragons: tuple[int, int], benches: tuple[int, int]) -> str:
    """Two benches at the beginning of a sentence, with their households and dragons."""
    a, b = (met.performance.parts[k].dance.dragon.called(bench) for k, bench in zip(dragons, benches, strict=True))
    one, two = map(met.performance.name_of, dragons)
    return say("Bench {a} of {one} and bench {b} of {two}", a=a, one=one, b=b, two=two)


@question_about("performance", Performance, "the trajectories were not computed")
def performance_trajectory(
    performance: Performance, times: ArrayLike, *, budget: Budget | None = None
) -> tuple[Trajectory, ...]:
    """Position and velocity of every handle of every dragon at every time of the performance, a Trajectory for each.

    times: (T,) or one [s]. Before and after its dance a dragon stands, with velocity 0. The Trajectory of a part
        without a delay is that of its dance, to the last bit, while it dances; others have no `dance` to plot
    raises: InvalidValue (times); TooMuchWork
    """
    return tuple(_trajectory_of(part, times, budget) for part in performance.parts)


@question_about("performance", Performance, "the ground that benches sweep was not found")
def performance_envelope(
    performance: Performance,
    *,
    start: float | None = None,
    stop: float | None = None,
    excess: float = 1e-3,
    budget: Budget | None = None,
) -> tuple[Envelope, ...]:
    """The ground that the benches of each dragon sweep, an Envelope for each, on the clock of its own dance.

    start, stop: of the performance [s], None for the beginning and the end; excess: see envelope()
    The ground of a dragon that stands is that of the first or the last STANDING of its dance.
    raises: InvalidValue; OutsideRun; TooMuchWork
    """
    begin, until = performance.span(start, stop)
    spans = [part.own_span(begin, until) for part in performance.parts]
    return tuple(
        envelope(part.dance, start=first, stop=last, excess=excess, budget=budget)
        for part, (first, last) in zip(performance.parts, spans, strict=True)
    )


def _trajectory_of(part: Part, times: ArrayLike, budget: Budget | None) -> Trajectory:
    time = checked_instants(times)
    own = np.clip(time - part.delay, part.dance.begin, part.dance.end.time)
    placed = trajectory(part.dance, own, budget=budget)
    stands = (time < part.begin) | (time > part.end)
    velocity, speed = placed.velocity.copy(), placed.speed.copy()
    velocity[stands], speed[stands] = 0.0, 0.0
    dances = part.dance if part.delay == 0.0 and not stands.any() else None
    return replace(placed, time=time, velocity=velocity, speed=speed, dance=dances)

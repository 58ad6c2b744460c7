"""The highest speed of any handle, and the largest constant head speed that keeps a limit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from core import kernels
from core.checks import checked_number
from core.contact.search import ContactSearch, SearchInput
from core.dance import Dance
from core.display import Readable
from core.errors import InvalidValue
from core.kernels import Budget, Judged
from core.passages import HEAD_SPEED_MAX, HEAD_SPEED_MIN, TIME_MAX, Period
from core.quantities import Quantity, bound
from core.questions import question_about
from core.sampling import bisect
from core.values import Interval

# Width of the proof: every handle stays below the highest rate found plus this [1]; the rate itself is good to 1e-12,
# except in the last moments before a fold, where rates grow without bound and lose digits.
RATE_TOLERANCE = 1e-9
# Step of the first samples of rates, as a part of the longest chord [1] ...
SAMPLE_STEP = 0.5
# ... and, on ways of many kilometres with fewer steps, their largest number of links of chains together [1].
SAMPLED_LINKS = 1_000_000
SAMPLES_MIN = 16
# Number of links of chains after which the slack grows fourfold [1]; they take 15 to 250 ms. So nearly equal peaks
# of many handles give a wider bracket, not a long search; the contest's turn takes about 30,000 over 200 s. An interval
# counts as at least twenty links (core/kernels/speed.py), and the slack grows at most twelve times, so every search
# is bounded.
LINKS_BUDGET = 250_000
# Largest slack before the proof is given up [1]: hundreds of benches on kilometres of winding curve exceed it.
LOOSEST_TOLERANCE = 1e-2
# Largest difference of rates that count as equal, so that several handles share the highest one [1].
TIED = 1e-9
# Allowance for the rounding of speeds, so that the maximum head speed itself is allowed [1].
SPEED_ROUNDING = 1e-12
# A limit counts as kept if it is proven to be exceeded by at most this part of it [1].
SPEED_PROVEN = 1e-6
# Width of the bracket of the first excess over a limit [s], or [m] of head travel at more than 1 m/s; but at least the
# error of a travel, TRAVEL_WIDTH of the longest one [1].
EXCESS_WIDTH = 5e-10
TRAVEL_WIDTH = 1e-14
# Number of links of chains after which that search is given up: about a second.
EXCESS_LINKS = 1_000_000
# Number of instants to try after that, towards the end of the interval, where the fold may be: each at half the
# distance of the one before.
HALVINGS = 50


@dataclass(frozen=True, slots=True, repr=False)
class HighestSpeed(Readable):
    """The highest speed of any handle over continuous time.

    speed: highest speed found; in the last moments before a fold it may be too high by 1e-6 of it [m/s]
    speed_bracket: highest speed found, then a proven upper bound (None if the search gave up before proving one) [m/s]
    time: time at which it is reached [s]
    handles: handles that reach it at that time
    passage: index of the passage in which it is reached; None: in none

    >>> from core import Dragon, Turn
    >>> fastest = highest_speed(Dance(Dragon(20), Turn(1.7)))
    >>> round(fastest.speed, 6), fastest.handles
    (1.604793, (3, 4, 5, 6, 7))
    """

    speed: float
    speed_bracket: tuple[float, float | None]
    time: float
    handles: tuple[int, ...]
    passage: int | None = None


@dataclass(frozen=True, slots=True, repr=False)
class MaximumHeadSpeed(Readable):
    """The largest speed of the head at which no handle exceeds a limit.

    head_speed: the largest one [m/s]
    head_speed_bracket: proven to keep the limit (None if the search gave up before proving one); found to reach it
        [m/s]
    speed_ratio: highest speed of any handle divided by that of the head
    handles: handles that reach the limit at that time
    time: time at which they reach it, at that head speed; 0 is the entry into a turn [s]
    time_at_unit_head_speed: the same time at a head speed of 1 m/s [s]
    passage: index of the passage in which they reach it; None: in none

    >>> from core import Dragon, Turn
    >>> answer = maximum_head_speed(Dance(Dragon(), Turn(1.7)), 2.0)
    >>> round(answer.head_speed, 6), answer.handles, round(answer.speed_ratio, 4)
    (1.246266, (3, 4, 5, 6, 7), 1.6048)
    """

    head_speed: float
    head_speed_bracket: tuple[float | None, float]
    speed_ratio: float
    handles: tuple[int, ...]
    time: float
    time_at_unit_head_speed: float
    passage: int | None = None


@dataclass(frozen=True, slots=True, repr=False)
class FirstExcess(Readable):
    """First time at which a handle is faster than a limit.

    time: the second of the times below, the latest possible first excess; None if the proof was given up and none was
        found [s]
    time_bracket: time until which the limit is proven to be kept, to within SPEED_PROVEN of it; time at which a handle
        is faster. It is no wider than EXCESS_WIDTH unless the proof was given up, near a fold or after EXCESS_LINKS;
        without an excess it ends with the interval [s]
    handle: the fastest handle then; None if none was found

    >>> from core import Dragon, Turn
    >>> first_excess(Dance(Dragon(), Turn(1.7)), 1.5)
    <FirstExcess: time 14.1296394 s, handle 1>
    """

    time: float | None
    time_bracket: Interval
    handle: int | None


@question_about("dance", Dance, "the highest speed was not found")
def highest_speed(
    dance: Dance, *, start: float | None = None, stop: float | None = None, budget: Budget | None = None
) -> HighestSpeed:
    """The highest speed of any handle over continuous time, with the handles that reach it.

    start, stop: [s]; defaults: dance.begin and the end of the run
    After sampling, every interval of time is proven to exceed the highest rate by at most RATE_TOLERANCE, and every
    peak on the way is refined on the exact derivative. At a joint the speed is continuous and its derivative jumps, so
    a peak may be a kink. See core/kernels/speed.py.
    raises: InvalidValue (stop) for a spiral up to its fold, where speeds grow without bound; TooMuchWork

    >>> from core import Dragon, Turn
    >>> round(highest_speed(Dance(Dragon(), Turn(1.7))).speed, 6)
    1.604793
    """
    clock, end = dance.clock, dance.end
    stop = None if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
    if dance.ends_by(end.time if stop is None else stop):
        values = {"end": bound(end.time, 9, "s"), **end.values}
        if stop is None:
            why = (
                "the run ends at a fold, towards which speeds grow without bound; "
                "it must be before {end}, when bench {bench} folds"
            )
            raise InvalidValue("stop", f"must be given: {why}", **values)
        rule = "must be before {end}, when bench {bench} folds and speeds grow without bound"
        raise InvalidValue("stop", rule, got=Quantity(stop, "s"), **values)
    begin, until = dance.whole_span(start, stop)
    search = ContactSearch(SearchInput(dance.dragon, dance.path, 0.0, whole=True), budget=budget)
    peaks = [_peak_of(search, period) for period in clock.periods(begin, until)]
    highest = max(peaks, key=lambda peak: peak.speed)
    proven = [peak.speed_bracket[1] for peak in peaks]
    upper = None if None in proven else max(speed for speed in proven if speed is not None)
    return replace(highest, speed_bracket=(highest.speed, upper))


def _peak_of(search: ContactSearch, period: Period) -> HighestSpeed:
    """The highest speed in a part of the dance with one head speed; 0 in a pause."""
    speed = period.speed
    if speed == 0.0:
        return HighestSpeed(0.0, (0.0, 0.0), period.begin, (0,), period.passage)
    peak = peak_over(search, period.first, period.last)
    rate, upper, travel = float(peak.rate), float(peak.upper), float(peak.travel)
    rates = np.abs(search.rates(travel))
    # Near a fold two chains differ by more than TIED, and the largest rate of this one counts.
    tied = tuple(int(k) for k in np.flatnonzero(rates >= min(rate, float(rates.max())) * (1.0 - TIED)))
    proven = upper * speed if upper < kernels.FREE else None
    return HighestSpeed(rate * speed, (rate * speed, proven), period.time(travel), tied, period.passage)


def peak_over(search: ContactSearch, begin: float, until: float) -> kernels.Peak:
    """The highest rate between two travels of the head [m], sampled and proven: see core/kernels/speed.py."""
    benches, alike = search.dragon.benches, search.dragon.uniform_from
    rounding = search.travel_rounding(begin, until)
    samples = max(SAMPLES_MIN, SAMPLED_LINKS // (benches + 1))
    step = max(SAMPLE_STEP * float(search.rings.all_chord), (until - begin) / samples)
    peak = kernels.Peak(search.interval, search.probed, _calm(search), alike, begin, until, rounding)
    peak.sample(step)
    search.budget.afford()
    peak.prove(step, RATE_TOLERANCE, LOOSEST_TOLERANCE, LINKS_BUDGET)
    search.budget.afford()
    return peak


def _calm(search: ContactSearch) -> float:
    """Lag from which backwards handles are no faster than those before them, and are left out."""
    return search.path.calm(2.0 * kernels.SINE_LIMIT / search.rings.all_chord)


@question_about("dance", Dance)
def maximum_head_speed(
    dance: Dance,
    speed_limit: float,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> MaximumHeadSpeed:
    """The largest constant head speed at which no handle ever exceeds the limit.

    speed_limit: [m/s]; start, stop: [s at a head speed of 1 m/s], as in highest_speed()
    All speeds are proportional to the head speed, so this is the limit divided by the highest rate. A dance with
    passages becomes faster or slower as a whole: the speeds of its passages grow in proportion to the head speed, and
    the times that end them fall in inverse proportion.
    raises: InvalidValue; TooMuchWork

    >>> from core import Dragon, Turn
    >>> round(maximum_head_speed(Dance(Dragon(), Turn(1.7)), 2.0).head_speed, 6)
    1.246266
    """
    limit = checked_limit(speed_limit)
    highest = highest_speed(dance.played(1.0), start=start, stop=stop, budget=budget)
    speed, upper = limit / highest.speed, highest.speed_bracket[1]
    bracket = (None if upper is None else limit / upper, speed)
    times = (highest.time / speed, highest.time)
    return MaximumHeadSpeed(speed, bracket, highest.speed, highest.handles, *times, highest.passage)


@question_about("dance", Dance, "the first time that a handle is too fast was not found")
def first_excess(
    dance: Dance,
    speed_limit: float,
    *,
    start: float | None = None,
    stop: float | None = None,
    budget: Budget | None = None,
) -> FirstExcess | None:
    """First time at which a handle is faster than the limit; None if none is, proven to within a millionth of it.

    speed_limit: [m/s], exceeded by more than 1e-12 of it; an excess below SPEED_PROVEN, 1e-6 of it, may be passed over
    start, stop: as in highest_speed(), but stop may be a fold, towards which speeds grow without bound
    The proof that no handle was faster before is that of core/kernels/excess.py.
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dragon, Turn
    >>> excess = first_excess(Dance(Dragon(), Turn(1.7)), 1.5)
    >>> round(excess.time, 3), excess.handle
    (14.13, 1)
    """
    limit = checked_limit(speed_limit)
    begin, until = dance.whole_span(start, stop)
    sought = SearchInput(dance.dragon, dance.path, 0.0, timing=dance.clock.rounding(until), whole=True)
    search, undecided = ContactSearch(sought, budget=budget), None
    for period in dance.clock.periods(begin, until):
        excess = _excess_in(search, period, limit) if period.speed > 0.0 else None
        if excess is None:
            continue
        if excess.time is None:
            undecided = undecided or excess
        elif undecided is None:
            return excess
        else:  # after the time at which a proof was given up
            return replace(excess, time_bracket=(undecided.time_bracket[0], excess.time))
    return None if undecided is None else replace(undecided, time_bracket=(undecided.time_bracket[0], until))


def _excess_in(search: ContactSearch, period: Period, limit: float) -> FirstExcess | None:
    """The first excess in a part of the dance with one head speed."""
    ratio = limit / period.speed
    outcome, excess = _excess(search, period.first, period.last, period.speed, ratio)
    if outcome is Judged.EXCEEDED:
        time = period.time(excess.exceeded)
        return FirstExcess(time, (period.time(excess.proven), time), excess.handle)
    return None if outcome is Judged.KEPT else _late_excess(search, ratio, period, period.time(excess.proven))


def _excess(
    search: ContactSearch, first: float, last: float, head_speed: float, ratio: float
) -> tuple[Judged, kernels.Excess]:
    """The search for the first excess over a rate between two travels of the head [m], and its outcome."""
    rounding = search.travel_rounding(first, last)
    step, way = SAMPLE_STEP * float(search.rings.all_chord), max(abs(first), abs(last), search.place)
    limit, kept = ratio * (1.0 + SPEED_ROUNDING), ratio * (1.0 + SPEED_PROVEN)
    width = max(EXCESS_WIDTH * min(1.0, head_speed), TRAVEL_WIDTH * way, 4.0 * rounding)
    excess = kernels.Excess(search.interval, _calm(search))
    outcome = excess.run(first, last, step, limit, kept, width, rounding, EXCESS_LINKS)
    search.budget.afford()
    return outcome, excess


def _late_excess(search: ContactSearch, ratio: float, period: Period, proven: float) -> FirstExcess:
    """An excess after the time at which a proof was given up [s], tried at instants that approach both ends:
    at a corner of the path a handle may become faster all at once."""

    def faster(time: float) -> int | None:
        """A handle that is certainly faster than the limit at an instant."""
        travel = period.travel(time)
        outcome, excess = _excess(search, travel, travel, period.speed, ratio)
        return excess.handle if outcome is Judged.EXCEEDED else None

    until = period.end
    ways = [(until - proven) * 0.5**k for k in range(1, HALVINGS)]
    times = [*(proven + way for way in reversed(ways)), *(until - way for way in ways), until]
    high = next((time for time in times if faster(time) is not None), None)
    if high is None:
        return FirstExcess(None, (proven, until), None)
    low = max([proven, *(time for time in times if time < high)])
    low, high = bisect(lambda time: faster(time) is not None, low, high)
    return FirstExcess(high, (proven, high), faster(high))


def checked_limit(speed_limit: object) -> float:
    """The speed limit [m/s], if it is in the allowed range."""
    return checked_number("speed_limit", speed_limit, "m/s", HEAD_SPEED_MIN, HEAD_SPEED_MAX)

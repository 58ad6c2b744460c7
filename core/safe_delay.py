"""Safe delays: the delays of one dragon of a performance at which it meets no other one.

A bench of the part that is delayed moves, if the delay changes by at most h, no further than
    x = gain * rate * v * h
at any instant: the head is at most v h from its place along the path, v its highest speed; every handle follows by at
most `rate` times that, the highest speed of a handle over that of the head; and no point of a bench moves further than
`gain` times the way of its two holes (core/shapes/reach.py). Before the beginning and after the end of its dance it
stands, which does not add to that. Two consequences:

Safe. Let the benches of the part be wider by x on all sides. If no dragons meet then at the delay d, in a march that
proves it (march.py), none do at any delay from d - h to d + h, because every bench lies within its wider one.

Met. The separation of two benches changes by no more than their points move. If at the delay d two benches are within
the margin less x at some instant, in spite of rounding, they are within the margin at this instant at every delay from
d - h to d + h.

Intervals for which neither holds are halved, down to LEAST.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from core.checks import checked_number
from core.contact.brackets import TOUCHES
from core.contact.search import MARGIN_MAX, WORK_BUDGET
from core.contact.stage import Player, Stage
from core.contact.stage_march import EncounterMarch
from core.dance import Dance
from core.display import Readable, format_range
from core.dragon import Stray
from core.errors import InvalidValue
from core.extremes.speed import highest_speed
from core.kernels import Budget, Ended
from core.kernels.constants import HALF_LENGTH
from core.kernels.results import Marched
from core.language import say
from core.passages import TIME_MAX
from core.performance import DELAY_MAX, Part, Performance
from core.quantities import Parameter, Quantity, bound, quantities
from core.questions import question_about
from core.shapes.reach import gains
from core.values import Interval, Pair

# Shortest interval of delays that is halved, and largest uncertainty of an end of a safe interval [s].
LEAST, END_WIDTH = 0.002, 0.01
# Half the bracket around a crossing in a march for an interval of delays, as a part of half the interval [1]: such a
# march only has to pass, so its steps need not be shorter than that.
BRACKET_PART = 0.1
# Number of samples of the separation of two benches after they meet, within the time in which a head passes both [1].
SAMPLES = 24
# Rounds of samples, each but the first one between the neighbours of the deepest sample, and their number [1].
ZOOMS, ZOOMED = 3, 9
# How far beyond a met interval the next delay is tried, as a part of half of it, and how often that is halved [1].
AHEAD, HALVINGS = 0.8, 4
# Work of one question [1], see core/kernels/constants.py: about a minute; of a sample of the separation of two benches,
# and of the beginning of a march for each bench of all dragons.
DELAY_WORK, SAMPLE_WORK, BENCH_WORK = 4e8, 400.0, 20.0
# Part by which bounds are enlarged for the rounding of their own numbers [1].
SPARE = 1e-9

Intervals = tuple[Interval, ...]
Stretches = list[Interval]


@dataclass(frozen=True, slots=True, repr=False)
class SafeDelays(Readable):
    """The delays of one dragon at which no dragons of a performance meet.

    safe: intervals of delays that are proven safe; an end is within 0.01 s of a delay that is not, or at an end of the
        interval that was asked about, or at an undecided one [s]
    undecided: intervals of which neither is proven. At all other delays two dragons certainly meet, but for 0.01 s
        beside a safe interval [s]
    part: number of the dragon
    least: shortest delay of the question [s]
    most: longest delay of the question [s]
    margin: the required margin; 0: only a touch counts [m]
    stray: largest distance of a hole from its place, by people and by play [m]
    stop: end of the judged time; None: the end of the performance at every delay [s]
    marches: number of searches
    performance: the performance of the question

    >>> from core import Dragon, Line, Route
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> len(safe_delay(crossing, 1, -60.0, 60.0).safe)
    2
    """

    safe: Intervals
    undecided: Intervals
    part: int
    least: float
    most: float
    margin: float
    stray: float
    stop: float | None
    marches: int
    performance: Performance = field(repr=False, compare=False)

    def _line(self) -> str:
        def listed(intervals: Intervals) -> str:
            return ", ".join(format_range(interval, "s") for interval in intervals) or say("none")

        values = {"name": self.performance.name_of(self.part), "safe": listed(self.safe)}
        span = format_range((self.least, self.most), "s")
        if not self.undecided:
            return say("delays of {name} from {span}: safe {safe}", span=span, **values)
        values["undecided"] = listed(self.undecided)
        return say("delays of {name} from {span}: safe {safe}; undecided {undecided}", span=span, **values)


@question_about("performance", Performance, "the safe delays were not found")
def safe_delay(
    performance: Performance,
    part: int | str,
    least: float = 0.0,
    most: float = 600.0,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    stop: float | None = None,
    budget: Budget | None = None,
) -> SafeDelays:
    """The delays of one dragon, from `least` to `most` [s], at which no two dragons come within the margin.

    part: its number or its name; the delay that it has in the performance does not matter
    margin: required clearance [m]; stray: largest distance of every hole from its place [m]
    stop: time of the performance up to which it is judged [s]; needed, and before the fold, if a dragon folds
    budget: default: DELAY_WORK
    returns: see SafeDelays. Every safe interval is proven for all of its delays; what each dragon does by itself does
        not count
    raises: InvalidValue; TooMuchWork

    >>> from core import Dance, Dragon, Line, Part, Performance, Route
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> [tuple(round(end, 1) for end in interval) for interval in safe_delay(crossing, 1, -60.0, 60.0).safe]
    [(-60.0, -10.3), (10.3, 60.0)]
    """
    k = performance.number_of(part)
    low = checked_number("least", least, "s", -DELAY_MAX, DELAY_MAX)
    high = checked_number("most", most, "s", -DELAY_MAX, DELAY_MAX)
    if low >= high:
        raise InvalidValue("most", "must be more than least ({least})", **quantities("s", got=high, least=low))
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed = performance.checked_stray(stray)
    until = None if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
    _refuse_folds(performance, k, low, until)
    search = _Search(performance, k, (low, high), margin, strayed, until, (budget or Budget()).within(DELAY_WORK))
    safe, undecided = search.run(low, high)
    return SafeDelays(safe, undecided, k, low, high, margin, strayed, until, search.marches, performance)


def _refuse_folds(performance: Performance, k: int, least: float, stop: float | None) -> None:
    """raises: InvalidValue if a dragon may fold in the judged time, where its speeds have no bound"""
    for number, part in enumerate(performance.parts):
        fold = part.dance.end.time + (least if number == k else part.delay)
        if part.folds and (stop is None or stop >= fold):
            values = {"fold": bound(fold, 6, "s")}
            got = {} if stop is None else {"got": Quantity(stop, "s")}
            rule = "must be before {fold}, when a bench of {part} may fold"
            if stop is None:
                rule = "must be given, before {fold}, when a bench of {part} may fold"
            raise InvalidValue("stop", rule, part=Parameter(f"parts.{number}"), **values, **got)


# Input:  a performance, one of its parts, and the interval of its delays.
# State:  the stack of intervals that are left; the safe, met and unknown ones so far.
# Output: the safe and the undecided intervals.
class _Search:
    """Search for the safe delays, see the top of this file.

    ways: (n,) x / h of the benches of the part [m/s]; look: a stage at which single delays are examined
    """

    def __init__(
        self,
        performance: Performance,
        k: int,
        interval: Interval,
        margin: float,
        stray: float,
        stop: float | None,
        budget: Budget,
    ) -> None:
        self.performance, self.k, self.margin, self.stray, self.stop = performance, k, margin, stray, stop
        self.budget, self.marches, self.met = budget, 0, Stretches()
        part = performance.parts[k]
        dance, clock = part.dance, part.dance.clock
        last = min(dance.end.time, math.inf if stop is None else stop - interval[0])
        last = clock.travel(max(last, dance.begin))
        lone = Dance(dance.dragon, dance.path, 1.0)
        rate: float | None = 1.0
        if last > lone.begin:
            rate = highest_speed(lone, start=lone.begin, stop=min(last, lone.end.time), budget=budget).speed_bracket[1]
        if rate is None:
            why = "no bound on the speed of the handles of {part} is known up to there"
            got = {} if stop is None else {"got": Quantity(stop, "s")}
            raise InvalidValue("stop", f"must be earlier: {why}", part=Parameter(f"parts.{k}"), **got)
        self.ways = gains(dance.dragon) * max(rate, 1.0) * max(clock.speeds) * (1.0 + SPARE)
        self.interval = interval
        self.look = self._stage(part, sum(interval) / 2.0, interval)

    def _stage(self, part: Part, delay: float, delays: Interval) -> Stage:
        """A stage with the part at a delay, over the judged time of an interval of delays [s]."""
        others = [one for number, one in enumerate(self.performance.parts) if number != self.k]
        begin = min([part.dance.begin + delays[0], *(one.begin for one in others)])
        until = max([part.dance.end.time + delays[1], *(one.end for one in others)]) if self.stop is None else self.stop
        parts = list(self.performance.parts)
        parts[self.k] = replace(part, delay=delay)
        span = (begin, max(until, begin + LEAST))
        delayed = Performance(parts)
        return Stage(delayed, span, self.margin, stray=self.stray, work=WORK_BUDGET, budget=self.budget)

    def run(self, least: float, most: float) -> tuple[Intervals, Intervals]:
        """The safe and the undecided intervals between two delays [s]."""
        safe: Stretches = []
        unknown: Stretches = []
        left, clear = [(least, most)], set[float]()
        if len(self.performance.parts) == 1:
            return ((least, most),), ()
        while left:
            low, high = left.pop()
            self.budget.afford()
            if self._is_safe(low, high):
                safe.append((low, high))
                continue
            if high - low <= LEAST:
                unknown.append((low, high))
                continue
            middle = 0.5 * (low + high)
            around = (middle, middle) if middle in clear else self._met_around(middle, low, high)
            if around[0] < around[1]:
                self.met.append(around)
            left += [(around[1], high), (low, around[0])] if around[1] > around[0] else [(middle, high), (low, middle)]
            left = [one for one in left if one[0] < one[1]]
        safe = _merged(safe)
        return tuple(safe), tuple(self._undecided(_merged(unknown), safe))

    def _undecided(self, unknown: Stretches, safe: Stretches) -> Stretches:
        """The unknown intervals, without short ones between a safe and a met one: one of its ends is there."""
        ends = {end for one in safe for end in one}
        met = {end for one in _merged(self.met) for end in one}

        def is_end(low: float, high: float) -> bool:
            between = (low in ends and high in met) or (low in met and high in ends)
            return between and high - low <= END_WIDTH

        return [one for one in unknown if not is_end(*one)]

    def _is_safe(self, low: float, high: float) -> bool:
        """True if all delays of an interval are proven safe."""
        half = 0.5 * (high - low) * (1.0 + SPARE) + SPARE * LEAST
        part = self.performance.parts[self.k]
        dance, wider = part.dance, self.ways * half
        dragon = dance.dragon.outlined(dance.dragon.overhangs + wider, dance.dragon.widths + 2.0 * wider)
        moved = replace(part, dance=Dance(dragon, dance.path, dance.head_speed, dance.passages))
        stage = self._stage(moved, 0.5 * (low + high), (low, high))
        return self._march(stage, BRACKET_PART * half).ended is Ended.REACHED

    def _march(self, stage: Stage, half: float | None) -> Marched:
        self.marches += 1
        self.budget.afford(BENCH_WORK * len(stage.owner))
        march = EncounterMarch(stage, dips=False)
        begin = max(stage.span[0], stage.clear_until())
        if begin >= stage.span[1]:
            return Marched(Ended.REACHED, begin)
        return march.run(begin, stage.span[1]) if half is None else march.try_once(begin, stage.span[1], half)

    def _met_around(self, delay: float, low: float, high: float) -> Interval:
        """An interval of delays around one, within [low, high], at which two benches certainly meet [s]; if there is
        none, the delay itself twice."""
        part = self.performance.parts[self.k]
        stage = self._stage(part, delay, (delay, delay))
        met = self._march(stage, None)
        if met.ended not in TOUCHES or met.touching is None:
            return delay, delay
        rows = met.pair
        sizes = [2.0 * float(self.look.own_sizes[row, HALF_LENGTH]) for row in rows]
        fastest = max(max(player.clock.speeds) for player in self.look.players)
        times = met.touching + np.linspace(0.0, 1.0, SAMPLES) * sum(sizes) / fastest
        time, half = self._deepest(delay, times, rows)
        if half <= 0.0:
            return delay, delay
        ends = []
        for side, end in ((-1.0, low), (1.0, high)):
            ends.append(self._grown(delay, side, end, time, half, rows))
        return max(low, ends[0]), min(high, ends[1])

    def _grown(self, delay: float, side: float, end: float, time: float, half: float, rows: Pair) -> float:
        """The furthest delay up to which two benches are followed that certainly meet [s]."""
        reach, part = delay + side * half, AHEAD
        while side * (end - reach) > 0.0 and half > 0.25 * LEAST:
            if self._stands(delay, side, time, rows):
                return end
            for _ in range(HALVINGS):
                ahead = reach + side * part * half
                shift = ahead - delay
                later, wide = self._deepest(ahead, time + shift * np.linspace(-1.0, 1.0, 9), rows)
                if wide > 1.01 * part * half:
                    reach, delay, time, half = ahead + side * wide, ahead, later, wide
                    break
                part *= 0.5
            else:
                break
            part = min(AHEAD, 2.0 * part)
        return reach

    # Two benches that meet at a time t of a delay d meet at every longer delay d' too if
    # - the dragon has not begun at t: with d' neither has it. If the performance begins later than t with d', all stand
    #   at its beginning as they do at t;
    # - the other one's path has ended at t: at t + d' - d the dragon is where it was, and the other one still stands.
    #   If the performance has ended by then, all stand at its end as they do at t. A stop may come before.
    # The same holds for shorter delays with beginnings and ends exchanged.
    def _stands(self, delay: float, side: float, time: float, rows: Pair) -> bool:
        """True if two benches that meet at a time meet at all delays on this side, because one of them stands then."""
        owners = [int(self.look.owner[row]) for row in rows]
        if self.k not in owners:
            return False
        other = self.performance.parts[sum(owners) - self.k]
        dance, own = self.performance.parts[self.k].dance, time - delay
        if side > 0.0:
            return own <= dance.begin or (self.stop is None and time >= other.end)
        return own >= dance.end.time or time <= other.begin

    def _deepest(self, delay: float, times: np.ndarray, rows: Pair) -> tuple[float, float]:
        """The time at which two benches are deepest within the margin at a delay, and half the width of the interval of
        delays around it at which they are within it at that time [s]."""
        look, k = self.look, self.k
        player = look.players[k]
        look.players[k] = Player(replace(player.part, delay=delay), player.search, player.first, look.span)
        until = look.span[1]
        gap, time = math.inf, float(times[0])
        laid_out = sum(row - look.players[int(look.owner[row])].first + 2 for row in rows)
        for _ in range(ZOOMS):
            inside = np.clip(times, look.span[0], until).tolist()
            self.budget.afford((SAMPLE_WORK + laid_out) * len(inside))
            gaps = [look.gap_most(time, rows) for time in inside]
            nearest = int(np.argmin(gaps))
            gap, time = min((gap, time), (gaps[nearest], inside[nearest]))
            times = np.linspace(inside[max(nearest - 1, 0)], inside[min(nearest + 1, len(inside) - 1)], ZOOMED)
        # no pair of two other dragons depends on the delay
        ways = [float(self.ways[row - player.first]) for row in rows if look.owner[row] == k]
        if not ways:
            return time, (self.interval[1] - self.interval[0]) if gap <= self.margin else 0.0
        return time, (self.margin - gap) / ways[0] * (1.0 - SPARE)


def _merged(intervals: Stretches) -> Stretches:
    """The same intervals in order, those that meet joined."""
    merged: Stretches = []
    for low, high in sorted(intervals):
        if merged and low <= merged[-1][1]:
            merged[-1] = merged[-1][0], max(merged[-1][1], high)
        else:
            merged.append((low, high))
    return merged

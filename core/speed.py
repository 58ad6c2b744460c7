"""The highest speed of any handle, and the largest constant head speed that keeps a limit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core import kernels
from core.dragon import Dragon, checked_number
from core.errors import InvalidValue
from core.kinematics import HEAD_SPEED_MAX, EndReason, checked_head_speed, checked_span, earliest_time, run_end
from core.paths import Spiral
from core.route import Route
from core.search import Search

# Every handle is proven to stay below this much above the highest rate found [1]; the rate itself is good to 1e-12.
RATE_TOLERANCE = 1e-9
# Rates are first sampled in steps of this part of the longest chord [1] ...
SAMPLE_STEP = 0.5
# ... or in as many as take so many links of chains, on ways of many kilometres [1].
SAMPLED_LINKS = 1_000_000
SAMPLES_MIN = 16
# The tolerance grows fourfold after so many links of chains, 15 to 250 ms, so that nearly equal peaks of many handles
# end in a wider bracket instead of a long search; the turn of the contest takes about 30,000 over 200 s. An interval
# counts as twenty links at least (core/kernels/speed.py), and twelve times the tolerance may grow: no search is longer.
LINKS_BUDGET = 250_000
# With a tolerance of more than this the proof is given up [1]: hundreds of benches on kilometres of winding curve.
LOOSEST_TOLERANCE = 1e-2
# Handles whose rates differ by less share the highest one [1].
TIED = 1e-9


@dataclass(frozen=True, slots=True)
class HighestSpeed:
    """speed: the highest found [m/s]; time [s]; handles: those that reach it together
    speed_bracket: (found, proven not to be exceeded: None where the proof was given up) [m/s]"""

    speed: float
    speed_bracket: tuple[float, float | None]
    time: float
    handles: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class MaximumHeadSpeed:
    """head_speed: the largest [m/s]
    head_speed_bracket: (proven to keep the limit: None where the proof was given up, found to reach it) [m/s]
    speed_ratio: highest handle speed over head speed; handles: those that reach the limit together
    time: when they do at that head speed [s]; time_at_unit_head_speed [s]"""

    head_speed: float
    head_speed_bracket: tuple[float | None, float]
    speed_ratio: float
    handles: tuple[int, ...]
    time: float
    time_at_unit_head_speed: float


def highest_speed(
    dragon: Dragon,
    path: Spiral | Route,
    *,
    head_speed: float = 1.0,
    start: float | None = None,
    stop: float | None = None,
) -> HighestSpeed:
    """The highest speed of any handle over continuous time, with the handles that reach it.

    start, stop: [s]; the defaults are 0 (on a route: when it begins, or the whole dragon is on it) and the end of
        the run
    Sampled, then every interval of time is proven not to exceed the highest rate by more than RATE_TOLERANCE, and
    every peak met on the way is refined on the exact derivative. At a joint the speed is continuous and its
    derivative jumps, so a peak may be a kink. See core/kernels/speed.py.
    raises: InvalidValue (stop) for a spiral danced to its fold, where speeds grow without bound
    """
    head_speed = checked_head_speed(head_speed)
    end = run_end(dragon, path, head_speed=head_speed)
    if end.reason is EndReason.FOLD and (stop is None or stop >= end.time):
        raise InvalidValue(
            "stop", f"stop must be before {end.time:.9f} s, when bench {end.bench} folds and speeds grow without bound"
        )
    if start is None:
        begin = path.begin / head_speed if isinstance(path, Route) else 0.0
        start = max(begin, earliest_time(dragon, path, head_speed))
    begin, until = checked_span(dragon, path, start, stop, end, head_speed)
    search = Search(dragon, path, 0.0)
    search.resize(dragon.benches)
    rate, upper, travel, _ = peak_over(search, begin * head_speed, until * head_speed)
    rates = np.abs(search.rates(travel))
    tied = tuple(int(k) for k in np.flatnonzero(rates >= rate * (1.0 - TIED)))
    proven = upper * head_speed if upper < kernels.FREE else None
    return HighestSpeed(rate * head_speed, (rate * head_speed, proven), travel / head_speed, tied)


def peak_over(search: Search, begin: float, until: float) -> tuple[float, float, float, float]:
    """kernels.peak_rate() between two travels of the head [m]: the rate, its upper bound, the travel, the intervals."""
    benches, out = search.dragon.benches, np.empty(4)
    samples = max(SAMPLES_MIN, SAMPLED_LINKS // (benches + 1))
    kernels.peak_rate(
        search.growth,
        search.pieces,
        search.place,
        begin,
        until,
        max(SAMPLE_STEP * float(search.extremes[0]), (until - begin) / samples),
        RATE_TOLERANCE,
        LOOSEST_TOLERANCE,
        LINKS_BUDGET,
        benches,
        _calm(search),
        search.sizes,
        search.rows,
        search.motion,
        out,
    )
    rate, upper, travel, intervals = out.tolist()
    return rate, upper, travel, intervals


def _calm(search: Search) -> float:
    """What kernels.peak_rate needs to leave out handles that are no faster than those before them."""
    if isinstance(search.path, Route):
        return 1.0 if search.path.calm_beginning else 0.0
    return search.growth * search.path.gentle_theta(2.0 * kernels.BEND_LIMIT / search.extremes[0])


def maximum_head_speed(
    dragon: Dragon,
    path: Spiral | Route,
    speed_limit: float,
    *,
    start: float | None = None,
    stop: float | None = None,
) -> MaximumHeadSpeed:
    """The largest constant head speed at which no handle ever exceeds the limit.

    speed_limit: [m/s]; start, stop: [s at a head speed of 1 m/s], as in highest_speed()
    Speeds are proportional to the head's, so this is the limit over the highest rate.
    raises: InvalidValue
    """
    if isinstance(speed_limit, (int, float)) and speed_limit <= 0:
        raise InvalidValue("speed_limit", f"speed_limit must be positive, got {speed_limit} m/s")
    limit = checked_number("speed_limit", speed_limit, "m/s", 1e-6, HEAD_SPEED_MAX)
    found = highest_speed(dragon, path, start=start, stop=stop)
    speed = limit / found.speed
    highest = found.speed_bracket[1]
    bracket = (None if highest is None else limit / highest, speed)
    return MaximumHeadSpeed(speed, bracket, found.speed, found.handles, found.time / speed, found.time)

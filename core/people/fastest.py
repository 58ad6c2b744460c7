"""The fastest moment of each bench.

The dance is sampled at travels of the head (travels_between()); the moment is then narrowed to FASTEST_WIDTH between
the two neighbours of the fastest sample. So no sample is faster, and the speed is really reached.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.dance import Dance
from core.display import Readable
from core.kernels import Budget
from core.motion.trajectory import trajectory
from core.passages import Period
from core.people.meetings import instants_at_once, travels_within
from core.values import Floats

# Width to which a fastest moment is narrowed [m of head travel], and the golden section that narrows it [1].
FASTEST_WIDTH = 1e-7
SECTION = 0.5 * (np.sqrt(5.0) - 1.0)


@dataclass(frozen=True, slots=True, repr=False)
class FastestMoment(Readable):
    """The moment at which one of the two handles of a bench is fastest.

    time: the moment [s]
    speed: higher speed of its two handles: reached then, and not exceeded every 0.25 m of head way [m/s]
    head_speed: speed of the head at that moment [m/s]
    handle: the handle: the number of the bench, or one more for its rear one
    x: x of that handle then [m]
    y: y of that handle then [m]

    >>> from core import Dragon, Spiral, bench_cues
    >>> fastest = bench_cues(Dance(Dragon(12), Spiral()), [5], stop=60.0)[0].fastest
    >>> fastest.handle, round(fastest.speed, 5)
    (5, 0.99995)
    """

    time: float
    speed: float
    head_speed: float
    handle: int
    x: float
    y: float


def fastest_moments(steady: Dance, benches: list[int], walks: list[Period], budget: Budget) -> list[FastestMoment]:
    """The fastest moment of each bench. walks: periods in which the head walks, each with one speed"""
    best, count = np.full(len(benches), -np.inf), len(benches)
    low, high, walk = np.empty(count), np.empty(count), np.zeros(count, dtype=np.intp)
    at_once = max(3, instants_at_once(steady))
    for number, period in enumerate(walks):
        travels = travels_within(steady, period.first, period.last)
        for first in range(0, len(travels), at_once):
            some = travels[first : first + at_once]
            speed = period.speed * _rates(steady, benches, some, budget)
            row, most = speed.argmax(axis=0), speed.max(axis=0)
            better = most > best
            best[better], walk[better] = most[better], number
            low[better] = travels[np.maximum(first + row[better] - 1, 0)]
            high[better] = travels[np.minimum(first + row[better] + 1, len(travels) - 1)]
    travel = _peaks(steady, benches, low, high, budget)
    speeds, moments = np.diagonal(_rates(steady, benches, travel, budget)), []
    for k, bench in enumerate(benches):
        period, at = walks[walk[k]], trajectory(steady, [travel[k]])
        handle = bench + int(at.speed[0, bench + 1] > at.speed[0, bench])
        place = at.position[0, handle].tolist()
        moments.append(
            FastestMoment(period.time(float(travel[k])), float(speeds[k] * period.speed), period.speed, handle, *place)
        )
    return moments


def _rates(steady: Dance, benches: list[int], travels: Floats, budget: Budget) -> Floats:
    """Speed of the faster handle of each bench at each travel, per m/s of the head (R, B) [1]."""
    speed = trajectory(steady, travels, budget=budget).speed
    front = np.array(benches)
    rates: Floats = np.maximum(speed[:, front], speed[:, front + 1])
    return rates


# A golden section finds a peak surely only if it is the only one and smooth. So the answer is the best of all travels
# tried, both ends among them.
def _peaks(steady: Dance, benches: list[int], low: Floats, high: Floats, budget: Budget) -> Floats:
    """Travel at which each bench is fastest between two travels (B,) [m]."""

    def rates(travels: Floats) -> Floats:
        parts = [
            np.diagonal(_rates(steady, benches[k : k + at_once], travels[k : k + at_once], budget))
            for k in range(0, len(benches), at_once)
        ]
        return np.concatenate(parts)

    at_once = instants_at_once(steady)
    middle = 0.5 * (low + high)
    tried = [(middle, rates(middle))]
    low, high = low.copy(), high.copy()
    tried += [(one.copy(), rates(one)) for one in (low, high)]
    while float((high - low).max()) > FASTEST_WIDTH:
        inner, outer = high - SECTION * (high - low), low + SECTION * (high - low)
        at_inner, at_outer = rates(inner), rates(outer)
        tried += [(inner, at_inner), (outer, at_outer)]
        falls = at_inner >= at_outer
        high, low = np.where(falls, outer, high), np.where(falls, low, inner)
    best = np.argmax([rate for _, rate in tried], axis=0)
    travels: Floats = np.stack([travel for travel, _ in tried])[best, np.arange(len(benches))]
    return travels

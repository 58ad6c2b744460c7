"""The sharpest bend between two consecutive benches over an interval of the dance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from core.contact.gaps import PROFILE_STEP, SAMPLES
from core.dance import Dance
from core.display import Readable
from core.kernels import Budget
from core.motion.trajectory import trajectory
from core.paths.following import longest_arc
from core.questions import question_about
from core.sampling import dips
from core.values import Floats, Pair

# Refinement of a peak to 1e-9 of a step: instants of one round around it, in steps; number of rounds; and number of
# highest peaks to refine.
ZOOM = np.linspace(-1.0, 1.0, 33)
ZOOM_ROUNDS = 7
PEAKS_REFINED = 5
# Angles with a smaller difference count as equal [rad], and the first one is taken.
SAME_ANGLE = 1e-13
# Number of instants whose handles are held in memory at once.
BATCH = 1_000


@dataclass(frozen=True, slots=True, repr=False)
class SharpestBend(Readable):
    """Largest angle between two consecutive benches; of a path see TightBend.

    angle: angle between their headings [rad]
    time: time at which it is reached [s]
    benches: the two benches

    >>> from core import Dragon, Turn
    >>> sharpest_bend(Dance(Dragon(20), Turn(1.7)))
    <SharpestBend: angle 1.74784005 rad, time 14.1832035 s, benches 0, 1>
    """

    angle: float
    time: float
    benches: Pair


# The benches from m on are equal and follow the same way: benches (i, i + 1) have the angle that (m, m + 1) had when
# handle m was where handle i is now. So m + 2 benches are enough once each handle has passed the start of the one
# before it.
@question_about("dance", Dance, "the sharpest bend was not found")
def sharpest_bend(
    dance: Dance, *, start: float | None = None, stop: float | None = None, budget: Budget | None = None
) -> SharpestBend | None:
    """The sharpest bend between start and stop [s], see Dance.span(); None for a single bench.

    Sampled in steps of PROFILE_STEP of the shortest chord (SAMPLES of them at most), then refined; a peak
    narrower than a step may be missed.
    raises: InvalidValue; OutsideRun for a stop after the end of the run; TooMuchWork

    >>> from core import Dragon, Turn
    >>> round(sharpest_bend(Dance(Dragon(20), Turn(1.7))).angle, 4)
    1.7478
    """
    span = dance.span(start, stop)
    begin, until = dance.steady_times(np.array(span)).tolist()
    clock, dance = dance.clock, dance.steady
    dragon = dance.dragon
    if dragon.benches < 2:
        return None
    count = 3 + int((until - begin) * dance.head_speed / (PROFILE_STEP * dragon.chords.min()))
    grid = np.linspace(begin, until, min(count, SAMPLES))
    front = dance.leading(dragon.uniform_from + 2)
    bends = [_sharpest(dance, grid[: _opened(dance, grid, budget)], budget), _sharpest(front, grid, budget)]
    largest = max(bend.angle for bend in bends)
    bend = min((bend for bend in bends if bend.angle >= largest - 2.0 * SAME_ANGLE), key=lambda bend: bend.time)
    return replace(bend, time=max(clock.of_steady(bend.time), span[0]))


def _opened(dance: Dance, grid: Floats, budget: Budget | None) -> int:
    """Number of instants until every handle has passed the start of the one before it."""
    ahead = longest_arc(dance.dragon, dance.path.as_route(dance.path.end))
    moved, step = np.zeros(dance.dragon.benches + 1), grid[1] - grid[0]
    for k, time in enumerate(grid):
        if moved.min() > ahead:
            return k + 1
        moved += step * trajectory(dance, [float(time)], budget=budget).speed[0]
    return grid.size


def _sharpest(dance: Dance, grid: Floats, budget: Budget | None) -> SharpestBend:
    step = grid[1] - grid[0]
    batches = [_angles(dance, grid[k : k + BATCH], budget) for k in range(0, grid.size, BATCH)]
    angle = np.concatenate([batch.max(axis=1) for batch in batches])
    joint = np.concatenate([batch.argmax(axis=1) for batch in batches])
    highest = (dips(np.pad(-angle, 1, constant_values=math.inf), PEAKS_REFINED) - 1).tolist()  # both ends too
    first = int(np.argmax(angle >= angle.max() - SAME_ANGLE))  # the angle may be constant, as on an arc
    refined = [_refined(dance, grid[k], step, int(joint[k]), grid, budget) for k in {first, *highest}]
    largest = max(bend.angle for bend in refined)
    return min((bend for bend in refined if bend.angle >= largest - 2.0 * SAME_ANGLE), key=lambda bend: bend.time)


def _refined(dance: Dance, time: float, step: float, joint: int, grid: Floats, budget: Budget | None) -> SharpestBend:
    low, high = float(grid[0]), float(grid[-1])
    for _ in range(ZOOM_ROUNDS):
        times = np.clip(time + step * ZOOM, low, high)
        angles = _angles(dance, times, budget)[:, joint]
        best = int(np.argmax(angles >= angles.max() - SAME_ANGLE))
        time, step = float(times[best]), step / 16.0
    return SharpestBend(float(angles[best]), time, (joint, joint + 1))


def _angles(dance: Dance, times: Floats, budget: Budget | None) -> Floats:
    """Angle at every inner handle [rad]. times: (T,) [s]; returns (T, n - 1) in [0, pi]"""
    handles = trajectory(dance, times, budget=budget).position
    along = handles[:, :-1] - handles[:, 1:]
    front, rear = along[:, :-1], along[:, 1:]
    cross = front[..., 0] * rear[..., 1] - front[..., 1] * rear[..., 0]
    angles: Floats = np.arctan2(np.abs(cross), (front * rear).sum(axis=-1))
    return angles

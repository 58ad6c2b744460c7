"""The sharpest bend between two consecutive benches over a stretch of the dance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.contact.first_contact import PROFILE_STEP
from core.contact.search import SAMPLES
from core.dragon import Dragon
from core.motion.trajectory import checked_head_speed, checked_span, run_end, trajectory
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.values import Floats

# Peaks are narrowed down with so many instants at a time, so many times, and so many of the highest: to 1e-9 of a step.
ZOOM = np.linspace(-1.0, 1.0, 33)
ZOOM_ROUNDS = 7
PEAKS_REFINED = 5
# Angles that differ by less are the same, and the first one counts [rad].
SAME_ANGLE = 1e-13
# Instants whose handles are held at once.
BATCH = 1_000


@dataclass(frozen=True, slots=True)
class SharpestBend:
    """The largest angle between the headings of two consecutive benches [rad], its time [s], and the benches."""

    angle: float
    time: float
    benches: tuple[int, int]


# Alike benches follow each other's way: benches (i, i + 1) bend as (m, m + 1) did when handle m stood where handle i
# stands. So beyond the first stretch, until each handle has passed where the one before it began, m + 2 benches do.
def sharpest_bend(
    dragon: Dragon,
    path: Spiral | Route,
    *,
    head_speed: float = 1.0,
    start: float = 0.0,
    stop: float | None = None,
) -> SharpestBend | None:
    """The sharpest bend between start and stop [s], None for the end of the run; None for a single bench.

    head_speed: [m/s]
    Sampled in steps of PROFILE_STEP of the shortest chord (SAMPLES of them at most), then refined; a peak
    narrower than a step may be missed.
    raises: InvalidValue; OutsideRun for a stop after the end of the run
    """
    head_speed = checked_head_speed(head_speed)
    begin, until = checked_span(dragon, path, start, stop, run_end(dragon, path, head_speed=head_speed), head_speed)
    if dragon.benches < 2:
        return None
    count = 3 + int((until - begin) * head_speed / (PROFILE_STEP * dragon.chords.min()))
    grid = np.linspace(begin, until, min(count, SAMPLES))
    leading = dragon.uniform_from + 2
    front = Dragon.of(dragon.lengths[:leading], dragon.widths[:leading], dragon.overhangs[:leading])
    found = [
        _sharpest(dragon, path, grid[: _opened(dragon, path, grid, head_speed)], head_speed),
        _sharpest(front, path, grid, head_speed),
    ]
    largest = max(bend.angle for bend in found)
    return min((bend for bend in found if bend.angle >= largest - 2.0 * SAME_ANGLE), key=lambda bend: bend.time)


def _opened(dragon: Dragon, path: Spiral | Route, grid: Floats, head_speed: float) -> int:
    """How many instants pass until every handle has passed where the one before it began."""
    ahead = 0.5 * math.pi * dragon.chords.max()  # no arc under a chord is longer
    moved, step = np.zeros(dragon.benches + 1), grid[1] - grid[0]
    for k, time in enumerate(grid):
        if moved.min() > ahead:
            return k + 1
        moved += step * trajectory(dragon, path, [float(time)], head_speed=head_speed).speed[0]
    return grid.size


def _sharpest(dragon: Dragon, path: Spiral | Route, grid: Floats, head_speed: float) -> SharpestBend:
    step = grid[1] - grid[0]
    batches = [_angles(dragon, path, grid[k : k + BATCH], head_speed) for k in range(0, grid.size, BATCH)]
    angle = np.concatenate([batch.max(axis=1) for batch in batches])
    joint = np.concatenate([batch.argmax(axis=1) for batch in batches])
    around = np.pad(angle, 1, constant_values=-1.0)
    peaks = np.flatnonzero((angle >= around[:-2]) & (angle >= around[2:]))
    highest = peaks[np.argsort(-angle[peaks], kind="stable")[:PEAKS_REFINED]].tolist()
    first = int(np.argmax(angle >= angle.max() - SAME_ANGLE))  # where it stays as sharp, as on an arc
    refined = [_refined(dragon, path, grid[k], step, int(joint[k]), grid, head_speed) for k in {first, *highest}]
    largest = max(bend.angle for bend in refined)
    return min((bend for bend in refined if bend.angle >= largest - 2.0 * SAME_ANGLE), key=lambda bend: bend.time)


def _refined(
    dragon: Dragon, path: Spiral | Route, time: float, step: float, joint: int, grid: Floats, head_speed: float
) -> SharpestBend:
    low, high = float(grid[0]), float(grid[-1])
    for _ in range(ZOOM_ROUNDS):
        times = np.clip(time + step * ZOOM, low, high)
        angles = _angles(dragon, path, times, head_speed)[:, joint]
        best = int(np.argmax(angles >= angles.max() - SAME_ANGLE))
        time, step = float(times[best]), step / 16.0
    return SharpestBend(float(angles[best]), time, (joint, joint + 1))


def _angles(dragon: Dragon, path: Spiral | Route, times: Floats, head_speed: float) -> Floats:
    """Angle at every inner handle [rad]. times: (T,) [s]; returns (T, n - 1) in [0, pi]"""
    handles = trajectory(dragon, path, times, head_speed=head_speed).position
    along = handles[:, :-1] - handles[:, 1:]
    front, rear = along[:, :-1], along[:, 1:]
    cross = front[..., 0] * rear[..., 1] - front[..., 1] * rear[..., 0]
    angles: Floats = np.arctan2(np.abs(cross), (front * rear).sum(axis=-1))
    return angles

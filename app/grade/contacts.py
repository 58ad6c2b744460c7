"""Contact by the rules of papers and students: the angle sum, the pose on the circle alone, or steps of time.

Each function recomputes the result of such a rule. State: the times of the angle-sum rule, each computed once.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from functools import cache

import numpy as np

from app.grade.chains import times_at
from app.grade.handles import Mask
from core import Dance, Dragon, Spiral, bench_poses, clearance_profile, separation
from core import trajectory as trajectory_of
from core.sampling import bisect
from core.shapes.rectangles import angle_sum_overlap, angle_sums, corners
from core.values import Floats

TURNING_RADIUS = 4.5  # [m], of the contest's turning circle
# Angle sum [deg] that gives the paper's time when it counts as 360: 0.9 degrees less.
LOOSE_ANGLE = 359.1
# Rounding of an angle sum [deg]: corners inside give 360 within 1e-12; corners 1e-9 m outside fall short by more.
EXACT_ANGLE = 360.0 - 1e-6
# Benches near the head: the ring around it has at most 34 benches; benches further back lie in outer rings.
RING_BENCHES = 40
# Steps of the searches for a first time [s] and for sign changes in the pitch [m], and width at which bisection stops.
TIME_STEP, PITCH_STEP, RESOLUTION = 0.1, 0.001, 1e-10
# Pitches that students and the paper try [m].
PITCH_RANGE = (0.30, 0.55)
# Step of the radii at which an overlap is looked for [m], and part of it to which its ends are narrowed [1].
OVERLAP_STEP, OVERLAP_SHARE = 0.0002, 1e-6
# Head radius from which the way to the circle is checked: the least clearance is inside it [m].
WAY_RADIUS = 4.8
# Part of a step by which the last sample may be missed in rounding [1].
SLACK = 1e-9
# Function from poses (..., 3) and sizes (..., 2) to corners (..., 4, 2).
Outline = Callable[[Floats, Floats], Floats]


def _benches(path: Spiral, times: Floats) -> tuple[Floats, Floats]:
    """Poses (T, N, 3) of the head and the benches near it at times (T,) [s], and their sizes (N, 2) [m]."""
    dragon = Dragon(RING_BENCHES)
    poses = bench_poses(trajectory_of(Dance(dragon, path), times).position)
    return poses, np.stack([dragon.lengths, dragon.widths], axis=-1)


def _gaps(path: Spiral, times: Floats) -> Floats:
    """Separations (T, N) of the head from the body benches near it at times (T,) [m]."""
    poses, sizes = _benches(path, times)
    return separation(poses[:, :1], sizes[:1], poses[:, 2:], sizes[2:]).separation


def _outlines(outline: Outline, times: Floats) -> tuple[Floats, Floats]:
    """Corners (T, 1, 4, 2) of the head and (T, N, 4, 2) of the body benches near it, at times (T,) [s]."""
    outlines = outline(*_benches(Spiral(), times))
    return outlines[:, :1], outlines[:, 2:]


def largest_sum(outline: Outline, time: float) -> float:
    """The paper's rule, eqs. 13-16: the largest angle sum between head and body benches at a time [deg]."""
    head, body = _outlines(outline, np.array([time]))
    return math.degrees(max(angle_sums(body, head).max(), angle_sums(head, body).max()))


@cache
def angle_sum_time(outline: Outline, angle: float) -> float:
    """First time [s] at which an angle sum reaches an angle [deg]: in steps of TIME_STEP, then by bisection."""

    def reached(times: Floats) -> list[bool]:
        head, body = _outlines(outline, times)
        seen = angle_sum_overlap(np.broadcast_to(head, body.shape), body, tolerance=math.radians(360.0 - angle))
        return list(np.asarray(seen.any(axis=1)).tolist())

    times = np.arange(0.0, Dance(Dragon(), Spiral()).end.time, TIME_STEP)
    high = float(times[reached(times).index(True)])
    return bisect(lambda time: reached(np.array([time]))[0], high - TIME_STEP, high, width=RESOLUTION)[1]


class StepKind(StrEnum):
    """What the way to the circle is sampled by: time, radius or angle of the head, in equal steps from the start.

    PARTS: so many equal steps of the angle, the last of which ends on the circle.
    """

    TIME = "time"
    RADIUS = "radius"
    ANGLE = "angle"
    PARTS = "parts"


def sampled_pitch(sampled: StepKind, step: float, right: float) -> float:
    """Smallest pitch without a contact at samples of the way to the circle [m].

    step: in s, m or rad, or number of parts; the radius is sampled from the circle outwards; right: the exact pitch
    """

    def clear(pitch: float) -> bool:
        spiral = Spiral(pitch)
        times = _samples(spiral, sampled, step)
        return not times.size or bool(_gaps(spiral, times).min() > 0.0)

    steps = range(1, math.ceil((right - PITCH_RANGE[0]) / PITCH_STEP))
    low = next(pitch for k in steps if not clear(pitch := right - k * PITCH_STEP))
    return bisect(clear, low, min(low + PITCH_STEP, right), width=RESOLUTION)[1]


def longest_overlap(pitch: float) -> tuple[float, float] | None:
    """Radii of the head [m] between which benches overlap longest on the way from WAY_RADIUS to the circle.

    None without an overlap. The radii are searched in steps of OVERLAP_STEP, then by bisection.
    """
    spiral = Spiral(pitch)

    def overlap(radii: Floats) -> Mask:
        return np.asarray(_gaps(spiral, times_at(spiral, radii)).min(axis=1) <= 0.0)

    def border(clear: float, touching: float) -> float:
        def is_past(share: float) -> bool:
            return bool(overlap(np.array([clear + share * (touching - clear)]))[0])

        return clear + bisect(is_past, 0.0, 1.0, width=OVERLAP_SHARE)[1] * (touching - clear)

    radii: Floats = np.arange(WAY_RADIUS, TURNING_RADIUS, -OVERLAP_STEP, dtype=np.float64)
    touching = overlap(radii)
    changes = np.flatnonzero(np.diff(np.concatenate([[False], touching, [False]]).astype(np.int8))).tolist()
    if not changes:
        return None
    first, after = max(zip(changes[::2], changes[1::2], strict=True), key=lambda pair: pair[1] - pair[0])
    begin = border(radii[first - 1], radii[first]) if first else WAY_RADIUS
    return begin, border(radii[after], radii[after - 1]) if after < radii.size else TURNING_RADIUS


def _samples(spiral: Spiral, sampled: StepKind, step: float) -> Floats:
    """Times of the samples between WAY_RADIUS and the circle [s], at 1 m/s from the start of the spiral."""
    if sampled is StepKind.RADIUS:
        count = math.floor((WAY_RADIUS - TURNING_RADIUS) / step + SLACK) + 1
        return times_at(spiral, (TURNING_RADIUS + step * np.arange(count, dtype=np.float64))[::-1])
    if sampled is StepKind.TIME:
        early, late = times_at(spiral, np.array([WAY_RADIUS, TURNING_RADIUS])).tolist()
        return step * np.arange(math.ceil(early / step), math.floor(late / step) + 1, dtype=np.float64)
    first, last = (radius / spiral.growth for radius in (WAY_RADIUS, TURNING_RADIUS))
    if sampled is StepKind.PARTS:
        thetas = np.linspace(spiral.start_theta, last, int(step) + 1)
        thetas = thetas[thetas <= first]
    else:
        turned = [spiral.start_theta - theta for theta in (first, last)]
        steps = np.arange(math.ceil(turned[0] / step), math.floor(turned[1] / step + SLACK) + 1, dtype=np.float64)
        thetas = spiral.start_theta - step * steps
    return times_at(spiral, spiral.growth * thetas)


def any_touch_at_start(path: Spiral) -> bool:
    return bool(clearance_profile(Dance(Dragon(), path), np.array([0.0])).clearance[0] <= 0.0)


def head_touches_at_start(path: Spiral) -> bool:
    return bool(_gaps(path, np.zeros(1)).min() <= 0.0)


def corner_at_start(path: Spiral) -> bool:
    """True if the outer front corner of the head is inside a body bench."""
    (poses,), sizes = _benches(path, np.zeros(1))
    body, away = poses[2:], corners(poses[0], sizes[0])[0] - poses[2:, :2]
    along = np.abs(away[:, 0] * np.cos(body[:, 2]) + away[:, 1] * np.sin(body[:, 2]))
    across = np.abs(away[:, 1] * np.cos(body[:, 2]) - away[:, 0] * np.sin(body[:, 2]))
    return bool((np.stack([along, across], axis=-1) <= 0.5 * sizes[2:]).all(axis=-1).any())


def circle_pitch(touches: Callable[[Spiral], bool]) -> float:
    """Largest pitch in PITCH_RANGE at which the pose on the circle touches, without a check of the way there [m]."""

    def touching(pitch: float) -> bool:
        # On a spiral that starts at the circle, the head is on it at time 0.
        return touches(Spiral(pitch, TURNING_RADIUS / pitch))

    pitches = np.arange(*PITCH_RANGE, PITCH_STEP).tolist()
    last = max(k for k, pitch in enumerate(pitches) if touching(pitch))
    apart = bisect(lambda pitch: not touching(pitch), pitches[last], pitches[last + 1], width=RESOLUTION)
    return apart[0]

"""Where every handle and bench is, and how fast."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.dragon import Dragon, Floats, checked_number
from core.errors import InvalidValue, OutsideRun
from core.paths import Spiral

HEAD_SPEED_MIN = 1e-6  # [m/s]
HEAD_SPEED_MAX = 1e4  # [m/s]


class EndReason(StrEnum):
    """Why a run ends: a chord has no continuous solution any more, or the head is at the centre."""

    FOLD = "fold"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True)
class RunEnd:
    """Where the run ends: reason, time [s], theta of the head [rad], the bench that folds (None at the centre)."""

    reason: EndReason
    time: float
    theta: float
    bench: int | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """time (T,) [s]; position (T, n + 1, 2) [m]; velocity (T, n + 1, 2) [m/s]; speed (T, n + 1) [m/s]."""

    time: Floats
    position: Floats
    velocity: Floats
    speed: Floats


def checked_head_speed(head_speed: float) -> float:
    """head_speed [m/s] if it lies in the range allowed."""
    if isinstance(head_speed, (int, float)) and head_speed <= 0:
        raise InvalidValue("head_speed", f"head_speed must be positive, got {head_speed} m/s")
    return checked_number("head_speed", head_speed, "m/s", HEAD_SPEED_MIN, HEAD_SPEED_MAX)


def end_theta(dragon: Dragon, path: Spiral) -> tuple[float, int | None]:
    """The head angle [rad] at which the run ends, and the bench that folds (0 and None at the centre).

    Bench k folds when handle k falls to the fold of its chord; that handle gets there when handle k - 1 first
    stands one chord further in. So from the tail forwards: the limit of handle k is the larger of its own fold
    and the place from which handle k + 1 reaches its limit. In a uniform tail the own fold always wins.
    """
    chords2 = (dragon.chords / path.growth) ** 2
    fold = {float(c): kernels.fold_theta(float(c)) for c in np.unique(chords2[: dragon.uniform_from + 1])}
    limit, bench = 0.0, None
    for k in range(dragon.uniform_from, -1, -1):
        chord2 = float(chords2[k])
        inherited = kernels.previous_theta(limit, chord2) if limit > fold[chord2] else -1.0
        if fold[chord2] >= inherited:
            limit, bench = fold[chord2], k
        else:
            limit = inherited
    return (limit, bench) if limit > 0.0 else (0.0, None)


def run_end(dragon: Dragon, path: Spiral, *, head_speed: float = 1.0) -> RunEnd:
    """Where the run ends: the fold or the centre.

    head_speed: [m/s]
    raises: InvalidValue (path.start_turns) when the dragon cannot even stand at the start
    """
    head_speed = checked_head_speed(head_speed)
    theta, bench = end_theta(dragon, path)
    if theta >= path.start_theta:
        raise InvalidValue(
            "path.start_turns",
            f"path.start_turns must be more than {theta / (2 * math.pi):.6g} turns, where bench {bench} of this "
            f"dragon folds, got {path.start_turns:g} turns",
        )
    time = (path.length - path.growth * kernels.spiral_arc(theta)) / head_speed
    return RunEnd(EndReason.CENTRE if bench is None else EndReason.FOLD, time, theta, bench)


def trajectory(
    dragon: Dragon, path: Spiral, times: Floats | Sequence[float], *, head_speed: float = 1.0
) -> Trajectory:
    """Position and velocity of every handle at every time.

    times: (T,) [s], 0 at the start; at negative times the head is on the outward extension of the spiral
    head_speed: [m/s], constant
    returns: see Trajectory; positions good to 1e-12 m, speeds from the rigid links, never from differences
    raises: OutsideRun (times) after the end of the run
    source: Yang et al., section 2.3, whose eqs. 6-7 divide a sum of speeds by 2 dt where a distance is meant

    >>> trajectory(Dragon(), Spiral(), [0.0]).position[0, 1].round(6)
    array([8.363824, 2.826544])
    """
    end = run_end(dragon, path, head_speed=head_speed)
    time = checked_times(times, end)
    head = np.maximum(path.theta(time * head_speed), end.theta)
    shape = (time.size, dragon.benches + 1)
    position, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
    folded = kernels.spiral_trajectory(path.growth, head, dragon.chords, head_speed, position, velocity, speed)
    if folded >= 0:
        raise _after_the_end(end, time, folded)
    return Trajectory(time, position, velocity, speed)


def checked_times(times: Floats | Sequence[float], end: RunEnd) -> Floats:
    """times as a (T,) array of finite numbers [s], none after the end of the run."""
    try:
        time = np.asarray(times, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidValue("times", "times must be a list of numbers in seconds") from error
    if time.ndim != 1:
        raise InvalidValue("times", "times must be a flat list of numbers in seconds")
    wrong = np.flatnonzero(~np.isfinite(time))
    if wrong.size:
        raise InvalidValue(f"times.{wrong[0]}", f"times[{wrong[0]}] must be finite, got {time[wrong[0]]} s")
    late = np.flatnonzero(time > end.time)
    if late.size:
        raise _after_the_end(end, time, int(late[0]))
    return np.ascontiguousarray(time)


def _after_the_end(end: RunEnd, time: Floats, index: int) -> OutsideRun:
    why = "the head is at the centre" if end.bench is None else f"bench {end.bench} folds"
    return OutsideRun(
        f"times.{index}", f"times[{index}] must be at most {end.time:.9f} s, when {why}, got {time[index]:g} s"
    )


def bench_poses(handles: Floats) -> Floats:
    """Pose of every bench from the handles at its two ends.

    handles: (..., n + 1, 2) [m], head first, world frame
    returns: (..., n, 3) x [m], y [m], heading [rad] in [-pi, pi], from rear to front handle
    source:  Yang et al., section 2.4.1, steps 1-2

    >>> bench_poses(np.array([[2.0, 0.0], [0.0, 0.0]]))
    array([[1., 0., 0.]])
    """
    front, rear = handles[..., :-1, :], handles[..., 1:, :]
    middle = 0.5 * (front + rear)
    along = front - rear
    heading = np.arctan2(along[..., 1], along[..., 0])
    return np.concatenate([middle, heading[..., None]], axis=-1)

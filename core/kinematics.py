"""Where every handle and bench is, and how fast."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.dragon import Dragon, Floats, checked_number, checked_type
from core.errors import InvalidValue, OutsideRun, said
from core.paths import Spiral
from core.route import Route

HEAD_SPEED_MIN = 1e-6  # [m/s]
HEAD_SPEED_MAX = 1e4  # [m/s]
TIME_MAX = 1e12  # [s]
# How long a dance is looked at, second by second, where nobody says: the contest's table is as long [s].
DEFAULT_SPAN = 300
# A run ends this much before its fold, so that rounding leaves every chord a place at the end too; 1e-14 was enough for
# 1,494 random dragons, 2026-11-21 [1].
FOLD_ROUNDING = 1e-13


class EndReason(StrEnum):
    """Why a run ends: a chord has no continuous solution any more, the head is at the centre of the spiral or at the
    end of the route, or the time asked for is over."""

    FOLD = "fold"
    CENTRE = "centre"
    END = "end"
    STOP = "stop"


@dataclass(frozen=True, slots=True)
class RunEnd:
    """Where the run ends: reason, time [s], theta of the head on a spiral [rad], the bench that folds if one does."""

    reason: EndReason
    time: float
    theta: float | None
    bench: int | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """time (...) [s]; position (..., n + 1, 2) [m]; velocity (..., n + 1, 2) [m/s]; speed (..., n + 1) [m/s].

    ... is (T,) for a list of times and nothing for one time.
    """

    time: Floats
    position: Floats
    velocity: Floats
    speed: Floats


def checked_head_speed(head_speed: float) -> float:
    """head_speed [m/s] if it lies in the range allowed."""
    if isinstance(head_speed, (int, float)) and head_speed <= 0:
        raise InvalidValue("head_speed", f"head_speed must be positive, got {said(head_speed)} m/s")
    return checked_number("head_speed", head_speed, "m/s", HEAD_SPEED_MIN, HEAD_SPEED_MAX)


def end_theta(dragon: Dragon, path: Spiral) -> tuple[float, int | None]:
    """The head angle [rad] at which the run ends, and the bench that folds (0 and None at the centre).

    Bench k folds when handle k falls to the fold of its chord; that handle gets there when handle k - 1 first
    stands one chord further in. So from the tail forwards: the limit of handle k is the larger of its own fold
    and the place from which handle k + 1 reaches its limit. In a uniform tail the own fold always wins.
    """
    chords2 = ((dragon.chords[: dragon.uniform_from + 1] / path.growth) ** 2).tolist()
    fold = {chord2: float(kernels.fold_theta(chord2)) for chord2 in set(chords2)}
    limit, bench = 0.0, None
    for k in range(dragon.uniform_from, -1, -1):
        chord2 = chords2[k]
        inherited = kernels.previous_theta(limit, chord2) if limit > fold[chord2] else -1.0
        if fold[chord2] >= inherited:
            limit, bench = fold[chord2], k
        else:
            limit = inherited
    return (limit * (1.0 + FOLD_ROUNDING), bench) if limit > 0.0 else (0.0, None)


def run_end(dragon: Dragon, path: Spiral | Route, *, head_speed: float = 1.0) -> RunEnd:
    """Where the run ends: the fold or the centre of a spiral, the end of a route.

    head_speed: [m/s]
    raises: InvalidValue when the dragon cannot even stand at the start (path.start_turns), or a bend of a route is too
        tight for a chord (path), or for a dragon or a path that is none
    """
    checked_type("dragon", dragon, Dragon)
    checked_type("path", path, (Spiral, Route))
    head_speed = checked_head_speed(head_speed)
    if isinstance(path, Route):
        _check_bends(dragon, path)
        return RunEnd(EndReason.END, path.end / head_speed, None, None)
    theta, bench = end_theta(dragon, path)
    if theta >= path.start_theta:
        raise InvalidValue(
            "path.start_turns",
            f"path.start_turns must be more than {theta / (2 * math.pi):.6g} turns, where bench {bench} of this "
            f"dragon folds, got {path.start_turns:g} turns",
        )
    time = (path.length - path.growth * kernels.spiral_arc(theta)) / head_speed
    return RunEnd(EndReason.CENTRE if bench is None else EndReason.FOLD, time, theta, bench)


def follows(dragon: Dragon, path: Route) -> bool:
    """Does no piece of the route bend too tight for a chord?"""
    longest = float(dragon.chords[: dragon.uniform_from + 1].max())
    return bool(0.5 * path.sharpest[0] * longest <= kernels.ROUTE_BEND_LIMIT)


def tightest_bend(dragon: Dragon) -> tuple[float, int]:
    """The least radius of a bend that all can follow [m], and the bench that needs it."""
    bench = int(dragon.chords[: dragon.uniform_from + 1].argmax())
    return 0.5 * float(dragon.chords[bench]) / kernels.ROUTE_BEND_LIMIT, bench


def _check_bends(dragon: Dragon, path: Route) -> None:
    """Refuse a bend that a bench cannot follow.

    With |curvature| chord / 2 below the limit the next handle is unique and never turns back.
    """
    curvature, s = path.sharpest
    if not follows(dragon, path):
        x, y = path.position(s)
        tightest, bench = tightest_bend(dragon)
        chord = float(dragon.chords[bench])
        raise InvalidValue(
            "path",
            f"path must not bend tighter than a radius of {tightest:.4g} m for the chord of "
            f"bench {bench} ({chord:g} m), got {1.0 / curvature:.4g} m near ({x:.4g}, {y:.4g}) m, s = {s:.4g} m",
        )


def trajectory(
    dragon: Dragon, path: Spiral | Route, times: Floats | Sequence[float] | float, *, head_speed: float = 1.0
) -> Trajectory:
    """Position and velocity of every handle at every time.

    times: (T,) or one [s], 0 at the start; at negative times the head is on the outward extension of the spiral, or on
        the part of a route before its s = 0
    head_speed: [m/s], constant
    returns: see Trajectory; positions good to 1e-12 m, speeds from the rigid links, never from differences
    raises: OutsideRun (times) after the end of the run, or where the tail would stand before the beginning of a route
    source: Yang et al., section 2.3, whose eqs. 6-7 divide a sum of speeds by 2 dt where a distance is meant

    >>> trajectory(Dragon(), Spiral(), [0.0]).position[0, 1].round(6)
    array([8.363824, 2.826544])
    >>> trajectory(Dragon(), Spiral(), 0.0).position.shape
    (224, 2)
    """
    end = run_end(dragon, path, head_speed=head_speed)
    asked = checked_times(times, dragon, path, end, head_speed)
    time = asked.reshape(-1)
    shape = (time.size, dragon.benches + 1)
    columns = position, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
    if isinstance(path, Route):
        sizes = np.zeros((dragon.benches, kernels.SIZE_COLUMNS))
        sizes[:, 0] = dragon.chords
        chain = np.empty((dragon.benches + 1, kernels.CHAIN_COLUMNS))
        kernels.route_trajectory(path.table, time * head_speed, head_speed, sizes, chain, position, velocity, speed)
        return Trajectory(asked, *(column.reshape(*asked.shape, *column.shape[1:]) for column in columns))
    head = np.maximum(path.theta(time * head_speed), end.theta or 0.0)
    folded = kernels.spiral_trajectory(path.growth, head, dragon.chords, head_speed, position, velocity, speed)
    if folded >= 0:
        raise _after_the_end(end, asked, folded)
    return Trajectory(asked, *(column.reshape(*asked.shape, *column.shape[1:]) for column in columns))


def checked_times(
    times: Floats | Sequence[float] | float, dragon: Dragon, path: Spiral | Route, end: RunEnd, head_speed: float
) -> Floats:
    """times as a (T,) or () array of finite numbers [s], none after the end of the run or before a route has room."""
    try:
        given = np.asarray(times)
    except ValueError as error:
        raise InvalidValue("times", "times must be a list of numbers in seconds, or one number") from error
    # numpy would read "1", True and None as numbers too
    if given.dtype.kind not in "iuf":
        raise InvalidValue("times", f"times must be a list of numbers in seconds, or one number, got {times!r:.60}")
    if given.ndim > 1:
        raise InvalidValue("times", "times must be a flat list of numbers in seconds, or one number")
    time = np.array(given, dtype=np.float64, order="C")
    wrong = np.flatnonzero(~np.isfinite(time))
    if wrong.size:
        raise InvalidValue.of(_instant(time, int(wrong[0])), "must be finite", time.flat[wrong[0]], "s")
    earliest = earliest_time(dragon, path, head_speed)
    late = np.flatnonzero(time > end.time)
    if late.size:
        raise _after_the_end(end, time, int(late[0]))
    early = np.flatnonzero(time < earliest)
    if early.size:
        k = int(early[0])
        rule = f"must be at least {earliest:.6f} s, when the whole dragon is on the path"
        raise OutsideRun.of(_instant(time, k), rule, time.flat[k], "s")
    return time


def _instant(time: Floats, k: int) -> str:
    """The field of one of the times."""
    return f"times.{k}" if time.ndim else "times"


def checked_span(
    dragon: Dragon, path: Spiral | Route, start: float, stop: float | None, end: RunEnd, head_speed: float
) -> tuple[float, float]:
    """start and stop [s] if the run has them, in that order; None stands for the end of the run."""
    until = end.time if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
    begin = checked_number("start", start, "s", -TIME_MAX, TIME_MAX)
    earliest = earliest_time(dragon, path, head_speed)
    if begin < earliest:
        rule = f"must be at least {earliest:.6f} s, when the whole dragon is on the path"
        raise OutsideRun.of("start", rule, begin, "s")
    if until > end.time:
        raise OutsideRun.of("stop", f"must be at most {end.time:.9f} s, when {_why(end)}", until, "s")
    if until <= begin:
        if stop is None:
            raise OutsideRun.of("start", f"must be before {until:.9f} s, when {_why(end)}", begin, "s")
        raise InvalidValue.of("stop", f"must be after start ({begin:g} s)", until, "s")
    return begin, until


def earliest_time(dragon: Dragon, path: Spiral | Route, head_speed: float) -> float:
    """When the last handle is at the beginning of the route [s]; -TIME_MAX where the path has no beginning.

    A chord spans between its own length and pi / 2 times it of the path, so the place of the head is bisected, as far
    as the path goes: beyond its end there is nothing to stand on.
    raises: InvalidValue (path) for a route too short for the dragon
    """
    if isinstance(path, Spiral) or path.tail_begin is None:
        return -TIME_MAX
    sizes = np.zeros((dragon.benches, kernels.SIZE_COLUMNS))
    sizes[:, 0] = dragon.chords
    chain = np.empty((dragon.benches + 1, kernels.CHAIN_COLUMNS))

    def has_room(s: float) -> bool:
        return bool(kernels.route_tail(path.table, min(s, path.end), dragon.benches, sizes, chain) >= path.tail_begin)

    low, straight = path.tail_begin, float(dragon.chords.sum())
    high = low + 0.5 * math.pi * straight
    if not has_room(high):
        raise InvalidValue(
            "path",
            f"path is too short for the whole dragon, which takes {straight:.9g} m of it from handle 0 to handle "
            f"{dragon.benches} (more along bends), got {path.end - path.begin:.9g} m",
        )
    while high - low > 1e-9 * (1.0 + abs(high)):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if has_room(middle) else (middle, high)
    return min(high, path.end) / head_speed


def first_time(dragon: Dragon, path: Spiral | Route, *, head_speed: float = 1.0) -> float:
    """From when a run is shown where nobody says [s]: 0, or where it has no 0, when the whole dragon is on the path.

    head_speed: [m/s]
    raises: InvalidValue (path) for a route too short for the dragon, or too tight
    """
    end = run_end(dragon, path, head_speed=head_speed).time
    begin = path.begin / head_speed if isinstance(path, Route) else 0.0
    earliest = max(begin, earliest_time(dragon, path, head_speed))
    return 0.0 if earliest <= 0.0 <= end else earliest


def default_times(dragon: Dragon, path: Route, *, head_speed: float = 1.0) -> Floats:
    """Whole seconds (T,) from first_time() on, for DEFAULT_SPAN or to the end of the route [s].

    first_time() alone where the run is too short for a whole second.
    head_speed: [m/s]; raises: as first_time()
    """
    earliest = first_time(dragon, path, head_speed=head_speed)
    # Both are whole, so that no rounding leads past the end.
    first, last = math.ceil(earliest), math.floor(path.end / head_speed)
    if first > last:
        return np.array([earliest])
    return np.arange(first, min(first + DEFAULT_SPAN, last) + 1, dtype=np.float64)


def _why(end: RunEnd) -> str:
    if end.reason is EndReason.FOLD:
        return f"bench {end.bench} folds"
    return "the head is at the centre" if end.reason is EndReason.CENTRE else "the path ends"


def _after_the_end(end: RunEnd, time: Floats, index: int) -> OutsideRun:
    rule = f"must be at most {end.time:.9f} s, when {_why(end)}"
    return OutsideRun.of(_instant(time, index), rule, time.flat[index], "s")


def bench_poses(handles: Floats) -> Floats:
    """Pose of every bench from the handles at its two ends.

    handles: (..., n + 1, 2) [m], head first, world frame
    returns: (..., n, 3) x [m], y [m], heading [rad] in [-pi, pi], from rear to front handle
    source:  Yang et al., section 2.4.1, steps 1-2
    raises:  InvalidValue (handles)

    >>> bench_poses(np.array([[2.0, 0.0], [0.0, 0.0]]))
    array([[1., 0., 0.]])
    """
    handles = _checked_handles(handles)
    front, rear = handles[..., :-1, :], handles[..., 1:, :]
    middle = 0.5 * (front + rear)
    along = front - rear
    heading = np.arctan2(along[..., 1], along[..., 0])
    return np.concatenate([middle, heading[..., None]], axis=-1)


def _checked_handles(handles: object) -> Floats:
    try:
        places = np.asarray(handles)
    except ValueError as error:
        raise InvalidValue("handles", "handles must be places of shape (..., n + 1, 2) in metres") from error
    if places.dtype.kind not in "iuf" or places.ndim < 2 or places.shape[-1] != 2:
        words = "handles must be places of shape (..., n + 1, 2) in metres"
        raise InvalidValue("handles", f"{words}, got {places.dtype.name} of shape {places.shape}")
    return places.astype(np.float64, copy=False)

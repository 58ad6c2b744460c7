"""A path from a track that was walked: thinned, smoothed to what benches can follow, with its times as passages.

A receiver is metres off, and more so while it stands: its points are thinned to APART, and smoothed along the way with
a Gaussian whose width grows until no bend is tighter than the longest bench can follow. It grows no further once the
path is further from the points than their noise explains: smoothing would then cut what was walked. Of the widths up
to there the least one counts that leaves the tight bends about as short as any. Both ends stay in place. Of a track of
more than POINTS_MOST points every second, third and so on counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from app.wire.paths import POINTS_MAX
from core import Dragon, InvalidValue, Legs, Quantity
from core.paths.following import tightest_bend
from core.values import Floats

# Distance of the handles of the longest bench [m]: the contest's head.
CHORD = 2.86
# Least distance of two points that count [m]: a receiver at rest moves by less.
APART = 2.0
# Distance of the points that are smoothed [m], and the most of them; distance of the points of the path [m].
STEP, STEPS_MAX, KNOT = 0.5, 20_000, 3.0
# First width of the smoothing [m], its growth, and the widest one; a Gaussian is cut off at so many widths [1].
FIRST, GROWTH, WIDEST, CUT = 1.0, 1.25, 15.0, 3.0
# The path is as far from the points as their noise explains: in distances after the first smoothing [1], at least [m];
# and length by which tight bends are as short as others [m].
NOISE, NOISE_LEAST, ABOUT = 3.0, 1.0, 1.0
# Most points of a track that count [1].
POINTS_MOST = 20_000
# Radius of the bends beyond the least one that benches can follow [1].
EASY = 1.1
# Way behind and ahead of the last place in which the next point is looked for, beside the distance of both points [m].
BEHIND, AHEAD = 2.0, 6.0
# Largest error of a place on the path at a time: at least [m], and in errors of the receiver [1]; its growth until
# PASSAGES are enough [1]; and a pause's speed [m/s].
PLACE, ERRORS, PLACE_GROWTH, PASSAGES, PAUSE = 1.0, 3.0, 1.5, 60, 0.1
DECIMALS = 3


@dataclass(frozen=True)
class Walk:
    """A path along a track.

    points: of its curve (K, 2) [m]; largest: distance of a point of the track from the curve [m]
    length, lost: of the curve, and by how much it is shorter than the thinned track [m]
    width: of the smoothing [m]; is_easy: True if benches can follow every bend, of at least radius [m]
    passages: speeds from the first time on, in the form of a request; None without times
    """

    points: Floats
    largest: float
    length: float
    lost: float
    width: float
    is_easy: bool
    radius: float
    passages: list[dict[str, Any]] | None

    @property
    def path(self) -> dict[str, Any]:
        """The path in the form of a request."""
        return {"kind": "waypoints", "points": np.round(self.points, DECIMALS).tolist()}


def walk_of(points: Floats, times: Floats | None, chord: float = CHORD) -> Walk | None:
    """The path along a track; None if it is too short.

    points: (P, 2) [m]; times: (P,) [s], or None; chord: longest distance of the handles of a bench [m]
    raises: InvalidValue for points that no smooth curve follows
    """
    every = len(points) // POINTS_MOST + 1
    points, times = points[::every], None if times is None else times[::every]
    radius = EASY * tightest_bend(Dragon(1, chord, overhang=0.0))[0]
    way = evenly(apart(points))
    if len(way) < 3:
        return None
    tries: list[_Try] = []
    width, one = FIRST, None
    while width <= WIDEST:
        if (one := _tried(points, way, width, radius)) is not None:
            if tries and one.error > max(NOISE_LEAST, NOISE * tries[0].error):
                break
            tries.append(one)
            if one.tight == 0.0:
                break
        width *= GROWTH
    if one is None:
        rule = "must hold a track that does not turn on the spot, as this one does even when smoothed over {width}"
        raise InvalidValue("file", rule, width=Quantity(width / GROWTH, "m", 3))
    least = min(one.tight for one in tries)
    best = next(one for one in tries if one.tight <= (least + ABOUT if least else 0.0))
    passages = None
    if times is not None:  # a receiver is as far off along the way as across it
        passages = passages_of(np.asarray(times, dtype=np.float64), best.places, max(PLACE, ERRORS * best.error))
    lost = length_along(way) - best.length
    return Walk(best.knots, best.largest, best.length, lost, best.width, best.tight == 0.0, radius, passages)


@dataclass(frozen=True)
class _Try:
    """The curve after one smoothing. tight: length of its bends that are too tight [m]; error: of the points [m];
    places: of the points along it [m]"""

    width: float
    knots: Floats
    length: float
    tight: float
    largest: float
    error: float
    places: Floats


def _tried(points: Floats, way: Floats, width: float, radius: float) -> _Try | None:
    """The curve along a way smoothed by this width [m]; None if it would stop or turn on the spot."""
    knots = _knots(smoothed(way, width))
    course = _curve(knots)
    if course is None:
        return None
    tight = sum(end - start for start, end, _ in course.tighter(radius))
    s = np.linspace(course.begin, course.end, min(STEPS_MAX, int((course.end - course.begin) / STEP) + 2))
    places, off = _beside(points, s, course.position(s))
    error = float(np.sqrt(np.mean(off * off)))
    return _Try(width, knots, course.end - course.begin, tight, float(off.max()), error, places)


def length_along(points: Floats) -> float:
    """Length of the line through points (N, 2) [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _curve(knots: Floats) -> Legs | None:
    """The curve through these points; None if it would stop or turn on the spot, as through noise."""
    try:
        return Legs([tuple(one) for one in knots.tolist()])
    except InvalidValue:
        return None


def apart(points: Floats) -> Floats:
    """The points at least APART from the one before, and the last point."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) >= APART:
            kept.append(point)
    last = points[-1]
    if len(kept) > 1 and np.hypot(*(last - kept[-1])) > 0.0:
        kept[-1 if np.hypot(*(last - kept[-1])) < 0.5 * APART else len(kept) :] = [last]
    return np.array(kept)


def evenly(points: Floats) -> Floats:
    """Points along a line through others, STEP apart (N, 2) [m]."""
    s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    count = min(STEPS_MAX, int(s[-1] / STEP) + 1)
    places = np.linspace(0.0, s[-1], count)
    return np.column_stack([np.interp(places, s, axis) for axis in points.T])


def smoothed(way: Floats, width: float) -> Floats:
    """Evenly spaced points smoothed by a Gaussian of this width [m]; beyond both ends the way is turned around them."""
    step = max(float(np.hypot(*(way[1] - way[0]))), 1e-9)
    reach = min(int(CUT * width / step) + 1, len(way) - 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) * step / width) ** 2)
    before, after = 2.0 * way[0] - way[reach:0:-1], 2.0 * way[-1] - way[-2 : -reach - 2 : -1]
    longer = np.concatenate([before, way, after])
    return np.column_stack([np.convolve(axis, weights / weights.sum(), "valid") for axis in longer.T])


def _knots(way: Floats) -> Floats:
    """The points of a curve along a smooth line: about KNOT apart, and at most as many as a path may have."""
    s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))])
    count = min(POINTS_MAX, max(2, round(s[-1] / KNOT) + 1))
    places = np.linspace(0.0, s[-1], count)
    return np.column_stack([np.interp(places, s, axis) for axis in way.T])


def _beside(points: Floats, s: Floats, line: Floats) -> tuple[Floats, Floats]:
    """The place on the path [m] and the distance from it [m] of every point (P,), in the order of the walk."""
    places, off, at, before = np.empty(len(points)), np.empty(len(points)), 0.0, points[0]
    for k, point in enumerate(points):
        reach = float(np.hypot(*(point - before)))
        low, high = np.searchsorted(s, [s[0] + at - BEHIND, s[0] + at + reach + AHEAD])
        low = min(int(low), len(s) - 2)
        begins, ways = line[low : max(int(high), low + 1)], np.diff(line[low : max(int(high), low + 1) + 1], axis=0)
        begins = begins[: len(ways)]
        share = np.clip(((point - begins) * ways).sum(axis=1) / (ways * ways).sum(axis=1), 0.0, 1.0)
        distance = np.hypot(*(begins + share[:, None] * ways - point).T)
        best = int(distance.argmin())
        off[k] = distance[best]
        places[k] = s[low + best] + share[best] * (s[low + best + 1] - s[low + best]) - s[0]
        at, before = max(at, float(places[k])), point
    return places, off


def passages_of(times: Floats, places: Floats, error: float = PLACE) -> list[dict[str, Any]] | None:
    """Speeds from the first time on (0 s); None if the times do not grow. times [s], places along the path [m]: (P,)

    error: of a place at a time that passages may have [m]; where places fall, they are first fitted by some that do not
    A point whose time is not known (NaN) does not count, but the first point must have one.
    """
    from scipy.optimize import isotonic_regression  # type: ignore[import-untyped]

    if not np.isfinite(times[0]):
        return None
    known = np.isfinite(times)
    times, places = times[known], places[known]
    grows = np.concatenate([[True], times[1:] > np.maximum.accumulate(times)[:-1]])
    times, places = times[grows] - times[0], places[grows]
    if len(times) < 2:
        return None
    places = isotonic_regression(places).x
    while len(kept := _corners(times, places, error)) > PASSAGES + 1:
        error *= PLACE_GROWTH
    passages: list[dict[str, Any]] = []
    for a, b in pairwise(kept):
        speed = round(float((places[b] - places[a]) / (times[b] - times[a])), DECIMALS)
        passages.append({"speed": 0.0 if speed < PAUSE else speed, "until_time": round(float(times[b]), 1)})
    return passages


def _corners(times: Floats, places: Floats, error: float) -> list[int]:
    """The fewest points found between which every place is within an error of a line in time (Douglas and Peucker)."""
    kept, parts = {0, len(times) - 1}, [(0, len(times) - 1)]
    while parts:
        a, b = parts.pop()
        if b - a < 2:
            continue
        inner = slice(a + 1, b)
        share = (times[inner] - times[a]) / (times[b] - times[a])
        off = np.abs(places[a] + share * (places[b] - places[a]) - places[inner])
        k = int(off.argmax())
        if off[k] > error:
            kept.add(a + 1 + k)
            parts += [(a, a + 1 + k), (a + 1 + k, b)]
    return sorted(kept)

"""A path from a track that was walked: thinned, smoothed to what benches can follow, with its times as passages.

A receiver is metres off, and more so while it stands. Its noise is measured from the track itself: third differences
of the points are nothing along a straight line and an even bend, and a corner is in few of them. The points are thinned
by it, and smoothed along the way with a Gaussian whose width grows until no bend is tighter than the longest bench can
follow. That may cost no more than the noise and what a right-angled corner loses for it. Where no width does, the track
keeps its shape: of the widths that cost no more than the noise the least one counts that leaves the tight bends about
as short as any. Where a track is made of straight lines that meet in corners, with room for arcs, an arc in each corner
costs less than a Gaussian, and is taken. Both ends stay in place. Of a track of more than POINTS_MOST points every
second, third and so on counts.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from app.maps.lines import far_apart, furthest
from app.wire.paths import POINTS_MAX
from core import Dragon, InvalidValue, Legs, Quantity
from core.paths.following import tightest_bend
from core.values import Floats

# Distance of the handles of the longest bench [m]: the contest's head.
CHORD = 2.86
# Least distance of two points that count: in errors of the receiver [1], at least and at most [m], because one at rest
# moves by less.
THINNED, APART_LEAST, APART = 10.0, 0.5, 2.0
# Distance of the points that are smoothed [m], and the most of them.
STEP, STEPS_MAX = 0.25, 20_000
# Distance of the points of the path: least and largest [m]; between them, the width of the smoothing.
KNOT_LEAST, KNOT = 0.5, 3.0
# First width of the smoothing [m], its growth, and the widest one; a Gaussian is cut off at so many widths [1].
FIRST, GROWTH, WIDEST, CUT = 0.25, 1.15, 15.0, 3.0
# What noise explains, in errors of the receiver in each direction [1], at least [m]: the error of the points that a
# curve follows in part, and their largest distance from it.
NOISE_LEAST, FOLLOWED, FARTHEST = 0.05, 1.3, 4.0
# What bends may cost beyond that to become easy, in the radius that they need [1]: error, and largest distance. A
# right angle that a Gaussian rounds to a radius is 0.65 of it off; others may stand close to it.
ROUNDED, CORNER = 0.6, 1.25
# Length by which tight bends are as short as others [m].
ABOUT = 1.0
# Most points of a track that count [1].
POINTS_MOST = 20_000
# Least turn of a corner [rad], and least share of all turns that corners have where a track is made of straight lines;
# the radii of its arcs that are tried, in the radius of an easy bend [1], because a curve through points of an arc is
# tighter where that begins; and how many points of the arcs belong to one of the way.
SHARP, SHARP_SHARE, ARCS, FINER = 0.4, 0.9, (1.0, 1.03, 1.06, 1.1, 1.15, 1.2), 4
# Radius of the bends beyond the least one that benches can follow [1].
EASY = 1.1
# Way to both sides of where a point went, in which the nearest place of the path is looked for: beside the distance of
# points that count, in errors of the receiver [1].
BESIDE = 3.0
# Largest error of a place on the path at a time: at least [m], and in errors of the receiver [1]; its growth until
# PASSAGES are enough [1]; and a pause's speed [m/s].
PLACE, ERRORS, PLACE_GROWTH, PASSAGES, PAUSE = 1.0, 4.0, 1.5, 60, 0.1
DECIMALS = 3
# Factors of a third difference [1].
THIRD = (1, -3, 3, -1)


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
    noise = noise_of(points)
    track = _Track.of(points, noise)
    if len(track.way) < 3:
        return None
    tries: list[_Try] = []
    width = FIRST
    while width <= WIDEST and not (tries and tries[-1].tight == 0.0):
        if (one := _tried(track, width, radius)) is not None:
            tries.append(one)
        width *= GROWTH
    if not tries:
        rule = "must hold a track that does not turn on the spot, as this one does even when smoothed over {width}"
        raise InvalidValue("file", rule, width=Quantity(width / GROWTH, "m", 3))
    best = _best(tries, noise, radius)
    eased = _with_arcs(track, radius)
    if eased is not None and (best.tight > 0.0 or eased.error <= best.error):
        best = eased
    passages = None
    if times is not None:  # a receiver is as far off along the way as across it
        passages = passages_of(np.asarray(times, dtype=np.float64), best.places, max(PLACE, ERRORS * best.error))
    lost = float(np.hypot(*np.diff(track.way, axis=0).T).sum()) - best.length
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


@dataclass(frozen=True)
class _Track:
    """A track that is smoothed.

    points: all (P, 2) [m]; way: through those that count, evenly spaced (N, 2) [m]; along: of the last point that
    counts, for every point, its part of the way (P,) [1]; reach: to both sides of there a point may be [m]
    """

    points: Floats
    way: Floats
    along: Floats
    reach: float

    @classmethod
    def of(cls, points: Floats, noise: float) -> _Track:
        distance = min(max(APART_LEAST, THINNED * noise), APART)
        kept = apart(points, distance)
        s = lengths_along(points[kept])
        last = np.searchsorted(kept, np.arange(len(points)), "right") - 1
        return cls(points, evenly(points[kept]), s[last] / max(s[-1], APART_LEAST), distance + BESIDE * noise)


def noise_of(points: Floats) -> float:
    """Error of a receiver in each direction [m], from the points of its track (P, 2) [m]; half of them may be corners.

    The third difference of values with independent errors of deviation d has the deviation d sqrt(1 + 9 + 9 + 1); the
    length of two such differences has the median sqrt(2 ln 2) times that.
    """
    if len(points) < len(THIRD):
        return 0.0
    median = float(np.median(np.hypot(*np.diff(points, n=len(THIRD) - 1, axis=0).T)))
    return median / math.sqrt(2.0 * math.log(2.0) * sum(one * one for one in THIRD))


def _best(tries: list[_Try], noise: float, radius: float) -> _Try:
    """The last try, if its bends are easy and cost no more than they may; else the best one that only noise explains.

    tries: from the least width on; noise: of the receiver in each direction [m]; radius: of an easy bend [m]
    """
    first, last = tries[0], tries[-1]
    error = max(NOISE_LEAST, FOLLOWED * noise, first.error)
    farthest = max(NOISE_LEAST, FARTHEST * noise, first.largest)
    is_near = last.error <= math.hypot(error, ROUNDED * radius) and last.largest <= farthest + CORNER * radius
    if last.tight == 0.0 and is_near:
        return last
    near = [one for one in tries if one.error <= error]
    least = min(one.tight for one in near)
    return next(one for one in near if one.tight <= least + ABOUT)


def _tried(track: _Track, width: float, radius: float) -> _Try | None:
    """The curve along a track smoothed by this width [m]; None if it would stop or turn on the spot."""
    return _followed(track, smoothed(track.way, width), width, radius)


def _followed(track: _Track, smooth: Floats, width: float, radius: float) -> _Try | None:
    """The curve along a line whose points belong to those of the track's way (N, 2) [m]; None as _tried()."""
    knots = _knots(smooth, min(max(width, KNOT_LEAST), KNOT))
    course = _curve(knots)
    if course is None:
        return None
    tight = sum(end - start for start, end, _ in course.tighter(radius))
    s = np.linspace(course.begin, course.end, min(STEPS_MAX, int((course.end - course.begin) / STEP) + 2))
    lengths = lengths_along(smooth)
    part = np.interp(track.along, np.linspace(0.0, 1.0, len(smooth)), lengths / lengths[-1])
    places, off = _beside(track.points, part, track.reach, s - course.begin, course.position(s))
    error = float(np.sqrt(np.mean(off * off)))
    return _Try(width, knots, course.end - course.begin, tight, float(off.max()), error, places)


def _with_arcs(track: _Track, radius: float) -> _Try | None:
    """The curve along straight lines with an arc in each corner, all easy; None for another track, or without room."""
    corners = _corners_of(track.points)
    ways = np.diff(corners, axis=0)
    headings = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
    turns = np.abs(np.diff(headings))
    if not turns.size or turns[turns >= SHARP].sum() < SHARP_SHARE * turns.sum():
        return None
    for scale in ARCS:
        line = _rounded(corners, headings, scale * radius, FINER * len(track.way))
        if line is None:
            return None
        one = _followed(track, smoothed(line, FIRST), FIRST, radius)
        if one is not None and one.tight == 0.0:
            return one
    return None


def _corners_of(points: Floats) -> Floats:
    """The ends of straight lines (K, 2) [m] from which no point is further off than NOISE_LEAST."""
    moved = np.concatenate([[True], np.hypot(*np.diff(points, axis=0).T) > 0.0])
    points = points[moved]
    return points[_corners(len(points), lambda a, b: furthest(points, a, b), NOISE_LEAST)]


def _corners(count: int, furthest_between: Callable[[int, int], tuple[float, int]], most: float) -> list[int]:
    """The fewest of so many places found between which none is further off than `most` (Douglas and Peucker).

    furthest_between: as furthest(), of two places
    """
    kept, parts = {0, count - 1}, [(0, count - 1)]
    while parts:
        a, b = parts.pop()
        off, k = furthest_between(a, b)
        if -off > most:
            kept.add(k)
            parts += [(a, k), (k, b)]
    return sorted(kept)


# An arc of radius r in a corner with the turn t begins and ends r tan(t / 2) from it. Points on the lines are spread
# evenly over the arc instead.
def _rounded(corners: Floats, headings: Floats, radius: float, count: int) -> Floats | None:
    """Points (count, 2) [m] that belong to evenly spaced ones of straight lines; None where arcs have no room."""
    lengths, turns = np.hypot(*np.diff(corners, axis=0).T), np.diff(headings)
    if np.abs(turns).max() >= math.pi - SHARP:
        return None
    cut = np.concatenate([[0.0], radius * np.tan(0.5 * np.abs(turns)), [0.0]])
    if (cut[:-1] + cut[1:] > lengths).any():
        return None
    s = lengths_along(corners)
    at, line = spread(corners, s, count)
    for k, turn in enumerate(turns, start=1):
        inside = np.abs(at - s[k]) < cut[k]
        share = (at[inside] - s[k] + cut[k]) / (2.0 * cut[k])
        along = np.array([math.cos(headings[k - 1]), math.sin(headings[k - 1])])
        left = math.copysign(1.0, turn) * np.array([-along[1], along[0]])
        angle = share * abs(turn)
        begin = corners[k] - cut[k] * along
        line[inside] = begin + radius * (np.sin(angle)[:, None] * along + (1.0 - np.cos(angle))[:, None] * left)
    return line


def lengths_along(points: Floats) -> Floats:
    """Length of the line through points (N, 2) up to each of them (N,) [m]."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def spread(points: Floats, s: Floats, count: int) -> tuple[Floats, Floats]:
    """Evenly spaced places on the line through points, as lengths (count,) [m], and where they are (count, 2) [m].

    s: lengths_along() of the points
    """
    at = np.linspace(0.0, s[-1], count)
    return at, np.column_stack([np.interp(at, s, axis) for axis in points.T])


def _curve(knots: Floats) -> Legs | None:
    """The curve through these points; None if it would stop or turn on the spot, as through noise."""
    try:
        return Legs([tuple(one) for one in knots.tolist()])
    except InvalidValue:
        return None


def apart(points: Floats, distance: float = APART) -> list[int]:
    """Which points are at least at a distance [m] from the one before that counts; and the last point."""
    kept = far_apart(points, distance)
    off = float(np.hypot(*(points[-1] - points[kept[-1]])))
    if len(kept) > 1 and off > 0.0:
        kept[-1 if off < 0.5 * distance else len(kept) :] = [len(points) - 1]
    return kept


def evenly(points: Floats) -> Floats:
    """Points along a line through others, STEP apart (N, 2) [m]."""
    s = lengths_along(points)
    return spread(points, s, min(STEPS_MAX, int(s[-1] / STEP) + 1))[1]


def smoothed(way: Floats, width: float) -> Floats:
    """Evenly spaced points smoothed by a Gaussian of this width [m]; beyond both ends the way is turned around them."""
    step = max(float(np.hypot(*(way[1] - way[0]))), 1e-9)
    reach = min(int(CUT * width / step) + 1, len(way) - 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) * step / width) ** 2)
    before, after = 2.0 * way[0] - way[reach:0:-1], 2.0 * way[-1] - way[-2 : -reach - 2 : -1]
    longer = np.concatenate([before, way, after])
    return np.column_stack([np.convolve(axis, weights / weights.sum(), "valid") for axis in longer.T])


def _knots(way: Floats, distance: float) -> Floats:
    """Points of a curve along a smooth line: about so far apart [m], and at most as many as a path may have."""
    s = lengths_along(way)
    return spread(way, s, min(POINTS_MAX, max(2, round(s[-1] / distance) + 1)))[1]


def _beside(points: Floats, part: Floats, reach: float, s: Floats, line: Floats) -> tuple[Floats, Floats]:
    """The place on the path [m] and the distance from it [m] of every point (P,): the nearest one around its part of
    the path (P,) [1], which is in the order of the walk, so that no other winding counts."""
    step = float(s[1] - s[0])
    around = int(reach / step) + 1
    middle = np.rint(part * s[-1] / step).astype(int)
    places, off = np.empty(len(points)), np.full(len(points), np.inf)
    ways = np.diff(line, axis=0)
    lengths = np.maximum((ways * ways).sum(axis=1), np.finfo(float).tiny)
    for shift in range(-around, around):
        k = np.clip(middle + shift, 0, len(ways) - 1)
        share = np.clip(((points - line[k]) * ways[k]).sum(axis=1) / lengths[k], 0.0, 1.0)
        distance = np.hypot(*(line[k] + share[:, None] * ways[k] - points).T)
        is_nearer = distance < off
        off[is_nearer], places[is_nearer] = distance[is_nearer], (s[k] + share * step)[is_nearer]
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

    def furthest_between(a: int, b: int) -> tuple[float, int]:
        """The place that is furthest from where even speed between two others would have it; as furthest()."""
        if b - a < 2:
            return 0.0, a
        inner = slice(a + 1, b)
        share = (times[inner] - times[a]) / (times[b] - times[a])
        off = np.abs(places[a] + share * (places[b] - places[a]) - places[inner])
        k = int(off.argmax())
        return -float(off[k]), a + 1 + k

    while len(kept := _corners(len(times), furthest_between, error)) > PASSAGES + 1:
        error *= PLACE_GROWTH
    passages: list[dict[str, Any]] = []
    for a, b in pairwise(kept):
        speed = round(float((places[b] - places[a]) / (times[b] - times[a])), DECIMALS)
        passages.append({"speed": 0.0 if speed < PAUSE else speed, "until_time": round(float(times[b]), 1)})
    return passages

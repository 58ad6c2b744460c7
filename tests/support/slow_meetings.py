"""Meetings of benches, found a second time slowly: trajectory() in small steps, complex numbers, SciPy and shapely."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq
from shapely import LineString, Polygon

from core import Dance, bench_outlines, trajectory
from core.people.meetings import EVEN, STEP, MeetingColumns
from core.values import Floats

# How well a root is known [m of head travel].
ROOT = 1e-12

# Own and other bench, travel of the head [m], gap [m], and whether the other is to the left.
SlowMeeting = tuple[int, int, float, float, bool]


def at_one_metre_a_second(dance: Dance) -> Dance:
    """The dance whose times are travels of the head."""
    return Dance(dance.dragon, dance.path, 1.0)


def ahead(dance: Dance, own: int, other: int, travel: float) -> float:
    """How far the middle of the other bench is before that of the own one, along the own bench [m]."""
    handles = trajectory(at_one_metre_a_second(dance), travel).position
    places = [complex(*handles[k]) for k in (own, own + 1, other, other + 1)]
    along = places[0] - places[1]
    return float(((places[2] + places[3] - places[0] - places[1]) / 2.0 * along.conjugate()).real / abs(along))


def slow_meetings(
    dance: Dance, ends: tuple[float, float], reach: float, step: float, lasting: float
) -> tuple[list[SlowMeeting], list[SlowMeeting]]:
    """All meetings between two travels of the head, and the lasting ones among them.

    step: of the search; lasting: way over which the other bench must be more than EVEN ahead before a meeting, and
        behind after it, or the other way round [m of head travel]
    """
    grid = np.linspace(*ends, int((ends[1] - ends[0]) / step) + 2)
    handles = trajectory(at_one_metre_a_second(dance), grid).position @ np.array([1.0, 1.0j])
    middles, along = 0.5 * (handles[:, :-1] + handles[:, 1:]), handles[:, :-1] - handles[:, 1:]
    every, last = [], []
    for own in range(dance.dragon.benches):
        for other in set(range(dance.dragon.benches)) - {own - 1, own, own + 1}:
            before = ((middles[:, other] - middles[:, own]) * along[:, own].conjugate() / np.abs(along[:, own])).real
            all_changes, some = (set(_changes(grid, before, way)) for way in (0.0, lasting))
            for first, later in all_changes | some:
                travel = brentq(lambda s: ahead(dance, own, other, s), grid[first], grid[later], xtol=ROOT)  # noqa: B023
                if (one := _met(dance, own, other, travel)) and one[3] <= reach:
                    every += [one] * ((first, later) in all_changes)
                    last += [one] * ((first, later) in some)
    return every, last


def _changes(grid: Floats, before: Floats, lasting: float) -> Iterator[tuple[int, int]]:
    """Last and first place of two stretches with other signs and nothing that counts between them."""
    signs = np.where(np.abs(before) > EVEN, np.sign(before), 0.0)
    starts = np.concatenate([[0], np.flatnonzero(np.diff(signs)) + 1, [signs.size]])
    stretches = [(first, last - 1) for first, last in pairwise(starts.tolist()) if signs[first]]
    ends = 0, signs.size - 1
    # A stretch at an end of the time may have lasted longer.
    kept = [
        one for one in stretches if grid[one[1]] - grid[one[0]] >= lasting or one[0] == ends[0] or one[1] == ends[1]
    ]
    return ((one[1], two[0]) for one, two in pairwise(kept) if signs[one[0]] != signs[two[0]])


def _met(dance: Dance, own: int, other: int, travel: float) -> SlowMeeting | None:
    """The meeting at a travel; None if a third bench is between the two."""
    outlines = bench_outlines(dance.dragon, trajectory(at_one_metre_a_second(dance), travel).position)
    shapes = [Polygon(one) for one in outlines]
    line = LineString([shapes[one].centroid for one in (own, other)])
    if any(line.intersects(one) for k, one in enumerate(shapes) if k not in (own, other)):
        return None
    away = np.subtract(line.coords[1], line.coords[0])
    to_the_left = outlines[own][0] - outlines[own][1]  # from the corner front-right to front-left
    return own, other, travel, shapes[own].distance(shapes[other]), bool(away @ to_the_left > 0.0)


def same_meetings(
    met: MeetingColumns, dance: Dance, ends: tuple[float, float], reach: float, step: float
) -> list[SlowMeeting]:
    """The slow meetings in the order of the others, which must be among them; every lasting one must be there.

    met: meetings of all benches; a bench that is more than EVEN past another for less than STEP may be missed
    """
    every, lasting = slow_meetings(dance, ends, reach, step, STEP)
    keys = [(own, other, round(travel, 5)) for own, other, travel, *_ in zip(*map(list, met), strict=True)]
    by_key = {(own, other, round(travel, 5)): one for one in every for own, other, travel in [one[:3]]}
    assert {(own, other, round(travel, 5)) for own, other, travel, *_ in lasting} <= set(keys)
    return [by_key[key] for key in keys]

"""Turns: the stretches of a path along which who follows it turns to one side.

Input:  a path and two places on it
Output: the turns between them, in the order of the path

The direction is taken at places STEP apart, or in ROWS_MAX places of a long stretch, and made continuous. A step turns
if it bends more than a circle of the radius GENTLE; steps to one side that are less than STRAIGHT apart are one turn,
which counts if it turns by LEAST or more. So a corner counts like a bend. What may be missed: a turn to one side and
back within a step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.paths.path import Path
from core.values import Point

# Distance of two places [m], and most places.
STEP, ROWS_MAX = 0.25, 20_000
# Radius of a bend that is too gentle to be called a turn, and straight way between two turns to one side [m].
GENTLE, STRAIGHT = 30.0, 3.0
# Least angle of a turn, and angle between two of its points that are kept [rad].
LEAST, KEPT = math.radians(30.0), math.radians(15.0)


@dataclass(frozen=True, slots=True)
class Bend:
    """A turn of a path.

    first, last: places of its ends [m]; angle: by which it turns, to the left > 0 [rad]; heading: behind it [rad]
    way: points of it [m]
    """

    first: float
    last: float
    angle: float
    heading: float
    way: tuple[Point, ...]


def bends_between(path: Path, first: float, last: float) -> list[Bend]:
    """The turns between two places of a path [m].

    >>> from core import Arc, Line, Route
    >>> turn = Arc((10.0, 2.0), 2.0, -math.pi / 2, math.pi / 2)
    >>> (bend,) = bends_between(Route([Line((0.0, 0.0), (10.0, 0.0)), turn, Line((12.0, 2.0), (12.0, 9.0))]), 0.0, 20.0)
    >>> round(bend.first), round(bend.last), round(math.degrees(bend.angle)), round(math.degrees(bend.heading))
    (10, 13, 90, 90)
    """
    # On a grid, so that a turn is the same between other ends.
    step = STEP * max(1, math.ceil((last - first) / STEP / ROWS_MAX))
    grid = step * np.arange(math.floor(first / step) + 1, math.ceil(last / step))
    s = np.concatenate([[first], grid[(grid > first) & (grid < last)], [last]])
    tangents = path.tangent(s)
    heading = np.unwrap(np.arctan2(tangents[:, 1], tangents[:, 0]))
    steps = np.diff(heading)
    turning = np.flatnonzero(np.abs(steps) * GENTLE > np.diff(s))
    if not turning.size:
        return []
    sides = np.sign(steps[turning])
    apart = (np.diff(sides) != 0.0) | (s[turning[1:]] - s[turning[:-1] + 1] > STRAIGHT)
    ends = np.concatenate([[0], np.flatnonzero(apart) + 1, [turning.size]])
    bends = []
    for a, b in zip(turning[ends[:-1]].tolist(), (turning[ends[1:] - 1] + 1).tolist(), strict=True):
        angle = float(heading[b] - heading[a])
        if abs(angle) >= LEAST:
            places = np.linspace(s[a], s[b], int(abs(angle) / KEPT) + 2)
            way = tuple((x, y) for x, y in path.position(places).tolist())
            bends.append(Bend(float(s[a]), float(s[b]), angle, float(heading[b]), way))
    return bends

"""A plain program: scipy.optimize.brentq finds every handle, and shapely looks at every instant."""

from __future__ import annotations

import math

import numpy as np
import shapely
from scipy.optimize import brentq

from core import Dragon, Spiral
from core.values import Floats

STEP = 0.1  # time between two looks [s]; it can miss short contacts, as every fixed step can
BRACKET = 1e-9  # width to which the baseline bisects [s] or [m]: the accuracy of core's answers
PITCH_RANGE = 0.25  # range in which the paper searches, 0.30 to 0.55 m [m]


def arc(theta: float) -> float:
    """Arc length from the centre, in units of growth."""
    return 0.5 * (theta * math.sqrt(1.0 + theta * theta) + math.asinh(theta))


def handle_thetas(dragon: Dragon, path: Spiral, time: float) -> Floats:
    """(n + 1,) polar angles of the handles, the head at 1 m/s: one root after the other."""
    growth, remaining = path.growth, path.length - time
    thetas = [brentq(lambda theta: growth * arc(theta) - remaining, 0.0, path.start_theta + 1.0, xtol=1e-14)]
    for chord in dragon.chords:
        front = thetas[-1]

        def excess(rear: float, front: float = front, chord2: float = (chord / growth) ** 2) -> float:
            return front * front + rear * rear - 2.0 * front * rear * math.cos(rear - front) - chord2

        thetas.append(brentq(excess, front, front + math.pi, xtol=1e-14))
    return np.array(thetas)


def handles_and_velocities(dragon: Dragon, path: Spiral, time: float) -> tuple[Floats, Floats]:
    """(n + 1, 2) positions [m] and velocities [m/s] at one instant, the velocities from the rigid links."""
    thetas = handle_thetas(dragon, path, time)
    direction = np.stack([np.cos(thetas), np.sin(thetas)], axis=-1)
    left = np.stack([-direction[:, 1], direction[:, 0]], axis=-1)
    position = path.growth * thetas[:, None] * direction
    tangent = -(direction + thetas[:, None] * left) / np.sqrt(1.0 + thetas**2)[:, None]
    link = position[:-1] - position[1:]
    ratio = np.sum(tangent[:-1] * link, axis=-1) / np.sum(tangent[1:] * link, axis=-1)
    speed = np.cumprod(np.r_[1.0, ratio])
    return position, speed[:, None] * tangent


def polygons(dragon: Dragon, position: Floats) -> list[shapely.Polygon]:
    """One rectangle for each bench."""
    front, rear = position[:-1], position[1:]
    along = (front - rear) / dragon.chords[:, None]
    left = np.stack([-along[:, 1], along[:, 0]], axis=-1) * 0.5 * dragon.widths[:, None]
    front, rear = front + along * dragon.overhangs[:, None], rear - along * dragon.overhangs[:, None]
    return list(shapely.polygons(np.stack([front + left, front - left, rear - left, rear + left], axis=1)))


def overlapping_pairs(benches: list[shapely.Polygon]) -> Floats:
    """(P, 2) pairs a < b that share no handle and intersect, by a tree over all benches."""
    a, b = shapely.STRtree(benches).query(benches, predicate="intersects")
    return np.stack([a, b], axis=-1)[b - a > 1]


def looks(dragon: Dragon, path: Spiral, times: Floats) -> list[bool]:
    """True at each time at which any benches overlap."""
    return [
        overlapping_pairs(polygons(dragon, handles_and_velocities(dragon, path, time)[0])).size > 0 for time in times
    ]


def handles(dragon: Dragon, path: Spiral, time: float) -> Floats:
    """(n + 1, 2) positions [m] at one instant, of a spiral anywhere and in either direction."""
    position = handles_and_velocities(dragon, path, time)[0]
    if not path.clockwise:
        position = position * [1.0, -1.0]
    cos, sin = math.cos(path.rotation), math.sin(path.rotation)
    return position @ np.array([[cos, sin], [-sin, cos]]) + path.centre


def looks_at_several(dragon: Dragon, paths: list[Spiral], times: Floats) -> list[bool]:
    """True at each time at which benches of two equal dragons overlap, one on each path."""
    owner, overlap = np.repeat(np.arange(len(paths)), dragon.benches), []
    for time in times:
        benches = [bench for path in paths for bench in polygons(dragon, handles(dragon, path, time))]
        a, b = shapely.STRtree(benches).query(benches, predicate="intersects")
        overlap.append(bool((owner[a] != owner[b]).any()))
    return overlap


def ground(dragon: Dragon, path: Spiral, times: Floats) -> shapely.Geometry:
    """The union of all benches at all times."""
    handles = (handles_and_velocities(dragon, path, time)[0] for time in times)
    return shapely.union_all([bench for position in handles for bench in polygons(dragon, position)])


def looks_for_first_contact(time: float) -> int:
    """Number of looks in a march to the first contact and a bisection there."""
    return math.ceil(time / STEP) + math.ceil(math.log2(STEP / BRACKET))


def looks_for_minimum_pitch(pitch: float, start_turns: float, turning_radius: float) -> int:
    """Number of looks in a bisection of the pitch, each step a march to the turning circle."""
    path = Spiral(pitch, start_turns)
    march = path.length - path.growth * arc(turning_radius / path.growth)
    return math.ceil(math.log2(PITCH_RANGE / BRACKET)) * math.ceil(march / STEP)

"""A bench on a route, followed a second time slowly and plainly: small steps, the first root of a scan, jumps seen."""

from dataclasses import dataclass

import numpy as np

from core import Route
from core.errors import InvalidValue
from tests.support.random_routes import Pen
from tests.support.slow_route import points_along

# Steps of the scan for the rear handle over the chord; steps of the scan for each step of the front handle; how far
# back the scan goes over the chord. A step in which the rear handle moves further than SUSPECT is halved down to
# HALVED [m]: if it moves further than SUSPECT even then, it jumps.
SCAN, FRONT, BACK, SUSPECT, HALVED = 2e-3, 4, 6.0, 0.03, 1e-6


@dataclass
class Followed:
    """What the steps saw: the first front place at which the rear handle jumps, if any; the least u . T at both handles
    up to there; and by how much the nearest local maximum of the distance stays below the chord [m]."""

    jumps_at: float | None = None
    rear_cosine: float = 1.0
    front_cosine: float = 1.0
    spare: float = np.inf


def rear_behind(distance, s, chord):
    """The first place behind s at the chord's distance, and the greatest distance of a nearer one [m]; None if none is.

    distance: from s, of the places of the scan behind it (N,) [m]
    """
    n = int(np.argmax(distance >= chord))
    if n == 0:
        return None, chord
    inner = distance[:n]
    tops = inner[1:-1][(inner[1:-1] >= inner[:-2]) & (inner[1:-1] > inner[2:])]
    part = (chord - distance[n - 1]) / (distance[n] - distance[n - 1])
    return s - (n - 1 + part) * SCAN * chord, tops.max(initial=0.0)


def cosines_at(route, chord, s):
    """u . T at the rear and at the front handle with the front one at s, its rear one from a finer scan."""
    points, _ = points_along(route, s - SCAN * chord * np.arange(round(BACK / SCAN)))
    rear, _ = rear_behind(np.abs(points - points[0]), s, chord)
    for width in (2.0 * SCAN * chord, 2.0 * SCAN**2 * chord):
        places = np.linspace(rear + width, rear - width, round(4.0 / SCAN))
        points, _ = points_along(route, np.array([s, *places]))
        rear = places[np.argmax(np.abs(points[1:] - points[0]) >= chord)]
    (front, place), (onwards, tangent) = points_along(route, np.array([s, rear]))
    along = np.conj(front - place) / chord
    return (along * tangent).real, (along * onwards).real


def jumps_between(route, chord, low, high):
    """Whether the rear handle jumps between two places of the front handle, each with that of the rear one [m]."""
    while abs(high[1] - low[1]) > SUSPECT:
        if high[0] - low[0] < HALVED:
            return True
        s = 0.5 * (low[0] + high[0])
        points, _ = points_along(route, s - SCAN * chord * np.arange(round(BACK / SCAN)))
        middle = s, rear_behind(np.abs(points - points[0]), s, chord)[0]
        if middle[1] is None:
            return True
        low, high = max((low, middle), (middle, high), key=lambda half: abs(half[1][1] - half[0][1]))
    return False


def followed_slowly(route, chord):
    """A bench with its front handle from a chord behind the beginning of a route, which is straight, to its end."""
    seen = Followed()
    before = None
    back = round(BACK / SCAN)
    grid = route.begin + SCAN * chord * np.arange(round(1.0 / SCAN) - back, (route.end - route.begin) / (SCAN * chord))
    points, tangents = points_along(route, grid)
    for k in range(back, len(grid), FRONT):
        s = grid[k]
        front = points[k]
        onwards = tangents[k]
        rear, top = rear_behind(np.abs(points[k - back : k + 1][::-1] - front), s, chord)
        if rear is None or (before is not None and jumps_between(route, chord, before, (s, rear))):
            seen.jumps_at = s
            break
        before = s, rear
        (place,), (tangent,) = points_along(route, np.array([rear]))
        along = np.conj(front - place) / chord
        seen.rear_cosine = min(seen.rear_cosine, (along * tangent).real)
        seen.front_cosine = min(seen.front_cosine, (along * onwards).real)
        seen.spare = min(seen.spare, chord - top)
    return seen


def twisted(rng, run_up):
    """A random route that begins with a straight run-up [m] and goes on with arcs down to a radius of 0.1 m, coils and
    clothoids, and corners of up to 86 degrees; None if its pieces are impossible."""
    pen = Pen()
    pen.line(run_up)
    for kind in rng.choice(["line", "arc", "arc", "arc", "corner", "corner", "coil", "clothoid"], rng.integers(2, 7)):
        if kind == "line":
            pen.line(rng.uniform(0.1, 3.0))
        elif kind == "arc":
            radius = 10.0 ** rng.uniform(-1.0, 0.5)
            pen.arc(radius, rng.choice([-1.0, 1.0]) * rng.uniform(0.1, min(4.0, 2.5 / radius)))
        elif kind == "corner":
            pen.line(rng.uniform(0.1, 1.5))
            pen.heading += rng.choice([-1.0, 1.0]) * rng.uniform(0.1, 1.5)
            pen.line(rng.uniform(0.1, 1.5))
        elif kind == "coil":
            turns = rng.uniform(0.3, 2.5)
            pen.coil(rng.uniform(0.6, 2.0), turns, turns + rng.choice([-0.2, 0.5]))
        else:
            pen.clothoid(*rng.uniform(-1.2, 1.2, 2), rng.uniform(0.3, 2.5))
    try:
        return Route(pen.pieces, run_up + rng.choice([-run_up, rng.uniform(0.0, 4.0)]))
    except InvalidValue:
        return None

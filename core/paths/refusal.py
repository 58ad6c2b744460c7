"""The refusal of a route that a bench cannot follow: where, why, what is too much, and the nearest that is followed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.dragon import Dragon
from core.errors import InvalidValue
from core.kernels.constants import LAG
from core.language import phrase
from core.paths.following import (
    ROOM_WIDTH,
    Hindrance,
    Obstacle,
    bends_widely,
    degrees_most,
    following,
    follows,
    least_radius,
)
from core.paths.legs import Legs
from core.paths.pieces import Arc, Line
from core.paths.route import Route
from core.quantities import Quantity, Value, bound, quantities
from core.sampling import bisect
from core.values import Floats

# Steps of the angle and of the radius that a remedy names [degrees], [m].
ANGLE_STEP, RADIUS_STEP = 0.1, 0.01
# Length of the straight lines before and behind a bend that is tried alone, in chords [1].
STRAIGHT = 2.0
# Most points of a path that is laid out again with other radii, which takes 0.1 s or less a time [1].
POINTS_MOST = 50
# Most different chords of a dragon for which other bends are tried [1].
CHORDS_MOST = 10

TOO_MUCH = phrase("the path turns by {turn} there, of which {missing} are too much")
ROUNDED = phrase("with a radius of {least} at its corners the path is followed")
ALONE = phrase("between straight lines a bend of this angle is followed with a radius of {least}")
ALWAYS = phrase("a radius of {least} always suffices")


@dataclass(frozen=True, slots=True)
class Remedy:
    """What would let every bench follow where one cannot.

    turn: of the bend, if it is one arc or corner between straight lines; missing: by how much less it would have to
        turn, in steps of ANGLE_STEP [rad]; None for other bends
    radius: the least that is followed, in steps of RADIUS_STEP if it was tried [m]; how: the template of its clause
    """

    turn: float | None
    missing: float | None
    radius: float
    how: str


# Nothing is said that was not tried: both numbers are on a grid, and the bend is followed with the values said.
def remedy(dragon: Dragon, path: Route, obstacle: Obstacle) -> Remedy:
    """What would let every bench follow where one cannot."""
    chords = np.unique(dragon.chords[: dragon.uniform_from + 1])
    turn, missing, radius, how = None, None, least_radius(float(chords[-1])), ALWAYS
    if obstacle.reason is Hindrance.UNKNOWN or chords.size > CHORDS_MOST:
        return Remedy(turn, missing, radius, how)
    surely = RADIUS_STEP * math.ceil(radius / RADIUS_STEP)
    bend = _lone_bend(path, obstacle)
    if bend is not None:
        own, turn = bend
        steps = int(turn / math.radians(ANGLE_STEP))
        few = _last(lambda k: _walked(dragon, own, math.radians(ANGLE_STEP) * k), steps)
        missing = turn - math.radians(ANGLE_STEP) * few
        least = _first(lambda k: _walked(dragon, RADIUS_STEP * k, turn), own, surely)
        radius, how = (RADIUS_STEP * least, ALONE) if least is not None else (radius, how)
    if isinstance(path, Legs) and len(path.points) <= POINTS_MOST:
        least = _first(lambda k: follows(dragon, path.rounded(RADIUS_STEP * k)), path.radius, surely)
        radius, how = (RADIUS_STEP * least, ROUNDED) if least is not None else (radius, how)
    return Remedy(turn, missing, radius, how)


def _lone_bend(path: Route, obstacle: Obstacle) -> tuple[float, float] | None:
    """Radius [m], 0 for a corner, and turn [rad] of the bend of an obstacle, between lines of a chord or more."""
    ends = np.array([path.begin, *path.joints, path.end])
    under = np.flatnonzero((ends[:-1] < obstacle.s + RADIUS_STEP) & (ends[1:] > obstacle.rear - RADIUS_STEP))
    first, last = int(under[0]), int(under[-1])
    pieces, lengths = path.pieces, np.diff(ends)
    arcs = [k for k in range(first, last + 1) if not isinstance(pieces[k], Line)]
    if len(arcs) == 1 and 0 < arcs[0] < len(pieces) - 1:
        k, before, after = arcs[0], arcs[0] - 1, arcs[0] + 1
    elif not arcs and last == first + 1:
        k, before, after = last, first, last
    else:
        return None
    if not (isinstance(pieces[before], Line) and isinstance(pieces[after], Line)):
        return None
    if min(lengths[before], lengths[after]) < obstacle.chord:
        return None
    arc = pieces[k]
    if isinstance(arc, Arc):
        return arc.radius, abs(arc.sweep)
    tangents = path.tangent(np.array([0.5 * (ends[one] + ends[one + 1]) for one in (before, after)]))
    return (0.0, math.acos(float(tangents[0] @ tangents[1]))) if isinstance(arc, Line) else None


def _walked(dragon: Dragon, radius: float, turn: float) -> bool:
    """Whether every bench alone follows a bend of a radius [m], 0 for a corner, and a turn [rad] between lines."""
    chords = np.unique(dragon.chords[: dragon.uniform_from + 1])
    way = STRAIGHT * float(chords[-1])
    ahead = complex(math.cos(turn), math.sin(turn))
    bend = [Arc((0.0, radius), radius, -0.5 * math.pi, turn)] if radius * turn > 0.0 else []
    end = complex(radius * math.sin(turn), radius * (1.0 - math.cos(turn)))
    far = end + way * ahead
    route = Route([Line((-way, 0.0), (0.0, 0.0)), *bend, Line((end.real, end.imag), (far.real, far.imag))])
    return all(follows(Dragon(1, chord, overhang=0.0), route) for chord in chords.tolist())


def _last(holds: Callable[[int], bool], end: int) -> int:
    """The last number before `end` up to which something holds, from 1 on, if it then never does; 0 if for none."""
    low, high = 0, end + 1
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def _first(holds: Callable[[int], bool], below: float, up_to: float) -> int | None:
    """The first step of RADIUS_STEP above a radius for which something holds, if it does at the last one [1]."""
    low, high = int(below / RADIUS_STEP), round(up_to / RADIUS_STEP)
    if high <= low or not holds(high):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high


def refuse_tight_bends(dragon: Dragon, path: Route, time_of: Callable[[float], float]) -> None:
    """Refuse a route on which a bench is not shown to follow.

    time_of: the time at which the head is at a place [m] -> [s]
    raises: InvalidValue (path)
    """
    if bends_widely(dragon, path) or not (obstacles := following(dragon, path).obstacles):
        return
    obstacle = obstacles[0]
    x, y = path.position(obstacle.s)
    better = remedy(dragon, path, obstacle)
    clauses = [obstacle.reason.template, *([TOO_MUCH] if better.missing is not None else []), better.how]
    rule = (
        "must bend so that every bench can follow: bench {bench} ({chord}) cannot follow beyond s = {s}, at {at}, "
        f"which its front handle reaches at {{time}}; {'; '.join(clauses)}"
    )
    values: dict[str, Value] = {"bench": obstacle.bench, "at": f"({x:.4g}, {y:.4g}) m"}
    values |= quantities("m", 6, chord=obstacle.chord, s=obstacle.s)
    values |= quantities("s", 6, time=time_of(_head_at(dragon.chords, path, obstacle)))
    if better.turn is not None and better.missing is not None:
        values["turn"] = Quantity(math.degrees(better.turn), "degrees", 4)
        values["missing"] = bound(math.degrees(better.missing), 1, "degrees", up=True)
    values["least"] = bound(better.radius, 3 if better.how is ALWAYS else 2, "m", up=True)
    values["limit"] = degrees_most()
    raise InvalidValue("path", rule, **values)


def _head_at(chords: Floats, path: Route, obstacle: Obstacle) -> float:
    """Place of the head when an obstacle's front handle is at its place [m]; the end of the path if that is nearer."""
    sizes = np.zeros((obstacle.bench, kernels.SIZE_COLUMNS))
    sizes[:, kernels.CHORD] = chords[: obstacle.bench]
    chain = np.empty((obstacle.bench + 1, kernels.CHAIN_COLUMNS))

    def arrived(s: float) -> bool:
        path.follow(-s, obstacle.bench, sizes, chain)
        return -float(chain[obstacle.bench, LAG]) >= obstacle.s

    if obstacle.bench == 0:
        return obstacle.s
    return bisect(arrived, obstacle.s, path.end, width=ROOM_WIDTH, relative=ROOM_WIDTH)[1]

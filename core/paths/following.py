"""A dragon on a route: the bends that every bench can follow, and the head's travel when the whole dragon has room."""

from __future__ import annotations

import math

import numpy as np

from core import kernels
from core.dragon import Dragon
from core.errors import InvalidValue, quantities
from core.paths.path import Path
from core.paths.route import Route
from core.sampling import bisect

# Width of the bracket around the earliest travel of the head: absolute [m], and relative to it [1].
ROOM_WIDTH = 1e-9


def follows(dragon: Dragon, path: Route) -> bool:
    """True if every bend of the route is wide enough for every chord."""
    longest = float(dragon.chords[: dragon.uniform_from + 1].max())
    return bool(0.5 * path.sharpest[0] * longest <= kernels.ROUTE_SINE_LIMIT)


def tightest_bend(dragon: Dragon) -> tuple[float, int]:
    """The least radius of a bend that every bench can follow [m], and the bench that needs that radius."""
    bench = int(dragon.chords[: dragon.uniform_from + 1].argmax())
    return 0.5 * float(dragon.chords[bench]) / kernels.ROUTE_SINE_LIMIT, bench


def refuse_tight_bends(dragon: Dragon, path: Route) -> None:
    """Refuse a bend that a bench cannot follow.

    With |curvature| chord / 2 below the limit, the next handle is unique and never moves backwards.
    """
    if follows(dragon, path):
        return
    curvature, s = path.sharpest
    tightest, bench = tightest_bend(dragon)
    chord = float(dragon.chords[bench])
    x, y = path.position(s)
    rule = "must not bend tighter than a radius of {least} for the chord of bench {bench} ({chord})"
    values = quantities("m", 4, least=tightest, bend=1.0 / curvature, s=s) | quantities("m", 6, chord=chord)
    place = f"({x:.4g}, {y:.4g}) m"
    raise InvalidValue("path", f"{rule}, got {{bend}} near {{at}}, s = {{s}}", bench=bench, at=place, **values)


def earliest_travel(dragon: Dragon, path: Path, tail_begin: float) -> float:
    """Travel of the head when the last handle is at the beginning of the path [m].

    A chord spans between 1 and pi / 2 times its own length of the path. These bounds, and the end of the path, give the
    interval for a bisection of the travel of the head.
    """
    sizes = np.zeros((dragon.benches, kernels.SIZE_COLUMNS))
    sizes[:, kernels.CHORD] = dragon.chords
    chain = np.empty((dragon.benches + 1, kernels.CHAIN_COLUMNS))

    def has_room(s: float) -> bool:
        path.follow(float(path.lags(np.array([min(s, path.end)]), 0.0)[0]), dragon.benches, sizes, chain)
        return float(path.along(chain[dragon.benches, kernels.LAG])) >= tail_begin

    low, straight = tail_begin, float(dragon.chords.sum())
    high = low + 0.5 * math.pi * straight
    if not has_room(high):
        rule = (
            "is too short for the whole dragon, which takes {least} of it from handle 0 to handle {last} "
            "(more along bends)"
        )
        values = quantities("m", 9, got=path.end - path.begin, least=straight)
        raise InvalidValue("path", rule, last=dragon.benches, **values)
    return min(bisect(has_room, low, high, width=ROOM_WIDTH, relative=ROOM_WIDTH)[1], path.end)

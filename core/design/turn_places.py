"""Places from which a search for the shortest turn begins: locally shortest turns by the closed forms alone.

They only give turns to dance; nothing is proven by them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from core.design.turn_boxes import JUST, can_be_drawn, sizes_of
from core.paths.turn import RATIO_MAX, RATIO_MIN
from core.values import Floats

# Steps of the grid: of the entry and exit radius, as a part of the circle's [1], and of the log ratio [1].
GRID, RATIO_GRID = 0.01, 0.05
# Most places that are tried.
PLACES = 60
# Radius by which arcs are wider than the least one, for rounding [m].
WIDER = 1e-12
# Distance from a bound that counts as on it [m], above what the minimiser leaves.
SNAP = 1e-5
# Distance of the neighbours with which a place is compared [m], of ratios [1]; length by which a shorter one is shorter
# for certain [m]; most searches, each from the shortest neighbour of the one before: where the minimiser gives up, the
# correction may lead to a place from which there are shorter ones.
APART, SHORTER, SEARCHES = 1e-3, 1e-9, 4
# Rounds of the correction that puts a place on the border of what benches can follow.
CORRECTIONS = 8


def starts(growth: float, inner: float, radius: float, ratio: float | None, least: float) -> Iterator[Floats]:
    """Places (a [m], v [rad], log ratio) on a grid that are shorter than their neighbours, the shortest first.

    inner, radius: least and greatest radius of entry and exit [m]; least: radius of a bend [m]
    """
    if inner >= radius:
        return
    count = math.ceil((radius - inner) / (GRID * radius)) + 1
    radii = np.linspace(inner, radius, count)
    logs = np.log([ratio]) if ratio is not None else np.arange(math.log(RATIO_MIN), math.log(RATIO_MAX), RATIO_GRID)
    a, b, logarithm = np.meshgrid(radii, radii, logs, indexing="ij")
    v = (b - a) / growth
    sizes = sizes_of(growth, a.ravel(), v.ravel(), logarithm.ravel())
    fits = (np.minimum(sizes[0], sizes[1]) >= least) & can_be_drawn(sizes)
    length = np.where(fits, sizes[4], np.inf).reshape(a.shape)
    padded = np.pad(length, 1, constant_values=np.inf)
    lowest = np.isfinite(length)
    for k in range(3):
        for side in (slice(None, -2), slice(2, None)):
            window = [slice(1, -1)] * 3
            window[k] = side
            lowest &= length <= padded[tuple(window)]
    chosen = np.flatnonzero(lowest)
    order = chosen[np.argsort(length.ravel()[chosen], kind="stable")]
    for k in order[:PLACES]:
        yield np.array([a.ravel()[k], v.ravel()[k], logarithm.ravel()[k]])


def locally_shortest(
    growth: float, start: Floats, inner: float, radius: float, ratio: float | None, least: float
) -> Floats | None:
    """The locally shortest turn near a place, with arcs that benches can follow; None if the search failed."""
    from scipy.optimize import minimize  # type: ignore[import-untyped]

    free = 3 if ratio is None else 2

    def place(x: Floats) -> Floats:
        """(a, b, log ratio) as (a, v, log ratio)."""
        return np.array([x[0], (x[1] - x[0]) / growth, x[2] if free == 3 else start[2]])

    def sizes(x: Floats) -> Floats:
        return sizes_of(growth, *place(x)[:, None])[:, 0]

    bounds = [(inner, radius), (inner, radius), (math.log(RATIO_MIN), math.log(RATIO_MAX))][:free]
    begin = np.array([start[0], start[0] + growth * start[1], start[2]])[:free]
    room = {"type": "ineq", "fun": lambda x: sizes(x)[:2] - least}
    low, high = np.array(bounds).T
    steps = APART * (np.indices((3,) * free).reshape(free, -1).T - 1.0)
    with np.errstate(all="ignore"):
        for _ in range(SEARCHES):
            point = minimize(
                lambda x: sizes(x)[4], begin, bounds=bounds, constraints=[room], method="SLSQP",
                options={"ftol": 1e-13, "maxiter": 200},
            ).x  # fmt: skip
            point = np.clip(point, low, high)
            point = np.where(point - low < SNAP, low, np.where(high - point < SNAP, high, point))
            inside = (point > low) & (point < high)
            for _ in range(CORRECTIONS):
                for k in range(2):
                    missing = least + WIDER - sizes(point)[k]
                    if missing > 0.0 or -JUST < missing < -2.0 * WIDER:
                        point = _corrected(lambda x: sizes(x)[:2], k, point, inside, missing)
            point = np.clip(point, low, high)
            if not np.isfinite(point).all() or (sizes(point)[:2] < least).any():
                return None
            around = [x for x in np.clip(point + steps, low, high) if (sizes(x)[:2] >= least).all()]
            begin = min(around, key=lambda x: float(sizes(x)[4]), default=point)
            if not sizes(begin)[4] < sizes(point)[4] - SHORTER:
                return place(point)
    return None


def _corrected(
    radii: Callable[[Floats], Floats], k: int, at: Floats, inside: NDArray[np.bool_], missing: float
) -> Floats:
    """The place moved along the steepest direction inside its bounds, until radius k has grown by what is missing."""
    step = 1e-6
    steps = step * np.eye(len(at))
    slope = np.array([(radii(at + one)[k] - radii(at - one)[k]) / (2.0 * step) for one in steps])
    slope = np.where(inside, slope, 0.0)
    steepest = float(slope @ slope)
    return at if steepest == 0.0 else at + slope * (missing / steepest)

"""Boxes of turns in a branch and bound: lower bounds of the lengths in them, and their division."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core.checks import SIZE_MIN
from core.design.spans import Span, mean_value
from core.design.turn_boxes import JUST, ROUNDING, Turns, sizes_of
from core.design.turn_moves import coil_bend
from core.kernels.constants import PROOF_COLUMNS
from core.paths.turn import RATIO_MAX, RATIO_MIN
from core.sampling import bisect
from core.values import Floats

# Least radius at which a turn is tried to begin or end [m]: the least that it may have, and more for rounding.
ENTRY_LEAST = 1.001 * SIZE_MIN
# Half widths of the first boxes: of the entry radius, as a part of the circle's [1], of v [rad], of the log ratio [1].
FIRST = (0.025, 0.2, 0.1)
# Larger slopes of a length count as this [m] for [m], [rad] or [1].
STEEPEST = 40.0
# Slopes by which a box is divided at least, however little its length depends on a direction: the moves of benches.
MOVES = np.array([4.0, 5.0, 2.0])


class Boxes(NamedTuple):
    """Boxes of (entry radius a [m], v [rad], log ratio): middles and half widths, (3, N); waits: divisions until an
    overlap is looked for again; lows: lower bounds of the lengths of their turns [m], (N,); proofs: what refused larger
    boxes, (N, PROOF_COLUMNS) of core/kernels/constants.py."""

    centres: Floats
    halves: Floats
    waits: NDArray[np.int64]
    lows: Floats
    proofs: Floats

    def taken(self, which: slice | NDArray[np.intp]) -> Boxes:
        """Some of the boxes."""
        centres, halves = self.centres[:, which], self.halves[:, which]
        return Boxes(centres, halves, self.waits[which], self.lows[which], self.proofs[which])


def joined(parts: list[Boxes]) -> Boxes:
    """All boxes of the parts."""
    centres, halves = (np.hstack([getattr(part, name) for part in parts]) for name in ("centres", "halves"))
    waits, lows, proofs = (np.concatenate([getattr(p, name) for p in parts]) for name in ("waits", "lows", "proofs"))
    return Boxes(centres, halves, waits, lows, proofs)


def least_entry(growth: float, radius: float, least: float) -> float:
    """Least radius at which a coil bends no tighter than `least`, from ENTRY_LEAST to that of the circle [m]."""

    def fits(inner: float) -> bool:
        return coil_bend(growth, inner) * least <= 1.0

    if not fits(radius):
        return radius
    low = min(max(1e-3 * radius, ENTRY_LEAST), radius)
    return low if fits(low) else bisect(fits, low, radius, width=1e-9)[0]


def first_boxes(growth: float, inner: float, radius: float, ratio: float | None) -> Boxes:
    """Boxes that cover all turns between two radii of entry and exit [m]."""
    logs = np.log([RATIO_MIN, RATIO_MAX]) if ratio is None else np.log([ratio, ratio])
    sweep = (radius - inner) / growth
    ends = np.array([[inner, radius], [-sweep, sweep], logs])
    sizes = np.array(FIRST) * [radius, 1.0, 1.0]
    counts = [max(1, math.ceil((high - low) / (2.0 * size))) for (low, high), size in zip(ends, sizes, strict=True)]
    half = np.diff(ends)[:, 0] / (2.0 * np.array(counts))
    axes = [low + step * (2.0 * np.arange(n) + 1.0) for (low, _), step, n in zip(ends, half, counts, strict=True)]
    centres = np.array(np.meshgrid(*axes, indexing="ij")).reshape(3, -1)
    count = centres.shape[1]
    waits, proofs = np.zeros(count, dtype=np.int64), np.zeros((count, PROOF_COLUMNS))
    return Boxes(centres, np.repeat(half[:, None], count, axis=1), waits, np.zeros(count), proofs)


def one_of_mirrored(boxes: Boxes, ratio: float | None) -> Boxes:
    """The boxes without those whose turns are all danced backwards in the others.

    Backwards, the turn (a, v, log ratio) is (b, -v, -log ratio), as long, in the same circle and with the same arcs.
    """
    across = 2 if ratio is None else 1
    kept = np.flatnonzero(boxes.centres[across] + boxes.halves[across] >= -ROUNDING)
    return boxes.taken(kept) if ratio in (None, 1.0) else boxes


def lower_lengths(turns: Turns, least: float = 0.0) -> Floats:
    """Lower bounds of the length of all turns of each box whose arcs have radii of `least` or more [m], (N,).

    An angle that is followed above 2 pi is 2 pi smaller in truth, so at least 0 then.
    """
    arcs = []
    for radius, angle, arc in zip(turns.radii, turns.angles, turns.arcs, strict=True):
        swept = np.nan_to_num(
            np.maximum(radius.low, least) * np.maximum(angle.low, 0.0), nan=0.0, posinf=0.0, neginf=0.0
        )
        alone = np.where(angle.high < 2.0 * math.pi, np.fmax(arc.low, swept), 0.0)
        arcs.append(np.fmax(alone, 0.0))
    single = (turns.angles[0].high < 2.0 * math.pi) & (turns.angles[1].high < 2.0 * math.pi)
    both = np.where(single & np.isfinite(turns.length.low), turns.length.low, 0.0)
    return np.asarray(np.fmax(arcs[0] + arcs[1], both))


def divided(boxes: Boxes, slope: Floats) -> Boxes:
    """Boxes divided in two across the direction in which their turns differ most. slope: |dL / dp|, (3, N)"""
    known = np.where(np.isfinite(slope), np.minimum(slope, STEEPEST), STEEPEST)
    return halved(boxes, np.maximum(known, MOVES[:, None]))


def halved(boxes: Boxes, moves: Floats) -> Boxes:
    """Boxes divided in two across the direction in which they are largest. moves: by each parameter, (3, N)"""
    along = (moves * boxes.halves).argmax(axis=0)
    index, halves, step = np.arange(along.size), boxes.halves.copy(), np.zeros_like(boxes.centres)
    halves[along, index] *= 0.5
    step[along, index] = halves[along, index]
    twice = np.tile(index, 2)
    centres = np.hstack([boxes.centres - step, boxes.centres + step])
    return Boxes(centres, halves[:, twice], boxes.waits[twice], boxes.lows[twice], boxes.proofs[twice])


# Let the multipliers k1, k2, ka, kb be 0 or more. A turn that can be danced has r1, r2 >= least and a, b <= R, so
#     L >= L - k1 (r1 - least) - k2 (r2 - least) - ka (R - a) - kb (R - b).
# With those of the shortest turn by closed forms (Karush, Kuhn and Tucker), the right side has no slope there, so its
# mean value form on a box is good to the second order of the box. Any other multipliers give a true bound too.
@dataclass(frozen=True)
class Multipliers:
    """least: least radius of a bend [m]; most: radius of the circle [m]; weights: k1, k2, ka, kb, none negative [1]."""

    growth: float
    least: float
    most: float
    weights: Floats

    @np.errstate(over="ignore", invalid="ignore")
    def lower(self, turns: Turns, centres: Floats, halves: Floats) -> Floats:
        """Lower bounds of the lengths of the turns of each box that benches can follow inside the circle [m], (N,)."""
        k1, k2, ka, kb = self.weights
        at = turns.middle[4] - k1 * (turns.middle[0] - self.least) - k2 * (turns.middle[1] - self.least)
        at = at - ka * (self.most - centres[0]) - kb * (self.most - turns.middle[5])
        slopes = [by_l - by_1.scaled(k1) - by_2.scaled(k2) for by_1, by_2, by_l in zip(*turns.slopes[:3], strict=True)]
        for k, more in ((0, ka + kb), (1, kb * self.growth)):
            slopes[k] = Span(slopes[k].low + more, slopes[k].high + more)
        low = mean_value(at, tuple(slopes), halves).low - ROUNDING * (1.0 + self.weights.sum())
        short = (turns.angles[0].high < 2.0 * math.pi) & (turns.angles[1].high < 2.0 * math.pi)
        return np.where(short & np.isfinite(low), low, -np.inf)


def multipliers_at(growth: float, point: Floats, least: float, most: float, free: bool) -> Multipliers:
    """The multipliers of the turn at a point (a [m], v [rad], log ratio) of the constraints that just hold there.

    free: whether the ratio is free
    """
    from scipy.optimize import nnls  # type: ignore[import-untyped]

    step, size = 1e-6, 3 if free else 2
    columns = point[:, None] + step * np.concatenate([np.eye(3)[:size], -np.eye(3)[:size]]).T
    sizes = sizes_of(growth, *columns)
    slopes = (sizes[:, :size] - sizes[:, size:]) / (2.0 * step)
    at = sizes_of(growth, *point[:, None])[:, 0]
    entry = np.eye(3)[0, :size]
    rooms = (at[0] - least, at[1] - least, most - point[0], most - at[5])
    sides = np.array([slopes[0], slopes[1], -entry, -slopes[5]])
    tight = [k for k, room in enumerate(rooms) if room < JUST]
    weights = np.zeros(4)
    if tight:
        weights[tight] = nnls(sides[tight].T, slopes[4])[0]
    return Multipliers(growth, least, most, weights)

"""Safe stray where the sizes of the benches and the pitch of the spiral are known only to within an error.

Errors of chords add up along the chain: after one turn of the spiral it is unknown which bench stands beside which. So
the bound must hold for every phase of a turn against the next one. The ring bound does (core/kernels/rings.py): it
depends on the longest and the shortest chord, not on where chords begin, and it holds for a range of growths. Applied
to the ground that benches may cover (core/shapes/reach.py), with chords l within their error, it shows whether two
benches that share no handle stay apart while the head is outside the circle. Bisection finds the largest stray for
which it shows this.

The ground of a bench whose chord is not known. In the frame of its nominal place, with the hole nearest to a point p at
0, let the bench turn by phi. Then p moves by d + (exp(i phi) - 1) p, d the stray of that hole, and the other hole may
stray too if |d - l (exp(i phi) - 1)| <= stray. If this holds for l, it holds for any shorter chord: d lies in the discs
around 0 and around l (exp(i phi) - 1), and so in the disc around each point between. Hence beyond a hole the ground of
the shortest chord holds the ground of any other. Between the holes a point of the centre line goes aside by no more
than the stray, because it lies between two points that do not, and a side goes half of the width further.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from core import kernels
from core.checks import checked_number, checked_size
from core.contact.search import ContactSearch, SearchInput
from core.dragon import Dragon
from core.kernels import Budget
from core.paths.spiral import Spiral
from core.questions import question_about
from core.sampling import bisect
from core.shapes.reach import SUPPORT_ROUNDING, Reach, reach, ring_bounds

# Width to which the largest stray is bisected, relative to half a chord [1].
WIDTH = 1e-6


@question_about("dragon", Dragon, "the stray that is safe in spite of errors was not found")
def uncertain_tolerance(
    dragon: Dragon,
    pitch: float,
    *,
    length_error: float = 0.0,
    pitch_error: float = 0.0,
    turning_radius: float = 4.5,
    budget: Budget | None = None,
) -> float:
    """Safe stray until the head is on the turning circle, whatever the errors of sizes are [m].

    length_error: largest error of the chord of every bench, whose overhangs and width are as given [m]; pitch_error:
        largest error of the pitch of the whole spiral [m]; turning_radius: [m]
    returns: a stray proven safe, smaller than that of tolerance() for sizes without errors; 0 if the bound proves none
    raises: InvalidValue; TooMuchWork

    >>> round(uncertain_tolerance(Dragon(), 0.7, length_error=0.01, pitch_error=0.005), 4)
    0.094
    """
    radius, spiral, budget = checked_size("turning_radius", turning_radius), Spiral(pitch), budget or Budget()
    shortest = float(dragon.chords.min())
    error = checked_number("length_error", length_error, "m", 0.0, 0.5 * shortest)
    spread = checked_number("pitch_error", pitch_error, "m", 0.0, 0.5 * spiral.pitch)
    low, high = ((spiral.pitch + off) / (2.0 * np.pi) for off in (-spread, spread))
    longer, shorter = (Dragon.of(dragon.lengths + off, dragon.widths, dragon.overhangs) for off in (error, -error))

    def touches(stray: float) -> bool:
        budget.afford(float(kernels.DIRECTIONS * min(dragon.uniform_from + 1, dragon.benches)))
        rings = ContactSearch(
            SearchInput(longer, spiral, 0.0, stray=stray, covered=partial(_longer_reach, shorter))
        ).rings
        rings.between_shortest -= 2.0 * error
        return not kernels.ring_clears(low, high, radius, 0.0, rings)

    most = 0.5 * float(shorter.chords.min())
    if not touches(most):
        return most
    return bisect(touches, 0.0, most, width=WIDTH * most)[0]


def _longer_reach(shorter: Dragon, longer: Dragon, stray: float) -> Reach:
    """Ground of benches with unknown chords, between those of two dragons [m]."""
    ground = reach(shorter, stray)
    alike = len(ground.kinds)
    hulls = ground.hulls.copy()
    further = np.empty(len(hulls))
    further[ground.kinds] = 0.5 * (longer.chords - ground.bounds.chords)[:alike]
    hulls[:, 0, :, 0] += further[:, None]
    hulls[:, 2, :, 0] -= further[:, None]
    sides = 0.5 * longer.widths + stray * (1.0 + SUPPORT_ROUNDING)
    bounds = longer.outlined(ground.bounds.overhangs, np.maximum(ground.bounds.widths, 2.0 * sides))
    corners, middle, within = ring_bounds(longer.chords[:alike], hulls, ground.kinds)
    middle = max(middle, float(sides.max()))
    return replace(ground, bounds=bounds, hulls=hulls, corners=corners, middle_half_width=middle, within=within)

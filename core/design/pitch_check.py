"""Cross-check of a minimum pitch: four engines judge the dance at a pitch just above it and at one just below."""

from __future__ import annotations

import math

import numpy as np

from core.checks import checked_number, checked_type
from core.contact.cross_check import ContactCheck, judged_contact, judged_grounds, judged_poses
from core.contact.search import MARGIN_MAX
from core.dance import Dance
from core.design.minimum_pitch import MinimumPitch, checked_dragons
from core.design.pitch_search import LimitedBy
from core.dragon import Dragon, Stray, checked_stray
from core.errors import InvalidValue
from core.kernels import Budget
from core.paths.spiral import Spiral
from core.questions import question_about
from core.shapes.reach import reach

# Distance of the judged pitches from the minimum [m]; see CHECK_TRAVEL of core/contact/cross_check.py.
CHECK_PITCH = 1e-6


@question_about("minimum", MinimumPitch, "the engines' verdict on the minimum pitch was not found")
def pitch_check(
    minimum: MinimumPitch,
    dragon: Dragon,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    dragons: int = 1,
    whole: bool = True,
    budget: Budget | None = None,
) -> ContactCheck | None:
    """The engines' verdicts at a pitch CHECK_PITCH larger and one CHECK_PITCH smaller than the minimum.

    The head is where the pair meets just below that pitch, or at the start if the start limits the pitch.
    whole: True judges the whole dragon, False only the reported pair; with a stray shapely always judges the ground
        that benches may cover. A pair of two dragons is judged among all pairs of two; in the answer bench b of dragon
        k has the number k * benches + b
    dragon, margin, stray, dragons: those of the search
    returns: None if no pair limits the pitch
    raises: InvalidValue; TooMuchWork

    >>> from core import minimum_pitch
    >>> dragon = Dragon()
    >>> pitch_check(minimum_pitch(dragon), dragon).agree
    True
    """
    checked_type("dragon", dragon, Dragon)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    strayed, count = checked_stray(stray, dragon), checked_dragons(dragons, dragon)
    if minimum.benches is None or minimum.head_radius is None:
        return None
    if minimum.benches[1] >= dragon.benches:
        rule, got = "must be that of the search, with bench {bench}", f"one of {dragon.benches} benches"
        raise InvalidValue("dragon", rule, got=got, bench=minimum.benches[1])
    count, pair = count if minimum.dragons else 1, minimum.benches
    if minimum.dragons:
        if minimum.dragons[1] >= count:
            rule = "must be that of the search, with dragon {k}"
            raise InvalidValue("dragons", rule, got=count, k=minimum.dragons[1])
        pair = pair[0], minimum.dragons[1] * dragon.benches + pair[1]
    owners = np.repeat(np.arange(count), dragon.benches) if minimum.dragons else None
    front = dragon if whole or strayed or minimum.dragons else dragon.leading(minimum.benches[1] + 1)
    rows = []
    for pitch in (minimum.pitch + CHECK_PITCH, minimum.pitch - CHECK_PITCH):
        # On a spiral that starts at this radius, the head is there at time 0.
        turns = minimum.head_radius / (minimum.pitch if minimum.limited_by is LimitedBy.START else pitch)
        turned = [Dance(front, Spiral(pitch, turns, rotation=math.tau * (k / count))) for k in range(count)]
        rows.append(np.concatenate([judged_poses(dance, [0.0], budget)[0] for dance in turned]))
    poses = np.array(rows)
    if strayed:
        ground = reach(dragon, strayed)
        return judged_grounds(poses, ground, pair, margin=margin, owners=owners, budget=budget)
    size = np.tile(np.stack([dragon.lengths, dragon.widths], axis=-1), (count, 1))[: len(poses[0])]
    return judged_contact(poses, size, pair, margin=margin, whole=whole, owners=owners, budget=budget)

"""Answers of minimum_pitch() for random dragons against a dense scan that shares no code with it.

`make sweep-pitch` runs it over 2,000 dragons, `test_sweep_pitch.py` over a few. Dragons are uniform or given bench by
bench, also such as overlap on a straight line; starts from 0.2 to 20 turns, circles from a part of a bench to many.
"""

from functools import partial

import numpy as np

from core import Dragon, InvalidValue, LimitedBy, minimum_pitch
from tests.campaigns import hunting
from tests.support.slow_pitch import SlowWay

# A pitch this much above the answer must be feasible, one this much below the infeasible end must not be [1], and at
# least the second number [m]: pitches are promised to 1e-9 m.
BESIDE = 1e-8
BESIDE_LEAST = 2e-9
# Rounding of a slow clearance on a way of metres [m], and of one on a wide spiral, per metre of its pitch [1].
ROUNDING = 1e-11
ROUNDING_PER_PITCH = 1e-13
# Nearest and furthest sample above the answer, as multiples of it less one [1]; the largest pitch sampled [m].
NEAREST = 1e-5
FURTHEST = 1e2
PITCH_MAX = 1e4
# A dragon that is refused touches, or folds, at every pitch looked at from here to the largest [m].
WIDE = 9e3


def random_case(seed):
    """dragon, turning radius [m], start turns, margin [m]"""
    rng = np.random.default_rng(seed)
    benches = int(rng.choice([1, 2, 3, 4, 5, 8, 12, 20, 40], p=[0.03, 0.04, 0.08, 0.1, 0.15, 0.25, 0.22, 0.1, 0.03]))
    chord = 10.0 ** rng.uniform(-0.3, 0.5)
    width = chord * 10.0 ** rng.uniform(-1.2, -0.1)
    if rng.uniform() < 0.4:
        chords = chord * 10.0 ** rng.uniform(-0.25, 0.25, benches)
        overhangs = chord * rng.uniform(0.0, 0.35, benches)
        widths = width * 10.0 ** rng.uniform(-0.2, 0.2, benches)
        dragon = Dragon.of(chords + 2.0 * overhangs, widths, overhangs)
    else:
        overhang = chord * rng.choice([0.0, 0.1, 0.2, 0.35, 0.49, 0.55], p=[0.1, 0.3, 0.25, 0.2, 0.1, 0.05])
        head = chord * 10.0 ** rng.uniform(-0.2, 0.3)
        dragon = Dragon(benches, head + 2.0 * overhang, chord + 2.0 * overhang, width, overhang)
    radius = float(dragon.chords.max()) * 10.0 ** rng.uniform(-0.7, 0.9)
    turns = 10.0 ** rng.uniform(np.log10(0.2), np.log10(2.0)) if rng.uniform() < 0.3 else rng.uniform(2.0, 20.0)
    margin = float(rng.choice([0.0, 0.05, 0.2]) * chord)
    return dragon, radius, turns, margin


def fault(seed):
    """The answer for one random dragon, and its fault in words ('' for none)."""
    return judged(*random_case(seed), np.random.default_rng(seed))


def judged(dragon, radius, turns, margin, rng):
    """The same for this dragon."""

    def least(pitch):
        return SlowWay.of(dragon, pitch, turns, radius).least() - margin

    def rounding(pitch):
        return ROUNDING + ROUNDING_PER_PITCH * pitch

    try:
        result = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
    except InvalidValue as refused:
        field = refused.field.split(".")[-2 if refused.field[-1].isdigit() else -1]
        feasible = [pitch for pitch in rng.uniform(WIDE, PITCH_MAX, 3) if least(pitch) > rounding(pitch)]
        return f"refused: {field}", f"refused, but feasible at {feasible}" if feasible else ""
    kind = f"{result.limited_by.value}, {result.justified_by}"
    beside = max(BESIDE * result.pitch, BESIDE_LEAST)
    above = result.pitch * (1.0 + 10.0 ** rng.uniform(np.log10(NEAREST), np.log10(FURTHEST), 5))
    above = above[above <= min(PITCH_MAX, result.proven_up_to or PITCH_MAX)]
    touching = [pitch for pitch in [result.pitch + beside, *above] if least(pitch) <= -rounding(pitch)]
    if touching:
        return kind, f"{result.pitch}: said to be feasible, but not at {touching}"
    infeasible = result.pitch_bracket[0]
    if infeasible == result.pitch:
        within = result.limited_by is LimitedBy.START and (infeasible - beside) * turns < radius
        return kind, "" if within else f"{infeasible}: not limited by the start"
    if least(infeasible - beside) > rounding(infeasible):
        return kind, f"{infeasible}: said to be infeasible, but {infeasible - beside} is feasible"
    wide = result.pitch_bracket[1] - infeasible > max(BESIDE_LEAST, BESIDE * infeasible)
    return kind + (", wide bracket" if wide else ""), ""


if __name__ == "__main__":
    count, first = hunting.arguments(2_000, 0)
    hunting.main(partial(hunting.hunt, lambda seed, case: fault(seed + case)), "dragons", first, 0.0, count)

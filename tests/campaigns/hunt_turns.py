"""Turns with any entry and exit, dances far in on long spirals, and boxes of turns, against a slow search.

`python -m tests.campaigns.hunt_turns SEED SECONDS`. First contacts, least clearances and verdicts are judged as in
hunt_contacts. Spirals have up to 1,000 turns, and the dance begins where the head has a few left. Of a box of turns
that share an overlap (core/design/turn_overlap.py), random turns are laid out slowly, and must overlap at some instant.
"""

import math
from functools import partial

import numpy as np

from core import Dance, Dragon, Spiral, Turn
from core.design.turn_boxes import turns_in
from core.design.turn_moves import box_of, least_bend
from core.design.turn_overlap import OverlapSearch
from tests.campaigns import hunting
from tests.campaigns.hunt_contacts import GAP, SlowLook, judged, random_dragon, random_margin
from tests.support.boxes_of_turns import turn_at
from tests.support.slow_route import SlowRoute
from tests.support.slow_search import STEP, SlowDance, arc_length

# Error of a slow place for each metre of a path, some roundings of a double [1].
OF_PATH = 3e-15
# The last part of a way to a fold is left out, in shortest chords [1]. There a handle moves ten times as far as the
# head, and so it does by an error of the time, which is some 1e6 s.
BEFORE_FOLD = 0.01
# Turns of a box that are laid out.
LAID_OUT = 2


def random_turn(rng, dragon):
    """A turn that may begin and end anywhere inside its circle."""
    chord, width = float(dragon.chords.max()), float(dragon.widths.max())
    pitch, radius = (
        float(rng.uniform(0.8, 2.0) * width + rng.uniform(0.0, 0.6) * chord),
        float(rng.uniform(1.1, 3.0) * chord),
    )
    ends = radius * np.maximum(rng.uniform(0.5, 1.15, 2), 0.0).clip(max=1.0)
    return Turn(
        pitch, radius, float(np.exp(rng.uniform(-0.5, 0.5))), start_turns=float(radius / pitch + rng.uniform(1.0, 5.0)),
        entry_radius=float(ends[0]), exit_radius=float(ends[1]),
    )  # fmt: skip


def turn_case(rng):
    """dance, margin, start, stop, the slow look at it, its accuracy; raises: InvalidValue for what core refuses"""
    dragon = random_dragon(rng)
    dance = Dance(dragon, random_turn(rng, dragon))
    slow = SlowRoute.of(dragon, dance.path)
    look = SlowLook(slow, dance.begin, slow.end())
    stop = look.until if look.until < slow.end() - 1.0 else None
    return dance, random_margin(rng, dragon.widths.max(), look.least()[0]), dance.begin, stop, look, GAP


def spiral_case(rng):
    """The same for the last turns of a long spiral."""
    dragon = random_dragon(rng)
    pitch, turns = float(rng.uniform(0.3, 2.0)), float(10.0 ** rng.uniform(1.0, 3.0))
    spiral = Spiral(pitch, turns)
    dance, slow = Dance(dragon, spiral), SlowDance.of(dragon, spiral)
    left = pitch / (2.0 * math.pi) * float(arc_length(2.0 * math.pi * rng.uniform(1.0, 7.0)))
    fold = min(slow.end(), dance.end.time)
    start = float(max(fold - left, 0.0))
    look = SlowLook(slow, start, float(max(fold - BEFORE_FOLD * slow.chords.min(), start)))
    accuracy = GAP + OF_PATH * slow.way
    return dance, random_margin(rng, dragon.widths.max(), look.least()[0]), start, look.until, look, accuracy


def box_fault(rng):
    """Kind and fault of a random box of turns."""
    dragon = Dragon(int(rng.integers(20, 40)), float(rng.uniform(2.0, 3.5)), 2.2, float(rng.uniform(0.1, 0.6)), 0.275)
    pitch, circle, least = float(rng.uniform(1.0, 2.2)), 4.5, least_bend(dragon)
    growth = pitch / (2.0 * math.pi)
    entry, leaving = rng.uniform(least, circle, 2)
    centre = np.array([entry, (leaving - entry) / growth, rng.uniform(-0.4, 0.4)])
    half = 10.0 ** rng.uniform(-3.0, -1.3, 3)
    box = box_of(pitch, turns_in(growth, centre[:, None], half[:, None]), 0, centre, half, least)
    if box is None or not OverlapSearch(dragon, 0.0, 26).exhibited(box).shared:
        return "without a shared overlap", ""
    for off in rng.choice([-1.0, 1.0], (LAID_OUT, 3)) * rng.uniform(0.0, 1.0, (LAID_OUT, 3)):
        turn = turn_at(centre + half * off, pitch, least)
        if turn is None:
            continue
        slow = SlowRoute.of(dragon, turn)
        times = np.arange(0.0, turn.length + 40.0, STEP * slow.chords.min())
        gap = float(slow.clearance(times)[0].min())
        if gap > 0.0:
            return "with a shared overlap", f"the gap is {gap} in {turn!r} of {dragon!r}, box {centre} +- {half}"
    return "with a shared overlap", ""


def fault(seed, case):
    """The kind of one random answer, and its fault in words ('' for none)."""
    rng, kinds = hunting.generator(seed, case), ("turn", "long spiral", "box")
    answers = (lambda: judged(*turn_case(rng)), lambda: judged(*spiral_case(rng)), lambda: box_fault(rng))
    outcome, wrong = hunting.unless_refused(answers[case % 3])
    return f"{kinds[case % 3]}: {outcome}", wrong


hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "turns, long spirals and boxes")

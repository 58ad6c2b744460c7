"""Turns with any entry and exit, and dances far in on long spirals, against a slow search.

`python -m tests.campaigns.hunt_turns SEED SECONDS`. First contacts, least clearances and verdicts are judged as in
hunt_contacts. Spirals have up to 1,000 turns, and the dance begins where the head has a few left.
"""

import math
from functools import partial

import numpy as np

from core import Dance, Spiral, Turn
from tests.campaigns import hunting
from tests.campaigns.hunt_contacts import GAP, SlowLook, judged, random_case, random_dragon, random_margin
from tests.support.slow_search import SlowDance, arc_length

# Error of a slow place for each metre of a path, some roundings of a double [1].
OF_PATH = 3e-15
# The last part of a way to a fold is left out, in shortest chords [1]. There a handle moves ten times as far as the
# head, and so it does by an error of the time, which is some 1e6 s.
BEFORE_FOLD = 0.01


def random_turn(rng, dragon):
    """A turn that may begin and end anywhere inside its circle."""
    chord = float(dragon.chords.max())
    width = float(dragon.widths.max())
    pitch = rng.uniform(0.8, 2.0) * width + rng.uniform(0.0, 0.6) * chord
    radius = rng.uniform(1.1, 3.0) * chord
    ends = radius * np.maximum(rng.uniform(0.5, 1.15, 2), 0.0).clip(max=1.0)
    return Turn(
        pitch, radius, float(np.exp(rng.uniform(-0.5, 0.5))), start_turns=radius / pitch + rng.uniform(1.0, 5.0),
        entry_radius=float(ends[0]), exit_radius=float(ends[1]),
    )  # fmt: skip


def spiral_case(seed, case):
    """dance, margin, start, stop, the slow look at the last turns of a long spiral, and its accuracy"""
    rng = hunting.generator(seed, case)
    dragon = random_dragon(rng)
    pitch = rng.uniform(0.3, 2.0)
    turns = 10.0 ** rng.uniform(1.0, 3.0)
    spiral = Spiral(pitch, turns)
    dance = Dance(dragon, spiral)
    slow = SlowDance.of(dragon, spiral)
    left = pitch / (2.0 * math.pi) * float(arc_length(2.0 * math.pi * rng.uniform(1.0, 7.0)))
    fold = min(slow.end(), dance.end.time)
    start = float(max(fold - left, 0.0))
    look = SlowLook(slow, start, float(max(fold - BEFORE_FOLD * slow.chords.min(), start)))
    return dance, random_margin(rng, look, dragon), start, look.until, look, GAP + OF_PATH * slow.way


def fault(seed, case):
    """The kind of one random answer, and its fault in words ('' for none)."""
    kind, make = [("turn", partial(random_case, any_path=random_turn)), ("long spiral", spiral_case)][case % 2]
    outcome, wrong = hunting.unless_refused(judged, make, seed, case)
    return f"{kind}: {outcome}", wrong


hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "turns and long spirals")

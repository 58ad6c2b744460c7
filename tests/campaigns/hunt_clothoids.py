"""The campaign of hunt_contacts.py on routes with clothoids: `python -m tests.campaigns.hunt_clothoids SEED SECONDS`.

The routes bend back towards themselves, once or to both sides, with ramps of any length before and after an arc, or
with none there, where the curvature jumps.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from core import Clothoid, Line, Route
from tests.campaigns import hunt_contacts, hunting


def blended_route(rng, dragon):
    """A line, bends of clothoids and arcs, and a line, each as long as the dragon."""
    chord = float(dragon.chords.max())
    way = float(sum(dragon.chords) + rng.uniform(1.0, 6.0) * chord)
    pieces, place, heading = [Line((-way, 0.0), (0.0, 0.0))], (0.0, 0.0), 0.0
    side = float(rng.choice([-1.0, 1.0]))
    for _ in range(int(rng.choice([1, 1, 2]))):
        bend, sweep = side / float(rng.uniform(0.55, 1.5) * chord), float(rng.uniform(1.5, 3.4))
        ramps = rng.uniform(0.0, 0.9, 2) * (rng.uniform(size=2) < 0.8)  # parts of the sweep, half of which is left
        turned = [(0.0, bend, 0.5 * ramps[0] * sweep), (bend, bend, (1.0 - 0.5 * ramps.sum()) * sweep)]
        turned.append((bend, 0.0, 0.5 * ramps[1] * sweep))
        for first, last, angle in turned:
            length = 2.0 * angle / abs(first + last)
            if length > 1e-2:
                pieces.append(Clothoid(place, heading, first, last, length))
                place, heading = pieces[-1].end, pieces[-1].end_heading
        side = -side
    x, y = place
    pieces.append(Line(place, (x + way * float(np.cos(heading)), y + way * float(np.sin(heading)))))
    return Route(pieces, start=way)


def fault(seed, case):
    """The kind of one random answer, and its fault in words ('' for none)."""
    return hunt_contacts.fault(seed, case, blended_route)


hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "dances on clothoids")

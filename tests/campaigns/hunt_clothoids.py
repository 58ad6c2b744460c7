"""The campaign of hunt_contacts.py on routes with clothoids: `python -m tests.campaigns.hunt_clothoids SEED SECONDS`.

The routes bend back towards themselves, once or to both sides, with ramps of any length before and after an arc, or
with none there, where the curvature jumps.
"""

from functools import partial

from core import Route
from tests.campaigns import hunt_contacts, hunting
from tests.support.random_routes import Pen


def blended_route(rng, dragon):
    """A line, bends of clothoids and arcs, and a line, each as long as the dragon."""
    chord = float(dragon.chords.max())
    way = float(sum(dragon.chords) + rng.uniform(1.0, 6.0) * chord)
    pen = Pen(complex(-way))
    side = float(rng.choice([-1.0, 1.0]))
    pen.line(way)
    for _ in range(int(rng.choice([1, 1, 2]))):
        bend = side / (rng.uniform(0.55, 1.5) * chord)
        sweep = rng.uniform(1.5, 3.4)
        ramps = rng.uniform(0.0, 0.9, 2) * (rng.uniform(size=2) < 0.8)  # parts of the sweep, half of which is left
        turned = [(0.0, bend, 0.5 * ramps[0] * sweep), (bend, bend, (1.0 - 0.5 * ramps.sum()) * sweep)]
        for first, last, angle in [*turned, (bend, 0.0, 0.5 * ramps[1] * sweep)]:
            if (length := 2.0 * angle / abs(first + last)) > 1e-2:
                pen.clothoid(first, last, length)
        side = -side
    pen.line(way)
    return Route(pen.pieces, start=way)


def fault(seed, case):
    """The kind of one random answer, and its fault in words ('' for none)."""
    return hunt_contacts.fault(seed, case, blended_route)


hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "dances on clothoids")

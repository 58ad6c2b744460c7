"""Paths, squares and performances that several tests share."""

import math

from core import Arc, Dance, Dragon, Line, Part, Performance, Route, Spiral, Venue
from tests.support.random_squares import box

FIVE_LENGTHS = Dragon.of([3.0, 1.5, 2.5, 1.2, 2.0], [0.3] * 5, [0.2] * 5)
UNLIKE = Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 4, [0.3, 0.5] * 10, [0.2] * 20)
# Two streets that cross in their middles [m].
EAST = ((-40.0, 0.0), (40.0, 0.0))
NORTH = ((0.0, -40.0), (0.0, 40.0))


def square(half):
    """A square around the origin."""
    return Venue(box("square", -half, -half, 2.0 * half, 2.0 * half))


def lane(first, last, **options):
    """A straight route."""
    return Route([Line(first, last)], **options)


def there_and_back(length):
    """Out, round half a circle, and back 3.2 m beside the way out; at time 0 the head has come 24 m."""
    bend = Arc((length, 1.6), 1.6, -math.pi / 2, math.pi)
    return Route([Line((0, 0), (length, 0)), bend, Line((length, 3.2), (0, 3.2))], 24.0)


def on_lanes(*lanes, benches=5):
    """Dragons that each walk along a straight line."""
    return Performance([Part(Dance(Dragon(benches), lane(*ends))) for ends in lanes])


def in_one_spiral(benches, pitch=1.1, turns=8.0):
    """Two dragons half a turn apart."""
    return Performance([Part(Dance(Dragon(benches), Spiral(pitch, turns, rotation=turn))) for turn in (0.0, math.pi)])


def side_by_side():
    """Two small dragons on spirals that are 9 m apart and fold at the same time."""
    return Performance([Part(Dance(Dragon(3), Spiral(1.2, 2.0, (x, 0.0)))) for x in (0.0, 9.0)])


STREET = Dance(Dragon(5), lane((0, 0), (60, 0)))
OPPOSITE = in_one_spiral(60)
# The second one is later and faster, so that it goes behind the first.
CROSSING = Performance(
    [Part(Dance(Dragon(5), lane(*ends), 1.0 + 0.1 * k), 15.0 * k) for k, ends in enumerate((EAST, NORTH))]
)

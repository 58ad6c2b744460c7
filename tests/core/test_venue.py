"""The square and its obstacles: edges, and refusals."""

import math
from time import process_time

import numpy as np
import pytest

from core import Area, InvalidValue, Venue
from core.venue import EDGES_MAX
from tests.support.random_squares import closed
from tests.support.refused import refused
from tests.support.shared_dances import square

AT_ONCE = 2.0  # [s] of processor time; judging the validity of that many rings takes more than a minute


def box(x, y, right, top):
    return ((x, y), (right, y), (right, top), (x, top), (x, y))


def boxed(name, x, y, right, top):
    return Area(name, (box(x, y, right, top),))


def circle(edges, x=0.0, y=0.0):
    angles = np.linspace(0, 2 * math.pi, edges, endpoint=False).tolist()
    return closed([(x + math.cos(a), y + math.sin(a)) for a in angles])


SQUARE = box(-35, -5, 20, 20)
STAGE = box(15.0, 0.0, 18.0, 3.0)
WELL = circle(24, 5.0, 4.0)


@pytest.mark.parametrize(
    "field, rings",
    [
        ("venue", ()),
        ("venue.0.1.1", (((0, 0), (1, math.nan), (1, 1), (0, 0)),)),
    ],
    ids=["none", "no number"],
)
def test_invalid_rings_are_refused_where_they_are_wrong(field, rings):
    with refused(field):
        Area("stage", rings)


INVALID = {
    "a hole outside the outer ring at (40, 40) m": (STAGE, box(40, 40, 41, 41)),
    "a hole inside another hole at (3, 3) m": (box(0, 0, 9, 9), box(2, 2, 8, 8), box(3, 3, 4, 4)),
    "an inside cut in two by rings that touch at": (box(0, 0, 9, 9), closed([(0, 4), (4, 0), (9, 4), (4, 9)])),
    "a ring that touches itself at (5, 5) m": (closed([(0, 0), (5, 5), (9, 0), (9, 9), (5, 5), (0, 9)]),),
    "a self-intersection at (5, 5) m": (closed([(0, 0), (10, 10), (10, 0), (0, 10)]),),
}


@pytest.mark.parametrize("words", INVALID)
def test_an_invalid_polygon_is_refused_by_name_in_plain_words_with_the_place(words):
    with pytest.raises(InvalidValue) as caught:
        Area("stage", INVALID[words])
    assert caught.value.message.startswith(f"venue: 'stage' must be a valid polygon, got {words}")


def test_the_edges_of_all_areas_together_are_limited():
    within, beyond = (Area(f"{edges}", (circle(edges),)) for edges in (EDGES_MAX - 4, EDGES_MAX - 3))
    around = square(9).square
    assert len(Venue(around, (within,)).areas) == 2
    with refused("venue", most=EDGES_MAX, got=EDGES_MAX + 1):
        Venue(around, (beyond,))


def test_edges_are_counted_before_validity_is_judged():
    began = process_time()
    with refused("venue", most=EDGES_MAX):
        Area("square", (((0, 0), (1, 0), (1, 1), (0, 0)),) * 140_000)
    assert process_time() - began < AT_ONCE

"""The square and its obstacles: edges, and refusals."""

from __future__ import annotations

import math
from time import process_time
from typing import Any

import numpy as np
import pytest

from core import Area, InvalidValue, Venue
from core.venue import EDGES_MAX, Ring

AT_ONCE = 2.0  # [s] of processor time; judging the validity of that many rings takes more than a minute


def box(x: float, y: float, right: float, top: float) -> Ring:
    return ((x, y), (right, y), (right, top), (x, top), (x, y))


def boxed(name: str, x: float, y: float, right: float, top: float) -> Area:
    return Area(name, (box(x, y, right, top),))


SQUARE = box(-35, -5, 20, 20)
WELL = tuple((5 + math.cos(a), 4 + math.sin(a)) for a in np.linspace(0, 2 * math.pi, 24, endpoint=False).tolist())
WELL = (*WELL, WELL[0])
STAGE = box(15.0, 0.0, 18.0, 3.0)


def test_edges_without_length_are_passed_over() -> None:
    square = Area("square", (((0, 0), (9, 0), (9, 0), (9, 9), (0, 0)),))
    assert square.edges.tolist() == [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 0]]


def test_a_hole_has_its_edges() -> None:
    assert Area("square", (SQUARE, WELL)).edges.shape == (4 + 24, 4)


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ((), "venue: 'stage' must have at least one ring"),
        (((),), "venue: a ring of 'stage' must be closed and have at least 4 points, got 0"),
        ((((0, 0), (1, 0), (1, 1)),), "venue: a ring of 'stage' must be closed and have at least 4 points, got 3"),
        ((((0, 0), (1, 0), (1, 1), (0, 1)),), "venue: a ring of 'stage' must be closed"),
        ((((0, 0), (1, 0, 5), (1, 1), (0, 0)),), "venue[0][1] must be a point [x, y] in metres"),
        ((((0, 0), (1, math.nan), (1, 1), (0, 0)),), "venue[0][1][1] must be a finite number"),
        ((((0, 0), (2e5, 0), (1, 1), (0, 0)),), "venue[0][1][0] must be at most 100000 m"),
        ("rings", "venue must be a list of rings"),
        ((3,), "venue[0] must be a list of rings"),
    ],
    ids=["none", "empty", "three points", "open", "height", "no number", "far", "text", "number"],
)
def test_invalid_rings_are_refused_where_they_are_wrong(rings: Any, words: str) -> None:
    with pytest.raises(InvalidValue) as e:
        Area("stage", rings)
    assert e.value.message.startswith(words)


def test_two_areas_of_one_name_are_refused() -> None:
    with pytest.raises(InvalidValue, match="its own name"):
        Venue(Area("a", (SQUARE,)), (Area("a", (WELL,)),))


def test_a_self_crossing_polygon_is_refused_with_the_place() -> None:
    with pytest.raises(InvalidValue, match=r"'square' must be a valid polygon, got a self-intersection at \(5, 5\) m"):
        Area("square", (((0, 0), (10, 10), (10, 0), (0, 10), (0, 0)),))


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ((STAGE, box(40, 40, 41, 41)), "a hole outside the outer ring at (40, 40) m"),
        ((box(0, 0, 9, 9), box(2, 2, 8, 8), box(3, 3, 4, 4)), "a hole inside another hole at (3, 3) m"),
        ((box(0, 0, 9, 9), ((0, 4), (4, 0), (9, 4), (4, 9), (0, 4))), "an inside cut in two by rings that touch at"),
        ((((0, 0), (5, 5), (9, 0), (9, 9), (5, 5), (0, 9), (0, 0)),), "a ring that touches itself at (5, 5) m"),
        ((((2, 1),) * 4,), "a ring of fewer than three different points at (2, 1) m"),
        ((box(0, 0, 9, 9), box(8, 8, 12, 12)), "a self-intersection at (8, 9) m"),
    ],
    ids=["hole outside", "nested holes", "cut", "touching itself", "too few points", "crossing hole"],
)
def test_an_invalid_polygon_is_refused_by_name_in_plain_words(rings: tuple, words: str) -> None:
    with pytest.raises(InvalidValue) as e:
        Area("stage", rings)
    assert e.value.message.startswith(f"venue: 'stage' must be a valid polygon, got {words}")


def circle(edges: int) -> Ring:
    ring = tuple((math.cos(a), math.sin(a)) for a in np.linspace(0, 2 * math.pi, edges, endpoint=False).tolist())
    return (*ring, ring[0])


def test_the_edges_of_all_areas_together_are_limited() -> None:
    circles = [Area(f"{edges}", (circle(edges),)) for edges in (EDGES_MAX - 4, EDGES_MAX - 3)]
    assert len(Venue(boxed("square", -9, -9, 9, 9), (circles[0],)).areas) == 2
    with pytest.raises(InvalidValue, match=f"at most {EDGES_MAX} edges, got {EDGES_MAX + 1}"):
        Venue(boxed("square", -9, -9, 9, 9), (circles[1],))


def test_edges_are_counted_before_validity_is_judged() -> None:
    began = process_time()
    with pytest.raises(InvalidValue, match=f"at most {EDGES_MAX} edges, got 420000"):
        Area("square", (((0, 0), (1, 0), (1, 1), (0, 0)),) * 140_000)
    assert process_time() - began < AT_ONCE

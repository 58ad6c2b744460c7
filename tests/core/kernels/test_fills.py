"""Rectangles in the bytes of a picture, against the area of each pixel that they cover."""

import numpy as np
import pytest
import shapely

from core.kernels import fill_rectangles
from core.shapes.rectangles import corners

# How far a value may be from the part of a pixel that is covered [of 255]: half a step between two values, and what the
# product of two stretches leaves out at an edge aslant.
NEAR = 0.6
NEAR_ASLANT = 32.0
FACE = 200
EDGE = 20
PAPER = 250


def filled(rectangles, line=0.0, inks=((FACE,), (EDGE,))):
    plane = np.full((30, 40, len(inks[0])), PAPER, np.uint8)
    fill_rectangles(plane, np.array(rectangles, dtype=np.float64), line, np.array(inks, dtype=np.float64))
    return plane


PIXELS = shapely.box(*np.meshgrid(np.arange(40), np.arange(30)), *np.meshgrid(np.arange(1, 41), np.arange(1, 31)))


def covered(x, y, angle, length, width):
    """The part of each pixel of 30 rows and 40 columns inside a rectangle, by shapely."""
    rectangle = shapely.Polygon(corners(np.array([x, y, angle]), 2.0 * np.array([length, width])))
    return shapely.area(shapely.intersection(PIXELS, rectangle))


def by_areas(x, y, angle, length, width, line):
    whole = PAPER + covered(x, y, angle, length + line, width + line) * (EDGE - PAPER)
    if min(length, width) <= line:
        return whole
    return whole + covered(x, y, angle, length - line, width - line) * (FACE - whole)


def row_of(x, y, angle, length, width):
    return [x, y, np.cos(angle), np.sin(angle), length, width]


@pytest.mark.parametrize("seed", range(40))
def test_a_pixel_is_mixed_by_the_part_of_it_that_is_covered(seed):
    rng = np.random.default_rng(seed)
    angle = rng.uniform(-4.0, 4.0) if seed % 3 else 0.5 * np.pi * rng.integers(-2, 3)
    place = rng.uniform(-5, 45), rng.uniform(-5, 35), angle, rng.uniform(2.0, 12.0), rng.uniform(0.2, 4.0)
    line = rng.choice([0.0, 0.3, 0.6, 1.5])
    plane = filled([row_of(*place)], line)[..., 0]
    slow = by_areas(*place, line)
    assert np.abs(plane - slow).max() < (NEAR_ASLANT if seed % 3 else NEAR)
    assert abs(float(np.mean(plane - slow))) < 0.1


def test_a_later_rectangle_covers_an_earlier_one_and_all_channels_alike():
    rows = [row_of(12.0, 15.0, 0.0, 8.0, 4.0), row_of(20.0, 15.0, 0.0, 8.0, 4.0)]
    plane = filled(rows, inks=[[1.0, 2.0, 3.0]] * 2)
    fill_rectangles(plane, np.array(rows[1:]), 0.0, np.array([[4.0, 5.0, 6.0]] * 2))
    assert plane[15, 10].tolist() == [1, 2, 3]
    assert plane[15, 16].tolist() == [4, 5, 6]
    assert np.array_equal(filled(rows)[:, 13:], filled(rows[1:])[:, 13:])
    assert filled(rows, 1.0, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])[15, 27].tolist() == [4, 5, 6]

"""Lines that meet: those that close are an area, those of the path one line, and all others stay."""

import pytest

from app.maps.features import MapFeature
from app.maps.joined import joined


def lines(*all_points, layer="0", role=None):
    return [MapFeature("line", (tuple(points),), None, role, properties={"layer": layer}) for points in all_points]


def shapes(features):
    return [(one.shape, list(one.rings[0])) for one in features]


FOUR = [[(0, 0), (9, 0)], [(9, 9), (9, 0)], [(0, 9), (0, 0)], [(9, 9), (0, 9)]]


@pytest.mark.parametrize("apart, kinds", [(0.0048, ["polygon"]), (0.0052, ["line"] * 3)])
def test_ends_within_five_millimetres_meet(apart, kinds):
    near = [[(0, 0), (9, 0)], [(9 + apart, 0), (9, 9)], [(9, 9.003), (0, 0.003)]]
    assert [shape for shape, _ in shapes(joined(lines(*near)))] == kinds


@pytest.mark.parametrize(
    "features",
    [[*lines(*FOUR[:3]), *lines(FOUR[3], layer="WALL")], lines(*FOUR[:3]), lines(*FOUR, [(0, 0), (9, 9)])],
    ids=["of two layers", "that do not close", "of which three meet"],
)
def test_lines_stay(features):
    assert joined(features) == features


def test_a_path_that_closes_stays_a_line():
    [(shape, ring)] = shapes(joined(lines(*FOUR, role="path")))
    assert shape == "line"
    assert ring[0] == ring[-1]


def test_lines_that_close_are_areas_in_their_places_whatever_their_order_and_direction():
    other = [[(x + 20, y) for x, y in points] for points in FOUR]
    result = shapes(joined([*lines(*FOUR), MapFeature("point", (((1, 1),),), "tree"), *lines(*other)]))
    assert [shape for shape, _ in result] == ["polygon", "point", "polygon"]
    for x, (_, ring) in ((0, result[0]), (20, result[2])):
        assert (ring[0], len(ring), {*ring}) == (ring[-1], 5, {(x, 0), (x + 9, 0), (x + 9, 9), (x, 9)})

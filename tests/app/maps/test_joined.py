"""Lines that meet: those that close are an area, those of the path one line, and all others stay."""

from __future__ import annotations

import pytest
import shapely

from app.maps.features import MapFeature
from app.maps.joined import joined, merged

Points = list[tuple[float, float]]


def lines(*all_points: Points, layer: str = "0", role: str | None = None) -> list[MapFeature]:
    return [MapFeature("line", (tuple(points),), None, role, properties={"layer": layer}) for points in all_points]


def shapes(features: list[MapFeature]) -> list[tuple[str, Points]]:
    return [(one.shape, list(one.rings[0])) for one in features]


FOUR: list[Points] = [[(0, 0), (9, 0)], [(9, 9), (9, 0)], [(0, 9), (0, 0)], [(9, 9), (0, 9)]]


def test_four_lines_that_close_are_an_area_whatever_their_order_and_direction() -> None:
    [(shape, ring)] = shapes(joined(lines(*FOUR)))
    assert shape == "polygon"
    assert ring[0] == ring[-1]
    assert set(ring) == {(0, 0), (9, 0), (9, 9), (0, 9)}
    assert len(ring) == 5


def test_ends_within_five_millimetres_meet() -> None:
    near: list[Points] = [[(0, 0), (9, 0)], [(9.004, 0), (9, 9)], [(9, 9.003), (0, 0.003)]]
    assert [shape for shape, _ in shapes(joined(lines(*near)))] == ["polygon"]
    far: list[Points] = [[(0, 0), (9, 0)], [(9.006, 0), (9, 9)], [(9, 9), (0, 0)]]
    assert [shape for shape, _ in shapes(joined(lines(*far)))] == ["line"] * 3


def test_lines_of_two_layers_do_not_meet() -> None:
    mixed = [*lines(*FOUR[:3]), *lines(FOUR[3], layer="WALL")]
    assert joined(mixed) == mixed


def test_lines_that_do_not_close_stay() -> None:
    assert joined(lines(*FOUR[:3])) == lines(*FOUR[:3])


def test_where_three_lines_meet_all_stay() -> None:
    crossing = lines(*FOUR, [(0, 0), (9, 9)])
    assert joined(crossing) == crossing


def test_pieces_of_the_path_are_one_path() -> None:
    pieces: list[Points] = [[(5, 5), (9, 0)], [(0, 0), (5, 5)], [(9, 0), (9, -4), (12, -4)]]
    [(shape, ring)] = shapes(joined(lines(*pieces, layer="PATH", role="path")))
    assert shape == "line"
    assert ring in ([(0, 0), (5, 5), (9, 0), (9, -4), (12, -4)], [(12, -4), (9, -4), (9, 0), (5, 5), (0, 0)])


def test_a_path_that_closes_stays_a_line() -> None:
    [(shape, ring)] = shapes(joined(lines(*FOUR, role="path")))
    assert (shape, ring[0]) == ("line", ring[-1])


def test_two_rings_are_two_areas_in_their_places() -> None:
    other = [[(x + 20, y) for x, y in points] for points in FOUR]
    between = MapFeature("point", (((1, 1),),), "tree")
    result = joined([*lines(*FOUR), between, *lines(*other)])
    assert [one.shape for one in result] == ["polygon", "point", "polygon"]
    assert {x for x, _ in result[2].rings[0]} == {20, 29}


# Rings of a square in parts: halves, halves with a corner on the side of the other, four quarters around a hole.
PARTS = {
    "halves": [((0, 0, 3, 3),), ((3, 0, 3, 3),)],
    "a narrow and a wide one": [((0, 0, 3, 3),), ((3, 1, 3, 1),)],
    "around a hole": [((0, 0, 3, 1),), ((0, 1, 1, 1),), ((2, 1, 1, 1),), ((0, 2, 3, 1),)],
}


@pytest.mark.parametrize("name", PARTS)
def test_parts_that_share_edges_are_one_area(name: str) -> None:
    boxes = [rings[0] for rings in PARTS[name]]
    rings = [[(x, y), (x + a, y), (x + a, y + b), (x, y + b), (x, y)] for x, y, a, b in boxes]
    # Every second one is walked the other way around.
    areas = [MapFeature("polygon", (tuple(ring[:: 1 - 2 * (k % 2)]),)) for k, ring in enumerate(rings)]
    whole = merged(areas)
    assert whole is not None
    shape = shapely.Polygon(whole.rings[0], whole.rings[1:])
    assert shape.is_valid
    assert shape.equals(shapely.union_all([shapely.Polygon(ring) for ring in rings]))


@pytest.mark.parametrize(
    "beside", [(5, 0, 3, 3), (3, 3, 2, 2), (2, 1, 3, 3)], ids=["apart", "at a corner", "overlapping"]
)
def test_parts_that_share_no_edge_are_not_one_area(beside: tuple[int, ...]) -> None:
    boxes = [(0, 0, 3, 3), beside]
    rings = [((x, y), (x + a, y), (x + a, y + b), (x, y + b), (x, y)) for x, y, a, b in boxes]
    assert merged([MapFeature("polygon", (ring,)) for ring in rings]) is None

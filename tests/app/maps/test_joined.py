"""Lines that meet: those that close are an area, those of the path one line, and all others stay."""

from __future__ import annotations

from app.maps.features import MapFeature
from app.maps.joined import joined

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

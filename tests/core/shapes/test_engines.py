"""The engines: boxes kept from pose to pose, many instants at once."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from core.kernels import Budget
from core.shapes.engines import (
    GRID,
    GROWTH_MOST,
    KEPT_DRAGONS,
    PIECE,
    WIDEST,
    Engine,
    engine_pairs,
    united,
    widest_place,
)
from tests.support.depth import examples
from tests.support.scenes import unlinked_pairs

Floats = NDArray[np.float64]
THREADS = 4


def crowds(count: int) -> list[tuple[Floats, Floats]]:
    """Dragons more than are kept, each at several instants: poses (T, n, 3) and sizes (n, 2)."""
    random = np.random.default_rng(4)
    scenes = []
    for _ in range(count):
        benches = int(random.integers(2, 60))
        place, heading = random.uniform(0.0, 9.0, (3, benches, 2)), random.uniform(-4.0, 4.0, (3, benches, 1))
        scenes.append((np.concatenate([place, heading], axis=-1), random.uniform(0.1, 3.0, (benches, 2))))
    return scenes


@pytest.mark.parametrize("margin", [0.0, 0.1])
def test_boxes_used_again_find_what_new_ones_find_in_any_order_and_from_several_threads(margin: float) -> None:
    scenes = crowds(KEPT_DRAGONS + 4)
    truth = [[unlinked_pairs(pose, size, margin) for pose in poses] for poses, size in scenes]
    assert sum(len(pairs) for instants in truth for pairs in instants) > 1_000
    random = np.random.default_rng(5)
    order = random.integers(0, (len(scenes), 3), (examples(60, 400), 2)).tolist()

    def pairs_of(request: list[int]) -> set[tuple[int, int]]:
        scene, instant = request
        poses, size = scenes[scene]
        (pairs,) = engine_pairs(Engine.FCL, poses[instant : instant + 1], size, margin, chained=True)
        return {(a, b) for a, b in pairs.tolist()}

    wanted = [truth[scene][instant] for scene, instant in order]
    assert [pairs_of(request) for request in order] == wanted
    with ThreadPoolExecutor(THREADS) as pool:
        assert list(pool.map(pairs_of, order)) == wanted


@pytest.mark.parametrize("engine", Engine)
def test_many_instants_at_once_are_as_one_by_one(engine: Engine) -> None:
    for poses, size in crowds(5):
        for chained in (True, False):
            together = engine_pairs(engine, poses, size, 0.0, chained=chained)
            for instant, pairs in enumerate(together):
                (alone,) = engine_pairs(engine, poses[instant : instant + 1], size, 0.0, chained=chained)
                np.testing.assert_array_equal(pairs, alone)


def test_a_union_is_grown_by_what_was_asked_and_hardly_more() -> None:
    random = np.random.default_rng(4)
    angles = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)[:, None] + [0.0, 0.11, 0.12]  # with shallow dents
    fan = np.stack([np.cos(angles), np.sin(angles)], axis=-1) * (1.0 + 1e-3 * random.uniform(size=(60, 1, 1)))
    fan[:, 0] *= 0.4
    bars = np.array(
        [[[-2.0, 0.0], [2.0, 0.0], [2.0, 0.1], [-2.0, 0.1]], [[5.0, 5.0], [6.0, 5.0], [6.0, 6.0], [5.0, 6.0]]]
    )
    grown = 0.02
    polygons = united([*fan[:, None], *bars[:, None]], [bars[1:] + 0.2], grown, 0.3, Budget())
    own = shapely.union_all([*shapely.polygons(fan), *shapely.polygons(bars)])
    result = shapely.MultiPolygon([(rings[0], rings[1:]) for rings in polygons])
    assert result.is_valid
    assert result.covers(own)
    border = shapely.segmentize(result.boundary, 1e-3)
    away = shapely.distance(own, shapely.points(shapely.get_coordinates(border)))
    assert grown - GRID <= away.min()
    assert away.max() <= GROWTH_MOST * grown + GRID
    rest = united([*bars[:, None]], [bars[1:] + 0.4], grown, 0.3, Budget())
    assert shapely.MultiPolygon([(rings[0], rings[1:]) for rings in rest]).covers(shapely.box(5.4, 5.4, 6.4, 6.4))


# Lines through points: a bow, one that crosses itself, one that turns back; and the fans and bands along them.
WAVES = {
    "bow": lambda t: (np.cos(t), np.sin(t)),
    "loop": lambda t: (np.cos(t) * (1.0 + 0.3 * t), np.sin(2.0 * t)),
    "back": lambda t: (np.sin(3.0 * t), 0.1 * t**2),
}


@pytest.mark.parametrize("wave", WAVES)
@pytest.mark.parametrize("corners", [3, 4])
@pytest.mark.parametrize("cells", [1, PIECE - 1, PIECE, 3 * PIECE + 5])
def test_a_strip_covers_what_its_polygons_cover(wave: str, corners: int, cells: int) -> None:
    line = np.stack(WAVES[wave](np.linspace(0.0, 2.5, cells + 1)), axis=-1)
    ahead = np.diff(line, axis=0)
    if corners == 4:
        side = line + 0.2 * np.stack([-np.gradient(line[:, 1]), np.gradient(line[:, 0])], axis=-1) * cells / 3.0
        strip = np.stack([line[:-1], side[:-1], side[1:], line[1:]], axis=1)
    else:  # the place of x on the line of the one before it: line[k] + t (x - line[k])
        crossings = [line[0] + [0.3, -0.4]]
        for k in range(1, cells):
            crossings.append(line[k] + (0.9 + 0.2 * (k % 2)) * (crossings[-1] - line[k]))
        strip = np.stack([np.array(crossings), line[:-1], line[1:]], axis=1)
    assert np.linalg.norm(ahead, axis=1).min() > 0.0
    own = shapely.union_all(shapely.convex_hull(shapely.polygons(strip)))
    polygons = united([strip], [strip[:1]], 1e-3, 0.0, Budget())
    result = shapely.MultiPolygon([(rings[0], rings[1:]) for rings in polygons])
    assert result.covers(own)
    border = shapely.points(shapely.get_coordinates(shapely.segmentize(result.boundary, 0.01)))
    assert shapely.distance(own, border).max() <= GROWTH_MOST * 1e-3 + GRID


SQUARE = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)]
STREET = [(0.0, 0.0), (50.0, 0.0), (50.0, 4.0), (10.0, 4.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)]
HALL = [(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (0.0, 10.0), (0.0, 0.0)]


@pytest.mark.parametrize(
    ("rings", "others", "middle", "radius"),
    [
        pytest.param([SQUARE], [], (5.0, 5.0), 5.0, id="a-square"),
        pytest.param([HALL], [], (15.0, 5.0), 5.0, id="as-wide-everywhere-so-around-the-centroid"),
        pytest.param([STREET], [], (5.0, 5.0), 5.0, id="the-wide-end-and-not-the-long-street"),
        pytest.param([SQUARE], [[SQUARE]], (5.0, 5.0), 5.0, id="all-covered"),
        pytest.param([HALL], [[SQUARE], [[(x + 10.0, y) for x, y in SQUARE]]], (25.0, 5.0), 5.0, id="beside-others"),
    ],
)
def test_the_widest_place_is_the_middle_of_the_largest_circle(
    rings: list[list[tuple[float, float]]],
    others: list[list[list[tuple[float, float]]]],
    middle: tuple[float, float],
    radius: float,
) -> None:
    x, y, wide = widest_place(rings, others)
    extent = max(max(column) - min(column) for column in zip(*rings[0], strict=True))
    assert (x, y) == pytest.approx(middle, abs=2.0 * WIDEST * extent)
    assert radius - 2.0 * WIDEST * extent <= wide <= radius + 1e-9
    assert shapely.Polygon(rings[0], rings[1:]).boundary.distance(shapely.Point(x, y)) == pytest.approx(wide)


def test_the_widest_place_is_in_the_view_if_the_view_shows_some_of_the_polygon() -> None:
    assert widest_place([STREET], view=(20.0, -5.0, 40.0, 50.0))[:2] == pytest.approx((30.0, 2.0), abs=1.0)
    assert widest_place([STREET], view=(60.0, -5.0, 90.0, 50.0)) == widest_place([STREET])

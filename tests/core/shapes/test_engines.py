"""The engines: boxes kept from pose to pose, many instants at once."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import shapely

from core.shapes.engines import (
    KEPT_DRAGONS,
    WIDEST,
    Engine,
    engine_pairs,
    widest_place,
)
from tests.support.depth import examples
from tests.support.near import assert_near
from tests.support.scenes import unlinked_pairs


def crowds(count):
    """Dragons more than are kept, each at several instants: poses (T, n, 3) and sizes (n, 2)."""
    random = np.random.default_rng(4)
    scenes = []
    for _ in range(count):
        benches = int(random.integers(2, 60))
        poses = random.uniform([0.0, 0.0, -4.0], [9.0, 9.0, 4.0], (3, benches, 3))
        scenes.append((poses, random.uniform(0.1, 3.0, (benches, 2))))
    return scenes


@pytest.mark.parametrize("margin", [0.0, 0.1])
def test_boxes_used_again_find_what_new_ones_find_in_any_order_and_from_several_threads(margin):
    scenes = crowds(KEPT_DRAGONS + 4)
    truth = [[unlinked_pairs(pose, size, margin) for pose in poses] for poses, size in scenes]
    assert sum(len(pairs) for instants in truth for pairs in instants) > 1_000
    order = np.random.default_rng(5).integers(0, (len(scenes), 3), (examples(40, 400), 2)).tolist()

    def pairs_of(request):
        scene, instant = request
        poses, size = scenes[scene]
        (pairs,) = engine_pairs(Engine.FCL, poses[instant : instant + 1], size, margin, chained=True)
        return set(map(tuple, pairs.tolist()))

    wanted = [truth[scene][instant] for scene, instant in order]
    assert [pairs_of(request) for request in order] == wanted
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(pairs_of, order)) == wanted


@pytest.mark.parametrize("engine", Engine)
def test_many_instants_at_once_are_as_one_by_one(engine):
    for poses, size in crowds(5):
        for chained in (True, False):
            together = engine_pairs(engine, poses, size, 0.0, chained=chained)
            for pose, pairs in zip(poses, together, strict=True):
                np.testing.assert_array_equal(pairs, *engine_pairs(engine, pose[None], size, 0.0, chained=chained))


def ring(*corners):
    return [*corners, corners[0]]


SQUARE, BESIDE, HALL = (ring((x, 0), (x + w, 0), (x + w, 10), (x, 10)) for x, w in ((0, 10), (10, 10), (0, 30)))
STREET = ring((0, 0), (50, 0), (50, 4), (10, 4), (10, 10), (0, 10))


@pytest.mark.parametrize(
    "outline, others, middle",
    [
        (SQUARE, [], (5.0, 5.0)),
        (HALL, [], (15.0, 5.0)),
        (STREET, [], (5.0, 5.0)),
        (SQUARE, [[SQUARE]], (5.0, 5.0)),
        (HALL, [[SQUARE], [BESIDE]], (25.0, 5.0)),
    ],
    ids=["square", "equally wide, so around the centroid", "not the long street", "all covered", "beside others"],
)
def test_the_widest_place_is_the_middle_of_the_largest_circle(outline, others, middle):
    x, y, wide = widest_place([outline], others)
    off = 2.0 * WIDEST * np.ptp(outline, axis=0).max()
    assert_near([x, y], middle, off)
    assert 5.0 - off <= wide <= 5.0 + 1e-9
    assert_near(shapely.Polygon(outline).boundary.distance(shapely.Point(x, y)), wide, 1e-6)


def test_the_widest_place_is_in_the_view_if_the_view_shows_some_of_the_polygon():
    assert_near(widest_place([STREET], view=(20.0, -5.0, 40.0, 50.0))[:2], [30.0, 2.0], 1.0)
    assert widest_place([STREET], view=(60.0, -5.0, 90.0, 50.0)) == widest_place([STREET])

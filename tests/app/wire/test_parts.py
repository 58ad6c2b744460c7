"""Areas of several parts are one area where these share edges."""

import pytest
import shapely

from app.wire.parts import merged

# Boxes of a square in parts, by a corner and their sides.
PARTS = {
    "halves": [(0, 0, 3, 3), (3, 0, 3, 3)],
    "a narrow and a wide one": [(0, 0, 3, 3), (3, 1, 3, 1)],
    "around a hole": [(0, 0, 3, 1), (0, 1, 1, 1), (2, 1, 1, 1), (0, 2, 3, 1)],
    "apart": [(0, 0, 3, 3), (5, 0, 3, 3)],
    "at a corner": [(0, 0, 3, 3), (3, 3, 2, 2)],
    "overlapping": [(0, 0, 3, 3), (2, 1, 3, 3)],
}
SEPARATE = ("apart", "at a corner", "overlapping")


@pytest.mark.parametrize("name", PARTS)
def test_parts_that_share_edges_are_one_area_and_no_others(name):
    rings = [[(x, y), (x + a, y), (x + a, y + b), (x, y + b), (x, y)] for x, y, a, b in PARTS[name]]
    # Every second one is walked the other way around.
    whole = merged([(tuple(ring[:: 1 - 2 * (k % 2)]),) for k, ring in enumerate(rings)])
    assert (whole is None) is (name in SEPARATE)
    if whole is not None:
        shape = shapely.Polygon(whole[0], whole[1:])
        assert shape.is_valid
        assert shape.equals(shapely.union_all([shapely.Polygon(ring) for ring in rings]))

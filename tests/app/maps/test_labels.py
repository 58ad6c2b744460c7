"""Texts of a drawing: each names what it stands in or beside."""

import pytest

from app.maps.features import MapFeature
from app.maps.labels import label_of, names_of

SQUARE = MapFeature("polygon", (((0, 0), (60, 0), (60, 60), (0, 60), (0, 0)),))
COURT = MapFeature("polygon", (((40, 40), (50, 40), (50, 50), (40, 50), (40, 40)),))
WALL = MapFeature("line", (((20, 20), (30, 20)),), radius=0.3)
TREE = MapFeature("point", (((10, 10),),), radius=1.0)
ALL = [SQUARE, WALL, TREE, COURT]


@pytest.mark.parametrize(
    "at, height, owner",
    [
        ((22, 21), 2.5, 1),  # beside the wall
        ((22, 25), 2.5, 0),  # two heights above it
        ((10, 10), 0.5, 2),
        ((11.5, 10), 0.5, 2),  # beside the tree
        ((41, 41), 0.5, 3),
        ((41, 39.5), 0.5, 3),  # below the court
        ((70, 70), 1.0, None),
    ],
)
def test_a_text_names_the_nearest_thing(at, height, owner):
    assert names_of(ALL, [label_of("words", at, height, 0.0, 0.0)]) == ({} if owner is None else {owner: "words"})

"""GeoJSON: accepted forms, and the places of refusals."""

from __future__ import annotations

import json
import math
import time
from typing import Any

import numpy as np
import pytest

from app.wire.degrees import Coordinates, place_of
from app.wire.geojson import outlined, read_things, venue_of
from core import Dragon, InvalidValue, Venue
from tests.support.asking import Asking, box, polygon

AT_ONCE = 20.0  # [s] of processor time; judged for validity these rings take more than a minute
SQUARE = (-35, -5, 20, 20)
WELL = [(5 + math.cos(a), 4 + math.sin(a)) for a in np.linspace(0, 2 * math.pi, 24, endpoint=False)]
RING = [[0, 0], [1, 0], [1, 1], [0, 0]]


def features(*members: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(members)}


def collection(*members: Any) -> dict[str, Any]:
    return {"type": "GeometryCollection", "geometries": list(members)}


def raw(*rings: Any) -> dict[str, Any]:
    """A polygon of rings as they are, closed or not."""
    return {"type": "Polygon", "coordinates": list(rings)}


def read(geometry: object) -> Venue:
    return venue_of(outlined(read_things(geometry)))


def test_a_single_polygon_is_the_square_with_its_holes() -> None:
    venue = read(polygon(box(*SQUARE)["coordinates"][0], WELL))
    assert (venue.square.name, len(venue.square.rings), venue.obstacles) == ("square", 2, ())
    assert venue.square.edges.shape == (4 + 24, 4)


def test_the_feature_named_square_is_the_square_wherever_it_stands() -> None:
    unnamed = {"type": "Feature", "properties": {"name": None}, "geometry": box(15, 0, 18, 3)}
    venue = read(features(polygon(WELL, name="well"), box(*SQUARE, name="square"), unnamed))
    assert [area.name for area in venue.areas] == ["square", "well", "obstacle 2"]


def test_the_first_polygon_of_a_collection_is_the_square() -> None:
    venue = read(collection(box(*SQUARE), polygon(WELL)))
    assert [area.name for area in venue.areas] == ["square", "obstacle 1"]
    assert venue.square.rings[0][0] == (-35.0, -5.0)


def test_heights_and_edges_without_length_are_passed_over() -> None:
    ring = [[0, 0, 7], [9, 0, 7], [9, 0, 7], [9, 9, 8], [0, 0, 7]]
    assert read(raw(ring)).square.edges.tolist() == [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 0]]


# JSON of what is no venue -> the field of its refusal. POLYGON stands for the beginning of a polygon.
WRONG = {
    "[]": "venue",
    "null": "venue",
    "{}": "venue.type",
    '{"type": "Point", "coordinates": [0, 0]}': "venue.type",
    '{"type": "Polygon"}': "venue.coordinates",
    "POLYGON: []}": "venue.coordinates",
    "POLYGON: [3]}": "venue.coordinates.0",
    "POLYGON: [[[0, 0], [1, 0], 5]]}": "venue.coordinates.0.2",
    "POLYGON: [[[0, 0], [1], [1, 1], [0, 0]]]}": "venue.coordinates.0.1",
    "POLYGON: [[[0, 0], [1, NaN], [1, 1], [0, 0]]]}": "venue.coordinates.0.1.1",
    "POLYGON: [[[0, 0], [2e5, 0], [1, 1], [0, 0]]]}": "venue.coordinates.0.1.0",
    "POLYGON: [[[0, 0], [1, 0], [1, 1]]]}": "venue",
    "POLYGON: [[[0, 0], [1, 0], [1, 1], [0, 1]]]}": "venue",
    "POLYGON: [[]]}": "venue.coordinates.0",
    '{"type": "FeatureCollection", "features": []}': "venue",
    '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": null, "geometry": null}]}': (
        "venue.features.0.geometry"
    ),
    '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": 7}, "geometry": SQUARE}]}': (
        "venue.features.0.properties.name"
    ),
    '{"type": "FeatureCollection", "features": [NAMED, NAMED]}': "venue",
}


@pytest.mark.parametrize("text", WRONG)
def test_what_is_no_venue_is_refused_where_it_is_wrong(text: str) -> None:
    parts = {"POLYGON": '{"type": "Polygon", "coordinates"', "SQUARE": json.dumps(box(*SQUARE))}
    parts["NAMED"] = json.dumps(box(*SQUARE, name="a"))
    geometry = text
    for word, part in parts.items():
        geometry = geometry.replace(word, part)
    with pytest.raises(InvalidValue) as refused:
        read(json.loads(geometry))
    assert refused.value.field == WRONG[text]


def test_endless_nesting_is_refused() -> None:
    nested = raw(RING)
    for _ in range(900):
        nested = collection(nested)
    with pytest.raises(InvalidValue, match="nest"):
        read(nested)


def test_as_many_edges_as_the_limit_are_read_and_one_more_is_refused() -> None:
    circle = [(math.cos(a), math.sin(a)) for a in np.linspace(0, 2 * math.pi, 2_001, endpoint=False)]
    assert len(read(polygon(circle[:-1])).square.edges) == 2_000
    with pytest.raises(InvalidValue, match="at most 2000 edges, got 2001"):
        read(polygon(circle))


@pytest.mark.parametrize(
    ("ring", "count"),
    [
        (RING, 140_000),
        pytest.param([[0, 0]] * 4, 140_000, marks=pytest.mark.thorough),
        pytest.param([], 500_000, marks=pytest.mark.thorough),
        pytest.param(None, 140_000, marks=pytest.mark.thorough),
    ],
    ids=["rings", "rings without size", "empty rings", "features"],
)
def test_too_many_rings_are_refused_before_their_validity_is_judged(ring: Any, count: int) -> None:
    one = {"type": "Feature", "properties": {"name": None}, "geometry": raw(RING)}
    geometry = features(*[one] * count) if ring is None else raw(*[ring] * count)
    began = time.process_time()
    with pytest.raises(InvalidValue, match="venue must have at most 2000 edges"):
        read(geometry)
    assert time.process_time() - began < AT_ONCE


def test_the_service_refuses_them_by_their_number(ask: Asking) -> None:
    ask.refuses("/venue edges 2000 90000", "check", {"venue": raw(*[RING] * 30_000)})
    ask.refuses(" 200000 700003", "check", {"venue": raw(*[RING] * 140_000)})


@pytest.mark.parametrize("coordinates", [None, "metres", "degrees"])
def test_a_ring_without_points_is_refused_by_its_place(coordinates: Coordinates | None) -> None:
    with pytest.raises(InvalidValue) as refused:
        place_of(collection(raw([]), raw(RING)), coordinates, Dragon())
    assert refused.value.field == "venue.geometries.0.coordinates.0"

"""GeoJSON: accepted forms, and the places of refusals."""

from __future__ import annotations

import math
import time
from typing import Any

import httpx
import numpy as np
import pytest

from app.wire.degrees import Coordinates, place_of
from app.wire.geojson import outlined, read_things, venue_of
from core import Dragon, InvalidValue, Venue

AT_ONCE_SECONDS = 20.0  # [s], with what else the machine does
AT_ONCE = 2.0  # [s] of processor time; judged for validity these rings take more than a minute


def box(x: float, y: float, right: float, top: float) -> list[list[float]]:
    return [[x, y], [right, y], [right, top], [x, top], [x, y]]


def polygon(*rings: list[list[float]]) -> dict[str, Any]:
    return {"type": "Polygon", "coordinates": list(rings)}


def feature(name: str | None, *rings: list[list[float]]) -> dict[str, Any]:
    return {"type": "Feature", "properties": {"name": name}, "geometry": polygon(*rings)}


def features(*members: dict[str, Any]) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(members)}


def read(geometry: object) -> Venue:
    return venue_of(outlined(read_things(geometry)))


SQUARE = box(-35, -5, 20, 20)
WELL = [[5 + math.cos(a), 4 + math.sin(a)] for a in np.linspace(0, 2 * math.pi, 24, endpoint=False)]
WELL.append(WELL[0])
STAGE = box(15.0, 0.0, 18.0, 3.0)


def test_a_single_polygon_is_the_square_with_its_holes() -> None:
    venue = read(polygon(SQUARE, WELL))
    assert venue.square.name == "square"
    assert len(venue.square.rings) == 2
    assert venue.square.edges.shape == (4 + 24, 4)
    assert venue.obstacles == ()


def test_the_feature_named_square_is_the_square_wherever_it_stands() -> None:
    venue = read(features(feature("well", WELL), feature("square", SQUARE), feature(None, STAGE)))
    assert [area.name for area in venue.areas] == ["square", "well", "obstacle 2"]


def test_the_first_polygon_of_a_collection_is_the_square() -> None:
    venue = read({"type": "GeometryCollection", "geometries": [polygon(SQUARE), polygon(WELL)]})
    assert [area.name for area in venue.areas] == ["square", "obstacle 1"]
    assert venue.square.rings[0][0] == (-35.0, -5.0)


def test_heights_and_edges_without_length_are_passed_over() -> None:
    ring = [[0, 0, 7], [9, 0, 7], [9, 0, 7], [9, 9, 8], [0, 0, 7]]
    assert read(polygon(ring)).square.edges.tolist() == [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 0]]


@pytest.mark.parametrize(
    ("geometry", "field"),
    [
        ([], "venue"),
        (None, "venue"),
        ({}, "venue.type"),
        ({"type": "Point", "coordinates": [0, 0]}, "venue.type"),
        ({"type": "Polygon"}, "venue.coordinates"),
        ({"type": "Polygon", "coordinates": []}, "venue.coordinates"),
        ({"type": "Polygon", "coordinates": [3]}, "venue.coordinates.0"),
        (polygon([[0, 0], [1, 0], 5]), "venue.coordinates.0.2"),
        (polygon([[0, 0], [1], [1, 1], [0, 0]]), "venue.coordinates.0.1"),
        (polygon([[0, 0], [1, math.nan], [1, 1], [0, 0]]), "venue.coordinates.0.1.1"),
        (polygon([[0, 0], [2e5, 0], [1, 1], [0, 0]]), "venue.coordinates.0.1.0"),
        (polygon([[0, 0], [1, 0], [1, 1]]), "venue"),
        (polygon([[0, 0], [1, 0], [1, 1], [0, 1]]), "venue"),
        (polygon([]), "venue.coordinates.0"),
        ({"type": "FeatureCollection", "features": []}, "venue"),
        (features({"type": "Feature", "properties": None, "geometry": None}), "venue.features.0.geometry"),
        (features(feature(7, SQUARE)), "venue.features.0.properties.name"),
        (features(feature("a", SQUARE), feature("a", WELL)), "venue"),
    ],
)
def test_what_is_no_venue_is_refused_where_it_is_wrong(geometry: object, field: str) -> None:
    with pytest.raises(InvalidValue) as e:
        read(geometry)
    assert e.value.field == field


def test_endless_nesting_is_refused() -> None:
    nested: dict = polygon(SQUARE)
    for _ in range(900):
        nested = {"type": "GeometryCollection", "geometries": [nested]}
    with pytest.raises(InvalidValue, match="nest"):
        read(nested)


def test_too_many_edges_are_refused() -> None:
    circle = [[math.cos(a), math.sin(a)] for a in np.linspace(0, 2 * math.pi, 2_001, endpoint=False)]
    with pytest.raises(InvalidValue, match="at most 2000 edges, got 2001"):
        read(polygon([*circle, circle[0]]))


RING = [[0, 0], [1, 0], [1, 1], [0, 0]]


@pytest.mark.parametrize(
    "geometry",
    [
        polygon(*[RING] * 140_000),
        polygon(*[[[0, 0]] * 4] * 140_000),
        polygon(*[[]] * 500_000),
        features(*[feature(None, RING)] * 140_000),
    ],
    ids=["rings", "rings without size", "empty rings", "features"],
)
def test_too_many_rings_are_refused_before_their_validity_is_judged(geometry: dict[str, Any]) -> None:
    began = time.process_time()
    with pytest.raises(InvalidValue, match="venue must have at most 2000 edges"):
        read(geometry)
    assert time.process_time() - began < AT_ONCE


def test_the_service_refuses_them_at_once(client: httpx.Client) -> None:
    began = time.monotonic()
    answers = [client.post("/check", json={"venue": polygon(*[RING] * rings)}) for rings in (30_000, 140_000)]
    assert time.monotonic() - began < AT_ONCE_SECONDS
    assert [answer.status_code for answer in answers] == [422, 422]
    assert [answer.json()["detail"] for answer in answers] == [
        "venue must have at most 2000 edges, got 90000",
        "The body must hold at most 200000 objects and lists, got about 700003.",
    ]


@pytest.mark.parametrize("coordinates", [None, "metres", "degrees"])
def test_a_ring_without_points_is_refused_by_its_place(coordinates: Coordinates | None) -> None:
    collection = {"type": "GeometryCollection", "geometries": [polygon([]), polygon(RING)]}
    with pytest.raises(InvalidValue, match="must hold at least one point") as e:
        place_of(collection, coordinates, Dragon())
    assert e.value.field == "venue.geometries.0.coordinates.0"

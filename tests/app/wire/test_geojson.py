"""GeoJSON: accepted forms, and the places of refusals."""

import math
import time

import numpy as np
import pytest

from app.wire.degrees import place_of
from app.wire.geojson import Aside, outlined, read_things, venue_of
from core import Dragon
from tests.support.asking import box, polygon
from tests.support.refused import refused

AT_ONCE = 20.0  # [s] of processor time; judged for validity these rings take more than a minute
SQUARE = (-35, -5, 20, 20)


def circle(count):
    """Points of a circle with a radius of 1 m around (5, 4)."""
    return [(5 + math.cos(k), 4 + math.sin(k)) for k in np.linspace(0, 2 * math.pi, count, endpoint=False)]


WELL = circle(24)
RING = [[0, 0], [1, 0], [1, 1], [0, 0]]


def features(*members):
    return {"type": "FeatureCollection", "features": list(members)}


def raw(*rings):
    """A polygon of rings as they are, closed or not."""
    return {"type": "Polygon", "coordinates": list(rings)}


def read(geometry):
    return venue_of(outlined(read_things(geometry)))


def test_a_single_polygon_is_the_square_with_its_holes():
    venue = read(polygon(box(*SQUARE)["coordinates"][0], WELL))
    assert (venue.square.name, len(venue.square.rings), venue.obstacles) == ("square", 2, ())
    assert venue.square.edges.shape == (4 + 24, 4)


def test_the_square_is_the_feature_of_that_name_or_else_the_first():
    unnamed = {"type": "Feature", "properties": {"name": None}, "geometry": box(15, 0, 18, 3)}
    venue = read(features(polygon(WELL, name="well"), box(*SQUARE, name="square"), unnamed))
    assert [area.name for area in venue.areas] == ["square", "well", "obstacle 2"]
    first = read({"type": "GeometryCollection", "geometries": [box(*SQUARE), polygon(WELL)]})
    assert [area.name for area in first.areas] == ["square", "obstacle 1"]
    assert first.square.rings[0][0] == (-35.0, -5.0)


GATE = {"name": "East", "role": "gate", "heading": 1.5}


def gate(properties, shape="Point", at=(20, 5)):
    return {"type": "Feature", "properties": properties, "geometry": {"type": shape, "coordinates": list(at)}}


def test_gates_are_kept_and_no_bench_can_touch_them():
    line = gate({"role": "square without streets"}, "LineString", RING)
    place = place_of(features(gate(GATE), box(*SQUARE, name="square"), line), None, Dragon())
    assert [area.name for area in place.venue.areas] == ["square"]
    ring = tuple(map(tuple, RING))
    assert place.asides == [
        Aside("gate", "East", ((20, 5),), {"heading": 1.5}),
        Aside("square without streets", None, ring),
    ]
    # In another shape, or with a radius, it stands in the way.
    blocks = [gate(GATE | {"radius": 0.3}), gate(GATE, "Polygon", [RING])]
    for one in blocks:
        assert [area.name for area in read(features(box(*SQUARE, name="square"), one)).areas] == ["square", "East"]


def test_a_lane_is_kept_with_its_width_and_is_a_line():
    lane = {"role": "emergency lane", "name": "ambulances"}
    places = [[0, 0], [20, 5]]

    def read_lane(own, at):
        return place_of(features(box(*SQUARE, name="square"), gate(lane | own, "LineString", at)), None, Dragon())

    place = read_lane({"radius": 2}, places)
    assert [area.name for area in place.venue.areas] == ["square"]
    assert place.asides == [Aside("emergency lane", "ambulances", ((0, 0), (20, 5)), radius=2.0)]
    assert read_lane({}, places).asides[0].radius == 1.75
    for own, at, field in (
        ({"radius": 0.1}, places, "properties.radius"),
        ({}, [[1, 1], [1, 1]], "geometry.coordinates"),
    ):
        with refused(f"venue.features.1.{field}"):
            read_lane(own, at)


def test_heights_and_edges_without_length_are_passed_over():
    ring = [[0, 0, 7], [9, 0, 7], [9, 0, 7], [9, 9, 8], [0, 0, 7]]
    assert read(raw(ring)).square.edges.tolist() == [[0, 0, 9, 0], [9, 0, 9, 9], [9, 9, 0, 0]]


def test_as_many_edges_as_the_limit_are_read_and_one_more_is_refused():
    assert len(read(polygon(circle(5_000))).square.edges) == 5_000
    with refused("venue", got=5_001, most=5_000):
        read(polygon(circle(5_001)))


def with_trees(count):
    places = [[3 * (k % 30), 3 * (k // 30)] for k in range(count)]
    trees = [
        {"type": "Feature", "properties": {"radius": 0.5}, "geometry": {"type": "Point", "coordinates": at}}
        for at in places
    ]
    return features({"type": "Feature", "properties": {}, "geometry": polygon(RING)}, *trees)


@pytest.mark.parametrize("count, sides, reach", [(60, 32, 1.02), (500, 8, 1.083)])
def test_trees_are_finer_polygons_where_there_are_few_of_them(count, sides, reach):
    trees = read(with_trees(count)).obstacles
    assert {len(tree.edges) for tree in trees} == {sides}
    ring = np.array(trees[-1].rings[0])
    middle = [3 * ((count - 1) % 30), 3 * ((count - 1) // 30)]
    assert np.hypot(*(0.5 * (ring[1:] + ring[:-1]) - middle).T).min() >= 0.5
    assert np.hypot(*(ring - middle).T).max() <= 0.5 * reach


def test_too_many_trees_are_told_from_other_edges():
    with refused("venue", got=5_603, most=5_000, trees=700, sides=8):
        read(with_trees(700))


@pytest.mark.parametrize(
    "geometry",
    [raw(*[RING] * 140_000), features(*[{"type": "Feature", "geometry": raw(RING)}] * 140_000)],
    ids=["rings", "features"],
)
def test_too_many_rings_are_refused_before_their_validity_is_judged(geometry):
    began = time.process_time()
    with refused("venue", most=5_000):
        read(geometry)
    assert time.process_time() - began < AT_ONCE

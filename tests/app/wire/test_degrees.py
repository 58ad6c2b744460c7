"""Venues in longitude and latitude, laid out on a plane as surveyors do it; test_refusals.py has what is wrong."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.wire.degrees import ACROSS_MAX, AXIS, place_of
from core import Dragon
from tests.support.asking import box, written
from tests.support.command import run
from tests.support.near import assert_near
from tests.support.refused import refused

# Longitude and latitude are differences of doubles near 120 degrees: 1e-14 degrees [m].
PLACED = 2e-8


def with_crs(name, venue):
    return venue | {"crs": {"type": "name", "properties": {"name": name}}}


def placed(venue, coordinates=None, dragon=Dragon()):  # noqa: B008
    return place_of(venue, coordinates, dragon)


METRES = box(-40, -40, 40, 40)
DEGREES = box(120.1547, 28.97, 120.1555, 28.9706)


# -- degrees or metres ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "venue",
    [box(0, 0, 3.42, 0.1), box(0, 0, 0.1, 3.42), box(-360.1, -90, -358, -88), box(177, 88, 179, 90.1)],
    ids=["longer", "higher", "beyond 360", "beyond 90"],
)
def test_what_cannot_be_degrees_or_holds_a_bench_is_in_metres(venue):
    assert placed(venue).origin is None


def test_a_toy_dragon_has_its_square_on_a_table():
    assert placed(box(0, 0, 0.5, 0.5), dragon=Dragon(9, 0.0341, 0.022, 0.003, 0.00275)).venue is not None


# -- laid out ------------------------------------------------------------------------------------------------


NEAR = st.floats(-0.05, 0.05)


@given(st.floats(-179.9, 179.9), st.floats(-80.0, 80.0), NEAR, NEAR, st.floats(0.01, 0.05))
def test_vertices_lie_where_the_slow_formula_puts_them(longitude, latitude, x, y, half):
    square = box(longitude - half, latitude - half, longitude + half, latitude + half)
    stall = box(longitude + x, latitude + y, longitude + x + 1e-3, latitude + y + 1e-3)
    place = placed({"type": "GeometryCollection", "geometries": [square, stall]}, "degrees")
    for area, geometry in zip(place.venue.areas, (square, stall), strict=True):
        slow = [east_north(place.origin, *corner) for corner in geometry["coordinates"][0]]
        assert_near(area.rings[0], slow, PLACED)


def east_north(origin, longitude, latitude):
    """By the latitude and longitude alone, as in Torge and Mueller, Geodesy, section 6.2: e = n cos p sin(l - l0)."""
    squared = 1.0 - (1.0 - 1.0 / 298.257223563) ** 2
    p0 = math.radians(origin.latitude)
    p = math.radians(latitude)
    dl = math.radians(longitude - origin.longitude)
    n0, n = (6_378_137.0 / math.sqrt(1.0 - squared * math.sin(one) ** 2) for one in (p0, p))
    east = n * math.cos(p) * math.sin(dl)
    north = n * (math.sin(p) * math.cos(p0) * (1.0 - squared) - math.cos(p) * math.sin(p0) * math.cos(dl))
    return east, north + squared * n0 * math.sin(p0) * math.cos(p0)


# -- the member crs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    ["urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4490", "CRS:84"],
)
def test_a_crs_of_longitude_and_latitude_is_believed(name):
    assert placed(with_crs(name, DEGREES)) == placed(with_crs(name, DEGREES), "degrees") == placed(DEGREES, "degrees")


def test_another_crs_or_none_is_believed_to_be_in_metres_if_the_user_says_so():
    for venue in (with_crs("EPSG:3857", METRES), with_crs("somewhere", METRES)):
        assert placed(venue, "metres") == placed(METRES) == placed(METRES | {"crs": None})


def test_the_limit_of_a_venue_is_where_it_says():
    degrees = math.degrees(ACROSS_MAX / AXIS)
    assert placed(box(0, 0, 0.99 * degrees, 0.001), "degrees").venue is not None
    with refused("venue"):
        placed(box(0, 0, 1.01 * degrees, 0.001), "degrees")


# -- on the command line -----------------------------------------------------------------------------------------


def test_the_command_takes_a_venue_in_degrees(tmp_path):
    written(tmp_path, DEGREES, "square.geojson")
    dance = {"path": {"pitch": 1.7, "start_turns": 6}, "dragon": {"benches": 20}, "stop": 20}
    file = written(tmp_path, dance | {"venue": "square.geojson", "coordinates": "degrees"})
    assert "x = y = 0 is longitude 120.155100, latitude 28.970300" in run("check", file).stdout

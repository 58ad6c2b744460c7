"""Venues in longitude and latitude: never read as metres, and laid out on a plane as surveyors do it."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.wire.degrees import ACROSS_MAX, GeographicOrigin, Plane, place_of
from core import Dance, Dragon, InvalidValue, check
from core import Spiral as CoreSpiral
from tests.app.test_cli import answer_of
from tests.support.command import run

# The plane that touches the earth shortens a length of 10 km by this part of it [1].
FLATNESS = 1.1e-6
# Longitude and latitude are differences of doubles near 120 degrees: 1e-14 degrees [m].
PLACED = 2e-8

LONGITUDE, LATITUDE = 120.1551, 28.9703
# Metres along a meridian and a parallel for a degree there, by the series of the WGS 84 ellipsoid (NGA TR8350.2).
PHI = math.radians(LATITUDE)
ALONG_MERIDIAN = 111_132.954 - 559.822 * math.cos(2 * PHI) + 1.175 * math.cos(4 * PHI) - 0.0023 * math.cos(6 * PHI)
ALONG_PARALLEL = 111_412.877 * math.cos(PHI) - 93.503 * math.cos(3 * PHI) + 0.118 * math.cos(5 * PHI)
SERIES = 1e-6  # how good the series is, as a part of the length [1]


def ring(left: float, low: float, right: float, high: float) -> list[list[float]]:
    return [[left, low], [right, low], [right, high], [left, high], [left, low]]


def around(half: float, longitude: float = LONGITUDE, latitude: float = LATITUDE) -> dict[str, Any]:
    """A square in degrees. half: distance from its middle to each side [m]"""
    east = half / (ALONG_PARALLEL / math.cos(PHI) * math.cos(math.radians(latitude)))
    north = half / ALONG_MERIDIAN
    box = ring(longitude - east, latitude - north, longitude + east, latitude + north)
    return {"type": "Polygon", "coordinates": [box]}


def with_crs(name: str | None) -> dict[str, Any]:
    system = None if name is None else {"type": "name", "properties": {"name": name}}
    return around(40.0) | {"crs": system}


METRES = {"type": "Polygon", "coordinates": [ring(-40, -40, 40, 40)]}
DANCE = {"dragon": {"benches": 20}, "path": {"pitch": 1.7, "start_turns": 6}, "stop": 20}


# -- degrees or metres ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("call", ["check", "figures/trajectory.svg", "figures/contact.svg"])
@pytest.mark.parametrize("coordinates", [{}, {"coordinates": None}, {"coordinates": "metres"}])
def test_degrees_are_never_read_as_metres(client: httpx.Client, call: str, coordinates: dict[str, Any]) -> None:
    body = {name: value for name, value in DANCE.items() if name != "stop"} | {"venue": around(40.0)} | coordinates
    answer = client.post(f"/{call}", json=body)
    assert answer.status_code == 422
    (item,) = answer.json()["errors"]
    assert item["pointer"] == "/venue"
    for words in (
        "longitude and latitude",
        "narrower than a bench of 3.41 m",
        'give "coordinates": "degrees" beside the venue (in TOML: coordinates = "degrees")',
    ):
        assert words in item["detail"]


@pytest.mark.parametrize(
    ("box", "is_read"),
    [
        (ring(0, 0, 3.40, 3.40), False),
        (ring(0, 0, 3.42, 0.1), True),
        (ring(0, 0, 0.1, 3.42), True),
        (ring(-180, -90, -178, -88), False),
        (ring(-180.1, -90, -178, -88), True),
        (ring(177, 88, 179, 90.1), True),
    ],
    ids=["smaller", "longer", "higher", "at the limits", "beyond 180", "beyond 90"],
)
def test_only_what_can_be_degrees_and_no_square_is_refused(box: list[list[float]], is_read: bool) -> None:
    geometry = {"type": "Polygon", "coordinates": [box]}
    if is_read:
        assert place_of(geometry, None, Dragon()).origin is None
        return
    with pytest.raises(InvalidValue, match="longitude and latitude"):
        place_of(geometry, None, Dragon())


def test_a_toy_dragon_has_its_square_on_a_table() -> None:
    toy = Dragon(9, 0.0341, 0.022, 0.003, 0.00275)
    assert place_of({"type": "Polygon", "coordinates": [ring(0, 0, 0.5, 0.5)]}, None, toy).venue is not None


def test_an_obstacle_far_away_makes_no_square_of_degrees_one_of_metres() -> None:
    square = {"type": "Feature", "properties": {"name": "square"}, "geometry": around(40.0)}
    stall = {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [ring(0, 0, 9, 9)]}}
    whole = {"type": "FeatureCollection", "features": [square, stall]}
    with pytest.raises(InvalidValue, match="longitude and latitude"):
        place_of(whole, None, Dragon())


@pytest.mark.parametrize("coordinates", [{}, {"coordinates": "metres"}, {"coordinates": "degrees"}])
def test_latitude_before_longitude_is_reported(client: httpx.Client, coordinates: dict[str, Any]) -> None:
    ((*corners,),) = around(40.0)["coordinates"]
    swapped = {"type": "Polygon", "coordinates": [[[y, x] for x, y in corners]]}
    answer = client.post("/check", json=DANCE | {"venue": swapped} | coordinates)
    assert answer.status_code == 422
    assert "longitude comes first and latitude second, and here they look swapped" in answer.json()["detail"]
    right = around(40.0, 120.1551, 28.9703)
    assert client.post("/check", json=DANCE | {"venue": right, "coordinates": "degrees"}).status_code == 200


def test_a_latitude_beyond_90_that_no_order_mends_is_refused_without_that_hint() -> None:
    geometry = {"type": "Polygon", "coordinates": [ring(120, 95, 121, 96)]}
    with pytest.raises(InvalidValue, match=r"must be at most 90 degrees, got 95 degrees$"):
        place_of(geometry, "degrees", Dragon())


@pytest.mark.parametrize("coordinates", ["metres", "degrees"])
@pytest.mark.parametrize("call", ["check", "figures/trajectory.svg", "figures/contact.svg"])
def test_coordinates_without_a_venue_are_refused(client: httpx.Client, call: str, coordinates: str) -> None:
    dance = {name: value for name, value in DANCE.items() if name != "stop"}
    answer = client.post(f"/{call}", json=dance | {"coordinates": coordinates})
    assert answer.status_code == 422
    (item,) = answer.json()["errors"]
    assert item["pointer"] == "/coordinates"
    assert f"got {coordinates} without one: give the venue, or leave coordinates out" in item["detail"]


@pytest.mark.parametrize("place", ["feature", "geometry"])
def test_a_coordinate_system_named_further_in_is_refused_and_not_overlooked(place: str) -> None:
    system = {"crs": {"type": "name", "properties": {"name": "EPSG:4326"}}}
    geometry = METRES | (system if place == "geometry" else {})
    feature = {"type": "Feature", "geometry": geometry} | (system if place == "feature" else {})
    field = "venue.features.0.crs" if place == "feature" else "venue.features.0.geometry.crs"
    with pytest.raises(InvalidValue, match=r"name it in venue\.crs") as refused:
        place_of({"type": "FeatureCollection", "features": [feature]}, None, Dragon())
    assert refused.value.field == field


# -- laid out ------------------------------------------------------------------------------------------------


def test_a_square_in_degrees_is_checked_like_the_same_one_in_metres(client: httpx.Client) -> None:
    there = client.post("/check", json=DANCE | {"venue": around(40.0), "coordinates": "degrees"}).json()
    here = client.post("/check", json=DANCE | {"venue": METRES}).json()
    assert there["verdict"] == here["verdict"] == "passes"
    assert here["origin"] is None
    assert there["origin"]["longitude"] == pytest.approx(LONGITUDE, abs=1e-12)
    assert there["origin"]["latitude"] == pytest.approx(LATITUDE, abs=1e-12)
    distances = [answer["venue"]["areas"][0]["nearest"]["distance"] for answer in (there, here)]
    assert distances[0] == pytest.approx(distances[1], abs=40.0 * 10 * SERIES)


@given(
    st.floats(-179.9, 179.9),
    st.floats(-80.0, 80.0),
    st.floats(-0.05, 0.05),
    st.floats(-0.05, 0.05),
    st.floats(0.01, 0.05),
)
def test_vertices_lie_where_the_slow_formula_puts_them(
    longitude: float, latitude: float, x: float, y: float, half: float
) -> None:
    box = ring(longitude - half, latitude - half, longitude + half, latitude + half)
    stall = ring(longitude + x, latitude + y, longitude + x + 1e-3, latitude + y + 1e-3)
    geometry = {
        "type": "GeometryCollection",
        "geometries": [{"type": "Polygon", "coordinates": [one]} for one in (box, stall)],
    }
    place = place_of(geometry, "degrees", Dragon())
    assert place.venue is not None
    assert place.origin is not None
    for area, outline in zip(place.venue.areas, (box, stall), strict=True):
        for (east, north), (lon, lat) in zip(area.rings[0], outline, strict=True):
            slow = east_north(place.origin, lon, lat)
            assert (east, north) == pytest.approx(slow, abs=PLACED)


def east_north(origin: GeographicOrigin, longitude: float, latitude: float) -> tuple[float, float]:
    """By the latitude and longitude alone, as in Torge and Mueller, Geodesy, section 6.2: e = n cos p sin(l - l0)."""
    squared = 1.0 - (1.0 - 1.0 / 298.257223563) ** 2
    p0, p, dl = math.radians(origin.latitude), math.radians(latitude), math.radians(longitude - origin.longitude)
    n0, n = (6_378_137.0 / math.sqrt(1.0 - squared * math.sin(one) ** 2) for one in (p0, p))
    east = n * math.cos(p) * math.sin(dl)
    north = n * (math.sin(p) * math.cos(p0) * (1.0 - squared) - math.cos(p) * math.sin(p0) * math.cos(dl))
    return east, north + squared * n0 * math.sin(p0) * math.cos(p0)


def test_lengths_are_those_on_the_ellipsoid() -> None:
    place = place_of(around(1_000.0), "degrees", Dragon())
    assert place.venue is not None
    corners = np.array(place.venue.square.rings[0])
    sides = np.hypot(*np.diff(corners, axis=0).T)
    assert sides[[1, 3]] == pytest.approx(2_000.0, rel=FLATNESS + SERIES)
    # the parallels to the south and the north are longer and shorter than the one in the middle
    assert sides[[0, 2]].mean() == pytest.approx(2_000.0, rel=FLATNESS + 2 * SERIES)
    assert sides[0] > 2_000.0 > sides[2]


def test_a_square_on_the_date_line_is_one_square() -> None:
    place = place_of({"type": "Polygon", "coordinates": [ring(179.9995, 10, -179.9995, 10.001)]}, "degrees", Dragon())
    assert place.venue is not None
    assert place.origin is not None
    assert abs(place.origin.longitude) == pytest.approx(180.0, abs=1e-9)
    assert np.abs(np.array(place.venue.square.rings[0])).max() < 60.0


# -- the member crs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        "urn:ogc:def:crs:OGC:1.3:CRS84",
        "EPSG:4326",
        "urn:ogc:def:crs:EPSG::4326",
        "urn:ogc:def:crs:EPSG::4490",
        "CRS:84",
    ],
)
def test_a_crs_of_longitude_and_latitude_is_believed(name: str) -> None:
    assert place_of(with_crs(name), None, Dragon()) == place_of(around(40.0), "degrees", Dragon())
    assert place_of(with_crs(name), "degrees", Dragon()).origin is not None
    with pytest.raises(InvalidValue) as refused:
        place_of(with_crs(name), "metres", Dragon())
    assert refused.value.field == "coordinates"


@pytest.mark.parametrize("name", ["EPSG:3857", "urn:ogc:def:crs:EPSG::32650", "EPSG:43260", "somewhere"])
def test_another_crs_is_refused_unless_the_user_says_that_it_is_in_metres(name: str) -> None:
    with pytest.raises(InvalidValue, match="longitude and latitude") as refused:
        place_of(METRES | {"crs": with_crs(name)["crs"]}, None, Dragon())
    assert refused.value.field == "venue.crs"
    assert place_of(METRES | {"crs": with_crs(name)["crs"]}, "metres", Dragon()) == place_of(METRES, None, Dragon())
    with pytest.raises(InvalidValue) as refused:
        place_of(with_crs(name), "degrees", Dragon())
    assert refused.value.field == "coordinates"


def test_no_crs_at_all_is_none() -> None:
    assert place_of(METRES | {"crs": None}, None, Dragon()) == place_of(METRES, None, Dragon())


@pytest.mark.parametrize("system", ["EPSG:4326", {"type": "link"}, {"type": "name", "properties": {}}, 4326, []])
def test_a_crs_that_names_none_is_refused(client: httpx.Client, system: Any) -> None:
    answer = client.post("/check", json=DANCE | {"venue": METRES | {"crs": system}})
    assert (answer.status_code, answer.json()["errors"][0]["pointer"]) == (422, "/venue/crs")


# -- what is wrong -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("box", "pointer", "words"),
    [
        (ring(28.0, 120.0, 28.001, 120.001), "/venue/coordinates/0/0/1", ("at most 90 degrees", "got 120 degrees")),
        (ring(181.0, 0.0, 181.001, 0.001), "/venue/coordinates/0/0/0", ("at most 180 degrees",)),
        (ring(120.0, 28.0, 120.3, 28.001), "/venue", ("at most 20 km across", "got about 29.49 km")),
        ([[120, 28], [120.001, 28], [120.001]], "/venue/coordinates/0/2", ("[longitude, latitude] in degrees",)),
        ([[120, 28], [120.001, 28.001], [120.001, 28], [120, 28.001], [120, 28]], "/venue", ("self-intersection",)),
        ([[120, 28], [120.001, 28], [120.001, 28.001]], "/venue", ("must be closed",)),
    ],
    ids=["latitude first", "longitude", "too wide", "no position", "crossed", "open"],
)
def test_what_is_no_venue_in_degrees_is_named(
    client: httpx.Client, box: list[list[float]], pointer: str, words: tuple[str, ...]
) -> None:
    venue = {"type": "Polygon", "coordinates": [box]}
    answer = client.post("/check", json=DANCE | {"venue": venue, "coordinates": "degrees"})
    assert answer.status_code == 422
    (item,) = answer.json()["errors"]
    assert item["pointer"] == pointer
    assert [word for word in words if word not in item["detail"]] == []


def test_the_limit_of_a_venue_is_where_it_says() -> None:
    for factor, is_read in ((0.99, True), (1.01, False)):
        square = around(0.5 * factor * ACROSS_MAX, latitude=0.1)
        if is_read:
            assert place_of(square, "degrees", Dragon()).venue is not None
        else:
            with pytest.raises(InvalidValue, match="at most 20 km across"):
                place_of(square, "degrees", Dragon())


# -- on the command line -------------------------------------------------------------------------------------


def test_the_command_takes_a_venue_in_degrees(tmp_path: Path) -> None:
    (tmp_path / "square.geojson").write_text(json.dumps(around(40.0)))
    file = tmp_path / "dance.toml"
    dance = 'stop = 20\nvenue = "square.geojson"\n{}\n[dragon]\nbenches = 20\n[path]\npitch = 1.7\nstart_turns = 6\n'
    file.write_text(dance.format('coordinates = "degrees"'))
    assert json.loads(answer_of("check", str(file), "--json"))["origin"]["longitude"] == pytest.approx(LONGITUDE)
    output = answer_of("check", str(file))
    assert "x = y = 0 is longitude 120.155100, latitude 28.970300" in output
    file.write_text(dance.format(""))
    done = run("check", str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert "longitude and latitude" in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_core_itself_knows_metres_alone() -> None:
    place = place_of(around(40.0), "degrees", Dragon(20))
    report = check(Dance(Dragon(20), CoreSpiral(1.7, 6.0)), venue=place.venue, stop=20.0)
    assert report.passed


@pytest.mark.parametrize(("metres", "latitude", "apart"), [(100.0, 30.0, 0.0001), (2_000.0, 60.0, 0.14)])
def test_an_edge_along_a_parallel_bends_as_far_as_the_pages_say(metres: float, latitude: float, apart: float) -> None:
    plane = Plane(GeographicOrigin(119.0, latitude))
    half = 0.5 * metres / 111_320.0 / math.cos(math.radians(latitude))
    begin, middle, end = plane.metres(np.array([[119.0 - half, latitude], [119.0, latitude], [119.0 + half, latitude]]))
    assert np.hypot(*(middle - 0.5 * (begin + end))) == pytest.approx(apart, rel=0.2)

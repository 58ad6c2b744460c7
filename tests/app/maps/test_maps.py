"""Maps: written files read back unchanged, files of other programs are understood, hostile ones refused at once."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import ezdxf
import httpx
import numpy as np
import pytest

from app.files.tables import Language
from app.files.words import Say
from app.maps.layout import DanceParts
from app.maps.places import places_of
from app.questions.maps import MapFormat, MapsRequest
from app.settings import Settings
from core import InvalidValue
from core.shapes.engines import GROWTH_MOST
from tests.conftest import ROOT
from tests.support.command import run

SAY = Say(Language.ENGLISH)
# Rounding of degrees in doubles, on places 10,000 km from the centre of the earth [m].
ROUNDING = 1e-7
ORIGIN = {"longitude": 120.123, "latitude": 30.25}
VILLAGE = json.loads((ROOT / "examples" / "village_square.geojson").read_text())
CORNER = {"kind": "route", "start": 9.0, "pieces": [
    {"kind": "line", "start": [-12.0, -8.0], "end": [0.0, -8.0]},
    {"kind": "arc", "centre": [0.0, -3.0], "radius": 5.0, "start_angle": -1.5707963267948966, "sweep": 1.5},
]}  # fmt: skip
PATHS: list[dict[str, Any]] = [
    CORNER,
    {"kind": "spiral", "pitch": 1.0, "start_turns": 3.0, "centre": [2.0, 1.0], "rotation": 0.5, "clockwise": False},
    {"kind": "turn", "pitch": 1.7, "start_turns": 4.0},
]


def read(data: bytes, units: Any = None) -> DanceParts:
    return places_of(data, units, SAY)


def rings(result: DanceParts) -> list[Any]:
    assert result.venue is not None
    return [np.array(ring) for area in result.venue.areas for ring in area.rings]


@pytest.mark.parametrize("format", MapFormat)
@pytest.mark.parametrize("path", PATHS, ids=lambda path: path["kind"])
def test_what_goes_out_comes_in_as_it_was(client: httpx.Client, format: str, path: dict[str, Any]) -> None:
    body = {"dragon": {"benches": 2}, "path": path, "venue": VILLAGE, "origin": ORIGIN}
    data = client.post(f"/maps.{format}", json=body).raise_for_status().content
    headers = {"Content-Type": "application/octet-stream"}
    got = client.post("/places", content=data, headers=headers).raise_for_status().json()
    values = {name: value for name, value in got["path"].items() if path.get(name) is not None}
    assert values == path
    assert got["venue"]["origin"] == ORIGIN
    came = [(one["properties"]["name"], one["geometry"]["coordinates"]) for one in got["venue"]["features"]]
    assert [name for name, _ in came] == [one["properties"]["name"] for one in VILLAGE["features"]]
    for (_, result), one in zip(came, VILLAGE["features"], strict=True):
        assert np.abs(np.array(result) - np.array(one["geometry"]["coordinates"])).max() < ROUNDING
    # The answer can be sent back, and knows where it is.
    again = {"dragon": {"benches": 2}, "path": got["path"], "venue": got["venue"]}
    assert client.post("/maps.kml", json=again).raise_for_status().content.startswith(b"<?xml")


def thing(name: str, kind: str, coordinates: Any, radius: float | None = None) -> dict[str, Any]:
    properties = {"name": name} | ({} if radius is None else {"radius": radius})
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


THINGS = [
    thing("square", "Polygon", [[[-30, -30], [30, -30], [30, 30], [-30, 30], [-30, -30]]]),
    thing("elm", "Point", [10.5, 4.25], 0.7),
    thing("wall", "LineString", [[-20, 10], [-10, 12], [0, 10]], 0.15),
    thing("ring wall", "LineString", [[20, 20], [25, 20], [25, 25], [20, 20]], 0.2),
    thing("stage", "Polygon", [[[-20, -20], [-15, -20], [-15, -15], [-20, -20]]]),
]


@pytest.mark.parametrize(
    ("format", "origin"),
    [("geojson", None), ("geojson", ORIGIN), ("kml", ORIGIN), ("dxf", None), ("dxf", ORIGIN)],
    ids=lambda part: part if isinstance(part, str) else "degrees" if part else "metres",
)
def test_trees_and_walls_come_back_as_they_were(
    client: httpx.Client, format: str, origin: dict[str, float] | None
) -> None:
    body = {"dragon": {"benches": 2}, "path": CORNER, "venue": {"type": "FeatureCollection", "features": THINGS}}
    data = client.post(f"/maps.{format}", json=body | {"origin": origin}).raise_for_status().content
    result = read(data)
    assert result.geometry is not None
    assert not any("without a radius" in note for note in result.notes)
    for got, put in zip(result.geometry["features"], THINGS, strict=True):
        assert (got["properties"], got["geometry"]["type"]) == (put["properties"], put["geometry"]["type"])
        came, was = (np.array(one["geometry"]["coordinates"]) for one in (got, put))
        assert came.shape == was.shape
        assert np.abs(came - was).max() < ROUNDING
    # So they do from a file that describes the dance.
    again = read(json.dumps({"venue": result.geometry}).encode())
    assert again.geometry == result.geometry
    assert again.venue == result.venue


def test_trees_and_walls_of_a_drawing_are_as_wide_as_they_are(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 2}, "path": CORNER, "venue": {"type": "FeatureCollection", "features": THINGS}}
    data = client.post("/maps.dxf", json=body).raise_for_status().text
    space = ezdxf.read(io.StringIO(data)).modelspace()
    walls = [one.dxf.const_width for one in space.query("LWPOLYLINE") if one.dxf.hasattr("const_width")]
    assert walls == [0.3, 0.4]
    assert [one.dxf.radius for one in space.query("CIRCLE[layer=='OBSTACLES']")] == [0.7]


def test_marks_stand_every_five_metres_of_the_path(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 2}, "path": CORNER}
    answer = client.post("/maps.geojson", json=body).raise_for_status().json()
    marks = [one for one in answer["features"] if one["properties"]["role"] == "mark"]
    assert [one["properties"]["name"] for one in marks] == ["0", "5", "10", "15"]
    # 15 m along: 3 m into the arc of radius 5 m around (0, -3).
    angle = -np.pi / 2 + 3.0 / 5.0
    expected = [-12, -8], [-7, -8], [-2, -8], [5 * np.cos(angle), -3 + 5 * np.sin(angle)]
    assert np.array([one["geometry"]["coordinates"] for one in marks]) == pytest.approx(np.array(expected))
    refused = client.post("/maps.kml", json=body)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == "/origin"
    assert client.post("/maps.shp", json=body).status_code == 404


def test_a_path_whose_line_was_moved_goes_through_the_line() -> None:
    line = [[0.0, 0.0], [10.0, 1.0], [20.0, 0.0]]
    straight = {"kind": "waypoints", "points": [[0.0, 0.0], [20.0, 0.0]]}
    feature = {"type": "Feature", "properties": {"name": "path", "path": straight},
               "geometry": {"type": "LineString", "coordinates": line}}  # fmt: skip
    result = read(json.dumps(feature).encode())
    assert result.path == {"kind": "waypoints", "points": line}
    assert "edited" in result.notes[1]


KML = """<kml xmlns="http://www.opengis.net/kml/2.2"><Document><name>Temple</name>
<Folder><name>Trees</name><Placemark><name>camphor</name>
<ExtendedData><Data name="radius"><value>0.8</value></Data></ExtendedData>
<Point><coordinates>120.0001,30.0001,5</coordinates></Point></Placemark></Folder>
<Placemark><name>square</name><Polygon><outerBoundaryIs><LinearRing><coordinates>
120,30 120.0004,30 120.0004,30.0003 120,30.0003 120,30
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>
<Placemark><name>Route</name><LineString><coordinates>
120.0001,30.0002 120.0003,30.0002</coordinates></LineString></Placemark>
<Placemark><GroundOverlay/></Placemark></Document></kml>"""


def test_a_map_drawn_on_a_phone_is_understood() -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("doc.kml", KML)
    for data in (KML.encode(), packed.getvalue()):
        result = read(data)
        assert result.venue is not None
        assert [area.name for area in result.venue.areas] == ["square", "camphor"]
        square, tree = rings(result)
        # A degree of longitude is 96,486 m at a latitude of 30 degrees, one of latitude 110,852 m.
        assert np.ptp(square, axis=0) == pytest.approx([0.0004 * 96_486, 0.0003 * 110_852], rel=1e-3)
        centre = np.array([-0.0001 * 96_486, -0.00005 * 110_852])
        away = np.hypot(*(tree - centre).T)
        assert away.min() > 0.79
        assert away.max() < 0.83
        assert result.path is not None
        assert result.path["points"][0] == pytest.approx([-0.0001 * 96_486, 0.00005 * 110_852], rel=1e-2)
        assert result.origin is not None
        assert (result.origin.longitude, result.origin.latitude) == pytest.approx((120.0002, 30.00015))
        assert "Left out: 1 GroundOverlay." in result.notes


def drawing() -> bytes:
    """A foreign drawing in millimetres: a court with an arched side, a tree as a block, a well, a wall, words."""
    document = ezdxf.new("R2010", units=ezdxf.units.MM)
    space = document.modelspace()
    court = space.add_lwpolyline([(0, 0), (40_000, 0), (40_000, 30_000), (0, 30_000)], close=True)
    court.set_points([(0, 0, 0), (40_000, 0, 0.2), (40_000, 30_000, 0), (0, 30_000, 0)], format="xyb")
    tree = document.blocks.new("TREE")
    tree.add_circle((0, 0), 500)
    space.add_blockref("TREE", (10_000, 10_000))
    space.add_circle((20_000, 10_000), 1_500)
    space.add_text("well", dxfattribs={"insert": (20_000, 10_000), "height": 500})
    space.add_line((5_000, 20_000), (9_000, 20_000), dxfattribs={"layer": "Walls"})
    space.add_lwpolyline([(5_000, 5_000), (30_000, 5_000)], dxfattribs={"layer": "PATH"})
    space.add_3dface([(0, 0), (1, 0), (1, 1)])
    sink = io.StringIO()
    document.write(sink)
    return sink.getvalue().encode()


def test_a_foreign_drawing_is_understood() -> None:
    result = read(drawing())
    assert result.venue is not None
    assert [area.name for area in result.venue.areas] == ["square", "obstacle 1", "well", "obstacle 3"]
    square, tree, well, wall = rings(result)
    assert np.ptp(square[:, 1]) == pytest.approx(30.0)
    # A bulge of 0.2 on a side of 30 m reaches 0.2 x 15 m beyond it.
    assert square[:, 0].max() == pytest.approx(43.0, abs=0.01)
    assert tree.mean(axis=0) == pytest.approx([10.0, 10.0], abs=0.1)
    assert np.ptp(well[:, 0]) == pytest.approx(3.0, rel=0.02)  # as far as the polygon of a circle may exceed it
    assert np.ptp(wall, axis=0) == pytest.approx([4.2, 0.2], rel=GROWTH_MOST - 1.0)
    assert result.path == {"kind": "waypoints", "points": [[5.0, 5.0], [30.0, 5.0]]}
    assert "Left out: 1 3DFACE." in result.notes


@pytest.mark.parametrize("version", ["R12", "R2010"])
def test_a_drawing_without_a_unit_is_in_metres_or_refused_where_it_cannot_be(version: str) -> None:
    for across, fits in ((60.0, True), (2_000.0, True), (60_000.0, False)):
        document = ezdxf.new(version, units=ezdxf.units.M)
        document.header["$INSUNITS"] = 0
        square = [(0.0, 0.0), (across, 0.0), (across, 40.0), (0.0, 40.0)]
        document.modelspace().add_polyline2d(square, close=True, dxfattribs={"layer": "square"})
        sink = io.StringIO()
        document.write(sink)
        if fits:
            assert rings(read(sink.getvalue().encode()))[0].max(axis=0).tolist() == [across, 40.0]
            continue
        with pytest.raises(InvalidValue, match=r"file must state its unit: .* is 60000 across"):
            read(sink.getvalue().encode())


def test_the_unit_follows_from_the_range_or_from_the_request() -> None:
    small = {"type": "Polygon", "coordinates": [[[10.0, 20.0], [10.1, 20.0], [10.1, 20.1], [10.0, 20.0]]]}
    data = json.dumps(small).encode()
    assert np.ptp(rings(read(data))[0], axis=0) == pytest.approx([10_450, 11_070], rel=2e-3)
    assert np.ptp(rings(read(data, "metres"))[0], axis=0) == pytest.approx([0.1, 0.1])
    assert rings(read(json.dumps(VILLAGE).encode()))[0].max() == 65.0


def test_points_alone_get_a_square_around_them_and_a_radius_that_is_said() -> None:
    points = {"type": "MultiPoint", "coordinates": [[0.0, 0.0], [300.0, 40.0]]}
    result = read(json.dumps(points).encode())
    assert result.venue is not None
    assert rings(result)[0].min(axis=0).tolist() == [-20.0, -20.0]
    assert [area.name for area in result.venue.obstacles] == ["obstacle 1", "obstacle 2"]
    assert any("2 things without a radius; 0.5 m is assumed" in note for note in result.notes)
    # They stay points with a radius, for a request and for whoever moves them.
    assert result.geometry is not None
    thing = result.geometry["features"][2]
    assert thing["geometry"] == {"type": "Point", "coordinates": [300.0, 40.0]}
    assert thing["properties"] == {"name": "obstacle 2", "radius": 0.5}


def test_swapped_longitude_and_latitude_are_refused_as_such() -> None:
    place = {"type": "Polygon", "coordinates": [[[29.1, 119.6], [29.101, 119.6], [29.101, 119.601], [29.1, 119.6]]]}
    with pytest.raises(InvalidValue, match="longitude and latitude seem to be swapped"):
        read(json.dumps(place).encode())


def placemark(inner: str, before: str = "") -> str:
    return (
        f'<kml xmlns="http://www.opengis.net/kml/2.2"><Document>{before}<Placemark>{inner}</Placemark></Document></kml>'
    )


def outline(coordinates: str) -> str:
    ring = f"<LinearRing><coordinates>{coordinates}</coordinates></LinearRing>"
    return f"<Polygon><outerBoundaryIs>{ring}</outerBoundaryIs></Polygon>"


CORNERS = "119.640,29.110,0 119.641,29.110,0 119.641,29.111,0 119.640,29.111,0 119.640,29.110,0"


@pytest.mark.parametrize("coding", ["GBK", "GB18030", "big5", "utf-16", "utf-8"])
def test_the_name_of_a_square_is_read_in_the_encoding_that_the_file_states(client: httpx.Client, coding: str) -> None:
    name = {"big5": "廣場"}.get(coding, "广场")
    text = f'<?xml version="1.0" encoding="{coding}"?>{placemark(f"<name>{name}</name>{outline(CORNERS)}")}'
    headers = {"Content-Type": "application/vnd.google-earth.kml+xml"}
    answer = client.post("/places", content=text.encode(coding), headers=headers)
    assert answer.status_code == 200, answer.text
    assert answer.json()["venue"]["features"][0]["properties"]["name"] == name


@pytest.mark.parametrize("archived", [False, True])
def test_a_map_that_states_no_encoding_is_read_as_chinese_programs_write_it(archived: bool) -> None:
    data = placemark(f"<name>广场</name>{outline(CORNERS)}").encode("gbk")
    if archived:
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as archive:
            archive.writestr("doc.kml", data)
        data = packed.getvalue()
    result = read(data)
    assert result.venue is not None
    assert result.venue.square.name == "广场"
    assert "The file is not in UTF-8; it was read as GB 18030." in result.notes


@pytest.mark.parametrize("coding", ["utf-16", "gb18030"])
@pytest.mark.parametrize("form", ["geojson", "toml"])
def test_text_of_chinese_and_windows_programs_is_read(coding: str, form: str) -> None:
    text = 'path = {kind = "spiral", pitch = 1.5}\nname = "龙"\n'
    if form == "geojson":
        square = {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [90, 95], [0, 0]]]}
        text = json.dumps({"type": "Feature", "properties": {"name": "广场"}, "geometry": square}, ensure_ascii=False)
    result = read(text.encode(coding))
    if form == "geojson":
        assert result.venue is not None
        assert result.venue.square.name == "广场"
    else:
        assert result.dance == {"name": "龙"}
    assert ("The file is not in UTF-8; it was read as GB 18030." in result.notes) == (coding == "gb18030")


@pytest.mark.parametrize(
    "inner",
    [outline(" "), "<Point><coordinates/></Point>", "<LineString><coordinates></coordinates></LineString>", ""],
    ids=["polygon", "point", "line", "nothing"],
)
def test_a_map_of_nothing_is_refused(client: httpx.Client, inner: str) -> None:
    headers = {"Content-Type": "application/vnd.google-earth.kml+xml"}
    answer = client.post("/places", content=placemark(inner).encode(), headers=headers)
    assert answer.status_code == 422
    assert answer.json()["detail"] == "file must hold a polygon, a line or a point, got none of these"


def test_what_is_empty_or_hidden_is_left_out_and_reported() -> None:
    point = "<Point><coordinates>119.6405,29.1105</coordinates></Point>"
    hidden = f"<Folder><visibility>0</visibility><Placemark>{point}</Placemark></Folder>"
    hidden += f"<Placemark><visibility>0</visibility>{point}</Placemark>"
    lone = f"<Placemark>{outline(' ')}</Placemark>"
    result = read(placemark(f"<name>square</name>{outline(CORNERS)}", hidden + lone).encode())
    assert result.venue is not None
    assert result.venue.obstacles == ()
    assert {"Left out, because hidden: 2 points.", "Left out: 1 empty Polygon."} <= set(result.notes)


def test_commas_between_points_are_named() -> None:
    line = "119.6402,29.1102,0,119.6403,29.1103,0\n119.6405,29.1104,0,119.6406,29.1105,0\n119.6408,29.1108,0"
    inner = f"<LineString><coordinates>{line}</coordinates></LineString>"
    with pytest.raises(InvalidValue, match=r"must have a space between two points.*got '119.6402,29.1102,0,119.6403"):
        read(placemark(inner).encode())


def test_a_name_in_the_data_is_the_name_where_there_is_no_other() -> None:
    data = '<ExtendedData><Data name="name"><value>old elm</value></Data></ExtendedData>'
    point = "<Point><coordinates>119.6405,29.1105</coordinates></Point>"
    square = f"<Placemark><name>square</name>{outline(CORNERS)}</Placemark>"
    for own, name in (("", "old elm"), ("<name>elm 7</name>", "elm 7")):
        result = read(placemark(own + data + point, square).encode())
        assert result.venue is not None
        assert [area.name for area in result.venue.obstacles] == [name]


def test_a_square_at_the_date_line_is_as_small_as_it_is(client: httpx.Client) -> None:
    ring = [[179.9995, 0], [-179.9995, 0], [-179.9995, 0.001], [179.9995, 0.001], [179.9995, 0]]
    tree = {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [-179.9999, 0.0005]}}
    square = {
        "type": "Feature",
        "properties": {"name": "square"},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    result = read(json.dumps({"type": "FeatureCollection", "features": [square, tree]}).encode())
    assert np.ptp(rings(result)[0], axis=0) == pytest.approx([111.3, 110.6], abs=0.1)
    assert result.origin is not None
    assert abs(result.origin.longitude) == pytest.approx(180.0)
    assert rings(result)[1].mean(axis=0) == pytest.approx([11.1, 0.0], abs=0.2)
    answer = client.post("/check", json={"dragon": {"benches": 2}, "venue": result.geometry})
    assert answer.status_code == 200, answer.text


@pytest.mark.parametrize("across", [0.0003, 0.1, 0.3, 3.0, 3.5, 60.0])
def test_places_and_check_agree_about_degrees(client: httpx.Client, across: float) -> None:
    x, y = 119.5, 29.0
    ring = [[x, y], [x + across, y], [x + across, y + across], [x, y + across], [x, y]]
    square = {"type": "Polygon", "coordinates": [ring]}
    checked = client.post("/check", json={"dragon": {"benches": 2}, "venue": square})
    taken_for_degrees = "looks like longitude and latitude" in checked.text
    if across in (0.3, 3.0):
        with pytest.raises(
            InvalidValue, match=r"file must be at most 20 km across.*if they are metres, give the units metres"
        ):
            read(json.dumps(square).encode())
        assert taken_for_degrees
        return
    result = read(json.dumps(square).encode())
    assert (result.origin is not None) == taken_for_degrees
    again = client.post("/check", json={"dragon": {"benches": 2}, "venue": result.geometry})
    assert again.status_code == 200, again.text


def test_a_square_that_check_refuses_is_noted() -> None:
    square = {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 0]]]}
    result = read(json.dumps(square).encode(), "metres")
    assert any("narrower than a bench of 3.41 m: check refuses it" in note for note in result.notes)


def zipped(size: int) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("doc.kml", b"<kml>" + b" " * size)
    return sink.getvalue()


def broken(place: int, changed: bytes, method: int = zipfile.ZIP_STORED) -> bytes:
    """A KMZ file with other bytes at a place of its record in the directory; method: stated in both of its records"""
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w") as archive:
        archive.writestr("doc.kml", b"<kml/>")
    data = bytearray(sink.getvalue())
    local, directory = data.index(b"PK\3\4"), data.index(b"PK\1\2")
    data[local + 8 : local + 10] = data[directory + 10 : directory + 12] = method.to_bytes(2, "little")
    data[directory + place : directory + place + len(changed)] = changed
    return bytes(data)


BOMB = '<!DOCTYPE k [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]><kml>&b;</kml>'


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (BOMB.encode(), "must not have a document type or entities"),
        (b'<!DOCTYPE k SYSTEM "file:///etc/passwd"><kml/>', "must not have a document type or entities"),
        (b"<kml>" + b"<Folder>" * 100_000, "must not nest elements deeper than 60"),
        (zipped(21_000_000), "must unpack to at most 20000000 bytes"),
        (b"PK\x03\x04broken", "must be a KMZ file that can be unpacked"),
        # A directory 500 bytes further than it is, a name that is not the UTF-8 it claims to be, and wrong methods.
        (broken(0, b"")[:-6] + b"\xff\xff\0\0\0\0", "must be a KMZ file that can be unpacked"),
        (broken(8, b"\0\x08", 0).replace(b"doc.kml", b"d\xff\xfe.kml"), "must be a KMZ file that can be unpacked"),
        (broken(0, b"", zipfile.ZIP_BZIP2), "must be a KMZ file that can be unpacked"),
        (broken(0, b"", zipfile.ZIP_LZMA), "must be a KMZ file that can be unpacked"),
        (zipped(0).replace(b"doc.kml", b"doc.txt"), "must be a KMZ file with a .kml document"),
        (b"<svg/>", "got XML of another kind"),
        (b"AC1027" + b"\0" * 100, "got DWG"),
        (b"0\nSECTION\nnonsense", "file must be DXF"),
        (b"\x00\xff\xfe", "got none of these"),
        (b"", "got nothing"),
        (b"margin = 0x" + b"f" * 9000, "has a whole number of more than 64 bits"),
        (b"dragon = {names = [{a = -inf}]}", "file must have finite numbers, got -inf"),
        (b"venue = 5", "a venue that is GeoJSON or the name of a file"),
        (b'{"type": "Point", "coordinates": [1e400, 2]}', "file"),
        (b'{"type": "Polygon", "coordinates": [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]]}', "self-intersection"),
        (b'{"type": "Topology"}', "file.type must be one of"),
        (b'path = {kind = "spiral", pitch = "wide"}', "pitch must be a number"),
        (json.dumps({"type": "MultiPoint", "coordinates": [[k, k] for k in range(20_000)]}).encode(), "at most 10000"),
    ],
)
def test_a_file_that_cannot_be_used_is_refused_in_words(data: bytes, words: str) -> None:
    with pytest.raises(InvalidValue, match=words) as refused:
        read(data)
    assert refused.value.field.partition(".")[0] == "file"


@pytest.mark.parametrize(
    ("query", "headers", "status", "words"),
    [
        ({}, {"Content-Type": "image/png"}, 415, "The body must be the file itself"),
        ({"units": "feet"}, {}, 422, "units must be"),
        ({}, {}, 422, "file must not have a document type"),
    ],
)
def test_the_service_refuses_in_problem_details(
    client: httpx.Client, query: dict[str, str], headers: dict[str, str], status: int, words: str
) -> None:
    own_headers = {"Content-Type": "application/vnd.google-earth.kml+xml"} | headers
    answer = client.post("/places", content=BOMB, params=query, headers=own_headers)
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")
    assert words in answer.json()["detail"]


def test_the_command_takes_a_map_for_a_dance_and_gives_one(tmp_path: Path) -> None:
    (tmp_path / "temple.kml").write_text(KML)
    dance = tmp_path / "dance.toml"
    dance.write_text('venue = "temple.kml"\npath = "temple.kml"\nmargin = 0.2\n[dragon]\nbenches = 4\n')
    checked = run("check", str(dance), "--json")
    assert checked.returncode == 0, checked.stderr
    assert json.loads(checked.stdout)["origin"] == pytest.approx({"longitude": 120.0002, "latitude": 30.00015})
    assert "temple.kml: Longitude and latitude were converted to metres" in checked.stderr
    done = run("maps", str(dance), "--output", str(tmp_path / "dance.dxf"))
    assert (done.returncode, done.stdout) == (0, "")
    back = run("places", str(tmp_path / "dance.dxf"), "--output", str(tmp_path / "again.json"))
    assert "camphor" in back.stdout
    again = json.loads((tmp_path / "again.json").read_text())
    assert (again["path"]["kind"], len(again["venue"]["features"])) == ("waypoints", 2)


# -- several dances ------------------------------------------------------------------------------------------

LANE = {"kind": "route", "pieces": [{"kind": "line", "start": [-14.0, 6.0], "end": [14.0, 6.0]}]}
TWO: dict[str, Any] = {
    "dances": [
        {"name": "low", "dragon": {"benches": 2}, "path": CORNER},
        {"dragon": {"benches": 3}, "path": LANE, "delay": 9},
    ],
    "venue": VILLAGE,
    "origin": ORIGIN,
    "spacing": 2,
}


def test_a_map_of_several_dances_has_the_path_and_the_marks_of_each(client: httpx.Client) -> None:
    performance, _ = MapsRequest.model_validate(TWO).to_placed(Settings())
    features = client.post("/maps.geojson", json=TWO).raise_for_status().json()["features"]
    lines = [one for one in features if one["properties"]["role"] == "path"]
    assert [one["properties"]["name"] for one in lines] == ["low path", "1 path"]
    for k, (line, dance) in enumerate(zip(lines, TWO["dances"], strict=True)):
        start, stop = performance.parts[k].own_span(*performance.span())
        alone = {name: TWO[name] for name in ("venue", "origin", "spacing")} | {"start": start, "stop": stop}
        alone |= {name: dance[name] for name in ("dragon", "path")}
        own = client.post("/maps.geojson", json=alone).raise_for_status().json()["features"]
        (path,) = (one for one in own if one["properties"]["role"] == "path")
        assert (line["geometry"], line["properties"]["path"]) == (path["geometry"], path["properties"]["path"])
        assert (line["properties"]["dragon"], line["properties"]["dragon_name"]) == (k, dance.get("name"))
        marks, own_marks = (
            [one for one in some if one["properties"]["role"] == "mark" and one["properties"].get("dragon", k) == k]
            for some in (features, own)
        )
        assert [one["geometry"] for one in marks] == [one["geometry"] for one in own_marks]
        before = dance.get("name") or k
        names = [f"{before} {one['properties']['name']}" for one in own_marks]
        assert [one["properties"]["name"] for one in marks] == names
        assert len(marks) > 3


@pytest.mark.parametrize("format", MapFormat)
def test_a_map_of_several_is_read_with_its_first_path_and_a_note(client: httpx.Client, format: str) -> None:
    result = read(client.post(f"/maps.{format}", json=TWO).raise_for_status().content)
    assert result.path is not None
    assert {name: value for name, value in result.path.items() if name in CORNER} == CORNER
    assert "2 lines are called path; the first is the path, and the others are left out." in result.notes
    assert result.venue is not None
    assert len(result.venue.areas) == len(VILLAGE["features"])


def test_the_command_writes_the_map_of_several(client: httpx.Client, tmp_path: Path) -> None:
    file, output = tmp_path / "two.json", tmp_path / "two.kml"
    file.write_text(json.dumps(TWO))
    assert run("maps", str(file), "--output", str(output)).returncode == 0
    assert output.read_bytes() == client.post("/maps.kml", json=TWO).content
    many = client.post(
        "/maps.kml", json=TWO | {"spacing": 0.5, "dances": [TWO["dances"][1] | {"delay": k} for k in range(40)]}
    )
    assert many.json()["errors"][0]["detail"].startswith("marks must be at most 2000 here, got 2280")

"""Maps: written files read back unchanged, files of other programs are understood, hostile ones refused at once."""

import io
import json
import zipfile
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from app.maps.places import places_of
from app.questions.maps import MapFormat, MapsRequest
from app.settings import Settings
from core import InvalidValue
from tests.conftest import ROOT
from tests.support.asking import assert_problem, box
from tests.support.command import run, said
from tests.support.near import assert_near
from tests.support.refusal_rows import assert_refused

# Rounding of degrees in doubles, on places 10,000 km from the centre of the earth [m].
ROUNDING = 1e-7
OWN = ("name", "radius", "role", "heading", "use", "street_length")
ORIGIN = {"longitude": 120.123, "latitude": 30.25}
VILLAGE = json.loads((ROOT / "examples" / "village_square.geojson").read_text())
PATHS = json.loads("""[
    {"kind": "route", "start": 9.0, "pieces": [
        {"kind": "line", "start": [-12.0, -8.0], "end": [0.0, -8.0]},
        {"kind": "arc", "centre": [0.0, -3.0], "radius": 5.0, "start_angle": -1.5707963267948966, "sweep": 1.5}]},
    {"kind": "spiral", "pitch": 1.0, "start_turns": 3.0, "centre": [2.0, 1.0], "rotation": 0.5, "clockwise": false},
    {"kind": "turn", "pitch": 1.7, "start_turns": 4.0}
]""")
CORNER = PATHS[0]


def read(data, units=None):
    return places_of(data, units)


def read_json(value, units=None):
    return read(json.dumps(value).encode(), units)


def rings(result):
    return [np.array(ring) for area in result.venue.areas for ring in area.rings]


def names(result):
    return [area.name for area in result.venue.areas]


def things(result):
    """Form, coordinates and radius of the obstacles."""
    values = [(one["properties"], one["geometry"]) for one in result.geometry["features"][1:]]
    return [(form["type"], form["coordinates"], own.get("radius")) for own, form in values]


def map_of(client, form, **body):
    return client.post(f"/maps.{form}", json={"dragon": {"benches": 2}, **body}).raise_for_status()


def posted(client, data, kind="application/octet-stream"):
    return client.post("/places", content=data, headers={"Content-Type": kind}).raise_for_status().json()


def assert_alike(features, others):
    """The same shapes with the same names, radii, roles and properties of gates, at the same places."""
    for feature, other in zip(features, others, strict=True):
        own, expected = ([one["properties"].get(name) for name in OWN] for one in (feature, other))
        assert own == expected
        assert feature["geometry"]["type"] == other["geometry"]["type"]
        places, expected = (np.array(each["geometry"]["coordinates"]) for each in (feature, other))
        assert_near(places, expected, ROUNDING)


THINGS = VILLAGE["features"] + json.loads("""[
    {"type": "Feature", "properties": {"name": "elm", "radius": 0.7}, "geometry":
        {"type": "Point", "coordinates": [10.5, 4.25]}},
    {"type": "Feature", "properties": {"name": "wall", "radius": 0.15}, "geometry":
        {"type": "LineString", "coordinates": [[-20, 10], [-10, 12], [0, 10]]}},
    {"type": "Feature", "properties": {"name": "ring wall", "radius": 0.2}, "geometry":
        {"type": "LineString", "coordinates": [[20, 20], [25, 20], [25, 25], [20, 20]]}}
]""")
COLLECTION = {"type": "FeatureCollection", "features": THINGS}
# What stands in a venue for people: gates, one of them with a heading, and the square without streets.
ASIDES = json.loads("""[
    {"type": "Feature", "properties": {"name": "West", "role": "gate"}, "geometry":
        {"type": "Point", "coordinates": [-20, 2]}},
    {"type": "Feature", "properties":
        {"name": "东门", "role": "gate", "heading": 3.5, "use": "out", "street_length": 60.0}, "geometry":
        {"type": "Point", "coordinates": [20, 3.25]}},
    {"type": "Feature", "properties": {"name": "ambulances", "role": "emergency lane", "radius": 1.5}, "geometry":
        {"type": "LineString", "coordinates": [[-20, -5], [0, -5], [20, 1]]}},
    {"type": "Feature", "properties": {"role": "square without streets"}, "geometry":
        {"type": "LineString", "coordinates": [[-20, -15], [20, -15], [20, 15], [-20, -15]]}}
]""")


@pytest.mark.parametrize("format", MapFormat)
@pytest.mark.parametrize("path", PATHS, ids=lambda path: path["kind"])
def test_what_goes_out_comes_in_as_it_was(client, format, path):
    venue = {"type": "FeatureCollection", "features": THINGS + ASIDES}
    for origin in (ORIGIN, None)[: 1 if format == "kml" else 2]:
        got = posted(client, map_of(client, format, path=path, venue=venue, origin=origin).content)
        assert {name: value for name, value in got["path"].items() if path.get(name) is not None} == path
        assert got["venue"].get("origin") == origin
        assert_alike(got["venue"]["features"], THINGS + ASIDES)
        assert not any("without a radius" in note for note in got["notes"])
        # The answer can be sent back, and knows where it is; so it can as a file that describes the dance.
        again = {"path": got["path"], "venue": got["venue"]}
        assert origin is None or map_of(client, "kml", **again).content.startswith(b"<?xml")
        assert_alike(read_json(again).geometry["features"], THINGS + ASIDES)


def thing(name, kind, coordinates):
    return {"type": "Feature", "properties": {"name": name}, "geometry": {"type": kind, "coordinates": coordinates}}


@pytest.mark.parametrize("width", [0.0, 4.0], ids=["an outline", "a line with a width"])
def test_a_lane_is_read_from_its_layer_as_a_line_with_a_width(width):
    document = ezdxf.new()
    space = document.modelspace()
    space.add_lwpolyline([(-30, -30), (30, -30), (30, 30), (-30, 30)], close=True, dxfattribs={"layer": "SQUARE"})
    fire = {"layer": "Fire Lane", "const_width": width}
    if width:
        space.add_lwpolyline([(-28, 0), (0, 0), (28, 7)], dxfattribs=fire)
    else:
        space.add_lwpolyline([(-28, -2), (28, -2), (28, 2), (-28, 2)], close=True, dxfattribs=fire)
    space.add_lwpolyline(
        [(0, 5), (9, 5), (9, 14), (6, 14), (6, 8), (0, 8)], close=True, dxfattribs=fire | {"const_width": 0}
    )
    stream = io.StringIO()
    document.write(stream)
    parts = places_of(stream.getvalue().encode(), "metres")
    assert [one["properties"].get("role") for one in parts.geometry["features"]] == [None, "emergency lane"]
    lane = parts.geometry["features"][1]
    assert lane["properties"]["radius"] == pytest.approx(2.0)
    ends = sorted(lane["geometry"]["coordinates"][k] for k in (0, -1))
    assert np.allclose(ends, [(-28, 0), (28, 7 if width else 0)])
    assert [note for note in parts.notes if "neither" in note] == [
        "Left out: 1 emergency lane that is neither a line nor a rectangle: emergency lane."
    ]


def test_walls_of_a_drawing_are_drawn_as_wide_as_they_are(client):
    data = map_of(client, "dxf", path=CORNER, venue=COLLECTION).text
    lines = ezdxf.read(io.StringIO(data)).modelspace().query("LWPOLYLINE")
    assert [wall.dxf.const_width for wall in lines if wall.dxf.hasattr("const_width")] == [0.3, 0.4]


def test_marks_stand_every_five_metres_of_the_path(client):
    features = map_of(client, "geojson", path=CORNER).json()["features"]
    marks = [feature for feature in features if feature["properties"]["role"] == "mark"]
    assert [feature["properties"]["name"] for feature in marks] == ["0", "5", "10", "15"]
    # 15 m along: 3 m into the arc of radius 5 m around (0, -3).
    x, y = marks[3]["geometry"]["coordinates"]
    assert (x, y) == pytest.approx((5.0 * np.sin(0.6), -3.0 - 5.0 * np.cos(0.6)))
    assert [feature["geometry"]["coordinates"] for feature in marks[:3]] == [[-12, -8], [-7, -8], [-2, -8]]
    assert_refused(client, "/maps.kml", {"dragon": {"benches": 2}, "path": CORNER}, "{} -> /origin")


def test_a_path_whose_line_was_moved_goes_through_the_line():
    line = [[0.0, 0.0], [10.0, 1.0], [20.0, 0.0]]
    straight = {"kind": "waypoints", "points": [[0.0, 0.0], [20.0, 0.0]]}
    feature = {"type": "Feature", "properties": {"name": "path", "path": straight},
               "geometry": {"type": "LineString", "coordinates": line}}  # fmt: skip
    result = read_json(feature)
    assert result.path == {"kind": "waypoints", "points": line}
    assert "edited" in result.notes[1]


def archived(data, name="doc.kml"):
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
    return sink.getvalue()


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


def test_a_map_drawn_on_a_phone_is_understood():
    for data in (KML.encode(), archived(KML.encode())):
        result = read(data)
        assert names(result) == ["square", "camphor"]
        square, tree = rings(result)
        # A degree of longitude is 96,486 m at a latitude of 30 degrees, one of latitude 110,852 m.
        scale = np.array([96_486, 110_852])
        assert np.ptp(square, axis=0) == pytest.approx([0.0004, 0.0003] * scale, rel=1e-3)
        away = np.hypot(*(tree - [-0.0001, -0.00005] * scale).T)
        assert 0.79 < away.min() < away.max() < 0.83
        assert result.path["points"][0] == pytest.approx([-0.0001, 0.00005] * scale, rel=1e-2)
        assert (result.origin.longitude, result.origin.latitude) == pytest.approx((120.0002, 30.00015))
        assert "Left out: 1 GroundOverlay." in result.notes


def test_what_has_no_square_and_no_radius_gets_both():
    lines = [[[100.0, 0.0], [104.0, 0.0]], [[100.0, 9.0], [104.0, 9.0]]]
    forms = [("Point", [0.0, 0.0], 0.5), ("Point", [300.0, 40.0], 0.5), *(("LineString", line, 0.1) for line in lines)]
    collection = {"type": "FeatureCollection", "features": [thing("", kind, places) for kind, places, _ in forms]}
    result = read_json(collection)
    assert rings(result)[0].min(axis=0).tolist() == [-20.0, -20.0]
    # They stay points and lines with a radius, for a request and for whoever moves them.
    assert things(result) == forms
    assert names(result)[1:] == [f"obstacle {k}" for k in range(1, 5)]
    assert sum("without a radius" in note for note in result.notes) == 2


@pytest.mark.parametrize("radius", ["0", "-0.5"])
def test_a_thing_with_a_radius_of_nothing_is_left_out_by_its_name(radius):
    """Some programs write a number as text."""
    elm = thing("elm", "Point", [5.0, 5.0])
    elm["properties"]["radius"] = radius
    for name, result in (("elm", read_json(elm)), ("camphor", read(KML.replace("0.8", radius).encode()))):
        assert f"Left out: 1 circle with a radius of less than 0.001 m: {name}." in result.notes


def placemark(inner, before=""):
    return (
        f'<kml xmlns="http://www.opengis.net/kml/2.2"><Document>{before}<Placemark>{inner}</Placemark></Document></kml>'
    )


def outline(coordinates):
    ring = f"<LinearRing><coordinates>{coordinates}</coordinates></LinearRing>"
    return f"<Polygon><outerBoundaryIs>{ring}</outerBoundaryIs></Polygon>"


CORNERS = "119.640,29.110,0 119.641,29.110,0 119.641,29.111,0 119.640,29.111,0 119.640,29.110,0"


KML_TYPE = "application/vnd.google-earth.kml+xml"
GUESSED = "The file is not in UTF-8; it was read as GB 18030."


SQUARE = {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [90, 95], [0, 0]]]}
NAMED = {"type": "Feature", "properties": {"name": "广场"}, "geometry": SQUARE}
GEOJSON = json.dumps(NAMED, ensure_ascii=False)
KML_SQUARE = placemark(f"<name>广场</name><author><name>Li</name></author>{outline(CORNERS)}")


@pytest.mark.parametrize(
    "data, guessed",
    [
        (KML_SQUARE.encode("gbk"), True),
        (archived(KML_SQUARE.encode("gbk")), True),
        (GEOJSON.encode("gb18030"), True),
        (GEOJSON.encode("utf-16"), False),
    ],
    ids=["kml", "kmz", "gb18030", "utf-16"],
)
def test_a_map_that_states_no_encoding_is_read_as_chinese_and_windows_programs_write_it(data, guessed):
    result = read(data)
    assert names(result) == ["广场"]
    assert (GUESSED in result.notes) is guessed


@pytest.mark.parametrize(
    "inner",
    [outline(" "), "<Point><coordinates/></Point>", "<LineString><coordinates></coordinates></LineString>", ""],
    ids=["polygon", "point", "line", "nothing"],
)
def test_a_map_of_nothing_is_refused(inner):
    with pytest.raises(InvalidValue, match="polygon, a line or a point") as refused:
        read(placemark(inner).encode())
    assert refused.value.field == "file"


def test_what_is_empty_or_hidden_is_left_out_and_reported():
    point = "<Point><coordinates>119.6405,29.1105</coordinates></Point>"
    # A name in the data is the name where there is no other.
    data = '<ExtendedData><Data name="name"><value>old elm</value></Data></ExtendedData>'
    named = f"<Placemark>{data}{point}</Placemark><Placemark><name>elm 7</name>{data}{point}</Placemark>"
    hidden = f"<Folder><visibility>0</visibility><Placemark>{point}</Placemark></Folder>{named}"
    hidden += f"<Placemark><visibility>0</visibility>{point}</Placemark>"
    lone = f"<Placemark>{outline(' ')}</Placemark>"
    result = read(placemark(f"<name>square</name>{outline(CORNERS)}", hidden + lone).encode())
    assert names(result) == ["square", "old elm", "elm 7"]
    assert {"Left out, because hidden: 2 points.", "Left out: 1 empty Polygon."} <= set(result.notes)


def test_where_all_of_a_kml_is_hidden_the_refusal_says_what():
    hidden = f"<visibility>0</visibility>{outline(CORNERS)}"
    with pytest.raises(InvalidValue, match=r"1 polygon is hidden; make it visible$"):
        read(placemark(hidden).encode())
    with pytest.raises(InvalidValue, match=r"2 polygons are hidden; make them visible$"):
        read(placemark(hidden, f"<Placemark>{hidden}</Placemark>").encode())


@pytest.mark.parametrize("across", [0.0003, 0.1, 0.3, 3.0, 3.5, 60.0])
def test_places_and_check_agree_about_degrees(client, across):
    square = box(119.5, 29.0, 119.5 + across, 29.0 + across)
    checked = client.post("/check", json={"dragon": {"benches": 2}, "venue": square})
    taken_for_degrees = "looks like longitude and latitude" in checked.text
    if across in (0.3, 3.0):
        with pytest.raises(InvalidValue, match=r"20 km across.*if they are metres, give the units metres"):
            read_json(square)
        assert taken_for_degrees
        return
    result = read_json(square)
    assert (result.origin is not None) == taken_for_degrees
    again = client.post("/check", json={"dragon": {"benches": 2}, "venue": result.geometry})
    assert again.status_code == 200, again.text


def test_a_square_that_check_refuses_is_noted():
    square = {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [2, 2], [0, 0]]]}
    result = read_json(square, "metres")
    assert any("narrower than a bench of 3.41 m: check refuses it" in note for note in result.notes)


BOMB = '<!DOCTYPE k [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]><kml>&b;</kml>'


SWAPPED = [[[29.1, 119.6], [29.101, 119.6], [29.101, 119.601], [29.1, 119.6]]]
COMMAS = "119.6402,29.1102,0,119.6403,29.1103,0\n119.6405,29.1104,0,119.6406,29.1105,0\n119.6408,29.1108,0"
POINTS = {"type": "MultiPoint", "coordinates": [[k, k] for k in range(20_000)]}
# The words tell apart what a caller cannot by the field, which is the file.
REFUSED = [
    (BOMB, "document type"),
    ("<kml>" + "<Folder>" * 100_000, "deeper than 60"),
    (archived(b"<kml>" + b" " * 21_000_000), "20000000 bytes"),
    ("PK\x03\x04broken", "unpacked"),
    (archived(b"<kml>", "doc.txt"), r"\.kml document"),
    ("<svg/>", "XML of another kind"),
    ("AC1027" + "\0" * 100, "got DWG"),
    ("0\nSECTION\nnonsense", "must be DXF"),
    (b"\x00\xff\xfe", "got none of these"),
    ("", "got nothing"),
    ("dragon = {names = [{a = -inf}]}", "finite numbers, got -inf"),
    ("venue = 5", "GeoJSON or the name of a file"),
    ('{"type": "Point", "coordinates": [1e400, 2]}', "file"),
    ('{"type": "Polygon", "coordinates": [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]]}', "self-intersection"),
    (json.dumps({"type": "Polygon", "coordinates": SWAPPED}), "swapped"),
    (placemark(f"<LineString><coordinates>{COMMAS}</coordinates></LineString>"), "space between two points"),
    ('{"type": "Topology"}', "file.type"),
    ('path = {kind = "spiral", pitch = "wide"}', "pitch must be a number"),
    (json.dumps(POINTS), "10000"),
]


@pytest.mark.parametrize("data, words", REFUSED)
def test_a_file_that_cannot_be_used_is_refused_in_words(data, words):
    with pytest.raises(InvalidValue, match=words) as refused:
        read(data.encode() if isinstance(data, str) else data)
    assert refused.value.field.partition(".")[0] == "file"


@pytest.mark.parametrize(
    "query, kind, status", [("", "image/png", 415), ("?units=feet", KML_TYPE, 422), ("", KML_TYPE, 422)]
)
def test_the_service_refuses_what_it_cannot_read(client, query, kind, status):
    assert_problem(client.post(f"/places{query}", content=BOMB, headers={"Content-Type": kind}), status)


def test_the_command_takes_a_map_for_a_dance_and_gives_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("temple.kml").write_text(KML)
    Path("dance.toml").write_text('venue = "temple.kml"\npath = "temple.kml"\nmargin = 0.2\ndragon.benches = 4\n')
    checked = run("check", "dance.toml", "--json")
    assert json.loads(checked.stdout)["origin"] == pytest.approx({"longitude": 120.0002, "latitude": 30.00015})
    assert "temple.kml: Longitude and latitude were converted to metres" in checked.stderr
    said("maps", "dance.toml", "--output", "dance.dxf", aside=None)
    assert "camphor" in run("places", "dance.dxf", "--output", "again.json").stdout
    again = json.loads(Path("again.json").read_text())
    assert again["path"]["kind"] == "waypoints"
    assert len(again["venue"]["features"]) == 2


# -- several dances ------------------------------------------------------------------------------------------

LANE = json.loads("""{"dragon": {"benches": 3}, "delay": 9,
    "path": {"kind": "route", "pieces": [{"kind": "line", "start": [-14.0, 6.0], "end": [14.0, 6.0]}]}}""")
LOW = {"name": "low", "dragon": {"benches": 2}, "path": CORNER}
TWO = {"dances": [LOW, LANE], "venue": VILLAGE, "origin": ORIGIN, "spacing": 2}


def test_a_map_of_several_dances_has_the_path_and_the_marks_of_each(client):
    performance, _ = MapsRequest.model_validate(TWO).to_placed(Settings())
    features = client.post("/maps.geojson", json=TWO).raise_for_status().json()["features"]
    for k, (dance, name) in enumerate(zip(TWO["dances"], ("low", "1"), strict=True)):
        start, stop = performance.parts[k].own_span(*performance.span())
        alone = TWO | {"dances": None, "start": start, "stop": stop, "dragon": dance["dragon"], "path": dance["path"]}
        wanted = [
            (f"{name} {feature['properties']['name']}", dance.get("name"), feature["geometry"])
            for feature in map_of(client, "geojson", **alone).json()["features"]
            if feature["properties"]["role"] in ("path", "mark")
        ]
        own = [feature for feature in features if feature["properties"].get("dragon") == k]
        assert wanted == [(one["properties"]["name"], one["properties"]["dragon_name"], one["geometry"]) for one in own]


@pytest.mark.parametrize("format", MapFormat)
def test_a_map_of_several_is_read_with_its_first_path_and_a_note(client, format):
    result = read(client.post(f"/maps.{format}", json=TWO).raise_for_status().content)
    assert CORNER.items() <= result.path.items()
    assert "2 lines are called path; the first is the path, and the others are left out." in result.notes
    assert len(names(result)) == len(VILLAGE["features"])


def test_a_map_has_at_most_two_thousand_marks(client):
    many = {"spacing": 0.5, "dances": [LANE | {"delay": k} for k in range(40)]}
    assert_refused(client, "/maps.kml", TWO, f"{json.dumps(many)} -> /spacing 2000 2280")


@pytest.mark.parametrize("write", [str.upper, str.title, str.lower])
def test_properties_are_read_however_their_names_are_written(write):
    path = thing("path", "LineString", [[5, 5], [35, 25]])
    well = thing("well", "Point", [10, 25])
    features = [
        {"type": "Feature", "properties": {"name": "Market", "layer": "square"}, "geometry": SQUARE},
        path,
        well,
    ]
    for feature in features:
        feature["properties"] = {write(name): value for name, value in feature["properties"].items()}
    result = read_json({"type": "FeatureCollection", "features": features}, "metres")
    assert names(result) == ["Market", "well"]
    assert result.path == {"kind": "waypoints", "points": [[5, 5], [35, 25]]}


def test_a_line_of_many_points_keeps_those_that_matter_and_says_how_near_it_stays():
    places = [[0.5 * k, 30.0 if k == 2501 else 0.001 * (k % 2)] for k in range(5003)]
    feature = thing("path", "LineString", places)
    result = read_json(feature, "metres")
    points = result.path["points"]
    assert len(points) == 1000
    assert max(y for _, y in points) == 30.0
    (said,) = (one for one in result.notes if "5003 points" in one)
    assert float(said.split("at most ")[1].split(" m")[0]) <= 0.01


@pytest.mark.parametrize("row", ["179.9995 180.0005 -> 180", "180.9995 181.0005 -> -179", "-180.0005 -179.9995 -> 180"])
def test_longitudes_beyond_180_are_places_on_the_other_side(row):
    west, east, middle = map(float, row.replace("->", "").split())
    result = read_json({"type": "GeometryCollection", "geometries": [box(west, 0, east, 0.001)]})
    assert_near(np.ptp(rings(result)[0], axis=0), [111.3, 110.6], 0.2)
    assert_near(abs(result.origin.longitude), abs(middle), 1e-9)


@pytest.mark.parametrize("west", [1, 3])
@pytest.mark.parametrize("name", ["square", None])
def test_a_square_that_is_cut_at_the_date_line_is_one_square_around_its_middle(client, name, west):
    halves = box(180 - 0.001 * west, 0, 180, 0.001), box(-180, 0, -179.999, 0.001)
    result = read_json(thing(name, "MultiPolygon", [half["coordinates"] for half in halves]), "degrees")
    [square] = rings(result)
    width, height = np.ptp(square, axis=0).tolist()
    assert width == pytest.approx((1 + west) * height, rel=0.02)
    assert_near(square.min(axis=0) + square.max(axis=0), [0.0, 0.0], 0.01)
    assert ("The square is drawn in 2 parts that share edges." in result.notes) is (name == "square")
    for form in MapFormat:
        if form is not MapFormat.DXF:
            data = map_of(client, form.value, venue=result.geometry, path=CORNER).content
            [again] = rings(read(data))
            assert abs(read(data).origin.longitude) <= 180.0
            assert np.abs(again - square).max() < 0.01

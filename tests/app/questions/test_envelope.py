"""The ground that benches sweep, the polygons of core, in every form."""

import io
import json
from dataclasses import replace

import ezdxf
import pytest
import shapely

from app.files.outlines import DXF_TYPE, GEOJSON_TYPE
from app.questions.envelope import Envelope, EnvelopeRequest
from core import Arc, Dance, Dragon, Route, envelope
from tests.support.asking import dance, written
from tests.support.command import said

# Rounds on a circle, which leave a hole.
RING = {"kind": "arc", "centre": [0, 0], "radius": 5, "start_angle": 0, "sweep": 7}
BODY = {"dragon": {"benches": 3}, "path": {"kind": "route", "pieces": [RING], "start": 8}}
ENVELOPE = envelope(Dance(Dragon(3), Route([Arc((0.0, 0.0), 5.0, 0.0, 7.0)], start=8.0)))
OUTLINE = [ring.tolist() for ring in ENVELOPE.polygons[0]]
SPECTATORS = [[8.0, -3.0], [8.0, 3.0], [9.0, 9.0]]
LOW = dance(3, (0, 0), (20, 0), name="low")
HIGH = dance(3, (0, 6), (20, 6), delay=5)
SEVERAL = {"dances": [LOW, HIGH], "start": 8, "stop": 12}
BEYOND = {"spectators": [[0.0, 9.0], [20.0, 9.0]]}


def test_several_polygons_are_a_multipolygon():
    several = replace(ENVELOPE, polygons=ENVELOPE.polygons * 2)
    answer = json.loads(Envelope.of(several, EnvelopeRequest()).to_json())
    assert answer["envelope"] == {"type": "MultiPolygon", "coordinates": [OUTLINE] * 2}
    assert answer["distance"] is None


def test_files_have_the_polygon_and_the_hole_as_its_own_line(ask, tmp_path):
    feature = ask.send("envelope", BODY, GEOJSON_TYPE).json()
    assert feature["type"] == "Feature"
    assert feature["properties"]["excess"] == ENVELOPE.excess
    assert feature["geometry"]["coordinates"] == OUTLINE
    document = ezdxf.read(io.StringIO(ask.file("envelope", BODY, DXF_TYPE).decode()))
    assert (document.units, document.audit().has_errors) == (ezdxf.units.M, False)
    lines = list(document.modelspace())
    assert [(line.dxf.layer, line.closed) for line in lines] == [("ENVELOPE", True), ("ENVELOPE_HOLES", True)]
    outer, hole = (shapely.Polygon([(x, y) for x, y, *_ in line.get_points()]).area for line in lines)
    assert outer - hole == pytest.approx(ENVELOPE.area)
    table = said("envelope", written(tmp_path, BODY | {"spectators": SPECTATORS}))
    for words in ("1 polygon, 1 hole, ", f"{ENVELOPE.distance(SPECTATORS):.9f} m"):
        assert words in table


def test_several_dances_have_the_ground_of_each_also_in_files(ask, tmp_path):
    got = ask("envelope", SEVERAL | BEYOND)
    low, high = got["dances"]
    assert (low["start"], low["stop"], high["stop"]) == (8.0, 12.0, 7.0)
    for part, answer in ((LOW, low), (HIGH, high)):
        alone = {name: part[name] for name in ("dragon", "path")} | {name: answer[name] for name in ("start", "stop")}
        assert answer == ask("envelope", alone | BEYOND) | {"name": part.get("name")}
    assert got["start"] == 8.0
    assert got["stop"] == 12.0
    assert got["distance"] == min(low["distance"], high["distance"]) == pytest.approx(2.85, abs=2e-3)
    features = ask.send("envelope", SEVERAL, GEOJSON_TYPE).json()["features"]
    named = [(one["properties"]["dragon"], one["properties"]["dragon_name"]) for one in features]
    assert named == [(0, "low"), (1, None)]
    assert [one["geometry"] for one in features] == [low["envelope"], high["envelope"]]
    drawing = io.StringIO(ask.file("envelope", SEVERAL, DXF_TYPE).decode())
    assert [line.dxf.layer for line in ezdxf.read(drawing).modelspace()] == ["ENVELOPE_0", "ENVELOPE_1"]
    table = said("envelope", written(tmp_path, SEVERAL))
    assert [one for one in got["dances"] if f"{one['area']:.9f} m2" not in table] == []

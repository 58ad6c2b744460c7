"""The ground that benches sweep, over HTTP and from a terminal: the polygons of core, in every form."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import ezdxf
import pytest
import shapely

from app.files.outlines import DXF_TYPE, GEOJSON_TYPE, envelope_geojson
from app.questions.envelope import Envelope, EnvelopeRequest
from app.settings import Settings
from core import Arc, Dance, Dragon, Route, Spiral, envelope, performance_envelope
from tests.support.asking import Asking, dance, written
from tests.support.command import run

# Rounds on a circle, which leave a hole.
RING = {"kind": "arc", "centre": [0, 0], "radius": 5, "start_angle": 0, "sweep": 7}
BODY = {"dragon": {"benches": 3}, "path": {"kind": "route", "pieces": [RING], "start": 8}}
ENVELOPE = envelope(Dance(Dragon(3), Route([Arc((0.0, 0.0), 5.0, 0.0, 7.0)], start=8.0)))
OUTLINE = [ring.tolist() for ring in ENVELOPE.polygons[0]]
SPECTATORS = [[8.0, -3.0], [8.0, 3.0], [9.0, 9.0]]
LOW, HIGH = dance(3, (0, 0), (20, 0), name="low"), dance(3, (0, 6), (20, 6), delay=5)
SEVERAL = {"dances": [LOW, HIGH], "start": 8, "stop": 12}
BEYOND = {"spectators": [[0.0, 9.0], [20.0, 9.0]]}


def test_the_answer_is_the_envelope_of_core_with_its_hole(ask: Asking) -> None:
    got = ask("envelope", BODY | {"spectators": SPECTATORS})
    assert got["envelope"] == {"type": "Polygon", "coordinates": OUTLINE}
    assert len(OUTLINE) == 2
    assert got["distance"] == ENVELOPE.distance(SPECTATORS) > 2.0
    known = ENVELOPE.certificate
    assert got["certificate"] == {"method": known.method, "cells": known.cells, "claim": asdict(known.claim)}
    assert ask("envelope", BODY)["distance"] is None


def test_several_polygons_are_a_multipolygon() -> None:
    several = replace(ENVELOPE, polygons=ENVELOPE.polygons * 2)
    answer = json.loads(Envelope.of(several, EnvelopeRequest()).to_json())["envelope"]
    assert answer == {"type": "MultiPolygon", "coordinates": [OUTLINE] * 2}


def test_geojson_is_offered(ask: Asking) -> None:
    answer = ask.send("envelope", BODY, GEOJSON_TYPE)
    assert (answer.headers["content-type"], answer.content) == (GEOJSON_TYPE, envelope_geojson(ENVELOPE))
    feature = answer.json()
    assert (feature["type"], feature["properties"]["excess"]) == ("Feature", ENVELOPE.excess)
    assert shapely.from_geojson(json.dumps(feature["geometry"])).area == pytest.approx(ENVELOPE.area)


def test_the_command_writes_what_the_service_says(ask: Asking, tmp_path: Path) -> None:
    file, drawing, table = written(tmp_path, BODY | {"spectators": SPECTATORS}), tmp_path / "x.dxf", tmp_path / "x.json"
    done = run("envelope", file, "--output", str(drawing))
    assert (done.returncode, done.stderr) == (0, f"{drawing}\n")
    assert "1 polygon, 1 hole, " in done.stdout
    assert f"{ENVELOPE.distance(SPECTATORS):.9f} m" in done.stdout
    assert json.loads(run("envelope", file, "--output", str(table), "--json").stdout)["excess"] == ENVELOPE.excess
    assert table.read_bytes() == envelope_geojson(ENVELOPE)
    assert drawing.read_bytes() == ask.file("envelope", BODY, DXF_TYPE)
    document = ezdxf.readfile(drawing)
    assert document.units == ezdxf.units.M
    assert not document.audit().has_errors
    lines = list(document.modelspace())
    assert [(line.dxf.layer, line.closed) for line in lines] == [("ENVELOPE", True), ("ENVELOPE_HOLES", True)]
    outer, hole = (shapely.Polygon([(x, y) for x, y, *_ in line.get_points()]).area for line in lines)
    assert outer - hole == pytest.approx(ENVELOPE.area)


def test_the_command_asks_for_a_spiral_by_its_options_and_refuses_other_files(tmp_path: Path) -> None:
    result = envelope(Dance(Dragon(5), Spiral(0.6)), stop=9.0)
    output = run("envelope", "--benches", "5", "--pitch", "0.6", "--stop", "9", "--json")
    assert json.loads(output.stdout)["area"] == result.area
    wrong = run("envelope", "--output", str(tmp_path / "ground.kml"))
    assert (wrong.returncode, wrong.stderr) == (2, "Error: --output must end in .geojson, .json or .dxf, got .kml\n")


def test_several_dances_have_the_ground_of_each(ask: Asking) -> None:
    got = ask("envelope", SEVERAL | BEYOND)
    performance = EnvelopeRequest.model_validate(SEVERAL).to_performance(Settings())
    results = performance_envelope(performance, start=8.0, stop=12.0)
    for part, result, answer in zip((LOW, HIGH), results, got["dances"], strict=True):
        alone = {name: part[name] for name in ("dragon", "path")} | {"start": result.start, "stop": result.stop}
        assert answer == ask("envelope", alone | BEYOND) | {"name": part.get("name")}
    assert [(one["start"], one["stop"]) for one in got["dances"]] == [(8.0, 12.0), (results[1].start, 7.0)]
    assert (got["start"], got["stop"]) == (8.0, 12.0)
    assert got["distance"] == min(one["distance"] for one in got["dances"]) == pytest.approx(2.85, abs=2e-3)


def test_files_of_several_have_the_ground_of_each(ask: Asking, tmp_path: Path) -> None:
    answer, collection = ask("envelope", SEVERAL), ask.send("envelope", SEVERAL, GEOJSON_TYPE)
    assert answer["distance"] is None
    features = collection.json()["features"]
    named = [(one["properties"]["dragon"], one["properties"]["dragon_name"]) for one in features]
    assert named == [(0, "low"), (1, None)]
    assert [one["geometry"] for one in features] == [one["envelope"] for one in answer["dances"]]
    file, drawing, table = written(tmp_path, SEVERAL), tmp_path / "two.dxf", tmp_path / "two.geojson"
    done = run("envelope", file, "--output", str(drawing))
    assert (done.returncode, done.stderr) == (0, f"{drawing}\n")
    assert [one for one in answer["dances"] if f"{one['area']:.9f} m2" not in done.stdout] == []
    assert drawing.read_bytes() == ask.file("envelope", SEVERAL, DXF_TYPE)
    assert [line.dxf.layer for line in ezdxf.readfile(drawing).modelspace()] == ["ENVELOPE_0", "ENVELOPE_1"]
    assert run("envelope", file, "--output", str(table)).returncode == 0
    assert table.read_bytes() == collection.content

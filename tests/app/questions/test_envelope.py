"""The ground that benches sweep, over HTTP and from a terminal: the polygons of core, in every form."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import ezdxf
import httpx
import pytest
import shapely

from app.files.outlines import DXF_TYPE, GEOJSON_TYPE, envelope_geojson
from app.questions.envelope import Envelope, EnvelopeRequest
from app.settings import Settings
from core import Arc, Dance, Dragon, Route, Spiral, envelope, performance_envelope
from tests.support.command import run

# Rounds on a circle, which leave a hole.
RING = {"kind": "arc", "centre": [0, 0], "radius": 5, "start_angle": 0, "sweep": 7}
BODY: dict[str, Any] = {"dragon": {"benches": 3}, "path": {"kind": "route", "pieces": [RING], "start": 8}}
DANCE = Dance(Dragon(3), Route([Arc((0.0, 0.0), 5.0, 0.0, 7.0)], start=8.0))
ENVELOPE = envelope(DANCE)
SPECTATORS = [[8.0, -3.0], [8.0, 3.0], [9.0, 9.0]]


def area_of_rings(rings: list[Any]) -> float:
    outer, *holes = (shapely.Polygon(ring).area for ring in rings)
    return float(outer - sum(holes))


def test_the_answer_is_the_envelope_of_core_with_its_hole(client: httpx.Client) -> None:
    got = client.post("/envelope", json=BODY | {"spectators": SPECTATORS}).raise_for_status().json()
    assert got["envelope"] == {"type": "Polygon", "coordinates": [ring.tolist() for ring in ENVELOPE.polygons[0]]}
    assert len(got["envelope"]["coordinates"]) == 2
    assert (got["excess"], got["area"], got["start"], got["stop"]) == (
        ENVELOPE.excess,
        ENVELOPE.area,
        ENVELOPE.start,
        ENVELOPE.stop,
    )
    assert got["distance"] == ENVELOPE.distance(SPECTATORS) > 2.0
    known = ENVELOPE.certificate
    assert got["certificate"] == {"method": known.method, "cells": known.cells, "claim": asdict(known.claim)}


def test_a_span_at_another_speed_is_that_of_core(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 4}, "head_speed": 2.0, "start": 3.0, "stop": 3.5}
    got = client.post("/envelope", json=body).raise_for_status().json()
    result = envelope(Dance(Dragon(4), Spiral(), 2.0), start=3.0, stop=3.5)
    assert (got["area"], got["excess"], got["distance"]) == (result.area, result.excess, None)


def test_several_polygons_are_a_multipolygon() -> None:
    several = replace(ENVELOPE, polygons=ENVELOPE.polygons * 2)
    answer = json.loads(Envelope.of(several, EnvelopeRequest()).to_json())["envelope"]
    assert answer == {"type": "MultiPolygon", "coordinates": [[ring.tolist() for ring in ENVELOPE.polygons[0]]] * 2}


def test_geojson_and_dxf_are_offered(client: httpx.Client) -> None:
    answer = client.post("/envelope", json=BODY, headers={"accept": GEOJSON_TYPE}).raise_for_status()
    assert answer.headers["content-type"] == GEOJSON_TYPE
    assert answer.content == envelope_geojson(ENVELOPE)
    feature = answer.json()
    assert (feature["type"], feature["properties"]["excess"]) == ("Feature", ENVELOPE.excess)
    assert shapely.from_geojson(json.dumps(feature["geometry"])).area == pytest.approx(ENVELOPE.area)
    drawing = client.post("/envelope", json=BODY, headers={"accept": DXF_TYPE}).raise_for_status()
    assert client.post("/envelope", json=BODY, headers={"accept": DXF_TYPE}).content == drawing.content


@pytest.mark.parametrize(
    ("wrong", "pointer", "words"),
    [
        ({"start": 5.0, "stop": 4.0}, "/stop", "stop must be after start (5 s), got 4 s"),
        ({"stop": 1e4}, "/stop", "stop must be at most "),
        ({"spectators": []}, "/spectators", "spectators must "),
        ({"spectators": [[1.0]]}, "/spectators/0", "spectators[0] must "),
        ({"excess": 0.1}, "/excess", '"excess" is unknown here'),
    ],
)
def test_a_wrong_value_is_refused_at_its_place(
    client: httpx.Client, wrong: dict[str, Any], pointer: str, words: str
) -> None:
    refused = client.post("/envelope", json=BODY | wrong)
    assert refused.status_code == 422
    (error,) = refused.json()["errors"]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)


def test_the_command_writes_what_the_service_says(tmp_path: Path) -> None:
    file, drawing, table = tmp_path / "dance.json", tmp_path / "ring.dxf", tmp_path / "ring.geojson"
    file.write_text(json.dumps(BODY | {"spectators": SPECTATORS}))
    done = run("envelope", str(file), "--output", str(drawing))
    assert (done.returncode, done.stderr) == (0, f"{drawing}\n")
    assert "1 polygon, 1 hole, " in done.stdout
    assert f"{ENVELOPE.distance(SPECTATORS):.9f} m" in done.stdout
    output = run("envelope", str(file), "--output", str(table), "--json")
    assert json.loads(output.stdout)["excess"] == ENVELOPE.excess
    assert table.read_bytes() == envelope_geojson(ENVELOPE)
    document = ezdxf.readfile(drawing)
    assert document.units == ezdxf.units.M
    assert not document.audit().has_errors
    lines = list(document.modelspace())
    assert [(line.dxf.layer, line.closed) for line in lines] == [("ENVELOPE", True), ("ENVELOPE_HOLES", True)]
    rings = [[(x, y) for x, y, *_ in line.get_points()] for line in lines]
    assert area_of_rings(rings) == pytest.approx(ENVELOPE.area)


def test_the_command_asks_for_a_spiral_by_its_options_and_refuses_other_files(tmp_path: Path) -> None:
    result = envelope(Dance(Dragon(5), Spiral(0.6)), stop=9.0)
    output = run("envelope", "--benches", "5", "--pitch", "0.6", "--stop", "9", "--json")
    assert json.loads(output.stdout)["area"] == result.area
    wrong = run("envelope", "--output", str(tmp_path / "ground.kml"))
    assert (wrong.returncode, wrong.stderr) == (2, "Error: --output must end in .geojson, .json or .dxf, got .kml\n")


# -- several dances ------------------------------------------------------------------------------------------

LANES = [{"kind": "waypoints", "points": [[0, y], [20, y]]} for y in (0, 6)]
SEVERAL: dict[str, Any] = {
    "dances": [
        {"name": "low", "dragon": {"benches": 3}, "path": LANES[0]},
        {"dragon": {"benches": 3}, "path": LANES[1], "delay": 5},
    ],
    "start": 8,
    "stop": 12,
}


def test_several_dances_have_the_ground_of_each(client: httpx.Client) -> None:
    got = client.post("/envelope", json=SEVERAL | {"spectators": [[0.0, 9.0], [20.0, 9.0]]}).raise_for_status().json()
    performance = EnvelopeRequest.model_validate(SEVERAL).to_performance(Settings())
    results = performance_envelope(performance, start=8.0, stop=12.0)
    for k, result in enumerate(results):
        alone = {name: SEVERAL["dances"][k][name] for name in ("dragon", "path")}
        alone |= {"start": result.start, "stop": result.stop, "spectators": [[0.0, 9.0], [20.0, 9.0]]}
        one = client.post("/envelope", json=alone).raise_for_status().json()
        assert got["dances"][k] == one | {"name": SEVERAL["dances"][k].get("name")}
    assert [(one["start"], one["stop"]) for one in got["dances"]] == [(8.0, 12.0), (results[1].start, 7.0)]
    assert (got["start"], got["stop"]) == (8.0, 12.0)
    assert got["distance"] == min(one["distance"] for one in got["dances"]) == pytest.approx(2.85, abs=2e-3)


def test_files_of_several_have_the_ground_of_each(client: httpx.Client, tmp_path: Path) -> None:
    answer = client.post("/envelope", json=SEVERAL).raise_for_status().json()
    assert answer["distance"] is None
    collection = client.post("/envelope", json=SEVERAL, headers={"accept": GEOJSON_TYPE}).raise_for_status()
    features = collection.json()["features"]
    assert [(one["properties"]["dragon"], one["properties"]["dragon_name"]) for one in features] == [
        (0, "low"),
        (1, None),
    ]
    assert [one["geometry"] for one in features] == [one["envelope"] for one in answer["dances"]]
    file, drawing, table = tmp_path / "two.json", tmp_path / "two.dxf", tmp_path / "two.geojson"
    file.write_text(json.dumps(SEVERAL))
    done = run("envelope", str(file), "--output", str(drawing))
    assert (done.returncode, done.stderr) == (0, f"{drawing}\n")
    for one in answer["dances"]:
        assert f"{one['area']:.9f} m2" in done.stdout
    assert drawing.read_bytes() == client.post("/envelope", json=SEVERAL, headers={"accept": DXF_TYPE}).content
    layers = [line.dxf.layer for line in ezdxf.readfile(drawing).modelspace()]
    assert layers == ["ENVELOPE_0", "ENVELOPE_1"]
    output = run("envelope", str(file), "--output", str(table), "--json")
    assert json.loads(output.stdout) == answer
    assert table.read_bytes() == collection.content


@pytest.mark.parametrize(
    ("wrong", "pointer", "words"),
    [
        ({"start": -500.0}, "/start", "start must be at least "),
        ({"stop": 1e4}, "/stop", "stop must be at most "),
        ({"head_speed": 1.0}, "/head_speed", "head_speed must stand in each of the dances"),
    ],
)
def test_a_wrong_value_of_several_is_refused(
    client: httpx.Client, wrong: dict[str, Any], pointer: str, words: str
) -> None:
    refused = client.post("/envelope", json=SEVERAL | wrong)
    assert refused.status_code == 422
    (error,) = refused.json()["errors"]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)

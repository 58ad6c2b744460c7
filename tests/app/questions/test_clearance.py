"""The clearance between several dragons over time, over HTTP, from a terminal and as a job."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.questions.clearance import ClearanceRequest
from app.settings import Settings
from core import performance_clearance
from tests.support.command import run
from tests.support.job_service import wait_for

EAST = {"dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[0, 0], [40, 0]]}}
NORTH = {"dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}}
TWO: dict[str, Any] = {"dances": [EAST | {"name": "east"}, NORTH | {"delay": 16}], "times": {"stop": 40, "step": 8}}
COLUMNS = ["time", "clearance", "dragons", "benches", "grazes"]


def ask(client: httpx.Client, body: dict[str, Any]) -> Any:
    return client.post("/clearance", json=body).raise_for_status().json()


def test_the_columns_are_those_of_core(client: httpx.Client) -> None:
    got = ask(client, TWO)
    assert list(got) == COLUMNS
    performance = ClearanceRequest.model_validate(TWO).to_performance(Settings())
    result = performance_clearance(performance, got["time"])
    # The start that is left out is the first whole second of the performance.
    assert performance.begin > 0.0
    assert (got["time"][0], got["time"][1] - got["time"][0]) == (pytest.approx(performance.begin, abs=1.0), 8.0)
    assert got["clearance"] == result.clearance.tolist()
    assert (got["dragons"], got["benches"]) == (result.dragons.tolist(), result.benches.tolist())
    assert got["grazes"] == [
        {"time": one.time, "clearance": one.clearance, "dragons": [*one.dragons], "benches": [*one.benches]}
        for one in result.grazes
    ]
    assert got["grazes"]


def test_without_times_it_is_every_second_from_the_beginning_to_the_end(client: httpx.Client) -> None:
    times = ask(client, TWO | {"times": None})["time"]
    performance = ClearanceRequest.model_validate(TWO).to_performance(Settings())
    assert times[0] - 1.0 < performance.begin <= times[0]
    assert times[-1] <= performance.end.time < times[-1] + 1.0
    assert {after - before for before, after in pairwise(times)} == {1.0}


WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "one dragon": ({"dances": [EAST]}, "/dances", "dances must be at least two, between which there is a clearance"),
    "a path beside": (TWO | {"path": EAST["path"]}, "/path", "path must stand in each of the dances, got it beside"),
    "after a fold": (
        {
            "dances": [{}, {"path": {"kind": "spiral", "centre": [50, 0]}}],
            "times": {"start": 0, "stop": 900, "step": 9},
        },
        "/times/stop",
        "times.stop must be at most ",
    ),
    "too many cells": (
        TWO | {"times": {"stop": 40, "step": 1e-6}},
        "/times/step",
        "instants x handles must be at most",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_refused_at_its_place(client: httpx.Client, name: str) -> None:
    body, pointer, words = WRONG[name]
    refused = client.post("/clearance", json=body)
    assert refused.status_code == 422
    error = refused.json()["errors"][0]
    assert (error["pointer"], error["detail"][: len(words)]) == (pointer, words)


def test_the_command_and_a_job_say_what_the_service_says(client: httpx.Client, tmp_path: Path) -> None:
    known = client.post("/clearance", json=TWO).raise_for_status()
    job = client.post("/clearance", json=TWO, headers={"Prefer": "respond-async"})
    address = f"{job.headers['location']}/result"
    wait_for(lambda: client.get(address).status_code == 200)
    assert client.get(address).content == known.content
    file = tmp_path / "two.json"
    file.write_text(
        json.dumps(TWO | {"venue": {"type": "FeatureCollection", "features": []}})
    )  # no part of this question
    assert run("clearance", str(file), "--json").stdout.encode() == known.content + b"\n"
    result = run("clearance", str(file))
    assert (result.returncode, result.stderr) == (0, "")
    assert "dragons" in result.stdout
    graze = known.json()["grazes"][0]
    assert f"{graze['time']:.9f}" in result.stdout
    file.write_text(json.dumps({"dances": TWO["dances"], "start": 20}))
    ranged = json.loads(run("clearance", str(file), "--json", "--step", "5").stdout)
    assert ranged["time"][:2] == [20.0, 25.0]
    late = run("clearance", str(file), "--stop", "1")
    assert "stop must not be before start (20 s), got 1 s" in late.stderr

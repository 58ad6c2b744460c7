"""The verdict on several dances on one clock, over HTTP, from a terminal and as a job; that on one is unchanged."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.questions.check import CheckRequest
from app.settings import Settings
from core import performance_check
from tests.app.files.test_figures import PNG_SIGNATURE, texts
from tests.support.command import run
from tests.support.job_service import wait_for

SQUARE = {"type": "Polygon", "coordinates": [[[-5, -30], [28, -30], [28, 30], [-5, 30], [-5, -30]]]}
FIVE: dict[str, Any] = {"benches": 5, "names": ["Zhou", "Wu", "Zheng", "Wang", "Feng"]}
EAST = {"dragon": {"benches": 5}, "path": {"kind": "waypoints", "points": [[0, 0], [30, 0]]}}
NORTH = {"dragon": FIVE, "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}}
TWO: dict[str, Any] = {
    "dances": [EAST | {"name": "east"}, NORTH | {"name": "north", "delay": 2, "head_speed": 1.1}],
    "venue": SQUARE,
    "speed_limit": 1.2,
    "margin": 0.05,
    "start_clock": "19:30",
}
# North passes behind east.
PASSING = {"dances": [EAST, NORTH | {"delay": 40}], "cross_check": "none"}


def ask(client: httpx.Client, body: dict[str, Any]) -> Any:
    return client.post("/check", json=body).raise_for_status().json()


def test_the_failures_are_those_of_core_in_order_of_time(client: httpx.Client) -> None:
    got = ask(client, TWO)
    performance, _ = CheckRequest.model_validate(TWO).to_placed(Settings())
    report = performance_check(performance, margin=0.05, speed_limit=1.2)
    assert (got["verdict"], got["passed"]) == ("fails", False)
    assert (got["start"], got["stop"], got["names"]) == (report.start, report.stop, ["east", "north"])
    keys = ("kind", "time", "dragons", "benches", "message")
    known = [(one.kind.value, one.time, [*one.dragons], [*one.benches], one.message) for one in report.failures]
    assert [tuple(one[key] for key in keys) for one in got["failures"]] == known
    (met,) = (one for one in got["failures"] if len(one["dragons"]) == 2)
    assert met["dragon_names"] == ["east", "north"]
    household = FIVE["names"][met["benches"][1]]
    assert met["names"] == ["", household]
    assert household in met["message"]
    assert met["clock"].startswith("19:30:")
    assert {tuple(one["dragon_names"]) for one in got["failures"] if one["area"] == "square"} == {("east",)}
    assert got["encounter"]["time"] == met["time"]
    assert got["encounter"]["cross_check"]["agree"]
    least = report.least_clearance
    assert least is not None
    assert got["least_clearance"] == {
        "dragons": list(least.dragons),
        "benches": list(least.benches),
        "distance": least.distance,
        "at_least": least.at_least,
        "time": least.time,
    }


def test_each_report_is_the_answer_about_that_dance_alone(client: httpx.Client) -> None:
    limits = {name: TWO[name] for name in ("venue", "speed_limit", "margin")}
    got = ask(client, TWO)
    assert got["reports"][0] == ask(client, limits | EAST | {"start_clock": "19:30"})
    assert got["reports"][1] == ask(client, limits | NORTH | {"head_speed": 1.1, "start_clock": "19:30:02"})
    met = {"dances": TWO["dances"], "margin": 0.05}
    assert ask(client, met)["encounter"] == client.post("/encounter", json=met).json()


def test_a_single_dragon_passes_or_fails_as_it_does_alone(client: httpx.Client) -> None:
    got, alone = ask(client, {"dances": [EAST], "venue": SQUARE}), ask(client, EAST | {"venue": SQUARE})
    assert got["reports"] == [alone]
    assert [one["message"] for one in got["failures"]] == [one["message"] for one in alone["failures"]]
    assert got["least_clearance"] is None
    assert got["encounter"]["outcome"] == "clear"


def test_without_details_the_verdict_is_the_same(client: httpx.Client) -> None:
    full, quick = (ask(client, TWO | {"details": details}) for details in (True, False))
    assert quick["failures"] == full["failures"]
    assert quick["least_clearance"] is None
    assert quick["reports"][0]["highest_speed"] is None


def test_dances_that_pass_each_other_pass(client: httpx.Client) -> None:
    got = ask(client, PASSING)
    assert (got["verdict"], got["failures"]) == ("passes", [])
    assert 0.0 < got["least_clearance"]["at_least"] <= got["least_clearance"]["distance"]
    assert (got["begins"], got["origin"]) == (None, None)


WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "a dragon beside": (TWO | {"dragon": {"benches": 9}}, "/dragon", "dragon must stand in each of the dances"),
    "a speed beside": (TWO | {"head_speed": 1.0}, "/head_speed", "head_speed must stand in each of the dances"),
    "none": ({"dances": []}, "/dances", "dances "),
    "a wrong one": ({"dances": [{"dragon": {"benches": 0}}]}, "/dances/0/dragon/benches", "benches must be at least 1"),
    "a late stop": ({"dances": [EAST], "stop": 500}, "/stop", "stop must be at most "),
    "too many benches": ({"dances": [{"dragon": {"benches": 90_000}}]}, "/dances", "benches of all dragons must be"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_refused_at_its_place(client: httpx.Client, name: str) -> None:
    body, pointer, words = WRONG[name]
    refused = client.post("/check", json=body)
    assert refused.status_code == 422
    error = refused.json()["errors"][0]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)


@pytest.mark.parametrize("name", ["dragon", "path", "head_speed", "passages", "beats"])
def test_a_field_of_one_dance_is_refused_also_with_its_default_and_after_an_answer(
    client: httpx.Client, name: str
) -> None:
    ask(client, PASSING)  # kept by its values, which are the same with a default
    default = CheckRequest().model_dump(mode="json")[name]
    refused = client.post("/check", json=PASSING | {name: default})
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == f"/{name}"


def test_null_stands_for_one_dance(client: httpx.Client) -> None:
    whole = {"start": 0, "stop": 9, "cross_check": "none"}
    assert ask(client, whole | {"dances": None, "dragon": None, "path": None}) == ask(client, whole)


def test_a_job_has_the_same_answer(client: httpx.Client) -> None:
    known = client.post("/check", json=PASSING).raise_for_status()
    job = client.post("/check", json=PASSING, headers={"Prefer": "respond-async"})
    address = f"{job.headers['location']}/result"
    wait_for(lambda: client.get(address).status_code == 200)
    assert client.get(address).content == known.content


def test_the_description_of_the_service_has_both_answers(client: httpx.Client) -> None:
    operation = client.get("/openapi.json").json()["paths"]["/check"]["post"]
    schema = operation["responses"]["200"]["content"]["application/json"]["schema"]
    assert [one["$ref"].rpartition("/")[2] for one in schema["anyOf"]] == ["Report", "PerformanceReport"]


# -- the command ---------------------------------------------------------------------------------------------


def test_the_command_says_what_the_service_says(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text(json.dumps(TWO))
    output = run("check", str(file), "--json")
    assert output.stdout.encode() == client.post("/check", json=TWO).content + b"\n"
    result = run("check", str(file))
    assert (result.returncode, result.stderr) == (0, "")
    words = " ".join(result.stdout.split())
    for failure in ask(client, TWO)["failures"]:
        assert f"{failure['clock']} {failure['message']}" in words
    for row in ("least clearance of two dragons", "east: first within 0.05 m", "north: highest speed", "engines agree"):
        assert row in words
    file.write_text(json.dumps(PASSING))
    assert "Passes. Nothing fails." in run("check", str(file)).stdout


def test_the_figure_shows_all_dragons(tmp_path: Path) -> None:
    file, svg, png = tmp_path / "two.json", tmp_path / "two.svg", tmp_path / "two.png"
    file.write_text(json.dumps(TWO))
    assert run("check", str(file), "--figure", str(svg)).returncode == 0
    words = texts(svg.read_bytes())
    assert "come within 0.05 m" in words
    assert "square" in words
    file.write_text(json.dumps(PASSING))
    assert run("check", str(file), "--figure", str(svg)).returncode == 0
    assert "At " in texts(svg.read_bytes())
    assert run("check", str(file), "--figure", str(png), "--time", "20").returncode == 0
    assert png.read_bytes().startswith(PNG_SIGNATURE)

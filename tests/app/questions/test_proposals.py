"""Proposals over HTTP and from a terminal: each is a dance that /check passes as it is."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import httpx
import pytest

import core
from core import Area, Dragon, Venue
from tests.support.command import run

RING = [[0, 0], [24, 0], [24, 20], [0, 20], [0, 0]]
YARD: dict[str, Any] = {"type": "Polygon", "coordinates": [RING]}
BODY: dict[str, Any] = {"venue": YARD, "dragon": {"benches": 10}, "figures": ["ring", "serpentine"], "count": 2}
GATES = [{"point": [0, 10], "heading": 0}, {"point": [24, 10], "heading": math.pi}]
PNG = b"\x89PNG\r\n"


def proposals(client: httpx.Client, **more: Any) -> dict[str, Any]:
    answer: dict[str, Any] = client.post("/proposals", json=BODY | more).raise_for_status().json()
    return answer


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"gates": GATES, "figures": ["parade", "ring"], "speed_limit": 1.2},
        {
            "dragon": {
                "lengths": [3, 2, 2.2, 2],
                "widths": [0.4, 0.3, 0.3, 0.3],
                "overhangs": [0.2] * 4,
                "names": ["Li", "", "", "Wu"],
            }
        },
        {"objective": "benches", "figures": ["ring"], "count": 1},
    ],
    ids=["square", "gates", "bench by bench", "most benches"],
)
def test_every_dance_passes_its_check_as_it_is(client: httpx.Client, more: dict[str, Any]) -> None:
    answer = proposals(client, **more)
    assert answer["proposals"]
    assert (answer["reason"], answer["reason_kind"]) == (None, None)
    for one in answer["proposals"]:
        body = one["dance"]
        assert (body["margin"], body["stray"], body["start"]) == (0.0, 0.05, 0.0)
        report = client.post("/check", json=body).raise_for_status().json()
        assert report["verdict"] == "passes"
        assert report["stop"] - report["start"] == pytest.approx(one["duration"], abs=1e-9)
        assert report["highest_speed"]["speed"] == pytest.approx(one["highest_speed"], abs=1e-9)
        assert report["sharpest_bend"]["angle"] == pytest.approx(one["sharpest_bend"], abs=1e-9)
        nearest = min(area["nearest"]["distance"] for area in report["venue"]["areas"])
        assert nearest == pytest.approx(one["near"]["distance"], abs=1e-9)
        assert one["summary"].endswith(f"from '{one['near']['name']}'.")


def test_the_answer_is_that_of_core(client: httpx.Client) -> None:
    result = core.propose(
        Venue(Area("square", (tuple((x, y) for x, y in RING),))), Dragon(10), figures=["ring", "serpentine"], count=2
    )
    answer = proposals(client)
    assert (answer["tried"], answer["checked"], answer["summary"]) == (result.tried, result.checked, result.message)
    assert [one["tolerance"] for one in answer["proposals"]] == [one.tolerance for one in result.proposals]
    assert [one["figure"] for one in answer["proposals"]] == [one.figure.value for one in result.proposals]


def test_a_reason_stands_where_no_dance_fits(client: httpx.Client) -> None:
    lane = {"type": "Polygon", "coordinates": [[[0, 0], [30, 0], [30, 3], [0, 3], [0, 0]]]}
    answer = proposals(client, venue=lane)
    assert answer["proposals"] == []
    assert answer["reason_kind"] == "width"
    assert answer["reason"] == "The widest free circle is at most 3.02 m across; a turn of the head bench needs 3.91 m."


def test_a_venue_in_degrees_keeps_its_place(client: httpx.Client) -> None:
    east, north = 24 / 111_320 / math.cos(math.radians(48.0)), 20 / 111_195
    square = [[9.0, 48.0], [9.0 + east, 48.0], [9.0 + east, 48.0 + north], [9.0, 48.0 + north], [9.0, 48.0]]
    answer = proposals(
        client, venue={"type": "Polygon", "coordinates": [square]}, coordinates="degrees", figures=["ring"], count=1
    )
    dance = answer["proposals"][0]["dance"]
    assert dance["venue"]["origin"]["longitude"] == pytest.approx(9.0 + 0.5 * east)
    report = client.post("/check", json=dance).raise_for_status().json()
    assert (report["passed"], report["origin"]) == (True, dance["venue"]["origin"])


@pytest.mark.parametrize(
    ("more", "pointer", "words"),
    [
        ({"gates": [{"point": [5, 6], "heading": 0}]}, "/gates/0/point", "must be on the border of the square"),
        ({"gates": [{"point": [0, 10], "heading": math.pi}]}, "/gates/0/heading", "must lead into the square"),
        ({"figures": ["parade"]}, "/figures", "must have two gates for a parade"),
        ({"figures": ["polka"]}, "/figures/0", "spiral"),
        ({"count": 0}, "/count", "1"),
        ({"venue": None}, "/venue", "must be given"),
        ({"dragon": {"benches": 100_000}}, "/dragon/benches", "at most"),
        (
            {"venue": {"type": "Polygon", "coordinates": [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]]}},
            "/venue",
            "self-intersection",
        ),
        ({"venue": {"type": "Polygon", "coordinates": [[[0, 0]] * 50_001]}}, "/venue", "at most 2000 edges, got 50000"),
    ],
)
def test_bad_input_is_named(client: httpx.Client, more: dict[str, Any], pointer: str, words: str) -> None:
    answer = client.post("/proposals", json=BODY | more)
    assert answer.status_code == 422
    problem = answer.json()["errors"][0]
    assert problem["pointer"].startswith(pointer)
    assert words in problem["detail"]


def test_the_command_writes_dances_and_pictures(tmp_path: Path) -> None:
    (tmp_path / "yard.geojson").write_text(json.dumps(YARD))
    file = tmp_path / "wish.toml"
    file.write_text('venue = "yard.geojson"\nfigures = ["ring"]\ncount = 2\n[dragon]\nbenches = 10\n')
    folder = tmp_path / "proposals"
    result = run("propose", str(file), "--output", str(folder))
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("The best 2 of ")
    names = {"1-ring.json", "1-ring.png", "2-ring.json", "2-ring.png", "overview.png"}
    assert {one.name for one in folder.iterdir()} == names
    assert result.stderr.splitlines() == [str(folder / name) for name in sorted(names)]
    assert all(one.read_bytes().startswith(PNG) for one in folder.glob("*.png"))
    checked = run("check", str(folder / "2-ring.json"))
    assert checked.stdout.startswith("Passes."), checked.stderr
    lane = tmp_path / "lane.toml"
    lane.write_text(
        '[dragon]\nbenches = 4\n[venue]\ntype = "Polygon"\ncoordinates = [[[0, 0], [30, 0], [30, 3], [0, 3], [0, 0]]]\n'
    )
    none = run("propose", str(lane), "--output", str(tmp_path / "none"))
    assert (none.returncode, none.stdout.strip()) == (
        0,
        "The widest free circle is at most 3.02 m across; a turn of the head bench needs 3.91 m.",
    )
    assert list((tmp_path / "none").iterdir()) == []


def test_the_command_says_how_many_benches_fit_and_what_the_area_bounds(tmp_path: Path) -> None:
    ring = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]
    body = {"venue": {"type": "Polygon", "coordinates": [ring]}, "dragon": {"benches": 3}, "figures": ["ring"]}
    file = tmp_path / "wish.json"
    file.write_text(json.dumps({**body, "objective": "benches", "count": 1}))
    answer = json.loads(run("propose", str(file), "--json").stdout)
    most, fitting = answer["most_benches"], answer["proposals"][0]["dance"]["dragon"]["benches"]
    table = run("propose", str(file)).stdout.splitlines()
    head, row = (next(line.split() for line in table if word in line) for word in ("figure", "ring"))
    assert row[head.index("benches")] == str(fitting)
    assert f"no dragon of this kind has more than {most} benches" in " ".join(table)

"""The crew over HTTP, on paper and from a terminal: the same people at the same benches, minutes and metres."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium
import pytest

import core
from app.maps.dances import read_dance
from app.questions.crew import QUESTION as CREW
from app.questions.crew import CrewRequest
from app.questions.plan import PDF_TYPE
from app.wire.messages import checked
from app.wire.question import Terms
from core import Budget, TooMuchWork
from tests.support.command import run

VILLAGE = Path(__file__).parents[3] / "examples" / "village_square.toml"
# Places [m], and the error with which a bench is at its place of a change [m].
ROUNDING, AT_PLACE = 1e-9, 0.02
PEOPLE = {"spares": 6, "shift": 40, "rest": 10, "points": [{"x": 6, "y": -8}], "start_clock": "19:44:30"}


@pytest.fixture(scope="module")
def body() -> dict[str, Any]:
    return read_dance(VILLAGE)


@pytest.fixture(scope="module")
def answer(client: httpx.Client, body: dict[str, Any]) -> dict[str, Any]:
    request = body | PEOPLE | {"at_clock": "19:45"}
    result: dict[str, Any] = client.post("/crew", json=request).raise_for_status().json()
    return result


def of_form(client: httpx.Client, request: dict[str, Any], accept: str) -> bytes:
    return client.post("/crew", json=request, headers={"accept": accept}).raise_for_status().content


def test_the_roll_at_a_time_of_day_names_everybody_once_where_the_trajectory_has_the_bench(
    answer: Any, body: dict[str, Any]
) -> None:
    roll, dance = answer["at"], checked(CrewRequest, body).to_dance(100)
    assert (roll["time"], roll["clock"]) == (30.0, "19:45:00")
    assert [len(one["people"]) for one in roll["benches"]] == [8] + [2] * 23
    position = core.trajectory(dance, [roll["time"]]).position[0]
    for one in roll["benches"]:
        assert (one["x"], one["y"]) == pytest.approx(position[one["bench"]], abs=ROUNDING)
    everyone = [label for one in roll["benches"] for label in one["people"]] + roll["resting"]
    assert sorted(everyone) == sorted(one["label"] for one in answer["carriers"])
    # Each is where their own spells say.
    spells = {one["label"]: one["spells"] for one in answer["carriers"]}
    for one in roll["benches"]:
        for label in one["people"]:
            assert [spell["bench"] for spell in spells[label] if spell["begin"] <= 30.0 < spell["end"]] == [
                one["bench"]
            ]


def test_minutes_and_metres_of_all_are_those_of_the_benches(answer: Any, body: dict[str, Any]) -> None:
    dance = checked(CrewRequest, body).to_dance(100)
    start, stop = answer["start"], answer["stop"]
    assert (start, stop) == (0.0, dance.end.time)
    assert sum(one["time"] for one in answer["carriers"]) == pytest.approx(54 * (stop - start), abs=ROUNDING)
    # The way of a handle is the integral of its speed along the path, which is 1 m/s for the head.
    times = np.linspace(start, stop, 20_001)
    speed = core.trajectory(dance, times).speed[:, :-1]
    ways = np.trapezoid(speed, times, axis=0) @ np.array([8] + [2] * 23)
    assert sum(one["way"] for one in answer["carriers"]) == pytest.approx(ways, abs=1e-3)
    for one in answer["carriers"]:
        lengths = [spell["end"] - spell["begin"] for spell in one["spells"]]
        assert one["time"] == pytest.approx(sum(lengths), abs=ROUNDING)
        assert one["longest"] == max(lengths, default=0.0)
    assert answer["longest"] == max(one["longest"] for one in answer["carriers"])


def test_people_change_where_the_front_handle_is_nearest_to_the_point(answer: Any, body: dict[str, Any]) -> None:
    place = answer["places"][0]
    assert place["distance"] == pytest.approx(np.hypot(place["x"] - 6, place["y"] + 8), abs=ROUNDING)
    at_point = [
        spell
        for one in answer["carriers"]
        for spell in one["spells"]
        if spell["relieves"] and spell["begin"] not in (40.0, 80.0, 120.0)
    ]
    assert len(at_point) > 10
    for spell in at_point:
        assert (spell["x"], spell["y"]) == pytest.approx((place["x"], place["y"]), abs=AT_PLACE)


def test_the_table_has_the_same_spells(client: httpx.Client, answer: Any, body: dict[str, Any]) -> None:
    names = ["=1+1", *[f"family {k}" for k in range(1, 24)]]
    request = body | PEOPLE | {"dragon": {"benches": 24, "names": names}}
    lines = list(csv.DictReader(io.StringIO(of_form(client, request, "text/csv").decode())))
    spells = {(one["label"], spell["begin"]): spell for one in answer["carriers"] for spell in one["spells"]}
    assert {(line["label"], float(line["begin"])) for line in lines} == spells.keys()
    for line in lines:
        spell = spells[line["label"], float(line["begin"])]
        assert [float(line[name]) for name in ("end", "way", "x", "y")] == [
            spell[name] for name in ("end", "way", "x", "y")
        ]
        assert (int(line["bench"]), line["begin_clock"]) == (spell["bench"], spell["begin_clock"])
        assert line["relieves"] == (spell["relieves"] or "")
    assert {line["name"] for line in lines if line["bench"] == "0"} == {"'=1+1"}


def test_the_timeline_on_paper_names_everybody_and_every_change(client: httpx.Client, answer: Any, body: Any) -> None:
    data = of_form(client, body | PEOPLE | {"at_clock": "19:45", "title": "Lantern night"}, "application/pdf")
    pages = list(pypdfium2.PdfDocument(data))
    texts = [" ".join(page.get_textpage().get_text_bounded().split()) for page in pages]
    words = " ".join(texts).split()
    for one in answer["carriers"]:
        assert one["label"] in words
        assert f"{one['way']:.0f}" in words
    assert all("Lantern night" in text for text in texts)
    assert "Who is where at 19:45:00" in texts[-1]
    assert len(pages) == 3
    fonts = [one.get_font() for page in pages for one in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_TEXT])]
    assert fonts
    assert all(font.is_embedded for font in fonts)
    assert b"/FontFile2" in data  # TrueType


@pytest.mark.chinese_font
def test_the_command_gives_the_same_bytes_and_a_table(client: httpx.Client, body: Any, tmp_path: Path) -> None:
    request = body | PEOPLE | {"at": 30, "language": "zh"}
    file = tmp_path / "dance.json"
    file.write_text(json.dumps({name: value for name, value in request.items() if name not in ("points", "spares")}))
    options = (str(file), "--spares", "6", "--point", "6,-8")
    for name, accept in (("crew.pdf", "application/pdf"), ("crew.csv", "text/csv"), ("crew.json", "application/json")):
        run("crew", *options, "--output", str(tmp_path / name))
        assert (tmp_path / name).read_bytes() == of_form(client, request, accept)
    text = "".join(pypdfium2.PdfDocument(tmp_path / "crew.pdf")[0].get_textpage().get_text_bounded().split())
    assert "谁在何时抬哪节板凳" in text
    table = run("crew", *options).stdout
    assert "60 people, 6 of them spares" in table
    assert "Who is where at 19:45:00" in table
    assert json.loads(run("crew", *options, "--json").stdout) == json.loads((tmp_path / "crew.json").read_text())


@pytest.mark.parametrize(
    ("change", "pointer", "words"),
    [
        ({"spares": 2, "shift": 200}, "/shift", "shift must be shorter than the dance, which takes 122.670"),
        ({"spares": 0, "shift": 20}, "/spares", "spares must be at least 1 where people change, got 0"),
        ({"spares": 1, "points": [{"x": 0, "y": 90}]}, "/points/0", "points[0] must be within 2 m of the path"),
        ({"people": [8, 2]}, "/people", "people must have an entry for each of the 24 benches, got 2"),
        ({"people": [8] + [2] * 22 + [0]}, "/people/23", "people[23] must be"),
        ({"at": 200}, "/at", "at must be during the dance, from 0 s to 122.670"),
        ({"at_clock": "19:45"}, "/at_clock", "at_clock must stand beside start_clock"),
        ({"at_clock": "21:00", "start_clock": "19:30"}, "/at_clock",
         "at_clock must be during the dance, from 19:30:00 to 19:32:02, got '21:00'"),
        ({"at_clock": "25:00", "start_clock": "19:30"}, "/at_clock", "must be a time of day"),
        ({"at": 3, "at_clock": "19:31", "start_clock": "19:30"}, "/at_clock", "must be left out beside at"),
        ({"spares": 19_999}, "/spares", "people must be at most 20000, spares among them, got 20053"),
        ({"spares": 1, "shift": 1e-4}, "/shift", "changes of people must be at most 100000"),
        ({"head_people": 0}, "/head_people", "head_people must be"),
    ],
    ids=lambda value: value.strip("/").replace("/", "-") if isinstance(value, str) and value.startswith("/") else "",
)  # fmt: skip
def test_bad_input_is_one_sentence(client: httpx.Client, body: Any, change: Any, pointer: str, words: str) -> None:
    refused = client.post("/crew", json=body | change)
    assert refused.status_code in (413, 422)
    assert refused.json()["errors"][0]["pointer"] == pointer
    assert words in refused.json()["detail"]


def test_a_deadline_while_the_timeline_is_drawn_is_a_refusal(body: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    budget = Budget()

    def late(draw: Any) -> Any:
        budget.stop("within 2 s")
        return draw()

    monkeypatch.setattr("app.cards.timeline.in_turn", late)
    with pytest.raises(TooMuchWork, match="the timeline was not drawn within 2 s"):
        CREW.to_bytes(checked(CrewRequest, body | PEOPLE), Terms(budget=budget), PDF_TYPE)


def test_a_clock_after_midnight_is_in_the_same_night(client: httpx.Client, body: Any) -> None:
    request = body | {"start_clock": "23:59:15", "at_clock": "00:00:10"}
    roll = client.post("/crew", json=request).raise_for_status().json()["at"]
    assert (roll["time"], roll["clock"]) == (55.0, "00:00:10")


def test_a_point_in_a_terminal_is_two_numbers(tmp_path: Path) -> None:
    done = run("crew", str(VILLAGE), "--spares", "2", "--point", "6")
    assert (done.returncode, done.stderr) == (2, "Error: --point must be X,Y [m], got '6'\n")

"""The crew over HTTP, on paper and from a terminal: the same people at the same benches, minutes and metres."""

import csv
import io
import json
import re

import pytest

import core
from app.maps.dances import read_dance
from app.questions.crew import CrewRequest
from app.wire.messages import checked
from tests.conftest import ROOT
from tests.support.command import run
from tests.support.near import assert_near
from tests.support.paper import assert_printable, sheets_of
from tests.support.refusal_rows import assert_refused

VILLAGE = read_dance(ROOT / "examples" / "village_square.toml")
# Places [m], and the error with which a bench is at its place of a change [m].
ROUNDING = 1e-9
AT_PLACE = 0.02
PEOPLE = {"spares": 6, "shift": 40, "rest": 10, "points": [{"x": 6, "y": -8}], "start_clock": "19:44:30"}


@pytest.fixture(scope="module")
def answer(ask):
    return ask("crew", VILLAGE | PEOPLE | {"at_clock": "19:45"})


def test_the_roll_at_a_time_of_day_names_everybody_once_where_the_trajectory_has_the_bench(answer):
    roll = answer["at"]
    dance = checked(CrewRequest, VILLAGE).to_dance(100)
    assert roll["time"] == 30.0
    assert roll["clock"] == "19:45:00"
    assert [len(entry["people"]) for entry in roll["benches"]] == [8] + [2] * 23
    position = core.trajectory(dance, [30.0]).position[0]
    assert_near([(entry["x"], entry["y"]) for entry in roll["benches"]], position[:-1], ROUNDING)
    changes = [spell for entry in answer["carriers"] for spell in entry["spells"] if spell["relieves"]]
    position = core.trajectory(dance, [spell["begin"] for spell in changes]).position
    places = [front[spell["bench"]] for front, spell in zip(position, changes, strict=True)]
    assert_near([(spell["x"], spell["y"]) for spell in changes], places, AT_PLACE)
    assert answer["longest"] == max(person["longest"] for person in answer["carriers"])
    # Each is where their own spells say.
    places = {label: entry["bench"] for entry in roll["benches"] for label in entry["people"]}
    assert places | dict.fromkeys(roll["resting"]) == {
        entry["label"]: next((s["bench"] for s in entry["spells"] if s["begin"] <= 30.0 < s["end"]), None)
        for entry in answer["carriers"]
    }


def test_the_table_has_the_same_spells(ask, answer):
    names = ["=1+1", *[f"family {k}" for k in range(1, 24)]]
    request = VILLAGE | PEOPLE | {"dragon": {"benches": 24, "names": names}}
    lines = list(csv.DictReader(io.StringIO(ask.file("crew", request, "text/csv").decode())))
    columns = ("begin", "end", "way", "x", "y", "bench", "begin_clock", "relieves")
    spells = [person | spell for person in answer["carriers"] for spell in person["spells"]]
    assert sorted([line[name] for name in ("label", *columns)] for line in lines) == sorted(
        ["" if spell[name] is None else str(spell[name]) for name in ("label", *columns)] for spell in spells
    )
    assert {line["name"] for line in lines if line["bench"] == "0"} == {"'=1+1"}


def test_the_timeline_on_paper_names_everybody_and_every_change(ask, answer):
    request = VILLAGE | PEOPLE | {"at_clock": "19:45", "title": "Lantern night"}
    data = ask.file("crew", request, "application/pdf")
    assert_printable(data, b"/Lang(en)", b"/S/H1", b"/S/H2", b"/S/Table", b"/S/TH")
    sheets = sheets_of(data)
    assert ["Lantern night" in sheet for sheet in sheets] == [True] * 3
    assert "Who is where at 19:45:00" in sheets[-1]
    words = {word for one in answer["carriers"] for word in (one["label"], f"{one['way']:.0f}")}
    assert words <= {*" ".join(sheets).split()}


def test_a_terminal_shows_who_is_where():
    text = json.dumps(VILLAGE | {"start_clock": "19:44:30", "at": 30})
    table = run("crew", "-", "--spares", "6", "--point", "6,-8", text=text).stdout
    assert re.match(r"Too few spares: .* \d+ spares are enough\..*\n\s*60 people, 6 of them spare;", table)
    assert "Who is where at 19:45:00" in table


@pytest.mark.parametrize(
    "row",
    [
        '{"spares": 2, "shift": 200} -> /shift 122.670',
        '{"spares": 0, "shift": 20} -> /spares 1 0',
        '{"spares": 1, "points": [{"x": 0, "y": 90}]} -> /points/0 2',
        '{"people": [8, 2]} -> /people 24 2',
        '{"people": [8,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,2,0]} -> /people/23',
        '{"at": 200} -> /at 0 122.670',
        '{"at_clock": "19:45"} -> /at_clock start_clock',
        '{"at_clock": "21:00", "start_clock": "19:30"} -> /at_clock 19:30:00 19:32:02 21:00',
        '{"at_clock": "25:00", "start_clock": "19:30"} -> /at_clock',
        '{"at": 3, "at_clock": "19:31", "start_clock": "19:30"} -> /at_clock at',
        '{"spares": 19999} -> /spares 20000 20053',
        '{"spares": 1, "shift": 0.0001} -> /shift 100000',
        '{"head_people": 0} -> /head_people',
    ],
)
def test_a_crew_that_cannot_be_is_refused(client, row):
    assert_refused(client, "/crew", VILLAGE, row)


def test_a_clock_after_midnight_is_in_the_same_night(ask):
    roll = ask("crew", VILLAGE | {"start_clock": "23:59:15", "at_clock": "00:00:10"})["at"]
    assert roll["time"] == 55.0
    assert roll["clock"] == "00:00:10"

"""The command check, run as a user runs it."""

import csv
import json
import re

import pytest

from tests.support.asking import box
from tests.support.asking import dance as dance_along
from tests.support.command import run, said

LAST_DIGIT = 1e-6  # of a distance in a report [m]
DANCE = """
margin = 0.9
speed_limit = 0.5
start = 15
venue = "yard.geojson"

[dragon]
benches = 4

[path]
kind = "route"

[[path.pieces]]
kind = "line"
start = [0, 0]
end = [60, 0]
"""
BODY = json.loads("""{
    "dragon": {"benches": 4}, "path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}]},
    "venue": {"type": "Polygon", "coordinates": [[[-2, -3], [62, -3], [62, 1], [-2, 1], [-2, -3]]]},
    "margin": 0.9, "speed_limit": 0.5, "start": 15
}""")
FOLDING = {"dragon": {"benches": 40}, "path": {"pitch": 1.2, "start_turns": 8}}
# Two dragons, each in a lane whose sides are a rounding shorter than 40 m.
LANES = [dance_along(3, (0, y), (40, y)) for y in (0, 5)]


@pytest.fixture
def dance(tmp_path):
    """A dance in a TOML file, and its venue beside it."""
    (tmp_path / "yard.geojson").write_text(json.dumps(BODY["venue"]))
    file = tmp_path / "dance.toml"
    file.write_text(DANCE)
    return file


def checked(body, *options):
    return said("check", "-", *options, text=json.dumps(body))


@pytest.mark.parametrize(
    "text, words",
    [
        (DANCE, "Failures in order | 'square' | exceeds 0.5 m/s | nearest to square | proven: at least"),
        (DANCE, "comes within 0.9 m of 'square' | never within 0.9 m | first within 0.9 m"),
        (DANCE.replace("0.9", "0.1").replace("0.5", "2.0"), "Nothing fails. | handles 0, 1, 2, 3, 4"),
        (
            "path = {pitch = 1.2, start_turns = 8}\ndragon.benches = 40",
            "Fails. Failures in order of time:\n  Bench 0 folds at 238.214985 s, the head at (1.0 | towards the fold",
        ),
        ("path = {pitch = 1.2, start_turns = 8}\ndragon.benches = 40\nstop = 238", "Passes. Nothing fails."),
        ("path.pitch = 0.4\nstart = 100\ndragon.benches = 30", "engines agree | all 30 benches"),
        ("path.pitch = 0.3", "overlap by 0.114627 m | 0.000000 s | benches 8, 28 "),
        ("dances = [{delay = 100, dragon.benches = 3}]\nstop = 101", "100.000000 s | 101.000000 s"),
    ],
    ids=["fails", "within a margin", "passes", "fold", "before a fold", "judged", "overlap at the start", "late"],
)  # fmt: skip
def test_a_report_says_what_fails_and_how_near(dance, text, words):
    dance.write_text(text)
    report = said("check", str(dance))
    assert [word for word in words.split(" | ") if word not in report] == []
    assert "contact" not in report or "margin" not in text


def test_a_least_clearance_is_not_rounded_above_what_is_proven(ask):
    proven = ask("check", FOLDING)["least_clearance"]["at_least"]
    (displayed,) = re.findall(r"proven: at least ([\d.]+) m", checked(FOLDING))
    assert proven - LAST_DIGIT < float(displayed) <= proven


def test_what_is_not_decided_is_no_failure():
    lane = {"kind": "route", "pieces": [{"kind": "line", "start": [-60, 0], "end": [60, 0]}], "start": 60}
    body = {"dragon": {"benches": 5}, "path": lane, "venue": box(-70, -9, 70, 0.35 + 1e-14), "margin": 0.2, "start": 0}
    answer = json.loads(checked(body, "--json"))
    assert (answer["verdict"], answer["passed"]) == ("undecided", False)
    report = checked(body)
    assert report.startswith("Undecided. No failure is known, but these questions are open:\n")
    assert "fails" not in report


def test_the_dance_is_drawn_in_its_venue(dance):
    figure = dance.with_name("dance.svg")
    said("check", str(dance), "--figure", str(figure), "--time", "15", "--json", aside=f"{figure}\n")
    drawn = figure.read_text()
    assert " square -->" in drawn
    run("check", str(dance), "--figure", str(figure))
    assert figure.read_text() == drawn  # at the first failure


def test_the_dance_that_is_judged_is_written_as_a_table(dance):
    simple = json.dumps({name: BODY[name] for name in ("dragon", "path")})
    for ending in ("json", "csv", "xlsx"):
        judged, table = (dance.with_name(f"{name}.{ending}") for name in ("judged", "table"))
        assert run("check", str(dance), "--output", str(judged)).stderr == f"{judged}\n"
        run("trajectory", "-", "--start", "15", "--stop", "60", "--output", str(table), text=simple)
        assert judged.read_bytes() == table.read_bytes()


@pytest.mark.parametrize("more", [LANES[0], {"dances": LANES}], ids=["one", "several"])
def test_the_last_second_of_a_table_is_not_after_the_end_of_a_path(tmp_path, more):
    table = tmp_path / "lane.csv"
    text = json.dumps({"start": 10, "start_clock": "19:30", **more})
    assert run("check", "-", "--output", str(table), text=text).stderr == f"{table}\n"
    stop = json.loads(said("check", "-", "--json", text=text))["stop"]
    assert stop % 1.0 > 0.999
    first, *_, last = csv.DictReader(table.read_text().splitlines())
    assert (float(first["time"]), first["clock"], float(last["time"])) == (10.0, "19:30:10", stop)

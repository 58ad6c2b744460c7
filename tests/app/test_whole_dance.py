"""Parts of a dance in addition to its path: passages, place of the spiral, names of benches, time of day."""

import csv
import json

import pytest

import core
from app.wire.benches import bench_table
from app.wire.clocks import time_of_day
from tests.support.asking import assert_motion, box, line, written
from tests.support.command import refusal, run, said
from tests.support.paper import sheets_of

NAMES = ["Zhou", "Li, the elder", "", "Wu"]
DRAGON = {"lengths": [3.41, 2.2, 2.2, 2.2], "widths": [0.3] * 4, "overhangs": [0.275] * 4}
SPIRAL = {"kind": "spiral", "centre": [30, -8], "rotation": 0.4, "clockwise": False}
PASSAGES = [{"speed": 0.5, "until_s": 20}, {"speed": 0, "until_time": 100}]
DANCE = {"dragon": DRAGON | {"names": NAMES}, "path": SPIRAL, "passages": PASSAGES}
CLOCK = {"start_clock": "19:30"}
TABLE = """name;length;width;overhang
Zhou;3,41;0,3;0,275
"Li, the elder";2,2;0,3;0,275

;2,2;0,3;0,275
Wu;2,2;0,3;0,275
"""
TOML = """
start_clock = 19:30:00
dragon = "benches.csv"
passages = [{speed = 0.5, until_s = 20}, {speed = 0, until_time = 100}]
path = {kind = "spiral", centre = [30, -8], rotation = 0.4, clockwise = false}
speed_limit = 0.9
stop = 400
"""
PLACED = core.Dance(
    core.Dragon.of(*DRAGON.values()).named(NAMES),
    core.Spiral(0.55, 16.0, (30.0, -8.0), 0.4, clockwise=False),
    1.0,
    [core.Passage(0.5, 20.0), core.Passage(0.0, None, 100.0)],
)
ON_LANE = {"dragon": {"benches": 4}, "path": line((0, 0), (60, 0))}


# -- places, speeds and names --------------------------------------------------------------------------------


def test_places_and_speeds_of_a_dance_with_passages_and_pauses_are_those_of_core(ask):
    body = DANCE | CLOCK | {"times": [10.0, 50.0, 130.25]}
    got = ask("trajectory", body)
    assert_motion(got, core.trajectory(PLACED, body["times"]))
    assert got["speed"][1] == [0.0] * 5
    assert ask("trajectory", body | {"dragon": {"csv": TABLE}}) == got


def test_failures_say_who_and_at_what_time_of_day(ask):
    got = ask("check", DANCE | CLOCK | {"venue": box(20, -18, 40, -6), "speed_limit": 0.9, "stop": 150})
    values = {failure["kind"]: failure for failure in got["failures"]}
    speed = values["speed"]
    outside = values["outside"]
    assert (speed["time"], speed["clock"], speed["names"]) == (100, "19:31:40", ["Zhou"])
    assert outside["names"] == [NAMES[outside["benches"][0]]]


def test_the_proof_of_a_dance_with_passages_is_that_of_its_places(tmp_path):
    body = {"dragon": {"benches": 4}, "path": SPIRAL | {"start_turns": 5}, "passages": PASSAGES, "stop": 104}
    done = run("prove", "dance", written(tmp_path, body), "--output", str(tmp_path / "proof.json"))
    assert "about places" in done.stderr
    claim = json.loads((tmp_path / "proof.json").read_text())["claim"]
    assert (claim["start"], claim["stop"]) == (0.0, 24.0)  # the head is 24 m on at 104 s


# -- tables of benches ---------------------------------------------------------------------------------------


def test_a_file_may_name_a_table_of_benches_and_a_time_of_day(tmp_path):
    benches, dance, table = (tmp_path / name for name in ("benches.csv", "dance.toml", "all.csv"))
    benches.write_bytes(TABLE.replace("Wu", "吴").encode("gb18030"))
    dance.write_text(TOML)
    done = run("check", str(dance), "--output", str(table))
    assert f"{benches} is not in UTF-8; it was read as GB 18030." in done.stderr
    assert "19:31:40  Handle 0 first exceeds 0.9 m/s at 100.000000 s" in done.stdout
    rows = table.read_text().splitlines()
    assert rows[0] == "time,handle,x,y,speed,name,clock"
    assert '"Li, the elder",19:30:00' in rows[2]
    benches.write_text(TABLE.replace("Wu;2,2", "Wu;220"))
    text = "line 6: length must be from 0.001 to 50 m, got 220 m: lengths are in metres, and 220 cm is 2.2 m"
    refused = refusal("check", str(dance)).replace("\n", " ")
    assert f"{benches}: {text}" in refused
    assert "dragon.csv" not in refused


BARE_TABLE = "Zhou,3.41,0.3,0.275\nLi,2.2,0.3,0.275\n"


@pytest.mark.parametrize(
    "text",
    [
        f"name,length,width,overhang\n{BARE_TABLE}",
        BARE_TABLE,
        f"\n\n{BARE_TABLE}",
        "3.41,0.3,0.275\n2.2,0.3,0.275\n",
        "Zhou\t3,41\t0,3\t0,275\nLi\t2,2\t0,3\t0,275\n",
        "Zhou;3,41;0,3;0,275\nLi;2,2;0,3;0,275\n",
        "name\tlength\twidth\toverhang\nZhou\t3,41\t0,3\t0,275\nLi\t2,2\t0,3\t0,275\n",
        "sep=;\nlength;name;overhang;width\n3,41;Zhou;0,275;0,3\n2,2;Li;0,275;0,3\n",
        f"sep=,\n{BARE_TABLE}",
        "sep=\t\n3,41\t0,3\t0,275\n2,2\t0,3\t0,275\n",
        "名称;长度;宽度;孔心距板头\nZhou;3,41;0,3;0,275\nLi;2,2;0,3;0,275\n",
        "\ufeff姓名\tLength [m]\twidth\toverhang\nZhou\t3,41\t0,3\t0,275\n\nLi\t2,2\t0,3\t0,275\n",
        "name,length,width,overhang\nZhou,3.41,0.3,0.275,,\nLi,2.2,0.3,0.275\n,,,\n",
    ],
)
def test_a_table_is_read_however_a_spreadsheet_writes_it(text):
    table = bench_table(text)
    assert (table.lengths, table.widths, table.overhangs) == ([3.41, 2.2], [0.3, 0.3], [0.275, 0.275])
    assert table.names in (["Zhou", "Li"], ["", ""])
    assert [text.splitlines()[number - 1].strip() != "" for number in table.lines] == [True, True]


# -- times of day --------------------------------------------------------------------------------------------


def test_the_day_begins_again_at_midnight():
    times = {0.0: "23:59:30", 29.999: "23:59:59", 30.0: "00:00:00", 86_400.0: "23:59:30"}
    assert {time: time_of_day(time, "23:59:30") for time in times} == times


@pytest.mark.parametrize("more", [{}, {"start": 20.25}], ids=["whole dragon on the path", "start"])
def test_the_dance_starts_at_its_time_of_day_and_the_verdict_says_when_it_ends(ask, more):
    body = ON_LANE | {"speed_limit": 0.5} | more
    report, without, at_zero = (ask("check", body | clock) for clock in ({"begin_clock": "19:30"}, {}, CLOCK))
    ends = f"19:30:{int(report['stop'] - report['start']):02d}"
    assert report["begins"] == "19:30:00"
    assert report["ends"] == ends
    assert [failure["clock"] for failure in report["failures"]] == ["19:30:00"]
    assert without["begins"] is None
    assert without["ends"] is None
    assert at_zero["begins"] == time_of_day(report["start"], "19:30")


@pytest.mark.parametrize("call", ["cues", "crew"])
def test_what_people_hold_begins_when_a_dance_does_that_begins_before_time_0(ask, call):
    lane = {"kind": "route", "start": 26, "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}]}
    body = {"dragon": {"benches": 5}, "path": lane, "begin_clock": "19:30"}
    held = ask(call, body)
    report = ask("check", body)
    first = held["cards"][0]["begin"] if call == "cues" else {"time": held["start"]}
    assert report["start"] == first["time"] < 0.0


@pytest.mark.parametrize(
    "file, options, begin",
    [({"start": 20}, "", 20.0), ({"start": 20}, "--start 22", 20.0), ({}, "--start 22", 7.81)],
)
def test_a_dance_starts_at_its_time_of_day_wherever_a_table_begins(tmp_path, file, options, begin):
    dance = written(tmp_path, ON_LANE | {"begin_clock": "19:30"} | file)
    table = tmp_path / "all.csv"
    said("trajectory", dance, *options.split(), "--output", str(table), aside=None)
    first = next(csv.DictReader(table.read_text().splitlines()))
    assert first["clock"] == f"19:30:{int(float(first['time']) - begin):02d}"


# -- lengths of passages, and beats --------------------------------------------------------------------------

BEATS = [
    {"bars": 4, "tempo": 96, "step": 0.6},
    {"bars": 2, "tempo": 60, "step": 0},
    {"bars": 8, "tempo": 120, "step": 0.45},
]
MARCH = {"dragon": {"benches": 6}, "path": line((0, 0), (80, 0), start=20)}


MARCHED = [
    {"speed": 0.96, "until_time": 10},
    {"speed": 0, "until_time": 18},
    {"speed": 0.9, "until_time": 34},
]
LASTING = [{"speed": 0.96, "duration": 10}, {"speed": 0, "duration": 8}, {"speed": 0.9, "duration": 16}]


@pytest.mark.parametrize("same", [{"passages": LASTING}, {"beats": BEATS}], ids=["durations", "beats"])
def test_durations_and_beats_give_the_speeds_that_their_passages_give(ask, same):
    for call in ("check", "trajectory"):
        assert ask.file(call, MARCH | CLOCK | same) == ask.file(call, MARCH | CLOCK | {"passages": MARCHED})


def test_a_plan_counts_in_bars_and_beats(ask):
    sheets = sheets_of(ask.file("plan", MARCH | {"beats": BEATS, "head_speed": 0.9}, "application/pdf"))
    assert "5.1 0:10.0" in " ".join(sheets)

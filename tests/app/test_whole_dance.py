"""Parts of a dance in addition to its path: passages, place of the spiral, names of benches, time of day."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pypdfium2
import pytest

import core
from app.files.film import FilmPicture
from app.files.film_spec import FilmSpec
from app.wire.benches import bench_table
from app.wire.clocks import time_of_day
from core import InvalidValue
from tests.support.command import run

NAMES = ["Zhou", "Li, the elder", "", "Wu"]
DRAGON = {"lengths": [3.41, 2.2, 2.2, 2.2], "widths": [0.3] * 4, "overhangs": [0.275] * 4, "names": NAMES}
SPIRAL = {"kind": "spiral", "centre": [30, -8], "rotation": 0.4, "clockwise": False}
PASSAGES = [{"speed": 0.5, "until_s": 20}, {"speed": 0, "until_time": 100}]
DANCE: dict[str, Any] = {"dragon": DRAGON, "path": SPIRAL, "passages": PASSAGES, "start_clock": "19:30"}
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
    core.Dragon.of(DRAGON["lengths"], DRAGON["widths"], DRAGON["overhangs"]).named(NAMES),
    core.Spiral(0.55, 16.0, (30.0, -8.0), 0.4, clockwise=False),
    1.0,
    [core.Passage(0.5, 20.0), core.Passage(0.0, None, 100.0)],
)


def posted(client: httpx.Client, call: str, **body: Any) -> httpx.Response:
    return client.post(call, json=DANCE | body)


def test_a_table_has_places_speeds_names_and_the_time_of_day(client: httpx.Client) -> None:
    times = [10.0, 50.0, 130.25]
    got = posted(client, "/trajectory", times=times).raise_for_status().json()
    known = core.trajectory(PLACED, times)
    assert np.stack([got["x"], got["y"]], axis=-1).tolist() == known.position.tolist()
    assert got["speed"] == known.speed.tolist()
    assert got["speed"][1] == [0.0] * 5
    text = client.post("/trajectory", json=DANCE | {"times": times}, headers={"accept": "text/csv"}).text
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["name"] for row in rows[:5]] == ["Zhou", "Li, the elder", "body 2", "Wu", "Wu (rear)"]
    assert [row["clock"] for row in rows[::5]] == ["19:30:10", "19:30:50", "19:32:10"]


def test_no_name_in_a_table_is_a_formula_for_a_spreadsheet_and_our_own_table_reads_back(client: httpx.Client) -> None:
    names = ["=HYPERLINK(1)", "@SUM(A1)", "+1+1", "-2", "'quoted'"]
    dragon = {"lengths": [2.2] * 5, "widths": [0.3] * 5, "overhangs": [0.275] * 5, "names": names}
    request = {"dragon": dragon, "times": [0.0]}
    text = client.post("/trajectory", json=request, headers={"accept": "text/csv"}).raise_for_status().text
    cells = [row["name"] for row in csv.DictReader(io.StringIO(text))]
    assert cells[:5] == ["'=HYPERLINK(1)", "'@SUM(A1)", "'+1+1", "'-2", "'quoted'"]
    table = "\n".join(["name,length,width,overhang", *(f"{cell},2.2,0.3,0.275" for cell in cells[:5])])
    assert list(bench_table(table).to_dragon().names) == names


def test_failures_say_who_and_at_what_time_of_day(client: httpx.Client) -> None:
    square = {"type": "Polygon", "coordinates": [[[20, -18], [40, -18], [40, -6], [20, -6], [20, -18]]]}
    got = posted(client, "/check", venue=square, speed_limit=0.9, stop=150).raise_for_status().json()
    values = {failure["kind"]: failure for failure in got["failures"]}
    assert (values["speed"]["time"], values["speed"]["clock"], values["speed"]["names"]) == (100, "19:31:40", ["Zhou"])
    assert values["outside"]["names"] == [NAMES[values["outside"]["benches"][0]]]
    assert got["highest_speed"]["passage"] is None
    assert f"Bench {values['outside']['benches'][0]} (" in values["outside"]["message"]


def test_a_file_may_name_a_table_of_benches_and_a_time_of_day(tmp_path: Path) -> None:
    (tmp_path / "benches.csv").write_text(TABLE, encoding="utf-8")
    (tmp_path / "dance.toml").write_text(TOML, encoding="utf-8")
    done = run("check", str(tmp_path / "dance.toml"), "--output", str(tmp_path / "all.csv"))
    assert done.returncode == 0, done.stderr
    assert "19:31:40  Handle 0 first exceeds 0.9 m/s at 100.000000 s" in done.stdout
    rows = (tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0] == "time,handle,x,y,speed,name,clock"
    assert '"Li, the elder",19:30:00' in rows[2]
    (tmp_path / "benches.csv").write_text(TABLE.replace("Wu;2,2", "Wu;220"), encoding="utf-8")
    refused = run("check", str(tmp_path / "dance.toml"))
    assert refused.returncode == 2
    text = "line 6: length must be from 0.001 to 50 m, got 220 m: lengths are in metres, and 220 cm is 2.2 m"
    assert text in refused.stderr.replace("\n", " ")


def test_the_proof_of_a_dance_with_passages_is_that_of_its_places(tmp_path: Path) -> None:
    dance = {"dragon": {"benches": 4}, "path": SPIRAL | {"start_turns": 5}, "passages": PASSAGES, "stop": 104}
    (tmp_path / "dance.json").write_text(json.dumps(dance))
    done = run("prove", "dance", str(tmp_path / "dance.json"), "--output", str(tmp_path / "proof.json"))
    assert done.returncode == 0, done.stderr
    assert "about places" in done.stderr
    claim = json.loads((tmp_path / "proof.json").read_text())["claim"]
    assert (claim["start"], claim["stop"]) == (0.0, 24.0)  # the head is 24 m on at 104 s


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1: must be the names of columns"),
        ("length,width\n", "line 1: the column overhang is missing"),
        ("length,width,overhang,weight\n", "line 1: a column must be name, length, width or overhang, got 'weight'"),
        ("length,length,width,overhang\n", "line 1: a column must be named once"),
        ("\n\nlength,width,overhang\n", "line 4: must be the first bench"),
        ("length,width,overhang\n2.2,0.3\n", "line 2: must have 3 entries"),
        ("length,width,overhang\n2.2,wide,0.3\n", "line 2: width must be a number in metres, got 'wide'"),
        ("length,width,overhang\n2.2,nan,0.3\n", "line 2: width must be from"),
        ("length,width,overhang\n\n2.2,0.3,1.1\n", "line 3: overhang must be less than half of the length, 2.2 m"),
    ],
)
def test_a_bad_line_of_a_table_is_named_by_its_number(text: str, words: str) -> None:
    with pytest.raises(InvalidValue, match=r"^line \d") as refused:
        bench_table(text).to_dragon()
    assert refused.value.message.startswith(words)


def test_a_table_may_come_from_a_spreadsheet() -> None:
    wanted = bench_table(TABLE).to_dragon()
    assert wanted == PLACED.dragon
    pasted = TABLE.replace(";", "\t").replace("name", "\ufeff姓名").replace("length", "Length [m]").replace('"', "")
    assert bench_table(pasted).to_dragon() == wanted
    commas = TABLE.replace(",", ".").replace(";", ",").replace("Li. the", "Li, the")
    assert bench_table(commas + ",,,\n").to_dragon() == wanted


@pytest.mark.parametrize(
    ("field", "body"),
    [
        ("/passages/1/until_time", {"passages": [{"speed": 1, "until_s": 5}, {"speed": 0, "until_time": 5}]}),
        ("/passages/0/until_time", {"passages": [{"speed": 0, "until_s": 5}]}),
        ("/passages/0", {"passages": [{"speed": 1}]}),
        ("/passages/0/duration", {"passages": [{"speed": 1, "until_s": 5, "duration": 3}]}),
        ("/passages/0/duration", {"passages": [{"speed": 0, "duration": 0}]}),
        ("/passages/0/speed", {"passages": [{"speed": -1, "until_s": 5}]}),
        ("/path/centre/1", {"path": SPIRAL | {"centre": [0, 1e9]}}),
        ("/path/clockwise", {"path": SPIRAL | {"clockwise": 1}}),
        ("/dragon/names", {"dragon": DRAGON | {"names": ["Zhou"]}}),
        ("/dragon/names/1", {"dragon": {"benches": 2, "names": ["Zhou", "Li\nWu"]}}),
        ("/dragon/csv", {"dragon": {"csv": TABLE.replace("0,3;", "x;")}}),
        ("/start_clock", {"start_clock": "24:00"}),
        ("/begin_clock", {"start_clock": None, "begin_clock": "7:30"}),
    ],
)
def test_each_is_refused_at_its_place(client: httpx.Client, field: str, body: dict[str, Any]) -> None:
    refused = posted(client, "/trajectory", times=[0], **body)
    assert refused.status_code == 422
    assert [error["pointer"] for error in refused.json()["errors"]] == [field], refused.text


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
    ],
)
def test_a_table_is_read_however_a_spreadsheet_writes_it(text: str) -> None:
    table = bench_table(text)
    assert (table.lengths, table.widths, table.overhangs) == ([3.41, 2.2], [0.3, 0.3], [0.275, 0.275])
    assert table.names in (["Zhou", "Li"], ["", ""])
    assert [text.splitlines()[number - 1].strip() != "" for number in table.lines] == [True, True]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Zhou,3.41,0.3\n", 'a column must be name, length, width or overhang, got "Zhou"|got .Zhou.'),
        ("3.41,0.3,0.275\n2.2,0.3\n", "line 2: must have 3 entries, as the first line has, got 2"),
        ("3.41,0.3\n", "line 1: a column must be"),
        ("sep=;\n", "line 1: a column must be"),
        (BARE_TABLE + "Wu,wide,0.3,0.275\n", "line 3: length must be a number in metres"),
    ],
)
def test_a_table_that_is_none_names_its_line(text: str, words: str) -> None:
    with pytest.raises(InvalidValue, match=words):
        bench_table(text)


@pytest.mark.parametrize("coding", ["gb18030", "utf-16", "utf-8-sig", "utf-8"])
def test_a_table_of_a_spreadsheet_is_read_in_its_encoding(tmp_path: Path, coding: str) -> None:
    lines = "名称,长度,宽度,孔距\n周,3.41,0.3,0.275\n李,2.2,0.3,0.275\n"
    (tmp_path / "benches.csv").write_bytes(lines.encode(coding))
    (tmp_path / "dance.json").write_text('{"dragon": "benches.csv", "stop": 5}')
    done = run("check", str(tmp_path / "dance.json"), "--json")
    assert done.returncode == 0, done.stderr
    note = f"{tmp_path / 'benches.csv'} is not in UTF-8; it was read as GB 18030."
    assert (note in done.stderr) == (coding == "gb18030")


def test_a_workbook_of_benches_is_refused_with_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "benches.xlsx").write_bytes(b"PK\3\4" + bytes(99))
    (tmp_path / "dance.json").write_text('{"dragon": "benches.xlsx"}')
    done = run("check", str(tmp_path / "dance.json"))
    assert done.returncode == 2
    assert "benches.xlsx is a workbook: save its sheet as CSV" in " ".join(done.stderr.split())


def test_a_table_of_benches_is_a_dragon_in_every_body(client: httpx.Client) -> None:
    ours = posted(client, "/trajectory", times=[40], dragon={"csv": TABLE}).raise_for_status().json()
    assert ours == posted(client, "/trajectory", times=[40]).raise_for_status().json()


def test_the_day_begins_again_at_midnight() -> None:
    assert [time_of_day(time, "23:59:30") for time in (0.0, 29.999, 30.0, 86_400.0)] == [
        "23:59:30", "23:59:59", "00:00:00", "23:59:30",
    ]  # fmt: skip


LANE = {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}]}


@pytest.mark.parametrize("more", [{}, {"start": 20.25}], ids=["whole dragon on the path", "start"])
def test_the_dance_starts_at_its_time_of_day_and_the_verdict_says_when_it_ends(
    client: httpx.Client, more: dict[str, Any]
) -> None:
    body = {"dragon": {"benches": 4}, "path": LANE, "speed_limit": 0.5, **more}
    report = client.post("/check", json=body | {"begin_clock": "19:30"}).raise_for_status().json()
    assert report["start"] % 1.0 > 0.1
    length = int(report["stop"] - report["start"])
    assert (report["begins"], report["ends"]) == ("19:30:00", f"19:30:{length:02d}")
    assert [failure["clock"] for failure in report["failures"]] == ["19:30:00"]
    answer = client.post("/check", json=body).raise_for_status().json()
    assert (answer["begins"], answer["ends"]) == (None, None)
    at_zero = client.post("/check", json=body | {"start_clock": "19:30"}).raise_for_status().json()
    assert at_zero["begins"] == time_of_day(report["start"], "19:30")


@pytest.mark.parametrize(
    ("file", "start", "begin"),
    [({"start": 20}, [], 20.0), ({"start": 20}, ["--start", "22"], 20.0), ({}, ["--start", "22"], None)],
    ids=["start of the file", "later", "whole dragon on the path"],
)
def test_a_dance_starts_at_its_time_of_day_wherever_a_table_begins(
    tmp_path: Path, file: dict[str, Any], start: list[str], begin: float | None
) -> None:
    dance, table = tmp_path / "dance.json", tmp_path / "all.csv"
    body = {"dragon": {"benches": 4}, "path": LANE, "begin_clock": "19:30", **file}
    dance.write_text(json.dumps(body))
    done = run("trajectory", str(dance), *start, "--output", str(table))
    assert done.returncode == 0, done.stderr
    first = next(csv.DictReader(table.read_text().splitlines()))
    begin = core.Dance(core.Dragon(4), core.Route([core.Line((0, 0), (60, 0))])).begin if begin is None else begin
    assert first["clock"] == f"19:30:{int(float(first['time']) - begin):02d}"


def test_two_times_of_day_are_refused(client: httpx.Client) -> None:
    refused = client.post(
        "/check", json={"path": LANE, "dragon": {"benches": 2}, "start_clock": "19:30", "begin_clock": "19:31"}
    )
    assert refused.status_code == 422
    assert "begin_clock must be left out beside start_clock, the time of day at time 0" in refused.json()["detail"]


def test_a_film_shows_the_time_of_day() -> None:
    stage = FilmPicture(PLACED, FilmSpec(0.0, 130.0, height=90, start_clock="19:30"), None, "")
    stage.frame(101.5, core.bench_outlines(PLACED.dragon, core.trajectory(PLACED, 101.5).position))
    assert stage.time.text == "19:31:41 (101.50 s)"


def test_a_pause_has_a_length(client: httpx.Client) -> None:
    body = {"path": LANE, "dragon": {"benches": 2}, "head_speed": 1}
    until = [{"speed": 0.5, "until_s": 5}, {"speed": 0, "until_time": 17.5}, {"speed": 2, "until_time": 20}]
    lasting = [{"speed": 0.5, "until_s": 5}, {"speed": 0, "duration": 7.5}, {"speed": 2, "duration": 2.5}]
    first, second = (
        client.post("/check", json=body | {"passages": one}).raise_for_status() for one in (until, lasting)
    )
    assert first.json() == second.json()
    refused = client.post("/check", json=body | {"passages": [{"speed": 0, "until_time": 5, "duration": 3}]})
    assert "must be left out beside passages[0].until_time" in refused.json()["detail"] or "until_time" in refused.text


BEATS = [
    {"bars": 4, "tempo": 96, "step": 0.6},
    {"bars": 2, "tempo": 60, "step": 0},
    {"bars": 8, "tempo": 120, "step": 0.45},
]
LONG_LANE = {"kind": "route", "start": 20, "pieces": [{"kind": "line", "start": [0, 0], "end": [80, 0]}]}


def test_beats_give_the_speeds_that_their_passages_give(client: httpx.Client) -> None:
    passages = [{"speed": 0.96, "until_time": 10}, {"speed": 0, "until_time": 18}, {"speed": 0.9, "until_time": 34}]
    body = {"dragon": {"benches": 6}, "path": LONG_LANE, "start_clock": "19:30"}
    for name in ("check", "trajectory"):
        answers = [client.post(f"/{name}", json=body | speeds) for speeds in ({"beats": BEATS}, {"passages": passages})]
        assert answers[0].raise_for_status().content == answers[1].content


def test_cards_and_plan_count_in_bars_and_beats(client: httpx.Client) -> None:
    body = {"dragon": {"benches": 6}, "path": LONG_LANE, "beats": BEATS, "head_speed": 0.9}
    body |= {"first_bench": 2, "last_bench": 2}
    cues = client.post("/cues", json=body).raise_for_status().json()["cards"][0]["cues"]
    assert [(cue["kind"], cue["count"]) for cue in cues] == [("begin", "1.1"), ("pause", "5.1"), ("done", None)]
    assert "until 7.1 0:18.0" in cues[1]["words"]
    table = client.post("/cues", json=body, headers={"accept": "text/csv"}).raise_for_status().text
    assert [line["count"] for line in csv.DictReader(io.StringIO(table))] == ["", "1.1", "5.1", ""]
    texts = []
    for name in ("cues", "plan"):
        request = {key: value for key, value in body.items() if name == "cues" or "bench" not in key}
        data = client.post(f"/{name}", json=request, headers={"accept": "application/pdf"}).raise_for_status().content
        texts.append(" ".join(page.get_textpage().get_text_bounded() for page in pypdfium2.PdfDocument(data)))
    assert "5.1" in texts[0]
    assert "5.1 0:10.0" in texts[1]


@pytest.mark.parametrize(
    ("change", "pointer", "words"),
    [
        ({"beats": [{"bars": 16, "tempo": 0, "step": 0.6}]}, "/beats/0/tempo", "tempo must be at least 10"),
        (
            {"beats": [{"bars": 16, "tempo": 96, "step": 0.001}]},
            "/beats/0/step",
            "must be 0, to mark time, or at least",
        ),
        ({"beats": [{"bars": 0.5, "tempo": 96, "step": 1}]}, "/beats/0/bars", "bars must be a whole number"),
        ({"beats": BEATS, "passages": PASSAGES}, "/passages", "passages must be left out beside beats"),
    ],
    ids=["tempo 0", "tiny step", "half a bar", "both"],
)
def test_beats_that_cannot_be_are_refused(client: httpx.Client, change: Any, pointer: str, words: str) -> None:
    refused = client.post("/check", json={"dragon": {"benches": 6}, "path": LONG_LANE} | change)
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"] == pointer
    assert words in refused.json()["detail"]

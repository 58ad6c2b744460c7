"""Tables of several dragons in every form, over HTTP and from a terminal: the numbers of core, and who has them."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import openpyxl
import pyarrow as pa
import pytest

from app.files.performance_tables import PerformanceTable, performance_file
from app.files.tables import ARROW_TYPE, CSV_TYPE, XLSX_TYPE, Language
from app.questions.trajectory import TrajectoryRequest
from app.settings import Settings
from core import TooLarge, performance_trajectory
from core.values import Floats
from tests.support.command import run
from tests.support.job_service import wait_for

FIVE: dict[str, Any] = {"benches": 5, "names": ["Zhou", "Wu", "", 'Zheng, "Wang"', "=Feng"]}
TWO: dict[str, Any] = {
    "dances": [
        {"name": "east", "dragon": {"benches": 4}, "path": {"kind": "waypoints", "points": [[0, 0], [40, 0]]}},
        {"dragon": FIVE, "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}, "delay": 12.5},
    ],
    "times": [5, 20, 45.25, 60],
    "start_clock": "19:30",
}
TIMES = np.array(TWO["times"], dtype=np.float64)


def results() -> list[tuple[Floats, Floats]]:
    """Positions (T, H, 2) and speeds (T, H) of each dragon."""
    performance = TrajectoryRequest.model_validate(TWO).to_performance(Settings())
    return [(one.position, one.speed) for one in performance_trajectory(performance, TIMES)]


def ask(client: httpx.Client, form: str = "application/json", **more: Any) -> httpx.Response:
    return client.post("/trajectory", json=TWO | more, headers={"accept": form}).raise_for_status()


def test_json_has_a_table_for_each_dragon(client: httpx.Client) -> None:
    got = ask(client).json()
    assert got["time"] == TIMES.tolist()
    assert [one["name"] for one in got["dances"]] == ["east", None]
    for one, (position, speed) in zip(got["dances"], results(), strict=True):
        assert (one["x"], one["y"]) == (position[..., 0].tolist(), position[..., 1].tolist())
        assert one["speed"] == speed.tolist()
    assert got["dances"][1]["speed"][0] == [0.0] * 6  # it waits
    rounded = ask(client, decimals=2).json()
    assert rounded["dances"][0]["x"] == np.round(results()[0][0][..., 0], 2).tolist()


def test_one_of_several_alone_has_the_numbers_of_one_dance(client: httpx.Client) -> None:
    east = TWO["dances"][0]
    several = client.post("/trajectory", json={"dances": [east], "times": [15, 20]}).raise_for_status().json()
    alone = {name: east[name] for name in ("dragon", "path")} | {"times": [15, 20]}
    one = client.post("/trajectory", json=alone).raise_for_status().json()
    assert several == {"time": one.pop("time"), "dances": [{"name": "east"} | one]}


def test_csv_has_the_dragon_before_each_line(client: httpx.Client) -> None:
    lines = list(csv.reader(io.StringIO(ask(client, CSV_TYPE).text)))
    assert lines[0] == ["dragon", "dragon_name", "time", "handle", "x", "y", "speed", "name", "clock"]
    rows = iter(lines[1:])
    names = [
        ["head", "body 1", "body 2", "tail", "tail (rear)"],
        ["Zhou", "Wu", "body 2", 'Zheng, "Wang"', "'=Feng", "'=Feng (rear)"],
    ]
    clocks = ["19:30:05", "19:30:20", "19:30:45", "19:31:00"]
    for k, (position, speed) in enumerate(results()):
        for t, time in enumerate(TIMES.tolist()):
            for handle in range(speed.shape[1]):
                row = next(rows)
                assert row[:2] == [str(k), "east" if k == 0 else ""]
                values = [time, handle, *position[t, handle].tolist(), speed[t, handle].item()]
                assert [float(word) for word in row[2:7]] == values
                assert row[7:] == [names[k][handle], clocks[t]]
    assert next(rows, None) is None
    part = TWO["dances"][0] | {"name": None}
    body = {"dances": [part, part], "times": [20]}
    text = client.post("/trajectory", json=body, headers={"accept": CSV_TYPE}).raise_for_status().text
    assert text.splitlines()[0] == "dragon,time,handle,x,y,speed"
    assert [line[:2] for line in text.splitlines()[1:]] == ["0,"] * 5 + ["1,"] * 5


def test_arrow_has_the_columns_of_the_csv(client: httpx.Client) -> None:
    table = pa.ipc.open_file(pa.BufferReader(ask(client, ARROW_TYPE).content)).read_all()
    assert table.column_names == ["dragon", "time", "handle", "x", "y", "speed"]
    assert table["dragon"].to_pylist() == [0] * 20 + [1] * 24
    for first, (position, speed) in zip((0, 20), results(), strict=True):
        own = table.slice(first, speed.size)
        assert own["x"].to_pylist() == position[..., 0].ravel().tolist()
        assert own["speed"].to_pylist() == speed.ravel().tolist()


def test_a_workbook_has_two_sheets_for_each_dragon(client: httpx.Client) -> None:
    book = openpyxl.load_workbook(io.BytesIO(ask(client, XLSX_TYPE).content))
    assert book.sheetnames == ["positions 0", "speeds 0", "positions 1", "speeds 1"]
    position, _ = results()[1]
    rows = list(book["positions 1"].values)
    assert [row[0] for row in rows[1:5]] == ["Zhou x (m)", "Zhou y (m)", "Wu x (m)", "Wu y (m)"]
    assert rows[1][1:] == tuple(np.round(position[:, 0, 0], 6).tolist())


def test_a_workbook_may_be_chinese_and_refuses_too_many_columns() -> None:
    performance = TrajectoryRequest.model_validate(TWO).to_performance(Settings())
    table = PerformanceTable(performance, performance_trajectory(performance, TIMES), language=Language.CHINESE)
    assert "位置 0" in openpyxl.load_workbook(io.BytesIO(performance_file(".xlsx", table))).sheetnames
    many = performance_trajectory(performance, np.linspace(15.0, 20.0, 20_000))
    with pytest.raises(TooLarge, match="xlsx holds at most"):
        performance_file(".xlsx", PerformanceTable(performance, many))


@pytest.mark.parametrize(
    ("wrong", "pointer", "words"),
    [
        ({"beats": []}, "/beats", "beats must stand in each of the dances, got it beside them"),
        ({"times": {"start": 9, "stop": 5}}, "/times/stop", "times.stop must not be before times.start (9 s), got 5 s"),
        ({"times": {"step": 1e-6}}, "/times/step", "instants x handles must be at most"),
    ],
)
def test_a_wrong_value_is_refused(client: httpx.Client, wrong: dict[str, Any], pointer: str, words: str) -> None:
    refused = client.post("/trajectory", json=TWO | wrong)
    assert refused.status_code == 422
    (error,) = refused.json()["errors"]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)


def test_the_command_and_a_job_write_what_the_service_says(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text(json.dumps(TWO))
    known = ask(client).content
    job = client.post("/trajectory", json=TWO, headers={"Prefer": "respond-async"})
    address = f"{job.headers['location']}/result"
    wait_for(lambda: client.get(address).status_code == 200)
    assert client.get(address).content == known
    assert run("trajectory", str(file), "--json").stdout.encode() == known + b"\n"
    for ending, form in ((".csv", CSV_TYPE), (".arrow", ARROW_TYPE), (".xlsx", XLSX_TYPE)):
        output = tmp_path / f"two{ending}"
        done = run("trajectory", str(file), "--output", str(output))
        assert (done.returncode, done.stderr) == (0, f"{output}: 11 handles at 4 instants\n")
        assert output.read_bytes() == ask(client, form).content
    result = run("trajectory", str(file), "--handles", "0,4")
    assert (result.returncode, result.stderr) == (0, "")
    for words in ("east: x [m]", "dragon 1: speed [m/s]", "4 =Feng", "2 of 6 handles, 4 of 4 instants"):
        assert words in result.stdout
    assert "must be from 0 to 4 for this dragon, got 5" in run("trajectory", str(file), "--handles", "0,5").stderr


def test_check_writes_every_second_of_the_judged_time(tmp_path: Path) -> None:
    file, table = tmp_path / "two.json", tmp_path / "two.csv"
    file.write_text(json.dumps({name: TWO[name] for name in ("dances", "start_clock")} | {"start": 20, "stop": 24.5}))
    assert run("check", str(file), "--output", str(table)).returncode == 0
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [row["time"] for row in rows if (row["dragon"], row["handle"]) == ("1", "0")] == [
        "20.0",
        "21.0",
        "22.0",
        "23.0",
        "24.0",
    ]
    assert rows[0]["clock"] == "19:30:20"

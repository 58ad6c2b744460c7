"""Tables of several dragons in every form, over HTTP and from a terminal: the numbers of core, and who has them."""

import csv
import io
import json

import numpy as np
import openpyxl
import pyarrow as pa
import pytest

from app.files.performance_tables import PerformanceTable, performance_xlsx
from app.files.tables import ARROW_TYPE, CSV_TYPE, XLSX_TYPE
from app.questions.trajectory import TrajectoryRequest
from app.settings import Settings
from core import TooLarge, trajectory
from core.language import speaking

TWO = json.loads("""{"dances": [
    {"name": "east", "dragon": {"benches": 4}, "path": {"kind": "waypoints", "points": [[0, 0], [40, 0]]}},
    {"dragon": {"benches": 5, "names": ["Zhou", "Wu", "", "Zheng, \\"Wang\\"", "=Feng"]}, "delay": 12.5,
     "path": {"kind": "waypoints", "points": [[15, -20], [15, 20]]}}
], "times": [5, 20, 45.25, 60], "start_clock": "19:30"}""")
TIMES = np.array(TWO["times"], dtype=np.float64)


def results():
    """Positions (T, H, 2) and speeds (T, H) of each dragon."""
    performance = TrajectoryRequest.model_validate(TWO).to_performance(Settings())
    return [(one.position, one.speed) for one in trajectory(performance, TIMES)]


def test_json_has_a_table_for_each_dragon(ask):
    for decimals in (None, 2):
        got = ask("trajectory", TWO | {"decimals": decimals})
        assert got["time"] == TIMES.tolist()
        assert [table["name"] for table in got["dances"]] == ["east", None]
        for table, (position, speed) in zip(got["dances"], results(), strict=True):
            known = np.stack([position[..., 0], position[..., 1], speed])
            assert [table["x"], table["y"], table["speed"]] == (known.round(decimals) if decimals else known).tolist()


def test_csv_has_the_dragon_before_each_line(ask):
    heads, *lines = csv.reader(io.StringIO(ask.file("trajectory", TWO, CSV_TYPE).decode()))
    assert heads == ["dragon", "dragon_name", "time", "handle", "x", "y", "speed", "name", "clock"]
    names = ["head", "body 1", "body 2", "tail", "tail (rear)"], [
        "Zhou", "Wu", "body 2", 'Zheng, "Wang"', "'=Feng", "'=Feng (rear)",
    ]  # fmt: skip
    clocks = ["19:30:05", "19:30:20", "19:30:45", "19:31:00"]
    assert [[*line[:2], *map(float, line[2:7]), *line[7:]] for line in lines] == [
        [*own, time, handle, *position[t, handle], speed[t, handle], name, clocks[t]]
        for own, (position, speed), labels in zip((["0", "east"], ["1", ""]), results(), names, strict=True)
        for t, time in enumerate(TIMES.tolist())
        for handle, name in enumerate(labels)
    ]


NAMELESS = TWO | {"dances": [TWO["dances"][0] | {"name": None}] * 2, "start_clock": None}
ALONE = {"dragon": {"benches": 5}, "times": [0, 0.5, 10]}


@pytest.mark.parametrize("body, own", [(NAMELESS, ["dragon"]), (ALONE, [])], ids=["several", "one"])
def test_without_names_and_clock_csv_has_no_columns_for_them_and_arrow_has_the_same(ask, body, own):
    lines = list(csv.reader(io.StringIO(ask.file("trajectory", body, CSV_TYPE).decode())))
    assert lines[0] == [*own, "time", "handle", "x", "y", "speed"]
    table = pa.ipc.open_file(pa.BufferReader(ask.file("trajectory", body, ARROW_TYPE))).read_all()
    assert table.column_names == lines[0]
    assert table.to_pydict() == {name: [float(line[k]) for line in lines[1:]] for k, name in enumerate(lines[0])}


def test_a_workbook_has_two_sheets_for_each_dragon_and_refuses_too_many_columns(ask):
    book = openpyxl.load_workbook(io.BytesIO(ask.file("trajectory", TWO, XLSX_TYPE)))
    assert book.sheetnames == ["positions 0", "speeds 0", "positions 1", "speeds 1"]
    position, _ = results()[1]
    rows = list(book["positions 1"].values)
    assert [row[0] for row in rows[1:5]] == ["Zhou x (m)", "Zhou y (m)", "Wu x (m)", "Wu y (m)"]
    assert rows[1][1:] == tuple(np.round(position[:, 0, 0], 6).tolist())
    performance = TrajectoryRequest.model_validate(TWO).to_performance(Settings())
    table = PerformanceTable(performance, trajectory(performance, TIMES))
    with speaking("zh"):
        assert "位置 0" in openpyxl.load_workbook(io.BytesIO(performance_xlsx(table))).sheetnames
    many = trajectory(performance, np.linspace(15.0, 20.0, 20_000))
    with pytest.raises(TooLarge, match="xlsx holds at most"):
        performance_xlsx(PerformanceTable(performance, many))

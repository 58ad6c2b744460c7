"""Tables of benches in workbooks: for the command, over HTTP, and refused where they cannot be read."""

import io
import json

import openpyxl
import pytest

from app.files.tables import XLSX_TYPE
from app.maps.places import places_of
from core import InvalidValue
from tests.support.command import run

ROWS = [
    ["名称", "长度", "宽度", "孔距"],
    ["周, 一", 3.41, 0.3, 0.275],
    [12, 2.2, 0.3, 0.275],
    ["吴", "=2.2", 0.3, 0.275],
]
CSV = '名称,长度,宽度,孔距\n"周, 一",3.41,0.3,0.275\n12,2.2,0.3,0.275\n'


def saved(*sheets):
    book = openpyxl.Workbook()
    for k, rows in enumerate(sheets):
        sheet = book.create_sheet(f"表{k}")
        for row in rows:
            sheet.append(row)
    sink = io.BytesIO()
    book.save(sink)
    return sink.getvalue()


def test_a_workbook_is_the_table_that_a_spreadsheet_would_save_as_csv(client):
    data = saved(ROWS[:3], [["spare", 2.2, 0.3, 0.275]])
    answer = client.post("/places?language=zh", content=data, headers={"Content-Type": XLSX_TYPE})
    assert answer.status_code == 200, answer.text
    got = answer.json()
    assert (got["dance"], got["path"], got["venue"]) == ({"dragon": {"csv": CSV}}, None, None)
    assert got["notes"] == ["板凳取自工作表 表0；未读取：表1。"]
    request = {"dragon": got["dance"]["dragon"], "path": {"kind": "spiral"}}
    assert client.post("/check", json=request).json()["first_contact"]["outcome"]


def test_a_formula_without_a_value_is_reported(client):
    answer = client.post("/places", content=saved(ROWS), headers={"Content-Type": XLSX_TYPE}).json()
    assert answer["dance"]["dragon"]["csv"] == CSV + "吴,,0.3,0.275\n"
    assert answer["notes"] == [
        "Cells with formulas but no stored value: 1, the first is B4. Open and save the workbook in a spreadsheet."
    ]


def test_a_dance_may_name_a_workbook(tmp_path):
    (tmp_path / "benches.xlsx").write_bytes(saved([["a", 3.41, 0.3, 0.275], ["b", 2.2, 0.3, 0.275]], [["left"]]))
    (tmp_path / "benches.csv").write_text("a,3.41,0.3,0.275\nb,2.2,0.3,0.275\n")
    answers = []
    for name in ("benches.xlsx", "benches.csv"):
        (tmp_path / "dance.json").write_text(json.dumps({"dragon": name}))
        answers.append(run("check", str(tmp_path / "dance.json"), "--json"))
    assert answers[0].stdout == answers[1].stdout != ""
    assert "The benches are those of sheet 表0; left out: 表1." in " ".join(answers[0].stderr.split())
    assert answers[1].stderr == ""


@pytest.mark.parametrize(
    "data, words",
    [
        (saved([[]]), "must have a sheet with benches, one in a line, got empty sheets"),
        (saved(ROWS)[:-300], "its archive ends early"),
        (bytes.fromhex("d0cf11e0a1b11ae1") + bytes(600), "must be saved as .xlsx or CSV"),
    ],
    ids=["empty", "truncated", "old"],
)
def test_a_workbook_without_benches_is_refused(data, words):
    with pytest.raises(InvalidValue, match=words):
        places_of(data, None)

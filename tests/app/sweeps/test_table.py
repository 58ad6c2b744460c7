"""The table of a sweep: from parts or from one file, as Parquet, CSV or a DataFrame."""

from __future__ import annotations

import csv
from pathlib import Path

import orjson
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.sweeps import shards
from app.sweeps.run import begin
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep, without_formulas
from core import InvalidValue
from tests.app.sweeps.test_run import spec_of
from tests.support.odd_questions import LAND

SPEC = spec_of(LAND, 40, 7)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A complete sweep."""
    begin(tmp_path, SPEC)
    for shard in range(SPEC.shards):
        shards.write_part(tmp_path, SPEC, shard, [shards.ShardPiece.whole(SPEC, LAND, shard).answer()])
    return tmp_path


def test_compacting_keeps_every_row_and_may_be_done_again(folder: Path) -> None:
    sweep = Sweep(folder, SPEC)
    before = sweep.table()
    first = sweep.compact().read_bytes()
    assert sorted(file.name for file in folder.iterdir()) == ["sweep.json", "sweep.parquet"]
    assert pq.read_table(folder / "sweep.parquet").equals(before)
    assert sweep.table(["height", "x"]).equals(before.select(["height", "x"]))
    assert sweep.compact().read_bytes() == first
    assert sweep.missing == 0


def test_a_kill_between_the_table_and_the_removal_of_the_parts_costs_nothing(folder: Path) -> None:
    part = (folder / shards.part_name(2)).read_bytes()
    whole = Sweep(folder, SPEC).compact().read_bytes()
    (folder / shards.part_name(2)).write_bytes(part)
    assert Sweep(folder, SPEC).compact().read_bytes() == whole
    assert not shards.parts(folder)


def test_an_incomplete_sweep_is_shown_but_not_compacted(folder: Path) -> None:
    (folder / shards.part_name(3)).unlink()
    sweep = Sweep(folder, SPEC)
    assert sweep.table().num_rows == 33
    for refused in (sweep.compact, lambda: sweep.to_csv(folder / "a.csv")):
        with pytest.raises(InvalidValue, match="lacks 1 of 6 shards: run the sweep again"):
            refused()
    assert len(shards.parts(folder)) == 5


def test_csv_has_every_row(folder: Path) -> None:
    Sweep(folder, SPEC).to_csv(folder / "a.csv")
    with (folder / "a.csv").open(newline="") as source:
        rows = list(csv.DictReader(source))
    assert [int(row["design"]) for row in rows] == list(range(40))
    assert [row["height"] for row in rows[:4]] == ["0", "0", "1", "2"]
    assert rows[26]["error.message"] == "x must not be 13 m"


def test_a_dataframe_has_numbers_as_numbers(folder: Path) -> None:
    frame = Sweep.open(folder).to_dataframe()
    assert frame.shape == (40, 10)
    assert frame["height"].sum() == sum(x * y for x in range(20) for y in (1, 2) if x not in (13, 14))
    assert frame["error.code"].value_counts().to_dict() == {"invalid-value": 2, "internal-error": 2}


def test_a_folder_tells_its_sweep(folder: Path) -> None:
    assert Sweep.open(folder).spec == SPEC


def test_a_folder_without_a_sweep_or_of_another_version_is_refused(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(InvalidValue, match="has no sweep"):
        Sweep.open(tmp_path / "nowhere")
    answer = orjson.loads((folder / "sweep.json").read_bytes())
    (folder / "sweep.json").write_bytes(orjson.dumps(answer | {"version": "0.0.1"}))
    with pytest.raises(InvalidValue, match=r"must be of this version, .*, got 0\.0\.1"):
        Sweep.open(folder)


def test_a_folder_without_rows_and_a_column_that_is_not_there_are_refused(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(InvalidValue, match="value must be a column of the sweep, got 'depth': design, x, y, height"):
        Sweep(folder, SPEC).table(["depth"])
    begin(tmp_path / "new", SPEC)
    with pytest.raises(InvalidValue, match="has no rows yet: run the sweep"):
        Sweep.open(tmp_path / "new").table()


def test_a_spec_of_bodies_comes_back_from_its_folder(tmp_path: Path) -> None:
    fields = {
        "question": "check",
        "over": {"path.pitch": [0.5], "dragon.width": {"start": 0.2, "stop": 0.3, "count": 2}},
    }
    spec = Spec.of(fields | {"request": {"dragon": {"benches": 5}}})
    begin(tmp_path / "a", spec)
    assert Sweep.open(tmp_path / "a").spec.name == spec.name


def test_no_text_of_a_table_is_a_formula_for_a_spreadsheet() -> None:
    table = without_formulas(pa.table({"x": [-1.0, 2.0], "error.message": ["=1+1", "x must not be 13 m"]}))
    assert table["x"].to_pylist() == [-1.0, 2.0]
    assert table["error.message"].to_pylist() == ["'=1+1", "x must not be 13 m"]

"""The table of a sweep: from parts or from one file, as Parquet, CSV or a DataFrame."""

import csv

import orjson
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.sweeps import shards
from app.sweeps.run import begin
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep, without_formulas
from tests.support.odd_questions import LAND
from tests.support.refused import refused
from tests.support.sweeping import answered, grid_of

SPEC = grid_of(LAND, 40, 7)


@pytest.fixture
def folder(tmp_path):
    """A complete sweep."""
    return answered(tmp_path, SPEC, LAND).folder


def test_compacting_keeps_every_row_and_may_be_done_again(folder):
    sweep = Sweep.open(folder)
    before = sweep.table()
    part = (folder / shards.part_name(2)).read_bytes()
    first = sweep.compact().read_bytes()
    assert pq.read_table(folder / "sweep.parquet").equals(before)
    assert sweep.table(["height", "x"]).equals(before.select(["height", "x"]))
    # A kill between the table and the removal of the parts costs nothing.
    (folder / shards.part_name(2)).write_bytes(part)
    assert sweep.compact().read_bytes() == first
    assert sorted(file.name for file in folder.iterdir()) == ["sweep.json", "sweep.parquet"]
    assert sweep.missing == 0


def test_an_incomplete_sweep_is_shown_but_not_compacted(folder):
    (folder / shards.part_name(3)).unlink()
    sweep = Sweep(folder, SPEC)
    assert sweep.table().num_rows == 33
    with refused("folder", missing=1):
        sweep.compact()
    with refused("folder", missing=1):
        sweep.to_csv(folder / "a.csv")


def test_csv_and_a_dataframe_have_every_row_and_numbers_as_numbers(folder):
    sweep = Sweep(folder, SPEC)
    sweep.to_csv(folder / "a.csv")
    rows = list(csv.DictReader((folder / "a.csv").read_text().splitlines()))
    frame = sweep.to_dataframe()
    assert [int(row["design"]) for row in rows] == list(frame["design"]) == list(range(40))
    heights = [str(x * y) if x not in (13, 14) else "" for x in range(20) for y in (1, 2)]
    assert [row["height"] for row in rows] == heights
    assert frame["height"].sum() == sum(map(int, filter(None, heights)))
    assert rows[26]["error.message"] == frame["error.message"][26] == "x must not be 13 m"


def test_a_folder_without_a_sweep_of_another_version_or_without_rows_is_refused(folder, tmp_path):
    with refused("folder", file="sweep.json"):
        Sweep.open(tmp_path / "nowhere")
    with refused("value", numbers=("design", "x", "y", "height", "around.0", "around.1")):
        Sweep(folder, SPEC).table(["depth"])
    begin(tmp_path / "new", SPEC)
    with refused("folder", folder=str(tmp_path / "new")):
        Sweep.open(tmp_path / "new").table()
    content = orjson.loads((folder / "sweep.json").read_bytes())
    (folder / "sweep.json").write_bytes(orjson.dumps(content | {"version": "0.0.1"}))
    with refused("folder", ours=content["version"]):
        Sweep.open(folder)


@pytest.mark.parametrize("name", [shards.part_name(2), "sweep.parquet"])
def test_a_file_whose_pages_are_damaged_is_named(folder, name):
    sweep = Sweep(folder, SPEC)
    if name == "sweep.parquet":
        sweep.compact()
    data = (folder / name).read_bytes()
    (folder / name).write_bytes(data[:4] + bytes(60) + data[64:])
    with refused("folder", file=str(folder / name)):
        sweep.table()


def test_a_spec_of_bodies_comes_back_from_its_folder(tmp_path):
    over = {"path.pitch": [0.5], "dragon.width": {"start": 0.2, "stop": 0.3, "count": 2}}
    spec = Spec.of({"question": "check", "over": over, "request": {"dragon": {"benches": 5}}})
    begin(tmp_path / "a", spec)
    assert Sweep.open(tmp_path / "a").spec.name == spec.name


def test_no_text_of_a_table_is_a_formula_for_a_spreadsheet():
    table = without_formulas(pa.table({"x": [-1.0, 2.0], "error.message": ["=1+1", "x must not be 13 m"]}))
    assert table.to_pydict() == {"x": [-1.0, 2.0], "error.message": ["'=1+1", "x must not be 13 m"]}

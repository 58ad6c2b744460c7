"""A trajectory as a file, read back by programs that we did not write."""

import csv
import io
from dataclasses import replace

import numpy as np
import openpyxl
import pyarrow
import pytest

from app.files import tables
from core import Dance, Dragon, Spiral, TooLarge, Trajectory, trajectory
from core.language import Language, speaking

pytestmark = pytest.mark.uncompiled

SIX_DECIMALS = 0.5e-6  # [m and m/s]: half of the last digit written
ROUNDING = 1e-15  # [m and m/s]: of the decimal text itself


@pytest.fixture(scope="module")
def dance():
    return trajectory(Dance(Dragon(benches=5), Spiral()), [0.0, 0.5, 10.0])


def columns_of(dance):
    """time, handle, x, y, speed, row by row."""
    instants, handles = dance.speed.shape
    x, y = dance.position.reshape(-1, 2).T
    return [np.repeat(dance.time, handles), np.tile(np.arange(handles), instants), x, y, dance.speed.ravel()]


def test_csv_holds_every_number_in_full_precision(dance):
    rows = list(csv.reader(io.StringIO(tables.trajectory_csv(dance).decode())))
    assert tuple(rows[0]) == ("time", "handle", "x", "y", "speed")
    read = np.array(rows[1:], dtype=np.float64).T
    assert np.array_equal(read, np.array(columns_of(dance)))


def test_rounding_never_writes_a_negative_zero(dance):
    position = dance.position.copy()
    position[0, 0, 1] = -1e-15  # as rounding may leave of 0
    assert b"-0.0," not in tables.trajectory_csv(replace(dance, position=position), decimals=6)


def test_arrow_reads_back_as_the_same_numbers(dance):
    table = pyarrow.ipc.open_file(tables.trajectory_arrow(dance)).read_all()
    assert tuple(table.column_names) == ("time", "handle", "x", "y", "speed")
    assert np.array_equal([column.to_numpy() for column in table.columns], columns_of(dance))


@pytest.mark.parametrize(
    ("language", "words"),
    [
        (Language.ENGLISH, ["positions", "speeds", "head x (m)", "tail (rear) (m/s)"]),
        (Language.CHINESE, ["位置", "速度", "龙头x (m)", "龙尾（后） (m/s)"]),
    ],
    ids=["english", "chinese"],
)
def test_workbook_has_the_layout_of_the_contest(dance, language, words):
    with speaking(language):
        book = openpyxl.load_workbook(io.BytesIO(tables.trajectory_xlsx(dance)))
    (heads, *positions), (same, *speeds) = (list(sheet.iter_rows(values_only=True)) for sheet in book.worksheets)
    assert heads == same == (None, "0 s", "0.5 s", "10 s")
    assert [*book.sheetnames, positions[0][0], speeds[-1][0]] == words
    assert book.worksheets[0]["B2"].number_format == "0.000000"
    numbers = np.array([row[1:] for row in positions + speeds])
    exact = np.concatenate([dance.position.transpose(1, 2, 0).reshape(12, 3), dance.speed.T])
    assert np.abs(numbers - exact).max() <= SIX_DECIMALS + ROUNDING


@pytest.mark.parametrize(
    ("benches", "names"),
    [(1, "龙头 龙尾（后）"), (2, "龙头 龙尾 龙尾（后）"), (4, "龙头 第1节龙身 第2节龙身 龙尾 龙尾（后）")],
)
def test_handles_are_named_after_the_bench_that_they_lead(benches, names):
    with speaking("zh"):
        assert tables.handle_names(benches) == names.split()


def test_workbook_refuses_more_instants_than_it_has_columns():
    still = Trajectory(np.arange(16_384.0), *(np.zeros((16_384, 2, 2)),) * 2, np.zeros((16_384, 2)))
    with pytest.raises(TooLarge, match="16383 instants"):
        tables.trajectory_xlsx(still)
    fitting = Trajectory(*(part[:-1] for part in (still.time, still.position, still.velocity, still.speed)))
    book = openpyxl.load_workbook(io.BytesIO(tables.trajectory_xlsx(fitting)), read_only=True)
    assert len(next(book.worksheets[0].iter_rows(max_row=1))) == 16_384

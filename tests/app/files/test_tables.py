"""A trajectory as a file, read back by programs that we did not write."""

import io
from dataclasses import replace

import numpy as np
import openpyxl
import pytest

from app.files import tables
from core import Dance, Dragon, Spiral, TooLarge, trajectory
from core.language import speaking

pytestmark = pytest.mark.uncompiled


@pytest.fixture(scope="module")
def dance():
    return trajectory(Dance(Dragon(benches=5), Spiral()), [0.0, 0.5, 10.0])


def test_rounding_never_writes_a_negative_zero(dance):
    position = dance.position.copy()
    position[0, 0, 1] = -1e-15  # as rounding may leave of 0
    assert b"-0.0," not in b"".join(tables.csv_blocks(replace(dance, position=position), decimals=6))


@pytest.mark.parametrize(
    "benches, names",
    [(1, "龙头 龙尾（后）"), (2, "龙头 龙尾 龙尾（后）"), (4, "龙头 第1节龙身 第2节龙身 龙尾 龙尾（后）")],
)
def test_handles_are_named_after_the_bench_that_they_lead(benches, names):
    with speaking("zh"):
        assert tables.handle_names(benches) == names.split()


def test_workbook_refuses_more_instants_than_it_has_columns():
    alone = Dance(Dragon(benches=1), Spiral())
    with pytest.raises(TooLarge, match="16383 instants"):
        tables.trajectory_xlsx(trajectory(alone, np.linspace(0.0, 9.0, 16_384)))
    fitting = tables.trajectory_xlsx(trajectory(alone, np.linspace(0.0, 9.0, 16_383)))
    book = openpyxl.load_workbook(io.BytesIO(fitting), read_only=True)
    assert len(next(book.worksheets[0].iter_rows(max_row=1))) == 16_384

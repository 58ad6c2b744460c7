"""Results as tables of pandas, Polars and xarray: the same numbers under their names, with their units."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, clearance_profile, pitch_scan, tolerance_curve, trajectory
from core.tables import Table

DANCE = Dance(Dragon(5), Spiral())
TIMES = [0.0, 60.0, 120.0]


def test_a_trajectory_has_one_row_for_each_time_and_handle() -> None:
    motion = trajectory(DANCE, TIMES)
    frame = motion.to_dataframe()
    assert list(frame) == ["time", "handle", "x", "y", "velocity_x", "velocity_y", "speed"]
    row = frame[(frame.time == 60.0) & (frame.handle == 4)].iloc[0]
    assert row.to_list() == [60.0, 4.0, *motion.position[1, 4], *motion.velocity[1, 4], motion.speed[1, 4]]
    assert len(frame) == len(TIMES) * 6


def test_a_frame_knows_its_units() -> None:
    units = trajectory(DANCE, TIMES).to_dataframe().attrs["units"]
    assert units == {
        "time": "s", "handle": "", "x": "m", "y": "m", "velocity_x": "m/s", "velocity_y": "m/s", "speed": "m/s",
    }  # fmt: skip


def test_one_instant_has_one_row_for_each_handle() -> None:
    frame = trajectory(DANCE, 60.0).to_dataframe()
    assert frame.handle.to_list() == [0, 1, 2, 3, 4, 5]
    assert set(frame.time) == {60.0}


def test_axes_of_a_trajectory_have_names() -> None:
    motion = trajectory(DANCE, TIMES)
    dataset = motion.to_xarray()
    assert dataset.position.dims == ("time", "handle", "axis")
    assert dataset.speed.sel(time=60.0, handle=4).item() == motion.speed[1, 4]
    assert dataset.velocity.sel(time=120.0, axis="y").values.tolist() == motion.velocity[2, :, 1].tolist()
    units = {name: dataset[name].attrs["units"] for name in ("time", "position", "velocity", "speed")}
    assert units == {"time": "s", "position": "m", "velocity": "m/s", "speed": "m/s"}


def test_one_instant_has_no_axis_of_time() -> None:
    dataset = trajectory(DANCE, 60.0).to_xarray()
    assert dict(dataset.sizes) == {"handle": 6, "axis": 2}
    assert dataset.time.item() == 60.0


@pytest.mark.parametrize("times", [TIMES, 60.0, []])
def test_a_clearance_profile_is_a_table(times: list[float] | float) -> None:
    result = clearance_profile(DANCE, times)
    frame, dataset = result.to_dataframe(), result.to_xarray()
    assert frame.time.to_list() == np.ravel(times).tolist()
    assert frame.clearance.to_list() == np.ravel(result.clearance).tolist()
    assert frame[["bench_a", "bench_b"]].to_numpy().tolist() == result.benches.reshape(-1, 2).tolist()
    assert np.array_equal(dataset.clearance, result.clearance)
    assert np.array_equal(dataset.benches.sel(pair="b"), result.benches[..., 1])
    assert dataset.clearance.attrs["units"] == frame.attrs["units"]["clearance"] == "m"


def test_a_scan_is_a_table_with_the_piece_of_each_pitch() -> None:
    result = pitch_scan(Dragon(30), np.linspace(0.4, 0.45, 3), start_turns=8.0)
    frame = result.to_dataframe()
    assert frame.pitch.to_list() == result.pitch.tolist()
    assert frame.radius.to_list() == result.radius.tolist()
    assert [(group.index[0], group.index[-1] + 1) for _, group in frame.groupby("piece")] == list(result.pieces)


@pytest.mark.parametrize(
    "result",
    [
        trajectory(DANCE, TIMES),
        trajectory(DANCE, 60.0),
        clearance_profile(DANCE, TIMES),
        pitch_scan(Dragon(30), np.linspace(0.4, 0.45, 3), start_turns=8.0),
        tolerance_curve(Dragon(5), [0.5, 0.6]),
    ],
    ids=lambda result: type(result).__name__,
)
def test_a_table_of_polars_has_the_numbers_of_that_of_pandas(result: Table) -> None:
    frame, other = result.to_polars(), result.to_dataframe()
    assert frame.columns == list(other)
    assert all(frame[name].to_list() == other[name].to_list() for name in other)

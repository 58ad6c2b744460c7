"""Results as tables of pandas, Polars and xarray: the same numbers under their names, with their units."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, clearance_profile, pitch_scan, tolerance_curve, trajectory

DANCE = Dance(Dragon(5), Spiral())
TIMES = [0.0, 60.0, 120.0]
MOTION = trajectory(DANCE, TIMES)
INSTANT = trajectory(DANCE, 60.0)
CURVE = tolerance_curve(Dragon(5), [0.5, 0.6])
SCAN = pitch_scan(Dragon(30), np.linspace(0.4, 0.45, 3), start_turns=8.0)


def test_a_trajectory_has_one_row_for_each_time_and_handle_and_knows_its_units():
    frame = MOTION.to_dataframe()
    units = {"time": "s", "handle": "", "x": "m", "y": "m"} | dict.fromkeys(
        ["velocity_x", "velocity_y", "speed"], "m/s"
    )
    assert (list(frame), frame.attrs["units"], len(frame)) == ([*units], units, len(TIMES) * 6)
    row = frame[(frame.time == 60.0) & (frame.handle == 4)].iloc[0].to_list()
    assert row == [60.0, 4.0, *MOTION.position[1, 4], *MOTION.velocity[1, 4], MOTION.speed[1, 4]]
    assert INSTANT.to_dataframe().handle.to_list() == [0, 1, 2, 3, 4, 5]


def test_axes_of_a_trajectory_have_names_and_one_instant_no_axis_of_time():
    dataset = MOTION.to_xarray()
    assert dataset.position.dims == ("time", "handle", "axis")
    assert dataset.velocity.sel(time=120.0, axis="y").values.tolist() == MOTION.velocity[2, :, 1].tolist()
    assert [dataset[name].attrs["units"] for name in ("time", "position", "speed")] == ["s", "m", "m/s"]
    assert dataset.attrs["dance"] == repr(DANCE)
    alone = INSTANT.to_xarray()
    assert dict(alone.sizes) == {"handle": 6, "axis": 2}
    assert alone.time.item() == 60.0


@pytest.mark.parametrize("times", [TIMES, 60.0, []])
def test_a_clearance_profile_is_a_table(times):
    result = clearance_profile(DANCE, times)
    frame = result.to_dataframe()
    dataset = result.to_xarray()
    columns = np.column_stack([np.ravel(times), np.ravel(result.clearance), result.benches.reshape(-1, 2)])
    assert frame[["time", "clearance", "bench_a", "bench_b"]].to_numpy().tolist() == columns.tolist()
    assert np.array_equal(dataset.benches.sel(pair="b"), result.benches[..., 1])
    assert dataset.clearance.attrs["units"] == frame.attrs["units"]["clearance"] == "m"


def test_a_scan_is_a_table_with_the_piece_of_each_pitch():
    frame = SCAN.to_dataframe()
    assert frame.pitch.to_list() == SCAN.pitch.tolist()
    assert frame.radius.to_list() == SCAN.radius.tolist()
    assert [(group.index[0], group.index[-1] + 1) for _, group in frame.groupby("piece")] == list(SCAN.pieces)
    for scan, name in ((SCAN, "radius"), (CURVE, "stray")):
        column = scan.to_xarray()[name]
        assert (column.dims, column.pitch.attrs["units"], column.attrs["units"]) == (("pitch",), "m", "m")
        assert column.sel(pitch=scan.pitch[1]) == getattr(scan, name)[1]


@pytest.mark.parametrize("result", [MOTION, clearance_profile(DANCE, TIMES), SCAN, CURVE])
def test_every_variable_and_axis_of_a_dataset_says_what_it_is_and_every_number_its_unit(result):
    dataset = result.to_xarray()
    assert {"title", "source"} <= {*dataset.attrs}
    for name, variable in dataset.variables.items():
        assert variable.attrs["long_name"], name
        assert variable.attrs.get("units") or variable.dtype.kind not in "fi", name


@pytest.mark.parametrize(
    "result",
    [MOTION, INSTANT, clearance_profile(DANCE, TIMES), SCAN, CURVE],
    ids=lambda result: type(result).__name__,
)
def test_a_table_of_polars_has_the_numbers_of_that_of_pandas(result):
    assert result.to_polars().to_dict(as_series=False) == result.to_dataframe().to_dict("list")

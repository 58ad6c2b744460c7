"""Maps: each value stands where its parameters are."""

import numpy as np
import pytest
from matplotlib.collections import PathCollection, QuadMesh

from app.sweeps import shards
from app.sweeps.maps import value_map
from app.sweeps.table import summary
from tests.support.odd_questions import LAND
from tests.support.refused import refused
from tests.support.sweeping import answered, spec_of


def swept(folder, over, **more):
    return answered(folder, spec_of(LAND, over, **({"shard_size": 50} | more)), LAND)


def drawn(axes, kind):
    """The one collection of this kind, with its values."""
    [result] = [each for each in axes.collections if isinstance(each, kind)]
    return result


def values(collection):
    return np.ma.filled(collection.get_array(), np.nan)


def test_a_map_of_two_lists_has_each_value_in_its_cell(tmp_path):
    over = {"x": [3.0, 1.0, 13.0, 2.0], "y": {"start": 1.0, "stop": 100.0, "count": 3, "scale": "log"}}
    axes = value_map(swept(tmp_path, over), "height").axes[0]
    x = np.array([1.0, 2.0, 3.0, np.nan])
    y = np.array([1.0, 10.0, 100.0])
    np.testing.assert_allclose(values(drawn(axes, QuadMesh)), y[:, None] * x, rtol=1e-12)
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_yscale()) == ("x", "y", "log")
    assert len(axes.collections) > 1  # contours


def test_a_map_of_part_of_a_sweep_leaves_the_rest_blank(tmp_path):
    sweep = swept(tmp_path, {"x": [1.0, 2.0, 3.0], "y": [1.0, 2.0]}, shard_size=2)
    (tmp_path / shards.part_name(1)).unlink()
    mesh = drawn(value_map(sweep, "height").axes[0], QuadMesh)
    np.testing.assert_array_equal(values(mesh), [[1.0, np.nan, 3.0], [2.0, np.nan, 6.0]])


def test_a_map_of_samples_has_a_dot_for_each(tmp_path):
    over = {"x": {"start": 0.0, "stop": 12.0}, "y": {"start": 0.0, "stop": 1.0}}
    dots = drawn(value_map(swept(tmp_path, over, samples={"count": 64}), "height").axes[0], PathCollection)
    places = np.asarray(dots.get_offsets())
    assert len(places) == 64
    np.testing.assert_allclose(values(dots), places.prod(axis=1), rtol=1e-12)


def test_a_map_of_one_parameter_is_a_line_in_its_order(tmp_path):
    line = value_map(swept(tmp_path, {"x": [3.0, 13.0, 1.0]}, request={"y": 2.0}), "height").axes[0].lines[0]
    np.testing.assert_array_equal(line.get_xydata(), [[1.0, 2.0], [3.0, 6.0], [13.0, np.nan]])


@pytest.mark.parametrize(
    "over, value, field",
    [
        ({"x": [1], "y": [1], "word": ["a"]}, "height", "output"),
        ({"x": [1.0]}, "side", "value"),
        ({"word": ["a", "b"]}, "height", "value"),
    ],
)
def test_what_cannot_be_drawn_is_refused(over, value, field, tmp_path):
    with refused(field):
        value_map(swept(tmp_path, over), value)


def test_a_summary_counts_errors_and_has_both_ends_where_there_are_any(tmp_path):
    sweep = swept(tmp_path / "a", {"x": [5.0, 13.0, 14.0, -2.0]}, request={"y": 3.0})
    assert summary(sweep, "height").lines() == [
        ("designs", "4 of 4"),
        ("error internal-error", "1"),
        ("error invalid-value", "1"),
        ("least height", "-6.0 at x = -2.0"),
        ("greatest height", "15.0 at x = 5.0"),
    ]
    assert summary(swept(tmp_path / "b", {"x": [13.0]}), "height").lines()[1:] == [("error invalid-value", "1")]

"""Scenes and intervals of head travel: bounds hold at every instant in between."""

import numpy as np
import pytest

from core import Dragon, Spiral
from core.kernels import Rings, Scene, spiral_curve
from core.kernels.constants import (
    ERROR,
    FRAME_COLUMNS,
    FRAME_X,
    FRAME_Y,
    RATE,
    SIZE_COLUMNS,
    SWAY,
)
from tests.support.searches import search_on


@pytest.mark.parametrize("benches, edges, room", [(223, 0, 40), (10, 0, 10), (30, 10, 30)])
def test_a_scene_has_room_for_as_many_benches_as_rows(benches, edges, room):
    sizes = np.zeros((41, SIZE_COLUMNS))
    assert Scene(spiral_curve(0.1), 9.0, Rings(), sizes, benches, edges).room == room


def test_an_interval_whose_chain_folds_has_no_bounds():
    assert not search_on(Dragon(5), Spiral()).interval.lay_out(0.1, 0.01, 5)


def test_copies_move_as_the_dragon_does_with_larger_errors():
    """Where they stand: tests/core/design/test_pitch_search.py."""
    search = search_on(Dragon(12), Spiral(), copies=3)
    assert search.interval.lay_out(search.place - 20.0, 0.05, 12)
    placed, motion = (rows.reshape(3, 13, -1) for rows in (np.asarray(search.placed), np.asarray(search.motion)))
    for error in (ERROR, SWAY):
        assert (placed[1:, :12, error] > placed[0, :12, error]).all()
    assert (placed[1:, :, RATE] == placed[0, :, RATE]).all()
    assert (motion[1:, :12] == motion[0, :12]).all()


def test_the_error_of_edges_at_rest_is_that_of_the_furthest():
    scene = Scene(spiral_curve(0.1), 9.0, Rings(), np.zeros((9, SIZE_COLUMNS)), 5, 3)
    walls = np.zeros((3, FRAME_COLUMNS))
    walls[:, FRAME_X], walls[:, FRAME_Y] = [1.0, -30.0, 2.0], [0.0, -40.0, 5.0]
    scene.lay_walls(walls)
    assert scene.wall_error == pytest.approx(6.0 * 70.0 * np.finfo(float).eps / 2.0, rel=1e-12, abs=0.0)

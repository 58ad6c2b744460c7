"""Scenes and intervals of head travel: bounds hold at every instant in between."""

import numpy as np
import pytest

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.kernels import Rings, Scene, spiral_curve
from core.kernels.constants import SIZE_COLUMNS


@pytest.mark.parametrize(("rows", "benches", "edges", "room"), [(41, 223, 0, 40), (41, 10, 0, 10), (41, 30, 10, 30)])
def test_a_scene_has_room_for_as_many_benches_as_rows(rows, benches, edges, room):
    sizes = np.zeros((rows, SIZE_COLUMNS))
    assert Scene(spiral_curve(0.1), 9.0, Rings(), sizes, benches, edges).room == room


def test_an_interval_whose_chain_folds_has_no_bounds():
    assert not ContactSearch(Dragon(5), Spiral(), 0.0).interval.lay_out(0.1, 0.01, 5)

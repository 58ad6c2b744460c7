"""Scenes and intervals of head travel: bounds hold at every instant in between."""

import numpy as np
import pytest

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.design.ways import SearchBetween
from core.kernels import Budget, Rings, Scene, spiral_curve
from core.kernels.constants import ERROR, MX, MY, SIZE_COLUMNS, TX, TY, UX, UY


@pytest.mark.parametrize(("rows", "benches", "edges", "room"), [(41, 223, 0, 40), (41, 10, 0, 10), (41, 30, 10, 30)])
def test_a_scene_has_room_for_as_many_benches_as_rows(rows, benches, edges, room):
    sizes = np.zeros((rows, SIZE_COLUMNS))
    assert Scene(spiral_curve(0.1), 9.0, Rings(), sizes, benches, edges).room == room


def test_an_interval_whose_chain_folds_has_no_bounds():
    assert not ContactSearch(Dragon(5), Spiral(), 0.0).interval.lay_out(0.1, 0.01, 5)


@pytest.mark.parametrize("count", [2, 3])
def test_copies_stand_where_turned_dragons_stand_with_larger_errors(count):
    search = SearchBetween(Dragon(12), Spiral(), count, 0.0, work=1e7, budget=Budget(), stray=0.0)
    assert search.interval.lay_out(search.place - 20.0, 0.05, 12)
    for k in range(1, count):
        rows = slice(13 * k, 13 * k + 12)
        for x, y in ((MX, MY), (UX, UY), (TX, TY)):
            turned = search.placed[:12, [x, y]] @ [1.0, 1.0j] * np.exp(2j * np.pi * k / count)
            assert search.placed[rows, [x, y]] @ [1.0, 1.0j] == pytest.approx(turned, rel=0, abs=1e-14)
        assert (search.placed[rows, ERROR] > search.placed[:12, ERROR]).all()
        assert (search.motion[rows] == search.motion[:12]).all()

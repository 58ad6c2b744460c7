"""Scenes and intervals of head travel: bounds hold at every instant in between."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Route, Spiral, Turn, kernels
from core.contact.search import ContactSearch
from core.design.ways import SearchBetween

ROUNDING = 1e-10  # of rates [1]


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
@pytest.mark.parametrize("travel", [-30.0, 5.0, 80.0])
def test_no_handle_within_an_interval_is_faster_than_its_bound(path: Spiral | Route, travel: float) -> None:
    search = ContactSearch(Dragon(30), path, 0.0)
    h, place = 0.05, search.place - travel
    assert search.interval.lay_out(place, h, 30)
    most = search.motion[1:31, kernels.RATE_HIGH]
    for part in np.linspace(0.0, 1.0, 11):
        kernels.place_chain(search.curve, place - part * h, 30, search.sizes, chain := np.zeros_like(search.placed))
        assert (np.abs(chain[1:31, kernels.RATE]) <= most + ROUNDING).all()


def test_a_scene_has_room_for_as_many_benches_as_rows() -> None:
    rings, curve = kernels.Rings(), kernels.spiral_curve(0.1)
    for rows, benches, edges, room in ((41, 223, 0, 40), (41, 10, 0, 10), (41, 30, 10, 30)):
        scene = kernels.Scene(curve, 9.0, rings, np.zeros((rows, kernels.SIZE_COLUMNS)), benches, edges)
        assert scene.room == room


def test_an_interval_whose_chain_folds_has_no_bounds() -> None:
    search = ContactSearch(Dragon(5), Spiral(), 0.0)
    assert not search.interval.lay_out(0.1, 0.01, 5)


@pytest.mark.parametrize("count", [2, 3, 7])
def test_copies_stand_where_turned_dragons_stand(count: int) -> None:
    search = SearchBetween(Dragon(12), Spiral(), count, 0.0, work=1e7, budget=kernels.Budget(), stray=0.0)
    assert search.interval.lay_out(search.place - 20.0, 0.05, 12)
    assert search.scene.stride == 13
    for k in range(1, count):
        own, copy = search.placed[:12], search.placed[13 * k : 13 * k + 12]
        for x, y in ((kernels.MX, kernels.MY), (kernels.UX, kernels.UY), (kernels.TX, kernels.TY)):
            turned = (own[:, x] + 1j * own[:, y]) * np.exp(2j * np.pi * k / count)
            np.testing.assert_allclose(copy[:, x] + 1j * copy[:, y], turned, rtol=0, atol=1e-14)
        assert (copy[:, kernels.ERROR] > own[:, kernels.ERROR]).all()
        assert (search.motion[13 * k : 13 * k + 13] == search.motion[:13]).all()

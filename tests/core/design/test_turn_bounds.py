"""Boxes of turns in a branch and bound: their lower bounds and their division."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core.design.turn_bounds import Boxes, divided, joined, multipliers_at
from core.design.turn_boxes import sizes_of, turns_in
from tests.core.design.test_turn_boxes import boxes
from tests.support.boxes_of_turns import GROWTH, LEAST


@pytest.mark.uncompiled
def test_multipliers_make_the_bound_good_to_the_second_order() -> None:
    """At the shortest turn of ratio 2 both the bend and the circle hold it, and a ten times smaller box is 100 times
    nearer."""
    from scipy.optimize import brentq

    def room(entry: float) -> float:
        return float(sizes_of(GROWTH, *np.array([[entry], [(4.5 - entry) / GROWTH], [math.log(2.0)]]))[1, 0] - LEAST)

    entry = brentq(room, 4.2, 4.4, xtol=1e-14)
    point = np.array([entry, (4.5 - entry) / GROWTH, math.log(2.0)])
    known = multipliers_at(GROWTH, point, LEAST, 4.5, free=False)
    length, missing = sizes_of(GROWTH, *point[:, None])[4, 0], []
    for half in (1e-2, 1e-3, 1e-4):
        halves = np.array([[half], [half], [0.0]])
        missing.append(length - float(known.lower(turns_in(GROWTH, point[:, None], halves), point[:, None], halves)[0]))
    assert missing[0] > 50.0 * missing[1] > 2_500.0 * missing[2] > 0.0


@pytest.mark.uncompiled
def test_divided_boxes_cover_the_same_turns() -> None:
    rng = np.random.default_rng(4)
    centres, halves = boxes(rng, 0.1)
    count = centres.shape[1]
    whole = Boxes(centres, halves, np.zeros(count, dtype=np.int64), np.zeros(count))
    slope = rng.uniform(0.0, 9.0, (3, count))
    slope[0, 0] = np.nan
    parts = divided(whole, slope)
    assert parts.halves.prod(axis=0).sum() == pytest.approx(halves.prod(axis=0).sum())
    for k in range(count):
        lows = [parts.centres[:, n] - parts.halves[:, n] for n in (k, k + count)]
        highs = [parts.centres[:, n] + parts.halves[:, n] for n in (k, k + count)]
        assert np.minimum(*lows) == pytest.approx(centres[:, k] - halves[:, k], abs=1e-15)
        assert np.maximum(*highs) == pytest.approx(centres[:, k] + halves[:, k], abs=1e-15)


@pytest.mark.uncompiled
def test_joined_boxes_keep_their_order() -> None:
    rng = np.random.default_rng(9)
    centres, halves = boxes(rng, 0.1)
    count = centres.shape[1]
    whole = Boxes(centres, halves, np.arange(count), rng.uniform(0.0, 9.0, count))
    again = joined([whole.taken(slice(0, 7)), whole.taken(slice(7, None))])
    for before, after in zip(whole, again, strict=True):
        assert (before == after).all()

"""Folds of a chain, and the earlier places of handles."""

from __future__ import annotations

import numpy as np
import pytest

from core import kernels

# A fold is good to this part of its angle [1].
PART = 1e-9


@pytest.mark.parametrize("chord2", [33.46, 40.0, 100.0, 1e4])
def test_just_outside_a_fold_a_chord_fits_and_just_inside_it_jumps_or_is_gone(chord2: float) -> None:
    fold = kernels.fold_theta(chord2)
    outside = kernels.first_root(fold * (1.0 + PART), chord2)
    inside = kernels.first_root(fold * (1.0 - 1e3 * PART), chord2)
    assert np.pi < outside < 2.0 * np.pi
    assert inside < 0.0 or inside > outside + 1e3 * PART


def test_short_chords_never_fold() -> None:
    assert [kernels.fold_theta(chord2) for chord2 in (0.1, 9.0, 33.4)] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("leader", [3.0, 12.0, 90.0])
def test_the_leader_of_a_follower_stood_where_that_was_found(leader: float) -> None:
    delta = kernels.first_root(leader, 20.0)
    assert kernels.previous_theta(leader + delta, 20.0) == pytest.approx(leader, rel=PART)

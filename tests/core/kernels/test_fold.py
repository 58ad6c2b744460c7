"""First roots and crests of a chord, folds of a chain, and the earlier places of handles."""

import numpy as np
import pytest

from core.kernels import first_crest, first_root, fold_theta, previous_theta
from tests.support.slow_search import chord_squared

# A fold is good to this part of its angle, and a root to this part of itself [1].
PART = 1e-9
ROOT_PART = 1e-13


@pytest.mark.parametrize("theta", [0.3, 2.0, 20.0])
def test_the_first_root_is_a_root_and_none_lies_before_it(theta):
    for chord in np.linspace(0.1, 1.9 * theta, 20):
        delta = first_root(theta, chord**2)
        assert (chord_squared(theta, np.linspace(0.0, delta, 2_000)[1:-1]) < chord**2).all()
        assert chord_squared(theta, delta) == pytest.approx(chord**2, rel=ROOT_PART)


@pytest.mark.parametrize("theta", [0.1, 0.5, 2.0, 20.0])
def test_a_chord_grows_up_to_the_first_crest_and_not_just_beyond_it(theta):
    crest = first_crest(theta)
    rise = np.diff(chord_squared(theta, np.append(np.linspace(0.0, crest, 2_000), crest + 1e-6)))
    assert (rise[:-1] > 0.0).all()
    assert crest == 2.0 * np.pi or rise[-1] < 0.0
    assert (crest < 2.0 * np.pi) == (theta > 1.0)


@pytest.mark.parametrize("chord2", [33.46, 40.0, 100.0, 1e4])
def test_just_outside_a_fold_a_chord_fits_and_just_inside_it_jumps_or_is_gone(chord2):
    fold = fold_theta(chord2)
    outside = first_root(fold * (1.0 + PART), chord2)
    inside = first_root(fold * (1.0 - 1e3 * PART), chord2)
    assert np.pi < outside < 2.0 * np.pi
    assert inside < 0.0 or inside > outside + 1e3 * PART


def test_short_chords_never_fold():
    assert [fold_theta(chord2) for chord2 in (0.1, 9.0, 33.4)] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("leader", [3.0, 12.0, 90.0])
def test_the_leader_of_a_follower_stood_where_that_was_found(leader):
    delta = first_root(leader, 20.0)
    assert previous_theta(leader + delta, 20.0) == pytest.approx(leader, rel=PART)

"""The places of front handles against sampled ones, also where handles turn back."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, trajectory
from core.ground.tracks import REVERSAL, tracks
from tests.support.slow_search import arc_length


def places(dance, times):
    """Place s (T, n) of every front handle on a spiral about the origin, from its radius [m]."""
    path = dance.path
    theta = np.linalg.norm(trajectory(dance, times).position[:, :-1], axis=-1) / path.growth
    return path.length - path.growth * arc_length(theta)


@pytest.mark.parametrize(
    "dragon",
    [Dragon(12), Dragon(6, head_length=5.0), Dragon.of([3.4, 1.0, 4.0, 2.0], [0.3] * 4, [0.2] * 4)],
    ids=["default", "long head", "one by one"],
)
def test_the_places_of_handles_that_turn_back_are_all_in_their_stretch(dragon):
    dance = Dance(dragon, Spiral())
    until = dance.end.time
    seen = places(dance, np.minimum(until - 8.0 * np.linspace(1.0, 0.0, 4001) ** 3, until))
    assert (np.diff(seen[:, 1:], axis=0) < -1e-6).any()  # some handle turns back
    for track in tracks(dance, until - 8.0, until):
        low = track.stretches[0][0]
        high = track.stretches[-1][1]
        spare = track.stretches[0][2]
        alike = seen[:, dragon.lengths == dragon.lengths[track.bench]]
        least = alike.min()
        most = alike.max()
        assert least - 1e-5 <= low <= least + 1e-9
        assert most - 1e-9 <= high <= most + 1e-5
        assert spare < 3.0 * REVERSAL

"""The places of front handles against sampled ones, also where handles turn back."""

import numpy as np
import pytest

from core import Coil, Dance, Dragon, Route, Spiral, trajectory
from core.ground.tracks import REVERSAL, tracks
from tests.support.shared_dances import lane

DANCE = Dance(Dragon(40), Spiral())


def places(dance, times):
    """Place s (T, n) of every front handle on a spiral about the origin, from its radius [m]."""
    path = dance.path
    theta = np.linalg.norm(trajectory(dance, times).position[:, :-1], axis=-1) / path.growth
    return path.length - 0.5 * path.growth * (theta * np.hypot(1.0, theta) + np.arcsinh(theta))


def stretches(dance, start, stop):
    """Beginning and end of all stretches of each track, in order of the benches."""
    every = sorted(tracks(dance, start, stop), key=lambda track: track.bench)
    assert [track.bench for track in every] == [0, 1]
    return [np.array(track.stretches)[:, :2] for track in every]


def test_equal_benches_have_one_track_as_long_as_the_dragon_and_its_way():
    head, body = stretches(DANCE, 0.0, 100.0)
    first, last = places(DANCE, [0.0, 100.0])
    assert head == pytest.approx(np.array([[0.0, 100.0]]), abs=1e-8)
    assert body == pytest.approx(np.array([[first[-1], last[1]]]), abs=1e-8)


def test_on_a_short_way_every_bench_has_a_stretch_of_its_own():
    _, body = stretches(DANCE, 50.0, 50.5)
    assert body == pytest.approx(places(DANCE, [50.0, 50.5])[:, :0:-1].T, abs=1e-8)


@pytest.mark.parametrize(("way", "count", "length"), [(5.0, 1, 13.2), (2.0, 3, 6.0)])
def test_benches_given_one_by_one_share_tracks_by_their_sizes(way, count, length):
    dragon = Dragon.of([2.2, 3.0] * 3, [0.3] * 6, [0.275] * 6)  # benches of a size are 4.1 m apart
    result = tracks(Dance(dragon, lane((0.0, 0.0), (90.0, 0.0), start=40.0)), 0.0, way)
    assert sorted((track.bench, len(track.stretches)) for track in result) == [(0, count), (1, count)]
    assert [track.length for track in result] == pytest.approx([length] * 2, abs=1e-7)


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
        low, high, spare = track.stretches[0][0], track.stretches[-1][1], track.stretches[0][2]
        alike = seen[:, dragon.lengths == dragon.lengths[track.bench]]
        least, most = alike.min(), alike.max()
        assert least - 1e-5 <= low <= least + 1e-9
        assert most - 1e-9 <= high <= most + 1e-5
        assert spare < 3.0 * REVERSAL


def test_a_coil_has_the_stretches_of_the_same_spiral():
    coil = Dance(DANCE.dragon, Route([Coil(0.55, 16.0, 4.0)]))
    for own, other in zip(stretches(DANCE, 20.0, 90.0), stretches(coil, 20.0, 90.0), strict=True):
        assert own == pytest.approx(other, abs=1e-8)

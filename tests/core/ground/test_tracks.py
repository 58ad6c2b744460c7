"""The places of front handles against sampled ones, also where handles turn back."""

from __future__ import annotations

import numpy as np
import pytest

from core import Coil, Dance, Dragon, Line, Route, Spiral, trajectory
from core.ground.tracks import REVERSAL, tracks

DANCE = Dance(Dragon(40), Spiral())


def places(dance: Dance, times: np.ndarray) -> np.ndarray:
    """Place s (T, n) of every front handle on a spiral about the origin, from its radius [m]."""
    path = dance.path
    assert isinstance(path, Spiral)
    theta = np.linalg.norm(trajectory(dance, times).position[:, :-1], axis=-1) / path.growth
    return path.length - 0.5 * path.growth * (theta * np.hypot(1.0, theta) + np.arcsinh(theta))


def test_equal_benches_have_one_track_as_long_as_the_dragon_and_its_way() -> None:
    head, body = sorted(tracks(DANCE, 0.0, 100.0), key=lambda track: track.bench)
    assert (head.bench, body.bench) == (0, 1)
    first, last = places(DANCE, np.array([0.0, 100.0]))
    assert np.array(head.stretches)[:, :2] == pytest.approx(np.array([[0.0, 100.0]]), abs=1e-8)
    assert np.array(body.stretches)[:, :2] == pytest.approx(np.array([[first[-1], last[1]]]), abs=1e-8)
    assert body.length == pytest.approx(last[1] - first[-1], abs=1e-8)


def test_on_a_short_way_every_bench_has_a_stretch_of_its_own() -> None:
    _, body = sorted(tracks(DANCE, 50.0, 50.5), key=lambda track: track.bench)
    ends = places(DANCE, np.array([50.0, 50.5]))[:, :0:-1].T
    assert np.array(body.stretches)[:, :2] == pytest.approx(ends, abs=1e-8)


@pytest.mark.parametrize(("way", "stretches", "length"), [(5.0, 1, 13.2), (2.0, 3, 6.0)])
def test_benches_given_one_by_one_share_tracks_by_their_sizes(way: float, stretches: int, length: float) -> None:
    dragon = Dragon.of([2.2, 3.0] * 3, [0.3] * 6, [0.275] * 6)  # benches of a size are 4.1 m apart
    result = tracks(Dance(dragon, Route([Line((0.0, 0.0), (90.0, 0.0))], start=40.0)), 0.0, way)
    assert sorted(track.bench for track in result) == [0, 1]
    assert [len(track.stretches) for track in result] == [stretches] * 2
    assert [track.length for track in result] == pytest.approx([length] * 2, abs=1e-7)


@pytest.mark.parametrize(
    "dragon",
    [Dragon(12), Dragon(6, head_length=5.0), Dragon.of([3.4, 1.0, 4.0, 2.0], [0.3] * 4, [0.2] * 4)],
    ids=["default", "long head", "one by one"],
)
def test_the_places_of_handles_that_turn_back_are_all_in_their_stretch(dragon: Dragon) -> None:
    dance = Dance(dragon, Spiral())
    begin, until = dance.end.time - 8.0, dance.end.time
    ends = (until - 8.0 * np.linspace(1.0, 0.0, 4001) ** 3).clip(begin, until)
    seen = places(dance, ends)
    assert (np.diff(seen[:, 1:], axis=0) < -1e-6).any()  # some handle turns back
    for track in tracks(dance, begin, until):
        low, high, spare = track.stretches[0][0], track.stretches[-1][1], track.stretches[0][2]
        alike = dragon.lengths == dragon.lengths[track.bench]
        least, most = seen[:, alike].min(), seen[:, alike].max()
        assert low <= least + 1e-9
        assert most - 1e-9 <= high
        assert spare < 3.0 * REVERSAL
        assert low == pytest.approx(least, abs=1e-5)
        assert high == pytest.approx(most, abs=1e-5)


def test_a_coil_has_the_stretches_of_the_same_spiral() -> None:
    coil = Dance(DANCE.dragon, Route([Coil(0.55, 16.0, 4.0)]))
    for own, other in zip(tracks(DANCE, 20.0, 90.0), tracks(coil, 20.0, 90.0), strict=True):
        assert np.array(own.stretches)[:, :2] == pytest.approx(np.array(other.stretches)[:, :2], abs=1e-8)

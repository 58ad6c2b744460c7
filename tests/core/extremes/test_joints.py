"""The sharpest bend between two consecutive benches."""

import numpy as np
import pytest

from core import Dance, Dragon, Passage, Spiral, Turn, sharpest_bend, trajectory
from tests.support.near import assert_near
from tests.support.shared_dances import UNLIKE

ANGLE_ERROR = 1e-12  # [rad]
ROUNDING = 1e-12  # [s]
TURN = Turn(1.7)


def dense_bends(dance, times):
    along = np.diff(trajectory(dance, times).position, axis=1)
    heading = np.unwrap(np.arctan2(along[..., 1], along[..., 0]), axis=1)
    return np.abs(np.diff(heading, axis=1))


@pytest.mark.parametrize(
    "dance, start, stop",
    [
        (Dance(Dragon(), TURN), -100.0, 100.0),
        (Dance(Dragon(50), TURN), 30.0, 34.0),
        (Dance(Dragon(12, head_length=1.6), TURN), 0.0, 30.0),
        (Dance(UNLIKE, TURN), 0.0, 40.0),
        (Dance(Dragon(40), Spiral()), 0.0, 400.0),
    ],
    ids=["turn", "turn behind the head", "a short head", "benches of many sizes", "spiral"],
)
def test_no_dense_sample_bends_more_sharply(dance, start, stop):
    result = sharpest_bend(dance, start=start, stop=stop)
    assert result.angle >= dense_bends(dance, np.linspace(start, stop, 2_500)).max() - ANGLE_ERROR
    [there] = dense_bends(dance, np.array([result.time]))
    assert_near(there[result.benches[0]], result.angle, ANGLE_ERROR)


def test_in_a_dance_with_passages_the_same_bend_comes_at_its_own_time():
    steady = Dance(Dragon(12), TURN)
    with_passages = Dance(Dragon(12), TURN, passages=[Passage(2.0, until_s=8.0), Passage(0.0, until_time=10.0)])
    result = sharpest_bend(with_passages, start=0.0, stop=26.0)
    expected = sharpest_bend(steady, start=0.0, stop=24.0)
    assert result.angle == expected.angle
    assert result.benches == expected.benches
    assert expected.time > 8.0
    # The first 8 m take 10 s, 4 s at 2 m/s and then the pause, instead of 8 s.
    assert_near(result.time, expected.time + 2.0, ROUNDING)

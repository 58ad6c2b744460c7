"""The fastest moment of each bench, held against the trajectory."""

import numpy as np
import pytest

from core import bench_cues, trajectory
from core.people.fastest import FASTEST_WIDTH
from tests.core.people.test_cues import DONE, PAUSED, ROUNDING, STEP
from tests.support.near import assert_near

pytestmark = pytest.mark.uncompiled


def test_the_fastest_moment_is_the_fastest_of_small_steps():
    speed = trajectory(PAUSED, np.arange(2.0, DONE, STEP)).speed
    for one in bench_cues(PAUSED, start=2.0, stop=50.0):
        fastest = one.fastest
        most = speed[:, one.bench : one.bench + 2].max()
        assert most - ROUNDING <= fastest.speed <= most + STEP
        assert fastest.handle in (one.bench, one.bench + 1)
        assert fastest.head_speed == 1.5
        before = trajectory(PAUSED, [fastest.time - FASTEST_WIDTH, fastest.time])
        assert_near(before.speed[:, fastest.handle].max(), fastest.speed, 1e-5)
        assert_near(before.position[1, fastest.handle], (fastest.x, fastest.y), ROUNDING)

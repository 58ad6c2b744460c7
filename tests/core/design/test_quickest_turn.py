"""The quickest turn: the time of a turn by plain samples, and no turn beside the quickest is quicker."""

import numpy as np
import pytest

from core import (
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Outcome,
    TooMuchWork,
    Turn,
    first_contact,
    quickest_turn,
    trajectory,
    turn_time,
)
from tests.support.depth import thorough
from tests.support.near import assert_near

LIMIT = 2.0  # [m/s]
SAMPLED = 2e-3  # [1], part of a rate that samples miss
BESIDE = 0.02  # [m]


def slow_time(turn):
    """Time of a turn from samples of all speeds."""
    motion = trajectory(Dance(Dragon(40), turn), np.arange(-5.0, 80.0, 0.01))
    return turn.length * float(motion.speed.max()) / LIMIT


# docs/contest.md
@pytest.mark.parametrize(
    "turn, length, speed, time",
    [
        (Turn(1.7), 13.6212, 1.2463, 10.93),
        (Turn(1.7, entry_radius=4.29039529, exit_radius=4.5), 11.7992, 0.9754, 12.10),
        *thorough((None, 9.7442, 1.3892, 7.01)),
    ],
    ids=["contest", "shortest", "quickest of ratio 1.2"],
)
def test_the_time_of_a_turn_is_its_length_over_the_highest_speed_of_the_head(turn, length, speed, time):
    result = turn_time(Dragon(), turn, LIMIT) if turn else quickest_turn(Dragon(), 1.7, ratio=1.2)
    assert_near((result.length, result.head_speed), (length, speed), 5e-5)
    assert_near(result.time, time, 5e-3)
    assert result.time * (1.0 - SAMPLED) <= slow_time(result.turn) <= result.time * (1.0 + 1e-9)


def test_the_quickest_turn_is_quicker_than_its_neighbours_the_shortest_and_the_contests():
    result = quickest_turn(Dragon(), 1.7)
    tried = 0
    assert result.time < 10.79
    at = np.array([result.turn.entry_radius, result.turn.exit_radius])
    for angle in np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False):
        entry, leaving = (at + BESIDE * np.array([np.cos(angle), np.sin(angle)])).tolist()
        try:
            time = slow_time(Turn(1.7, entry_radius=entry, exit_radius=leaving))
        except InvalidValue:
            continue
        tried += 1
        assert time >= result.time * (1.0 - SAMPLED)
    assert tried
    assert first_contact(Dance(Dragon(), result.turn), start=-100.0, stop=500.0).outcome is Outcome.CLEAR


@pytest.mark.parametrize("share", [0.3, 0.9, 0.99])
def test_work_that_ends_before_a_dance_is_proven_refuses_no_circle(share):
    whole = Budget(1e9)
    quickest_turn(Dragon(5), 1.7, budget=whole)
    with pytest.raises(TooMuchWork):
        quickest_turn(Dragon(5), 1.7, budget=Budget(share * (1e9 - whole.left)))

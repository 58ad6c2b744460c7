"""The quickest turn: the time of a turn by plain samples, and no turn beside the quickest is quicker."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, InvalidValue, Outcome, Turn, first_contact, quickest_turn, trajectory, turn_time

LIMIT = 2.0  # [m/s]
SAMPLED = 2e-3  # [1], part of a rate that samples miss
BESIDE = 0.02  # [m]


def slow_time(entry: float, leaving: float) -> float | None:
    """Time of a turn of ratio 2 from samples of all speeds; None if it cannot be danced."""
    try:
        turn = Turn(1.7, entry_radius=entry, exit_radius=leaving)
        motion = trajectory(Dance(Dragon(40), turn), np.arange(-5.0, 80.0, 0.01))
    except InvalidValue:
        return None
    return turn.length * float(motion.speed.max()) / LIMIT


@pytest.mark.parametrize(
    ("entry", "leaving", "length", "speed", "time"),
    [(4.5, 4.5, 13.6212, 1.2463, 10.93), (4.29039529, 4.5, 11.7992, 0.9754, 12.10)],
    ids=["contest", "shortest"],
)
def test_the_time_of_a_turn_is_its_length_over_the_highest_speed_of_the_head(
    entry: float, leaving: float, length: float, speed: float, time: float
) -> None:
    result = turn_time(Dragon(), Turn(1.7, entry_radius=entry, exit_radius=leaving), LIMIT)
    assert (result.length, result.head_speed) == (pytest.approx(length, abs=5e-5), pytest.approx(speed, abs=5e-5))
    assert result.time == pytest.approx(time, abs=5e-3)
    assert result.time == result.length / result.head_speed
    slow = slow_time(entry, leaving)
    assert slow is not None
    assert result.time * (1.0 - SAMPLED) <= slow <= result.time * (1.0 + 1e-9)


def test_the_quickest_turn_is_quicker_than_its_neighbours_the_shortest_and_the_contests() -> None:
    result = quickest_turn(Dragon(), 1.7)
    assert result.time < 10.79
    entry, leaving = result.turn.entry_radius, result.turn.exit_radius
    tried = 0
    for angle in np.linspace(0.0, 2.0 * np.pi, 16, endpoint=False):
        beside = (entry + BESIDE * float(np.cos(angle)), leaving + BESIDE * float(np.sin(angle)))
        time = None if max(beside) > 4.5 else slow_time(*beside)
        if time is not None:
            tried += 1
            assert time >= result.time * (1.0 - SAMPLED)
    assert tried
    assert first_contact(Dance(Dragon(), result.turn), start=-100.0, stop=500.0).outcome is Outcome.CLEAR


def test_a_lower_limit_takes_as_much_longer() -> None:
    one, two = (quickest_turn(Dragon(12), 1.7, ratio=1.6, speed_limit=limit) for limit in (1.0, 2.0))
    assert one.turn == two.turn
    assert one.time == pytest.approx(2.0 * two.time, rel=1e-12)


def test_a_circle_in_which_nothing_can_be_danced_is_refused() -> None:
    with pytest.raises(InvalidValue, match=r"^turning_radius must be larger"):
        quickest_turn(Dragon(), 1.7, 3.0)


@pytest.mark.parametrize(
    ("ratio", "turn", "known"),
    [
        (1.0, Turn(1.7, ratio=1.0), (13.6212, 1.6595, 8.21)),
        (1.0, Turn(1.7, ratio=1.0, entry_radius=4.5, exit_radius=3.9337884833950665), (8.2240, 0.7159, 11.49)),
        (1.2, None, (9.7442, 1.3892, 7.01)),
    ],
    ids=["equal arcs", "shortest", "quickest"],
)
def test_the_table_of_the_contest_has_these_times(
    ratio: float, turn: Turn | None, known: tuple[float, float, float]
) -> None:
    """docs/contest.md."""
    result = quickest_turn(Dragon(), 1.7, ratio=ratio) if turn is None else turn_time(Dragon(), turn)
    length, speed, time = known
    assert (result.length, result.head_speed) == (pytest.approx(length, abs=5e-5), pytest.approx(speed, abs=5e-5))
    assert result.time == pytest.approx(time, abs=5e-3)

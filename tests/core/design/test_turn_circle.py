"""What questions about turns share: its numbers are checked by their names, and its turns are those of the circle."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from core import Dragon, Turn, deepest_turn, dubins_turn, quickest_turn, shortest_turn, turn_length_bounds
from core.design.turn_circle import checked_circle
from tests.support.refused import refused

QUESTIONS = [deepest_turn, dubins_turn, quickest_turn, shortest_turn, turn_length_bounds]


def test_a_turn_of_the_circle_is_the_turn() -> None:
    circle = checked_circle(1.7, 4.5, 2.0, 12.0)
    assert circle.turn() == Turn(1.7, start_turns=12.0)
    assert circle.turn(4.3, 4.45) == Turn(1.7, start_turns=12.0, entry_radius=4.3, exit_radius=4.45)
    assert circle.turn(4.3, 4.45, 1.5) == Turn(1.7, 4.5, 1.5, start_turns=12.0, entry_radius=4.3, exit_radius=4.45)
    assert circle.growth == 1.7 / (2.0 * math.pi)
    assert checked_circle(1.7, 4.5, None, 16.0, any_ratio=True).turn() == Turn(1.7, ratio=1.0)


WRONG = [
    ("pitch", 0.0),
    ("turning_radius", -1.0),
    ("ratio", 0.001),
    ("ratio", 101.0),
    ("start_turns", 2.0),
    ("margin", -1.0),
]


@pytest.mark.parametrize("ask", QUESTIONS, ids=lambda ask: ask.__name__)
def test_every_question_refuses_the_same_numbers_by_their_names(ask: Callable) -> None:
    for field, value in WRONG[:-1] if ask is turn_length_bounds else WRONG:  # which has no margin
        with refused(field):
            ask(Dragon(4), **{"pitch": 1.7, field: value})

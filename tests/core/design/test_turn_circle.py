"""What questions about turns share: its numbers are checked by their names."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from core import Dragon, deepest_turn, dubins_turn, quickest_turn, shortest_turn, turn_length_bounds
from tests.support.refused import refused

QUESTIONS = [deepest_turn, dubins_turn, quickest_turn, shortest_turn, turn_length_bounds]


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

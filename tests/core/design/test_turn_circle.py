"""What questions about turns share: a circle in which nothing can be danced is refused by its name."""

import pytest

from core import Dragon, deepest_turn, dubins_turn, quickest_turn, shortest_turn, turn_length_bounds
from tests.support.refused import refused


@pytest.mark.parametrize("ask", [deepest_turn, dubins_turn, quickest_turn, shortest_turn])
def test_every_question_refuses_a_circle_that_no_bench_can_follow(ask):
    with refused("turning_radius"):
        ask(Dragon(), 1.7, 1.4)


def test_no_arc_is_so_short_that_it_cannot_be_drawn():
    with refused("turning_radius"):
        turn_length_bounds(Dragon(), 1e-3, 1e-3)

"""The shortest turn of all that benches can follow, of one ratio: its bracket, and that the turn can be danced."""

import pytest

from core import Budget, Dance, Dragon, TurnLimit, first_contact, followed_turn, shortest_turn
from core.paths.following import follows
from tests.support.near import assert_near
from tests.support.refused import refused

SHORTEST = 11.799152352899  # of ratio 2, with bends of half a chord over 0.999 [m]


def test_a_little_work_gives_a_turn_that_can_be_danced_and_a_bracket_that_holds_the_shortest():
    brief = followed_turn(Dragon(), 1.7, budget=Budget(3e7))
    assert brief.limited_by == TurnLimit.FOLLOWING
    assert 0.0 <= brief.length_bracket[0] < SHORTEST - 1e-3
    assert_near(brief.length_bracket[1], SHORTEST, 1e-9)
    with refused("ratio"):
        followed_turn(Dragon(), 1.7, ratio=0.0)


@pytest.mark.thorough
def test_no_turn_of_ratio_2_that_benches_can_follow_is_a_millimetre_shorter():
    whole = followed_turn(Dragon(), 1.7)
    assert_near(whole.length_bracket, (SHORTEST - 1e-3, SHORTEST), 1e-9)
    assert whole.boxes > 50_000


@pytest.mark.thorough
def test_with_tighter_arcs_a_turn_is_shorter_than_any_of_half_a_chord():
    wide = shortest_turn(Dragon(), 1.7, ratio=1.25)
    tight = followed_turn(Dragon(), 1.7, ratio=1.25, budget=Budget(1e8))
    assert tight.length_bracket[0] <= tight.turn.length < 7.8905 < wide.length_bracket[0]
    assert follows(Dragon(), tight.turn)
    assert first_contact(Dance(Dragon(), tight.turn), stop=400.0).time is None

"""Turns of a path: their ends, angles and sides."""

import math

import pytest

from core import Arc, Dance, Dragon, Line, Passage, Route, Spiral, bench_cues
from core.people.turns import bends_between
from tests.support.near import assert_near
from tests.support.shared_dances import there_and_back

pytestmark = pytest.mark.uncompiled

# A bend of 20 degrees, a straight way, and a turn of 90 degrees to the right.
SLIGHT = math.radians(20.0)
RIGHT = -math.radians(90.0)
CROOKED = Route(
    [Arc((0, 5), 5.0, -math.pi / 2 - SLIGHT, SLIGHT), Line((0, 0), (10, 0)), Arc((10, -3), 3.0, math.pi / 2, RIGHT)],
    2.0,
)


def test_a_turn_has_its_angle_and_its_side_and_a_slight_bend_is_none():
    (turn,) = bends_between(CROOKED, CROOKED.begin, CROOKED.end)
    assert_near((turn.angle, turn.last - turn.first), (RIGHT, 1.5 * math.pi), 0.3)


def test_a_bench_begins_and_ends_a_turn_when_its_handle_is_there_and_a_spiral_turns_again_and_again():
    dance = Dance(Dragon(12), there_and_back(30), 1.0, [Passage(0.5, until_time=9.0)])
    head, *_, tail = bench_cues(dance)
    (first,), (last,) = head.turns, tail.turns
    assert_near((first.angle, last.s), (math.pi, first.s), 0.1)
    assert_near(dance.clock.travel(first.begin), first.s, 0.3)
    assert last.begin > first.begin + 8.0
    (spiral,) = bench_cues(Dance(Dragon(3), Spiral(1.0, 4.0)), [0], stop=40.0)
    assert spiral.turns[0].angle < -2.0 * math.pi

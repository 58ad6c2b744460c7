"""A dragon on a route: bends that are too tight for a chord, and room for the whole dragon."""

import pytest

from core import (
    Arc,
    Dance,
    Line,
    OutsideRun,
    Route,
    Waypoints,
    check,
    first_contact,
    trajectory,
)
from core.paths.following import ROOM_WIDTH, earliest_travel
from tests.core.paths.test_route import PLACE_ERROR
from tests.support.near import assert_near
from tests.support.random_routes import DRAGON, first_behind
from tests.support.refused import refused

LENGTH = float(DRAGON.chords.sum())
SAME = 1e-10  # [m]: one curve written in two ways


def line(length):
    return Route([Line((0, 0), (length, 0))])


def test_a_start_before_the_beginning_of_the_path_is_refused():
    dance = Dance(DRAGON, line(100))
    assert_near(trajectory(dance, LENGTH + 1e-6).position[-1, 0], 1e-6, SAME)
    with refused("times.0", OutsideRun):
        trajectory(dance, [LENGTH - 0.001])
    with refused("start", OutsideRun):
        first_contact(dance, start=0.0)


def test_a_path_a_hair_longer_than_the_dragon_has_room_and_a_shorter_one_or_an_arc_of_its_length_has_none():
    for path in (line(LENGTH - 1e-6), Route([Arc((0, 0), 3.7, 0, LENGTH / 3.7)])):
        with refused("path"):
            check(Dance(DRAGON, path))
    assert_near(check(Dance(DRAGON, line(LENGTH + 1e-6))).start, LENGTH, 1e-6)


@pytest.mark.parametrize("begin", [0.0, 3.0])
def test_at_its_earliest_travel_the_head_is_a_dragon_ahead_of_the_beginning(begin):
    route = Route([Waypoints(((0, 0), (8, 1), (12, 6), (9, 12), (0, 14)))])
    s = head = earliest_travel(DRAGON, route, begin)
    for chord in DRAGON.chords.tolist():
        s = first_behind(route, s, chord)
    assert begin - PLACE_ERROR <= s <= begin + ROOM_WIDTH * (1.0 + head)

"""A dragon on a route: bends that are too tight for a chord, and room for the whole dragon."""

import math

import pytest

from core import (
    Arc,
    Dance,
    Dragon,
    InvalidValue,
    Judgement,
    Legs,
    Line,
    OutsideRun,
    Route,
    Turn,
    Waypoints,
    check,
    first_contact,
    trajectory,
)
from core.paths.following import ROOM_WIDTH, earliest_travel, following, follows
from tests.campaigns import hunt_bends
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


def test_benches_follow_the_random_bends_on_which_small_steps_see_them_follow():
    result = hunt_bends.hunt(seed=1, cases=40)
    assert result.faults == 0
    assert {"followed", "backwards"} <= result.kinds.keys()


@pytest.mark.parametrize(
    "ratio, entry, leaving, length, followed",
    [(0.7, 3.65, 4.25, 7.7319, True), (1.25, 4.0, 3.45, 7.8905, True), (1.417, 3.617, 3.097, 7.6918, False)],
)
def test_turns_with_an_arc_tighter_than_half_a_chord_are_danced_unless_a_bench_jumps(
    ratio, entry, leaving, length, followed
):
    turn = Turn(1.7, ratio=ratio, entry_radius=entry, exit_radius=leaving)
    assert_near(turn.length, length, 1e-4)
    assert follows(Dragon(), turn) is followed
    if not followed:
        words = r"bench 0 .* beyond s = 9.60113 m, .* at 9.60113 s; .* jump to a nearer place"
        with pytest.raises(InvalidValue, match=words):
            Dance(Dragon(), turn)
        return
    dance = Dance(Dragon(60), turn)
    s = 5.0
    handles = trajectory(dance, s).position
    for k, chord in enumerate(dance.dragon.chords.tolist()[:3]):
        s = first_behind(turn, s, chord)
        assert_near(turn.position(s), handles[k + 1], SAME)


def test_a_corner_of_a_right_angle_is_walked_around_and_one_that_turns_back_is_refused_with_its_place_and_bench():
    street = [(0.0, 0.0), (60.0, 0.0)]
    assert check(Dance(Dragon(20), Legs([*street, (60.0, 30.0)], [0, 1], radius=0.5))).stop > 89.0
    words = (
        r"bench 0 \(2.86 m\) cannot follow beyond s = 59.685 m, at \(59.28, 0.6059\) m, .* at 59.685 s; .* backwards"
    )
    with pytest.raises(InvalidValue, match=words):
        Dance(Dragon(20), Legs([*street, (40.0, 20.0)], [0, 1], radius=0.5))


def test_the_last_bench_meets_the_bend_that_the_others_can_follow():
    """A head bench of 1 m passes where those behind it, of 2 m, cannot."""
    route = Legs([(0.0, 0.0), (20.0, 0.0), (5.0, 12.0)], [0, 1], radius=0.6)
    assert follows(Dragon(1, 1.2, overhang=0.1), route)
    [obstacle] = following(Dragon(3, 1.2, 2.2, overhang=0.1), route).obstacles
    assert obstacle.bench == 1


U_TURN = [Arc((8.0, 0.9), 0.9, -0.5 * math.pi, math.pi), Line((8.0, 1.8), (-80.0, 1.8))]


@pytest.mark.parametrize("start", [0.0, 8.0, 9.0, 11.0])
def test_bends_before_and_beyond_place_zero_are_looked_at(start):
    route = Route([Line((0.0, 0.0), (8.0, 0.0)), *U_TURN], start)
    (obstacle,) = following(Dragon(1), route).obstacles
    # There the bench is across the path of its front handle.
    assert_near(obstacle.s + start, 8.0 + 0.9 * math.acos(-0.9 / (2.86 - 0.9)), 1e-6)
    corners = Legs([(0.0, 0.0), (8.0, 0.0), (8.051, 0.296), (0.513, 2.976)], [0, 1, 2], radius=0.0, start=start)
    assert not follows(Dragon(1), corners)


def test_no_bench_is_refused_for_a_bend_that_it_has_passed_before_the_dance_begins():
    route = Route([Line((0.0, 0.0), (8.0, 0.0)), *U_TURN])
    assert check(Dance(Dragon(20), route)).verdict is Judgement.PASSES
    # A path that is too short for the dragon is judged as it would be for a shorter one.
    for benches in (2, 223):
        with refused("path", bench=0):
            Dance(Dragon(benches), route)

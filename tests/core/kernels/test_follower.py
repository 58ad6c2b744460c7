"""Proofs that a bench follows a route with bends of any radius."""

import math

from core import Arc, Line, Route
from core.kernels import Follower
from core.kernels.constants import REAR_COSINE_LEAST, Follows
from tests.support.near import assert_near

CHORD = 2.0
RADIUS = 0.7


def around(angle):
    """A line of 5 m, an arc of the radius, and a line of 5 m."""
    end = (RADIUS * math.sin(angle), RADIUS * (1.0 - math.cos(angle)))
    out = (end[0] + 5.0 * math.cos(angle), end[1] + 5.0 * math.sin(angle))
    return Route([Line((-5.0, 0.0), (0.0, 0.0)), Arc((0.0, RADIUS), RADIUS, -0.5 * math.pi, angle), Line(end, out)])


def end_of_proof(angle, least=REAR_COSINE_LEAST):
    route = around(angle)
    proof = Follower(route.table, CHORD, least)
    return proof.follow(5.0, route.end, route.joints[1], 1e7), proof


def test_the_least_cosine_at_the_front_handle_is_that_at_the_end_of_the_arc():
    """There the front handle is y = r (1 - cos a) beside the line on which the rear one still is."""
    angle = math.radians(90.0)
    ended, proof = end_of_proof(angle)
    assert ended == Follows.PROVEN
    assert proof.front_cosine > RADIUS / CHORD - 0.1
    assert proof.front_cosine <= RADIUS / CHORD


def test_a_bench_follows_an_arc_up_to_the_angle_at_which_its_rear_handle_goes_across_it():
    """With the front handle at the end of the arc, u . T = sin a sin b + cos a cos b there, with the angle b of the
    chord, sin b = y / c; and the same at the rear handle when that one is at the beginning of the arc."""
    low = math.radians(90.0)
    high = math.radians(170.0)
    while high - low > 1e-9:
        angle = 0.5 * (low + high)
        across = RADIUS * (1.0 - math.cos(angle)) / CHORD
        cosine = math.sin(angle) * across + math.cos(angle) * math.sqrt(1.0 - across * across)
        low, high = (angle, high) if cosine > REAR_COSINE_LEAST else (low, angle)
    assert end_of_proof(low - 1e-5)[0] == Follows.PROVEN
    ended, proof = end_of_proof(high + 1e-5)
    assert ended == Follows.SIDEWAYS
    assert_near(proof.rear, 5.0, 1e-3)


def test_on_a_circle_the_limit_at_the_rear_handle_decides_and_too_small_a_circle_has_no_place_behind():
    for radius, expected in ((1.0002, Follows.SIDEWAYS), (1.002, Follows.PROVEN), (0.9, Follows.NOWHERE)):
        route = Route([Arc((0.0, 0.0), radius, 0.0, 6.0)])
        proof = Follower(route.table, CHORD, REAR_COSINE_LEAST)
        assert proof.follow(4.0, route.end, route.end, 1e7) == expected


def test_a_proof_that_takes_more_work_than_it_may_says_so():
    route = around(1.0)
    assert Follower(route.table, CHORD, 0.04).follow(5.0, route.end, route.joints[1], 10.0) == Follows.UNKNOWN

"""Routes: joints, arc length, and the same answers as an independent slow way."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings

from core import (
    Arc,
    Dance,
    Line,
    Route,
    Turn,
    trajectory,
)
from core.quantities import Quantity
from tests.support.depth import examples
from tests.support.near import assert_near
from tests.support.random_routes import DRAGON, first_behind, routes
from tests.support.refused import refused

TURN = Turn(1.7, 4.5, 2.0)
CHORD_ERROR = 1e-11  # [m], at coordinates to 100 m
PLACE_ERROR = 1e-9  # [m]: handles by a scan and brentq, each good to 1e-12 m, along a chain
QUOTIENT_STEP = 1e-6  # [s]
QUOTIENT_ERROR = 1e-4  # [m/s]: accelerations jump at joints, which moves a quotient by their size times the step
QUARTER = Arc((5.0 - math.sin(0.5), math.cos(0.5)), 1.0, 0.5 - 0.5 * math.pi, 1.5)
LENGTH = float(DRAGON.chords.sum())  # 16.4 m


def way(*points):
    return [Line(*ends) for ends in pairwise(points)]


@pytest.mark.parametrize(
    "pieces, field, values",
    [
        (way((0, 0), (5, 0)) + way((5.25, 0), (9, 0)), "path.pieces.1", {"gap": Quantity(0.25, "m", 3)}),
        (way((0, 0), (5, 0), (6, 0), (6, 1)), "path.pieces.2", {"got": Quantity(90.0, "degrees", 6)}),
        ([*way((0, 0), (5, 0)), QUARTER], "path.pieces.1", {"at": "(5, 0) m"}),
        ([], "path.pieces", {}),
    ],
    ids=["a gap", "a right angle", "a kink", "none"],
)
def test_what_is_no_smooth_way_is_refused_with_its_joint_and_size(pieces, field, values):
    with refused(field, **values):
        Route(pieces)


STRAIGHT = Route([Line((0, 0), (100, 0))])


@pytest.mark.parametrize(
    "path, head_speed, first, last",
    [
        (STRAIGHT, 1.0, 17, 100),
        (Route([Line((0, 0), (100.5, 0))], 10.0), 1.0, 7, 90),
        (Route(STRAIGHT.pieces, 200.0), 1.0, -183, -100),
        (STRAIGHT, 7.0, 3, 14),
        (TURN, 1.0, 0, 300),
    ],
    ids=["line", "started", "ended", "fast", "turn"],
)
def test_default_instants_are_whole_seconds_that_the_run_has(path, head_speed, first, last):
    dance = Dance(DRAGON, path, head_speed)
    assert dance.default_times.tolist() == list(range(first, last + 1))
    assert math.ceil(dance.default_start) == first
    assert trajectory(dance, dance.default_times).speed.min() >= 0.0


def instants(route, count):
    return np.linspace(1.005 * LENGTH, route.end - QUOTIENT_STEP, count)


@settings(max_examples=30, deadline=None)
@given(routes())
def test_chords_keep_their_length_and_velocities_are_difference_quotients_on_any_route(route):
    times = instants(route, 15)
    before, motion, after = (
        trajectory(Dance(DRAGON, route), times + step) for step in (-QUOTIENT_STEP, 0.0, QUOTIENT_STEP)
    )
    chords = np.linalg.norm(np.diff(motion.position, axis=1), axis=-1)
    assert_near(chords, np.broadcast_to(DRAGON.chords, chords.shape), CHORD_ERROR)
    assert_near((after.position - before.position) / (2.0 * QUOTIENT_STEP), motion.velocity, QUOTIENT_ERROR)
    assert_near(np.linalg.norm(motion.velocity, axis=-1), motion.speed, CHORD_ERROR)


@settings(max_examples=examples(8, 20), deadline=None)
@given(routes())
def test_the_next_handle_is_the_first_point_behind_at_chord_distance(route):
    times = instants(route, 4)
    for handles, s in zip(trajectory(Dance(DRAGON, route), times).position, times.tolist(), strict=True):
        behind = [s]
        for chord in DRAGON.chords.tolist():
            behind.append(first_behind(route, behind[-1], chord))
        assert_near(handles, route.position(np.array(behind)), PLACE_ERROR)

"""Handles, velocities, poses and the end of a run."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Dance, Dragon, Spiral, Turn, kernels, trajectory
from core.error_free import paired
from core.kernels import LANES_PER_BLOCK
from tests.support import random_dances
from tests.support.near import assert_near
from tests.support.reference import reference
from tests.support.refused import refused
from tests.support.slow_search import SlowDance

pytestmark = pytest.mark.uncompiled

REFERENCE = reference("trajectory")
# Positions and speeds are promised to this [m] and [m/s].
ACCURACY = 1e-11
# Rounding of a position, relative to the largest coordinate [1].
ROUNDING = 1e-12
DANCE = Dance(Dragon(), Spiral())
DANCES = random_dances.DANCES.map(lambda both: Dance(*both))
COLUMNS = "time", "position", "velocity", "speed"


@pytest.mark.parametrize("table", ["selected", "full"])
def test_every_handle_is_that_of_the_reference(table):
    rows = REFERENCE[table]
    motion = trajectory(DANCE, [row["time"] for row in rows])
    result = np.concatenate([motion.position, motion.speed[..., None]], axis=-1)
    for row, places in zip(rows, result, strict=True):
        numbers = [handle.get("handle", k) for k, handle in enumerate(row["handles"])]
        known = [[handle["x"], handle["y"], handle["speed"]] for handle in row["handles"]]
        assert_near(places[numbers], known, ACCURACY)


@settings(max_examples=30, deadline=None)
@given(DANCES, st.floats(-0.5, 0.999), st.floats(0.1, 10.0))
def test_handles_are_those_of_the_slow_dance_sooner_with_a_faster_head(dance, share, head_speed):
    travel = share * dance.end.time
    slow = SlowDance.of(dance.dragon, dance.path).handles([travel])[0]
    motion = trajectory(Dance(dance.dragon, dance.path, head_speed), travel / head_speed)
    # close to the fold a handle moves as the square root of what is left
    assert_near(motion.position, slow, 1e-9 * (1.0 + np.abs(slow).max()))


@settings(max_examples=40, deadline=None)
@given(DANCES, st.floats(-0.5, 0.9), st.floats(0.2, 5.0))
def test_velocities_are_the_difference_quotients_of_positions(dance, share, head_speed):
    dance = Dance(dance.dragon, dance.path, head_speed)
    end = dance.end.time
    time = share * end
    h = 1e-6 * end * (1.0 - share)
    moving = trajectory(dance, [time - h, time, time + h])
    quotient = (moving.position[2] - moving.position[0]) / (2 * h)
    assert_near(quotient, moving.velocity[1], 1e-5 * moving.speed.max() + 1e-8 / h * ROUNDING)
    np.testing.assert_allclose(np.linalg.norm(moving.velocity, axis=-1), moving.speed, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(moving.speed[:, 0], head_speed, rtol=1e-14)


@pytest.mark.parametrize("instants", [*range(LANES_PER_BLOCK + 2), 2 * LANES_PER_BLOCK + 1])
@pytest.mark.parametrize(
    "dragon, path, most",
    [
        *((Dragon(12), Spiral(), 432.0), (Dragon(1), Spiral(), 432.0)),
        (Dragon.of([1.0, 3.0, 2.0, 2.0, 2.0, 2.0, 2.0, 0.6, 2.0, 1.5], [0.2] * 10, [0.1] * 10), Spiral(), 430.0),
        (Dragon(30), Turn(1.7), 40.0),
    ],
    ids=["uniform", "lone bench", "bench by bench", "turn"],
)
def test_a_batch_equals_a_loop_whatever_its_place_in_a_block(dragon, path, most, instants):
    times = np.random.default_rng(instants).permutation(np.linspace(-40.0, most, instants))
    dance = Dance(dragon, path)
    batch = trajectory(dance, times)
    assert batch.position.shape == (instants, dragon.benches + 1, 2)
    for k, time in enumerate(times.tolist()):
        single = trajectory(dance, time)
        assert all(np.array_equal(getattr(batch, name)[k], getattr(single, name)) for name in COLUMNS)


# Near the crest a root is as uncertain as rounding of theta makes it; 2e-15 theta was met, 2026-11-21 [1].
CREST_ROUNDING = 1e-14


@pytest.mark.parametrize("delta", [1.0, 2.0, 3.0, 3.1, 3.14, 3.1415])
def test_a_chord_across_the_whole_coil_ends_where_bisection_says(delta):
    for theta in np.geomspace(3.0, 1000.0, 300):
        chord = math.sqrt(delta**2 + 4.0 * theta * (theta + delta) * math.sin(0.5 * delta) ** 2)
        row, position = first_folded_row([theta], [chord])
        assert row == 1
        assert_near(np.hypot(*position[0, 1]), theta + kernels.first_root(theta, chord**2), CREST_ROUNDING * theta)


# In units of growth: a head at HALF_FOLDED takes the first chord but not the second, at FOLDED not even the first.
FOLDING_CHORDS, STANDING, HALF_FOLDED, FOLDED = [6.0, 20.0, 1.0], 30.0, 2.0, 1.0


def first_folded_row(heads, chords):
    position, velocity = np.zeros((2, len(heads), len(chords) + 1, 2))
    speed = np.zeros(position.shape[:2])
    budget = kernels.Budget()
    row = kernels.spiral_trajectory(
        1.0, paired(np.array(heads)), np.array(chords), 1.0, position, velocity, speed, budget
    )
    return row, position


@pytest.mark.parametrize("row", range(2 * LANES_PER_BLOCK + 1))
def test_the_first_row_that_folds_is_found_wherever_it_stands_in_its_block(row):
    _, whole = first_folded_row([STANDING], FOLDING_CHORDS)
    for first, later in ((HALF_FOLDED, FOLDED), (FOLDED, HALF_FOLDED), (FOLDED, STANDING), (HALF_FOLDED, STANDING)):
        heads = [STANDING] * row + [first] + [later] * (2 * LANES_PER_BLOCK - row)
        result, position = first_folded_row(heads, FOLDING_CHORDS)
        assert result == row
        assert (position[:row] == whole[0]).all()


@pytest.mark.parametrize("times, field", [(math.inf, "times"), ([0.0, math.nan], "times.1"), ([[0.0]], "times")])
def test_times_that_are_no_flat_list_of_numbers_are_refused(times, field):
    with refused(field):
        trajectory(DANCE, times)

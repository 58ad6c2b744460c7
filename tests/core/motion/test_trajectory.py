"""Handles, velocities, poses and the end of a run."""

import hashlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Dance, Dragon, OutsideRun, Spiral, Turn, kernels, trajectory
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
        assert len(known) == (224 if table == "full" else 7)
        assert_near(places[numbers], known, ACCURACY)


def test_all_rows_rounded_to_six_decimals_have_the_sha256_of_the_reference():
    dance = trajectory(DANCE, np.arange(301.0))
    digest = hashlib.sha256()
    for t in range(301):
        for k in range(224):
            row = [f"{value:.6f}" for value in (*dance.position[t, k], dance.speed[t, k])]
            row = ["0.000000" if value == "-0.000000" else value for value in row]
            digest.update(f"{t} {k} {' '.join(row)}\n".encode())
    assert digest.hexdigest() == REFERENCE["sha256_of_all_six_decimal_rows"]["t=0..300 step 1"]


@settings(max_examples=40, deadline=None)
@given(DANCES, st.floats(-0.5, 1.0))
def test_chords_keep_their_length_and_handles_stay_on_the_spiral(dance, share):
    pitch = dance.path.pitch
    position = trajectory(dance, share * dance.end.time).position
    size = ROUNDING * (np.abs(position).max() + pitch)
    assert_near(np.linalg.norm(np.diff(position, axis=0), axis=1), dance.dragon.chords, 10 * size)
    radius = np.hypot(*position.T)
    turns = radius / pitch - np.arctan2(position[:, 1], position[:, 0]) / (2 * np.pi)
    off = np.abs(turns - np.round(turns)) * pitch
    assert off[radius > 1e-3 * pitch].max(initial=0.0) <= 100 * size


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
    time, h = share * end, 1e-6 * end * (1.0 - share)
    moving = trajectory(dance, [time - h, time, time + h])
    quotient = (moving.position[2] - moving.position[0]) / (2 * h)
    assert_near(quotient, moving.velocity[1], 1e-5 * moving.speed.max() + 1e-8 / h * ROUNDING)
    np.testing.assert_allclose(np.linalg.norm(moving.velocity, axis=-1), moving.speed, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(moving.speed[:, 0], head_speed, rtol=1e-14)


def assert_a_batch_equals_a_loop(dance, times):
    batch, handles = trajectory(dance, times), dance.dragon.benches + 1
    assert batch.position.shape == (len(times), handles, 2)
    for k, time in enumerate(times):
        single = trajectory(dance, time)
        assert (single.time.shape, single.position.shape, single.speed.shape) == ((), (handles, 2), (handles,))
        assert all(np.array_equal(getattr(batch, name)[k], getattr(single, name)) for name in COLUMNS)


@settings(max_examples=25, deadline=None)
@given(DANCES, st.lists(st.floats(-0.2, 1.0), max_size=5))
def test_a_batch_equals_a_loop_to_the_last_bit(dance, shares):
    assert_a_batch_equals_a_loop(dance, [share * dance.end.time for share in shares])


@pytest.mark.parametrize("instants", [*range(1, LANES_PER_BLOCK + 2), 2 * LANES_PER_BLOCK + 1])
@pytest.mark.parametrize(
    ("dragon", "path", "most"),
    [
        *((Dragon(12), Spiral(), 432.0), (Dragon(1), Spiral(), 432.0)),
        (Dragon.of([1.0, 3.0, 2.0, 2.0, 2.0, 2.0, 2.0, 0.6, 2.0, 1.5], [0.2] * 10, [0.1] * 10), Spiral(), 430.0),
        (Dragon(30), Turn(1.7), 40.0),
    ],
    ids=["uniform", "lone bench", "bench by bench", "turn"],
)
def test_a_batch_equals_a_loop_whatever_its_place_in_a_block(dragon, path, most, instants):
    times = np.random.default_rng(instants).permutation(np.linspace(-40.0, most, instants))
    assert_a_batch_equals_a_loop(Dance(dragon, path), times.tolist())


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
    assert first_folded_row([HALF_FOLDED], FOLDING_CHORDS[:1])[0] == 1
    assert first_folded_row([HALF_FOLDED], FOLDING_CHORDS)[0] == 0
    assert first_folded_row([FOLDED], FOLDING_CHORDS[:1])[0] == 0
    standing, whole = first_folded_row([STANDING], FOLDING_CHORDS)
    assert standing == 1
    for first, later in ((HALF_FOLDED, FOLDED), (FOLDED, HALF_FOLDED), (FOLDED, STANDING), (HALF_FOLDED, STANDING)):
        heads = [STANDING] * row + [first] + [later] * (2 * LANES_PER_BLOCK - row)
        result, position = first_folded_row(heads, FOLDING_CHORDS)
        assert result == row
        assert (position[:row] == whole[0]).all()


@pytest.mark.parametrize(
    ("times", "field"),
    [
        *(([[0.0]], "times"), ("0", "times"), (["soon"], "times")),
        *((math.inf, "times"), ([0.0, math.nan], "times.1"), ([math.inf], "times.0")),
    ],
)
def test_times_that_are_no_flat_list_of_numbers_are_refused(times, field):
    with refused(field):
        trajectory(DANCE, times)


@pytest.mark.parametrize(("times", "field"), [(500.0, "times"), ([0, 500], "times.1")])
def test_a_time_after_the_end_is_refused_by_its_place_with_the_end(times, field):
    with pytest.raises(OutsideRun, match=r"432\.917924228 s, when bench 0 folds, got 500 s") as caught:
        trajectory(DANCE, times)
    assert caught.value.field == field


def test_no_times_give_an_empty_table():
    assert trajectory(Dance(Dragon(4), Spiral()), []).position.shape == (0, 5, 2)

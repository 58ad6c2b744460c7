"""Handles, velocities, poses and the end of a run."""

from __future__ import annotations

import hashlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    BenchDragonError,
    Dance,
    Dragon,
    InvalidValue,
    Route,
    Spiral,
    Turn,
    kernels,
    trajectory,
)
from core.error_free import paired
from core.kernels import LANES_PER_BLOCK
from tests.support.random_dances import DANCES
from tests.support.reference import reference
from tests.support.slow_search import SlowDance

pytestmark = pytest.mark.uncompiled

REFERENCE = reference("trajectory")
# Positions and speeds are promised to this [m] and [m/s].
ACCURACY = 1e-11
# Rounding of a position, relative to the largest coordinate [1].
ROUNDING = 1e-12


def instant(dragon: Dragon, spiral: Spiral, share: float) -> float:
    """The time at a share of the run, 1 at its end [s]; negative before the start."""
    return share * Dance(dragon, spiral).end.time


def test_the_selected_handles_are_those_of_the_reference() -> None:
    rows = REFERENCE["selected"]
    dance = trajectory(Dance(Dragon(), Spiral()), [row["time"] for row in rows])
    for k, row in enumerate(rows):
        for handle in row["handles"]:
            place = dance.position[k, handle["handle"]]
            np.testing.assert_allclose(place, [handle["x"], handle["y"]], rtol=0, atol=ACCURACY)
            assert dance.speed[k, handle["handle"]] == pytest.approx(handle["speed"], rel=0, abs=ACCURACY)


def test_every_handle_is_that_of_the_reference() -> None:
    rows = REFERENCE["full"]
    dance = trajectory(Dance(Dragon(), Spiral()), [row["time"] for row in rows])
    for k, row in enumerate(rows):
        places = [[handle["x"], handle["y"]] for handle in row["handles"]]
        np.testing.assert_allclose(dance.position[k], places, rtol=0, atol=ACCURACY)
        np.testing.assert_allclose(dance.speed[k], [h["speed"] for h in row["handles"]], rtol=0, atol=ACCURACY)


def test_all_rows_rounded_to_six_decimals_have_the_sha256_of_the_reference() -> None:
    dance = trajectory(Dance(Dragon(), Spiral()), np.arange(301.0))
    digest = hashlib.sha256()
    for t in range(301):
        for k in range(224):
            row = [f"{value:.6f}" for value in (*dance.position[t, k], dance.speed[t, k])]
            row = ["0.000000" if value == "-0.000000" else value for value in row]
            digest.update(f"{t} {k} {' '.join(row)}\n".encode())
    assert digest.hexdigest() == REFERENCE["sha256_of_all_six_decimal_rows"]["t=0..300 step 1"]


@settings(max_examples=60, deadline=None)
@given(DANCES, st.floats(-0.5, 1.0))
def test_chords_keep_their_length_and_handles_stay_on_the_spiral(dance: tuple[Dragon, Spiral], share: float) -> None:
    dragon, spiral = dance
    position = trajectory(Dance(dragon, spiral), [instant(dragon, spiral, share)]).position[0]
    size = ROUNDING * (np.abs(position).max() + spiral.pitch)
    links = np.linalg.norm(np.diff(position, axis=0), axis=1)
    np.testing.assert_allclose(links, dragon.chords, rtol=0, atol=10 * size)
    turns = np.hypot(*position.T) / spiral.pitch - np.arctan2(position[:, 1], position[:, 0]) / (2 * np.pi)
    off = np.abs(turns - np.round(turns)) * spiral.pitch
    assert off[np.hypot(*position.T) > 1e-3 * spiral.pitch].max(initial=0.0) <= 100 * size


@settings(max_examples=40, deadline=None)
@given(DANCES, st.floats(-0.5, 0.999))
def test_handles_are_those_of_the_slow_dance(dance: tuple[Dragon, Spiral], share: float) -> None:
    dragon, spiral = dance
    time = instant(dragon, spiral, share)
    position = trajectory(Dance(dragon, spiral), [time]).position[0]
    slow = SlowDance.of(dragon, spiral).handles([time])[0]
    # close to the fold a handle moves as the square root of what is left
    np.testing.assert_allclose(position, slow, rtol=0, atol=1e-9 * (1.0 + np.abs(position).max()))


@settings(max_examples=60, deadline=None)
@given(DANCES, st.floats(-0.5, 0.9), st.floats(0.2, 5.0))
def test_velocities_are_the_difference_quotients_of_positions(
    dance: tuple[Dragon, Spiral], share: float, head_speed: float
) -> None:
    dragon, spiral = dance
    end = Dance(dragon, spiral, head_speed).end.time
    time, h = share * end, 1e-6 * end * (1.0 - share)
    moving = trajectory(Dance(dragon, spiral, head_speed), [time - h, time, time + h])
    quotient = (moving.position[2] - moving.position[0]) / (2 * h)
    fastest = moving.speed.max()
    np.testing.assert_allclose(quotient, moving.velocity[1], rtol=0, atol=1e-5 * fastest + 1e-8 / h * ROUNDING)
    np.testing.assert_allclose(np.linalg.norm(moving.velocity, axis=-1), moving.speed, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(moving.speed[:, 0], head_speed, rtol=1e-14)


@settings(max_examples=40, deadline=None)
@given(DANCES, st.lists(st.floats(-0.2, 1.0), max_size=5))
def test_a_batch_equals_a_loop_to_the_last_bit(dance: tuple[Dragon, Spiral], shares: list[float]) -> None:
    dragon, spiral = dance
    assert_a_batch_equals_a_loop(dragon, spiral, [instant(dragon, spiral, share) for share in shares])


@pytest.mark.parametrize("instants", range(1, 2 * LANES_PER_BLOCK + 2))
@pytest.mark.parametrize(
    "dragon",
    [Dragon(12), Dragon(1), Dragon.of([1.0, 3.0, 2.0, 2.0, 2.0, 2.0, 2.0, 0.6, 2.0, 1.5], [0.2] * 10, [0.1] * 10)],
    ids=["uniform", "lone bench", "bench by bench"],
)
def test_a_batch_equals_a_loop_whatever_its_place_in_a_block(dragon: Dragon, instants: int) -> None:
    shares = np.random.default_rng(instants).permutation(np.linspace(-0.1, 1.0, instants))
    assert_a_batch_equals_a_loop(dragon, Spiral(), [instant(dragon, Spiral(), share) for share in shares])


def assert_a_batch_equals_a_loop(dragon: Dragon, spiral: Spiral, times: list[float]) -> None:
    batch = trajectory(Dance(dragon, spiral), times)
    assert batch.position.shape == (len(times), dragon.benches + 1, 2)
    for k, time in enumerate(times):
        one = trajectory(Dance(dragon, spiral), [time])
        assert np.array_equal(batch.position[k], one.position[0])
        assert np.array_equal(batch.velocity[k], one.velocity[0])
        assert np.array_equal(batch.speed[k], one.speed[0])


# Near the crest a root is as uncertain as rounding of theta makes it; 2e-15 theta was met, 2026-11-21 [1].
CREST_ROUNDING = 1e-14


@pytest.mark.parametrize("delta", [1.0, 2.0, 3.0, 3.1, 3.14, 3.1415])
def test_a_chord_across_the_whole_coil_ends_where_bisection_says(delta: float) -> None:
    for theta in np.geomspace(3.0, 1000.0, 300):
        chord = math.sqrt(delta**2 + 4.0 * theta * (theta + delta) * math.sin(0.5 * delta) ** 2)
        row, position = first_folded_row([theta], [chord])
        assert row == 1
        root = theta + kernels.first_root(theta, chord**2)
        assert np.hypot(*position[0, 1]) == pytest.approx(root, rel=0, abs=CREST_ROUNDING * theta)


# In units of growth: a head at HALF_FOLDED takes the first chord but not the second, at FOLDED not even the first.
FOLDING_CHORDS, STANDING, HALF_FOLDED, FOLDED = [6.0, 20.0, 1.0], 30.0, 2.0, 1.0


def first_folded_row(heads: list[float], chords: list[float]) -> tuple[int, np.ndarray]:
    position, velocity = np.zeros((2, len(heads), len(chords) + 1, 2))
    speed = np.zeros(position.shape[:2])
    budget = kernels.Budget()
    row = kernels.spiral_trajectory(
        1.0, paired(np.array(heads)), np.array(chords), 1.0, position, velocity, speed, budget
    )
    return row, position


@pytest.mark.parametrize("row", range(2 * LANES_PER_BLOCK + 1))
def test_the_first_row_that_folds_is_found_wherever_it_stands_in_its_block(row: int) -> None:
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


@settings(max_examples=40, deadline=None)
@given(DANCES, st.floats(-0.2, 0.95), st.floats(0.5, 2.0))
def test_scaling_every_length_scales_every_place(dance: tuple[Dragon, Spiral], share: float, k: float) -> None:
    dragon, spiral = dance
    large = Dragon.of(k * dragon.lengths, k * dragon.widths, k * dragon.overhangs)
    time = instant(dragon, spiral, share)
    small = trajectory(Dance(dragon, spiral), [time])
    scaled = trajectory(Dance(large, Spiral(k * spiral.pitch, spiral.start_turns)), [k * time])
    np.testing.assert_allclose(scaled.position, k * small.position, rtol=0, atol=1e-9 * np.abs(small.position).max())
    np.testing.assert_allclose(scaled.speed, small.speed, rtol=1e-8)


@settings(max_examples=40, deadline=None)
@given(DANCES, st.floats(0.0, 0.99), st.floats(0.1, 10.0))
def test_a_faster_head_is_at_the_same_place_sooner(
    dance: tuple[Dragon, Spiral], share: float, head_speed: float
) -> None:
    dragon, spiral = dance
    time = instant(dragon, spiral, share)
    slow, fast = (trajectory(Dance(dragon, spiral, v), [time / v]) for v in (1.0, head_speed))
    size = np.abs(slow.position).max() + spiral.pitch
    np.testing.assert_allclose(fast.position, slow.position, rtol=0, atol=1e-9 * size)
    np.testing.assert_allclose(fast.speed, head_speed * slow.speed, rtol=1e-7)


@pytest.mark.parametrize(
    ("times", "field"),
    [([[0.0]], "times"), ("0", "times"), (["soon"], "times"), ([0.0, math.nan], "times.1"), ([math.inf], "times.0")],
)
def test_times_that_are_no_flat_list_of_numbers_are_refused(times: object, field: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        trajectory(Dance(Dragon(), Spiral()), times)  # type: ignore[arg-type]
    assert refused.value.field == field


@pytest.mark.parametrize("path", [Spiral(), Turn(1.7)], ids=["spiral", "turn"])
def test_one_time_answers_one_instant_and_a_list_is_a_loop_over_its_times(path: Spiral | Route) -> None:
    dragon, times = Dragon(30), [0.0, 12.5, 40.0]
    many = trajectory(Dance(dragon, path), times)
    for k, time in enumerate(times):
        one = trajectory(Dance(dragon, path), time)
        assert one.time.shape == ()
        assert one.position.shape == one.velocity.shape == (31, 2)
        assert one.speed.shape == (31,)
        for name in ("time", "position", "velocity", "speed"):
            assert np.array_equal(getattr(one, name), getattr(many, name)[k])


@pytest.mark.parametrize(
    ("times", "words"),
    [
        (500.0, r"^times must be at most 432\.917924228 s, when bench 0 folds, got 500 s$"),
        ([0, 500], r"^times\[1\] must be at most 432\.917924228 s, when bench 0 folds, got 500 s$"),
        (math.inf, r"^times must be finite, got inf s$"),
    ],
)
def test_a_time_that_is_refused_is_named_as_it_was_given(times: object, words: str) -> None:
    with pytest.raises(BenchDragonError, match=words):
        trajectory(Dance(Dragon(), Spiral()), times)  # type: ignore[arg-type]


def test_no_times_give_an_empty_table() -> None:
    assert trajectory(Dance(Dragon(4), Spiral()), []).position.shape == (0, 5, 2)

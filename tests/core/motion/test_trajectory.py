"""Handles, velocities, poses and the end of a run."""

from __future__ import annotations

import hashlib
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    BenchDragonError,
    Dance,
    Dragon,
    EndReason,
    InvalidValue,
    OutsideRun,
    Route,
    Spiral,
    Turn,
    bench_poses,
    kernels,
    trajectory,
)
from core.dance import HEAD_SPEED_MAX, HEAD_SPEED_MIN
from core.kernels import LANES_PER_BLOCK
from tests.core.slow_search import SlowDance

pytestmark = pytest.mark.uncompiled

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "trajectory.json").read_text())
# Positions and speeds are promised to this [m] and [m/s].
ACCURACY = 1e-11
# Rounding of a position, relative to the largest coordinate [1].
ROUNDING = 1e-12
# The slow dance finds the end by bisecting on whether a chain exists: as good as the crest is flat [m of travel].
SLOW_END = 1e-8

SIZES = st.floats(0.3, 3.0)
DRAGONS = st.one_of(
    st.builds(
        Dragon, st.integers(1, 25), st.floats(0.5, 4.0), st.floats(0.5, 4.0), st.floats(0.05, 1.0), st.floats(0, 0.2)
    ),
    st.lists(SIZES, min_size=1, max_size=12).map(lambda c: Dragon.of(c, [0.2] * len(c), [0.1] * len(c))),
)
SPIRALS = st.builds(Spiral, pitch=st.floats(0.2, 3.0), start_turns=st.floats(3.0, 20.0))


def instant(dragon: Dragon, spiral: Spiral, share: float) -> float:
    """The time at a share of the run, 1 at its end [s]; negative before the start."""
    return share * Dance(dragon, spiral).end.time


def stands(dragon: Dragon, spiral: Spiral) -> bool:
    try:
        return Dance(dragon, spiral).end.time > 1.0
    except InvalidValue:
        return False


DANCES = st.tuples(DRAGONS, SPIRALS).filter(lambda dance: stands(*dance))


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
        assert row == -1
        root = theta + kernels.first_root(theta, chord**2)
        assert np.hypot(*position[0, 1]) == pytest.approx(root, rel=0, abs=CREST_ROUNDING * theta)


# In units of growth: a head at HALF_FOLDED takes the first chord but not the second, at FOLDED not even the first.
FOLDING_CHORDS, STANDING, HALF_FOLDED, FOLDED = [6.0, 20.0, 1.0], 30.0, 2.0, 1.0


def first_folded_row(heads: list[float], chords: list[float]) -> tuple[int, np.ndarray]:
    position, velocity = np.zeros((2, len(heads), len(chords) + 1, 2))
    speed = np.zeros(position.shape[:2])
    row = kernels.spiral_trajectory(1.0, np.array(heads), np.array(chords), 1.0, position, velocity, speed)
    return row, position


@pytest.mark.parametrize("row", range(2 * LANES_PER_BLOCK + 1))
def test_the_first_row_that_folds_is_found_wherever_it_stands_in_its_block(row: int) -> None:
    assert first_folded_row([HALF_FOLDED], FOLDING_CHORDS[:1])[0] == -1
    assert first_folded_row([HALF_FOLDED], FOLDING_CHORDS)[0] == 0
    assert first_folded_row([FOLDED], FOLDING_CHORDS[:1])[0] == 0
    standing, whole = first_folded_row([STANDING], FOLDING_CHORDS)
    assert standing == -1
    for first, later in ((HALF_FOLDED, FOLDED), (FOLDED, HALF_FOLDED), (FOLDED, STANDING), (HALF_FOLDED, STANDING)):
        heads = [STANDING] * row + [first] + [later] * (2 * LANES_PER_BLOCK - row)
        found, position = first_folded_row(heads, FOLDING_CHORDS)
        assert found == row
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


def test_the_default_run_ends_at_the_fold_of_the_head() -> None:
    end = Dance(Dragon(), Spiral()).end
    assert (end.reason, end.bench) == (EndReason.FOLD, 0)
    assert end.time == pytest.approx(432.917924228, abs=1e-8)
    assert end.theta is not None
    assert end.theta * Spiral().growth == pytest.approx(1.28980, abs=1e-5)


def test_a_wide_spiral_is_danced_to_its_centre() -> None:
    spiral = Spiral(9.0, 3.0)
    end = Dance(Dragon(5), spiral).end
    assert (end.reason, end.bench, end.theta) == (EndReason.CENTRE, None, 0.0)
    assert end.time == spiral.length
    assert trajectory(Dance(Dragon(5), spiral), [end.time]).position[0, 0].tolist() == [0.0, 0.0]


def test_the_reference_agrees_on_every_fold() -> None:
    cases = json.loads((Path(__file__).parents[2] / "reference" / "first_contact.json").read_text())["cases"]
    folding = [case for case in cases if case.get("fold_time")]
    assert folding
    for case in folding:
        end = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), case["head_speed"]).end
        assert end.time == pytest.approx(case["fold_time"], rel=0, abs=1e-9), case["name"]


def sampled_fold(chord2: float) -> float | None:
    """Where theta first stops falling along f = chord^2 as delta grows from pi, None if nowhere: two scans, the second
    around the least slope of the first."""

    def theta_and_slope(delta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rise = 1.0 - np.cos(delta)
        theta = np.sqrt(0.25 * delta**2 + np.maximum(chord2 - delta**2, 0.0) / (2.0 * rise)) - 0.5 * delta
        return theta, delta + theta * rise + theta * (theta + delta) * np.sin(delta)

    low, high = math.pi, min(2.0 * math.pi, math.sqrt(chord2))
    for _ in range(2):
        delta = np.linspace(low, high, 200_001)[1:-1]
        theta, slope = theta_and_slope(delta)
        if (slope < 0.0).any():
            return float(theta[int(np.argmax(slope < 0.0))])
        least = int(slope.argmin())
        low, high = delta[max(least - 2, 0)], delta[min(least + 2, delta.size - 1)]
    return None


# The chord, in units of growth squared, from which on a bench folds: core/kernels/fold.py [1].
FOLDING = 33.44973623331110255
# theta is flat at the fold: a sample beside it is good to this [rad].
BESIDE_FOLD = 1e-8


@pytest.mark.parametrize("excess", [-20.0, -1.0, -1e-6, 1e-8, 1e-7, 1e-6, 3e-6, 1e-5, 1e-3, 0.1, 1.0, 7.0, 100.0, 1e5])
def test_a_bench_folds_where_dense_samples_see_theta_stop_falling(excess: float) -> None:
    sampled = sampled_fold(FOLDING + excess)
    assert (sampled is None) == (excess < 0.0)
    fold = kernels.fold_theta(FOLDING + excess)
    assert fold == pytest.approx(sampled or 0.0, rel=BESIDE_FOLD, abs=0.0)


def test_a_chord_that_just_folds_ends_the_run_before_the_centre() -> None:
    """256 samples of delta missed that theta stops falling, and rises, between two of them."""
    growth = 0.5
    chord = growth * math.sqrt(FOLDING + 1e-6)
    end = Dance(Dragon(1, chord, chord, 0.1, 0.0), Spiral(2.0 * math.pi * growth, 3.0)).end
    assert end.reason is EndReason.FOLD
    assert end.theta == pytest.approx(sampled_fold(FOLDING + 1e-6), rel=BESIDE_FOLD)


@pytest.mark.parametrize("seed", range(12))
def test_a_run_of_unlike_benches_ends_where_the_slow_chain_stops(seed: int) -> None:
    rng = np.random.default_rng(seed)
    benches = int(rng.integers(1, 8))
    dragon = Dragon.of(10 ** rng.uniform(-0.5, 0.6, benches), [0.1] * benches, [0.05] * benches)
    spiral = Spiral(10 ** rng.uniform(-0.5, 0.8), 4.0)
    end = Dance(dragon, spiral).end
    assert end.time == pytest.approx(SlowDance.of(dragon, spiral).end(), abs=SLOW_END)


@settings(max_examples=40, deadline=None)
@given(DANCES)
def test_the_last_instant_is_danced_and_the_next_is_outside_the_run(dance: tuple[Dragon, Spiral]) -> None:
    dragon, spiral = dance
    end = Dance(dragon, spiral).end
    assert np.isfinite(trajectory(Dance(dragon, spiral), [0.0, end.time]).speed).all()
    with pytest.raises(OutsideRun) as refused:
        trajectory(Dance(dragon, spiral), [0.0, math.nextafter(end.time, math.inf)])
    assert refused.value.field == "times.1"
    assert ("folds" in str(refused.value)) == (end.reason is EndReason.FOLD)


def test_a_start_inside_the_fold_is_refused() -> None:
    fold = Dance(Dragon(), Spiral()).end.theta
    assert fold is not None
    turns = fold / (2 * math.pi)
    assert Dance(Dragon(), Spiral(0.55, turns * (1 + 1e-9))).end.time > 0.0
    with pytest.raises(InvalidValue) as refused:
        Dance(Dragon(), Spiral(0.55, turns))
    assert refused.value.field == "path.start_turns"


@pytest.mark.parametrize("head_speed", [HEAD_SPEED_MIN, 1.0, HEAD_SPEED_MAX])
def test_a_head_speed_at_its_limits_is_accepted(head_speed: float) -> None:
    assert Dance(Dragon(), Spiral(), head_speed).end.time == pytest.approx(432.917924228 / head_speed)


@pytest.mark.parametrize(
    "head_speed", [HEAD_SPEED_MIN / 2, HEAD_SPEED_MAX * 2, 0.0, -1.0, math.nan, math.inf, "1", None]
)
def test_a_head_speed_beyond_its_limits_is_refused(head_speed: object) -> None:
    with pytest.raises(InvalidValue) as refused:
        trajectory(Dance(Dragon(), Spiral(), head_speed), [0.0])  # type: ignore[arg-type]
    assert refused.value.field == "head_speed"


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


@pytest.mark.parametrize("handles", [None, 1.0, [[0.0, 0.0, 0.0]], [0.0, 0.0], "handles", [["a", "b"]]])
def test_handles_that_are_no_places_are_refused(handles: object) -> None:
    with pytest.raises(InvalidValue, match=r"^handles must be places of shape"):
        bench_poses(handles)  # type: ignore[arg-type]


def test_no_times_give_an_empty_table() -> None:
    assert trajectory(Dance(Dragon(4), Spiral()), []).position.shape == (0, 5, 2)


@given(st.integers(1, 6), st.integers(0, 3), st.data())
def test_poses_of_many_instants_equal_those_one_by_one(benches: int, instants: int, data: st.DataObject) -> None:
    numbers = 2 * (benches + 1) * instants
    places = st.lists(st.floats(-100.0, 100.0), min_size=numbers, max_size=numbers)
    handles = np.array(data.draw(places)).reshape(instants, benches + 1, 2)
    poses = bench_poses(handles)
    assert poses.shape == (instants, benches, 3)
    for k in range(instants):
        assert np.array_equal(poses[k], bench_poses(handles[k]))
        np.testing.assert_allclose(poses[k, :, :2], 0.5 * (handles[k, 1:] + handles[k, :-1]), atol=1e-14)
        reach = np.hypot(*(handles[k, :-1] - handles[k, 1:]).T)
        along = np.stack([np.cos(poses[k, :, 2]), np.sin(poses[k, :, 2])], axis=-1) * reach[:, None]
        np.testing.assert_allclose(along, handles[k, :-1] - handles[k, 1:], atol=1e-12)

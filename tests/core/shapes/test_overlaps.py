"""Four engines that find overlapping benches, and a broad phase that must miss none."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from core import Dance
from core.dragon import Dragon
from core.errors import SIZE_MAX, SIZE_MIN, InvalidValue, TooLarge
from core.motion.trajectory import trajectory
from core.paths.spiral import Spiral
from core.shapes.overlaps import POSITION_MAX, Engine, Verdict, cross_check, overlaps, separation, verdicts
from core.shapes.rectangles import bench_poses
from tests.support.depth import examples
from tests.support.scenes import LENGTH, WIDTH, Scene, all_pairs, benches, crowd

Floats = NDArray[np.float64]

# Within this of the margin the engines may differ, for each rounds its own corners [m].
UNDECIDED = 1e-9
# Distance from the margin at which most random pairs are put: there engines could err without being undecided [m].
NEAR = 1e-8
# First contact of the default dragon, computed in 256-bit ball arithmetic [s].
CONTACT_TIME = 412.473837682
EXACT = (Engine.SEPARATING_AXIS, Engine.FCL, Engine.SHAPELY)


def near_pairs(count: int, seed: int, margin: float) -> tuple[Scene, Floats]:
    """Pairs of rectangles 2 k, 2 k + 1, each pair in its own cell, two thirds of them within NEAR of the margin.

    returns: the scene and the separation of each pair (count,) [m]
    """
    random = np.random.default_rng(seed)
    pose = random.uniform(-1.0, 1.0, (2, count, 3)) * [3.0, 3.0, math.pi]
    square_on = random.random((2, count)) < 1 / 3
    pose[square_on, 2] = random.integers(0, 8, square_on.sum()) * math.pi / 4
    size = random.uniform(0.1, 3.0, (2, count, 2))
    near = random.random(count) < 2 / 3
    wanted = margin + NEAR * random.choice([0.0, 0.1, -0.1, 0.2, -0.2, 1.0, -1.0], count)
    result = separation(pose[0], size[0], pose[1], size[1])
    pose[1, near, :2] -= ((result.separation - wanted)[:, None] * result.normal)[near]
    cell = 20.0 * np.stack(np.divmod(np.arange(count), math.isqrt(count)), axis=-1)
    pose[..., :2] += cell
    gap = separation(pose[0], size[0], pose[1], size[1]).separation
    flat_size = size.transpose(1, 0, 2).reshape(-1, 2)
    return (pose.transpose(1, 0, 2).reshape(-1, 3), flat_size[:, 0], flat_size[:, 1]), gap


# -- scenes in a table ----------------------------------------------------------------------------------------

SCENES = {
    "nobody": ((), []),
    "one bench alone": (((0, 0, 0),), []),
    "apart": (((0, 0, 0), (0, 0.5, 0)), []),
    "touching counts": (((0, 0, 0), (LENGTH, 0, 0)), [(0, 1)]),
    "touching at a corner counts": (((0, 0, 0), (LENGTH, WIDTH, 0)), [(0, 1)]),
    "overlapping": (((0, 0, 0), (1, 0.1, 0.3)), [(0, 1)]),
    "the same place": (((0, 0, 0), (0, 0, 0)), [(0, 1)]),
    "boxes overlap, benches do not": (((0, 0, 0.8), (0.4, -0.4, 0.8)), []),
    "sorted, lower number first": (
        ((9, 0, 0), (0, 0, 0), (9, 0.1, 0), (0, 0.1, 0), (9, 0.2, 0)),
        [(0, 2), (0, 4), (1, 3), (2, 4)],
    ),
}


@pytest.mark.parametrize("engine", Engine)
@pytest.mark.parametrize(("poses", "pairs"), SCENES.values(), ids=SCENES.keys())
def test_every_engine_finds_the_pairs_of_the_table(poses: tuple, pairs: list, engine: Engine) -> None:
    result = overlaps(*benches(*poses), engine=engine, chained=False)
    np.testing.assert_array_equal(result.pairs, np.array(pairs).reshape(-1, 2))


@pytest.mark.parametrize("engine", Engine)
def test_neighbours_are_left_out_of_a_chain_only(engine: Engine) -> None:
    scene = benches((0, 0, 0), (0.5, 0.1, 0.1), (0.2, -0.1, -0.05))
    assert overlaps(*scene, engine=engine).pairs.tolist() == [[0, 2]]
    assert overlaps(*scene, engine=engine, chained=False).pairs.tolist() == [[0, 1], [0, 2], [1, 2]]


@pytest.mark.parametrize("engine", EXACT)
@pytest.mark.parametrize(
    ("gap", "within"), [(0.5, True), (0.5 - 1e-9, True), (0.5 + 1e-9, False)], ids=["at", "below", "above"]
)
def test_a_gap_counts_up_to_and_with_the_margin(engine: Engine, gap: float, within: bool) -> None:
    side_by_side = np.array([[0.0, 0.0, 0.0], [0.0, 1.0 + gap, 0.0]])
    assert overlaps(side_by_side, [2, 2], [1, 1], engine=engine, margin=0.5, chained=False).pairs.size == 2 * within


@pytest.mark.parametrize("engine", EXACT)
def test_margin_is_a_distance_also_around_corners(engine: Engine) -> None:
    corner_to_corner = np.array([[0.0, 0.0, 0.0], [2.0 + 0.3, 1.0 + 0.4, 0.0]])
    for margin, within in ((0.499999, False), (0.500001, True)):
        result = overlaps(corner_to_corner, [2, 2], [1, 1], engine=engine, margin=margin, chained=False)
        assert result.pairs.size == 2 * within


def test_contact_holds_the_exact_separation_of_each_pair() -> None:
    pose, length, width = crowd(60, seed=1, side=8.0)
    size = np.stack([length, width], axis=-1)
    for engine in Engine:
        result = overlaps(pose, length, width, engine=engine)
        a, b = result.pairs.T
        expected = separation(pose[a], size[a], pose[b], size[b])
        for name in ("separation", "witness_a", "witness_b", "normal"):
            np.testing.assert_array_equal(getattr(result.contact, name), getattr(expected, name))


# -- the engines against each other ---------------------------------------------------------------------------


@pytest.mark.parametrize(("count", "margin"), [(examples(10_000, 100_000), 0.0), (examples(4_000, 10_000), 0.05)])
def test_engines_agree_on_random_and_near_touching_pairs(count: int, margin: float) -> None:
    scene, gap = near_pairs(count, seed=2, margin=margin)
    assert np.mean(np.abs(gap - margin) <= NEAR + UNDECIDED) > 0.6
    for engine in EXACT:
        result = overlaps(*scene, engine=engine, margin=margin, chained=False).pairs
        np.testing.assert_array_equal(result[:, 1], result[:, 0] + 1)
        within = np.zeros(count, dtype=bool)
        within[result[:, 0] // 2] = True
        differs = within != (gap <= margin)
        assert np.abs(gap[differs] - margin).max(initial=0.0) <= UNDECIDED, engine
        assert engine is not Engine.SEPARATING_AXIS or not differs.any()


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32), st.integers(2, 40), st.sampled_from([0.0, 0.05, 1.0]))
def test_exact_engines_agree_on_crowds(seed: int, count: int, margin: float) -> None:
    scene = crowd(count, seed, side=8.0)
    expected = all_pairs(scene, margin)
    for engine in EXACT:
        np.testing.assert_array_equal(overlaps(*scene, engine=engine, margin=margin, chained=False).pairs, expected)


def test_cross_check_names_the_engine_that_differs_and_its_pairs() -> None:
    plus_and_corner = benches((0, 0, 0), (0, 0, math.pi / 2), (9, 0, 0), (10, 0.1, 0.3))
    check = cross_check(*plus_and_corner, chained=False)
    assert not check.agree
    for engine in EXACT:
        assert check.pairs[engine].tolist() == [[0, 1], [2, 3]]
        assert check.only[engine].tolist() == [[0, 1]]
        assert check.missing[engine].tolist() == []
    assert check.pairs[Engine.ANGLE_SUM].tolist() == [[2, 3]]
    assert check.only[Engine.ANGLE_SUM].tolist() == []
    assert check.missing[Engine.ANGLE_SUM].tolist() == [[0, 1]]
    assert check.left_out == ()


def test_cross_check_agrees_when_all_find_the_same() -> None:
    for scene in (benches(), benches((0, 0, 0), (5, 0, 0), (0.5, 0.1, 0.2))):
        check = cross_check(*scene)
        assert check.agree
        assert list(check.pairs) == list(Engine)
        assert all(pairs.shape == (0, 2) for pairs in (*check.only.values(), *check.missing.values()))


def test_cross_check_says_that_the_angle_sum_rule_knows_no_margin() -> None:
    check = cross_check(*benches((0, 0, 0), (0, 0.34, 0)), margin=0.05, chained=False)
    assert check.agree
    assert check.left_out == (Engine.ANGLE_SUM,)
    assert list(check.pairs) == list(EXACT)
    assert all(pairs.tolist() == [[0, 1]] for pairs in check.pairs.values())


def test_all_four_see_the_head_touch_bench_8_at_the_verified_time() -> None:
    dragon = Dragon()
    moment = [CONTACT_TIME - UNDECIDED, CONTACT_TIME + UNDECIDED]
    before, after = bench_poses(trajectory(Dance(dragon, Spiral()), moment).position)
    pair = [0, 8]
    seen = verdicts(before[pair], after[pair], dragon.lengths[pair], dragon.widths[pair])
    assert seen == dict.fromkeys(Engine, Verdict(before=False, after=True))
    assert cross_check(before, dragon.lengths, dragon.widths).agree
    assert overlaps(after, dragon.lengths, dragon.widths).pairs.tolist() == [pair]


def test_verdicts_of_a_margin_come_from_the_engines_that_know_one() -> None:
    before, after = (benches((0, 0, 0), (0, WIDTH + gap, 0))[0] for gap in (0.06, 0.04))
    seen = verdicts(before, after, [LENGTH] * 2, [WIDTH] * 2, margin=0.05)
    assert seen == dict.fromkeys(EXACT, Verdict(before=False, after=True))


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 2**32), st.sampled_from([0.0, 0.05, 1.0]))
def test_verdicts_on_one_pair_are_what_the_searches_find(seed: int, margin: float) -> None:
    (pose, length, width), (other, _, _) = crowd(2, seed, side=3.0), crowd(2, seed + 1, side=3.0)
    seen = verdicts(pose, other, length, width, margin=margin)
    entries = [cross_check(poses, length, width, margin=margin, chained=False) for poses in (pose, other)]
    assert list(seen) == list(entries[0].pairs)
    for engine, verdict in seen.items():
        assert (verdict.before, verdict.after) == tuple(check.pairs[engine].size > 0 for check in entries)


@pytest.mark.parametrize(("before", "after"), [(1, 2), (2, 1), (3, 3)])
def test_verdicts_are_of_two_benches(before: int, after: int) -> None:
    with pytest.raises(InvalidValue, match=r"benches must have shape \(2, 3\)|lengths must have") as refused:
        verdicts(np.zeros((before, 3)), np.zeros((after, 3)), [LENGTH] * before, [WIDTH] * before)
    assert refused.value.field == "benches"


# -- many benches ---------------------------------------------------------------------------------------------


@settings(deadline=None)
@given(st.integers(0, 2**32), st.integers(2, 60))
def test_numbering_the_benches_otherwise_renumbers_the_pairs(seed: int, count: int) -> None:
    pose, length, width = crowd(count, seed, side=10.0)
    order = np.random.default_rng(seed).permutation(count)
    renumbered = order[overlaps(pose[order], length[order], width[order], chained=False).pairs]
    expected = overlaps(pose, length, width, chained=False).pairs
    assert {frozenset(pair) for pair in renumbered.tolist()} == {frozenset(pair) for pair in expected.tolist()}


@pytest.mark.parametrize("engine", Engine)
def test_a_hundred_thousand_stacked_benches_are_refused(engine: Engine) -> None:
    count = 100_000
    with pytest.raises(TooLarge) as caught:
        overlaps(np.zeros((count, 3)), np.full(count, LENGTH), np.full(count, WIDTH), engine=engine)
    assert caught.value.field == "benches"
    assert str(count) in caught.value.message


# -- bad input ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("row", "name", "value", "text"),
    [
        (1, "x", math.nan, "benches[1].x must be a finite number, got nan m"),
        (0, "y", math.inf, "benches[0].y must be a finite number, got inf m"),
        (2, "x", 1e308, "benches[2].x must be from -1e+09 to 1e+09 m, got 1e+308 m"),
        (2, "heading", -math.inf, "benches[2].heading must be a finite number, got -inf rad"),
        (1, "length", 0.0, "benches[1].length must be positive, got 0 m"),
        (1, "width", -0.3, "benches[1].width must be positive, got -0.3 m"),
        (0, "width", math.nan, "benches[0].width must be a finite number, got nan m"),
        (0, "length", 1e5, "benches[0].length must be from 0.001 to 10000 m, got 100000 m"),
    ],
)
def test_a_bad_bench_is_refused_by_number_and_name(row: int, name: str, value: float, text: str) -> None:
    pose, length, width = benches((0, 0, 0), (3, 0, 0), (6, 0, 0))
    columns = {"x": pose[:, 0], "y": pose[:, 1], "heading": pose[:, 2], "length": length, "width": width}
    columns[name][row] = value
    for find in (overlaps, cross_check):
        with pytest.raises(InvalidValue) as caught:
            find(pose, length, width)
        assert caught.value.field == f"benches.{row}.{name}"
        assert caught.value.message == text


@pytest.mark.parametrize(
    ("poses", "lengths", "widths", "field"),
    [
        ([0, 0, 0], [1], [1], "benches"),
        ([[0, 0]], [1], [1], "benches"),
        ([], [], [], "benches"),
        ([["here", 0, 0]], [1], [1], "benches"),
        ([[0, 0, 0]], [1, 1], [1], "lengths"),
        ([[0, 0, 0]], [1], [[1]], "widths"),
        ([[0, 0, 0]], ["long"], [1], "lengths"),
    ],
)
def test_wrong_shapes_are_refused(poses: object, lengths: object, widths: object, field: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        overlaps(poses, lengths, widths)
    assert caught.value.field == field


@pytest.mark.parametrize("margin", [-1e-3, math.nan, math.inf, 1e308])
def test_a_bad_margin_is_refused(margin: float) -> None:
    with pytest.raises(InvalidValue) as caught:
        overlaps(*benches((0, 0, 0)), margin=margin)
    assert caught.value.field == "margin"


BENCH = (2.2, 0.3)
GOOD = ((0.0, 0.0, 0.0), BENCH)


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    ("pose", "size", "field", "text"),
    [
        ((math.nan, 0, 0), BENCH, "poses_a.0.x", "finite number, got nan m"),
        ((0, math.inf, 0), BENCH, "poses_a.0.y", "finite number, got inf m"),
        ((0, 0, -math.inf), BENCH, "poses_a.0.heading", "finite number, got -inf rad"),
        ((1e308, 0, 0), BENCH, "poses_a.0.x", "from -1e+09 to 1e+09 m, got 1e+308 m"),
        ((0, np.nextafter(-POSITION_MAX, -math.inf), 0), BENCH, "poses_a.0.y", "from -1e+09 to 1e+09 m"),
        ((0, 0, 0), (2.2, -0.3), "sizes_a.0.width", "positive, got -0.3 m"),
        ((0, 0, 0), (0.0, 0.3), "sizes_a.0.length", "positive, got 0 m"),
        ((0, 0, 0), (np.nextafter(SIZE_MIN, 0), 0.3), "sizes_a.0.length", "from 0.001 to 10000 m"),
        ((0, 0, 0), (np.nextafter(SIZE_MAX, math.inf), 0.3), "sizes_a.0.length", "from 0.001 to 10000 m"),
        ((0, 0), BENCH, "poses_a", "shape (..., 3): x, y, heading, got (2,)"),
        (0.0, BENCH, "poses_a", "shape (..., 3)"),
        ((0, 0, 0), (2.2, 0.3, 1.0), "sizes_a", "shape (..., 2): length, width, got (3,)"),
        (("left", 0, 0), BENCH, "poses_a", "must be numbers"),
        (((0, 0, 0), (0, 0)), BENCH, "poses_a", "must be numbers"),
        (np.zeros((2, 3)), np.ones((3, 2)), "sizes_a", "must broadcast"),
    ],
)  # fmt: skip
def test_bad_rectangles_are_refused_by_name(pose: object, size: object, field: str, text: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        separation(pose, size, *GOOD)
    assert caught.value.field == field
    assert text in caught.value.message


@pytest.mark.uncompiled
def test_pairs_that_do_not_broadcast_are_refused() -> None:
    with pytest.raises(InvalidValue) as caught:
        separation(np.zeros((2, 3)), BENCH, np.zeros((3, 3)), BENCH)
    assert caught.value.field == "poses_b"


@pytest.mark.uncompiled
@pytest.mark.parametrize("size", [SIZE_MIN, SIZE_MAX])
def test_sizes_and_positions_at_their_limits_are_accepted(size: float) -> None:
    result = separation([-POSITION_MAX, 0, 0], [size, size], [POSITION_MAX, 0, 0], [size, size])
    assert result.separation == pytest.approx(2 * POSITION_MAX - size, rel=1e-15)

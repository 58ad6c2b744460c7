"""Four engines that find overlapping benches, and a broad phase that must miss none."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.checks import SIZE_MAX, SIZE_MIN
from core.shapes.overlaps import POSITION_MAX, Engine, Verdict, cross_check, overlaps, separation, verdicts
from tests.support.depth import examples
from tests.support.refused import refused
from tests.support.scenes import LENGTH, WIDTH, benches, crowd, near_pairs

# Within this of the margin the engines may differ, for each rounds its own corners [m].
UNDECIDED = 1e-9
# Distance from the margin at which most random pairs are put: there engines could err without being undecided [m].
NEAR = 1e-8
EXACT = (Engine.SEPARATING_AXIS, Engine.FCL, Engine.SHAPELY)

by_every_engine = pytest.mark.parametrize("engine", Engine)
by_exact_engines = pytest.mark.parametrize("engine", EXACT)


# -- scenes in a table ----------------------------------------------------------------------------------------

SCENES = {
    "nobody": ((), []),
    "touching counts": (((0, 0, 0), (LENGTH, 0, 0)), [(0, 1)]),
    "touching at a corner counts": (((0, 0, 0), (LENGTH, WIDTH, 0)), [(0, 1)]),
    "the same place": (((0, 0, 0), (0, 0, 0)), [(0, 1)]),
    "sorted, lower number first": (
        ((9, 0, 0), (0, 0, 0), (9, 0.1, 0), (0, 0.1, 0), (9, 0.2, 0)),
        [(0, 2), (0, 4), (1, 3), (2, 4)],
    ),
}


@by_every_engine
@pytest.mark.parametrize("poses, pairs", SCENES.values(), ids=SCENES)
def test_every_engine_finds_the_pairs_of_the_table(poses, pairs, engine):
    result = overlaps(*benches(*poses), engine=engine, chained=False)
    np.testing.assert_array_equal(result.pairs, np.array(pairs).reshape(-1, 2))


@by_every_engine
def test_neighbours_are_left_out_of_a_chain_only(engine):
    scene = benches((0, 0, 0), (0.5, 0.1, 0.1), (0.2, -0.1, -0.05))
    assert overlaps(*scene, engine=engine).pairs.tolist() == [[0, 2]]
    assert overlaps(*scene, engine=engine, chained=False).pairs.tolist() == [[0, 1], [0, 2], [1, 2]]


@by_exact_engines
@pytest.mark.parametrize(
    "x, y, within",
    [
        *((0.0, 1.5, True), (0.0, 1.5 - 1e-9, True), (0.0, 1.5 + 1e-9, False)),
        *((2.3 - 1e-6, 1.4, True), (2.3 + 1e-6, 1.4, False)),
    ],
    ids=["at", "below", "above", "below around a corner", "above around a corner"],
)
def test_a_gap_counts_up_to_and_with_the_margin(engine, x, y, within):
    two = np.array([[0.0, 0.0, 0.0], [x, y, 0.0]])
    assert overlaps(two, [2, 2], [1, 1], engine=engine, margin=0.5, chained=False).pairs.size == 2 * within


@by_every_engine
def test_contact_holds_the_exact_separation_of_each_pair(engine):
    pose, length, width = crowd(60, seed=1, side=8.0)
    size = np.stack([length, width], axis=-1)
    result = overlaps(pose, length, width, engine=engine)
    a, b = result.pairs.T
    expected = separation(pose[a], size[a], pose[b], size[b])
    for name in ("separation", "witness_a", "witness_b", "normal"):
        np.testing.assert_array_equal(getattr(result.contact, name), getattr(expected, name))


# -- the engines against each other ---------------------------------------------------------------------------


@pytest.mark.parametrize("count, margin", [(examples(4_000, 100_000), 0.0), (examples(2_000, 10_000), 0.05)])
def test_engines_agree_on_random_and_near_touching_pairs(count, margin):
    scene, gap = near_pairs(count, 2, margin, NEAR)
    assert np.mean(np.abs(gap - margin) <= NEAR + UNDECIDED) > 0.6
    for engine in EXACT:
        result = overlaps(*scene, engine=engine, margin=margin, chained=False).pairs
        np.testing.assert_array_equal(result[:, 1], result[:, 0] + 1)
        within = np.isin(2 * np.arange(count), result[:, 0])
        differs = within != (gap <= margin)
        assert np.abs(gap[differs] - margin).max(initial=0.0) <= UNDECIDED, engine
        assert engine is not Engine.SEPARATING_AXIS or not differs.any()


def test_cross_check_names_the_engine_that_differs_and_its_pairs():
    plus_and_corner = benches((0, 0, 0), (0, 0, math.pi / 2), (9, 0, 0), (10, 0.1, 0.3))
    check = cross_check(*plus_and_corner, chained=False)
    assert (check.agree, check.left_out) == (False, ())
    plus = [[0, 1]]
    corner = [[2, 3]]
    for engine in Engine:
        answer = [pairs[engine].tolist() for pairs in (check.pairs, check.only, check.missing)]
        assert answer == ([plus + corner, plus, []] if engine in EXACT else [corner, [], plus])


def test_the_angle_sum_rule_knows_no_margin_and_is_left_out():
    check = cross_check(*benches((0, 0, 0), (0, WIDTH + 0.04, 0)), margin=0.05, chained=False)
    assert (check.agree, check.left_out) == (True, (Engine.ANGLE_SUM,))
    assert {engine: pairs.tolist() for engine, pairs in check.pairs.items()} == {key: [[0, 1]] for key in EXACT}


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.sampled_from([0.0, 0.05, 1.0]))
def test_verdicts_on_one_pair_are_what_the_searches_find(seed, margin):
    (pose, length, width), (other, _, _) = crowd(2, seed, side=3.0), crowd(2, seed + 1, side=3.0)
    seen = verdicts(pose, other, length, width, margin=margin)
    before, after = (cross_check(poses, length, width, margin=margin, chained=False).pairs for poses in (pose, other))
    assert seen == {engine: Verdict(before[engine].size > 0, after[engine].size > 0) for engine in before}


# -- bad input ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row, column, value",
    [(1, "x", math.nan), (2, "heading", -math.inf), (0, "width", 1e5)],
)
def test_a_bad_bench_is_refused_by_number_and_name(row, column, value):
    scene = np.array([[0.0, 0.0, 0.0, LENGTH, WIDTH]] * 3)
    scene[row, ("x", "y", "heading", "length", "width").index(column)] = value
    with refused(f"benches.{row}.{column}"):
        overlaps(scene[:, :3], *scene[:, 3:].T)


@pytest.mark.parametrize("field, poses, lengths", [("benches", [0, 0, 0], [1]), ("lengths", [[0, 0, 0]], [1, 1])])
def test_wrong_shapes_are_refused(field, poses, lengths):
    with refused(field):
        overlaps(poses, lengths, [1])


@pytest.mark.parametrize("count", [1, 3])
def test_verdicts_are_of_two_benches(count):
    with refused("benches"):
        verdicts(np.zeros((2, 3)), np.zeros((count, 3)), [LENGTH] * 2, [WIDTH] * 2)


POSE = (0.0, 0.0, 0.0)
BENCH = (2.2, 0.3)
LAST, LEAST, MOST = np.nextafter([-POSITION_MAX, SIZE_MIN, SIZE_MAX], [-math.inf, 0.0, math.inf])


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    "field, pose, size",
    [
        *(("poses_a.0.x", (math.nan, 0, 0), BENCH), ("poses_a.0.y", (0, LAST, 0), BENCH)),
        *(("sizes_a.0.length", POSE, (length, 0.3)) for length in (LEAST, MOST)),
        *(("sizes_a.0.width", POSE, (2.2, -0.3)), ("sizes_a", np.zeros((2, 3)), np.ones((3, 2)))),
    ],
)
def test_bad_rectangles_are_refused_by_name(field, pose, size):
    with refused(field):
        separation(pose, size, POSE, BENCH)


@pytest.mark.uncompiled
@pytest.mark.parametrize("size", [SIZE_MIN, SIZE_MAX])
def test_sizes_and_positions_at_their_limits_are_accepted(size):
    result = separation([-POSITION_MAX, 0, 0], [size, size], [POSITION_MAX, 0, 0], [size, size])
    assert result.separation == pytest.approx(2 * POSITION_MAX - size, rel=1e-15)

"""Chains in ball arithmetic on a spiral: their enclosures, and the limits of their proofs."""

from itertools import pairwise, product

import numpy as np
import pytest
from flint import arb, ctx

from core import Dragon, Spiral
from core.proof.chain import Chain, Pose, SpiralStretch, delta, newton
from core.proof.pairs import Unproven
from tests.support.proof_shapes import polygon
from tests.support.shared_dances import FIVE_LENGTHS
from tests.support.slow_search import chord_squared

# A delta from doubles, where F is steep, is this near to the true one [rad].
DOUBLES = 1e-9
# With chords up to 5.78357469 growths no bench folds (CREST_DELTA of core/kernels/fold.py); so near to that the balls
# still decide [1].
JUST_FOLLOWS = 5.7835739
# The default dragon, where handle 1 turns back near the fold (combo_b), and bench by bench.
PLACES = {
    "far outside": (Dragon(), Spiral(), 0, 90.0, 90.8),
    "before the contact": (Dragon(), Spiral(), 0, 26.2, 26.5),
    "handle 1 turns back": (Dragon(400, 3.61, 2.4, 0.12, 0.1), Spiral(0.48, 25.0), 0, 20.732, 20.7326),
    "bench by bench": (FIVE_LENGTHS, Spiral(), 1, 30.0, 30.6),
}


@pytest.mark.parametrize("name", PLACES)
def test_a_stretch_encloses_every_pose_in_it_and_every_velocity(name):
    dragon, path, bench, low, high = PLACES[name]
    chain = Chain(dragon, arb(path.pitch), path.start_turns)
    with ctx.workprec(128):
        stretch = SpiralStretch(chain, bench, low, high, dragon.benches)
        poses = [Pose(chain, bench, arb(theta)) for theta in np.linspace(low, high, 9)]
        for pose in poses:
            pose.grow_to(4)
        for _ in range(3):
            stretch.grow()
        assert stretch.rising == (name != "handle 1 turns back")
        for before, after in pairwise(poses):
            step = after.thetas[0] - before.thetas[0]
            for k, (centre, along, centre_move, along_move) in enumerate(stretch.placed):
                assert stretch.thetas[k + 1].contains(before.thetas[k + 1])
                assert centre.contains(before.centres[k])
                assert along.contains(before.along[k])
                # A difference quotient is a velocity somewhere between.
                assert centre_move.overlaps((after.centres[k] - before.centres[k]) / step)
                assert along_move.overlaps((after.along[k] - before.along[k]) / step)
                assert stretch.rates[k + 1].overlaps((after.thetas[k + 1] - before.thetas[k + 1]) / step)
            assert stretch.rear[0] <= float(before.thetas[1]) <= stretch.rear[1]


@pytest.mark.parametrize("stray", [0.0, 0.05, 0.3])
def test_a_bench_called_far_is_clear_of_the_ring_inside_it_whatever_both_stray(stray):
    chain = Chain(Dragon(), arb(0.55), 16.0, stray=stray)
    for theta in (27.0, 60.0, 100.0):
        pose = Pose(chain, 0, arb(theta))
        pose.grow_to(120)
        shapes = [polygon(*row) for row in zip(pose.centres, pose.along, chain.sizes, strict=False)]
        far = [k for k in range(2, 120) if chain.far(0, pose.thetas[1], pose.thetas[k])]
        assert 0 < len(far) < 110
        assert min(shapes[0].distance(shapes[k]) for k in far) > 2.0 * stray


@pytest.mark.parametrize(
    "theta, chord",
    [
        *product((14.76, 15.0, 16.0, 30.0, 100.0), (1.14, 18.8, 32.67)),
        *product((0.01, 0.3, 0.8, 1.0, 2.0), (1.65, 4.0)),
        *product((0.01, 0.3, 0.8, 2.0), [6.0]),
        *product(np.linspace(0.97, 1.0, 9).tolist(), [JUST_FOLLOWS]),
    ],
)
def test_a_bend_is_the_first_root(theta, chord):
    """In units of growth; also beyond pi near the centre, and where a fold has just vanished."""
    needed = arb(chord) ** 2
    result = float(delta(arb(theta), needed))
    before = np.linspace(0.0, result - DOUBLES, 100_000)
    assert np.all(chord_squared(theta, before) < float(needed))


def test_there_is_no_bend_past_the_fold_and_one_beyond_pi_just_before():
    needed = (arb("2.86") / (arb("0.55") / (2 * arb.pi()))) ** 2
    assert delta(arb("14.735"), needed) > arb.pi()
    for theta, square, reason in ((arb("14.73"), needed, None), (arb(1.0), arb(36.0), "nearest")):
        with pytest.raises(Unproven, match=reason):
            delta(theta, square)


def test_a_newton_step_that_leaves_its_ball_or_finds_no_slope_proves_nothing():
    with ctx.workprec(96):
        near = arb(2.0, 1e-8)
        step = newton(arb(2.0), near, arb(1e-9), arb(4.0, 1e-7))
        assert abs(step - (2 - arb(1e-9) / 4)) < 1e-16
        for value, slope in ((arb(1e-7), arb(4.0, 1e-7)), (arb(1e-9), arb(0.0, 1e-7))):
            with pytest.raises(Unproven):
                newton(arb(2.0), near, value, slope)

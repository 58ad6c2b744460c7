"""Claims: those that do not hold are refused, and a pair that is near is found where shapely finds it."""

import math
from contextlib import nullcontext

import numpy as np
import pytest
import shapely
from flint import arb, ctx

from core import Dance, Dragon, Spiral, bench_poses, trajectory
from core.errors import ProofRefused
from core.proof import prove_collision_time, prove_minimum_pitch, verify
from core.proof.chain import Chain
from core.proof.claims import head_theta, near_pair, verify_near
from core.proof.pairs import Unproven
from core.shapes.rectangles import corners
from tests.support.depth import thorough
from tests.support.forgeries import assert_refused
from tests.support.reference_contacts import GRAZING, SMALL, graze, proof_of
from tests.support.refused import refused

# Distances by shapely [m], and places by bisection in doubles [rad], are this near to the true ones.
SHAPELY, PLACE = 1e-11, 1e-9


@pytest.mark.parametrize("later", [-1.0, -2.1e-10, 2.1e-10, 1e-6, 1.0])
def test_a_bracket_moved_off_the_contact_is_refused(later):
    with pytest.raises(ProofRefused, match="no two benches overlap" if later < 0 else "benches 0 and 4 overlap"):
        proof_of(SMALL, later=later)


# At pitch 0.55 the benches part again from 415.02 to 415.375 s: a contact after that is not the first.
@pytest.mark.parametrize(
    ("benches", "time", "reason"),
    [
        (1, 100.0, "no two benches overlap"),
        (2, 100.0, "no two benches overlap"),
        (223, 433.0, "folds"),
        *thorough((20, 415.5, "benches 0 and 8 overlap")),
    ],
)
def test_a_time_that_is_not_the_first_at_which_two_touch_is_refused(benches, time, reason):
    with pytest.raises(ProofRefused, match=reason):
        prove_collision_time(Dance(Dragon(benches), Spiral()), time)


@pytest.mark.parametrize("time", [-1.0, math.nan, math.inf, 1e9, "412"])
def test_a_time_that_is_no_time_of_the_dance_is_an_invalid_value(time):
    with refused("time"):
        prove_collision_time(Dance(Dragon(), Spiral()), time)


@pytest.mark.parametrize(
    ("margin", "below", "above"),
    [
        (0.0, "overlap when handle 0", "free of contact too"),
        *thorough((0.1, "nearer than the margin", "keeps the margin")),
    ],
)
def test_a_minimum_pitch_is_proven_and_one_off_it_refused(margin, below, above):
    certificate = graze(margin)
    assert "says nothing of larger pitches" in verify(certificate).statement
    for more, reason in ((-1e-8, below), (1.1e-6, above)):
        with pytest.raises(ProofRefused, match=reason):
            prove_minimum_pitch(Dragon(14), certificate["claim"]["pitch"] + more, **GRAZING, margin=margin)


@pytest.mark.parametrize(
    ("edit", "reason"),
    [
        ('overlap = {"benches": [0, 12], "head_theta": 40.0}', "not shown to overlap on the way"),  # within the circle
        ('overlap = {"benches": [0, 12], "head_theta": 43.0}', "not shown to overlap"),
        ('overlap = {"benches": [0, 12], "head_theta": 44.5}', "not shown to overlap on the way"),  # before the start
        ('overlap = {"start_within_circle": true}', "not shown to lie within the circle"),
    ],
)
def test_a_forged_overlap_on_the_way_to_the_circle_is_refused(edit, reason):
    assert_refused(graze(), edit, reason)


# -- pairs that are near --


@pytest.mark.parametrize("seed", range(8))
def test_a_near_pair_is_found_where_shapely_finds_one_and_only_it_is_shown(seed):
    random = np.random.default_rng(seed)
    dragon, spiral = Dragon(14, 2.4, 1.8, random.uniform(0.2, 0.5), 0.2), Spiral(0.5, 6.0)
    margin = float(random.choice([0.0, random.uniform(0.01, 0.1)]))
    time = float(random.uniform(0.2, 0.85) * spiral.length)
    poses = bench_poses(trajectory(Dance(dragon, spiral), time).position)
    shapes = shapely.polygons(corners(poses, np.stack([dragon.lengths, dragon.widths], axis=-1)))
    pairs = [(a, b) for a in range(14) for b in range(a + 2, 14)]
    near = [pair for pair in pairs if shapely.distance(*shapes[list(pair)]) < max(margin, SHAPELY)]
    with ctx.workprec(128):
        chain = Chain(dragon, arb(spiral.pitch), spiral.start_turns, margin)
        head = chain.place_after(arb(time))
        if near:
            assert tuple(near_pair(chain, head, time)) in near
        else:
            with pytest.raises(ProofRefused, match=r"no two benches .* at .* \+ 1e-10 s"):
                near_pair(chain, head, time)
        for pair in pairs:
            with nullcontext() if pair in near else pytest.raises(Unproven, match="are not shown to"):
                verify_near(chain, head, *pair, "then")


@pytest.mark.parametrize("handle", [0, 1, 5])
def test_the_head_is_found_from_where_a_handle_stands(handle):
    with ctx.workprec(128):
        chain = Chain(Dragon(14), arb(0.55), 16.0)
        pose = chain.pose_at(0, arb(40.0))
        pose.grow_to(handle + 1)
        there = float(pose.places[handle])
        assert head_theta(chain, handle, there, 20.0, 90.0) == pytest.approx(40.0, abs=PLACE)

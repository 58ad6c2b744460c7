"""Proofs that no turn of a box can be danced: how far its turns differ, and what holds for a smaller box in it."""

import math

import numpy as np

from core import Dragon, InvalidValue, Turn
from core.design.turn_boxes import turns_in
from core.design.turn_refusal import TurnRefusal
from core.kernels.constants import PROOF_COLUMNS, PROOF_KIND

GROWTH = 1.7 / (2.0 * math.pi)
# Entry and exit radii [m] of turns of ratio 2 of which none can be followed, each refused by another kind of proof: a
# bench that is stuck, one that would jump, a path that meets itself.
NONE = {1: (2.431, 1.578), 2: (4.293, 2.249), 3: (4.4, 2.106)}


def kinds(refusal, centres, halves, proofs):
    refusal.refused(turns_in(GROWTH, centres, halves), centres, halves, proofs, math.inf)
    return proofs[:, PROOF_KIND]


def test_a_proof_that_is_remembered_holds_for_smaller_boxes_without_another_search():
    random = np.random.default_rng(2)
    for kind, (entry, leaving) in NONE.items():
        refusal, halves = TurnRefusal(Dragon(), GROWTH), np.full((3, 1), 1e-3 if kind < 3 else 1e-4)
        centre, proof = np.array([[entry], [(leaving - entry) / GROWTH], [math.log(2.0)]]), np.zeros((1, PROOF_COLUMNS))
        assert kinds(refusal, centre, halves, proof) == kind
        searched = refusal.box.work
        inside = centre + 0.7 * halves * random.uniform(-1.0, 1.0, (3, 50))
        assert (kinds(refusal, inside, np.tile(0.3 * halves, 50), np.tile(proof, (50, 1))) == kind).all()
        assert refusal.box.work < 25 * searched


def seen_from_joint(place, s):
    """Points (N, 2) [m] and directions (N,) [rad] of a turn at places from where its arcs meet, as seen from there."""
    entry, turned, logarithm = place[:, 0].tolist()
    path = Turn(
        1.7, 30.0, math.exp(logarithm), start_turns=40.0, entry_radius=entry, exit_radius=entry + GROWTH * turned
    )
    joint = path.radii[0] * path.angles[0]
    x, y = path.tangent(joint)
    ways, tangents = path.position(joint + s) - path.position(joint), path.tangent(joint + s)
    own = np.array([[x, -y], [y, x]])
    return ways @ own, np.arctan2(*(tangents @ own).T[::-1])


def test_no_turn_of_a_box_differs_by_more_from_its_middle_than_is_said():
    random, refusal = np.random.default_rng(5), TurnRefusal(Dragon(), GROWTH)
    tightest = 0.0
    for _ in range(400):
        centre = random.uniform((1.5, -14.0, -1.2), (4.5, 14.0, 1.2))[:, None]
        halves = random.choice([1e-3, 1e-2, 0.03]) * random.uniform(0.1, 1.0, (3, 1))
        rows, held, usable, _ = refusal.family(turns_in(GROWTH, centre, halves), centre, halves, (0, 0))
        if not (held & usable)[0] or not 1.2 < centre[0, 0] + GROWTH * centre[1, 0] < 9.0:
            continue
        refusal.box.take(rows, 0)
        first, last = np.sort(random.uniform(-12.0, 12.0, 2))
        s = np.linspace(first, last, 60)
        try:
            middle, other = (
                seen_from_joint(centre + halves * by, s) for by in (0.0, random.choice([-1.0, 1.0], (3, 1)))
            )
        except InvalidValue:
            continue
        moved = np.hypot(*(other[0] - middle[0]).T).max()
        turned = np.abs(np.angle(np.exp(1j * (other[1] - middle[1])))).max()
        assert moved <= refusal.box.moved_over(first, last) + 1e-9
        assert turned <= refusal.box.turned_over(first, last) + 1e-9
        tightest = max(tightest, moved / refusal.box.moved_over(first, last))
    assert tightest > 0.3

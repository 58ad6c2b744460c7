"""Proofs that no turn of a box can be danced: what holds for a box holds for each smaller one in it."""

import math

import numpy as np

from core import Dragon
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

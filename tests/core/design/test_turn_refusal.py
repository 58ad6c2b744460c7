"""No box of turns is refused that holds one which can be danced; most small ones of the others are."""

import math

import numpy as np
import pytest

from core import Dance, Dragon, InvalidValue, Turn, first_contact
from core.checks import SIZE_MIN
from core.design.turn_boxes import sizes_of, turns_in
from core.design.turn_refusal import TurnRefusal
from core.kernels.constants import PROOF_COLUMNS
from core.paths.following import follows
from tests.support.depth import thorough

DRAGONS = (Dragon(), 1.7, 4.5), *thorough((Dragon(25, 2.04, 2.63), 1.05, 6.0), (Dragon(15, 2.16, 1.74), 1.5, 7.9))
# Half widths of boxes [m], [rad], [1].
SIZES = np.geomspace(1e-4, 0.2, 8)


def tight_turns(dragon, pitch, radius, count):
    """(a, v, log ratio) and the turns at random places with an arc that is tighter than half a chord."""
    random = np.random.default_rng(7)
    growth, tight = pitch / (2.0 * math.pi), 0.5 * dragon.chords.max() / 0.999
    while count:
        entry, turned, logarithm = random.uniform((0.25 * radius, -18.0, -1.5), (radius, 18.0, 1.5))
        leaving = entry + growth * turned
        if not SIZE_MIN < leaving < radius:
            continue
        radii, angles = np.split(sizes_of(growth, *np.array([[entry], [turned], [logarithm]]))[:4, 0], 2)
        if not (0.5 * tight < radii.min() < tight and angles.min() > 0.01 and angles.max() < 5.5):
            continue
        try:
            turn = Turn(pitch, radius, math.exp(logarithm), entry_radius=entry, exit_radius=leaving)
        except InvalidValue:
            continue
        count -= 1
        yield np.array([[entry], [turned], [logarithm]]), turn


@pytest.mark.parametrize("dragon, pitch, radius", DRAGONS)
def test_no_box_is_refused_that_holds_a_turn_which_can_be_danced(dragon, pitch, radius):
    """A refused box may hold a turn that is followed only if the path meets itself: then benches touch."""
    growth = pitch / (2.0 * math.pi)
    refusal, random = TurnRefusal(dragon, growth), np.random.default_rng(3)
    followed = refused_ones = 0
    for place, turn in tight_turns(dragon, pitch, radius, 600):
        is_followed = follows(dragon, turn)
        followed += is_followed
        for size in SIZES if is_followed else SIZES[:1]:
            halves = size * random.uniform(0.2, 1.0, (3, 1))
            centre, proofs = place + halves * random.uniform(-1.0, 1.0, (3, 1)), np.zeros((1, PROOF_COLUMNS))
            refused_ones += (hairpin := refusal.hairpins(centre, halves)[0]) or (
                is_refused := refusal.refused(turns_in(growth, centre, halves), centre, halves, proofs, math.inf)[0]
            )
            if is_followed and (hairpin or is_refused):
                assert not hairpin
                assert first_contact(Dance(dragon, turn), stop=400.0).time is not None
                break
    assert followed > 10
    assert refused_ones > 0.8 * (600 - followed)

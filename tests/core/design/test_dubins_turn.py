"""The turn with a straight piece: its pieces meet smoothly, it is danced, and it is not shorter than two arcs."""

import numpy as np
import pytest

from core import Dance, Dragon, Outcome, dubins_turn, first_contact, shortest_turn
from tests.support.depth import further
from tests.support.near import assert_near

PITCH = 1.7
# How much longer than its limit, without a straight piece, a scan ends [m].
SCANNED = 2e-6


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    "pitch, radius, ratio, length, turned",
    [(PITCH, 4.5, 0.7, 8.354, 1), (PITCH, 4.5, 1.3, 7.491, -1), (0.6, 4.5, 1.3, 6.812, 1), (3.0, 7.0, 1.0, 6.506, -1)],
)
def test_the_pieces_have_the_length_and_are_as_tight_as_benches_can_follow(pitch, radius, ratio, length, turned):
    """A route refuses pieces that do not meet. Two benches never touch, so that only the bends limit the turn."""
    result = dubins_turn(Dragon(2), pitch, radius, ratio)
    start, left, right, end = result.path.joints
    assert_near((start, end, right - left), (0.0, result.length, result.straight), 1e-9)
    assert min(result.radii) == pytest.approx(1.43 / 0.999, rel=1e-9)
    assert result.radii[0] / result.radii[1] == pytest.approx(ratio)
    # as found on 2026-11-28, when the pieces were laid out at random entries and exits too
    assert_near(result.length, length, 1e-3)
    assert np.sign(result.path.pieces[1].sweep) == turned


@pytest.mark.parametrize("ratio", further([0.5, 2.0, 1.0], 1))
def test_a_straight_piece_makes_no_turn_of_the_contest_shorter(ratio):
    """The shortest one found has nearly none: it is the turn of two arcs as tight as benches can follow."""
    result = dubins_turn(Dragon(), PITCH, ratio=ratio)
    two_arcs = shortest_turn(Dragon(), PITCH, ratio=ratio)
    assert two_arcs.length_bracket[0] <= result.length <= two_arcs.turn.length + (SCANNED if ratio >= 1.0 else 4.0)
    assert first_contact(Dance(Dragon(), result.path), start=-100.0, stop=500.0).outcome is Outcome.CLEAR
    within = result.path.position(np.linspace(0.0, result.length, 2_000))
    assert np.linalg.norm(within, axis=-1).max() <= 4.5 + 1e-8

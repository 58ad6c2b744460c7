"""The turn with a straight piece: its pieces meet smoothly, it is danced, and it is not shorter than two arcs."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Arc, Coil, Dance, Dragon, InvalidValue, Line, Outcome, Route, dubins_turn, first_contact, shortest_turn
from core.design.dubins_turn import arcs_and_line

PITCH = 1.7
GROWTH = PITCH / (2.0 * math.pi)
# How much longer than its limit, without a straight piece, a scan ends [m].
SCANNED = 2e-6


@pytest.mark.uncompiled
@pytest.mark.parametrize("sigma", [-1.0, 1.0])
def test_the_pieces_meet_and_have_the_length(sigma: float) -> None:
    """A route refuses pieces that do not meet, and its length is measured along it."""
    rng, laid_out = np.random.default_rng(6), 0
    for _ in range(60):
        ends, radii = rng.uniform(2.0, 4.5, 2), tuple(rng.uniform(0.5, 1.6, 2).tolist())
        length, straight, first, second, c1, c2, h = (x[0] for x in arcs_and_line(GROWTH, ends[:, None], radii, sigma))
        if not math.isfinite(length):
            assert abs(c2 - c1) < sum(radii)
            continue
        laid_out += 1
        left, right = c1 - 1j * sigma * radii[0] * h, c2 + 1j * sigma * radii[1] * h
        coils = Coil(PITCH, 9.0, ends[0] / PITCH), Coil(PITCH, ends[1] / PITCH, 9.0, rotation=math.pi)
        begin = Route(coils[:1])
        x, y = begin.position(begin.end)
        arcs = (
            Arc((c1.real, c1.imag), radii[0], float(np.angle(x + 1j * y - c1)), sigma * first),
            Arc((c2.real, c2.imag), radii[1], float(np.angle(right - c2)), -sigma * second),
        )
        line = Line((left.real, left.imag), (right.real, right.imag))
        path = Route([coils[0], arcs[0], line, arcs[1], coils[1]])
        assert path.joints[3] - path.joints[0] == pytest.approx(length, abs=1e-9)
        assert path.joints[2] - path.joints[1] == pytest.approx(straight, abs=1e-9)
    assert laid_out > 20


@pytest.mark.parametrize("ratio", [1.0, 2.0, 0.5])
def test_a_straight_piece_makes_no_turn_of_the_contest_shorter(ratio: float) -> None:
    """The shortest one found has nearly none: it is the turn of two arcs as tight as benches can follow."""
    result, two_arcs = dubins_turn(Dragon(), PITCH, ratio=ratio), shortest_turn(Dragon(), PITCH, ratio=ratio)
    assert two_arcs.length_bracket[0] <= result.length <= two_arcs.turn.length + (SCANNED if ratio >= 1.0 else 4.0)
    assert first_contact(Dance(Dragon(), result.path), start=-100.0, stop=500.0).outcome is Outcome.CLEAR
    joints = result.path.joints
    assert joints[0] == pytest.approx(0.0, abs=1e-9)
    assert joints[3] == pytest.approx(result.length, abs=1e-9)
    within = result.path.position(np.linspace(joints[0], joints[3], 2_000))
    assert np.linalg.norm(within, axis=-1).max() <= 4.5 + 1e-8


def test_in_a_wide_circle_the_arcs_are_tight_and_the_line_is_long() -> None:
    """Two benches never touch, so that only the bends limit the turn."""
    result = dubins_turn(Dragon(2), PITCH, 4.5, 1.3)
    assert min(result.radii) == pytest.approx(1.43 / 0.999, rel=1e-9)
    assert result.radii[0] / result.radii[1] == pytest.approx(1.3)
    assert result.evaluations >= 1


def test_a_circle_in_which_nothing_can_be_danced_is_refused() -> None:
    with pytest.raises(InvalidValue, match=r"^turning_radius must be larger"):
        dubins_turn(Dragon(), PITCH, 2.0)

"""Turns with clothoids: continuous curvature, the coils they join, the turn of two arcs as their limit, refusals."""

import numpy as np
import pytest

from core import ClothoidTurn, Dance, Dragon, Outcome, Turn, first_contact
from tests.support.near import assert_near
from tests.support.refused import refused

# A joint as it is accepted [m].
JOINT = 1e-9
SMOOTH = ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5)


def test_the_curvature_is_continuous_from_coil_to_coil():
    s = np.linspace(-2.0, SMOOTH.length + 2.0, 40_001)
    bends = SMOOTH.curvature(s)
    sharpest = 1.0 / min(SMOOTH.radii)
    assert np.abs(np.diff(bends)).max() < 2.0 * sharpest / 0.5 * (s[1] - s[0])
    assert_near(np.abs(bends).max(), sharpest, 3e-13)


@pytest.mark.parametrize("ratio", [0.8, 1.0, 2.0])
def test_short_clothoids_leave_the_turn_of_two_arcs(ratio):
    arcs = Turn(1.7, ratio=ratio, entry_radius=4.3, exit_radius=4.4)
    blended = ClothoidTurn(1.7, ratio=ratio, middle=1e-3, entry_radius=4.3, exit_radius=4.4)
    assert_near([blended.length, *blended.radii], [arcs.length, *arcs.radii], 1e-5)
    s = np.linspace(-5.0, arcs.length, 101)
    assert_near(blended.position(s), arcs.position(s), 1e-5)


def test_its_arcs_and_the_place_between_them_lie_on_it():
    turn = ClothoidTurn(1.7, ratio=1.3, middle=2.0, ends=0.4, entry_radius=4.2, exit_radius=4.4)
    s = np.linspace(0.0, turn.length, 40_001)
    places = turn.position(s)
    bends = turn.curvature(s)
    step = s[1] - s[0]
    for centre, radius, angle, side in zip(turn.centres, turn.radii, turn.angles, (-1.0, 1.0), strict=True):
        on_arc = np.abs(bends - side / radius) < 1e-12
        assert_near(on_arc.sum() * step, radius * angle, 2.0 * step)
        assert np.abs(np.hypot(*(places[on_arc] - centre).T) - radius).max() < JOINT
    between = int(np.argmin(np.hypot(*(places - turn.tangent_point).T)))
    assert bends[between - 1] < 0.0 < bends[between + 1]


def test_all_benches_dance_through_it():
    assert first_contact(Dance(Dragon(), SMOOTH), start=-100.0, stop=500.0).outcome is Outcome.CLEAR


@pytest.mark.parametrize(
    "ways, field",
    [
        ({"middle": 1e-3, "ends": 100.0}, "middle"),
        ({"middle": 1.0, "ends": 1e-4}, "ends"),
    ],
    ids=["long ends", "short ends"],
)
def test_what_is_no_turn_is_refused(ways, field):
    with refused(field):
        ClothoidTurn(1.7, **ways)


def test_the_extent_is_the_largest_distance_from_the_centre():
    turn = ClothoidTurn(1.7, ratio=1.07, middle=2.265, entry_radius=3.417, exit_radius=3.57)
    places = turn.position(np.linspace(0.0, turn.length, 100_001))
    assert_near(turn.extent, np.hypot(*places.T).max(), 1e-8)

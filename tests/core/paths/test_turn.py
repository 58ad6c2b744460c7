"""The turn: the reference's arcs, places and clearance."""

import numpy as np
import pytest

from core import Coil, Dance, Dragon, InvalidValue, Route, Turn, trajectory
from tests.support.near import assert_near
from tests.support.reference import reference

REFERENCE = reference("turn")
TURN = Turn(1.7, 4.5, 2.0)
DANCE = Dance(Dragon(), TURN)
BARELY_OUTSIDE = 4.5 / 1.7 * (1 + 1e-12)  # [turns]: from there to the circle a coil is shorter than any piece may be
REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]: accuracy of the reference values
INVALID = {
    "on the circle": ("start_turns", {"pitch": 1.7, "turning_radius": 4.5, "start_turns": BARELY_OUTSIDE}),
    "an arc too small": (
        "ratio", {"pitch": 1e-3, "turning_radius": 0.1, "start_turns": 200, "entry_radius": 3e-3, "ratio": 0.01}
    ),
    "the entry": ("entry_radius", {"pitch": 1e-3, "turning_radius": 0.01, "entry_radius": 1e-3}),
    "arcs outside": ("exit_radius", {"pitch": 1.7, "ratio": 100, "entry_radius": 1.0, "exit_radius": 4.0}),
    "a coil too long": ("start_turns", {"pitch": 1e4, "start_turns": 200.0}),
}  # fmt: skip


@pytest.mark.uncompiled
@pytest.mark.parametrize("name", INVALID)
def test_an_invalid_turn_names_what_was_asked_and_never_a_piece(name):
    field, query = INVALID[name]
    with pytest.raises(InvalidValue) as caught:
        Turn(**query)
    assert caught.value.field == field
    assert "path" not in caught.value.message


@pytest.mark.uncompiled
# Turns with their own exit, found on a grid: ratio, radii of entry and exit, length of both arcs [m].
@pytest.mark.parametrize(
    "ratio, entry, leaving, length",
    [
        (2.0, 4.290, 4.498, 11.8105),
        (1.0, 4.462, 3.900, 8.2271),
        (0.8, 4.310, 3.828, 8.7917),
    ],
)
def test_a_free_exit_leaves_on_the_coil_outwards_in_its_direction(ratio, entry, leaving, length):
    turn = Turn(1.7, ratio=ratio, entry_radius=entry, exit_radius=leaving)
    assert turn.entry_radius == entry
    assert turn.exit_radius == leaving
    assert_near(turn.length, length, 5e-5)
    assert_near(turn.radii[0], ratio * turn.radii[1], 1e-14)
    coil = Route([Coil(1.7, leaving / 1.7, 16.0, rotation=np.pi)])
    s = turn.joints[2] - turn.joints[0]
    assert_near([turn.position(s), turn.tangent(s)], [coil.position(0.0), coil.tangent(0.0)], 1e-12)
    assert np.linalg.norm(turn.position(np.linspace(0.0, turn.length, 20_001)), axis=-1).max() <= 4.5 + 1e-9


@pytest.mark.uncompiled
def test_an_exit_equal_to_the_entry_is_the_default():
    default, equal, near = (Turn(1.7, entry_radius=4.3, exit_radius=leaving) for leaving in (None, 4.3, 4.3 + 1e-9))
    assert equal == default
    assert_near(near.length, default.length, 1e-7)


@pytest.mark.uncompiled
@pytest.mark.parametrize("ratio, entry, leaving", [(2.598, 1.853, 4.403), (0.288, 4.395, 1.672), (3.921, 1.557, 4.317)])
def test_arcs_that_leave_the_circle_are_refused_with_their_distance(ratio, entry, leaving):
    """On a larger circle the same arcs are accepted, and samples of them say how far they go."""
    arcs = Turn(1.7, 20.0, ratio, entry_radius=entry, exit_radius=leaving)
    furthest = np.linalg.norm(arcs.position(np.linspace(0.0, arcs.length, 200_001)), axis=-1).max()
    with pytest.raises(InvalidValue, match=f"^exit_radius .* up to {furthest:.6g} m "):
        Turn(1.7, 4.5, ratio, entry_radius=entry, exit_radius=leaving)
    Turn(1.7, furthest + 1e-6, ratio, entry_radius=entry, exit_radius=leaving)


@pytest.mark.uncompiled
def test_the_turn_has_the_reference_arcs():
    known = REFERENCE["turn"]
    for name in ("length", "radii", "angles", "entry", "exit", "tangent_point", "centres"):
        assert_near(getattr(TURN, name), known[name], REFERENCE_ERROR)


@pytest.mark.uncompiled
@pytest.mark.parametrize("table", REFERENCE["tables"], ids=lambda table: f"{table['time']:g} s")
def test_every_handle_on_the_turn_is_the_reference_one(table):
    motion = trajectory(DANCE, table["time"])
    rows = table["handles"]
    handles = [row["handle"] for row in rows]
    assert len(handles) > 5
    result = np.column_stack([motion.position, motion.speed])[handles]
    assert_near(result, [[row["x"], row["y"], row["speed"]] for row in rows], REFERENCE_ERROR)

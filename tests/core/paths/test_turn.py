"""The turn: the reference's arcs, places and clearance."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from core import (
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Route,
    Turn,
    first_contact,
    least_clearance,
    trajectory,
)
from core.errors import Quantity
from tests.support.near import assert_near
from tests.support.reference import reference

REFERENCE = reference("turn")
TURN = Turn(1.7, 4.5, 2.0)
BARELY_OUTSIDE = 4.5 / 1.7 * (1 + 1e-12)  # [turns]: from there to the circle a coil is shorter than any piece may be
REFERENCE_ERROR = 1e-9  # [m], [m/s], [s]: accuracy of the reference values


@pytest.mark.parametrize(
    ("query", "field", "got"),
    [
        ({"pitch": 1.7, "start_turns": 2.0}, "start_turns", 2.0),
        ({"pitch": 1.7, "turning_radius": 4.5, "start_turns": BARELY_OUTSIDE}, "start_turns", None),
        (
            {"pitch": 1e-3, "turning_radius": 0.1, "start_turns": 200, "entry_radius": 3e-3, "ratio": 0.01},
            "ratio",
            0.01,
        ),
        ({"pitch": 1e-3, "turning_radius": 1e-3}, "turning_radius", 1e-3),
        ({"pitch": 1e-3, "turning_radius": 0.01, "entry_radius": 1e-3}, "entry_radius", 1e-3),
        ({"pitch": 1.7, "exit_radius": 4.6}, "exit_radius", 4.6),
        ({"pitch": 1.7, "ratio": 100, "entry_radius": 1.0, "exit_radius": 4.0}, "exit_radius", 4.0),
        ({"pitch": 1e4, "start_turns": 200.0}, "start_turns", 200.0),
    ],
    ids=[
        "inside the circle",
        "on the circle",
        "an arc too small",
        "the circle",
        "the entry",
        "the exit",
        "arcs outside",
        "a coil too long",
    ],
)
def test_an_invalid_turn_names_what_was_asked_and_never_a_piece(query: dict, field: str, got: float | None) -> None:
    with pytest.raises(InvalidValue) as refused:
        Turn(**query)
    assert refused.value.field == field
    in_error = refused.value.got
    assert got is None or (isinstance(in_error, Quantity) and in_error.value == got)
    assert refused.value.message.startswith(f"{field} must ")
    assert "path" not in refused.value.message


@pytest.mark.uncompiled
def test_a_start_barely_outside_the_circle_is_refused_as_one_inside_it() -> None:
    with pytest.raises(InvalidValue, match=r"start_turns must be more than 2\.64706 turns, so that the coil begins"):
        Turn(1.7, 4.5, start_turns=BARELY_OUTSIDE)


@pytest.mark.uncompiled
def test_turns_with_the_same_pieces_differ_by_their_turning_circles() -> None:
    one, same, wider = (Turn(1.7, radius, entry_radius=4.0) for radius in (4.5, 4.5, 5.0))
    assert one == same
    assert one.pieces == wider.pieces
    assert one != wider


# Turns with their own exit, found on a grid: ratio, radii of entry and exit, length of both arcs [m].
FREE = [
    (2.0, 4.290, 4.498, 11.8105),
    (1.5, 4.044, 4.486, 9.4153),
    (1.2, 3.954, 4.474, 8.6309),
    (1.0, 4.462, 3.900, 8.2271),
    (0.8, 4.310, 3.828, 8.7917),
]


@pytest.mark.uncompiled
@pytest.mark.parametrize(("ratio", "entry", "leaving", "length"), FREE, ids=lambda value: f"{value:g}")
def test_a_free_exit_leaves_on_the_coil_outwards_in_its_direction(
    ratio: float, entry: float, leaving: float, length: float
) -> None:
    turn = Turn(1.7, ratio=ratio, entry_radius=entry, exit_radius=leaving)
    assert (turn.entry_radius, turn.exit_radius) == (entry, leaving)
    assert_near(turn.length, length, 5e-5)
    assert turn.radii[0] / turn.radii[1] == pytest.approx(ratio, rel=1e-14)
    coil = Route([Coil(1.7, leaving / 1.7, 16.0, rotation=np.pi)])
    s = turn.joints[2] - turn.joints[0]
    assert_near(turn.position(s), coil.position(0.0), 1e-12)
    assert_near(turn.tangent(s), coil.tangent(0.0), 1e-12)
    places = np.linspace(0.0, turn.length, 20_001)
    furthest = np.linalg.norm(turn.position(places), axis=-1).max()
    assert furthest <= 4.5 + 1e-9
    assert first_contact(Dance(Dragon(), turn), start=-100.0, stop=500.0).time is None


@pytest.mark.uncompiled
def test_an_exit_equal_to_the_entry_is_the_default() -> None:
    assert Turn(1.7, entry_radius=4.3, exit_radius=4.3) == Turn(1.7, entry_radius=4.3)
    near = Turn(1.7, entry_radius=4.3, exit_radius=4.3 + 1e-9)
    assert_near(near.length, Turn(1.7, entry_radius=4.3).length, 1e-7)


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    ("ratio", "entry", "leaving"), [(2.598, 1.853, 4.403), (0.288, 4.395, 1.672), (3.921, 1.557, 4.317)]
)
def test_arcs_that_leave_the_circle_are_refused_with_their_distance(ratio: float, entry: float, leaving: float) -> None:
    """On a larger circle the same arcs are accepted, and samples of them say how far they go."""
    arcs = Turn(1.7, 20.0, ratio, entry_radius=entry, exit_radius=leaving)
    furthest = np.linalg.norm(arcs.position(np.linspace(0.0, arcs.length, 200_001)), axis=-1).max()
    with pytest.raises(InvalidValue, match=r"^exit_radius must leave the arcs inside the circle") as refused:
        Turn(1.7, 4.5, ratio, entry_radius=entry, exit_radius=leaving)
    assert f"up to {furthest:.6g} m from its centre, more than 4.5 m" in refused.value.message
    just = Turn(1.7, furthest + 1e-6, ratio, entry_radius=entry, exit_radius=leaving)
    assert just.length == arcs.length


@pytest.mark.uncompiled
def test_the_turn_has_the_reference_arcs() -> None:
    known = REFERENCE["turn"]
    assert_near(TURN.length, known["length"], REFERENCE_ERROR)
    for name in ("radii", "angles", "entry", "exit", "tangent_point"):
        assert getattr(TURN, name) == pytest.approx(known[name], abs=REFERENCE_ERROR), name
    assert_near(np.array(TURN.centres), np.array(known["centres"]), REFERENCE_ERROR)


@pytest.mark.uncompiled
@pytest.mark.parametrize("table", REFERENCE["tables"], ids=lambda table: f"{table['time']:g} s")
def test_every_handle_on_the_turn_is_the_reference_one(table: dict) -> None:
    motion = trajectory(Dance(Dragon(), TURN), [table["time"]])
    handles = [row["handle"] for row in table["handles"]]
    known = np.array([[row["x"], row["y"], row["speed"]] for row in table["handles"]])
    assert len(handles) > 5
    assert_near(motion.position[0, handles], known[:, :2], REFERENCE_ERROR)
    assert_near(motion.speed[0, handles], known[:, 2], REFERENCE_ERROR)


@pytest.mark.uncompiled
def test_the_least_clearance_on_the_turn_is_the_reference_one() -> None:
    known = REFERENCE["clearance"]
    start, stop = known["interval"]
    least = least_clearance(Dance(Dragon(), TURN), start=start, stop=stop)
    assert_near(least.distance, known["least"], REFERENCE_ERROR)
    assert_near(least.time, known["time"], REFERENCE_ERROR)
    assert list(least.benches) == known["benches"]
    assert least.distance - 1.1e-5 < least.at_least <= least.distance
    assert first_contact(Dance(Dragon(), TURN), start=start, stop=stop, margin=known["least"] - 1e-9).time is None
    graze = first_contact(Dance(Dragon(), TURN), start=start, stop=stop, margin=known["least"] + 1e-9)
    assert_near(graze.time, known["time"], 1e-3)


def test_a_free_exit_gives_the_arcs_that_root_finding_gives() -> None:
    """The radius at which the circles touch, from tangents and root finding alone."""
    growth = 1.7 / (2.0 * math.pi)

    def place(radius: float) -> tuple[Any, Any]:
        theta = radius / growth
        out, across = np.array([math.cos(theta), math.sin(theta)]), np.array([-math.sin(theta), math.cos(theta)])
        ahead = growth * out + radius * across
        return radius * out, ahead / np.linalg.norm(ahead)

    (entry, inwards), (leaving, outwards) = place(4.3), place(4.5)
    first = np.array([-inwards[1], inwards[0]])  # to the right of the way in, which is -inwards
    second = np.array([-outwards[1], outwards[0]])  # to the left of the way out, turned by pi with its place

    def gap(radius: float) -> float:
        centres = entry + 2.0 * radius * first, -leaving - radius * second
        return float(np.linalg.norm(centres[1] - centres[0])) - 3.0 * radius

    small = brentq(gap, 0.5, 3.0)
    assert Turn(1.7, entry_radius=4.3, exit_radius=4.5).radii == pytest.approx((2.0 * small, small), rel=1e-12)

"""Paths in certificates: a written path reads back unchanged, and paths without a proof are refused."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from flint import arb

from core import (
    Arc,
    Clothoid,
    ClothoidTurn,
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Route,
    Spiral,
    Turn,
    Waypoints,
    trajectory,
)
from core.proof.chain import Chain
from core.proof.paths import chain_on, core_path, path_words, recorded_path
from core.proof.route import RouteChain

BEND = Arc((30.0, 3.0), 3.0, -math.pi / 2, 1.0)
PATHS: dict[str, tuple[Spiral | Route, str]] = {
    "spiral": (Spiral(0.55, 16.0), "the spiral of pitch 0.55 m inwards from 16 turns"),
    "turn": (Turn(1.7, ratio=1.5, entry_radius=4.2), "the turn of ratio 1.5, which it enters 4.2 m from the centre"),
    "free turn": (
        Turn(1.7, ratio=1.2, entry_radius=3.96, exit_radius=4.47),
        "which it enters 3.96 m from the centre at 0 s and leaves 4.47 m from it",
    ),
    "route": (
        Route([Line((0.0, 0.0), (30.0, 0.0)), BEND], 7.0),
        "2 pieces (line, arc), joined exactly, its s = 0 at 7",
    ),
    "coil": (Route([Coil(0.9, 3.0, 9.0, (1.0, 2.0), 0.5)]), "the route of 1 piece (coil)"),
}


@pytest.mark.parametrize(("path", "words"), PATHS.values(), ids=PATHS)
def test_a_path_reads_back_from_json_to_the_last_bit(path: Spiral | Route, words: str) -> None:
    record = json.loads(json.dumps(recorded_path(path)))
    again = core_path(record)
    s = np.linspace(max(path.begin, -20.0), min(path.end, 60.0), 50)
    assert type(again) is type(path)
    assert again.position(s).tolist() == path.position(s).tolist()
    assert recorded_path(again) == record
    assert words in path_words(record)


@pytest.mark.parametrize(("path", "_"), PATHS.values(), ids=PATHS)
def test_a_spiral_has_its_own_chain_and_everything_else_that_of_a_route(path: Spiral | Route, _: str) -> None:
    chain = chain_on(Dragon(5), recorded_path(path), 0.0)
    assert type(chain) is (Chain if isinstance(path, Spiral) else RouteChain)


@pytest.mark.parametrize("leaving", [4.49, 3.9, 4.2])
def test_the_arcs_of_a_turn_with_its_own_exit_are_those_of_core(leaving: float) -> None:
    """The chain in balls has the separations of handles that core computes: it does not depend on the frame."""
    turn, dragon = Turn(1.7, ratio=1.1, entry_radius=4.3, exit_radius=leaving), Dragon(4)
    chain = chain_on(dragon, recorded_path(turn), 0.0)
    for time in (-3.0, 2.0, 6.0, 9.0, 14.0):
        pose = chain.pose_at(0, arb(-time))
        pose.grow_to(dragon.benches)
        known = trajectory(Dance(dragon, turn), [time]).position[0]
        places = np.array([-float(place) for place in pose.places[: dragon.benches + 1]])
        assert turn.position(places) == pytest.approx(known, abs=1e-9)


def test_a_turn_with_clothoids_is_refused_by_what_makes_them() -> None:
    words = (
        r"path must be a turn of two arcs, without `middle` and `ends`, for a proof in ball arithmetic, got clothoid"
    )
    with pytest.raises(InvalidValue, match=words):
        recorded_path(ClothoidTurn(1.7, ratio=1.0, middle=4.0))


def test_clothoids_are_refused_by_their_place() -> None:
    path = Route([Line((-9.0, 0.0), (0.0, 0.0)), Clothoid((0.0, 0.0), 0.0, 0.0, 0.5, 2.0)])
    with pytest.raises(InvalidValue, match=r"path\.pieces\[1\] must be .* in ball arithmetic, got clothoid: on such"):
        recorded_path(path)


@pytest.mark.parametrize("before", [0, 1])
def test_waypoints_are_refused_by_their_place(before: int) -> None:
    pieces = [Line((-9.0, 0.0), (0.0, 0.0))] * before
    path = Route([*pieces, Waypoints(((0.0, 0.0), (5.0, 0.0), (9.0, 4.0)), start_heading=0.0)])
    with pytest.raises(InvalidValue, match="in ball arithmetic, got waypoints") as refused:
        recorded_path(path)
    assert refused.value.field == f"path.pieces.{before}"
    assert refused.value.message.startswith("path.pieces[1] must be a line" if before else "path must be a spiral")


@pytest.mark.parametrize(
    ("name", "place", "value", "field"),
    [
        ("turn", ("entry_radius",), 9.0, "path.entry_radius"),
        ("route", ("pieces", 1, "radius"), -1.0, "path.pieces.1.radius"),
        ("spiral", ("pitch",), -1.0, "path.pitch"),
    ],
)
def test_a_number_that_no_path_has_is_refused_by_its_place(
    name: str, place: tuple[str | int, ...], value: float, field: str
) -> None:
    record = recorded_path(PATHS[name][0])
    inner = record
    for key in place[:-1]:
        inner = inner[key]  # type: ignore[index]
    inner[place[-1]] = value  # type: ignore[index]
    with pytest.raises(InvalidValue) as refused:
        core_path(record)
    assert refused.value.field == field

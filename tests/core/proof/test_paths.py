"""Paths in certificates: a written path reads back unchanged, and paths without a proof are refused."""

import json
import math

import numpy as np
import pytest

from core import (
    Arc,
    Clothoid,
    ClothoidTurn,
    Coil,
    Dragon,
    Line,
    Route,
    Spiral,
    Turn,
    Waypoints,
)
from core.proof.chain import Chain
from core.proof.paths import chain_on, core_path, path_words, recorded_path
from core.proof.route import RouteChain
from tests.support.forgeries import in_words
from tests.support.refused import refused

BEND = Arc((30.0, 3.0), 3.0, -math.pi / 2, 1.0)
PATHS = {
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


@pytest.mark.parametrize("name", PATHS)
def test_a_path_reads_back_from_json_to_the_last_bit_and_has_its_chain(name):
    path, words = PATHS[name]
    record = json.loads(json.dumps(recorded_path(path)))
    again = core_path(record)
    s = np.linspace(max(path.begin, -20.0), min(path.end, 60.0), 50)
    assert type(again) is type(path)
    assert again.position(s).tolist() == path.position(s).tolist()
    assert recorded_path(again) == record
    assert words in path_words(record)
    assert type(chain_on(Dragon(5), record, 0.0)) is (Chain if name == "spiral" else RouteChain)


FIRST = Line((-9.0, 0.0), (0.0, 0.0))
BENDING = Clothoid((0.0, 0.0), 0.0, 0.0, 0.5, 2.0)
CURVE = Waypoints(((0.0, 0.0), (5.0, 0.0), (9.0, 4.0)), 0.0)


@pytest.mark.parametrize(
    "path, place",
    [
        *((ClothoidTurn(1.7, ratio=1.0, middle=4.0), 1), (Route([FIRST, BENDING]), 1)),
        *((Route([FIRST, CURVE]), 1), (Route([CURVE]), 0)),
    ],
)
def test_a_path_without_a_proof_is_refused_by_its_place(path, place):
    with refused(f"path.pieces.{place}"):
        recorded_path(path)


@pytest.mark.parametrize(
    "name, edit, field",
    [
        ("turn", "entry_radius = 9.0", "path.entry_radius"),
        ("route", "pieces.1.radius = -1.0", "path.pieces.1.radius"),
        ("spiral", "pitch = -1.0", "path.pitch"),
    ],
)
def test_a_number_that_no_path_has_is_refused_by_its_place(name, edit, field):
    record = recorded_path(PATHS[name][0])
    in_words(edit)(record)
    with refused(field):
        core_path(record)

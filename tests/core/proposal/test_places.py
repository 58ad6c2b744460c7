"""Places of figures, against all places on a fine grid."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Area, Dragon, Figure, Route, Venue
from core.proposal.figures import Shape
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.places import base_rotation, placements, sampled
from tests.support.random_squares import box, random_case

NEEDS = Needs(Dragon(8), 0.0, 0.0)
OVAL = Shape(Figure.RING, (5.0, 3.0, 3.0))


@pytest.mark.parametrize("seed", [1, 5, 12])
def test_no_place_of_a_fine_grid_has_much_more_room(seed: int) -> None:
    ground = FreeGround(random_case(seed).venue)
    best = placements(ground, NEEDS, OVAL, 1)
    outline = sampled(Route(OVAL.pieces or ()), NEEDS)
    xs, ys = (np.arange(low, high, 1.0) for low, high in zip(ground.low, ground.high, strict=True))
    most = -math.inf
    for turn in base_rotation(ground) + math.pi / 8 * np.arange(8):
        cos, sin = math.cos(turn), math.sin(turn)
        x, y = outline.points.T
        turned = np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
        for place in np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2):
            if ground.roughly(place + turned[::9]).min() > most:
                most = max(most, float((ground.clearance(place + turned) - outline.sides).min()))
    if most > 0.0:
        ((room, pose),) = best
        assert room >= most - 2.0 * ground.node_error
        x, y = outline.points.T
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        there = np.stack([pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y], axis=-1)
        assert room == pytest.approx(
            float((ground.clearance(there) - outline.sides).min()), abs=2.0 * ground.node_error
        )


def test_a_ring_runs_around_a_well() -> None:
    venue = Venue(box("square", 0, 0, 16, 12), (box("well", 7, 5, 2, 2),))
    (_, pose), *_ = placements(FreeGround(venue), NEEDS, OVAL, 1)
    assert math.dist(pose[:2], (8.0, 6.0)) < 1.5


def test_a_square_without_room_has_no_place() -> None:
    assert placements(FreeGround(Venue(box("square", 0, 0, 6, 5))), NEEDS, OVAL, 3) == []


def test_several_places_differ() -> None:
    first, second = (
        pose
        for _, pose in placements(
            FreeGround(Venue(Area("square", (box("square", 0, 0, 60, 40).rings)))), NEEDS, OVAL, 2
        )
    )
    assert math.dist(first[:2], second[:2]) > NEEDS.chord or abs(math.remainder(first[2] - second[2], math.pi)) > 0.3

"""Benches on a path stand with both handles on it, as far from every edge as polygons are."""

import math

import numpy as np
import shapely

from core import Dragon, Venue
from core.proposal.footprint import DENSE, room_beside, standing
from core.proposal.free_ground import FreeGround
from core.proposal.legs import points_along
from core.proposal.needs import Needs
from tests.support.near import assert_near
from tests.support.random_squares import box, polygon

NEEDS = Needs(Dragon(3), 0.05, 0.0)
SQUARE = box("square", 0, 0, 20, 12)
TREE = box("tree", 9, 5, 1, 1.5)
PLACE = 1e-3  # [m]: of a handle between dense points of a bend


def test_handles_are_a_chord_apart_and_on_the_path():
    steps = [(5.0, 0.0), (0.5 * math.pi * NEEDS.tight, 1.0 / NEEDS.tight), (3.0, 0.0)]
    points, s = points_along((2.0, 2.0, 0.0), steps, DENSE)
    fronts = np.linspace(5.0, s[-1], 40)
    front, rear = standing(s, points, fronts, NEEDS.chord)
    assert_near(np.hypot(*(front - rear).T), NEEDS.chord, PLACE)
    line = shapely.LineString(points)
    assert max(line.distance(shapely.Point(point)) for point in [*front, *rear]) < PLACE


def test_the_room_beside_a_bench_is_the_distance_of_its_rectangle():
    rng = np.random.default_rng(65)
    ground = FreeGround(Venue(SQUARE, (TREE,)))
    rear = rng.uniform((2, 2), (18, 10), (200, 2))
    turn = rng.uniform(0.0, 2.0 * math.pi, 200)
    ahead = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    room = room_beside(ground, NEEDS, rear + NEEDS.chord * ahead, rear)
    borders = shapely.union_all([polygon(SQUARE).boundary, polygon(TREE)])
    compared = 0
    for point, way, distance in zip(rear, ahead, room.tolist(), strict=True):
        ends = point - NEEDS.overhang * way, point + (NEEDS.chord + NEEDS.overhang) * way
        bench = shapely.LineString(ends).buffer(NEEDS.straight_side, cap_style="flat")
        if polygon(SQUARE).contains(bench) and not bench.intersects(polygon(TREE)):
            assert_near(distance, bench.distance(borders), 1e-9)
            compared += 1
    assert compared > 50

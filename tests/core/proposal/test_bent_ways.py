"""Bent ways: how far benches reach inside a corner, and the way back; test_propose.py dances them."""

import math

import numpy as np
import pytest

from core import Dragon
from core.proposal.bent_ways import backwards, bent_ways
from core.proposal.footprint import standing
from core.proposal.legs import points_along
from core.proposal.needs import Needs
from core.proposal.walks import moved

CHORD = 2.86


@pytest.mark.parametrize("degrees", [35, 60, 90])
def test_a_sharper_bend_around_a_corner_takes_as_much_ground_inside_as_a_wide_one(degrees):
    angle = math.radians(degrees)
    nearest = []
    for radius in (0.2, 0.5 * CHORD, 0.5 * CHORD / math.sin(0.5 * angle)):
        cut = radius * math.tan(0.5 * angle)
        steps = [(10.0 - cut, 0.0), (radius * angle, 1.0 / radius), (10.0 - cut, 0.0)]
        points, s = points_along((-10.0, 0.0, 0.0), steps, 0.002)
        front, rear = standing(s, points, np.arange(6.0, s[-1], 0.01), CHORD)
        inside = np.array([-math.sin(0.5 * angle), math.cos(0.5 * angle)])  # the bisector of the corner, at the origin
        way, beside = rear - front, inside[::-1] * (1.0, -1.0)
        meets = -(front @ beside) / (way @ beside)
        on = (meets >= 0.0) & (meets <= 1.0)
        nearest.append(float(((front + meets[:, None] * way) @ inside)[on].max()))
    assert nearest == pytest.approx([0.5 * CHORD * math.tan(0.5 * angle)] * 3, abs=1e-3)


@pytest.mark.parametrize("measured", [40, 400])
def test_no_more_ways_are_measured_than_may_be(measured):
    rooms = []

    def narrow(pose, steps):
        rooms.append(points_along(pose, steps)[0][:, 1].max())
        return np.array([0.1 * rooms[-1]])

    ends, line = ((0.0, 0.0, 0.0), (9.0, 9.0, 0.5 * math.pi)), np.array([[0.0, 0.0], [8.0, 1.0], [9.0, 9.0]])
    outwards = np.array([[1.0, -1.0]])
    ways = list(bent_ways(ends, line, outwards, Needs(Dragon(3), 0.0, 0.0), narrow, measured))
    assert len(ways) == 2
    assert 0.5 * measured < len(rooms) <= measured


def test_a_way_back_leads_to_its_beginning():
    pose = begin = (1.0, 2.0, 0.3)
    steps = [(2.0, 0.0), (1.0, 0.7), (3.0, -0.2)]
    for step in steps:
        pose = moved(pose, step)
    back = (pose[0], pose[1], pose[2] + math.pi)
    for step in backwards(steps):
        back = moved(back, step)
    assert back == pytest.approx((begin[0], begin[1], begin[2] + math.pi))

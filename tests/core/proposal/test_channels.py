"""Legs through channels run along their middle, and turn where one side is open."""

import math
from functools import reduce

import pytest
import shapely

from core import Area, Budget, Dragon, Venue
from core.proposal.channels import ChannelLegFinder
from core.proposal.free_ground import FreeGround
from core.proposal.legs import LegFinder, points_along
from core.proposal.needs import Needs
from core.proposal.walks import joined, moved
from tests.support.random_squares import closed, polygon

NEEDS = Needs(Dragon(3), 0.05, 0.0)
ROOM = Area("room", (closed([(0, 0), (30, 0), (30, 0.8), (20, 0.8), (20, 10), (30, 10), (30, 10.8), (0, 10.8)]),))
BEGIN, END = (28.0, 0.4, math.pi), (28.0, 10.4, 0.0)


def finder(kind, area=ROOM):
    return kind(FreeGround(Venue(area)), NEEDS, Budget())


def test_a_leg_between_two_channels_is_straight_in_both_and_turns_between():
    plain = finder(LegFinder)
    assert (plain.around(BEGIN, END), plain.walk(BEGIN, END)) == (None, None)
    steps = joined(finder(ChannelLegFinder).around(BEGIN, END))
    assert reduce(moved, steps, BEGIN)[:2] == pytest.approx(END[:2], abs=1e-9)
    assert [math.copysign(1.0, curvature) if curvature else 0.0 for _, curvature in steps] == [
        0.0,
        -1.0,
        0.0,
        -1.0,
        0.0,
    ]
    assert min(steps[0][0], steps[-1][0]) >= 8.0
    line = shapely.LineString(points_along(BEGIN, steps, 0.05)[0])
    assert line.distance(polygon(ROOM).boundary) >= NEEDS.straight_side + NEEDS.free


def test_no_leg_leads_around_the_corner_of_a_narrow_channel():
    bent = Area("bent", (closed([(0, 0), (12, 0), (12, 12), (11.1, 12), (11.1, 0.9), (0, 0.9)]),))
    assert finder(ChannelLegFinder, bent).around((1.0, 0.45, 0.0), (11.55, 11.0, 0.5 * math.pi)) is None

"""Legs through channels: none around a narrow corner. Those that there are: test_propose.py."""

import math

from core import Area, Budget, Dragon, Venue
from core.proposal.channels import ChannelLegFinder
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from tests.support.random_squares import closed


def test_no_leg_leads_around_the_corner_of_a_narrow_channel():
    bent = Area("bent", (closed([(0, 0), (12, 0), (12, 12), (11.1, 12), (11.1, 0.9), (0, 0.9)]),))
    legs = ChannelLegFinder(FreeGround(Venue(bent)), Needs(Dragon(3), 0.05, 0.0), Budget())
    assert legs.around((1.0, 0.45, 0.0), (11.55, 11.0, 0.5 * math.pi)) is None

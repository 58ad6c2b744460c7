"""Small parts of the random campaigns, and that they find what is false."""

from dataclasses import replace

import pytest

from core import (
    Outcome,
    first_contact,
    venue_clearance,
)
from tests.campaigns import hunt_contacts, hunt_corners, hunt_encounters, hunt_turns, hunt_venues, hunting
from tests.support.depth import examples, further

CAMPAIGNS = hunt_encounters, hunt_venues, hunt_contacts, hunt_turns, hunt_corners
# Cases of a small part, of which the first ones are those of every run.
FEW = 6
MANY = examples(25, 200)


@pytest.mark.parametrize("count", further([FEW, MANY], 1), ids=["few", "many"])
@pytest.mark.parametrize("campaign", CAMPAIGNS, ids=lambda campaign: campaign.__name__.split("_")[-1])
def test_nothing_false_is_found_in_a_small_part(campaign, count):
    result = hunting.hunt(campaign.fault, 44, 0.0, count)
    assert result.cases == count
    assert result.faults == 0
    assert len(result.kinds) >= 3 or count == FEW  # contacts, clear dances and others


def test_a_contact_that_is_left_out_or_invented_is_a_fault():
    dance, margin, start, stop, look = hunt_contacts.random_case(44, 4)
    result = first_contact(dance, margin=margin, start=start, stop=stop)
    assert result.outcome is Outcome.CONTACT
    clear = replace(result, outcome=Outcome.CLEAR, time=None, time_bracket=None, benches=None)
    for fault in (clear, replace(result, time_bracket=(result.time_bracket[1] + 0.05,) * 2)):
        assert hunt_contacts.contact_fault(dance, fault, margin, look)


@pytest.mark.parametrize("case, outcome", [(1, Outcome.CLEAR), (2, Outcome.CONTACT)])
def test_a_bound_that_is_too_high_and_a_tree_that_is_overlooked_are_faults(case, outcome):
    dance, venue, margin, start, stop, look = hunt_venues.random_case(44, case)
    result = venue_clearance(dance, venue, margin=margin, start=start, stop=stop).areas[1]
    assert result.outcome is outcome
    nearest = replace(result.nearest, at_least=result.nearest.distance + 1e-4)
    wrong = {"nearest": nearest} if outcome is Outcome.CLEAR else {"outcome": Outcome.CLEAR, "time_bracket": None}
    assert hunt_venues.area_fault(replace(result, **wrong), margin, look)


@pytest.mark.parametrize("case", further([(3, 130), (1, 201), (1, 6), (1, 11), (3, 186)], 2), ids=str)
def test_slow_contacts_of_dances_with_passages_have_narrow_brackets(case):
    """Cases of the campaign whose brackets were up to 6e-7 s wide; corners pass corners in some of them."""
    dance, margin, start, stop, _ = hunt_contacts.random_case(*case)
    contact = first_contact(dance, margin=margin, start=start, stop=stop)
    assert dance.passages
    assert contact.outcome is Outcome.CONTACT
    assert not hunt_contacts.is_wide(dance, contact)

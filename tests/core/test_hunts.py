"""Small parts of the random campaigns, and that they find what is false."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core import (
    Clothoid,
    Coil,
    Dance,
    Dragon,
    Line,
    Outcome,
    Route,
    Turn,
    first_contact,
    first_encounter,
    trajectory,
    venue_clearance,
)
from tests.campaigns import hunt_clothoids, hunt_contacts, hunt_encounters, hunt_turns, hunt_venues, hunting
from tests.support.depth import examples
from tests.support.slow_route import SlowRoute

CONTACTS, VENUES = examples(25, 200), examples(25, 200)
# Places of handles far out on a route [m].
SAME_PLACE = 1e-10


@pytest.mark.parametrize(
    ("fault", "count"),
    [
        (hunt_contacts.fault, CONTACTS),
        (hunt_clothoids.fault, CONTACTS),
        (hunt_venues.fault, VENUES),
        (hunt_turns.fault, CONTACTS),
        (hunt_encounters.fault, CONTACTS),
    ],
    ids=["contacts", "clothoids", "venues", "turns", "encounters"],
)
def test_nothing_false_is_found_in_a_small_part(fault: Callable[[int, int], tuple[str, str]], count: int) -> None:
    result = hunting.hunt(fault, 44, 0.0, count)
    assert (result.cases, result.faults) == (count, 0)
    assert len(result.kinds) >= 3  # contacts, clear dances and others


@pytest.mark.parametrize(
    "route",
    [
        Turn(1.0, 1.5, 1.3, start_turns=8.0),
        Route([Coil(1.7, 9.0, 2.0, (3.0, -2.0), 0.7)], start=40.0),
        Route([Line((0.0, 0.0), (60.0, 25.0))], start=30.0),
        Route([Clothoid((3.0, -2.0), 0.7, -0.2, 0.7, 40.0)], start=20.0),
        Route([Clothoid((3.0, -2.0), 0.7, -0.2, -0.2, 40.0)], start=20.0),
    ],
    ids=["turn", "coil", "line", "clothoid", "arc as a clothoid"],
)
def test_the_slow_route_is_the_route(route: Route) -> None:
    dragon = Dragon(9, 1.3, 1.1, 0.3, 0.1)
    slow = SlowRoute.of(dragon, route)
    assert slow.end() == pytest.approx(route.end, rel=0, abs=SAME_PLACE)
    times = np.linspace(0.0, 0.9 * route.end, 50)
    np.testing.assert_allclose(
        slow.handles(times), trajectory(Dance(dragon, route), times).position, rtol=0, atol=SAME_PLACE
    )


def first_where(campaign: Any, wanted: Callable[[Any], bool]) -> tuple[Any, Any]:
    """The first random case and its answer that are wanted."""
    for case in range(200):
        result = campaign(case)
        if result is not None and wanted(result[1]):
            return result
    raise AssertionError("no such case")


def test_a_contact_that_is_left_out_or_invented_is_a_fault() -> None:
    def campaign(case: int) -> Any:
        dance, margin, start, stop, look = hunt_contacts.random_case(44, case)
        return (dance, margin, look), first_contact(dance, margin=margin, start=start, stop=stop)

    (dance, margin, look), result = first_where(campaign, lambda result: result.outcome is Outcome.CONTACT)
    assert hunt_contacts.contact_fault(dance, result, margin, look) == ""
    clear = replace(result, outcome=Outcome.CLEAR, time=None, time_bracket=None, benches=None)
    assert hunt_contacts.contact_fault(dance, clear, margin, look)
    start, touching = result.time_bracket
    early = replace(result, time_bracket=(start - 0.1, start - 1e-4))
    assert hunt_contacts.contact_fault(dance, early, margin - 1e-9, look)
    late = replace(result, time_bracket=(touching + 0.05, touching + 0.05))
    assert hunt_contacts.contact_fault(dance, late, margin, look)


def test_a_bound_that_is_too_high_and_a_tree_that_is_overlooked_are_faults() -> None:
    def campaign(case: int) -> Any:
        dance, venue, margin, start, stop, look = hunt_venues.random_case(44, case)
        return (margin, look), venue_clearance(dance, venue, margin=margin, start=start, stop=stop).areas[1]

    (margin, look), result = first_where(campaign, lambda result: result.outcome is Outcome.CLEAR)
    assert hunt_venues.area_fault(result, margin, look) == ""
    nearest = replace(result.nearest, at_least=result.nearest.distance + 1e-4)
    assert hunt_venues.area_fault(replace(result, nearest=nearest), margin, look)
    (margin, look), result = first_where(campaign, lambda result: result.outcome is Outcome.CONTACT)
    assert hunt_venues.area_fault(replace(result, outcome=Outcome.CLEAR, time_bracket=None), margin, look)


def test_an_encounter_that_is_left_out_or_invented_is_a_fault() -> None:
    def campaign(case: int) -> Any:
        performance, margin, start, stop, look = hunt_encounters.random_case(44, case)
        return (margin, look), first_encounter(performance, margin=margin, start=start, stop=stop)

    (margin, look), encounter = first_where(campaign, lambda encounter: encounter.outcome is Outcome.CONTACT)
    assert hunt_encounters.encounter_fault(encounter, margin, look) == ""
    assert hunt_encounters.encounter_fault(replace(encounter, outcome=Outcome.CLEAR, time_bracket=None), margin, look)
    start = encounter.time_bracket[0]
    early = replace(encounter, time_bracket=(start - 0.1, start - 1e-2))
    assert hunt_encounters.encounter_fault(early, margin - 1e-6, look)


@pytest.mark.parametrize(("seed", "case"), [(1, 6), (1, 11), (1, 201), (3, 130), (3, 186)])
def test_slow_contacts_of_dances_with_passages_have_narrow_brackets(seed: int, case: int) -> None:
    """Cases of the campaign whose brackets were up to 6e-7 s wide; corners pass corners in some of them."""
    dance, margin, start, stop, _ = hunt_contacts.random_case(seed, case)
    contact = first_contact(dance, margin=margin, start=start, stop=stop)
    assert dance.passages
    assert contact.outcome is Outcome.CONTACT
    assert not hunt_contacts.is_wide(dance, contact)

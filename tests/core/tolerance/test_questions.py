"""Every question with a stray: messages, the two sides of a tolerance, and no change by a stray of 0."""

import pytest

from core import (
    Dance,
    Dragon,
    InvalidValue,
    Outcome,
    Spiral,
    Stray,
    check,
    deepest_turn,
    first_contact,
    minimum_pitch,
    tolerance,
    venue_clearance,
)
from tests.core.contact.test_walls import CORNER, VENUE

DANCE = Dance(Dragon(), Spiral())


def test_a_stray_above_the_tolerance_until_a_time_touches_just_before_it():
    known = tolerance(DANCE, stop=300.0)
    safe, touching = known.stray_bracket
    assert first_contact(DANCE, stray=safe, stop=300.0).outcome is Outcome.CLEAR
    assert known.time - 2.0 < first_contact(DANCE, stray=1.001 * touching).time < known.time


QUESTIONS = {
    "first contact": lambda **options: first_contact(DANCE, **options),
    "minimum pitch": lambda **options: minimum_pitch(Dragon(), **options),
    "shortest turn": lambda **options: deepest_turn(Dragon(3), 1.7, **options).turn.entry_radius,
    "venue": lambda **options: venue_clearance(CORNER, VENUE, **options),
    "check": lambda **options: check(DANCE, **options),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_stray_of_0_changes_no_bit(name):
    ask = QUESTIONS[name]
    assert ask(stray=0.0) == ask(stray=Stray(0.0, 0.05, 0.05)) == ask()


def test_a_stray_brings_benches_nearer_to_a_wall_by_it_and_at_most_half_more():
    still, strayed = (venue_clearance(CORNER, VENUE, stray=stray, stop=10.0) for stray in (0.0, 0.02))
    for before, after in zip(still.areas, strayed.areas, strict=True):
        assert 0.02 - 1e-9 < before.nearest.distance - after.nearest.distance < 0.03


def test_a_stray_that_no_pitch_allows_is_reported_as_such():
    with pytest.raises(InvalidValue, match=r"^stray must be smaller, got 0\.6 m: on a straight line, "):
        minimum_pitch(Dragon(), stray=0.6)

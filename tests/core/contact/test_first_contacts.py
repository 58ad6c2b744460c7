"""First contacts of many dances at once: each as alone."""

import numpy as np
import pytest

from core import (
    Budget,
    Dance,
    Dragon,
    OutsideRun,
    Passage,
    Spiral,
    TooMuchWork,
    Turn,
    first_contact,
    first_contacts,
    threads,
)
from tests.support.every_digit import every_digit
from tests.support.refused import refused


@pytest.fixture(params=[1, 4], autouse=True)
def cores(request, monkeypatch):
    """A machine with one core, and one with four, however many there are."""
    monkeypatch.setattr(threads, "usable_cores", lambda: request.param)


def test_each_of_many_dances_has_the_digits_that_it_has_alone_and_its_place():
    pitches = np.random.default_rng(72).uniform(0.4, 0.9, 60)
    dances = [Dance(Dragon(20 + k, body_length=2.0 + 0.01 * k), Spiral(pitch, 8.0)) for k, pitch in enumerate(pitches)]
    dances[7] = Dance(Dragon(12), Turn(1.7))
    dances[30] = Dance(Dragon(30), Spiral(0.5, 6.0), 0.7, [Passage(0.3, until_s=20.0)])
    for limits in ({}, {"margin": 0.02}, {"stray": 0.02, "stop": 40.0}):
        together = first_contacts((dance for dance in dances), **limits)
        alone = [first_contact(dance, **limits) for dance in dances]
        assert [every_digit(one) for one in together] == [every_digit(one) for one in alone]
        assert [one.dance for one in together] == dances


def test_no_dances_have_no_contacts():
    assert first_contacts([]) == []


def test_the_first_dance_that_is_refused_is_the_reason_and_one_budget_ends_all():
    long = Dance(Dragon(5), Spiral(0.55))
    short = Dance(Dragon(5), Spiral(0.55, 4.0))
    with pytest.raises(OutsideRun) as caught:
        first_contacts([long, short, long, Dance(Dragon(5), Spiral(0.55, 3.0))], stop=200.0)
    with pytest.raises(OutsideRun) as alone:
        first_contact(short, stop=200.0)
    assert str(caught.value) == str(alone.value)
    with refused("dances.1"):
        first_contacts([long, Dragon(5)])
    budget = Budget()
    budget.stop()
    with pytest.raises(TooMuchWork) as caught:
        first_contacts([long] * 9, budget=budget)
    assert caught.value.stopped

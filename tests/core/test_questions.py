"""One budget through every question: spent or stopped, it ends any of them; how soon: app/questions/test_bounds.py."""

import inspect
from contextlib import suppress
from functools import partial

import pytest

import core
from core import (
    Budget,
    Dance,
    Dragon,
    Route,
    Spiral,
    TooMuchWork,
    Turn,
    Waypoints,
    bench_poses,
    first_contact,
    minimum_pitch,
    trajectory,
)
from tests.support.depth import further
from tests.support.every_digit import every_digit
from tests.support.public_calls import CALLS, OF_SEVERAL
from tests.support.refused import refused
from tests.support.shared_dances import square

WHOLE = 1e12

SPIRAL = Dance(Dragon(30), Spiral(0.7, 8.0))
SIZED = {
    "poses": bench_poses(trajectory(SPIRAL, 100.0).position),
    "lengths": SPIRAL.dragon.lengths,
    "widths": SPIRAL.dragon.widths,
}
# Functions without a budget: their work grows only with arrays that their caller made.
SMALL = {"bench_outlines", "bench_poses", "card_of", "course", "separation", "verdicts"}
# Calls with more work than the short ones that they replace.
LARGER = {
    core.check: {"dance": SPIRAL, "venue": square(30)},
    core.clearance_profile: {"dance": SPIRAL, "times": [0.0, 9.0, 100.0]},
    core.first_contact: {"dance": SPIRAL},
    core.first_contacts: {"dances": [SPIRAL]},
    core.minimum_pitch: {"dragon": Dragon(30)},
    core.overlaps: SIZED,
    core.pitch_check: {"minimum": minimum_pitch(Dragon()), "dragon": Dragon()},
    core.quickest_turn: {"dragon": Dragon(6), "pitch": 1.7},
    core.venue_clearance: {"dance": SPIRAL, "venue": square(30), "stop": 50.0},
}
QUESTIONS = {
    call.__name__: partial(call, **arguments)
    for call, arguments in (CALLS | LARGER).items()
    if inspect.isfunction(call) and "budget" in inspect.signature(call).parameters
}
TAKING = {*QUESTIONS, "Route"} - {call.__name__ for call in OF_SEVERAL}
QUESTIONS["trajectory on a route"] = partial(trajectory, Dance(Dragon(30), Turn(1.7)), [0.0, 9.0])
QUESTIONS["first_contact with a stray"] = partial(first_contact, SPIRAL, stray=0.02)
QUESTIONS["Route"] = lambda budget: Route([Waypoints(((0, 0), (6, 1), (11, 6), (9, 13)))], budget=budget).table
ALL = pytest.mark.parametrize("name", QUESTIONS)


@ALL
def test_a_question_whose_work_is_stopped_or_spent_ends_and_says_which(name):
    stopped = Budget()
    spent = Budget(1.0)
    stopped.stop()
    spent.spend(1.0)
    for budget in (stopped, spent):
        with pytest.raises(TooMuchWork) as caught:
            QUESTIONS[name](budget=budget)
        assert bool(caught.value.field)
        assert caught.value.stopped == (budget is stopped)
        # What was stopped could have gone on: nothing that was asked for need be smaller.
        assert budget is spent or "must be" not in str(caught.value)


@pytest.mark.parametrize("name", [name for name in QUESTIONS if name != "Route"])
def test_a_number_is_no_budget(name):
    with refused("budget"):
        QUESTIONS[name](budget=1e6)


# The other calls first: these take more than a second.
SLOW = ("propose", "shortest_turn", "turn_length_bounds")


# A whole answer takes a minute: tests/core/design/test_followed_turn.py.
WHOLE_SOON = sorted(QUESTIONS.keys() - {"followed_turn"}, key=lambda name: (name in SLOW, name))


@pytest.mark.parametrize("name", further(WHOLE_SOON, len(WHOLE_SOON) - len(SLOW)))
def test_enough_work_changes_no_digit_and_less_ends_in_an_answer_or_in_too_much_work(name):
    budget = Budget(WHOLE)
    assert repr(every_digit(QUESTIONS[name](budget=budget))) == repr(every_digit(QUESTIONS[name](budget=None)))
    spent = WHOLE - budget.left
    assert 0.0 < spent < 1e9
    for part in (0.3, 0.6, 0.9):
        with suppress(TooMuchWork):
            QUESTIONS[name](budget=Budget(part * spent))


def test_a_budget_without_work_of_its_own_takes_the_default_of_the_question_and_stops_it():
    budget = Budget()
    assert budget.within(5.0).left == 5.0
    assert Budget(7.0).within(3.0).left == 7.0
    budget.within(1.0).spend(1.0)
    part = budget.within(3.0)
    assert part.left == 3.0  # each question its own
    budget.stop("before dinner")
    assert (part.stopped, part.then, budget.within(1.0).stopped) == (True, "before dinner", True)
    with pytest.raises(TooMuchWork, match="before dinner"):
        minimum_pitch(Dragon(20), budget=budget)


def test_every_public_question_about_a_dance_or_a_dragon_takes_a_budget():
    functions = {name for name in core.__all__ if inspect.isfunction(getattr(core, name))}
    taking = {name for name in functions if "budget" in getattr(core, name).__annotations__}
    assert taking | {"Route"} == TAKING
    assert functions - taking == SMALL, "take `budget`, and decorate it with question_about() of core/errors.py"

"""One budget through every question: spent or stopped from another thread, it ends any of them."""

from __future__ import annotations

import inspect
import math
import threading
import time
from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest

import core
from core import (
    Area,
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Route,
    Spiral,
    TooMuchWork,
    Turn,
    Venue,
    Waypoints,
    Wobble,
    bench_poses,
    check,
    clearance_profile,
    contact_check,
    contact_probability,
    cross_check,
    deepest_turn,
    dubins_turn,
    envelope,
    first_contact,
    first_excess,
    highest_speed,
    kernels,
    least_clearance,
    maximum_head_speed,
    minimum_pitch,
    overlaps,
    pitch_check,
    pitch_scan,
    propose,
    quick_check,
    quickest_turn,
    sharpest_bend,
    shortest_turn,
    tolerance,
    trajectory,
    turn_length_bounds,
    turn_time,
    venue_clearance,
)
from core.errors import format_field
from tests.support.every_digit import every_digit
from tests.support.public_calls import CALLS

# A question ends this soon after it was stopped, however busy the machine is [s].
ENDS_WITHIN = 1.0

SPIRAL = Dance(Dragon(30), Spiral(0.7, 8.0))
TURN = Dance(Dragon(30), Turn(1.7))
SQUARE = Venue(Area("square", (((-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0), (-30.0, -30.0)),)))
POSES = bench_poses(trajectory(SPIRAL, 100.0).position)
SIZES = (SPIRAL.dragon.lengths, SPIRAL.dragon.widths)
PITCHES = np.linspace(0.5, 0.6, 3)
LANE = Waypoints(((0, 0), (6, 1), (11, 6), (9, 13)))
CONTACT = first_contact(Dance(Dragon(), Spiral()))

# Functions without a budget: their work grows only with arrays that their caller made.
SMALL = {"bench_outlines", "bench_poses", "card_of", "course", "separation", "verdicts"}

Question = Callable[[Budget | None], Any]
# Every question that takes a budget; the calls here have more work than the short ones that they replace.
QUESTIONS: dict[str, Question] = {
    "trajectory": lambda budget: trajectory(SPIRAL, [0.0, 9.0], budget=budget),
    "trajectory on a route": lambda budget: trajectory(TURN, [0.0, 9.0], budget=budget),
    "first_contact": lambda budget: first_contact(SPIRAL, budget=budget),
    "clearance_profile": lambda budget: clearance_profile(SPIRAL, [0.0, 9.0, 100.0], budget=budget),
    "least_clearance": lambda budget: least_clearance(SPIRAL, budget=budget),
    "minimum_pitch": lambda budget: minimum_pitch(Dragon(30), budget=budget),
    "pitch_scan": lambda budget: pitch_scan(Dragon(30), PITCHES, budget=budget),
    "shortest_turn": lambda budget: shortest_turn(Dragon(12), 1.7, budget=budget),
    "deepest_turn": lambda budget: deepest_turn(Dragon(12), 1.7, budget=budget),
    "dubins_turn": lambda budget: dubins_turn(Dragon(6), 1.7, ratio=1.5, budget=budget),
    "quickest_turn": lambda budget: quickest_turn(Dragon(6), 1.7, speed_limit=2.0, budget=budget),
    "turn_time": lambda budget: turn_time(Dragon(12), Turn(1.7), speed_limit=2.0, budget=budget),
    "turn_length_bounds": lambda budget: turn_length_bounds(Dragon(12), 1.7, budget=budget),
    "highest_speed": lambda budget: highest_speed(TURN, budget=budget),
    "maximum_head_speed": lambda budget: maximum_head_speed(TURN, 2.0, budget=budget),
    "first_excess": lambda budget: first_excess(TURN, 1.5, budget=budget),
    "sharpest_bend": lambda budget: sharpest_bend(TURN, budget=budget),
    "propose": lambda budget: propose(SQUARE, Dragon(6), figures=["ring"], count=1, budget=budget),
    "check": lambda budget: check(SPIRAL, venue=SQUARE, budget=budget),
    "quick_check": lambda budget: quick_check(SPIRAL, venue=SQUARE, speed_limit=2.0, budget=budget),
    "venue_clearance": lambda budget: venue_clearance(SPIRAL, SQUARE, stop=50.0, budget=budget),
    "tolerance": lambda budget: tolerance(SPIRAL, SQUARE, stop=50.0, budget=budget),
    "envelope": lambda budget: envelope(SPIRAL, stop=2.0, budget=budget),
    "contact_probability": lambda budget: contact_probability(SPIRAL, Wobble(), 20, 1, stop=50.0, budget=budget),
    "first_contact with a stray": lambda budget: first_contact(SPIRAL, stray=0.02, budget=budget),
    "overlaps": lambda budget: overlaps(POSES, *SIZES, budget=budget),
    "cross_check": lambda budget: cross_check(POSES, *SIZES, budget=budget),
    "contact_check": lambda budget: contact_check(CONTACT, budget=budget),
    "pitch_check": lambda budget: pitch_check(minimum_pitch(Dragon()), Dragon(), budget=budget),
    "Route": lambda budget: Route([LANE], budget=budget).table,
}
QUESTIONS |= {
    call.__name__: lambda budget, call=call, values=values: call(**values, budget=budget)
    for call, values in CALLS.items()
    if inspect.isfunction(call) and "budget" in inspect.signature(call).parameters and call.__name__ not in QUESTIONS
}
ALL = pytest.mark.parametrize("name", QUESTIONS)


@ALL
def test_a_stopped_question_ends_and_says_what_was_too_much(name: str) -> None:
    budget = Budget()
    budget.stop()
    with pytest.raises(TooMuchWork, match=r" before it was stopped") as caught:
        QUESTIONS[name](budget)
    error = caught.value
    assert error.stopped
    assert error.message.startswith(f"{format_field(error.field)} must ")
    assert error.with_field("renamed").stopped


@ALL
def test_a_question_whose_work_is_spent_ends_and_says_how_much_that_was(name: str) -> None:
    budget = Budget(1.0)
    budget.spend(1.0)
    with pytest.raises(TooMuchWork, match=r" within 1 steps of work, each a bench placed or a pair of ben") as caught:
        QUESTIONS[name](budget)
    assert not caught.value.stopped
    assert not caught.value.with_field("renamed").stopped


@pytest.mark.parametrize("name", [name for name in QUESTIONS if name != "Route"])
def test_a_number_is_no_budget(name: str) -> None:
    with pytest.raises(InvalidValue, match=r"budget must be a Budget, got 1000000\.0"):
        QUESTIONS[name](cast(Budget, 1e6))


@pytest.mark.parametrize("work", [-1.0, math.nan])
def test_work_is_zero_or_more(work: float) -> None:
    with pytest.raises(ValueError, match=f"work must be zero or more, got {work:g}"):
        Budget(work)
    assert Budget(0.0).left == 0.0
    with pytest.raises(ValueError, match="work must be a number of steps, got 'many'"):
        Budget(cast(float, "many"))


@ALL
def test_a_budget_that_is_large_enough_changes_no_digit_and_is_spent(name: str) -> None:
    budget = Budget(1e12)
    assert repr(every_digit(QUESTIONS[name](budget))) == repr(every_digit(QUESTIONS[name](None)))
    assert 0.0 < 1e12 - budget.left < 1e9


@ALL
def test_work_that_ends_on_the_way_ends_in_an_answer_or_in_too_much_work(name: str) -> None:
    whole = Budget(1e12)
    QUESTIONS[name](whole)
    refusals = []
    for part in (0.3, 0.6, 0.9):
        try:
            QUESTIONS[name](Budget(part * (1e12 - whole.left)))
        except TooMuchWork as error:
            refusals.append(error.message)
    assert all(" steps of work, each a bench placed or a pair of benches tried" in one for one in refusals)


def test_a_budget_without_work_of_its_own_takes_the_default_of_the_question_and_stops_it() -> None:
    budget = Budget()
    assert budget.within(5.0).left == 5.0
    spent = budget.within(1.0)
    spent.spend(1.0)
    assert budget.within(3.0).left == 3.0  # each question its own
    part = budget.within(3.0)
    budget.stop("before dinner")
    assert (part.stopped, part.then, budget.within(1.0).stopped) == (True, "before dinner", True)
    assert Budget(7.0).within(3.0).left == 7.0
    with pytest.raises(TooMuchWork, match="before dinner"):
        minimum_pitch(Dragon(20), budget=budget)


def test_every_public_question_about_a_dance_or_a_dragon_takes_a_budget() -> None:
    request = {name.split()[0] for name in QUESTIONS}
    taking = {
        name
        for name in core.__all__
        if "budget" in getattr(getattr(core, name), "__annotations__", {})
        or (name == "Route" and "budget" in Route.__init__.__annotations__)
    }
    assert taking == request
    functions = {name for name in core.__all__ if inspect.isfunction(getattr(core, name))}
    assert functions - taking == SMALL, "take `budget`, and decorate it with question_about() of core/errors.py"


def stopped_after(seconds: float, question: Callable[[Budget], Any]) -> tuple[TooMuchWork, float]:
    """The error of a question that another thread stops after so long, and how long after that it came [s]."""
    budget, stopped = Budget(), [math.inf]

    def stop() -> None:
        stopped[0] = time.perf_counter()
        budget.stop()

    timer = threading.Timer(seconds, stop)
    timer.start()
    try:
        with pytest.raises(TooMuchWork) as caught:
            question(budget)
        return caught.value, time.perf_counter() - stopped[0]
    finally:
        timer.join()


TINY = Dragon(6308, head_length=0.001, body_length=0.001, overhang=0.0)
# Its last bench is longer than the others, so that the whole way out is followed.
LONG = Dragon.of([2.2] * 1999 + [2.3], [0.3] * 2000, [0.275] * 2000)
WIDE_TURN = Dance(LONG, Turn(10.0, 100.0, start_turns=200))
LONG = Dance(Dragon(20_000), Route([Line((0.0, 0.0), (1e5, 0.0))], start=0.0))
# Questions that take long, and when they are stopped [s].
LONG_QUESTIONS: dict[str, tuple[float, Question]] = {
    "head speed in a turn of 200 m": (0.1, lambda budget: maximum_head_speed(WIDE_TURN, 2.0, budget=budget)),
    "pitch of benches of a millimetre, soon": (0.1, lambda budget: minimum_pitch(TINY, budget=budget)),
    "pitch of benches of a millimetre": (1.0, lambda budget: minimum_pitch(TINY, budget=budget)),
    "shortest turn of a short head": (
        0.1,
        lambda budget: shortest_turn(Dragon(head_length=1.001), 1.7, ratio=1.0, budget=budget),
    ),
    "trajectory of 20,000 benches": (0.1, lambda budget: trajectory(LONG, np.arange(6e4, 6.1e4), budget=budget)),
    "profile of 20,000 benches": (0.1, lambda budget: clearance_profile(LONG, np.arange(6e4, 7e4), budget=budget)),
}


@pytest.mark.skipif(not kernels.COMPILED, reason="the kernels run uncompiled")
@pytest.mark.parametrize("name", LONG_QUESTIONS)
def test_a_long_question_ends_soon_after_another_thread_stopped_it(name: str) -> None:
    error, late = stopped_after(*LONG_QUESTIONS[name])
    assert error.stopped
    assert late < ENDS_WITHIN


def test_a_budget_may_be_larger_or_smaller_than_a_question_has_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    budget = Budget(1e12)
    result = minimum_pitch(Dragon(20), budget=budget)
    spent = 1e12 - budget.left
    monkeypatch.setattr(core.design.ways, "PITCH_WORK", 0.5 * spent)
    with pytest.raises(TooMuchWork, match=rf"within {0.5 * spent:g} steps"):
        minimum_pitch(Dragon(20))
    assert every_digit(minimum_pitch(Dragon(20), budget=Budget(2.0 * spent))) == every_digit(result)

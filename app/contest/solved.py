"""The five questions of the contest, solved: what every file of the kit is made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import core
from app.questions.question import Terms
from app.wire.dances import DanceQuery
from app.wire.models import Instant, SpeedLimit, TurningDiameter, measure
from core import Dance, Dragon, Outcome, Trajectory, Turn
from core.values import Floats

# Handles of the tables in the paper, as the contest asks: the head, those of six bodies, and the rear of the tail.
SHOWN_HANDLES = (0, 1, 51, 101, 151, 201)
# Number of steps between the instants of those tables; of the turn, between -span and span.
SHOWN_STEPS, TURN_STEPS = 5, 4


class ContestRequest(DanceQuery):
    """The numbers of the problem; the defaults are the contest's."""

    stop: Instant = measure("s", "Last second of question 1", 300.0, gt=0)
    turning_diameter: TurningDiameter = measure("m", "Diameter of the turning circle of questions 3 and 4", 9.0)
    turn_pitch: float = measure("m", "Pitch of the coils of question 4", 1.7, ge=1e-3, le=10)
    ratio: float = measure("1", "Radius of the first arc divided by that of the second", 2.0, ge=0.01, le=100)
    span: Instant = measure("s", "Question 4 is shown from this long before the turn to this long after", 100.0, gt=0)
    speed_limit: SpeedLimit = measure("m/s", "Highest speed of any handle in question 5", 2.0)


@dataclass(frozen=True)
class Solved:
    """Inputs and answers of the five questions, in metres and seconds.

    spiral, turning: the dances of questions 1 to 3, and of 4 and 5
    inwards: every second of question 1; meeting: the instant of first contact (`met_at`), of which `contact` tells;
        around: every second of question 4
    """

    asked: ContestRequest
    spiral: Dance
    turning: Dance
    inwards: Trajectory
    contact: core.FirstContact
    met_at: float
    meeting: Trajectory
    pitch: core.MinimumPitch
    turn: Turn
    shortest: core.ShortestTurn
    around: Trajectory
    fastest: core.MaximumHeadSpeed

    @property
    def dragon(self) -> Dragon:
        return self.spiral.dragon

    @property
    def handles(self) -> list[int]:
        """The handles that the paper shows; of a short dragon those that it has."""
        return sorted({k for k in (*SHOWN_HANDLES, self.dragon.benches) if k <= self.dragon.benches})

    @property
    def shown_times(self) -> Floats:
        """Instants of question 1 that the paper shows [s]."""
        return np.linspace(0.0, self.asked.stop, SHOWN_STEPS + 1)

    @property
    def turn_times(self) -> Floats:
        """Instants of question 4 that the paper shows [s]."""
        return np.linspace(-self.asked.span, self.asked.span, TURN_STEPS + 1)


def solve(asked: ContestRequest, terms: Terms, progress: Callable[[float], None]) -> Solved:
    """All five answers. raises: InvalidValue, OutsideRun, TooMuchWork"""
    dragon = asked.to_dragon(terms.settings.checked_benches_max)
    spiral = Dance(dragon, asked.to_path(), asked.head_speed)
    turn = Turn(asked.turn_pitch, asked.turning_diameter / 2, asked.ratio, start_turns=asked.start_turns)
    turning = Dance(dragon, turn, asked.head_speed)
    inwards = core.trajectory(spiral, seconds(0.0, spiral.span(0.0, asked.stop)[1]), budget=terms.budget)
    progress(0.1)
    contact = core.first_contact(spiral, budget=terms.budget)
    met_at = instant_of(contact)
    progress(0.2)
    least = core.minimum_pitch(
        dragon, turning_radius=asked.turning_diameter / 2, start_turns=asked.start_turns, budget=terms.budget
    )
    progress(0.4)
    shortest = core.shortest_turn(
        dragon, asked.turn_pitch, asked.turning_diameter / 2, asked.ratio, start_turns=asked.start_turns,
        budget=terms.budget,
    )  # fmt: skip
    progress(0.7)
    fastest = core.maximum_head_speed(turning, asked.speed_limit, budget=terms.budget)
    return Solved(
        asked=asked,
        spiral=spiral,
        turning=turning,
        inwards=inwards,
        contact=contact,
        met_at=met_at,
        meeting=core.trajectory(spiral, [met_at], budget=terms.budget),
        pitch=least,
        turn=turn,
        shortest=shortest,
        around=core.trajectory(turning, seconds(-asked.span, asked.span), budget=terms.budget),
        fastest=fastest,
    )


def seconds(start: float, stop: float) -> Floats:
    """start, start + 1 s, ... up to stop [s]."""
    return start + np.arange(int(np.floor(stop - start + 1e-9)) + 1, dtype=np.float64)


def instant_of(contact: core.FirstContact) -> float:
    """When benches first touch; else the last instant that is proven clear, or the end of the run less a moment [s]."""
    if contact.time is not None:
        return contact.time
    if contact.outcome is Outcome.UNDECIDED and contact.time_bracket:
        return contact.time_bracket[0]
    assert contact.end is not None
    return contact.end.time - 1e-6

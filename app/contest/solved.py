"""Solutions of the contest's five questions: the source of every file of the kit."""

from __future__ import annotations

from collections.abc import Collection
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from pydantic import Field

import core
from app.files.tables import PAPER_HANDLES, handle_titles
from app.wire.fields import DanceQuery, Instant, SpeedLimit, TurningDiameter, measure
from app.wire.question import Terms
from core import Budget, Dance, Dragon, InvalidValue, Outcome, Trajectory, Turn
from core.values import Floats, Progress

# Number of intervals between the instants of the tables that the contest requires; for the turn, from -span to span.
TABLE_STEPS, TURN_STEPS = 5, 4
# Ratio of equal arcs [1], which makes the turn shortest: both arcs are as tight as the benches allow.
EVEN = 1.0
# The question for which each answer is computed; the last one takes longest.
OF_SPIRAL = {"inwards": 1, "contact": 2, "pitch": 3}
OF_TURN = {"fastest": 5, "around": 4, "shortest": 4, "times": 4, "even": 4}


class ContestRequest(DanceQuery):
    """The numbers of the problem; the defaults are the contest's."""

    stop: Instant = measure("s", "Last second of question 1", 300.0, gt=0)
    turning_diameter: TurningDiameter = measure("m", "Diameter of the turning circle of questions 3 and 4", 9.0)
    turn_pitch: float = measure("m", "Pitch of the coils of question 4", 1.7, ge=1e-3, le=10)
    ratio: float = Field(2.0, ge=0.01, le=100, description="Radius of the first arc divided by that of the second")
    span: Instant = measure("s", "Time before and after the turn that question 4 shows", 100.0, gt=0)
    speed_limit: SpeedLimit = measure("m/s", "Highest speed of any handle in question 5", 2.0)

    @property
    def turning_radius(self) -> float:
        return self.turning_diameter / 2

    def to_turn(self) -> Turn:
        """The turn of question 4. raises: InvalidValue"""
        return Turn(self.turn_pitch, self.turning_radius, self.ratio, start_turns=self.start_turns)

    def least_pitch(self, dragon: Dragon, budget: Budget) -> core.MinimumPitch:
        """The answer to question 3. raises: InvalidValue"""
        return core.minimum_pitch(
            dragon, turning_radius=self.turning_radius, start_turns=self.start_turns, budget=budget
        )


@dataclass(frozen=True)
class Turned:
    """Inputs and answers of questions 4 and 5, each answer computed when it is first read.

    dance: along the turn
    """

    request: ContestRequest
    path: Turn
    dance: Dance
    budget: Budget

    @cached_property
    def shortest(self) -> core.ShortestTurn:
        """The shortest turn with the ratio asked for. raises: InvalidValue if there is none"""
        return self._shortest(self.request.ratio)

    @cached_property
    def even(self) -> core.ShortestTurn | None:
        """The shortest one with equal arcs, None where it cannot be danced."""
        with suppress(InvalidValue):  # Equal arcs may be too tight even with the entry on the circle.
            return self._shortest(EVEN)
        return None

    @cached_property
    def times(self) -> list[core.TurnTime]:
        """Of the turn of question 4, of the shortest and of the quickest one with its ratio, at the speed limit."""
        limit, danced = self.request.speed_limit, list[core.Turn | core.ClothoidTurn]([self.path, self.shortest.turn])
        with suppress(InvalidValue):  # no turn that was tried can be danced
            quickest = core.quickest_turn(
                *self._inside, self.request.ratio, start_turns=self.request.start_turns, speed_limit=limit,
                budget=self.budget,
            )  # fmt: skip
            danced.append(quickest.turn)
        return [core.turn_time(self.dance.dragon, turn, limit, budget=self.budget) for turn in danced]

    @cached_property
    def around(self) -> Trajectory:
        """Every second of question 4."""
        return core.trajectory(self.dance, seconds(-self.request.span, self.request.span), budget=self.budget)

    @cached_property
    def fastest(self) -> core.MaximumHeadSpeed:
        return core.maximum_head_speed(self.dance, self.request.speed_limit, budget=self.budget)

    @property
    def _inside(self) -> tuple[Dragon, float, float]:
        return self.dance.dragon, self.request.turn_pitch, self.request.turning_radius

    def _shortest(self, ratio: float) -> core.ShortestTurn:
        return core.shortest_turn(*self._inside, ratio, start_turns=self.request.start_turns, budget=self.budget)


@dataclass
class Solved:
    """Inputs and answers of the five questions, in metres and seconds, each answer computed when it is first read.

    spiral: the dance of questions 1 to 3
    turned: None where no turn can be danced, with the reason why_no_turn
    budget: of all that is computed from these answers
    """

    request: ContestRequest
    spiral: Dance
    turned: Turned | None
    budget: Budget
    why_no_turn: str = ""

    @cached_property
    def inwards(self) -> Trajectory:
        """Every second of question 1."""
        stop = self.spiral.span(0.0, self.request.stop)[1]
        return core.trajectory(self.spiral, seconds(0.0, stop), budget=self.budget)

    @cached_property
    def contact(self) -> core.FirstContact:
        """The answer of the search of question 2."""
        return core.first_contact(self.spiral, budget=self.budget)

    @property
    def met_at(self) -> float:
        """Time of first contact; else the last instant proven clear, or just before the end of the run [s]."""
        contact = self.contact
        if contact.time is not None:
            return contact.time
        if contact.outcome is Outcome.UNDECIDED and contact.time_bracket:
            return contact.time_bracket[0]
        assert contact.end is not None
        return contact.end.time - 1e-6

    @cached_property
    def meeting(self) -> Trajectory:
        """The dance at the instant `met_at`."""
        return core.trajectory(self.spiral, [self.met_at], budget=self.budget)

    @cached_property
    def pitch(self) -> core.MinimumPitch:
        return self.request.least_pitch(self.dragon, self.budget)

    @property
    def dragon(self) -> Dragon:
        return self.spiral.dragon

    @property
    def stop(self) -> float:
        """The last second of question 1 [s]."""
        return float(self.inwards.time[-1])

    @property
    def names(self) -> list[str]:
        """Names of all handles."""
        return handle_titles(self.dragon.benches)

    @property
    def handles(self) -> list[int]:
        """The handles in the tables; for a short dragon those that it has."""
        return sorted({k for k in (*PAPER_HANDLES, self.dragon.benches) if k <= self.dragon.benches})

    @property
    def table_times(self) -> Floats:
        """Instants of question 1 in the tables [s]."""
        return np.linspace(0.0, self.request.stop, TABLE_STEPS + 1)

    @property
    def turn_times(self) -> Floats:
        """Instants of question 4 in the tables [s]."""
        return np.linspace(-self.request.span, self.request.span, TURN_STEPS + 1)


def solve(
    request: ContestRequest, terms: Terms, progress: Progress, question: int | None = None, names: Collection[str] = ()
) -> Solved:
    """The answers, of which those to a question are ready. question: None for all five; names: the only ones, if any

    raises: InvalidValue, also for a question about a turn where none can be danced; OutsideRun, TooMuchWork
    """
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    spiral = Dance(dragon, request.to_path(), request.head_speed)
    on_spiral, on_turn = (
        [name for name, number in known.items() if question in (None, number) and name in (names or known)]
        for known in (OF_SPIRAL, OF_TURN)
    )
    solved = Solved(request, spiral, None, terms.budget)
    for name in on_spiral:
        getattr(solved, name)
    if not on_turn:
        return solved
    try:
        path = request.to_turn()
        solved.turned = Turned(request, path, Dance(dragon, path, request.head_speed), terms.budget)
        for k, name in enumerate(on_turn):
            progress(k / len(on_turn))
            getattr(solved.turned, name)
    except InvalidValue as error:
        if question is not None:
            raise
        solved.turned, solved.why_no_turn = None, error.message
    progress(1.0)
    return solved


def seconds(start: float, stop: float) -> Floats:
    """start, start + 1 s, ... up to stop [s]."""
    return start + np.arange(int(np.floor(stop - start + 1e-9)) + 1, dtype=np.float64)

"""Solutions of the contest's five questions: the source of every file of the kit."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

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
    """Inputs and answers of questions 4 and 5.

    dance: along the turn; shortest: with the ratio asked for; even: with equal arcs, None where it cannot be danced
    times: of the turn of question 4, of the shortest and of the quickest one with its ratio, at the speed limit
    around: every second of question 4
    """

    path: Turn
    dance: Dance
    shortest: core.ShortestTurn
    even: core.ShortestTurn | None
    times: list[core.TurnTime]
    around: Trajectory
    fastest: core.MaximumHeadSpeed


@dataclass(frozen=True)
class Solved:
    """Inputs and answers of the five questions, in metres and seconds.

    spiral: the dance of questions 1 to 3
    inwards: every second of question 1; meeting: the instant `met_at` of first contact; contact: the search's answer
    turned: None where no turn can be danced, with the reason why_no_turn
    budget: of all that is computed from these answers
    """

    request: ContestRequest
    spiral: Dance
    inwards: Trajectory
    contact: core.FirstContact
    met_at: float
    meeting: Trajectory
    pitch: core.MinimumPitch
    turned: Turned | None
    budget: Budget
    why_no_turn: str = ""

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


def solve(request: ContestRequest, terms: Terms, progress: Progress, *, turns: bool = True) -> Solved:
    """All five answers. turns: False leaves out questions 4 and 5; raises: InvalidValue, OutsideRun, TooMuchWork"""
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    spiral = Dance(dragon, request.to_path(), request.head_speed)
    inwards = core.trajectory(spiral, seconds(0.0, spiral.span(0.0, request.stop)[1]), budget=terms.budget)
    progress(0.1)
    contact = core.first_contact(spiral, budget=terms.budget)
    met_at = instant_of(contact)
    progress(0.2)
    least = request.least_pitch(dragon, terms.budget)
    progress(0.4)
    turned, why = None, ""
    try:
        turned = _turned(request, dragon, terms) if turns else None
    except InvalidValue as error:
        why = error.message
    progress(1.0)
    meeting = core.trajectory(spiral, [met_at], budget=terms.budget)
    return Solved(
        request,
        spiral,
        inwards=inwards,
        contact=contact,
        met_at=met_at,
        meeting=meeting,
        pitch=least,
        turned=turned,
        budget=terms.budget,
        why_no_turn=why,
    )


def _turned(request: ContestRequest, dragon: Dragon, terms: Terms) -> Turned:
    """Questions 4 and 5. raises: InvalidValue if the turn cannot be danced"""
    path = request.to_turn()
    dance = Dance(dragon, path, request.head_speed)
    inside, turns = (dragon, request.turn_pitch, request.turning_radius), request.start_turns
    shortest = core.shortest_turn(*inside, request.ratio, start_turns=turns, budget=terms.budget)
    even = None
    with suppress(InvalidValue):  # Equal arcs may be too tight even with the entry on the circle.
        even = core.shortest_turn(*inside, EVEN, start_turns=turns, budget=terms.budget)
    around = core.trajectory(dance, seconds(-request.span, request.span), budget=terms.budget)
    fastest = core.maximum_head_speed(dance, request.speed_limit, budget=terms.budget)
    danced: list[core.Turn | core.ClothoidTurn] = [path, shortest.turn]
    with suppress(InvalidValue):  # no turn that was tried can be danced
        limit = request.speed_limit
        quickest = core.quickest_turn(*inside, request.ratio, start_turns=turns, speed_limit=limit, budget=terms.budget)
        danced.append(quickest.turn)
    times = [core.turn_time(dragon, turn, request.speed_limit, budget=terms.budget) for turn in danced]
    return Turned(path, dance, shortest=shortest, even=even, times=times, around=around, fastest=fastest)


def seconds(start: float, stop: float) -> Floats:
    """start, start + 1 s, ... up to stop [s]."""
    return start + np.arange(int(np.floor(stop - start + 1e-9)) + 1, dtype=np.float64)


def instant_of(contact: core.FirstContact) -> float:
    """Time of first contact; else the last instant proven clear, or an instant just before the end of the run [s]."""
    if contact.time is not None:
        return contact.time
    if contact.outcome is Outcome.UNDECIDED and contact.time_bracket:
        return contact.time_bracket[0]
    assert contact.end is not None
    return contact.end.time - 1e-6

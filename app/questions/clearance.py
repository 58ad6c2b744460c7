"""The question clearance: the smallest distance between two benches over time."""

from __future__ import annotations

from pydantic import Field

import core
from app.wire.answers import Columns, Graze, Pair
from app.wire.dances import TimedDance, TimeRange
from app.wire.question import Answer, DanceQuery, Question, Terms, measure

# Time that one bench at one instant takes, measured 2026-11-22 [s].
SECONDS_PER_CELL = 3e-6


class ClearanceQuery(TimeRange, DanceQuery):
    """Smallest distance between two benches over time, on a spiral."""


class ClearanceRequest(TimedDance):
    """Smallest distance between two benches over time, on any path."""


class ClearanceTable(Answer):
    """Columns with one entry per instant, and the local minima between the instants."""

    time: list[float] = measure("s", "Instants")
    clearance: list[float] = measure("m", "Smallest separation of two benches that are not neighbours")
    benches: list[Pair] = Field(description="The pair with that separation")
    grazes: list[Graze] = Field(description="Local minima between the first and the last instant, refined")


def clearance(request: ClearanceQuery | ClearanceRequest, terms: Terms) -> Columns:
    """Smallest separation of two benches that are not neighbours, and the pair, at every instant."""
    result = profile_of(request, terms)
    columns = {"time": result.time, "clearance": result.clearance, "benches": result.benches}
    return Columns(columns | {"grazes": result.grazes})


def profile_of(request: ClearanceQuery | ClearanceRequest, terms: Terms) -> core.ClearanceProfile:
    """The clearance as an object of core. raises: TooLarge, InvalidValue"""
    flat = isinstance(request, ClearanceQuery)
    dance = request.to_dance(terms.settings.benches_max if flat else terms.settings.checked_benches_max)
    return core.clearance_profile(dance, request.times_of(dance, terms.settings.cells_max), budget=terms.budget)


def _cost(request: ClearanceQuery | ClearanceRequest) -> float:
    return request.instants() * request.benches * SECONDS_PER_CELL


QUESTION = Question(clearance, ClearanceTable, flat=ClearanceQuery, body=ClearanceRequest, cost=_cost)

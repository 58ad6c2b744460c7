"""How near do two benches come over time?"""

from __future__ import annotations

from pydantic import Field

import core
from app.questions.question import Question
from app.settings import Settings
from app.wire.answers import Columns, Graze, Pair
from app.wire.dances import DanceQuery, TimedDance, TimeRange, TimeSteps
from app.wire.models import Answer, measure

# Time that one bench at one instant takes, measured 2026-11-22 [s].
SECONDS_PER_CELL = 3e-6


class ClearanceQuery(TimeRange, DanceQuery):
    """How near do two benches come over time?"""


class ClearanceRequest(TimedDance):
    """How near do two benches come over time, on any path?"""


class ClearanceTable(Answer):
    """Columns: one entry per instant; and what lies between them."""

    time: list[float] = measure("s", "Instants, T of them")
    clearance: list[float] = measure("m", "Smallest separation of two benches that are no neighbours")
    benches: list[Pair] = Field(description="The pair that is so near")
    grazes: list[Graze] = Field(description="Local minima between the first and the last instant, refined")


def clearance(asked: ClearanceQuery | ClearanceRequest, settings: Settings) -> Columns:
    """Smallest separation of two benches that are no neighbours, and whose, at every instant."""
    flat = isinstance(asked, ClearanceQuery)
    dance = asked.to_dance(settings.benches_max if flat else settings.checked_benches_max)
    found = core.clearance_profile(dance, asked.times_of(dance, settings.cells_max))
    columns = {"time": found.time, "clearance": found.clearance, "benches": found.benches}
    return Columns(columns | {"grazes": found.grazes})


def _cost(asked: ClearanceQuery | ClearanceRequest) -> float:
    times = (asked if isinstance(asked, ClearanceQuery) else asked.times) or TimeSteps()
    instants = len(times) if isinstance(times, list) else times.instants()
    return instants * asked.benches * SECONDS_PER_CELL


QUESTION = Question(clearance, ClearanceTable, flat=ClearanceQuery, body=ClearanceRequest, cost=_cost)

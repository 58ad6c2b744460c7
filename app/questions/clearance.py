"""The question clearance: the smallest distance between two benches over time, of one dragon or of two."""

from __future__ import annotations

from collections.abc import Iterator

import core
from app.questions.encounter import NearPass
from app.wire.answers import Columns
from app.wire.dances import TimedDance, TimeRange
from app.wire.fields import Answer, DanceQuery, Wire
from app.wire.labels import Part, TextTable, label, separation, value_text
from app.wire.performances import SeveralDances
from app.wire.question import Command, Question, Terms
from core.language import say
from core.quantities import format_number
from core.values import Pair

# Time that one bench at one instant takes, measured 2026-11-22 [s].
SECONDS_PER_CELL = 3e-6


class ClearanceQuery(TimeRange, DanceQuery):
    """Smallest distance between two benches over time, on a spiral."""


class DanceClearance(TimedDance):
    """Smallest distance between two benches of a dragon over time, on any path."""


class ClearanceRequest(SeveralDances, DanceClearance):
    """Smallest distance between two benches over time, on any path; of several dragons, between two of them."""


class ClearanceTable(Answer, of=core.ClearanceProfile):
    """Columns with one entry per instant, and the local minima between the instants."""

    time: list[float]
    clearance: list[float]
    benches: list[Pair]
    grazes: list[core.Graze]


class PerformanceClearanceTable(Answer, of=core.PerformanceClearance):
    """Columns with one entry per instant, and the local minima between the instants."""

    time: list[float]
    clearance: list[float]
    dragons: list[Pair]
    benches: list[Pair]
    grazes: list[NearPass]


def clearance(request: ClearanceQuery | DanceClearance, terms: Terms) -> Columns:
    """Smallest separation of two benches that are not neighbours, and the pair, at every instant."""
    if isinstance(request, ClearanceRequest) and request.dances is not None:
        between = between_dragons(request, terms)
        names = ("time", "clearance", "dragons", "benches", "grazes")
        return Columns({name: getattr(between, name) for name in names})
    result = profile_of(request, terms)
    columns = {"time": result.time, "clearance": result.clearance, "benches": result.benches}
    return Columns(columns | {"grazes": result.grazes})


def between_dragons(request: ClearanceRequest, terms: Terms) -> core.PerformanceClearance:
    """The clearance between dragons as an object of core. raises: TooLarge, InvalidValue"""
    performance = request.to_performance(terms.settings)
    times = request.times_of(performance, terms.settings.cells_max)
    return core.clearance_profile(performance, times, budget=terms.budget)


def profile_of(request: ClearanceQuery | DanceClearance, terms: Terms) -> core.ClearanceProfile:
    """The clearance as an object of core. raises: TooLarge, InvalidValue"""
    flat = isinstance(request, ClearanceQuery)
    dance = request.to_dance(terms.settings.benches_max if flat else terms.settings.checked_benches_max)
    return core.clearance_profile(dance, request.times_of(dance, terms.settings.cells_max), budget=terms.budget)


def _cost(request: ClearanceQuery | DanceClearance) -> float:
    return request.instants() * request.benches * SECONDS_PER_CELL


def _parts(answer: Columns, request: Wire) -> Iterator[Part]:
    """Clearance at every instant, and the local minima between them."""
    columns = answer.columns
    pairs = [name for name in ("dragons", "benches") if name in columns]
    heads = label("time", "s"), label("clearance", "m"), *map(label, pairs)
    table = TextTable(say("Clearance"), *heads)
    for time, clearance, *pair in zip(*(columns[name] for name in ("time", "clearance", *pairs)), strict=True):
        table.add(format_number(time), separation(clearance), *(value_text(tuple(one.tolist())) for one in pair))
    yield table
    grazes = TextTable(say("Local minima"), *heads)
    for graze in columns["grazes"]:
        pair = [value_text(getattr(graze, name)) for name in pairs]
        grazes.add(value_text(graze.time), separation(graze.clearance), *pair)
    yield grazes if columns["grazes"] else say("No local minimum between the first and the last instant.")


QUESTION = Question(
    clearance,
    ClearanceTable,
    flat=ClearanceQuery,
    body=ClearanceRequest,
    cost=_cost,
    several=PerformanceClearanceTable,
    command=Command(
        "Smallest distance between two benches that share no handle, and the pair, at every instant.\n\n"
        "Of a FILE of several dragons, between benches of two of them.",
        lambda request: say("Clearance"),
        _parts,
    ),
)

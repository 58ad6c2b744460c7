"""Rows for questions with lists as answers: the numbers of each answer in a table of many designs."""

from __future__ import annotations

import numpy as np
from pydantic import Field

import core
from app.questions import clearance, overlaps
from app.questions.check import LeastClearance
from app.questions.trajectory import TrajectoryRequest
from app.wire.answers import Pair
from app.wire.dances import DanceFields
from app.wire.question import Answer, DanceQuery, Terms, measure
from core import InvalidValue


class ClearanceRow(Answer):
    """The smallest clearance between the first and the last instant of the request."""

    clearance: float = measure("m", "Smallest separation of two benches that are not neighbours")
    time: float = measure("s", "Time of that clearance")
    benches: Pair = Field(description="The pair with that separation")


class TrajectoryRow(Answer):
    """The two ends of the dragon at the last instant of the request, and the speeds at all instants."""

    time: float = measure("s", "Last instant")
    head_x: float = measure("m", "Of the first handle, at the last instant")
    head_y: float = measure("m", "As head_x")
    tail_x: float = measure("m", "Of the last handle, at the last instant")
    tail_y: float = measure("m", "As tail_x")
    tail_speed: float = measure("m/s", "Of the last handle, at the last instant")
    least_speed: float = measure("m/s", "Of any handle at any instant")
    greatest_speed: float = measure("m/s", "Of any handle at any instant")


class OverlapsRow(Answer):
    """The number of overlapping pairs, and the deepest overlap."""

    pairs: int = Field(description="Pairs that overlap, or are nearer than the margin")
    separation: float | None = measure("m", "Smallest separation of these pairs; null: there is no such pair")
    benches: Pair | None = Field(description="The pair with that separation")
    agree: bool = Field(description="True if all engines found the same pairs")


def clearance_row(asked: clearance.ClearanceQuery | clearance.ClearanceRequest, terms: Terms) -> ClearanceRow:
    """The smallest clearance of a dance, at the instants or at a local minimum between them."""
    found = clearance.profile(asked, terms)
    k = int(found.clearance.argmin())
    at = core.Graze(float(found.time[k]), float(found.clearance[k]), tuple(found.benches[k].tolist()))
    return ClearanceRow.known(min([at, *found.grazes], key=lambda graze: graze.clearance))


def trajectory_row(asked: TrajectoryRequest, terms: Terms) -> TrajectoryRow:
    """The ends of the dragon at the last instant, and the speeds. raises: InvalidValue without an instant"""
    dance = asked.to_dance(terms.settings.benches_max)
    times = asked.times_of(dance, terms.settings.cells_max)
    if not times.size:
        raise InvalidValue("times", "must have at least one instant for a row, got none")
    found = core.trajectory(dance, times, budget=terms.budget)
    head, tail = found.position[-1, 0], found.position[-1, -1]
    return TrajectoryRow(
        time=times[-1],
        head_x=head[0],
        head_y=head[1],
        tail_x=tail[0],
        tail_y=tail[1],
        tail_speed=found.speed[-1, -1],
        least_speed=np.min(found.speed),
        greatest_speed=np.max(found.speed),
    )


def overlaps_row(asked: overlaps.OverlapsRequest, terms: Terms) -> OverlapsRow:
    """The number of overlapping pairs, and the pair with the deepest overlap."""
    found = overlaps.overlaps(asked, terms)
    deepest = min(found.overlaps, key=lambda pair: pair.separation, default=None)
    return OverlapsRow(
        pairs=len(found.overlaps),
        separation=deepest and deepest.separation,
        benches=deepest and deepest.benches,
        agree=found.cross_check.agree,
    )


def least_clearance(asked: DanceQuery | DanceFields, terms: Terms) -> LeastClearance:
    """The least separation of two benches that share no handle, over the whole dance."""
    found = core.least_clearance(asked.to_dance(terms.settings.checked_benches_max), budget=terms.budget)
    if found is None:
        raise InvalidValue.of("dragon.benches", "must be at least 3 for two to share no handle", asked.benches, "")
    return LeastClearance.model_validate(found)

"""The question overlaps: overlapping benches at one instant."""

from __future__ import annotations

import numpy as np
from pydantic import Field

import core
from app.questions.figures import InstantQuery
from app.wire.answers import LEFT_OUT, Pair, Point
from app.wire.question import Answer, Coordinate, Length, Margin, Question, Terms, Width, Wire, check_limit, measure
from core import Engine
from core.values import Floats


class BenchPose(Wire, strict=True):
    """One bench, anywhere."""

    x: Coordinate = measure("m", "Centre")
    y: Coordinate = measure("m", "Centre")
    heading: float = measure("rad", "Direction, counter-clockwise from the x axis", ge=-1000, le=1000)
    length: Length = measure("m", "Length along the heading")
    width: Width = measure("m", "Width across the heading")


class OverlapsRequest(Wire, strict=True):
    """Overlapping pairs of benches."""

    benches: list[BenchPose] = Field(min_length=1, fail_fast=True, description="The benches, in order")
    margin: Margin = 0.0
    chained: bool = Field(True, description="Consecutive benches are neighbours: they are never a checked pair")

    def to_poses(self, poses_max: int) -> tuple[Floats, Floats, Floats]:
        """Poses (n, 3), lengths (n,) [m] and widths (n,) [m]. raises: TooLarge"""
        check_limit(
            "benches",
            "benches must be at most {most} here",
            len(self.benches),
            poses_max,
            "ask for fewer in one request",
        )
        rows = np.array([(b.x, b.y, b.heading, b.length, b.width) for b in self.benches], dtype=np.float64)
        return rows[:, :3], rows[:, 3], rows[:, 4]


class Overlap(Answer, of=core.Separation):
    """Two benches within the margin, or overlapping if it is 0. witness_b - witness_a = separation * normal."""

    benches: Pair = Field(description="The pair a, b")
    separation: float
    witness_a: Point
    witness_b: Point
    normal: Point


class OverlapsCheck(Answer):
    """Independent engines side by side."""

    agree: bool = Field(description="True if all engines that were asked found the same pairs")
    engines: dict[Engine, list[Pair]] = Field(description="Pairs found by each engine")
    left_out: list[Engine] = Field(description=LEFT_OUT)


class OverlapsAnswer(Answer):
    """All pairs with separation <= margin."""

    overlaps: list[Overlap] = Field(description="The pairs, sorted")
    cross_check: OverlapsCheck = Field(description="Independent engines side by side")


def overlaps(request: OverlapsRequest, terms: Terms) -> OverlapsAnswer:
    """Benches that overlap or come within a margin, with depth and place, according to four engines."""
    poses, lengths, widths = request.to_poses(terms.settings.poses_max)
    return _overlaps_of(poses, lengths, widths, terms, margin=request.margin, chained=request.chained)


def of_dance(request: InstantQuery, terms: Terms) -> OverlapsAnswer:
    """The overlaps of the benches of a dance at one instant."""
    dance = request.to_dance(terms.settings.poses_max)
    handles = core.trajectory(dance, [request.time], budget=terms.budget).position[0]
    dragon, poses = dance.dragon, core.bench_poses(handles)
    return _overlaps_of(poses, dragon.lengths, dragon.widths, terms, margin=request.margin, chained=True)


def _overlaps_of(
    poses: Floats, lengths: Floats, widths: Floats, terms: Terms, *, margin: float, chained: bool
) -> OverlapsAnswer:
    """The overlaps of benches, and the verdict of each engine on them. raises: TooLarge, InvalidValue"""
    result = core.overlaps(poses, lengths, widths, margin=margin, chained=chained, budget=terms.budget)
    check_limit(
        "benches",
        "overlapping pairs must be at most {most} here",
        len(result.pairs),
        terms.settings.pairs_max,
        "move them apart",
    )
    check = core.cross_check(poses, lengths, widths, margin=margin, chained=chained, budget=terms.budget)
    names, contact = tuple(Overlap.model_fields), result.contact
    columns = (contact.separation, contact.witness_a, contact.witness_b, contact.normal)
    # Adding 0.0 turns -0.0 into 0.0.
    rows = zip(result.pairs.tolist(), *((column + 0.0).tolist() for column in columns), strict=True)
    pairs = [Overlap(**dict(zip(names, row, strict=True))) for row in rows]
    engines = {engine: known.tolist() for engine, known in check.pairs.items()}
    return OverlapsAnswer(overlaps=pairs, cross_check=OverlapsCheck.from_result(check, engines=engines))


def _cost(request: OverlapsRequest) -> float:
    benches = len(request.benches)
    return 4e-5 * benches + 5e-6 * min(benches * benches / 2, 20_000)


QUESTION = Question(overlaps, OverlapsAnswer, body=OverlapsRequest, cost=_cost)

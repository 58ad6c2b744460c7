"""The question overlaps: overlapping benches at one instant."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

import core
from app.questions.figures import InstantQuery
from app.wire.answers import LEFT_OUT
from app.wire.fields import Answer, Coordinate, Length, Margin, Width, Wire, check_limit, measure
from app.wire.labels import Part, TextTable, label, separation, value_text, value_word
from app.wire.question import Command, Question, Terms
from core import Engine
from core.language import Listed, phrase, say
from core.quantities import format_number
from core.values import Floats, Pair, Point


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
    """Two benches within the margin, or overlapping if it is 0. witness_b - witness_a = separation * normal.

    benches: the pair a, b
    """

    benches: Pair
    separation: float
    witness_a: Point
    witness_b: Point
    normal: Point


class OverlapsCheck(Answer):
    """Independent engines side by side.

    agree: true if all engines that were asked found the same pairs
    engines: pairs found by each engine
    """

    agree: bool
    engines: dict[Engine, list[Pair]]
    left_out: list[Engine] = Field(description=LEFT_OUT)


class OverlapsAnswer(Answer):
    """All pairs with separation <= margin.

    overlaps: the pairs, sorted
    cross_check: independent engines side by side
    """

    overlaps: list[Overlap]
    cross_check: OverlapsCheck


def overlaps(request: OverlapsRequest | InstantQuery, terms: Terms) -> OverlapsAnswer:
    """Benches that overlap or come within a margin, with depth and place, according to four engines."""
    margin, most = request.margin, terms.settings.poses_max
    if isinstance(request, OverlapsRequest):
        chained, (poses, lengths, widths) = request.chained, request.to_poses(most)
    else:
        dance, chained = request.to_dance(most), True
        poses = core.bench_poses(core.trajectory(dance, [request.time], budget=terms.budget).position[0])
        lengths, widths = dance.dragon.lengths, dance.dragon.widths
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


def _parts(answer: OverlapsAnswer, request: OverlapsRequest | InstantQuery) -> Iterator[Part]:
    """The pairs, and what the engines say of them."""
    near = say("Pairs within {margin} m of each other", margin=format_number(request.margin))
    heads = (label(name, "m") for name in ("separation", "witness_a", "witness_b"))
    table = TextTable(near if request.margin else say("Overlapping pairs"), label("benches"), *heads)
    for one in answer.overlaps:
        witnesses = map(value_text, (one.witness_a, one.witness_b))
        table.add(value_text(one.benches), separation(one.separation), *witnesses)
    yield table
    check = answer.cross_check
    counts = Listed(f"{value_word(engine.value)} {len(pairs)}" for engine, pairs in check.engines.items())
    engines = say("All four engines") if not check.left_out else say("The engines that can judge a margin")
    agree = phrase("{engines} agree; pairs found: {counts}")
    disagree = phrase("{engines} DISAGREE; pairs found: {counts}")
    yield say(agree if check.agree else disagree, engines=engines, counts=counts)


QUESTION = Question(
    overlaps,
    OverlapsAnswer,
    body=OverlapsRequest,
    cost=_cost,
    command=Command(
        "Benches that overlap, or come within a margin, at one instant, according to four engines.",
        lambda request: say("overlaps"),
        _parts,
        options=InstantQuery,
        file="Benches as for POST /overlaps, in place of a dance (- for standard input).",
    ),
)

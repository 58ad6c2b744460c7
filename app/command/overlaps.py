"""The command overlaps: benches that overlap at one instant."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import Json, asks, unused
from app.files.disk import read_json
from app.questions import overlaps as together
from app.questions.figures import InstantQuery
from app.questions.overlaps import OverlapsAnswer, OverlapsRequest
from app.wire.messages import checked
from app.wire.question import Terms
from core.errors import said


@asks(InstantQuery)
def overlaps(
    asked: InstantQuery,
    context: typer.Context,
    file: Annotated[
        Path | None, typer.Argument(help="Benches as for POST /overlaps, in place of a dance (- for standard input).")
    ] = None,
    json: Json = False,
) -> None:
    """Benches that overlap, or are nearer than a margin, at one instant, according to four engines."""
    if file:
        why = "describes a dance, and FILE gives the benches: give one of the two"
        unused(context, InstantQuery.model_fields, why)
        benches = checked(OverlapsRequest, read_json(file))
    with show.waiting("overlaps"):
        if file:
            answer, margin = together.overlaps(benches, Terms()), benches.margin
        else:
            answer, margin = together.of_dance(asked, Terms()), asked.margin
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*overlap_tables(answer, margin))


def overlap_tables(answer: OverlapsAnswer, margin: float = 0.0) -> list[show.Part]:
    title = f"Pairs nearer than {said(margin)} m" if margin else "Overlapping pairs"
    table = show.new_table(title, "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        table.add_row(
            show.shown(one.benches),
            show.separation(one.separation),
            show.shown(one.witness_a),
            show.shown(one.witness_b),
        )
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that can judge a margin"
    return [table, f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"]

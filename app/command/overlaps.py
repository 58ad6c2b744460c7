"""The command bench-dragon overlaps: which benches overlap at one instant."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import Json, asks, unused
from app.command.usage import path_argument
from app.files.disk import ending_of, read_json
from app.questions import overlaps as together
from app.questions.figures import InstantQuery
from app.questions.overlaps import OverlapsAnswer, OverlapsRequest
from app.wire.messages import checked
from app.wire.question import Terms
from core import InvalidValue
from core.errors import format_number


@asks(InstantQuery)
def overlaps(
    asked: InstantQuery,
    context: typer.Context,
    file: Annotated[
        Path | None,
        path_argument("FILE", "Benches as for POST /overlaps, in place of a dance (- for standard input)."),
    ] = None,
    json: Json = False,
) -> None:
    """Benches that overlap, or come within a margin, at one instant, according to four engines."""
    if file:
        why = "describes a dance, and FILE gives the benches: give one of the two"
        unused(context, InstantQuery.model_fields, why)
        told = {} if ending_of(file) == ".toml" else read_json(file)
        if "benches" not in told:
            words = "{file} must be JSON with benches, each a rectangle with x, y, heading, length and width"
            why = "ask check or clearance about a dance"
            raise InvalidValue.in_words("file", words, reason=why, file=str(file))
        benches = checked(OverlapsRequest, told)
    with show.waiting("overlaps"):
        answer = together.overlaps(benches, Terms()) if file else together.of_dance(asked, Terms())
    show.print_found(answer, json, _overlap_parts(answer, benches.margin if file else asked.margin))


def _overlap_parts(answer: OverlapsAnswer, margin: float) -> Iterator[show.Part]:
    title = f"Pairs within {format_number(margin)} m of each other" if margin else "Overlapping pairs"
    table = show.new_table(title, "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        witnesses = map(show.shown, (one.witness_a, one.witness_b))
        table.add_row(show.shown(one.benches), show.separation(one.separation), *witnesses)
    yield table
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that can judge a margin"
    yield f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"

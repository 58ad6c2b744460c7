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
from app.wire.labels import Part, Table, label, separation, value_text, value_word
from app.wire.messages import checked
from app.wire.question import Terms
from core import InvalidValue
from core.errors import format_number
from core.language import Listed, phrase, say


@asks(InstantQuery)
def overlaps(
    request: InstantQuery,
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
        values = {} if ending_of(file) == ".toml" else read_json(file)
        if "benches" not in values:
            words = "{file} must be JSON with benches, each a rectangle with x, y, heading, length and width"
            why = "ask check or clearance about a dance"
            raise InvalidValue.in_words("file", words, reason=why, file=str(file))
        benches = checked(OverlapsRequest, values)
    with show.waiting(say("overlaps")):
        answer = together.overlaps(benches, Terms()) if file else together.of_dance(request, Terms())
    show.print_result(answer, json, _overlap_parts(answer, benches.margin if file else request.margin))


def _overlap_parts(answer: OverlapsAnswer, margin: float) -> Iterator[Part]:
    near = say("Pairs within {margin} m of each other", margin=format_number(margin))
    heads = (label(name, "m") for name in ("separation", "witness_a", "witness_b"))
    table = Table(near if margin else say("Overlapping pairs"), label("benches"), *heads)
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

"""The commands that ask where benches touch: first contact, clearance and overlaps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from app.command import show
from app.command.options import Json, asks, unused
from app.files.disk import read_json
from app.questions import clearance as clearances
from app.questions import collision_time as collisions
from app.questions import overlaps as together
from app.questions.clearance import ClearanceQuery, ClearanceRequest
from app.questions.collision_time import CollisionQuery, CollisionRequest
from app.questions.figures import InstantQuery
from app.questions.overlaps import OverlapsAnswer, OverlapsRequest
from app.wire.messages import checked
from app.wire.question import Terms
from core import InvalidValue
from core.errors import said


@asks(CollisionQuery, CollisionRequest)
def collision_time(asked: CollisionQuery | CollisionRequest, json: Json = False) -> None:
    """Time of first contact: when two benches first touch, or come nearer than a margin."""
    with show.waiting("first contact"):
        answer = collisions.collision_time(asked, Terms())
    title = f"First time that two benches are nearer than {said(asked.margin)} m" if asked.margin else "First contact"
    if stray := asked.to_stray():
        title += f" that may come about with strays up to {said(stray)} m"
    show.print_answer(title, answer, json, margin=asked.margin, benches=asked.benches)


@asks(ClearanceQuery, ClearanceRequest)
def clearance(asked: ClearanceQuery | ClearanceRequest, json: Json = False) -> None:
    """Smallest distance between two benches that share no handle, and the pair, at every instant."""
    with show.waiting("clearance"):
        answer = clearances.clearance(asked, Terms())
    show.print_found(answer, json, _clearance_parts(answer.columns))


def _clearance_parts(columns: dict[str, Any]) -> Iterator[show.Part]:
    """Clearance at every instant, and the local minima between them."""
    table = show.new_table("Clearance", "time [s]", "clearance [m]", "benches")
    for time, clearance, benches in zip(columns["time"], columns["clearance"], columns["benches"], strict=True):
        table.add_row(said(time), show.separation(clearance), show.shown(tuple(benches)))
    yield table
    grazes = show.new_table("Local minima", "time [s]", "clearance [m]", "benches")
    for graze in columns["grazes"]:
        grazes.add_row(show.shown(graze.time), show.separation(graze.clearance), show.shown(graze.benches))
    yield grazes if columns["grazes"] else "No local minimum between the first and the last instant."


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
        told = {} if file.suffix.lower() == ".toml" else read_json(file)
        if "benches" not in told:
            words = "must be JSON with benches, each a rectangle with x, y, heading, length and width"
            raise InvalidValue.in_words("file", f"{file} {words}: ask check or clearance about a dance")
        benches = checked(OverlapsRequest, told)
    with show.waiting("overlaps"):
        answer = together.overlaps(benches, Terms()) if file else together.of_dance(asked, Terms())
    show.print_found(answer, json, _overlap_parts(answer, benches.margin if file else asked.margin))


def _overlap_parts(answer: OverlapsAnswer, margin: float) -> Iterator[show.Part]:
    title = f"Pairs nearer than {said(margin)} m" if margin else "Overlapping pairs"
    table = show.new_table(title, "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        witnesses = map(show.shown, (one.witness_a, one.witness_b))
        table.add_row(show.shown(one.benches), show.separation(one.separation), *witnesses)
    yield table
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that can judge a margin"
    yield f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"

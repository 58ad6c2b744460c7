"""The commands that ask when benches come near each other: first contact and clearance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from app.command import show
from app.command.options import Json, asks
from app.questions import clearance as clearances
from app.questions import collision_time as collisions
from app.questions.clearance import ClearanceQuery, ClearanceRequest
from app.questions.collision_time import CollisionQuery, CollisionRequest
from app.wire.question import Terms
from core.errors import format_number
from core.language import say


@asks(CollisionQuery, CollisionRequest)
def collision_time(request: CollisionQuery | CollisionRequest, json: Json = False) -> None:
    """Time of first contact: when two benches first touch, or come within a margin."""
    with show.waiting(say("first contact")):
        answer = collisions.collision_time(request, Terms())
    near = f"First time that two benches are within {format_number(request.margin)} m of each other"
    title = near if request.margin else "First contact"
    if stray := request.to_stray():
        title += f" that may come about with strays up to {format_number(stray)} m"
    show.print_answer(title, answer, json, margin=request.margin, benches=request.benches)


@asks(ClearanceQuery, ClearanceRequest)
def clearance(request: ClearanceQuery | ClearanceRequest, json: Json = False) -> None:
    """Smallest distance between two benches that share no handle, and the pair, at every instant.

    Of a FILE of several dragons, between benches of two of them.
    """
    with show.waiting(say("clearance")):
        answer = clearances.clearance(request, Terms())
    show.print_result(answer, json, _clearance_parts(answer.columns))


def _clearance_parts(columns: dict[str, Any]) -> Iterator[show.Part]:
    """Clearance at every instant, and the local minima between them."""
    pairs = [name for name in ("dragons", "benches") if name in columns]
    table = show.new_table("Clearance", "time [s]", "clearance [m]", *pairs)
    for time, clearance, *pair in zip(*(columns[name] for name in ("time", "clearance", *pairs)), strict=True):
        table.add_row(
            format_number(time), show.separation(clearance), *(show.value_text(tuple(one.tolist())) for one in pair)
        )
    yield table
    grazes = show.new_table("Local minima", "time [s]", "clearance [m]", *pairs)
    for graze in columns["grazes"]:
        pair = [show.value_text(getattr(graze, name)) for name in pairs]
        grazes.add_row(show.value_text(graze.time), show.separation(graze.clearance), *pair)
    yield grazes if columns["grazes"] else "No local minimum between the first and the last instant."

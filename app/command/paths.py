"""--path: the spiral or the contest's turn, as options of the commands that also take a FILE."""

from __future__ import annotations

from typing import Literal, Protocol

import typer
from pydantic import Field

from app.command.options import typed_options, unused
from app.wire.paths import Ends, EntryRadius, ExitRadius, Middle, TurnFields
from app.wire.question import DanceQuery, TurningDiameter, measure
from core import Dance

TURN_FIELDS = ("turning_diameter", "ratio", "entry_radius", "exit_radius", "middle", "ends")


class PathOptions(DanceQuery):
    """A uniform dragon on a chosen path."""

    path: Literal["spiral", "turn"] = Field(
        "spiral", description="Path: a spiral inwards, or the contest's turn between two coils"
    )
    turning_diameter: TurningDiameter = measure("m", "Diameter of the circle in which the turn lies", 9.0)
    ratio: float = Field(2.0, ge=0.01, le=100, description="Radius of the first arc of the turn divided by the second")
    entry_radius: EntryRadius = None
    exit_radius: ExitRadius = None
    middle: Middle = None
    ends: Ends = 0.0


class OfFile(Protocol):
    """A request made from a FILE."""

    def to_dance(self, benches_max: int) -> Dance: ...


def dance_of(request: PathOptions | OfFile, context: typer.Context, benches_max: int) -> Dance:
    """The dance on the path of the request, whose own pitch is the default. raises: TooLarge, InvalidValue"""
    options = request if isinstance(request, PathOptions) else None
    if options is None:
        unused(context, ["path"], "cannot be combined with FILE, which describes the dance")
    if options is None or options.path == "spiral":
        unused(context, TURN_FIELDS, "belongs to a turn: give --path turn too, or leave it out")
        return request.to_dance(benches_max)
    values = {name: getattr(options, name) for name in typed_options(context, "pitch", "start_turns", *TURN_FIELDS)}
    return Dance(options.to_dragon(benches_max), TurnFields(**values).to_turn(), options.head_speed)

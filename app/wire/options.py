"""A dance on a spiral or on the contest's turn as options of a command, which also takes a FILE with any other."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from app.wire.fields import DanceQuery, TurningDiameter, measure
from app.wire.paths import Ends, EntryRadius, ExitRadius, Middle


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

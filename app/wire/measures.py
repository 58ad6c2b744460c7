"""What every request is made of: no unknown names, no infinities, measures with their units.

The limits here are narrower than core's own: they fit a dance in a real place, so that a length in centimetres is
noticed.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

# An object with more names than this is not looked into.
NAMES_MAX = 100

Length = Annotated[float, Field(ge=1e-3, le=50)]
Width = Annotated[float, Field(ge=1e-3, le=5)]
Overhang = Annotated[float, Field(ge=0, le=5)]
Pitch = Annotated[float, Field(ge=1e-3, le=10, description="Radial advance of the spiral per full turn [m]")]
StartTurns = Annotated[float, Field(gt=0, le=200, description="Turns between the centre and the start [turns]")]
Margin = Annotated[
    float, Field(ge=0, le=2, description="Clearance required: nearer benches count as a contact; 0: a touch does [m]")
]
Coordinate = Annotated[float, Field(ge=-1e6, le=1e6)]
Instant = Annotated[float, Field(ge=-1e6, le=1e6)]
SpeedLimit = Annotated[float, Field(ge=1e-3, le=100)]
TurningDiameter = Annotated[float, Field(ge=2e-3, le=200)]
Angle = Annotated[float, Field(ge=-1000, le=1000)]
# Whom four engines judge around a contact.
CrossCheck = Annotated[
    Literal["dragon", "pair", "none"],
    Field(
        description="Whom independent engines judge just before and just after: dragon: every bench (of more than "
        "2,000, or very crowded ones, those near the pair); pair: the two of the contact, a tenth of the work; none: "
        "nobody"
    ),
]


class Wire(BaseModel):
    """What comes in: no unknown names, no infinities, never changed."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _few_names(cls, value: Any) -> Any:
        # Each unknown name would become an error of its own: 300,000 of them took 2 s (measured 2026-11-21).
        if isinstance(value, dict) and len(value) > NAMES_MAX:
            counts = {"most": NAMES_MAX, "given": len(value)}
            raise PydanticCustomError("too_many_names", "at most {most} names, got {given}", counts)
        return value

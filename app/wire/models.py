"""What every request and answer is made of: no unknown names, no infinities, measures with their units.

The limits here are narrower than core's own: they fit a dance in a real place, so that a length in centimetres is
noticed.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from core import TooLarge

JSON = "application/json"
# An object with more names than this is not looked into.
NAMES_MAX = 100


def measure(unit: str, description: str = "", default: Any = ..., **limits: Any) -> Any:
    """A field with a unit, which stands in the schema and for readers at the end of the description."""
    words = f"{description} [{unit}]".lstrip()
    return Field(default, description=words, json_schema_extra={"x-unit": unit}, **limits)


def unit_of(field: FieldInfo) -> str:
    """Unit of a field; empty for a pure number and for what is no number."""
    extra = field.json_schema_extra
    return str(extra["x-unit"]) if isinstance(extra, dict) and "x-unit" in extra else ""


Length = Annotated[float, Field(ge=1e-3, le=50)]
Width = Annotated[float, Field(ge=1e-3, le=5)]
Overhang = Annotated[float, Field(ge=0, le=5)]
PITCH_MAX = 10.0  # [m]
Pitch = Annotated[float, measure("m", "Radial advance of the spiral per full turn", ge=1e-3, le=PITCH_MAX)]
StartTurns = Annotated[float, measure("turns", "Turns between the centre and the start", gt=0, le=200)]
Margin = Annotated[
    float,
    measure("m", "Clearance required: nearer benches count as a contact; 0: a touch does", ge=0, le=2),
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


def check_limit(field: str, what: str, count: int, limit: int, advice: str) -> None:
    """raises: TooLarge at the field when there are more than the limit of what"""
    if count > limit:
        raise TooLarge(field, f"{what} must be at most {limit} here, got {count}: {advice}")


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


class Answer(BaseModel):
    """What goes out: finite numbers only, so that a mistake of ours is an error and never a NaN."""

    model_config = ConfigDict(allow_inf_nan=False, from_attributes=True)

    def to_json(self) -> bytes:
        return self.model_dump_json().encode()

    @classmethod
    def known(cls, found: Any, **own: Any) -> Self:
        """This answer from a result of core, by the names of its fields, but for those that are given."""
        return cls(**{name: getattr(found, name) for name in cls.model_fields if name not in own}, **own)

"""Base classes and common fields of requests and answers, with units and limits.

The limits here are narrower than those of core: they fit a dance in a real place, so that a length in centimetres
is noticed.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

from core import TooLarge

JSON = "application/json"
# An object with more names than this is refused without a look at its fields.
NAMES_MAX = 100


def measure(unit: str, description: str = "", default: Any = ..., **limits: Any) -> Any:
    """A field with a unit, which appears in the schema as x-unit and at the end of the description."""
    words = f"{description} [{unit}]".lstrip()
    return Field(default, description=words, json_schema_extra={"x-unit": unit}, **limits)


def unit_of(field: FieldInfo) -> str:
    """Unit of a field; empty for a pure number and for a field that is not a number."""
    extra = field.json_schema_extra
    return str(extra["x-unit"]) if isinstance(extra, dict) and "x-unit" in extra else ""


# Least and largest sizes of a bench [m].
LENGTHS, WIDTHS, OVERHANGS = (1e-3, 50.0), (1e-3, 5.0), (0.0, 5.0)
Length = Annotated[float, Field(ge=LENGTHS[0], le=LENGTHS[1])]
Width = Annotated[float, Field(ge=WIDTHS[0], le=WIDTHS[1])]
Overhang = Annotated[float, Field(ge=OVERHANGS[0], le=OVERHANGS[1])]
PITCH_MAX = 10.0  # [m]
Pitch = Annotated[float, measure("m", "Radial advance of the spiral per full turn", ge=1e-3, le=PITCH_MAX)]
StartTurns = Annotated[float, measure("turns", "Turns between the centre and the start", gt=0, le=200)]
Margin = Annotated[
    float,
    measure("m", "Clearance required: benches nearer than this are in contact; 0: only a touch counts", ge=0, le=2),
]
# Unit of the coordinates of a venue.
Coordinates = Literal["metres", "degrees"]
Coordinate = Annotated[float, Field(ge=-1e6, le=1e6)]
Instant = Annotated[float, Field(ge=-1e6, le=1e6)]
SpeedLimit = Annotated[float, Field(ge=1e-3, le=100)]
TurningDiameter = Annotated[float, Field(ge=2e-3, le=200)]
Angle = Annotated[float, Field(ge=-1000, le=1000)]
# Benches that four engines check around a contact.
CrossCheck = Annotated[
    Literal["dragon", "pair", "none"],
    Field(
        description="Benches that independent engines check just before and just after the contact. dragon: all of "
        "them (only those near the pair if there are more than 2,000 or they are very crowded); pair: the two in "
        "contact, a tenth of the work; none: no check"
    ),
]


def check_limit(field: str, what: str, count: int, limit: int, advice: str) -> None:
    """raises: TooLarge, at the field, when the count exceeds the limit; what: the things counted"""
    if count > limit:
        raise TooLarge(field, f"{what} must be at most {limit} here, got {count}: {advice}")


class Wire(BaseModel):
    """A request or a part of one: no unknown names, no infinities, immutable."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, defer_build=True)

    @model_validator(mode="before")
    @classmethod
    def _few_names(cls, value: Any) -> Any:
        # Every unknown name would become an error of its own: 300,000 of them took 2 s (measured 2026-11-21).
        if isinstance(value, dict) and len(value) > NAMES_MAX:
            counts = {"most": NAMES_MAX, "given": len(value)}
            raise PydanticCustomError("too_many_names", "at most {most} names, got {given}", counts)
        return value


class Answer(BaseModel):
    """An answer or a part of one: finite numbers only, so that a mistake of ours becomes an error and never a NaN."""

    model_config = ConfigDict(allow_inf_nan=False, from_attributes=True, defer_build=True)

    def to_json(self) -> bytes:
        return self.model_dump_json().encode()

    @classmethod
    def known(cls, found: Any, **own: Any) -> Self:
        """This answer with the given fields, the others taken by name from a result of core."""
        return cls(**{name: getattr(found, name) for name in cls.model_fields if name not in own}, **own)

"""Several dances on one clock, in request bodies, and their conversion to core."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import BeforeValidator, Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails, PydanticCustomError

from app.settings import Settings
from app.wire.dances import PathFields, VenueFields
from app.wire.fields import Wire, check_limit, measure
from app.wire.refusals import reworded
from core import BenchDragonError, Part, Performance
from core.performance import DELAY_MAX, PARTS_MAX

if TYPE_CHECKING:
    from app.wire.degrees import Place

# The rule for a field of one dance beside the dances of several.
FILE_OF_DANCES = "Several dances, as [[dances]] of a .toml file or as dances of a .json file."
BESIDE_SEVERAL = "must stand in each of the dances, got it beside them"
# A time of a performance [s]: of a dance, and its delay.
Moment = Annotated[float, Field(ge=-2 * DELAY_MAX, le=2 * DELAY_MAX)]


def _number_or_name(value: Any) -> Any:
    if isinstance(value, float) and value.is_integer():
        return int(value)
    if isinstance(value, bool) or not isinstance(value, (int, str)):
        raise PydanticCustomError("rule", "must be the number of a dragon, in the order of the dances, or its name")
    return value


# A dragon of a performance.
NumberOrName = Annotated[int | str, BeforeValidator(_number_or_name)]


def dragon_of(part: int | str, performance: Performance) -> int:
    """The number of a dragon; digits are its number unless they are its name. raises: InvalidValue"""
    is_name = part in [one.name for one in performance.parts]
    is_number = isinstance(part, str) and not is_name and re.fullmatch(r"\d{1,9}", part, re.ASCII)
    return performance.number_of(int(part) if is_number else part)


def dragons_of(part: int | str | None, performance: Performance) -> Sequence[int]:
    """The dragon of that number or name; None: all of them. raises: InvalidValue"""
    return range(len(performance.parts)) if part is None else [dragon_of(part, performance)]


class PartBody(PathFields, strict=True):
    """One dragon of a performance, on its path."""

    name: str | None = Field(None, description="Name of the dragon, in answers and messages; each has its own")
    delay: float = measure(
        "s", "Time of the performance at time 0 of this dance", 0.0, ge=-DELAY_MAX, le=DELAY_MAX
    )  # fmt: skip

    colour: str | None = Field(
        None,
        pattern="^#[0-9a-f]{6}$",
        description="Colour of the dragon in pictures, such as #b3261e; null: its turn's",
    )

    def to_part(self, benches_max: int) -> Part:
        """raises: TooLarge, InvalidValue"""
        return Part(self.to_dance(benches_max), self.delay, self.name, self.colour)


class PerformanceFields(Wire, strict=True):
    """The dances of a performance, as the body of a request."""

    dances: list[PartBody] = Field(
        min_length=1,
        max_length=PARTS_MAX,
        fail_fast=True,
        description="The dragons, each with its path. Before the whole dragon is on its path it stands at the "
        "beginning, after the end of its path it stays there; the performance ends when a bench of any dragon folds",
    )

    @property
    def benches(self) -> int:
        """Number of the benches of all dragons."""
        return sum(part.benches for part in self.dances)

    def to_performance(self, settings: Settings) -> Performance:
        """raises: TooLarge, InvalidValue"""
        return performance_of(self.dances, settings)


def performance_of(dances: Sequence[PartBody], settings: Settings) -> Performance:
    """raises: TooLarge, InvalidValue, named by their places in a body"""
    most, benches = settings.performed_benches_max, sum(one.benches for one in dances)
    rule = "benches of all dragons must be at most {most} here"
    check_limit("dances", rule, benches, most, "take fewer or shorter dragons")
    return Performance([_part(f"dances.{k}", one, most) for k, one in enumerate(dances)])


def _part(place: str, body: PartBody, most: int) -> Part:
    try:
        return body.to_part(most)
    except BenchDragonError as error:
        raise reworded(error, body).renamed(lambda name: f"{place}.{name}") from error


def placed(performance: Performance, request: VenueFields) -> tuple[Performance, Place]:
    """A performance in the venue of a request, and the place of this. raises: InvalidValue"""
    dragons = [part.dance.dragon for part in performance.parts]
    place = request.to_place(max(dragons, key=lambda dragon: float(dragon.lengths.max())))
    return replace(performance, venue=place.venue), place


class PlacedPerformance(VenueFields, PerformanceFields, strict=True):
    """The dances of a performance and its venue."""

    def to_placed(self, settings: Settings) -> tuple[Performance, Place]:
        """The performance in its venue, and the place of this. raises: TooLarge, InvalidValue"""
        return placed(self.to_performance(settings), self)


class SeveralDances(PathFields):
    """One dance, or several on one clock in its place."""

    dances: Annotated[list[PartBody], Field(min_length=1, max_length=PARTS_MAX, fail_fast=True)] | None = Field(
        None,
        description="Several dances on one clock, in place of dragon, path, head_speed, passages and beats, which each "
        "of them has; null: one dance",
    )

    @model_validator(mode="after")
    def _refuse_one_beside_several(self) -> Self:
        # A later look at the values would miss a field with its default: answers are kept by values.
        if self.dances is None:
            return self
        beside = PydanticCustomError("beside", BESIDE_SEVERAL)
        errors: list[InitErrorDetails] = [
            {"type": beside, "loc": (name,), "input": getattr(self, name)}
            for name in PathFields.model_fields
            if name in self.model_fields_set
        ]
        if errors:
            raise ValidationError.from_exception_data(type(self).__name__, errors)
        return self

    @property
    def benches(self) -> int:
        """Number of the benches of the dragon, or of all dragons."""
        return super().benches if self.dances is None else sum(part.benches for part in self.dances)

    def to_performance(self, settings: Settings) -> Performance:
        """The dances of several. raises: TooLarge, InvalidValue"""
        return performance_of(self.dances or [], settings)


class SeveralFields(VenueFields, SeveralDances):
    """One dance or several, in a venue."""

    def to_placed(self, settings: Settings) -> tuple[Performance, Place]:
        """Several dances in their venue, and the place of this. raises: TooLarge, InvalidValue"""
        return placed(self.to_performance(settings), self)


class PerformanceSpan(Wire):
    """A stretch of a performance."""

    start: Moment | None = measure(
        "s", "Start time; default: when the first dragon dances, with all of it on its path", None
    )
    stop: Moment | None = measure(
        "s", "End time; default: the end of the performance, at the first fold or the end of the last path", None
    )

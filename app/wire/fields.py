"""Fields of requests and answers, with units and limits: their base classes, and a dance as a flat query.

The limits here are narrower than those of core: they fit a dance in a real place, so that a length in centimetres
is noticed.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Collection
from dataclasses import fields
from functools import lru_cache
from types import NoneType
from typing import Annotated, Any, Literal, Self, get_args, get_type_hints

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ValidationError,
    model_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, PydanticCustomError

from app.settings import Settings
from core import Dance, Dragon, Spiral, Stray, TooLarge
from core.display import NO_MEANING, meanings
from core.dragon import BENCHES_MAX, wider_pin
from core.errors import InvalidValue
from core.names import TURNING, checked_name
from core.quantities import format_number

# Longer values are shortened in messages [characters].
VALUE_LENGTH_MAX = 60
# Characters that turn the direction of writing around, as a message shows them.
ESCAPED = {ord(one): f"\\u{ord(one):04x}" for one in TURNING}
# An object with more names than this is refused without a look at its fields.
NAMES_MAX = 100


def is_deeper(value: Any, most: int) -> bool:
    """True if objects and lists nest deeper than that in one another."""
    level = [value]
    for _ in range(most):
        level = [inner for outer in level for inner in _inside(outer)]
        if not level:
            return False
    return True


def _inside(outer: Any) -> list[Any]:
    """Objects and lists directly inside an object or a list."""
    entries = outer.values() if isinstance(outer, dict) else outer if isinstance(outer, list) else ()
    return [inner for inner in entries if isinstance(inner, (dict, list))]


def _one_line(text: str) -> str:
    try:
        checked_name("text", text)
    except InvalidValue as error:
        raise PydanticCustomError("rule", "must be one line of plain text") from error
    return text


def _address(text: str) -> str:
    if text and not re.fullmatch(r"https?://[!-~]+", text):
        raise PydanticCustomError("rule", "must be a web address that begins with http:// or https://")
    return text


# The address of a page, which stands on paper as a code; empty for none.
Address = Annotated[str, AfterValidator(_address)]
# A title or a name, which stands in sentences and on paper.
OneLine = Annotated[str, AfterValidator(_one_line)]


def shallow(most: int) -> AfterValidator:
    """A check that objects and lists are at most so deep in one another, because recursion exhausts the stack."""

    def checked(value: Any) -> Any:
        if is_deeper(value, most):
            raise PydanticCustomError("too_deep", "objects and lists in one another", {"most": most})
        return value

    return AfterValidator(checked)


def short_json(value: Any) -> str:
    """A value of a request in JSON, shortened, for a message."""
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    if isinstance(value, float):
        return format_number(value)
    text = json.dumps(value, ensure_ascii=False, default=str).translate(ESCAPED)
    return text if len(text) <= VALUE_LENGTH_MAX else f"{text[:VALUE_LENGTH_MAX]}... ({len(text)} characters)"


def measure(
    unit: str, description: str = "", default: Any = ..., *, label: str = "", hint: str = "", **limits: Any
) -> Any:
    """A field with a unit, which appears in the schema as x-unit and at the end of the description.

    unit: empty for none; label, hint: what people read beside it on the page, in refusals, and in the schema as x-label
    """
    words = f"{description} [{unit}]".lstrip() if unit else description
    extra: Any = {f"x-{what}": text for what, text in (("unit", unit), ("label", label), ("hint", hint)) if text}
    return Field(default, description=words, json_schema_extra=extra, **limits)


# Fields with a label, by name: each request that has one enters it.
LABELLED: dict[str, FieldInfo] = {}


def extra_of(field: FieldInfo, what: str) -> str:
    """The unit, the label or the hint of a field; empty for a field without."""
    extra = field.json_schema_extra
    return str(extra.get(f"x-{what}", "")) if isinstance(extra, dict) else ""


def typed_fields(kind: Any) -> dict[str, tuple[Any, str]]:
    """Type and unit of every field of an answer, or of a value of core in one."""
    if issubclass(kind, BaseModel):
        return {name: (field.annotation, extra_of(field, "unit")) for name, field in kind.model_fields.items()}
    types, known = get_type_hints(kind), meanings(kind)
    return {one.name: (types[one.name], known.get(one.name, NO_MEANING).unit) for one in fields(kind)}


def _whole(value: Any) -> Any:
    return int(value) if isinstance(value, float) and value.is_integer() else value


# A whole number of JSON, of which 223.0 is one. Limits stand before the validator where a number may be null or is in a
# list: elsewhere pydantic would name them in the schema by words of its own.
AS_WHOLE = BeforeValidator(_whole)
Whole = Annotated[int, AS_WHOLE]
# Least and largest sizes of a bench [m].
LENGTHS, WIDTHS, OVERHANGS = (1e-3, 50.0), (1e-3, 5.0), (0.0, 5.0)
Length = Annotated[float, Field(ge=LENGTHS[0], le=LENGTHS[1])]
Width = Annotated[float, Field(ge=WIDTHS[0], le=WIDTHS[1])]
Overhang = Annotated[float, Field(ge=OVERHANGS[0], le=OVERHANGS[1])]
PITCH_MAX = 10.0  # [m]
# Largest stray in a request [m]: half of the longest possible chord. The real limit is half of the shortest chord.
STRAY_MAX = 25
Pitch = Annotated[
    float, measure(
        "m", "Radial advance of the spiral per full turn", label="Pitch", hint="between two rings",
        ge=1e-3, le=PITCH_MAX,
    ),
]  # fmt: skip
StartTurns = Annotated[
    float,
    measure(
        "turns", "Turns between the centre and the start", label="Head starts", hint="turns from the centre",
        gt=0, le=200,
    ),
]  # fmt: skip
Margin = Annotated[
    float,
    measure(
        "m", "Clearance required: benches within it are in contact; 0: only a touch counts", label="Margin",
        hint="gap to keep", ge=0, le=2,
    ),
]  # fmt: skip
# Unit of the coordinates of a venue.
Coordinates = Literal["metres", "degrees"]
PaperSize = Annotated[Literal["A4", "A3"], Field(description="Size of the paper")]
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


def check_limit(field: str, rule: str, count: int, limit: int, advice: str) -> None:
    """raises: TooLarge, at the field, when the count exceeds the limit; rule: which things are counted"""
    if count > limit:
        raise TooLarge.in_words(field, rule, got=count, reason=advice, most=limit)


class Wire(BaseModel):
    """A request or a part of one: no unknown names, no infinities, immutable.

    Null counts as left out for a field whose default is an object or a list: the schema cannot state such a default, so
    clients that were generated from it send null.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, defer_build=True)

    @classmethod
    def __pydantic_init_subclass__(cls, **options: Any) -> None:
        super().__pydantic_init_subclass__(**options)
        LABELLED.update({name: field for name, field in cls.model_fields.items() if extra_of(field, "label")})

    @model_validator(mode="before")
    @classmethod
    def _plain(cls, value: Any) -> Any:
        if not isinstance(value, dict):
            return value
        # Of a query all values are texts, and Pydantic takes 1_000 for a number, as Python does.
        faults: list[Any] = [
            {"type": kind, "loc": (name,), "input": text}
            for name, text in value.items()
            if isinstance(text, str) and "_" in text and (kind := cls._number(name))
        ]
        if faults:
            raise ValidationError.from_exception_data(cls.__name__, faults)
        if None in value.values():
            value = {name: part for name, part in value.items() if part is not None or name not in cls._parts()}
        # Every unknown name would become an error of its own: 300,000 of them took 2 s (measured 2026-11-21).
        if len(value) > NAMES_MAX:
            counts = {"most": NAMES_MAX, "given": len(value)}
            raise PydanticCustomError("too_many_names", "at most {most} names, got {given}", counts)
        return value

    @classmethod
    def _number(cls, name: str) -> str:
        """The kind of fault of a text that is no number for a field; empty if the field takes other values."""
        field = cls.model_fields.get(name)
        kinds = set(get_args(field.annotation) or [field.annotation]) - {NoneType} if field else set()
        return {frozenset([float]): "float_parsing", frozenset([int]): "int_parsing"}.get(frozenset(kinds), "")

    @classmethod
    def _parts(cls) -> set[str]:
        return {name for name, field in cls.model_fields.items() if field.default_factory is not None}

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        schema = handler(core)
        for name in cls._parts():
            field = handler.resolve_ref_schema(schema)["properties"][name]
            words = {word: field.pop(word) for word in ("title", "description") if word in field}
            handler.resolve_ref_schema(schema)["properties"][name] = {"anyOf": [field, {"type": "null"}], **words}
        return schema


def described_field(name: str, kind: type) -> FieldInfo | None:
    """What a value of core says of one of its fields, as a field of the description; None if it says nothing."""
    meaning = meanings(kind).get(name)
    if meaning is None:
        return None
    words = re.sub(r"(^|\. )([a-z])(?!\w+:|[xy]\b|(?<=[xy]) )", lambda one: one[1] + one[2].upper(), meaning.words)
    words = re.sub(r"(?<=\. )None\b", "Null", words).replace("None", "null")
    field: FieldInfo = measure(meaning.unit, words)
    return field


def _on_wire(kind: Any) -> Any:
    """The type of a field of a value of core in an answer: a tuple of any length is a list."""
    entries = get_args(kind)
    return list[_on_wire(entries[0])] if entries[1:] == (...,) else kind  # type: ignore[misc]


def _first_paragraph(schema: dict[str, Any]) -> None:
    """Cut the description of an answer behind its first paragraph, where its fields are described."""
    if "description" in schema:
        schema["description"] = schema["description"].partition("\n\n")[0]


class Answer(BaseModel):
    """An answer or a part of one: finite numbers only, so that a mistake of ours becomes an error and never a NaN.

    A part that says what a value of core says is that value itself. Where an answer says more, `of` is the value whose
    docstring describes the fields of the same names; its own docstring describes the others, as there: each in a line
    `name: words [unit]` behind its first paragraph. A description stands beside a field only where it is made there.
    With `leave`, it has also the fields of that value that it does not declare, each behind the one that is before it
    there, but those to leave out.
    """

    model_config = ConfigDict(
        allow_inf_nan=False,
        from_attributes=True,
        defer_build=True,
        revalidate_instances="always",
        json_schema_extra=_first_paragraph,
    )

    def __init_subclass__(cls, of: Any = None, leave: Collection[str] | None = None, **options: Any) -> None:
        super().__init_subclass__(**options)
        if leave is None:
            return
        kinds, names, place = get_type_hints(of), list(cls.__annotations__), -1
        for name in (field.name for field in fields(of) if field.name not in leave):
            if name in names:
                place = names.index(name)
            else:
                names.insert(place := place + 1, name)
        cls.__annotations__ = {name: cls.__annotations__.get(name) or _on_wire(kinds[name]) for name in names}

    @classmethod
    def __pydantic_init_subclass__(cls, of: type | None = None, leave: Any = None, **options: Any) -> None:
        super().__pydantic_init_subclass__(**options)
        for name, field in cls.model_fields.items():
            if field.description is None and (known := described_field(name, cls) or described_field(name, of or cls)):
                field.description, field.json_schema_extra = known.description, known.json_schema_extra

    def to_json(self) -> bytes:
        return self.model_dump_json().encode()

    @classmethod
    def from_result(cls, result: Any, **own: Any) -> Self:
        """This answer with the given fields, the others taken by name from a result of core."""
        return cls(**{name: getattr(result, name) for name in cls.model_fields if name not in own}, **own)


# Most requests are about the same dragon, and laying one out is a twentieth of a quick answer.
uniform_dragon = lru_cache(maxsize=4)(Dragon)


class UniformDragon(Wire):
    """A head and a body of equal benches."""

    benches: Whole = measure(
        "", "Number of benches", 223, label="Benches", hint="with head and tail", ge=1, le=BENCHES_MAX
    )
    head_length: Length = measure("m", "Length of the head's bench", 3.41, label="Head length", hint="end to end")
    body_length: Length = measure("m", "Length of every other bench", 2.20, label="Body length", hint="end to end")
    width: Width = measure("m", "Width of every bench", 0.30, label="Width", hint="of every board")
    overhang: Overhang = measure(
        "m", "Distance from a handle to the nearer end of its bench", 0.275, label="Handle to end", hint="hole to end"
    )

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        check_limit(
            "dragon.benches", "benches must be at most {most} here", self.benches, benches_max, "shorten the dragon"
        )
        return uniform_dragon(self.benches, self.head_length, self.body_length, self.width, self.overhang)

    def most_benches(self, settings: Settings) -> int:
        """Largest number of benches: equal benches repeat one another, so the limit is high."""
        return settings.benches_max


class SpiralFields(Wire):
    """The spiral of the dance."""

    pitch: Pitch = 0.55
    start_turns: StartTurns = 16.0

    def to_path(self) -> Spiral:
        """raises: InvalidValue"""
        return Spiral(self.pitch, self.start_turns)


class Strays(Wire):
    """Largest distance of every hole from its place, by people and by the play of its pin."""

    stray: float = measure(
        "m", "Largest distance of a person from their place; the margin then holds for all places within it", 0.0,
        label="Stray", hint="of every person", ge=0, le=STRAY_MAX,
    )  # fmt: skip
    hole: float = measure(
        "m", "Diameter of the holes in the benches; with the pin it gives the play", 0.0,
        label="Hole", hint="its diameter", ge=0, le=1,
    )  # fmt: skip
    pin: float = measure(
        "m", "Diameter of the pins in these holes; half of the difference adds to the stray", 0.0,
        label="Pin", hint="its diameter", ge=0, le=1,
    )  # fmt: skip

    @property
    def has_stray(self) -> bool:
        """True if people or holes may stray, which makes a search slower."""
        return self.stray > 0.0 or self.hole > 0.0

    @property
    def total_stray(self) -> float | None:
        """The stray in all, as an answer tells it; None for none [m]."""
        return self.to_stray() or None

    def to_stray(self) -> float:
        """The stray in all, 0.0 for none [m]. raises: InvalidValue for a pin wider than its hole"""
        if self.pin > self.hole:
            raise wider_pin("pin", "hole", self)
        return Stray(self.stray, self.hole, self.pin).total if self.has_stray else 0.0

    def to_limits(self) -> dict[str, Any]:
        """Arguments of core: the stray in all, and the margin and the limit of speed of a request that has them."""
        limits = {name: getattr(self, name) for name in ("margin", "speed_limit") if name in type(self).model_fields}
        return limits | {"stray": self.to_stray()}


class HeadSpeed(Wire):
    """Speed of the head."""

    head_speed: float = measure(
        "m/s", "Speed of the head", 1.0, label="Head speed", hint="along its path", ge=1e-3, le=20
    )


class DanceQuery(HeadSpeed, SpiralFields, UniformDragon):
    """A uniform dragon on a spiral, as query parameters."""

    def to_dance(self, benches_max: int) -> Dance:
        """raises: TooLarge, InvalidValue"""
        return Dance(self.to_dragon(benches_max), self.to_path(), self.head_speed)

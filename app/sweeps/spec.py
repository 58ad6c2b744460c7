"""The spec of a sweep: one question with values for some of its parameters, the same on every machine.

A spec never changes. Its name is the hash of its canonical bytes, and that name and an index identify a shard.
"""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import orjson
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError, model_validator
from pydantic_core import PydanticCustomError

import core
from app.sweeps.questions import SweepQuestion, question_of
from app.wire.dances import AXIS
from app.wire.fields import AS_WHOLE, Whole, measure, shallow
from app.wire.messages import checked
from app.wire.texts import Unreadable, json_of, toml_of
from core import InvalidValue, TooLarge
from core.language import Listed
from core.quantities import Given

DESIGNS_MAX = 10**8
SHARDS_MAX = 10**6
# Time that a shard should take [s], largest number of designs in a shard, and least number of shards, so that a small
# sweep uses all cores too.
SHARD_SECONDS = 5.0
SHARD_MAX = 100_000
SHARDS_SMALL = 64
# Most values of a parameter; and how deep objects and lists may nest in them: a venue has up to 20.
VALUES_MAX, VALUES_DEPTH_MAX = 100_000, 40
# Most dimensions of scipy's Sobol points.
SOBOL_DIMENSIONS = 21_201
# The first columns of every table.
OWN_COLUMNS = ("design", "error.code", "error.message")

# Digits of the distance of two values in a range that the values keep [1].
STEP_DIGITS = 9
Parameter = Annotated[str, Field(min_length=1, max_length=200)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Range(_Strict):
    """Values from `start` to `stop`: `count` evenly spaced values with both ends, or samples if count is null."""

    start: float = measure("as the parameter", "First value")
    stop: float = measure("as the parameter", "Last value")
    count: Annotated[int, Field(ge=2, le=DESIGNS_MAX), AS_WHOLE] | None = Field(
        None, description="Number of values; null: sampled"
    )
    scale: Literal["linear", "log"] = Field(
        "linear", description="linear: evenly spaced values; log: evenly spaced logarithms"
    )

    @model_validator(mode="after")
    def _has_logarithms(self) -> Self:
        if self.scale == "log" and not (self.start > 0.0 and self.stop > 0.0):
            raise PydanticCustomError("log_scale", "start and stop must be positive on a log scale")
        return self

    def at(self, share: float) -> float:
        """The value at a fraction of the range: start at 0, stop at 1."""
        if share in (0.0, 1.0):
            return self.stop if share else self.start
        if self.scale == "log":
            return self.start * math.pow(self.stop / self.start, share)
        return self.start + (self.stop - self.start) * share

    def value(self, k: int) -> float:
        """Value k of `count`; on a linear scale without the digits that rounding adds, as in 0.41000000000000003."""
        assert self.count is not None
        value, step = self.at(k / (self.count - 1)), abs(self.stop - self.start) / (self.count - 1)
        return value if self.scale == "log" or not step else round(value, STEP_DIGITS - math.floor(math.log10(step)))

    def grid(self) -> list[float]:
        """All `count` values."""
        assert self.count is not None
        return [self.value(k) for k in range(self.count)]


class Samples(_Strict):
    """Method for all sampled ranges together; point k depends on k alone."""

    count: Whole = Field(ge=1, le=DESIGNS_MAX, description="Number of samples")
    sequence: Literal["sobol", "philox"] = Field(
        "sobol", description="sobol: spread evenly; philox: independent random ones"
    )
    seed: Whole = Field(0, ge=0, lt=2**63, description="Seed of philox")


Axis = Annotated[
    Annotated[Range, Tag(AXIS)] | Annotated[list[Any], Field(min_length=1, max_length=VALUES_MAX), Tag("list")],
    Discriminator(lambda value: "list" if isinstance(value, list) else AXIS),
]


class Spec(_Strict):
    """One question with values for some of its parameters.

    The designs are all combinations of the lists and evenly spaced ranges, repeated for each sample of the sampled
    ranges; the last parameter varies fastest.
    """

    question: str = Field(description="The operation id")
    over: Annotated[dict[Parameter, Axis], shallow(VALUES_DEPTH_MAX)] = Field(
        min_length=1, description="Parameters that vary, by dotted names, with their values"
    )
    request: Annotated[dict[str, Any], shallow(VALUES_DEPTH_MAX)] = Field(
        default_factory=dict, description="The other parameters; default: their defaults"
    )
    samples: Samples | None = Field(None, description="Method for ranges without a count")
    shard_size: Annotated[int, Field(ge=1, le=SHARD_MAX), AS_WHOLE] | None = Field(
        None, description="Designs in a shard; null: about 5 s of work"
    )

    @classmethod
    def of(cls, values: Any, question: SweepQuestion | None = None) -> Self:
        """A complete spec, with the size of its shards, from values of JSON, TOML or Python.

        question: the question with that name, if it is not in the registry
        raises: InvalidValue, TooLarge
        """
        spec = checked(cls, values)
        question = question or spec.asks
        usual = min(int(SHARD_SECONDS / question.seconds), SHARD_MAX, -(-spec.designs // SHARDS_SMALL))
        size = spec.shard_size or usual
        request = spec.request
        # A cross-check costs more than the answer, and an answer in a sweep can be compared with its neighbours.
        if "cross_check" in question.request.model_fields and "cross_check" not in spec.over:
            request = {"cross_check": "none"} | request
        spec = spec.model_copy(update={"shard_size": max(size, 1), "request": request})
        spec._check(question)
        return spec

    @classmethod
    def read(cls, file: Path) -> Self:
        """The spec in a .toml or .json file. raises: InvalidValue, TooLarge, OSError"""
        try:
            return cls.of((toml_of if file.suffix.lower() == ".toml" else json_of)(file.read_bytes()))
        except Unreadable as error:
            raise error.of("spec", str(file)) from error

    @property
    def asks(self) -> SweepQuestion:
        """The named question, in the form that has all these parameters. raises: InvalidValue"""
        return question_of(self.question, [*self.over, *self.request])

    @property
    def sampled(self) -> dict[str, Range]:
        """The sampled ranges by parameter."""
        return {name: axis for name, axis in self.over.items() if isinstance(axis, Range) and axis.count is None}

    @property
    def counts(self) -> dict[str, int]:
        """Number of values of each parameter that is not sampled."""
        counts = {name: axis.count if isinstance(axis, Range) else len(axis) for name, axis in self.over.items()}
        return {name: count for name, count in counts.items() if count is not None}

    @property
    def designs(self) -> int:
        """Number of designs."""
        return math.prod(self.counts.values()) * (self.samples.count if self.samples else 1)

    @property
    def shards(self) -> int:
        """Number of shards."""
        assert self.shard_size is not None
        return -(-self.designs // self.shard_size)

    def shard(self, index: int) -> tuple[int, int]:
        """The designs of a shard: from the first to before the last."""
        assert self.shard_size is not None
        return index * self.shard_size, min((index + 1) * self.shard_size, self.designs)

    def canonical(self) -> bytes:
        """The spec as bytes, independent of its notation, with the version of the program that answers it."""
        content = self.model_dump(mode="json") | {"version": core.__version__}
        # The order of the parameters is the order of the designs, so it is part of the spec.
        return orjson.dumps(content | {"over": list(content["over"].items())}, option=orjson.OPT_SORT_KEYS)

    @property
    def name(self) -> str:
        """The identity of this sweep: the SHA-256 of its canonical bytes."""
        return hashlib.sha256(self.canonical()).hexdigest()

    def _check(self, question: SweepQuestion) -> None:
        if bool(self.sampled) is not bool(self.samples):
            words = "needs a range without a count, and there is none: leave samples out, or remove a count"
            if self.sampled:
                words = "must say how to sample {ranges}: give samples, or give the range a count"
            raise InvalidValue("samples", words, ranges=Listed(self.sampled))
        if len(self.sampled) > SOBOL_DIMENSIONS:
            rule, got = "must have at most {most} sampled ranges", len(self.sampled)
            raise TooLarge("over", rule, got=got, most=SOBOL_DIMENSIONS)
        if self.designs > DESIGNS_MAX:
            raise TooLarge("over", "must make at most {most} designs", got=self.designs, most=DESIGNS_MAX)
        if self.shards > SHARDS_MAX:
            least = -(-self.designs // SHARDS_MAX)
            rule, size = "must be at least {least} for {designs} designs", self.shard_size
            raise TooLarge("shard_size", rule, got=size, least=least, designs=self.designs)
        for name in self.over:
            if name in OWN_COLUMNS:
                raise InvalidValue(f"over.{name}", "is not a parameter of {question}", question=self.question)
        self._check_names(question)

    def _check_names(self, question: SweepQuestion) -> None:
        """Refuse mistakes that affect every design: unknown parameters, and an invalid base.

        A refused value of an axis affects only its designs, which become rows with the error.
        """
        first = {name: axis.start if isinstance(axis, Range) else axis[0] for name, axis in self.over.items()}
        values = with_values(self.request, first)
        try:
            question.request.model_validate(values)
        except ValidationError as error:
            for one in error.errors():
                place = {str(part) for part in one["loc"]}
                varied = any(set(name.split(".")) <= place for name in self.over)
                if one["type"] == "extra_forbidden" or not varied:
                    checked(question.request, values)


def with_values(request: dict[str, Any], values: dict[str, Any]) -> dict[str, Any]:
    """A copy of a request with values set at dotted names; a number is a place in a list that the request has.

    >>> with_values({"path": {"kind": "spiral"}, "margin": 0}, {"path.pitch": 0.5})
    {'path': {'kind': 'spiral', 'pitch': 0.5}, 'margin': 0}
    >>> with_values({"dances": [{"delay": 0}, {"delay": 0}]}, {"dances.1.delay": 9})
    {'dances': [{'delay': 0}, {'delay': 9}]}
    """
    changed = dict(request)
    for name, value in values.items():
        inner: Any = changed
        *outer, last = name.split(".")
        for step in outer:
            place = _place(inner, step)
            old = inner[place] if isinstance(inner, list) else inner.get(place)
            inner[place] = inner = old.copy() if isinstance(old, (dict, list)) else {}
        inner[_place(inner, last)] = value
    return changed


def _place(inner: dict[str, Any] | list[Any], step: str) -> Any:
    """The key or index of a step of a dotted name. raises: InvalidValue for an index that the list does not have"""
    if not isinstance(inner, list):
        return step
    if not step.isdecimal() or int(step) >= len(inner):
        rule = "must name an entry of the list in the request by its number, which is less than {count}"
        raise InvalidValue("over", rule, got=Given(step), count=len(inner))
    return int(step)

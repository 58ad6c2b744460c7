"""The columns of a table of answers, taken from the answer's model before the first answer.

So every part of a sweep has the same columns of the same types, even if all its designs failed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin

import orjson
import pyarrow as pa
from pydantic import BaseModel

from app.wire.evidence import Words
from app.wire.fields import typed_fields
from core.display import Readable

TYPES = {bool: pa.bool_(), int: pa.int64(), float: pa.float64(), str: pa.string()}


@dataclass(frozen=True, slots=True)
class Column:
    """One column.

    name: dotted place in the answer; steps: the names and indices to that place; kind: bool, int, float or str
    unit: of its values; as_json: True for a list or an object, which the column holds as JSON
    """

    name: str
    steps: tuple[str | int, ...]
    kind: type
    unit: str = ""
    as_json: bool = False

    def value(self, answer: Any) -> Any:
        """Value of this column in an answer; None if the answer has none."""
        for step in self.steps:
            if answer is None:
                return None
            answer = answer[step] if isinstance(step, int) else getattr(answer, step)
        if self.as_json:
            return orjson.dumps(answer, default=_dumped).decode()
        return answer


def _dumped(value: Any) -> Any:
    return value.model_dump(mode="json")


@lru_cache(maxsize=16)
def answer_columns(model: type[BaseModel | Readable], left_out: frozenset[str] = frozenset()) -> tuple[Column, ...]:
    """A column for every number, text and truth value of an answer: dotted names for inner objects and pairs, JSON for
    lists of any length. left_out: fields without columns"""
    return tuple(_columns_of(model, (), left_out, ""))


def _columns_of(kind: Any, steps: tuple[str | int, ...], left_out: frozenset[str], unit: str) -> Iterator[Column]:
    name = ".".join(map(str, steps))
    if name in left_out:
        return
    options = [one for one in get_args(kind) if one is not NoneType]
    if get_origin(kind) in (Union, UnionType) and len(options) == 1:
        yield from _columns_of(options[0], steps, left_out, unit)
    elif isinstance(kind, type) and issubclass(kind, Words):
        return  # No request of a sweep asks for words.
    elif isinstance(kind, type) and issubclass(kind, BaseModel | Readable):
        for inner, (annotation, own) in typed_fields(kind).items():
            yield from _columns_of(annotation, (*steps, inner), left_out, own)
    elif get_origin(kind) is tuple and Ellipsis not in options:
        for k, option in enumerate(get_args(kind)):
            yield from _columns_of(option, (*steps, k), left_out, unit)
    elif get_origin(kind) is Literal or (isinstance(kind, type) and issubclass(kind, Enum)):
        yield Column(name, steps, str)
    elif kind in TYPES:
        yield Column(name, steps, kind, unit)
    else:
        yield Column(name, steps, str, as_json=True)


def value_type(values: Sequence[Any]) -> type:
    """Type of a column of given values: bool, int, float or str; values kept as JSON are str."""
    kinds = {type(value) for value in values}
    if kinds == {int, float}:
        return float
    return kinds.pop() if len(kinds) == 1 and kinds <= TYPES.keys() else str
